"""A gear rig as a user runs it: planned, run on its twin, reduced, fitted."""

import csv
import json
import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.tribometer.twin.plants import plant_of

pytestmark = pytest.mark.slow

FEW = ('plan.frequencies=["1000 Hz"]', 'plan.steel_supplies=["4 V"]', "plan.repeats=1")


@pytest.fixture(scope="module")
def plant():
    return plant_of(read_case("rig-gear", case_tables(), FEW))


@pytest.fixture(scope="module")
def recorded(asperity, tmp_path_factory):
    folder = tmp_path_factory.mktemp("gear-rig")
    sets = [word for one in (*FEW, "plan.sample_rate=4 kHz") for word in ("--set", one)]
    code, _, errors = asperity("rig", "run", "rig-gear", "--out", folder, *sets)
    assert code == 0, errors
    return folder / "file-01.nc"


def test_a_run_is_reduced_to_a_ratio_that_the_drive_says_too(asperity, recorded, tmp_path, plant):
    code, output, _ = asperity("rig", "reduce", recorded, "--json", "--out", tmp_path)
    (segment,) = json.loads(output)["segments"]
    assert (code, segment["quality"], segment["mode"]) == (0, "good", "axial")
    state = plant.steady(4.0, 12.0, plant.friction("sine", 1000.0, mode="axial"))
    still = plant.steady(4.0, 12.0, plant.friction())
    change = 100.0 * (state.torque / still.torque - 1.0)
    low, high = segment["torque_change_ci95_percent"]
    assert low < change < high
    assert segment["torque_before_Nm"] == pytest.approx(still.torque, rel=0.01)
    with (tmp_path / "measurements.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert float(row["vibration.velocity_amplitude [mm/s]"]) == pytest.approx(40.0, rel=5e-3)
    assert float(row["operation.output_torque [N m]"]) == pytest.approx(23.0, rel=2e-3)
    worm = state.steel / 30.0 * 30.0 / math.pi
    assert float(row["operation.worm_speed [rpm]"]) == pytest.approx(worm, rel=0.02)


def test_a_wheel_that_does_not_turn_as_its_teeth_have_it_is_told(asperity, recorded):
    scale = (
        'channels.speed_bronze={ channel = "D", points = [["0 V", "0 rpm"], ["5 V", "650 rpm"]] }'
    )
    _, output, _ = asperity("rig", "reduce", recorded, "--json", "--set", scale)
    told = json.loads(output)
    assert "speeds are not as the teeth" in [one["name"] for one in told["findings"]]
    assert told["segments"][0]["quality"] == "doubtful"


def test_a_report_of_a_gear_rig_tells_of_gears_and_keeps_to_no_standard_of_discs(
    asperity, recorded, tmp_path
):
    code, output, errors = asperity("rig", "report", recorded.parent, "--out", tmp_path)
    assert code == 0, errors
    assert "torque of the brake" in output
    assert "normal force, without friction" in output
    assert "bronze disc" not in output
    page = (tmp_path / "report.html").read_text()
    assert "what the brake holds the wheel with" in page
    code, _, errors = asperity("rig", "report", recorded.parent, "--standard", "G99")
    assert code == 2
    assert "--standard G99 asks for friction and wear of discs" in errors


def test_what_was_measured_fits_the_friction_that_the_twin_was_given(asperity, recorded, tmp_path):
    asperity("rig", "reduce", recorded, "--out", tmp_path)
    code, output, errors = asperity(
        "fit", tmp_path / "measurements.csv", "rig-gear", "--free", "friction.mu", "--model",
        "drive", "--json",
    )  # fmt: skip
    assert code == 0, errors
    (parameter,) = json.loads(output)["parameters"]
    low, high = parameter["ci95"]
    assert low < 0.1344 < high
