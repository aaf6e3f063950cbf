"""Stress at the fillets of a wheel's teeth: a field that is known, statics, and CalculiX.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import functools
import shutil

import numpy as np
import pytest
from apparatus.calculix import of_twenty_nodes, solved

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.root_stress.loads import loads_of
from asperity.drive.root_stress.model import COUNTS, RootModel, Roots
from asperity.drive.root_stress.study import prepare
from asperity.drive.static.solve import StaticModel
from asperity.drive.teeth.sector import right_handed
from asperity.flanks.mesh.tooth import Counts
from asperity.flanks.wheel.frame import turned
from asperity.mesh.shape import REFERENCE_FACE_NODES, face_shapes
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


def normals(own, fillet):
    """Unit vectors across a fillet at its nodes, means of its faces'."""
    _, slopes = face_shapes(REFERENCE_FACE_NODES, 9)
    along = np.einsum("qnj,mni->mqji", slopes, own.mesh.points[fillet.faces])
    across = np.cross(along[..., 0, :], along[..., 1, :])
    found = np.zeros((len(fillet.nodes), 3))
    np.add.at(found, np.searchsorted(fillet.nodes, fillet.faces), across)
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def test_a_fillet_has_the_stress_of_its_strained_surface_that_nothing_presses_on():
    slope = 1e-4 * np.array([[1.0, -2.0, 0.5], [0.3, 0.7, -1.1], [0.9, 0.2, -0.4]])
    off = []
    few = SMALL._replace(flank=2, thickness=2, rim=2)
    for counts in (few, few._replace(face=12, land=4, low_fillet=6, high_fillet=6)):
        own = model(1, counts)
        moved = (own.mesh.points @ slope.T).reshape(-1, 1)
        first, second = own.material.lame
        for fillet in own.fillets:
            normal = normals(own, fillet)
            plane = np.eye(3) - normal[:, :, None] * normal[:, None, :]
            strain = plane @ (0.5 * (slope + slope.T)) @ plane
            trace = np.trace(strain, axis1=1, axis2=2)[:, None, None]
            stress = 2.0 * second * (strain + first / (first + 2.0 * second) * trace * plane)
            found, jump = own.stress(fillet, moved)
            expected = np.stack([stress[:, i, j] for i, j in PAIRS], axis=-1)
            off.append(np.abs(found[0] - expected).max() / np.abs(stress).max())
            assert jump.max() < 0.05 * np.abs(stress).max()
    assert max(off[:2]) < 0.02
    assert max(off[2:]) < 0.4 * max(off[:2])


def test_a_fillet_that_is_turned_as_it_is_has_no_stress():
    own = model(1)
    turn = 1e-4 * np.array([[0.0, -2.0, 0.5], [2.0, 0.0, -1.1], [-0.5, 1.1, 0.0]])
    moved = (own.mesh.points @ turn.T).reshape(-1, 1)
    for fillet in own.fillets:
        found, jump = own.stress(fillet, moved)
        assert max(np.abs(found).max(), jump.max()) < 1e-9 * own.material.youngs_modulus * 1e-4


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


@pytest.mark.slow
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
    for counts in (COUNTS, COUNTS._replace(thickness=10, rim=5)):
        own = model(3, counts)
        roots = own.solve(own.nodal(surface, worst.forces)[:, None])
        found.append(roots.principal(0)[..., 2].max())
    assert found[0] == pytest.approx(found[1], rel=0.05)


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed")
def test_calculix_finds_the_same_stress_at_the_fillet(tmp_path):
    own = model(1, COUNTS)
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
    forces = np.zeros_like(nodal)
    forces[pulled] = len(tip) / len(pulled) * force
    moved, stress = solved(tmp_path, mesh.points, mesh.cells, inner, forces, own.material)
    xx, yy, zz, xy, yz, zx = stress[own.fillets[0].nodes].T
    whole = np.stack([np.stack(r, -1) for r in ((xx, xy, zx), (xy, yy, yz), (zx, yz, zz))], -2)
    other = np.linalg.eigvalsh(whole[np.isfinite(xx)])[:, 2]
    ours = roots.principal(0)[0, :, 2].max()
    assert 1e6 * other.max() == pytest.approx(ours, rel=0.05)
    # What it says of the fillet's surface.
    theirs = own.stress(own.fillets[0], 1e-3 * moved.reshape(-1, 1))[0]
    assert Roots((theirs, theirs), (theirs, theirs)).principal(0)[..., 2].max() == pytest.approx(
        ours, rel=0.02
    )


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed")
def test_calculix_finds_the_same_stress_at_the_fillet_under_the_forces_of_the_contact(tmp_path):
    worst = max(loads_of(static()), key=lambda load: load.normal)
    surface = static().sector.surface
    own = model(1, COUNTS)
    ours = own.solve(own.nodal(surface, worst.forces)[:, None]).principal(0)[0, :, 2].max()
    # Its stresses are carried on from inside to the nodes: with 8 hexahedra through the tooth they
    # are 8 % less than its displacements say, with 12 5 %, with 16 4 %.
    fine = model(1, COUNTS._replace(thickness=16, low_fillet=8, high_fillet=8))
    nodal = fine.nodal(surface, worst.forces).reshape(-1, 3)
    mesh = fine.mesh.converted("mm")
    forces = of_twenty_nodes(mesh.cells, nodal)
    for before, after in ((nodal, forces), (np.cross(mesh.points, nodal),
                                            np.cross(mesh.points, forces))):  # fmt: skip
        np.testing.assert_allclose(after.sum(axis=0), before.sum(axis=0), rtol=1e-4)
    inner = np.unique(mesh.face_nodes("inner"))
    moved, stress = solved(tmp_path, mesh.points, mesh.cells, inner, forces, fine.material)
    fillet = fine.fillets[0]
    of_fillet = stress[fillet.nodes]
    known = Roots((1e6 * of_fillet[np.isfinite(of_fillet[:, 0])][None],) * 2, (of_fillet,) * 2)
    assert known.principal(0)[..., 2].max() == pytest.approx(ours, rel=0.05)
    theirs = fine.stress(fillet, 1e-3 * moved.reshape(-1, 1))[0]
    strained = Roots((theirs, theirs), (theirs, theirs)).principal(0)[..., 2].max()
    assert strained == pytest.approx(ours, rel=0.01)
