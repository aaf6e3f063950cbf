"""What of a vibration comes to a drive's worm and wheel, and how a march begins."""

import numpy as np
import pytest
from apparatus.drives import problem, solved

from asperity.drive.motion.kernels import move
from asperity.drive.protocols.equations_of_motion import begin, corners_of, shakes, system
from asperity.drive.protocols.march import March
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.warmed import warmth
from asperity.errors import InputError
from asperity.runs import Run
from asperity.vibration.waveform import displacement_at


def modelled(*settings):
    given = problem(*settings)
    return given, ReducedModel(given, reduction(given, Run()))


@pytest.mark.parametrize(
    ("mode", "around", "along"),
    # Where the worm touches, and at its reference circle, for an amplitude of one.
    [
        ("axial", lambda point, radius: 0.0, lambda point, radius: 1.0),
        ("torsional", lambda point, radius: point.radius / radius, lambda point, radius: 0.0),
        # The wheel moves one way as the worm would the other.
        ("wheel-axial", lambda point, radius: -1.0, lambda point, radius: 0.0),
        (
            "screw",
            lambda point, radius: point.radius / radius,
            lambda point, radius: -point.lead / radius,
        ),
    ],
)
def test_tangential_leaves_of_a_vibration_its_part_along_the_thread(mode, around, along):
    amplitude = 3e-6
    given, model = modelled(
        "drive.protocol=tangential", f"vibration.mode={mode}", "vibration.applied_to="
        + ("wheel" if mode == "wheel-axial" else "worm"),
        f"vibration.displacement_amplitude={amplitude} m",
    )  # fmt: skip
    point, radius = model.point, given.reference_radius
    thread = np.array([point.radius, -point.lead]) / np.hypot(point.radius, point.lead)
    moved = amplitude * np.array([around(point, radius), along(point, radius)])
    found = shakes(given, model)
    left = np.array([point.radius * found["shake_worm_turn"], found["shake_worm_shift"]])
    assert left == pytest.approx((moved @ thread) * thread, rel=1e-12, abs=1e-18)


def test_flanks_that_slide_steadily_begin_with_the_friction_of_their_speed():
    given, model = modelled(
        "friction.model=lugre", "friction.static_mu=0.18", "friction.stribeck_velocity=2 m/s",
        "friction.contact_damping=20 N s/m", "friction.viscous_damping=20 N s/m",
        "vibration.displacement_amplitude=1e-6 um",
    )  # fmt: skip
    moving = system(given, model)
    march = March(model, moving, *begin(given, model, moving), Run())
    (first,) = march.stretches(1, 1e-6)
    # What asperities, Stribeck's effect and dampings carry together is the steady friction.
    assert model.friction > 1.02 * model.kinetic
    static = model.point.worm_torque(given.load, model.friction)
    assert first["torque"] / 1e-6 == pytest.approx(static, rel=1e-6)


@pytest.mark.parametrize("settings", [
    (), ("vibration.waveform=triangle",),
    ("vibration.waveform=square", "vibration.rise_time=50 us", "vibration.frequency=5 kHz"),
])  # fmt: skip
def test_a_march_knows_the_corners_at_which_its_wave_turns(settings):
    shape = problem(*settings).shape
    wave, steps = shape.wave(), 2000
    at = [displacement_at(wave, 1.0 + n / steps) for n in range(-1, steps + 1)]
    bends = np.abs(np.diff(at, 2))
    turned = np.flatnonzero(bends > 0.5 * bends.max()) / steps if settings else []
    assert corners_of(shape) == pytest.approx(np.array(turned), abs=1e-9)


def test_a_seat_begins_with_the_energy_of_a_spring_under_the_worm_s_thrust():
    settings = "vibration.mode=axial", "vibration.applied_to=seat", "drive.worm_mass=0.3 kg"
    stored = []
    for seat in ((), ("shaft.bearing_axial=50 kN/mm",)):
        given, model = modelled(*settings, *seat)
        states, _ = begin(given, model, system(given, model))
        stored.append(float(states[0]["stored"]))
    thrust = given.load / model.point.arm
    assert stored[1] - stored[0] == pytest.approx(0.5 * thrust**2 / 50e6, rel=1e-6)


@pytest.mark.usefixtures("plain_kernels")
def test_of_every_freedom_the_rate_is_that_of_its_place():
    given, model = modelled(
        "vibration.mode=axial", "vibration.applied_to=seat", "vibration.frequency=2 kHz",
        "vibration.displacement_amplitude=3 um", "drive.worm_mass=0.3 kg",
        "shaft.torsional_stiffness=4394 N m/rad", "shaft.bearing_axial=50 kN/mm",
        "shaft.diameter=17 mm", "shaft.span=150 mm",
    )  # fmt: skip
    moving = system(given, model)
    states, _ = begin(given, model, moving)
    state = states[0]
    state["turn_rate"], state["shift_rate"], state["roll_rate"] = 151.0, 7e-3, 9.9
    state["bent_rate"] = [2e-3, -3e-3, 5e-3]
    short = 1e-8
    places, rates = np.empty((2, 5)), np.empty((2, 5))
    for n in range(2):
        move(moving, state, (n + 1) * short, places[n], rates[n])
    assert rates[1] == pytest.approx([151.0, 9e-3, 9.9, 3e-3, 5e-3], rel=1e-2)
    freely = [0, 1, 2, 3]
    assert np.diff(places, axis=0)[0, freely] / short == pytest.approx(rates[1, freely], rel=1e-3)


@pytest.mark.parametrize("warm", [False, True])
def test_a_shaken_drive_says_whether_it_is_warm(warm):
    temperatures = "tolerances.temperatures={ housing = '60 degC', gears = '80 degC' }"
    quick = "drive.protocol=window", "drive.window=1"
    made = ("drive.warm=true",) if warm else ()
    begins = "warm (drive.warm): tolerances" if warm else "cold: tolerances"
    assert any(note.startswith(begins) for note in solved(*quick, temperatures, *made).notes)


def test_a_gearset_that_could_not_stand_warm_says_so_and_goes_on():
    class Cold:
        warmed = None

        @property
        def warmer(self):
            raise InputError("it would be 2 mm off")

    (said,) = warmth(Cold())
    assert said.startswith("cold: as warm as tolerances.temperatures say it does not stand (it w")
