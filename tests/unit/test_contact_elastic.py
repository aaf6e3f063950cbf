"""Condensing a body: its cache, solvers, bounds and refusals."""

import importlib
import os
import subprocess
import sys
from dataclasses import fields, replace

import numpy as np
import pytest
from apparatus.loads import Force

from asperity.contact.elastic import (
    ElasticMaterial,
    Pressure,
    Traction,
    condense,
    elastic_body,
    machine_memory,
    memory_for,
)
from asperity.contact.elastic.solver import factorise, installed_solver
from asperity.errors import InputError
from asperity.mesh import HexMesh, box

condensing = importlib.import_module("asperity.contact.elastic.condense")

STEEL = ElasticMaterial(209e9, 0.3, 7850.0)
SOLVERS = sorted({"superlu", installed_solver()})
SIZE = (0.04, 0.03, 0.03)
LOADS = {"drive": Force("right", (1.0, 0.0, 0.0))}


@pytest.fixture
def store(tmp_path, monkeypatch):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    return tmp_path / "asperity" / "condensed"


def assert_same(one, other):
    for field in fields(one):
        if field.name not in ("from_cache", "seconds"):
            a, b = getattr(one, field.name), getattr(other, field.name)
            assert type(a) is type(b), field.name
            assert np.array_equal(a, b), field.name


def test_what_was_condensed_once_is_read_back_the_same(store):
    mesh = box(SIZE, (2, 2, 2), 2)
    first = condense(mesh, STEEL, "bottom", loads=LOADS, modes=2)
    second = condense(mesh, STEEL, "bottom", loads=LOADS, modes=2)
    assert (first.from_cache, second.from_cache) == (False, True)
    assert second.seconds == first.seconds > 0.0
    assert_same(first, second)


@pytest.mark.slow
def test_another_body_is_another_entry(store):
    mesh = box(SIZE, (2, 1, 1))
    moved = replace(mesh, points=mesh.points * [1.0, 1.0, 1.001])
    cases = [
        (mesh, STEEL, {}),
        (moved, STEEL, {}),
        (mesh, replace(STEEL, density=7000.0), {}),
        (mesh, STEEL, {"element": "hex8i"}),
        (mesh, STEEL, {"tied": "top"}),
        (mesh, STEEL, {"tied": "top", "movable": True}),
        (mesh, STEEL, {"modes": 1}),
        (mesh, STEEL, {"loads": LOADS}),
        (mesh, STEEL, {"loads": {"other": LOADS["drive"]}}),
    ]
    for case, material, options in cases:
        assert not condense(case, material, "bottom", **options).from_cache
    assert len([*store.glob("*.npz")]) == len(cases)


@pytest.mark.parametrize("damage", [b"", b"PK\x03\x04 torn", None])
def test_a_damaged_entry_is_made_again(store, damage):
    mesh = box(SIZE, (2, 1, 1))
    first = condense(mesh, STEEL, "bottom")
    (path,) = store.glob("*.npz")
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 0xFF
    path.write_bytes(bytes(content) if damage is None else damage)
    told = []
    again = condense(mesh, STEEL, "bottom", notify=told.append)
    assert not again.from_cache
    assert told == [f"{path} is damaged, or nothing of ours; set aside as {path.name}.damaged"]
    assert_same(first, again)
    assert condense(mesh, STEEL, "bottom").from_cache


def test_a_mesh_in_millimetres_is_the_same_body():
    mesh = box(SIZE, (2, 1, 1))
    metres = condense(mesh, STEEL, "bottom", use_cache=False)
    millimetres = condense(mesh.converted("mm"), STEEL, "bottom", use_cache=False)
    assert millimetres.positions == pytest.approx(metres.positions, abs=1e-17)
    difference = millimetres.flexibility - metres.flexibility
    assert np.abs(difference).max() < 1e-12 * np.abs(metres.flexibility).max()


@pytest.mark.slow
def test_every_solver_gives_the_same_body_and_says_its_name():
    mesh = box(SIZE, (3, 2, 2), 2)
    chosen = installed_solver()
    first = condense(mesh, STEEL, "bottom", loads=LOADS, modes=3, use_cache=False)
    other = condense(mesh, STEEL, "bottom", loads=LOADS, modes=3, solver="superlu", use_cache=False)
    assert (first.solver, other.solver) == (chosen, "superlu")
    # Modes of equal frequency may be combined otherwise; what they carry together is the same.
    for name in ("flexibility", "mode_frequency", "load_compliance", "residual_flexibility"):
        a, b = getattr(first, name), getattr(other, name)
        assert np.abs(a - b).max() < 1e-8 * np.abs(a).max(), name
    assert max(first.residual, other.residual) < 1e-9


def test_without_pypardiso_superlu_is_taken(monkeypatch):
    monkeypatch.setitem(sys.modules, "pypardiso", None)
    assert installed_solver() == "superlu"
    with pytest.raises(ImportError, match="'pypardiso' is not installed"):
        installed_solver("pypardiso")


def test_a_pypardiso_that_finds_no_library_is_none(monkeypatch, tmp_path):
    (tmp_path / "pypardiso.py").write_text("None.split()")
    monkeypatch.delitem(sys.modules, "pypardiso", raising=False)
    monkeypatch.syspath_prepend(tmp_path)
    assert installed_solver() == "superlu"
    with pytest.raises(ImportError, match="'pypardiso' finds no MKL library; install it, or use"):
        installed_solver("pypardiso")


@pytest.mark.parametrize("said", ["max", "1000000000", ""])
def test_the_memory_is_the_machine_s_or_less_of_it_in_a_container(said, monkeypatch, tmp_path):
    whole = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    (tmp_path / "memory.max").write_text(f"{said}\n")
    limits = (str(tmp_path / "memory.max"), str(tmp_path / "nothing"))
    monkeypatch.setattr(condensing, "_CONTAINER_LIMITS", limits)
    assert machine_memory() == (min(1e9, whole) if said.isdigit() else whole)
    monkeypatch.delattr(os, "sysconf")
    assert machine_memory() == (1e9 if said.isdigit() else np.inf)


def test_a_mesh_that_does_not_fit_this_machine_is_refused_and_one_that_does_is_not(monkeypatch):
    mesh = box(SIZE, (20, 20, 20), 1)
    needed = memory_for(len(mesh.points), mesh.cells.shape, 21 * 21, solver=installed_solver())
    monkeypatch.setattr(condensing, "machine_memory", lambda: 0.9 * needed)
    with pytest.raises(InputError, match=r"needs about \S+ GB, more than the limit of \S+ GB"):
        condense(mesh, STEEL, "bottom", use_cache=False)


def test_a_mesh_too_large_for_the_memory_is_refused_with_the_figure_before_any_work():
    mesh = box(SIZE, (40, 40, 40), 1)
    needed = memory_for(len(mesh.points), mesh.cells.shape, 41 * 41)
    assert needed > 1e9
    with pytest.raises(InputError, match=r"needs about \d+(\.\d)? GB, more than the limit of 1 GB"):
        condense(mesh, STEEL, "bottom", memory_limit=1e9, use_cache=False)


@pytest.mark.parametrize("solver", SOLVERS)
def test_a_matrix_that_is_not_positive_definite_is_refused(solver):
    body = elastic_body(box(SIZE, (2, 1, 1)), STEEL, solver=solver)
    with pytest.raises(InputError, match="not positive definite"):
        factorise(-body.stiffness[body.moving][:, body.moving], solver)
    with pytest.raises(InputError, match="not positive definite"):
        factorise(-body.stiffness[body.moving][:, body.moving], solver, np.array([3, 5]))


@pytest.mark.parametrize("solver", SOLVERS)
@pytest.mark.parametrize("tied", [None, "top"])
def test_a_flexibility_is_what_unit_forces_do_whatever_order_they_are_asked_in(solver, tied):
    wanted = np.random.default_rng(3).permutation(3 * 27)[:20]
    body = elastic_body(box(SIZE, (2, 2, 2)), STEEL, tied=tied, solver=solver, loaded=wanted)
    plain = elastic_body(box(SIZE, (2, 2, 2)), STEEL, tied=tied, solver=solver)
    forces = np.zeros((3 * 27, len(wanted)))
    forces[wanted, np.arange(len(wanted))] = 1.0
    moved = plain.response(forces)
    if tied is not None:
        assert not np.isin(wanted, body.moving).all()
    tolerance = 1e-12 * np.abs(moved).max()
    np.testing.assert_allclose(body.flexibility(), moved[wanted], rtol=0.0, atol=tolerance)
    np.testing.assert_allclose(body.response(forces), moved, rtol=0.0, atol=tolerance)


def test_a_body_that_is_not_held_is_refused():
    mesh = box(SIZE, (2, 2, 2))
    edge = np.flatnonzero((mesh.points[:, 0] > 0.019) & (mesh.points[:, 2] > 0.029))
    mesh = replace(mesh, node_sets={**mesh.node_sets, "edge": edge, "all": range(27)})
    with pytest.raises(InputError, match=r"'edge' ties 3 nodes that lie on a line; .* not held"):
        condense(mesh, STEEL, "bottom", tied="edge", use_cache=False)
    with pytest.raises(InputError, match="ties every node"):
        condense(mesh, STEEL, "bottom", tied="all", use_cache=False)


def test_a_mesh_that_is_not_one_sound_piece_is_refused():
    mesh = box(SIZE, (1, 1, 1))
    away = mesh.points + np.array([0.1, 0.0, 0.0])
    pieces = HexMesh(
        np.concatenate([mesh.points, away]),
        np.concatenate([mesh.cells, mesh.cells + 8]),
        face_sets=mesh.face_sets,
    )
    with pytest.raises(InputError, match="falls into 2 pieces"):
        condense(pieces, STEEL, "bottom", use_cache=False)
    unused = replace(mesh, points=np.concatenate([mesh.points, away[:2]]))
    with pytest.raises(InputError, match="2 of 10 nodes belong to no cell"):
        condense(unused, STEEL, "bottom", use_cache=False)
    inverted = replace(mesh, cells=mesh.cells[:, [4, 5, 6, 7, 0, 1, 2, 3]])
    with pytest.raises(InputError, match="turned inside out, the first is cell 0"):
        condense(inverted, STEEL, "bottom", use_cache=False)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"element": "hex27"}, "element is 'hex27', with 27 nodes; the mesh has 8"),
        ({"element": "tet4"}, "element is 'tet4'; allowed"),
        ({"modes": -1}, "modes is -1; allowed: 0 to"),
        ({"modes": 1000}, "modes is 1000; allowed: 0 to"),
        ({"solver": "cholmod"}, "solver is 'cholmod'; allowed"),
        ({"tied": "roof"}, "no face set 'roof'"),
        ({"loads": {"gravity_x": Pressure("top")}}, "choose another name"),
        ({"loads": {"a": Pressure("tpo")}}, "no face set 'tpo' .did you mean 'top'"),
        ({"loads": {"a": Force("top", (0, 0, 0))}}, "direction is"),
        ({"loads": {"a": Force([99], (1, 0, 0))}}, "give nodes of the mesh"),
        ({"loads": {"a": Traction("none", (1, 0, 0))}}, "face set 'none' is empty"),
        ({"contact": "none"}, "face set 'none' is empty"),
        ({"contact": "buttom"}, "did you mean 'bottom'"),
    ],
)
def test_what_cannot_be_condensed_is_refused_in_one_line(options, message):
    mesh = box(SIZE, (2, 1, 1))
    mesh = replace(mesh, face_sets={**mesh.face_sets, "none": np.empty((0, 2), int)})
    options = {"contact": "bottom", "use_cache": False} | options
    with pytest.raises(InputError, match=message) as caught:
        condense(mesh, STEEL, **options)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "values", [(0.0, 0.3, 7850.0), (209e9, 0.5, 7850.0), (209e9, -1.0, 7850.0), (209e9, 0.3, -1.0)]
)
def test_a_material_out_of_range_is_refused(values):
    with pytest.raises(InputError):
        ElasticMaterial(*values)


def test_a_body_has_the_loads_it_was_given_and_gravity():
    body = condense(box(SIZE, (2, 1, 1)), STEEL, "bottom", loads=LOADS, use_cache=False)
    assert body.load_names == ("gravity_x", "gravity_y", "gravity_z", "drive")
    with pytest.raises(InputError, match=r"no load 'drvie' .did you mean 'drive'"):
        body.load_index("drvie")


_PEAK = """
import sys
from pathlib import Path
import numpy as np
from asperity.contact.elastic import ElasticMaterial, condense, memory_for
from asperity.mesh import box

def peak_so_far():  # of this program alone: that of getrusage counts the one it was started from
    status = Path("/proc/self/status").read_text().split()
    return 1024 * int(status[status.index("VmHWM:") + 1])


material, solver = ElasticMaterial(209e9, 0.3, 7850.0), sys.argv[1]
condense(box((1, 1, 1), (2, 1, 1)), material, "bottom", solver=solver, modes=1, use_cache=False)
before = peak_so_far()
mesh = box((0.04, 0.03, 0.03), (8, 6, 6), 2)
condense(mesh, material, "left", solver=solver, modes=2, use_cache=False)
contact = len(mesh.node_set("left"))
needed = memory_for(len(mesh.points), mesh.cells.shape, contact, modes=2, solver=solver)
print((peak_so_far() - before) / needed)
"""


@pytest.mark.slow
@pytest.mark.parametrize("solver", SOLVERS)
def test_condensing_stays_within_the_memory_it_says_it_needs(solver):
    ran = subprocess.run(
        [sys.executable, "-c", _PEAK, solver], capture_output=True, text=True, check=True
    )
    assert 0.3 < float(ran.stdout) < 1.0
