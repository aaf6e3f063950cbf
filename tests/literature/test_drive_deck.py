"""The deck of loaded teeth run by CalculiX, against the package's own contact of one tooth.

G. Dhondt, K. Wittig: CalculiX, a free software three-dimensional structural finite element program.
"""

import re
import shutil
import subprocess

import numpy as np
import pytest
from apparatus.drives import case

from asperity.contact.candidates.records import Answer, Candidates
from asperity.drive.deck import TeethSetup, abaqus_files, calculix_files
from asperity.drive.deck.calculix import deflection, torques
from asperity.drive.deck.facets import on_faces, rows_of
from asperity.drive.deck.setup import PER_TURN, SLID, WORM, turned_about
from asperity.drive.teeth.sector import RIM
from asperity.errors import InputError
from asperity.flanks.worm.distance import distances

FLOAT = r"[-+]?\d\.\d+E[-+]\d+"
LOAD = 60.0  # N m, of a tooth alone

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def setup():
    """A tooth cut out of the wheel, alone in the worm: small enough to solve in half a minute."""
    return alone(
        case("drive.teeth=1", f"operation.output_torque={LOAD} N m", "friction.model=coulomb")
    )


def alone(given):
    """The deck of a case whose wheel is one tooth."""
    made = TeethSetup.from_case(given)
    contact = made.model.contact
    body = contact.sector.body
    contact.slots = 1
    contact.candidates, contact.answer = Candidates.workspace(body, 1), Answer.workspace(body, 1)
    return made


CORNERS = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
GAUSS = 0.25 * (1.0 + np.einsum("gi,ci->gci", CORNERS / 3.0**0.5, CORNERS)).prod(axis=-1)


def inside(points, quads):
    """Places of Gauss on faces that are straight between their corners, shape (4 n, 3)."""
    return np.einsum("gc,fci->gfi", GAUSS, points[quads]).reshape(-1, 3)


def test_the_worm_s_faces_are_on_the_exact_flank_and_their_layer_behind_it(setup):
    own = turned_about(setup.worm.points, setup.axis, setup.origin, SLID)
    faces = setup.worm.face_nodes(WORM)[:, :4]

    def off(places):
        return np.abs(distances(setup.pair.mounting.to_helicoid(1e3 * places), setup.pair.worm, 1))

    # Their nodes stand back by a micrometre, so that the faces do not.
    assert off(own[np.unique(faces)]).max() > 1e-3
    assert off(inside(own, faces)).max() < 3e-4
    assert np.median(off(inside(own, faces))) < 1e-4
    assert setup.worm.scaled_jacobian().min() > 0.5


def bent(rows, columns):
    """Greatest distance of straight faces from a barrel, as its nodes stand and moved."""
    turn, along = np.meshgrid(
        np.linspace(-0.3, 0.3, rows), np.linspace(0.0, 4.0, columns), indexing="ij"
    )
    # 9 mm about and 70 mm along.
    radius = 9.0 - (along - 2.0) ** 2 / 140.0
    place = np.stack([radius * np.cos(turn), radius * np.sin(turn), along], axis=-1)
    number = np.arange(rows * columns).reshape(rows, columns)
    quads = np.stack(
        [number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], axis=-1
    ).reshape(-1, 4)
    assert (rows_of(quads) == number).all()

    def off(points):
        found = inside(points.reshape(-1, 3), quads)
        return np.abs(np.hypot(found[:, 0], found[:, 1]) - 9.0 + (found[:, 2] - 2.0) ** 2 / 140.0)

    return off(place).max(), off(on_faces(place)).max()


def test_straight_faces_between_moved_nodes_lie_on_a_bent_flank_to_fourth_order():
    (coarse, moved), (fine, moved_fine) = bent(5, 7), bent(9, 13)
    assert coarse / fine == pytest.approx(4.0, rel=0.02)
    assert moved < 0.01 * coarse
    assert moved / moved_fine == pytest.approx(16.0, rel=0.1)


def test_the_flanks_begin_apart_and_the_package_s_balance_carries_the_load(setup):
    before, loaded, end = setup.wheel_angles
    assert before > setup.touching - SLID / 15.0
    assert loaded < before
    assert end - loaded == pytest.approx(SLID / 15.0)
    assert setup.balance.action.wrench[5] == pytest.approx(LOAD, rel=1e-6)


def test_abaqus_is_told_of_the_same_motion_and_of_dahl_s_law_by_a_subroutine(setup):
    (name, text), *none = abaqus_files(setup).items()
    assert (name, none) == ("teeth.inp", [])
    assert "*RIGID BODY, ELSET=worm, REF NODE=worm_centre" in text
    assert re.search(r"\*FRICTION\n0\.1344,", text)
    assert text.count("*CLOAD\nwheel_centre, 6, -60.0,") == 1
    turns = re.findall(r"^worm_centre, ([456]), \1, (\S+?),?$", text, re.MULTILINE)
    last = np.array([float(amount) for _, amount in turns[-3:]])
    assert last == pytest.approx(SLID * setup.axis)
    dahl = TeethSetup.from_case(case("drive.teeth=1", f"operation.output_torque={LOAD} N m"))
    files = abaqus_files(dahl)
    assert set(files) == {"teeth.inp", "user.f"}
    assert "*FRICTION, USER, DEPVAR=3" in files["teeth.inp"]
    assert "law 'vector'" in files["user.f"]
    # On request that of the thesis's Appendix E, with its state and its three properties.
    asked = abaqus_files(dahl, "appendix-e")
    assert re.search(
        r"\*FRICTION, USER, DEPVAR=5, PROPERTIES=3\n0\.1344, 1\.0,", asked["teeth.inp"]
    )
    assert "Appendix E" in asked["user.f"]
    with pytest.raises(InputError, match="Appendix E is of 'dahl'"):
        abaqus_files(setup, "appendix-e")


def test_abaqus_is_told_of_the_shaken_gearset_in_the_steps_of_the_thesis(setup):
    assert setup.shaken is None
    assert "axial" in setup.unshaken
    given = case("drive.teeth=1", f"operation.output_torque={LOAD} N m", name="drive-thesis")
    made = TeethSetup.from_case(given)
    text = abaqus_files(made)["gear.inp"]
    steps = text.split("*STEP, NAME=")[1:]
    assert [step.split(",")[0] for step in steps] == ["touch", "load", "run_up", "vibration"]
    told = {
        "4394.0,": "*SPRING", "1, 47211.8": "DEFINITION=PERIODIC", "0.0032,": "*ROTARY INERTIA",
        "7600.0,": "*DENSITY",
    }  # fmt: skip
    for number, keyword in told.items():
        assert re.search(rf"{re.escape(keyword)}[^*]*\n{re.escape(number)}", text), keyword
    assert steps[1].count(f"*CLOAD\nwheel_centre, 6, {-LOAD},") == 1
    assert "wheel_centre, 6, 6" not in "".join(steps[1:])
    # 1440 rpm at B, 0.16 mm at A in the last step alone.
    assert re.search(r"AMPLITUDE=running_up\nmotor, 4, 4, 150\.796", steps[2])
    assert re.search(r"AMPLITUDE=shaking\nworm_centre, 1, 1, 0\.00016", steps[3])
    assert "worm_centre, 1, 3" not in steps[3]
    # Either all boundaries of a step are new, or none.
    assert text.count("*BOUNDARY,") == text.count("*BOUNDARY, OP=NEW")
    # No node and no element has a number twice.
    for kind in ("NODE", "ELEMENT"):
        blocks = re.findall(rf"^\*{kind}[^\n]*\n((?:\s*\d[^\n]*\n)+)", text, re.MULTILINE)
        numbers = [line.split(",")[0].strip() for block in blocks for line in block.splitlines()]
        assert len(set(numbers)) == len(numbers)


def test_the_rim_is_held_where_the_package_holds_it(setup):
    rim = setup.wheel.points[setup.wheel.node_set(RIM)]
    radius = np.hypot(rim[:, 0], rim[:, 1])
    assert np.ptp(radius) < 1e-9


HAS_CCX = pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
# Minutes each.
BY_ONE_TOOTH = pytest.mark.campaign(
    tried_by="test_calculix_finds_the_torques_and_the_deflection_of_the_package"
)


def run_by_calculix(setup, folder, onward=0.0):
    """Torques of wheel and worm after each increment, N m, and the wheel's deflection, rad."""
    for name, text in calculix_files(setup, onward).items():
        (folder / name).write_text(text)
    done = subprocess.run(
        ["ccx", "teeth"], cwd=folder, capture_output=True, text=True, check=False, timeout=3600
    )
    assert "Job finished" in done.stdout, done.stdout[-2000:]
    told = (folder / "teeth.dat").read_text()
    sums = np.array(
        re.findall(
            r"moment about the origin \(mx,my,mz\)\s+" + r"\s+".join([f"({FLOAT})"] * 6), told
        ),
        float,
    )
    turned = re.findall(rf"set WHEEL_TURNING.*\n\n\s+\d+(?:\s+{FLOAT})+\s+({FLOAT})", told)
    found = [torques(setup, one[:3], one[3:]) for one in sums]
    end = setup.at(setup.ends + onward)
    more = end.touching - setup.touching
    return found, more + deflection(setup, float(turned[-1]))


@HAS_CCX
def test_calculix_finds_the_torques_and_the_deflection_of_the_package(setup, tmp_path):
    found, turned = run_by_calculix(setup, tmp_path)
    wheel, worm = found[-1]
    end = setup.balance
    assert wheel == pytest.approx(LOAD, rel=1e-4)
    assert worm == pytest.approx(end.worm_torque, rel=2e-3)
    # Element by element the same, but pressed by its faces and not by its nodes: 4 % here.
    assert turned == pytest.approx(setup.touching - end.wheel_angle, rel=5e-2)
    # Before it slides friction is not yet that of sliding.
    assert found[3][1] < 0.8 * worm


@HAS_CCX
@BY_ONE_TOOTH
def test_calculix_finds_the_torques_and_the_deflection_of_five_teeth(tmp_path):
    setup = TeethSetup.from_case(case("drive.teeth=5", "friction.model=coulomb"))
    found, turned = run_by_calculix(setup, tmp_path)
    end = setup.balance
    assert np.count_nonzero(end.action.normal) == 3
    assert found[-1][0] == pytest.approx(setup.problem.load, rel=1e-4)
    assert found[-1][1] == pytest.approx(end.worm_torque, rel=2e-2)
    assert turned == pytest.approx(setup.touching - end.wheel_angle, rel=5e-2)


@HAS_CCX
@BY_ONE_TOOTH
@pytest.mark.parametrize("share", [-0.5, -5.0 / 12.0, -0.25, 0.0, 0.25, 0.5])
def test_calculix_finds_the_torque_as_a_pitch_passes_a_sector_of_three_teeth(share, tmp_path):
    # What lies between repeats: a revolution of the worm is four pitches.
    made = TeethSetup.from_case(case("drive.teeth=3", "friction.model=coulomb"))
    pitch = made.model.sector.pitch * made.pair.ratio
    setup = made.at(share * pitch)
    found, _ = run_by_calculix(setup, tmp_path)
    assert found[-1][1] == pytest.approx(setup.balance.worm_torque, rel=2e-2)


@HAS_CCX
@BY_ONE_TOOTH
def test_calculix_turns_the_worm_on_in_increments_that_are_short_beside_a_face(setup, tmp_path):
    onward = 0.13
    # The error goes with the square of an increment: 2.8 times the deflection in one, as a point
    # of the wheel goes on along the plane of the worm's face that it met when it began.
    found, turned = run_by_calculix(setup, tmp_path, onward)
    assert len(found) >= 7 + onward / (2.0 * np.pi / PER_TURN / 3.0)
    end = setup.at(onward)
    assert found[-1][0] == pytest.approx(LOAD, rel=1e-4)
    assert found[-1][1] == pytest.approx(end.balance.worm_torque, rel=2e-2)
    assert turned == pytest.approx(end.touching - end.balance.wheel_angle, rel=5e-2)


def test_a_turn_beyond_the_sector_is_refused(setup):
    pitch = setup.model.sector.pitch * setup.pair.ratio
    for angle in (0.51 * pitch, -60.0 * pitch, np.nan):
        with pytest.raises(InputError, match="take whole pitches away"):
            setup.at(angle)
    with pytest.raises(InputError, match="take whole pitches away"):
        calculix_files(setup.at(0.4 * pitch), 0.2 * pitch)
    for onward in (-0.1, 0.6, np.nan):
        with pytest.raises(InputError, match="turns on by 0 to"):
            calculix_files(setup, onward)


def pressure_of(made):
    """What the slope at rest of a deck says of the pressure: full friction over its deflection."""
    return made.stick * made.problem.friction.max_deflection / made.model.friction


@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_the_slope_at_rest_is_of_the_pressure_that_the_load_makes(angle):
    made = alone(case("drive.teeth=1", f"operation.output_torque={LOAD} N m")).at(angle)
    contact = made.balance.contact
    valid = np.arange(contact.answer.pressure.shape[1]) < 4 * contact.candidates.counts[:, :1]
    p, area = contact.answer.pressure[valid], contact.candidates.weights[valid]
    # All of the load: a point of contact at the wheel's pitch circle, rubbed by the worm.
    geometry = made.pair.geometry
    lead, alpha = geometry.lead_angle, geometry.pressure_angle
    arm = 0.5e-3 * geometry.wheel_mean_diameter
    share = np.cos(alpha) * np.cos(lead) - made.model.friction * np.sin(lead)
    assert p @ area == pytest.approx(LOAD / arm / share, rel=0.05)
    found = pressure_of(made)
    assert found == pytest.approx(np.average(p, weights=p * area), rel=1e-3)
    # Of Hertz's pressures the mean by force is 3/4 of the largest on an ellipse, 8/(3 pi) on a
    # line.
    assert 0.9 * 0.75 < found / p.max() < 1.1 * 8.0 / (3.0 * np.pi)
    # Whatever the model balanced since.
    again = alone(case("drive.teeth=1", f"operation.output_torque={LOAD} N m")).at(angle)
    assert again.at(-0.6).balance.action.wrench[5] == pytest.approx(LOAD, rel=1e-6)
    assert pressure_of(again) == pytest.approx(found, rel=1e-6)


def test_the_slope_of_a_deck_of_one_tooth_is_of_all_the_load_on_it(setup):
    given = case("drive.teeth=1", f"operation.output_torque={LOAD} N m")
    sharing = TeethSetup.from_case(given)
    assert np.count_nonzero(sharing.balance.action.normal) > 1
    assert sharing.stick == pytest.approx(alone(given).stick, rel=1e-6)


@HAS_CCX
@BY_ONE_TOOTH
@pytest.mark.parametrize("angle", [0.0, 0.4])
def test_calculix_finds_the_torque_with_the_slope_at_rest_of_dahl_s_law(angle, tmp_path):
    made = alone(case("drive.teeth=1", f"operation.output_torque={LOAD} N m")).at(angle)
    found, _ = run_by_calculix(made, tmp_path)
    assert found[-1][1] == pytest.approx(made.balance.worm_torque, rel=2e-2)


def test_the_worm_turned_by_a_pitch_stands_as_it_stood(setup):
    pitch = setup.model.sector.pitch * setup.pair.ratio
    # The two ends of it: further the sector's own teeth would leave the worm.
    before, on = setup.at(-pitch / 2.0), setup.at(pitch / 2.0)
    assert on.balance.worm_torque == pytest.approx(before.balance.worm_torque, rel=1e-6)
    assert on.touching - before.touching == pytest.approx(setup.model.sector.pitch, rel=1e-6)
    # What is written of it faces the wheel at either angle.
    assert on.worm.points[:, 1].mean() == pytest.approx(setup.worm.points[:, 1].mean(), abs=1e-5)
