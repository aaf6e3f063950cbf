"""The tables of a worm gearset's drive, and what is refused of its vibration."""

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.parameters import Drive, Shaft
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.reduction import teeth_key
from asperity.errors import InputError
from asperity.slider.slide import prepare
from asperity.vibration import Vibration

TEXT = {"text_only": True}


def drive(**keys):
    return Drive.model_validate(keys, context=TEXT)


def vibration(**keys):
    return Vibration.model_validate(
        {"frequency": "2 kHz", "velocity_ratio": 1.5, **keys}, context=TEXT
    )


def test_a_measured_deflection_is_a_list_of_torques_and_angles():
    pairs = drive(deflection=[["23 N m", "47.6 urad"], ["366 N m", "365 urad"]]).deflection
    assert pairs == ((23.0, pytest.approx(47.6e-6)), (366.0, pytest.approx(365e-6)))


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"deflection": 3}, "list of at least two pairs"),
        ({"deflection": [["23 N m", "47.6 urad"]]}, "list of at least two pairs"),
        ({"deflection": [["23 N m", "4 urad"], ["3 N m", "5 urad"]]}, "does not rise"),
        ({"deflection": [["23 N m", "4 mm"], ["30 N m", "5 urad"]]}, "number 1 of the list"),
        ({"deflection": [["2 N m", "4 urad"], ["3 N m", "5 urad"]], "model": "teeth"}, "leave it"),
        ({"teeth": 4}, "must be odd"),
        ({"load_inertia": "3.2e-3"}, "moment of inertia"),
    ],
)
def test_a_table_that_cannot_be_is_refused_in_one_line(keys, words):
    with pytest.raises(InputError, match=words) as refused:
        drive(**keys)
    assert "\n" not in str(refused.value)


def test_a_shaft_of_a_given_size_has_the_thesis_s_stiffness_and_a_cylinder_s_inertia():
    shaft = Shaft(diameter=17e-3, span=150e-3, units="SI")
    assert shaft.torsion == pytest.approx(4394.17, abs=0.01)
    assert shaft.inertia(18.09e-3, 0.05) == pytest.approx(1.057e-5, rel=1e-3)
    assert Shaft(torsional_stiffness=4000.0, diameter=1.0, span=1.0, units="SI").torsion == 4000.0
    assert Shaft().torsion is None
    assert Shaft().inertia(18e-3, 0.05) is None


def test_a_cam_on_the_worm_counts_by_its_turns():
    cam = vibration(frequency="12 per turn", mode="axial")
    assert cam.per_turn == 12.0
    assert cam.shape(turns=24.0).frequency == 288.0
    with pytest.raises(InputError, match="no worm here"):
        cam.shape()
    with pytest.raises(InputError, match="keep one"):
        vibration(frequency="12 per turn", per_turn=12)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({}, "vibration.mode is missing"),
        ({"mode": "axial", "direction": "30 deg"}, "vibration.direction is of a sliding body"),
        ({"mode": "axial", "elevation": "30 deg"}, "vibration.elevation is of a sliding body"),
        ({"mode": "axial", "applied_to": "body"}, "of a sliding body; of a gearset it must be"),
    ],
)
def test_a_sliding_body_s_vibration_is_refused_of_a_gearset(keys, words):
    with pytest.raises(InputError, match=words):
        vibration(**keys).of_gearset()


def test_a_gearset_is_shaken_at_its_worm_unless_said():
    assert vibration(mode="screw").of_gearset().applied_to == "worm"
    assert vibration(mode="screw", applied_to="seat").of_gearset().applied_to == "seat"


@pytest.mark.parametrize(
    "setting",
    ["vibration.mode=axial", "vibration.applied_to=worm", 'vibration.frequency="12 per turn"'],
)
def test_a_gearset_s_vibration_is_refused_of_a_sliding_body(setting):
    case = read_case("table-4.3", case_tables(), [setting])
    with pytest.raises(InputError, match="gearset"):
        prepare(case)


def test_a_copy_keeps_the_quantities_of_a_list():
    given = drive(deflection=[["23 N m", "47.6 urad"], ["366 N m", "365 urad"]])
    copied = given.model_copy(update={"protocol": "window"})
    assert copied.deflection == given.deflection
    assert copied.protocol == "window"


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("table-4.3", "this case is of a sliding body: asperity slide takes it"),
        ("gearset-2", r"add it with model, 'coulomb' or 'dahl', and mu, or set .*'iso14521'"),
    ],
)
def test_what_a_case_lacks_of_a_drive_is_told(name, words):
    with pytest.raises(InputError, match=words):
        DriveProblem.from_case(read_case(name, case_tables()))


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("operation.worm_speed=1e24 rpm", "1e6 rpm at most"),
        ("operation.output_torque=2.5e28 N m", r"at most 1e\+09 N m"),
    ],
)
def test_no_worm_is_marched_faster_or_loaded_more_than_any_gear_holds(setting, words):
    read = read_case("drive-screw", case_tables(), [setting])
    with pytest.raises(InputError, match=words):
        DriveProblem.from_case(read)


def test_by_the_standard_friction_is_its_own_whatever_the_table_says_or_lacks():
    def friction(name, *settings):
        read = read_case(name, case_tables(), ["drive.friction=iso14521", *settings])
        return DriveProblem.from_case(read, shaken=False).friction

    bare, given = friction("gearset-3b"), friction("drive-screw", "friction.mu=0.9")
    assert bare.model == "coulomb"
    assert bare.mu == given.mu == pytest.approx(0.1346, abs=5e-4)
    assert given.max_deflection == 70e-9


def test_teeth_rated_otherwise_are_kept_apart_where_friction_is_the_standard_s():
    def kept(*settings):
        return teeth_key(
            DriveProblem.from_case(read_case("gearset-3b", case_tables(), settings), shaken=False)
        )

    own = ("drive.friction=iso14521", "friction.model=coulomb", "friction.mu=0.1")
    assert kept(*own) != kept(*own, "rating.friction_factor=0.5")
    assert kept(*own[1:]) == kept(*own[1:], "rating.friction_factor=0.5")
