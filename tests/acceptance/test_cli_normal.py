"""`asperity slide` with [normal]: what it tells, what it writes, what it refuses."""

import json

import pytest

from asperity.files.store import read_dataset

KEYS = {
    "ratio_mean_load", "normal_mean_N", "normal_min_N", "normal_max_N", "open_share",
    "landings_per_cycle", "penetration_mean_m", "critical_velocity_m_s", "contact_frequency_Hz",
    "period", "multiplier", "power_normal_W", "power_contact_damping_W", "friction_gain_W",
    "wear_integral_W",
}  # fmt: skip
WEAR = [
    "--set", "wear.coefficient=1e-5", "--set", "wear.hardness=2 GPa",
    "--set", "wear.contact_radius=0.1 mm", "--set", "wear.conductivity=46 W/m/K",
    "--set", "wear.diffusivity=1.25e-5 m**2/s",
]  # fmt: skip
TOLD_OF_WEAR = {"wear_depth_per_cycle_m", "flash_temperature_K", "peclet"}


@pytest.mark.slow
@pytest.mark.parametrize("case", ["normal-pin", "normal-machine", "oblique"])
def test_a_pressed_body_tells_its_load_beside_its_ratio(asperity, case, tmp_path):
    code, output, _ = asperity("slide", case, "--json", "--out", tmp_path)
    answer = json.loads(output)
    assert code == 0
    assert answer.keys() >= KEYS
    assert not answer.keys() & TOLD_OF_WEAR
    written = read_dataset(tmp_path / "slide.nc")
    assert {"normal_force", "penetration", "height"} <= set(written.variables)
    assert written["normal_force"].attrs["units"] == "N"
    assert float(written["normal_force"].mean()) == pytest.approx(answer["normal_mean_N"], rel=1e-3)


def test_with_wear_it_tells_depth_and_temperature(asperity):
    code, output, _ = asperity("slide", "normal-pin", *WEAR, "--json")
    answer = json.loads(output)
    assert code == 0
    assert all(answer[key] > 0.0 for key in TOLD_OF_WEAR)


def test_without_it_nothing_new_is_told(asperity):
    _, output, _ = asperity("slide", "table-4.3", "--set", "solve.method=periodic", "--json")
    assert not json.loads(output).keys() & (KEYS | TOLD_OF_WEAR | {"thrust_N"})


def test_a_vibration_that_drives_the_body_tells_its_thrust(asperity):
    """Mirrored it holds the body back, which is no thrust."""
    _, output, _ = asperity("slide", "oblique", "--json")
    answer = json.loads(output)
    assert answer["thrust_N"] == -answer["drive_force_N"] == pytest.approx(1.1014, abs=1e-4)
    _, output, _ = asperity("slide", "oblique")
    assert "thrust: the vibration drives the body" in output
    _, output, _ = asperity("slide", "oblique", "--set", "vibration.elevation=150 deg", "--json")
    answer = json.loads(output)
    assert answer["drive_force_N"] > 0.0
    assert "thrust_N" not in answer


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    "axis",
    [
        "normal.law=linear,hertz,rough", "normal.control=force,displacement",
        "normal.damping_ratio=0.01,0.1", "normal.damping=0,20 s/m",
        "normal.penetration=0.7,0.9 um", "normal.stiffness=80,100 MN/m",
        "friction.keeps=stiffness,deflection", "friction.load_exponent=0.7,1",
        "vibration.normal_phase=0,90", "vibration.ramp=0,1 ms", "wear.coefficient=1e-6,1e-5",
        "wear.hardness=1,2 GPa", "wear.contact_radius=0.1,0.2 mm", "wear.conductivity=40,46 W/m/K",
        "wear.diffusivity=10,12.5 mm**2/s",
    ],
)  # fmt: skip
def test_every_key_of_vibration_out_of_the_plane_can_be_an_axis(asperity, axis):
    tilted = "--set", "vibration.elevation=45 deg"
    code, output, _ = asperity("sweep", "normal-pin", *WEAR, *tilted, "--over", axis, "--json")
    answer = json.loads(output)
    assert (code, answer["failed"]) == (0, 0)
    assert len(answer["ratio"]) == axis.count(",") + 1


def test_the_number_of_springs_can_be_an_axis(asperity):
    springs = "--set", "friction.model=springs"
    code, output, errors = asperity(
        "sweep", "normal-pin", *springs, "--over", "friction.springs=8,16", "--json"
    )
    assert code == 0, errors
    eight, sixteen = json.loads(output)["ratio"]
    assert eight == pytest.approx(sixteen, rel=0.01)
    assert eight != sixteen


@pytest.mark.slow
def test_a_sweep_over_the_elevation_keeps_the_loads(asperity, tmp_path):
    code, _, errors = asperity(
        "sweep", "normal-pin", "--over", "vibration.elevation=0 deg,30 deg,90 deg",
        "--out", tmp_path, "--json",
    )  # fmt: skip
    assert code == 0, errors
    written = read_dataset(tmp_path / "sweep.nc")
    assert written["ratio"].values == pytest.approx([0.13701, 0.1003, 0.828], abs=1e-4)
    assert {"open_share", "normal_mean", "period", "power_normal"} <= set(written.variables)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["table-4.3", "--set", "vibration.elevation=30 deg"], "[normal]"),
        (["normal-pin", "--set", "friction.law=split"], "friction.law"),
        (["normal-pin", "--set", "solve.scheme=two-phase", "--set", "solve.method=march",
          "--set", "friction.law=split"], "two-phase"),
        (["normal-machine", "--set", "normal.control=force"], "slider.mass"),
        (["normal-machine", "--set", "normal.damping_ratio=0.05"], "slider.mass"),
        (["normal-machine", "--set", "friction.exponent=0.5"], "friction.exponent"),
        (["normal-machine", "--set", "vibration.displacement_amplitude=1 mm"], "rigid machine"),
        (["normal-pin", "--set", "vibration.elevation=200 deg"], "vibration.elevation"),
        (["table-4.3", "--set", "friction.model=springs", "--set", "friction.law=vector"],
         "[normal]"),
        (["table-4.3", "--set", "normal.law=constant", "--set", "normal.control=force",
          "--set", "normal.damping=1 s/m"], "leave out normal.control, normal.damping"),
        (["table-4.3", "--set", "wear.coefficient=1e-5", "--set", "wear.hardness=2 GPa"],
         "[normal]"),
    ],
)  # fmt: skip
def test_what_does_not_go_together_is_refused_in_one_line(asperity, arguments, told):
    code, output, errors = asperity("slide", *arguments, "--json")
    assert code == 2
    assert output == ""
    assert len(errors.strip().splitlines()) == 1
    assert told in errors


def test_an_oblique_block_is_refused(asperity):
    code, _, errors = asperity("block", "block-longitudinal", "--set", "vibration.elevation=30 deg")
    assert code == 2
    assert "in the plane of contact only" in errors
