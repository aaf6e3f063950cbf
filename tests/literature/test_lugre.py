"""LuGre friction: stick-slip, the Stribeck curve, presliding, Dahl as a special case.

Source: C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky, A New Model for Control of
Systems with Friction, IEEE Transactions on Automatic Control 40 (1995) 419-425: table I
(sigma_0 1e5 N/m, sigma_1 sqrt(1e5) N s/m, sigma_2 0.4 N s/m, F_C 1 N, F_S 1.5 N, v_s 1 mm/s) and
its stick-slip experiment (1 kg on a spring of 2 N/m pulled at 0.1 m/s).
"""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from asperity.casefile import read_case
from asperity.friction import LAWS, Friction, lugre_update, update
from asperity.friction.lugre import stribeck_share
from asperity.slider import TABLES, Model, Slider, Solve, solve
from asperity.slider.march import March

pytestmark = pytest.mark.usefixtures("plain_kernels")

CANUDAS = {
    "model": "lugre",
    "mu": 0.1,
    "static_mu": 0.15,
    "tangential_stiffness": 1e5,
    "contact_damping": math.sqrt(1e5),
    "viscous_damping": 0.4,
    "stribeck_velocity": 1e-3,
}
WEIGHT = 10.0
NOTHING = (0.0, 0.0)


@pytest.fixture(scope="module")
def stick_slip():
    """Time, velocity, spring force and friction of two slips, every 0.1 ms around them."""
    slider = Slider(
        drive_velocity=0.1, drive_stiffness=2.0, mass=1.0, normal_force=WEIGHT, units="SI"
    )
    solver = Solve(step=1e-5, duration=14.5, units="SI")
    model = Model(slider, Friction(**CANUDAS, units="SI"), None, solver)
    march = March(model, record=True)
    step = march.table.step
    for begin, end in ((7.3, 7.6), (13.7, 13.9)):
        march.to(round(begin / step), 1000)
        march.to(round(end / step), 10)
    history = march.history()
    return history.time, history.velocity[:, 0], history.drive_force, history.friction[:, 0]


def slip_starts(time, velocity):
    above = velocity > 0.01
    return np.flatnonzero(above[1:] & ~above[:-1]) + 1


@pytest.fixture(scope="module")
def equations():
    """The same three equations integrated by SciPy: slips (time, spring force), friction's peak."""

    def rates(time, state):
        x, v, z = state
        limit = (1.0 + 0.5 * np.exp(-((v / 1e-3) ** 2))) / 1e5
        return v, 2.0 * (0.1 * time - x) - friction(v, z), v - abs(v) / limit * z

    def friction(v, z):
        limit = (1.0 + 0.5 * np.exp(-((v / 1e-3) ** 2))) / 1e5
        return 1e5 * z + math.sqrt(1e5) * (v - abs(v) / limit * z) + 0.4 * v

    def slips(_, state):
        return state[1] - 0.01

    slips.direction = 1.0
    answer = solve_ivp(
        rates, (0.0, 14.5), [0.0, 0.0, 0.0], "Radau", rtol=1e-8, atol=1e-13, events=slips,
        dense_output=True,
    )  # fmt: skip
    times = answer.t_events[0]
    spring = 2.0 * (0.1 * times - answer.y_events[0][:, 0])
    around = np.linspace(7.39, 7.42, 30001)
    peak = np.argmax(friction(*answer.sol(around)[1:]))
    return times, spring, around[peak], friction(*answer.sol(around[peak])[1:])


# The march is seen every 0.1 ms; published digits hold to one unit of the last.
SEEN = 1.1e-4
DIGIT = 1e-3


@pytest.mark.slow
def test_the_spring_force_at_which_the_body_slips(stick_slip, equations):
    time, velocity, spring, _ = stick_slip
    first = slip_starts(time, velocity)[0]
    assert time[first] == pytest.approx(equations[0][0], abs=SEEN)
    assert spring[first] == pytest.approx(equations[1][0], abs=5e-5)
    assert (time[first], spring[first]) == pytest.approx((7.458, 1.491), abs=DIGIT)


def test_friction_peaks_before_the_body_slips(stick_slip, equations):
    time, _, _, friction = stick_slip
    before = time < 7.5
    peak = time[before][friction[before].argmax()]
    assert peak == pytest.approx(equations[2], abs=SEEN)
    assert friction[before].max() == pytest.approx(equations[3], abs=1e-7)
    assert peak == pytest.approx(7.405, abs=DIGIT)
    assert friction[before].max() == pytest.approx(1.4766, abs=1e-4)


def test_stick_slip_repeats_with_its_period(stick_slip, equations):
    time, velocity, _, _ = stick_slip
    starts = time[slip_starts(time, velocity)]
    assert len(starts) == 2
    assert starts[1] - starts[0] == pytest.approx(np.diff(equations[0])[0], abs=SEEN)
    assert starts[1] - starts[0] == pytest.approx(6.362, abs=DIGIT)


@pytest.mark.parametrize("velocity", [1e-5, 3e-4, 1e-3, 5e-3])
@pytest.mark.parametrize("law", LAWS)
def test_steady_sliding_follows_the_stribeck_curve(velocity, law):
    slider = Slider(drive_velocity=velocity, normal_force=WEIGHT, units="SI")
    limit = 1.5e-5  # F_S / sigma_0
    solver = Solve(step=0.01 * limit / velocity, duration=60.0 * limit / velocity, units="SI")
    answer = solve(
        Model(slider, Friction(**CANUDAS, law=law, units="SI"), None, solver), history=False
    )
    curve = 1.0 + 0.5 * math.exp(-((velocity / 1e-3) ** 2)) + 0.4 * velocity
    assert answer.drive_force == pytest.approx(curve, rel=1e-9)


def test_the_stribeck_curve_is_even_and_finite_for_a_backward_slip():
    assert stribeck_share(0.0, 1.5, 1e-3) == 1.5
    assert stribeck_share(2e-3, 1.5, 1e-3) == pytest.approx(1.0 + 0.5 * math.exp(-4.0), rel=1e-15)
    backward = lugre_update(NOTHING, (-3e-6, 0.0), NOTHING, 1e-5, 1e-3, 1.5, 1e-3, 300.0, 0.4, 2)
    forward = lugre_update(NOTHING, (3e-6, 0.0), NOTHING, 1e-5, 1e-3, 1.5, 1e-3, 300.0, 0.4, 2)
    assert backward[1][0] == -forward[1][0]


def test_without_static_friction_or_stribeck_velocity_the_limit_is_full_friction():
    # As printed, (43) with F_S = v_s = 0 is 0/0.
    assert stribeck_share(3.0, 1.0, 0.0) == 1.0
    assert stribeck_share(0.0, 1.0, 0.0) == 1.0


@pytest.mark.parametrize("law", LAWS)
def test_without_damping_and_stribeck_terms_lugre_is_dahl(law):
    settings = [f"friction.law={law}", "vibration.direction=60 deg", "solve.duration=0.2 s"]
    case = read_case("table-4.4", TABLES, settings)
    dahl = solve(Model.from_case(case))
    lugre = solve(Model.from_case(case.replace(["friction.model=lugre"])))
    assert lugre.ratio == pytest.approx(dahl.ratio, rel=1e-12)
    assert np.abs(lugre.history.drive_force - dahl.history.drive_force).max() <= 1e-10
    assert np.abs(lugre.history.friction - dahl.history.friction).max() <= 1e-10


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_without_damping_and_stribeck_terms_its_update_is_dahls(law):
    deflection, slips, limit = (2e-8, -3e-8), ((5e-8, 1e-8), (0.0, -4e-8)), 7e-8
    new, share, tangents = lugre_update(deflection, *slips, limit, 1e-6, 1.0, 0.0, 0.0, 0.0, law)
    dahl_new, dahl_share, dahl_tangents = update(deflection, *slips, limit, 1.0, law)
    assert new == dahl_new
    assert share == pytest.approx(dahl_share, rel=1e-14)
    assert np.multiply(tangents, limit) == pytest.approx(np.array(dahl_tangents), rel=1e-13)


def test_a_small_push_meets_spring_and_damper():
    # Presliding: far below the limit the contact is sigma_0 in parallel with sigma_1 + sigma_2.
    way, step, limit = 1e-11, 1e-4, 1e-5
    _, share, _ = lugre_update(
        NOTHING, (way, 0.0), NOTHING, limit, step, 1.5, 1e-3, math.sqrt(1e5), 0.4, LAWS["vector"]
    )
    force = 1e5 * way + (math.sqrt(1e5) + 0.4) * way / step
    assert share[0] == pytest.approx(force, rel=2e-6)
