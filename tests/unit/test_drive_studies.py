"""What vibration is worth: map, stroke of a valve, gearsets."""

import math

import numpy as np
import pytest
from apparatus.drives import GIVEN

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.point import MeshPoint
from asperity.drive.studies.closed_form import frictionless_ratio, screw_ratio
from asperity.drive.studies.gains import gains
from asperity.drive.studies.map import drive_map
from asperity.drive.studies.on_demand import Stroke, on_demand
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.results import read


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


@pytest.fixture(scope="module")
def mapped():
    return drive_map(case(), (2000.0, 20000.0), (0.5, 1.5))


def test_a_map_has_both_readings_beside_each_ratio_and_resonances(mapped, tmp_path):
    assert mapped.torque_ratio.shape == mapped.settled.shape == (2, 2)
    assert mapped.settled.all()
    assert np.abs(mapped.torque_balance).max() < 5e-3
    # Hardly anything below the sliding; far above resonance the closed form but for elastic slip.
    assert mapped.torque_ratio[:, 0] == pytest.approx([1.0, 1.0], abs=2e-3)
    assert mapped.torque_ratio[1, 1] == pytest.approx(mapped.closed_form[1], abs=0.03)
    assert mapped.energy_ratio[0, 1] < 0.95
    assert mapped.resonance_worm == pytest.approx(2926.0, rel=1e-3)
    path = mapped.save(tmp_path / "map.nc")
    assert read(path).figure() is not None


def test_a_map_of_nothing_is_refused():
    with pytest.raises(InputError, match=r"frequencies are \[\]; give positive numbers that rise"):
        drive_map(case(), ())
    with pytest.raises(InputError, match=r"ratios are \[2.0, 1.0\]"):
        drive_map(case(), (2000.0,), (2.0, 1.0))


def test_points_beyond_the_mesh_leave_a_gap_and_a_note():
    found = drive_map(case("vibration.mode=axial"), (20.0, 20000.0), (1.2,))
    assert np.isnan(found.torque_ratio[0, 0])
    assert np.isfinite(found.torque_ratio[1, 0])
    assert "lifts the worm out of mesh" in found.notes[0]


ACTUATOR = ("actuator.coupling=0.3", "drive.worm_mass=0.3 kg")


@pytest.fixture(scope="module")
def stroke():
    given = case(*ACTUATOR, "operation.through_travel_torque=122 N m")
    return on_demand(given, Stroke(rest=60.0))


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
    assert not stroke.holds_after
    assert stroke.safety_wear != pytest.approx(stroke.safety_wear_plain, rel=1e-2)
    assert stroke.figure() is not None
    assert set(stroke.to_json()) >= {"torque_ratio", "torque_balance", "settled"}


def test_rest_neither_wears_nor_spares(stroke):
    without = on_demand(
        case(*ACTUATOR, "operation.through_travel_torque=122 N m"), Stroke(rest=0.0)
    )
    assert without.share_shaken > 10.0 * stroke.share_shaken
    assert without.safety_wear == pytest.approx(stroke.safety_wear, rel=1e-9)
    assert without.sump_rise == pytest.approx(stroke.sump_rise, rel=1e-9)


def test_without_an_actuator_or_with_an_impossible_stroke_it_is_refused():
    with pytest.raises(InputError, match=r"the table \[actuator\] is missing"):
        on_demand(case())
    with pytest.raises(InputError, match="both seats must leave some of the turn"):
        Stroke(turn=1.0, seat=0.5)


def test_the_gearset_of_least_efficiency_gains_most_and_loses_its_locking():
    names = ("gearset-3b", "gearset-2")
    gears = [case(name=name).require(Gearset) for name in names]
    found = gains(gears, case(name="gearset-2").require(Operation))
    assert found.names == ("gearset 2", "gearset 3, 2.9 in")
    assert np.all(np.diff(found.efficiency) > 0.0)
    assert np.all(np.diff(found.shaken_ratio) > 0.0)
    assert np.all(found.shaken_ratio > found.efficiency)
    assert found.locks.tolist() == [1.0, 0.0]
    assert found.locks_shaken.tolist() == [0.0, 0.0]
    assert list(found.to_dataset()["gearset"].values) == list(found.names)
    assert found.figure() is not None


def test_gains_of_nothing_or_below_the_sliding_are_refused():
    operation = case(name="gearset-2").require(Operation)
    with pytest.raises(InputError, match="no gearset is given"):
        gains([], operation)
    gear = case(name="gearset-2").require(Gearset)
    with pytest.raises(InputError, match=r"velocity_ratio is 0.9; the closed form holds from 1.05"):
        gains([gear], operation, velocity_ratio=0.9)
