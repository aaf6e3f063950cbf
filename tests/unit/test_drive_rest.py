"""What a drive's ratios refer to: the same drive without vibration, as a march has it."""

import re

import numpy as np
import pytest
from apparatus.drives import problem, solved
from apparatus.grid import grid, slow

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive import directions
from asperity.drive.solve import answer, prepare
from asperity.errors import InputError
from asperity.runs import Run

LAWS = {
    "coulomb": ("friction.model=coulomb",),
    "dahl": (),
    "brittle": ("friction.exponent=0",),
    "lugre": ("friction.model=lugre", "friction.viscous_damping=20 N s/m"),
    "falling": (
        "friction.model=lugre", "friction.static_mu=0.2", "friction.stribeck_velocity=0.5 m/s",
    ),
}  # fmt: skip
WAYS = {
    "axial": (),
    "torsional": (),
    "wheel-axial": (),
    "screw": (),
    "seat": ("vibration.mode=axial", "vibration.applied_to=seat"),
}
SHAFTS = {
    "rigid": (),
    "bends": ("shaft.diameter=17 mm", "shaft.span=150 mm"),
    "seated": ("shaft.bearing_axial=200 kN/mm", "drive.worm_mass=0.3 kg"),
}
NOTHING = "vibration.velocity_ratio=1e-6"


def nothing(law, way, shaft, *more):
    mode = WAYS[way] or (f"vibration.mode={way}",)
    return solved(*LAWS[law], *mode, *SHAFTS[shaft], NOTHING, *more)


@pytest.mark.parametrize(("law", "way", "shaft"), grid(list(LAWS), list(WAYS), list(SHAFTS)))
def test_a_vibration_of_nothing_changes_nothing(law, way, shaft):
    one = nothing(law, way, shaft)
    assert one.settled
    assert one.torque_ratio == pytest.approx(1.0, abs=1e-6)
    assert one.energy_ratio == pytest.approx(1.0, abs=1e-6)
    assert one.saved_per_actuator is None


@pytest.mark.slow
def test_no_way_of_shaking_is_best_by_what_an_actuator_of_nothing_saves():
    one = directions.answer(problem(NOTHING), Run())
    assert one.settled.any()
    assert [row["saved_per_actuator_W_W"] for row in one.rows] == [None] * len(one.rows)
    assert one.rankings["per_watt"] == []


# Slowly, static friction shakes the drive by itself.
SLOW = "operation.worm_speed=360 rpm", "vibration.frequency=1 kHz"


@pytest.mark.parametrize(
    ("way", "step"), [slow("screw", 0.5), slow("screw", None), slow("axial", None)]
)
def test_a_drive_that_shakes_by_itself_is_what_its_ratios_refer_to(way, step):
    given = () if step is None else (f"solve.step={step} us",)
    one = nothing("falling", way, "rigid", *SLOW, *given)
    assert one.settled
    assert one.torque_ratio == pytest.approx(1.0, abs=5e-4)
    assert one.energy_ratio == pytest.approx(1.0, abs=5e-4)
    # Sliding steadily it would take 37.47 N m.
    assert one.torque_static == pytest.approx(34.88 if step is None else 35.8, abs=0.1)
    assert any("shakes by itself" in note for note in one.notes)
    # A step that was given is kept, and what it makes wrong told.
    assert (one.step_error > 1e-3) == (step is not None)
    assert any("give none, or a smaller solve.step" in note for note in one.notes) == (
        step is not None
    )


@pytest.mark.slow
def test_at_full_speed_too_a_drive_that_shakes_by_itself_is_what_its_ratios_refer_to():
    fast = "operation.worm_speed=1440 rpm", "friction.stribeck_velocity=1 m/s"
    one = nothing("falling", "screw", "rigid", *fast)
    assert one.settled
    assert one.torque_ratio == pytest.approx(1.0, abs=5e-4)
    assert one.energy_ratio == pytest.approx(1.0, abs=5e-4)
    assert one.torque_static == pytest.approx(34.86, abs=0.05)
    (note,) = [note for note in one.notes if "shakes by itself" in note]
    assert "sliding would take 35.06 N m" in note


@pytest.mark.slow
def test_a_drive_that_shakes_by_itself_for_a_short_while_and_in_a_step_that_is_given():
    short = "vibration.frequency=4 kHz", "solve.step=0.5 us", "solve.duration=20 ms"
    one = nothing("falling", "screw", "rigid", *SLOW, *short)
    assert one.settled
    assert one.torque_ratio == pytest.approx(1.0, abs=5e-4)
    assert one.energy_ratio == pytest.approx(1.0, abs=5e-4)
    (note,) = [note for note in one.notes if "shakes by itself" in note]
    steady = float(re.search(r"sliding would take (\S+) N m", note)[1])
    # The middle of what it swings over is less than it slides by.
    assert 0.9 * steady < one.torque_static < 0.97 * steady
    assert one.torque == pytest.approx(one.torque_static, rel=5e-4)


def test_a_held_wheel_refers_to_what_it_takes_once_the_worm_stands():
    held = "drive.protocol=held-wheel"
    assert nothing("brittle", "screw", "rigid", held).torque_ratio == pytest.approx(1.0, abs=1e-3)
    # Viscous friction of a worm that slid is none of one that stands.
    one = nothing("lugre", "screw", "bends", held)
    assert one.torque_ratio == pytest.approx(1.0, abs=1e-3)
    assert any("of the worm that stands" in note for note in one.notes)


def random_settings(rng):
    given = [
        f"vibration.mode={rng.choice(['axial', 'torsional', 'wheel-axial', 'screw'])}",
        f"vibration.frequency={10 ** rng.uniform(2.5, 4.3):.4g} Hz",
        "vibration.velocity_ratio=1e-5",
        f"friction.mu={rng.uniform(0.02, 0.3):.4g}",
        f"friction.model={rng.choice(['dahl', 'coulomb'])}",
        f"drive.load_inertia={10 ** rng.uniform(-3.5, -0.5):.4g} kg m**2",
        f"drive.contact_damping={rng.choice(['0', '0.01', '0.1'])} s/m",
        f"drive.worm_mass={10 ** rng.uniform(-1, 0.5):.3g} kg",
        f"operation.output_torque={rng.uniform(20, 600):.4g} N m",
        f"operation.worm_speed={rng.uniform(50, 3000):.4g} rpm",
        f"shaft.torsional_stiffness={10 ** rng.uniform(2, 4.5):.4g} N m/rad",
        f"shaft.damping_ratio={rng.choice([0, 0.03])}",
    ]
    if rng.random() < 0.5:
        given.append(f"shaft.bearing_axial={10 ** rng.uniform(0.5, 3):.3g} kN/mm")
    if rng.random() < 0.5:
        given += [f"shaft.diameter={rng.uniform(10, 22):.3g} mm",
                  f"shaft.span={rng.uniform(80, 250):.4g} mm"]  # fmt: skip
    return given


@pytest.mark.parametrize(
    "count", [5, pytest.param(200, marks=[pytest.mark.slow, pytest.mark.campaign])]
)
def test_under_constant_friction_drives_slide_steadily_whatever_holds_their_worm(count):
    rng = np.random.default_rng(9)
    for _ in range(count):
        given = random_settings(rng)
        one = solved(*given)
        assert one.settled, given
        assert one.torque_ratio == pytest.approx(1.0, abs=1e-5), given


@pytest.mark.slow
def test_elastic_teeth_of_a_part_of_a_pitch_refer_to_the_same_part():
    # The torque swings by a few thousandths over a pitch.
    given = ("drive.model=teeth", "drive.protocol=window", "vibration.displacement_amplitude=1 nm")
    one = answer(prepare(read_case("drive-screw", case_tables(), given)), Run())
    assert one.torque_ratio == pytest.approx(1.0, abs=1e-6)


def test_the_speeds_and_ways_of_a_turning_vibration_are_those_of_its_threads():
    turned = problem("vibration.mode=torsional", "vibration.frequency=20 kHz")
    geometry = turned.geometry
    lead = 0.5 * 2.15380e-3 * 4
    circle = 0.5 * 2.15380e-3 * 8.4
    normal = np.cos(np.arctan2(4.0, 8.4)) * np.cos(np.radians(20.0))
    # A worm that turns at w moves its threads at p w along the axis, their normals' share of it.
    assert turned.approach_speed == pytest.approx(turned.velocity / circle * lead * normal)
    for mode, share in (("axial", 1.0), ("wheel-axial", lead / 9.81e-3), ("screw", 0.0)):
        other = problem(f"vibration.mode={mode}", "vibration.frequency=20 kHz")
        assert other.approach_speed == pytest.approx(other.velocity * normal * share)
    # A quarter of the pitch is reached by p/r of the arc.
    most = 0.25 * np.pi * 2.15380e-3 * circle / lead
    assert geometry.axial_pitch == pytest.approx(np.pi * 2.15380)
    for mode in ("torsional", "screw"):
        way = f"vibration.mode={mode}", "vibration.frequency=10 Hz"
        problem(*way, f"vibration.displacement_amplitude={0.999 * most!r} m")
        with pytest.raises(InputError, match="lifts the worm out of mesh"):
            problem(*way, f"vibration.displacement_amplitude={1.001 * most!r} m")
