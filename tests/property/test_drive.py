"""At every instant with one flank in contact the worm's torque over the wheel's has bounds."""

import math

import numpy as np
import pytest
from apparatus.drives import all_solved

MODES = ("axial", "torsional", "wheel-axial", "screw")


def drawn(rng):
    """Return the settings of a drive that is legal, of any kind of motion."""
    frequency = 10 ** rng.uniform(2.9, 4.5)
    mode = rng.choice(MODES)
    amplitude = min(10 ** rng.uniform(-6.5, -3.8), 20.0 / (2 * np.pi * frequency))
    return (
        f"vibration.mode={mode}",
        "vibration.applied_to=" + {"wheel-axial": "wheel"}.get(mode, "worm"),
        f"vibration.frequency={frequency:.6g} Hz",
        f"vibration.displacement_amplitude={amplitude:.6g} m",
        f"friction.mu={rng.uniform(0.02, 0.2):.4g}",
        f"friction.model={rng.choice(['dahl', 'coulomb'])}",
        f"drive.load_inertia={10 ** rng.uniform(-3, -1):.4g} kg m**2",
        f"operation.output_torque={rng.uniform(20, 600):.4g} N m",
        f"operation.worm_speed={rng.uniform(100, 3000):.4g} rpm",
        f"shaft.torsional_stiffness={10 ** rng.uniform(2.5, 4.5):.4g} N m/rad",
        f"drive.flanks={rng.choice(['both', 'driving'])}",
        f"solve.duration={6.0:.4g} ms",
    )


def aslant(point, friction):
    """Coefficient along the sliding that friction is worth at most, in whatever direction.

    Its part across the sliding presses the flanks apart or together.
    """
    across = point.normal_across
    return friction * across / math.sqrt(across**2 - (friction * point.normal_radial) ** 2)


def check(count, seed):
    rng = np.random.default_rng(seed)
    settings = [drawn(rng) for _ in range(count)]
    found = all_solved(settings)
    touched, lowest = 0, []
    for given, one in zip(settings, found, strict=True):
        if one.advantage_min is None:
            continue
        touched += 1
        point = one.problem.point(one.problem.drive.effective_radius)
        most_friction = aslant(point, one.problem.friction.mu)
        least, most = (
            point.worm_torque(one.problem.load, sign * most_friction) / one.torque_static
            for sign in (-1.0, 1.0)
        )
        # The mesh is solved to 1e-12 of its full friction, of which a light touch is a small part.
        assert least - 1e-8 <= one.advantage_min <= one.advantage_max <= most + 1e-8, given
        # Between reversed and static friction, but for what slip across the sliding is worth.
        lowest.append(one.advantage_min / one.floor_reversed)
        assert lowest[-1] >= 0.996, given
        assert one.advantage_max <= 1.002, given
        assert one.closure < 1e-2, given
    assert touched > 0.9 * count
    # The floor is reached, not only kept.
    assert np.min(lowest) < 1.001


def test_the_worm_s_torque_stays_between_reversed_and_static_friction():
    check(24, 7)


def test_how_far_beyond_them_slip_across_the_sliding_takes_it_is_a_closed_form_that_is_reached():
    ways = [
        (f"vibration.mode={mode}", "friction.model=coulomb", "friction.mu=0.2",
         "drive.tangential_compliance=0 m/N", "operation.output_torque=300 N m",
         "vibration.frequency=3 kHz", "vibration.velocity_ratio=1.2", "solve.duration=4 ms")
        for mode in ("axial", "wheel-axial")
    ]  # fmt: skip
    found = all_solved(ways)
    point = found[0].problem.point(found[0].problem.drive.effective_radius)
    # Of the flank's normal 0.376 is radial and 0.9266 across the sliding.
    assert aslant(point, 0.2) / 0.2 == pytest.approx(
        1.0 / math.sqrt(1.0 - (0.2 * 0.376 / 0.9266) ** 2), rel=1e-5
    )
    floor, most = (
        point.worm_torque(1.0, sign * aslant(point, 0.2)) / point.worm_torque(1.0, sign * 0.2)
        for sign in (-1.0, 1.0)
    )
    assert (floor, most) == pytest.approx((0.9965, 1.0014), abs=5e-5)
    assert min(one.advantage_min / one.floor_reversed for one in found) == pytest.approx(floor)
    assert max(one.advantage_max for one in found) == pytest.approx(most)


@pytest.mark.slow
def test_the_same_over_five_hundred_drives():
    check(500, 11)
