"""What `asperity roots` tells: where stresses are largest, and what a reader should know."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.root_stress import study
from asperity.drive.root_stress.model import RootModel, Roots
from asperity.drive.root_stress.result import Largest, _notes
from asperity.errors import InputError
from asperity.flanks.mesh.tooth import Counts
from asperity.runs import Run

SMALL = Counts(flank=4, face=6, thickness=4, rim=3, land=2, low_fillet=3, high_fillet=3)


def roots(loaded, other):
    """Stresses under loads at two nodes of either fillet."""
    jump = np.zeros((len(loaded), 2))
    return Roots((np.array(loaded, float), np.array(other, float)), (jump, jump))


def test_the_largest_stresses_are_found_among_loads_and_nodes():
    none = [0.0] * 6
    pulled = [30.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    sheared = [0.0, 0.0, 0.0, 20.0, 0.0, 0.0]  # principal stresses 20, 0, -20
    pressed = [0.0, -50.0, 0.0, 0.0, 0.0, 0.0]
    found = Largest.of(roots([[none, sheared], [none, pulled]], [[none, none], [pressed, none]]))
    assert (found.load, found.node) == (1, 1)
    assert found.tension == pytest.approx(30.0)
    assert found.compression == pytest.approx(-50.0)
    assert found.equivalent == pytest.approx(50.0)
    assert found.shear == pytest.approx(20.0)


def test_notes_tell_a_tooth_alone_a_load_beside_the_fillet_and_a_coarse_mesh():
    assert len(_notes(3, 0.05, 0.01)) == 1
    told = _notes(1, 0.32, -0.19)
    assert len(told) == 4
    assert "one tooth alone" in told[1]
    assert told[2].startswith("32 % of the tooth's force")
    assert told[3].startswith("a coarser mesh has 19 % less")


@pytest.fixture(scope="module")
def found():
    settings = ("drive.phases=2", "drive.teeth=1")
    case = read_case("drive-screw", case_tables(), settings)
    patched = pytest.MonkeyPatch()
    patched.setattr(study, "COUNTS", SMALL)
    patched.setattr(study, "COARSER", SMALL._replace(rim=2))
    with patched.context():
        yield study.answer(study.prepare(case), Run())
    patched.undo()


@pytest.mark.slow
def test_the_answer_is_the_largest_of_its_courses_and_its_fillet(found):
    assert found.tension == pytest.approx(1e-6 * found.tension_course.max())
    assert found.tension == pytest.approx(1e-6 * found.fillet_tension.max())
    assert found.compression == pytest.approx(1e-6 * found.compression_course.min())
    assert found.residual < 1e-9
    assert found.compression < 0.0 < found.shear < found.equivalent
    at = np.unravel_index(np.argmax(found.fillet_tension), found.fillet_tension.shape)
    assert found.tension_radius == pytest.approx(1e3 * found.fillet_radius[at])
    assert found.tension_face == pytest.approx(1e3 * found.fillet_face[at])
    assert found.fillet_way[0] == pytest.approx(0.0)
    assert (np.diff(found.fillet_way, axis=0) > 0.0).all()
    # The standard's own stress and safety are those of `asperity rate`.
    assert found.nominal_shear == pytest.approx(135.74, abs=0.01)
    assert found.nominal_safety == pytest.approx(0.943, abs=1e-3)


@pytest.mark.slow
def test_twice_the_torque_bends_a_tooth_about_twice_as_much(found):
    case = read_case(
        "drive-screw", case_tables(), ("drive.phases=2", "operation.output_torque=183 N m")
    )
    static = study.StaticModel(study.prepare(case), Run())
    wheel = study.right_handed(static.sector.wheel)
    own = RootModel(wheel, static.problem.gearset.wheel_material, SMALL, 1)
    (load, *_) = [one for one in study.loads_of(static) if one.foot < 0.05]
    forces = own.nodal(static.sector.surface, load.forces)
    two = own.solve(np.column_stack([forces, 2.0 * forces])).principal(0)
    np.testing.assert_allclose(two[1], 2.0 * two[0], rtol=1e-9, atol=1e-3)


def test_a_rim_that_leaves_no_room_is_refused_in_a_line():
    case = read_case("drive-screw", case_tables(), ("gearset.rim_thickness=100 mm",))
    with pytest.raises(InputError, match="rim_thickness"):
        study.answer(study.prepare(case), Run())
