"""Closed forms of vibration out of the plane, against their numbers and a march of springs.

Sources: M. Popov (2020) for the model; Popov, Popov and Popov (2017) for the polynomial; Milahin
and Starcevic (2014), and Hess and Soom (1991), by what their abstracts say. The reference numbers
are of an independent prototype of the sliding body with a normal freedom. The march below is
another: it knows springs and a load, and none of the formulas.
"""

import itertools
import math

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.friction.dahl import VECTOR
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.slider import TABLES, Model, solve_many
from asperity.slider import closed_forms as cf

STEPS = 2000  # a cycle


def springs(profile, count=1200):
    """Height and stiffness of springs whose load over an approach is the profile's."""
    if profile == "flat":
        return np.zeros(1), np.ones(1)
    if profile == "rough":
        height = np.linspace(-25.0, 3.0, count)
        return height, np.exp(height) * (height[1] - height[0])
    root = np.linspace(0.0, 1.8, count + 1)
    return (0.5 * (root[1:] + root[:-1])) ** 2, np.full(count, 1.5 * root[1])


def dragged(profile, approach, drag, last, count=1200):
    """Mean force of springs over their last steps, over mu times the load at rest.

    Law and load alone: a spring keeps its stiffness, 1/mu of the normal one, so that its deflection
    is at most what it is pressed.
    """
    height, stiffness = springs(profile, count)
    deflection = np.full_like(height, np.inf)
    force = np.zeros(len(drag))
    for step, (pressed, way) in enumerate(zip(approach, drag, strict=True)):
        limit = np.maximum(pressed - height, 0.0)
        deflection = np.clip(deflection + way, -limit, limit)
        force[step] = stiffness @ deflection
    return force[-last:].mean()


def marched(velocity, swing, profile):
    """Mean friction of the second cycle of springs dragged at V v*, the first begins slipping."""
    turn = 2.0 * np.pi / STEPS
    approach = (0.0 if profile == "rough" else 1.0) + swing * np.cos(turn * np.arange(2 * STEPS))
    return dragged(profile, approach, np.full(2 * STEPS, swing * velocity * turn), STEPS)


def test_the_master_curve_has_its_reference_values():
    velocity = [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9]
    expected = [0.86841, 0.75717, 0.57096, 0.42064, 0.20145, 0.06883, 0.00731]
    assert cf.master_curve(velocity) == pytest.approx(expected, abs=5e-6)


def test_the_master_curve_falls_from_all_to_nothing():
    velocity = np.linspace(0.0, 1.0, 400)
    reduction = cf.master_curve(velocity)
    assert reduction[0] == pytest.approx(1.0, abs=1e-12)
    assert np.all(np.diff(reduction) < 0.0)
    assert cf.master_curve([1.0, 1.5, 1e9]).tolist() == [0.0, 0.0, 0.0]


def test_near_the_critical_velocity_the_master_curve_ends_as_a_parabola():
    rest = 1e-4
    expected = 81.0 * (2.0 * rest) ** 2 / (144.0 * math.pi)
    assert cf.master_curve(1.0 - rest) == pytest.approx(expected, rel=1e-3)


@pytest.mark.ordinary(5)
@pytest.mark.parametrize("swing", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("velocity", [0.05, 0.3, 0.7, 0.95, 1.0, 1.3])
def test_a_flat_contact_is_on_the_master_curve_at_any_swing(velocity, swing):
    # The march's own error is half a step of the load.
    expected = 1.0 - swing * cf.master_curve(velocity)
    assert cf.normal_ratio(velocity, swing, "flat") == pytest.approx(expected, abs=1e-14)
    assert marched(velocity, swing, "flat") == pytest.approx(expected, abs=5e-6)


def test_the_polynomial_stays_within_0_0145_of_the_master_curve():
    velocity = np.linspace(0.0, 1.5, 3001)
    apart = np.abs(cf.master_curve_approximated(velocity) - cf.master_curve(velocity)).max()
    assert 0.0135 < apart < 0.0145


@pytest.mark.parametrize(
    ("profile", "swing", "velocity", "expected", "tolerance"),
    [
        # Sixteen springs of the prototype are right to 7e-4, and its steps to as much where contact
        # is lost.
        ("hertz", 0.5, (0.05, 0.2, 0.5), (0.44234, 0.64643, 0.90385), 1e-4),
        ("hertz", 1.5, (0.05, 0.2, 0.5), (0.1676, 0.5814, 1.1342), 8e-4),
        ("flat", 1.5, (0.1, 0.3, 1.0), (0.22595, 0.56967, 1.08816), 4e-4),
        ("flat", 2.0, (0.1, 0.3, 1.0), (0.25204, 0.63778, 1.21800), 4e-4),
        ("rough", 0.5, (0.2, 0.5), (0.7996, 0.9694), 2e-4),
    ],
)
def test_other_contacts_have_their_reference_values(profile, swing, velocity, expected, tolerance):
    assert cf.normal_ratio(velocity, swing, profile) == pytest.approx(expected, abs=tolerance)


@pytest.mark.ordinary(3)
@pytest.mark.parametrize("profile", ["flat", "hertz", "rough"])
@pytest.mark.parametrize(("velocity", "swing"), [(0.05, 0.5), (0.4, 1.5), (0.9, 0.8), (1.2, 2.0)])
def test_springs_dragged_under_a_swinging_load_have_the_ratio_of_the_closed_form(
    profile, velocity, swing
):
    expected = cf.normal_ratio(velocity, swing, profile)
    # A spring that lands within a step is dragged for all of it, in the mean half a step too far.
    assert marched(velocity, swing, profile) == pytest.approx(expected, abs=5e-4)


@pytest.mark.parametrize("profile", ["flat", "hertz", "rough"])
def test_the_slower_the_nearer_sliding_friction_comes_to_static_friction(profile):
    swing = np.array([0.0, 0.2, 0.7, 1.0])
    static = cf.normal_static_ratio(swing, profile)
    assert cf.normal_ratio(0.0, swing, profile) == pytest.approx(static, abs=1e-6)
    assert cf.normal_ratio(1.0, swing, profile) == pytest.approx(
        cf.mean_load_ratio(swing, profile), abs=1e-14
    )


def test_static_friction_is_that_of_the_least_load():
    assert cf.normal_static_ratio([0.0, 0.3, 1.0, 1.4], "flat").tolist() == [1.0, 0.7, 0.0, 0.0]
    assert cf.normal_static_ratio(0.3, "hertz") == pytest.approx(0.7**1.5, rel=1e-15)
    assert cf.normal_static_ratio(1.2, "hertz") == 0.0


@pytest.mark.parametrize("profile", ["flat", "hertz", "rough"])
@pytest.mark.parametrize("share", [0.25, 0.6])
def test_what_drags_on_slowly_under_vibration_in_the_plane_is_static_friction(profile, share):
    # The springs below have their limits over that of full slip, 3/2 of s_max in a Hertz contact.
    expected = cf.plane_static_ratio(share, 2.0 / 3.0 if profile == "hertz" else 1.0, profile)
    # A drift of a thousandth of the limit in a cycle adds about as much.
    phase = 2.0 * np.pi / 60 * np.arange(40 * 60 + 1)
    drag = share * np.diff(np.sin(phase)) + 1e-3 / 60
    approach = np.full(len(drag), 0.0 if profile == "rough" else 1.0)
    assert dragged(profile, approach, drag, 60, 300) == pytest.approx(expected, abs=4e-3)


def test_contacts_differ_in_static_friction_by_the_power_of_their_load():
    assert cf.plane_static_ratio(30e-9, 100e-9, "flat") == pytest.approx(0.7, rel=1e-14)
    assert cf.plane_static_ratio(30e-9, 100e-9, "hertz") == pytest.approx(0.8**1.5, rel=1e-14)
    assert cf.plane_static_ratio(1.4, 1.0, "hertz") > 0.0
    assert cf.plane_static_ratio(1.5, 1.0, "hertz") == 0.0


def test_a_rigid_machine_raises_the_mean_load():
    assert cf.mean_load_ratio([0.5, 1.5], "hertz") == pytest.approx([1.0475, 1.4837], abs=5e-5)
    for swing in (0.3, 1.0, 1.7, 8.0):
        for profile, load in (
            ("flat", lambda d: max(d, 0.0)),
            ("hertz", lambda d: max(d, 0.0) ** 1.5),
            ("rough", lambda d: math.exp(d - 1.0)),
        ):
            end = [math.acos(-1.0 / swing)] if swing > 1.0 else None
            mean, _ = quad(lambda p, a=swing, N=load: N(1.0 + a * math.cos(p)), 0.0, math.pi,
                           points=end, epsabs=1e-13)  # fmt: skip
            assert cf.mean_load_ratio(swing, profile) == pytest.approx(mean / math.pi, rel=1e-9)


def test_under_a_dead_load_fast_sliding_has_all_of_the_friction():
    assert cf.dead_load_ratio([1.0, 30.0]).tolist() == [1.0, 1.0]


def test_a_hertz_contact_at_first_loss_has_its_mean_approach():
    assert cf.orbit_mean_approach(1.5) == pytest.approx(0.87579, abs=5e-6)
    assert cf.cosine_mean_approach(1.0, 1.5) == pytest.approx(0.88534, abs=5e-6)
    assert cf.orbit_mean_approach(1.0) == pytest.approx(1.0, rel=1e-14)
    assert cf.cosine_mean_approach([0.3, 1.0], 1.0) == pytest.approx([1.0, 1.0], rel=1e-14)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_the_free_orbit_that_just_touches_is_that_of_the_equation_of_motion(exponent):
    def top(time, state):
        return state[1]

    top.terminal, top.direction = True, -1.0
    # From rest at the moment of touching, up to where the load is greatest: half of the orbit.
    orbit = solve_ivp(
        lambda time, state: (state[1], 1.0 - max(state[0], 0.0) ** exponent, state[0]),
        (0.0, 10.0), (0.0, 0.0, 0.0), events=top, first_step=1e-3, rtol=1e-11, atol=1e-13,
    )  # fmt: skip
    approach, _, integral = orbit.y[:, -1]
    assert approach**exponent == pytest.approx(exponent + 1.0, rel=1e-8)
    mean = integral / orbit.t[-1]
    assert cf.orbit_mean_approach(exponent) == pytest.approx(mean, abs=1e-7)


@pytest.mark.parametrize("frequency", [0.3, 0.95, 1.8])
def test_the_load_of_a_flat_contact_under_a_dead_load_swings_as_a_linear_oscillator(frequency):
    damping, amplitude, period = 0.2, 0.02, 2.0 * math.pi / frequency

    def load(time, state):
        base, rate = np.sin(frequency * time), frequency * np.cos(frequency * time)
        return amplitude * base - state[0] + 2.0 * damping * (amplitude * rate - state[1])

    end = period * math.ceil(60.0 / period)
    times = np.linspace(end - period, end, 2001)
    solved = solve_ivp(
        lambda time, state: (state[1], load(time, state)), (0.0, end), (0.0, 0.0),
        t_eval=times, rtol=1e-8, atol=1e-11,
    )  # fmt: skip
    swing = load(times, solved.y).max()
    assert cf.load_swing(amplitude, frequency, damping) == pytest.approx(swing, rel=1e-4)


def test_the_load_of_the_body_of_table_4_3_falls_as_far_as_its_swing():
    # Stiffness 97.12 MN/m at 55 N, 4 kHz, k = 6; the prototype's damping follows the load, which
    # shifts its least load by 0.0025.
    swing = cf.load_swing(3e-3 / (2.0 * np.pi * 4e3) * 97.12e6 / 55.0, 4e3 / 2218.0, 0.05)
    assert cf.normal_static_ratio(swing, "flat") == pytest.approx(0.694, abs=3e-3)


def test_the_critical_velocity_is_where_the_load_outruns_the_drive():
    assert cf.critical_velocity(68.75e-9, 0.5, 4e3, "flat") == pytest.approx(8.639e-4, rel=1e-4)


PHASES = (0.0, 0.7, math.pi / 2.0, 3.0, -2.0)


@pytest.mark.ordinary(78)
@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("theta", [0.0, 0.02, math.pi / 4.0, math.pi / 2.0, 2.5, math.pi])
@pytest.mark.parametrize("k", [0.4, 1.0, 1.7, 6.0])
def test_the_elliptic_ratio_is_the_phase_mean_of_load_and_direction(k, theta, phase):
    def friction(p):
        x, y = 1.0 - k * math.cos(theta) * math.cos(p), k * math.sin(theta) * math.cos(p)
        return (1.0 + 0.8 * math.sin(p + phase)) * x / max(math.hypot(x, y), 1e-300)

    near = math.acos(min(1.0, 1.0 / max(k * abs(math.cos(theta)), 1e-300)))
    near = near if math.cos(theta) >= 0.0 else math.pi - near
    points = sorted({-near, near, 0.0})
    mean = quad(friction, -math.pi, math.pi, points=points, limit=400, epsabs=1e-11)[0]
    expected = mean / (2.0 * math.pi)
    assert cf.elliptic_ratio(k, theta, 0.8, phase) == pytest.approx(expected, abs=2e-8)


def test_along_the_drive_the_ellipse_pushes():
    assert cf.elliptic_ratio(6.0, 0.0, 0.8, math.pi / 2.0) == pytest.approx(-0.3956, abs=5e-5)
    k, swing, phase = np.array([1.5, 6.0, 40.0]), 0.6, 0.9
    along = 2.0 / math.pi * (
        np.arcsin(1.0 / k) - swing * math.sin(phase) * np.sqrt(1.0 - 1.0 / k**2)
    )  # fmt: skip
    assert cf.elliptic_ratio(k, 0.0, swing, phase) == pytest.approx(along, abs=1e-14)


def test_an_ellipse_without_a_swing_is_vibration_in_the_plane():
    theta = np.linspace(0.0, 3.0, 7)
    for k in (0.0, 0.5, 6.0):
        there = cf.directed_ratio(k, theta)
        assert cf.elliptic_ratio(k, theta, 0.0, 1.0) == pytest.approx(there, abs=1e-15)
        assert cf.elliptic_ratio(k, theta, 0.8, 0.0) == pytest.approx(there, abs=1e-15)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: cf.master_curve(-0.1), "velocity is -0.1; it must be zero or positive"),
        (lambda: cf.normal_ratio(0.5, -1.0, "flat"), "swing is -1; it must be zero or positive"),
        (lambda: cf.normal_ratio(0.5, 0.5, "sphere"), "it must be one of 'flat', 'hertz', 'rough'"),
        (lambda: cf.dead_load_ratio(0.5), "velocity is 0.5; it must be at least 1; slower"),
        (lambda: cf.cosine_mean_approach(1.2, 1.5), "above 1 contact is lost"),
        (lambda: cf.elliptic_ratio(6.0, 0.0, 1.1, 0.0), "above 1 contact is lost"),
        (lambda: cf.load_swing(0.1, 1.0, 0.0), "swings without bound"),
        (lambda: cf.orbit_mean_approach(0.5), "exponent is 0.5; it must be from 1 to 3"),
    ],
)
def test_what_is_outside_a_form_is_refused_in_a_line(call, message):
    with pytest.raises(InputError) as refused:
        call()
    assert message in str(refused.value)
    assert "\n" not in str(refused.value)


def test_every_form_names_its_source_and_how_far_it_can_be_trusted():
    for name in cf.__all__:
        assert str(getattr(cf, name).source).endswith(")"), name
    assert cf.master_curve_approximated.source.confidence == "from memory"


@pytest.mark.usefixtures("plain_kernels")
def test_an_asperity_after_dahl_loses_more_and_has_no_end_at_the_critical_velocity():
    # The table of the prototype for exponent 1, whose reduction over the swing reaches on for ever:
    # the package's update with its stiffness kept, at the same rigid drive.
    steps, swing = 1000, 0.5
    expected = {0.1: 0.89417, 0.3: 0.74512, 0.5: 0.63875, 1.0: 0.46668, 2.0: 0.29537, 5.0: 0.13248}
    loads = 1.0 + swing * np.cos(2.0 * np.pi / steps * np.arange(steps + 1))
    for velocity, reduction in expected.items():
        way = 2.0 * np.pi / steps * swing * velocity
        deflection, before = 1.0, np.inf
        while abs(deflection - before) > 1e-9:
            before, friction = deflection, []
            for start, end in itertools.pairwise(loads):
                deflection, _, share, _ = advance_loaded(
                    deflection, 0.0, way, 0.0, 0.0, 0.0, start, end, 1.0, VECTOR, STIFFNESS
                )
                friction.append(share)
        found = (1.0 - np.mean(friction)) / swing
        assert found == pytest.approx(reduction, abs=1e-4), velocity


def bodies(profile, velocities, swing):
    """Ratios of the shipped case normal-machine at velocities over the critical one."""
    law = {"flat": "linear"}.get(profile, profile)
    case = read_case("normal-machine", TABLES, [f"normal.law={law}"])
    critical = cf.critical_velocity(68.75e-9, swing, 4e3, profile)
    changes = [
        {"slider.drive_velocity": v * critical, "vibration.displacement_amplitude": swing * 0.4e-6}
        for v in velocities
    ]
    return [
        result.ratio
        for result in solve_many([Model.from_case(case.replace_values(c)) for c in changes])
    ]


@pytest.mark.parametrize("swing", [0.1, 0.5, 0.9])
def test_a_body_on_flat_springs_is_on_the_master_curve(swing):
    velocities = (0.05, 0.3, 0.9, 1.1)
    reduction = (1.0 - np.array(bodies("flat", velocities, swing))) / swing
    assert reduction == pytest.approx(cf.master_curve(velocities), abs=1e-4)


def test_a_body_on_hertz_springs_has_the_ratio_of_a_hertz_contact():
    velocities = (0.05, 0.2, 0.5)
    found = bodies("hertz", velocities, 0.5)
    assert found == pytest.approx(cf.normal_ratio(velocities, 0.5, "hertz"), abs=1e-3)
