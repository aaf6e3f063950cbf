"""A gear rig: worm and wheel in place of two discs, and its simulated one."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.point import MeshPoint
from asperity.drive.solve import answer, prepare
from asperity.errors import InputError
from asperity.runs import Run
from asperity.tribometer import discs
from asperity.tribometer.channels import Channels
from asperity.tribometer.instruments.acquisition import inputs_for
from asperity.tribometer.instruments.inputs import lines_of, simulated_of
from asperity.tribometer.instruments.sim import SimulatedRig
from asperity.tribometer.options import Plan
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Limits, Sonotrode
from asperity.tribometer.plan.matrix import planned_files
from asperity.tribometer.procedure.steps import sequence
from asperity.tribometer.twin.plants import plant_of

FEW = ('plan.frequencies=["1000 Hz"]', 'plan.steel_supplies=["4 V"]', "plan.repeats=1")


def case_of(*settings):
    return read_case("rig-gear", case_tables(), settings)


@pytest.mark.parametrize("starts", [1, 2, 4])
def test_worm_and_wheel_that_teeth_tie_slide_along_the_thread_at_the_reference_circle(starts):
    pair = pair_of(case_of(f"gearset.starts={starts}"))
    own, motor = pair.geometry, 37.0
    worm = motor / pair.drives.gear_ratio
    rims = pair.rims(motor, pair.wheel_speed(motor))
    expected = worm * 0.5e-3 * own.worm_pitch_diameter / math.cos(own.lead_angle)
    # A wheel with a profile shift rolls beside its reference circle.
    assert discs.sliding_velocity(*rims) == pytest.approx(expected, rel=2e-3)
    assert worm * pair.sliding_radius == pytest.approx(expected, rel=1e-12)
    assert pair.wheel_speed(motor) * own.gear_ratio == pytest.approx(
        worm * pair.drives.bronze_gear_ratio
    )


def test_the_torque_of_the_worm_is_about_that_of_the_teeth():
    pair = pair_of(case_of())
    own = pair.geometry
    point = MeshPoint.of(own, 0.5e-3 * own.worm_pitch_diameter)
    torque = point.worm_torque(pair.brake_torque, pair.friction)
    assert pair.torque_share * pair.brake_torque == pytest.approx(torque, rel=0.02)
    assert pair.load == pytest.approx(point.normal_force(pair.brake_torque, 0.0), rel=0.02)


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (["rig.brake_torque="], "rig.brake_torque"),
        (["rig.normal_force=100 N"], "rig.brake_torque is of a gearset"),
        (["rig.mode=transverse"], "give 'axial'"),
        (["steel_disc.diameter=60 mm", "steel_disc.material=steel", "steel_disc.thickness=8 mm",
          "steel_disc.young_modulus=210 GPa"], "[steel_disc] stands beside [gearset]"),
    ],
)  # fmt: skip
def test_what_makes_no_gear_rig_is_refused_in_a_line(settings, told):
    with pytest.raises(InputError) as error:
        pair_of(case_of(*settings))
    assert told in str(error.value)
    assert "\n" not in str(error.value)


def test_discs_are_not_shaken_along_an_axis_and_have_no_brake():
    with pytest.raises(InputError, match="along a worm's axis"):
        pair_of(read_case("rig-final", case_tables(), ["rig.mode=axial"]))
    with pytest.raises(InputError, match="keep one of them"):
        pair_of(read_case("rig-final", case_tables(), ["rig.brake_torque=23 N m"]))


def test_nobody_is_asked_to_weigh_or_wipe_gears():
    case = case_of()
    files = planned_files(case.require(Plan), case.require(Limits))
    both = [[*sequence(files, geared=geared)] for geared in (False, True)]
    acts = [{one.act for one in actions} for actions in both]
    assert acts[0] - acts[1] == {"weigh"}
    texts = " ".join(one.text for one in both[1])
    assert "disc" not in texts
    assert "Install worm and wheel; build the rig for axial vibration." in texts
    assert sum(one.act == "cell" for one in both[1]) == 18


@pytest.fixture(scope="module")
def plant():
    return plant_of(case_of(*FEW))


@pytest.mark.slow
def test_the_twin_s_worm_takes_what_the_drive_of_the_same_case_says(plant):
    radius, worm = plant.pair.sliding_radius, float(plant._speeds[3])
    shaken = plant.friction("sine", 1000.0, mode="axial")
    told = plant.sonotrode.velocity("axial", 1000.0)
    case = plant.case.replace_values(
        {
            "operation.worm_speed": worm, "operation.output_torque": 23.0,
            "vibration.frequency": 1000.0, "vibration.velocity_amplitude": told,
        }
    )  # fmt: skip
    found = answer(prepare(case), Run())
    assert radius * shaken(radius * worm) == pytest.approx(
        found.torque_static * found.torque_ratio, rel=1e-6
    )
    assert radius * plant.friction()(radius * worm) == pytest.approx(found.torque_static, rel=1e-9)
    assert found.torque_ratio < 0.9


@pytest.mark.slow
def test_the_twin_comes_to_its_steady_state_with_the_wheel_in_its_teeth(plant):
    case = plant.case
    inputs = simulated_of(inputs_for(case))
    rig = SimulatedRig(plant, inputs, lines_of(case.require(Channels), inputs))
    rig.volts, rig.on = {"steel": 4.0, "bronze": 12.0}, {"amplifier", "steel", "bronze"}
    rig.now = 5.0
    steel, current = rig.motor("steel")
    wheel, coil = rig.motor("bronze")
    expected = plant.steady(4.0, 12.0, plant.friction())
    assert steel == pytest.approx(expected.steel, rel=0.03)  # a run-out of a percent is in it
    assert wheel == pytest.approx(plant.pair.wheel_speed(steel), rel=1e-12)
    assert coil == pytest.approx(12.0 / 20.0, rel=1e-9)
    # What the supply gives is what the motor turns and loses.
    assert pytest.approx(0.3 * current + 0.0515 * steel, rel=0.02) == 4.0
    # Without its supply the brake holds nothing, and the motor runs up.
    rig.on = {"amplifier", "steel"}
    rig.now = 10.0
    assert rig.motor("steel")[0] > 1.2 * steel


def test_a_sonotrode_tells_the_velocity_of_its_own_direction():
    sonotrode = case_of().require(Sonotrode)
    assert sonotrode.velocity("axial", 750.0) == pytest.approx(59e-3)
    assert sonotrode.velocity("transverse", 750.0) is None


def test_a_channel_that_is_read_again_is_the_same_and_of_the_same_class():
    one, other = (case_of()[Channels].torque_steel for _ in range(2))
    assert one == other
    assert type(one) is type(other)
    assert type(one).table == "channels.torque_steel"
    assert type(case_of()[Channels].torque_bronze).table == "channels.torque_bronze"
