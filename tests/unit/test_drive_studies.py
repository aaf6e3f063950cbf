"""What vibration is worth: the closed form, the stroke of a valve, gearsets."""

import math

import numpy as np
import pytest
from apparatus.drives import GIVEN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.closed_form import frictionless_ratio, screw_ratio
from asperity.drive.point import MeshPoint
from asperity.drive.solve import answer, prepare
from asperity.drive.studies.gains import gain
from asperity.drive.studies.on_demand import OnDemand
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.runs import Run


def case(*settings, name="drive-screw"):
    given = GIVEN if name.startswith("drive") else ()
    return read_case(name, case_tables(), [*given, *settings])


@pytest.fixture(scope="module")
def point():
    return MeshPoint.of(case().require(Gearset).geometry, 9.81e-3)


def test_a_screw_s_ratio_is_its_closed_form_and_ends_without_friction(point):
    found = screw_ratio(point, 0.1344, [0.5, 1.2, 1.842, 3.684, 20.0, 1e6])
    # The reference is of teeth, whose floor is 0.7025.
    assert found == pytest.approx([1.0, 0.885, 0.807, 0.752, 0.711, 0.7025], abs=2e-3)
    assert found[-1] == pytest.approx(frictionless_ratio(point, 0.1344), abs=1e-5)


ON_DEMAND = (
    "drive.protocol=on-demand", "operation.through_travel_torque=122 N m", "drive.stroke_rest=60 s",
)  # fmt: skip
ACTUATOR = ("actuator.coupling=0.3", "drive.worm_mass=0.3 kg")


def stroked(*settings):
    return answer(prepare(case(*ON_DEMAND, *settings)), Run())


@pytest.fixture(scope="module")
def stroke():
    return stroked(*ACTUATOR)


def test_a_stroke_without_vibration_saves_nothing():
    energy = stroked(*ACTUATOR, "vibration.velocity_ratio=0").headline()
    assert "saves no energy" in str(energy[1])
    assert ", no less" in str(energy[2])


def test_a_stroke_s_times_turns_and_energies_follow_from_its_torques(stroke):
    assert stroke.settled
    assert abs(stroke.torque_balance) < 5e-3
    speed = 2.0 * math.pi * 24.0
    assert stroke.part_time == pytest.approx(np.radians([4.5, 81.0, 4.5]) * 15.0 / speed)
    assert stroke.part_plain[0] == pytest.approx(34.67, abs=0.01)
    assert stroke.part_plain[1] == pytest.approx(stroke.part_plain[0] / 3.0, rel=1e-9)
    assert stroke.part_shaken[0] == pytest.approx(stroke.torque_ratio * stroke.part_plain[0])
    assert stroke.part_shaken[1] == stroke.part_plain[1]
    energy = speed * float(stroke.part_time @ stroke.part_plain)
    assert stroke.energy_plain == pytest.approx(energy)
    assert stroke.share_shaken == pytest.approx(2 * 0.015625 / 120.3125, rel=0.05)


def test_a_smaller_motor_does_but_the_actuator_weighs_more_than_it_saves(stroke):
    assert stroke.motor_shaken_mass < stroke.motor_plain_mass
    assert stroke.saved_mass == pytest.approx(
        stroke.motor_plain_mass - stroke.motor_shaken_mass - stroke.actuator_mass
    )
    assert stroke.saved_mass < 0.0
    # A lead angle of 25 deg locks nothing.
    assert not stroke.held_after
    assert stroke.safety_wear != pytest.approx(stroke.safety_wear_plain, rel=1e-2)
    assert set(stroke.to_json()) >= {"torque_ratio", "torque_balance", "settled"}
    title = stroke.figure("drive_stroke").axes[0].get_title(loc="left")
    assert "in balance to" in title
    assert "does not hold after" in title


def test_rest_neither_wears_nor_spares(stroke):
    without = stroked(*ACTUATOR, "drive.stroke_rest=0 s")
    assert without.share_shaken > 10.0 * stroke.share_shaken
    assert without.safety_wear == pytest.approx(stroke.safety_wear, rel=1e-9)
    assert without.sump_rise == pytest.approx(stroke.sump_rise, rel=1e-9)


def test_a_duty_cycle_changes_what_wears_but_not_the_stroke(stroke):
    parts = ", ".join(
        f'{{duration = "{hours} h", output_torque = "{torque} N m"}}'
        for hours, torque in ((2.0, 366.0), (1.5, 100.0))
    )
    found = stroked(*ACTUATOR, f"operation.duty_cycle=[{parts}]")
    assert found.part_plain == pytest.approx(stroke.part_plain, rel=1e-12)
    assert found.energy_plain == pytest.approx(stroke.energy_plain, rel=1e-12)
    assert found.safety_wear_plain != pytest.approx(stroke.safety_wear_plain, rel=1e-2)
    assert any("by the parts of operation.duty_cycle" in note for note in found.notes)
    assert not any("operation.duty_cycle" in note for note in stroke.notes)


def test_without_an_actuator_the_drive_is_told_and_why_its_stroke_is_not():
    found = stroked()
    assert not isinstance(found, OnDemand)
    assert found.settled
    assert "the stroke is not told: the table [actuator] is missing" in found.notes[-1]


def test_a_stroke_that_is_all_seats_is_refused():
    with pytest.raises(InputError, match=r"drive.stroke_seat is 30 deg and drive.stroke 60 deg"):
        case("drive.stroke=60 deg", "drive.stroke_seat=30 deg")


@pytest.mark.slow
def test_a_stroke_s_files_have_the_last_cycles_and_the_stroke(tmp_path):
    run = Run(folder=tmp_path)
    found = answer(prepare(case(*ON_DEMAND, *ACTUATOR)), run)
    assert found.bands is not None
    names = found.write(tmp_path)
    assert {"drive.png", "drive_stroke.png"} <= set(names)


def test_the_gearset_of_least_efficiency_gains_most_and_loses_its_locking():
    steep, flat = (
        gain(case(name=name).require(Gearset).geometry, friction)
        for name, friction in (("gearset-3b", 0.1346), ("gearset-2", 0.149))
    )
    assert flat.least_ratio < steep.least_ratio
    assert flat.least_ratio < flat.torque_ratio < steep.torque_ratio < 1.0
    assert (steep.locks, flat.locks) == (False, True)
    assert not flat.locks_shaken


def test_a_stroke_s_headline_says_what_vibration_is_worth_and_what_fails(stroke):
    torque, energy, rest = stroke.headline()
    assert torque.startswith(f"{stroke.torque_ratio:.3g} of the torque without vibration (settled")
    assert "energy" in energy
    assert "S_W" in rest
    # Kept going for 25000 h, a valve's gearset wears out.
    worn = answer(prepare(case("operation.life=25000 h", name="drive-actuator")), Run())
    assert worn.safety_wear < 0.01
    assert "of 1.1  FAILS" in worn.headline()[-1]
    units = [row[3] for row in worn.tables()[0].rows if row[0].startswith("safety")]
    assert units == ["of 1.1  FAILS"] * 2
    asked = answer(prepare(case(name="drive-actuator")), Run())
    assert asked.safety_wear > 1.1
    assert not any("FAILS" in line for line in asked.headline())
    assert len(asked.headline()) == 3
    # Nothing is said of the torque between the seats: a valve's is a third.
    assert asked.part_load == pytest.approx([66.0, 22.0, 66.0], rel=1e-12)
    assert asked.part_plain[1] == pytest.approx(asked.part_plain[0] / 3.0, rel=1e-9)


def test_a_shaken_wheel_s_actuator_counts_by_what_it_gives_at_least():
    wheel = "vibration.mode=wheel-axial", "vibration.applied_to=wheel"
    one = answer(prepare(case(*wheel, name="drive-actuator")), Run())
    assert one.settled
    assert one.actuator_electrical is None
    seats = one.part_time[0] + one.part_time[2]
    least = one.ledger.actuator * seats
    assert least > 10.0
    # The amplifier takes a tenth more.
    assert one.energy_actuator == pytest.approx(least / 0.9)
    work = one.part_shaken @ one.part_time * one.problem.worm_speed
    assert one.energy_shaken == pytest.approx(work + least / 0.9)
    assert one.actuator_mass > 0.0
    assert "takes at least" in one.headline()[-1]
    assert any("only the" in note and "from the mains" in note for note in one.notes)
