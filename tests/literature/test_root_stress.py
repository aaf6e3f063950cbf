"""Stress at the fillets of a wheel's teeth: a field that is known, statics, and CalculiX.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import functools
import re
import shutil
import subprocess

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.root_stress.loads import loads_of
from asperity.drive.root_stress.model import COUNTS, RootModel
from asperity.drive.root_stress.study import prepare
from asperity.drive.static.solve import StaticModel
from asperity.drive.teeth.sector import right_handed
from asperity.flanks.mesh.tooth import Counts
from asperity.flanks.wheel.frame import turned
from asperity.mesh.inp import numbers
from asperity.runs import Run

SMALL = Counts(flank=4, face=6, thickness=4, rim=3, land=2, low_fillet=3, high_fillet=3)
PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))


@functools.cache
def static():
    case = read_case("drive-screw", case_tables(), ("drive.phases=2",))
    return StaticModel(prepare(case), Run())


@functools.cache
def model(teeth, counts=SMALL):
    wheel = right_handed(static().sector.wheel)
    return RootModel(wheel, static().problem.gearset.wheel_material, counts, teeth)


def test_a_field_of_even_strain_has_its_stress_at_every_node_of_both_fillets():
    own = model(1)
    slope = 1e-4 * np.array([[1.0, -2.0, 0.5], [0.3, 0.7, -1.1], [0.9, 0.2, -0.4]])
    moved = (own.mesh.points @ slope.T).reshape(-1, 1)
    first, second = own.material.lame
    strain = 0.5 * (slope + slope.T)
    stress = 2.0 * second * strain + first * np.trace(strain) * np.eye(3)
    for fillet in own.fillets:
        found, jump = own.stress(fillet, moved)
        expected = [stress[pair] for pair in PAIRS]
        np.testing.assert_allclose(found[0], np.tile(expected, (len(found[0]), 1)), rtol=1e-9)
        assert jump.max() < 1e-9 * np.abs(stress).max()


def test_a_fillet_goes_from_the_foot_of_its_flank_to_the_middle_of_the_tooth_space():
    own = model(1)
    flank = own.mesh.points[np.unique(own.mesh.face_nodes("flank_plus"))]
    cut = np.unique(own.mesh.face_nodes("cut_plus"))
    fillet = own.fillets[0]
    rows = fillet.places[fillet.grid]
    assert len(rows) == 2 * (SMALL.land + SMALL.low_fillet + SMALL.high_fillet) + 1
    for place in rows[0]:
        assert np.linalg.norm(flank - place, axis=1).min() < 1e-12
    assert np.isin(fillet.nodes[fillet.grid[-1]], cut).all()
    # Outwards along the face all rows alike.
    assert (np.diff(rows[..., 2], axis=1) > 0.0).all()
    assert (np.diff(np.hypot(rows[..., 0], rows[..., 1]), axis=0)[:4] < 0.0).all()


def test_three_teeth_feel_the_forces_and_moments_that_the_loaded_contact_gives_them():
    loads = loads_of(static())
    surface, pitch = static().sector.surface, static().sector.pitch
    own = model(3)
    assert {load.phase for load in loads} == {0, 1}
    for load in loads:
        nodal = own.nodal(surface, load.forces).reshape(-1, 3)
        force, moment = nodal.sum(axis=0), np.cross(own.mesh.points, nodal).sum(axis=0)
        given, about = np.zeros(3), np.zeros(3)
        for place, one in enumerate(load.forces):
            turn = turned(place * pitch)
            given += turn @ one.sum(axis=0)
            about += turn @ np.cross(surface.positions, one).sum(axis=0)
        size = np.linalg.norm(given)
        # Another mesh of the same flank: it is not quite as large.
        np.testing.assert_allclose(force, given, rtol=0, atol=0.02 * size)
        np.testing.assert_allclose(moment, about, rtol=0, atol=0.02 * np.linalg.norm(about))
    # Where three teeth bear, their torque is the wheel's.
    most = max(loads, key=lambda load: np.abs(load.forces).sum())
    nodal = own.nodal(surface, most.forces).reshape(-1, 3)
    torque = np.cross(own.mesh.points, nodal).sum(axis=0)[2]
    assert abs(torque) == pytest.approx(static().problem.load, rel=0.02)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_calculix_finds_the_same_stress_at_the_fillet")
def test_on_finer_hexahedra_the_stress_stays():
    loads = loads_of(static())
    worst = max(loads, key=lambda load: load.normal)
    surface = static().sector.surface
    found = []
    for counts in (COUNTS, COUNTS._replace(thickness=8, rim=5)):
        own = model(3, counts)
        roots = own.solve(own.nodal(surface, worst.forces)[:, None])
        found.append(roots.principal(0)[..., 2].max())
    assert found[0] == pytest.approx(found[1], rel=0.05)


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed")
def test_calculix_finds_the_same_stress_at_the_fillet(tmp_path):
    own = model(1)
    mesh = own.mesh.converted("mm")
    # Pulled at the tip, whose hexahedra are far from the fillets.
    tip = np.unique(mesh.face_nodes("tip"))
    force = np.array([-1.0, 0.2, 0.4])
    nodal = np.zeros((len(mesh.points), 3))
    nodal[tip] = force
    roots = own.solve(nodal.reshape(-1, 1))
    used = np.unique(mesh.cells[:, :20])
    inner = np.intersect1d(np.unique(mesh.face_nodes("inner")), used)
    pulled = np.intersect1d(tip, used)
    scale = len(tip) / len(pulled)
    lines = [
        "*NODE", *(f"{n + 1}, {numbers(*mesh.points[n])}" for n in used),
        "*ELEMENT, TYPE=C3D20, ELSET=BODY",
        # Without the nodes in the middle of faces and cells.
        *(
            f"{k}, {', '.join(map(str, cell[:15] + 1))},\n{', '.join(map(str, cell[15:20] + 1))}"
            for k, cell in enumerate(mesh.cells, 1)
        ),
        "*MATERIAL, NAME=OWN", "*ELASTIC",
        numbers(1e-6 * own.material.youngs_modulus, own.material.poissons_ratio),
        "*SOLID SECTION, ELSET=BODY, MATERIAL=OWN", "*NSET, NSET=HELD",
        *(f"{node + 1}," for node in inner), "*BOUNDARY", "HELD, 1, 3", "*STEP", "*STATIC",
        "*CLOAD",
        *(
            f"{node + 1}, {axis + 1}, {float(scale * force[axis])!r}"
            for node in pulled for axis in range(3)
        ),
        "*EL FILE", "S", "*END STEP", "",
    ]  # fmt: skip
    (tmp_path / "root.inp").write_text("\n".join(lines))
    done = subprocess.run(
        ["ccx", "root"], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=300
    )
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    text = (tmp_path / "root.frd").read_text()
    rows = re.search(r"^ -4  STRESS.*\n(?:^ -5.*\n)+((?:^ -1.*\n)+)", text, re.MULTILINE)[1]
    theirs = {
        int(row[3:13]) - 1: [float(row[i : i + 12]) for i in range(13, 85, 12)]
        for row in rows.splitlines()
    }
    xx, yy, zz, xy, yz, zx = np.array([theirs[n] for n in own.fillets[0].nodes if n in theirs]).T
    other = np.linalg.eigvalsh(
        np.stack([np.stack(r, -1) for r in ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz))], -2)
    )[:, 2]
    assert 1e6 * other.max() == pytest.approx(roots.principal(0)[0, :, 2].max(), rel=0.05)
