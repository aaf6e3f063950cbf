r"""Springs against what is known of contacts that are sheared while their load changes.

Sources: P. R. Dahl, A Solid Friction Model, 1968, whose law integrated from rest is
1 - (1 - (1 - i) s)^(1/(1 - i)); the master curve of a flat contact under normal vibration in closed
form, and the mean friction of Hertz and rough contacts by converged integration (M. Popov, V. L.
Popov, N. V. Popov 2017, 10.1007/s40544-016-0136-4, for the shape of the first).
"""

import math

import numpy as np
import pytest
from apparatus.grid import slow
from scipy.optimize import brentq

from asperity.errors import InputError
from asperity.friction.dahl import VECTOR, advance
from asperity.friction.springs import (
    REFERENCE_INDENTATION,
    advance_springs,
    advance_springs_along,
    load_and_slope,
    spring_profile,
    stored_in_springs,
)
from asperity.kernels.compiled import kernel

pytestmark = pytest.mark.usefixtures("plain_kernels")

DAHL = {"linear": 0.0, "hertz": 1 / 3, "rough": 1.0}
STEPS = 200


@kernel
def pulled(s, velocity, indentations, heights, weights):
    """Friction after each step of an even pull."""
    shares = np.zeros(len(indentations))
    for n in range(len(indentations)):
        shares[n], _ = advance_springs_along(
            s, velocity, indentations[n - 1], indentations[n], heights, weights
        )
    return shares


def vibrated(law, swing, velocity, springs=16, cycles=None, start=None):
    """Friction over the last of the cycles while the indentation swings and the body is pulled.

    ``velocity`` is over that at which the springs' limits rise fastest.
    """
    reference = REFERENCE_INDENTATION[law]
    heights, weights = spring_profile(law, springs, reference + swing)
    cycles = cycles or math.ceil(4 / velocity)
    phase = 2.0 * np.pi * np.arange(STEPS * cycles) / STEPS
    s = np.zeros(len(heights)) if start is None else start
    indentations = reference + swing * np.sin(phase)
    slip = velocity * 2.0 * np.pi * swing / STEPS
    return pulled(s, slip, indentations, heights, weights)[-STEPS:]


@pytest.mark.parametrize("count", [16, 64, 256])
@pytest.mark.parametrize("law", DAHL)
def test_the_springs_carry_the_normal_law(law, count):
    deepest = 1.3 * REFERENCE_INDENTATION[law]
    heights, weights = spring_profile(law, count, deepest)
    indentations = np.linspace(deepest - 6.0, deepest, 2001)
    carried = [weights @ np.maximum(d - heights, 0.0) for d in indentations]
    wanted, _ = load_and_slope(law, indentations)
    miss = carried - wanted
    # A rough contact's last intervals are wide beside the others: 1.3e-3 of 16 springs.
    assert np.abs(miss).max() < 1.4e-3 * (16 / count) ** 2
    assert abs(miss.mean()) < 2e-4 * (16 / count) ** 2


@pytest.mark.parametrize("law", DAHL)
def test_the_first_loading_is_dahl_s_law_of_the_contact_s_exponent(law):
    reference = REFERENCE_INDENTATION[law]
    errors = []
    for count in (16, 256):
        heights, weights = spring_profile(law, count, reference)
        s = np.zeros(len(heights))
        slip = 2.0 / 100
        shares = pulled(s, slip, np.full(100, reference), heights, weights)
        expected = [
            advance(0.0, 0.0, slip * n, 0.0, 0.0, 0.0, DAHL[law], VECTOR)[0] for n in range(101)
        ]
        errors.append(np.abs(shares - expected[1:]).max())
    if law == "linear":
        assert max(errors) < 1e-14
    else:
        assert errors[0] < 2e-3
        assert errors[1] < errors[0] / 200


def flat_reduction(velocity):
    """Reduction of friction over the relative swing of the load, by the two times of stick."""
    c, v = math.sqrt(1.0 - velocity**2), velocity
    first = math.pi + math.asin(v)
    last = brentq(
        lambda t: math.cos(t) + c - v * (t - first), first + 0.05, first + 2 * math.pi, xtol=1e-14
    )
    span = last - first
    return (math.sin(last) - math.sin(first) + c * span - v * span**2 / 2) / (2 * math.pi)


@pytest.mark.ordinary(5)
@pytest.mark.parametrize("swing", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("velocity", [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9])
def test_a_flat_contact_meets_the_master_curve(velocity, swing):
    ratio = vibrated("linear", swing, velocity).mean()
    assert (1.0 - ratio) / swing == pytest.approx(flat_reduction(velocity), abs=1e-4)


@pytest.mark.parametrize(("law", "velocity"), [("linear", 1.05), ("hertz", 1.05), ("rough", 1.05)])
def test_above_the_critical_velocity_friction_follows_the_load(law, velocity):
    shares = vibrated(law, 0.5, velocity, springs=64, cycles=8)
    phase = 2.0 * np.pi * np.arange(STEPS) / STEPS
    load, _ = load_and_slope(law, REFERENCE_INDENTATION[law] + 0.5 * np.sin(phase))
    assert shares == pytest.approx(load, abs=3e-4)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("law", "swing", "velocity", "mean"),
    [
        slow("hertz", 0.75, 0.05, 0.44234),
        ("hertz", 0.75, 0.2, 0.64643),
        ("hertz", 0.75, 0.5, 0.90385),
        ("hertz", 2.25, 0.05, 0.1676),
        ("hertz", 2.25, 0.2, 0.5814),
        ("hertz", 2.25, 0.5, 1.1342),
        ("rough", 0.5, 0.2, 0.7996),
        ("rough", 0.5, 0.5, 0.9694),
    ],
)
def test_sixteen_springs_give_the_mean_friction_of_curved_contacts(law, swing, velocity, mean):
    assert vibrated(law, swing, velocity).mean() == pytest.approx(mean, abs=1e-3)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", ["linear", "hertz"])
def test_a_force_below_the_least_load_is_held_without_creep(law):
    # Pulled to a deflection, then held under an oscillating load: after the first cycle no change.
    reference = REFERENCE_INDENTATION[law]
    swing = 0.3 * reference
    heights, weights = spring_profile(law, 64, reference + swing)
    s = np.zeros(len(heights))
    slip, least = 0.1, reference - swing
    held = pulled(s, slip, np.array([least]), heights, weights)[0]
    phase = 2.0 * np.pi * np.arange(200 * 20 + 1) / 200
    shares = pulled(s, 0.0, reference - swing * np.cos(phase), heights, weights)
    assert shares == pytest.approx(held, abs=1e-15)
    most = load_and_slope(law, np.array([least]))[0][0]
    shares = pulled(s, 0.02, np.full(200, least), heights, weights)
    assert shares[-1] == pytest.approx(most, abs=5e-4)


@kernel
def walk(sx, sy, slips, indentations, heights, weights):
    """Friction at the end of a path, and least of loss of any step."""
    least = 1e300
    share = (0.0, 0.0)
    stored = 0.0
    for n in range(len(slips)):
        fx, fy, energy = advance_springs(
            sx, sy, slips[n, 0], slips[n, 1], indentations[n], indentations[n + 1],
            heights, weights,
        )  # fmt: skip
        share = fx, fy
        before = stored
        stored = energy
        work = share[0] * slips[n, 0] + share[1] * slips[n, 1]
        least = min(least, work - (stored - before))
    return share, least


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", DAHL)
@pytest.mark.parametrize("paths", [100, slow(10_000)])
def test_paths_of_indentation_and_slip_gain_nothing(law, paths):
    random = np.random.default_rng(6)
    reference = REFERENCE_INDENTATION[law]
    heights, weights = spring_profile(law, 16, reference + 1.5)
    for _ in range(paths):
        indentations = reference + random.uniform(-2.0, 1.5, 41)
        slips = 10.0 ** random.uniform(-3, 1.5, (40, 1)) * random.standard_normal((40, 2))
        s = np.zeros((2, len(heights)))
        _, least = walk(*s, slips, indentations, heights, weights)
        assert least >= -1e-13 * np.abs(slips).max()


@pytest.mark.slow
def test_in_the_plane_the_order_is_two_on_average_over_a_decade():
    heights, weights = spring_profile("hertz", 16, 2.4)
    steps = np.unique(np.geomspace(400, 4000, 16).astype(int))
    errors = np.zeros(len(steps))

    def friction(steps, phase):
        time = np.linspace(0.0, 6.0, steps + 1)
        ways = [
            1.5 * time + 2.0 * np.sin(time),
            0.7 * np.sin(time + 0.4) + 1.1 * np.cos(2.0 * time),
        ]
        indentations = 1.5 * (1.0 + 0.6 * np.sin(3.0 * time + phase))
        slips = np.ascontiguousarray(np.diff(ways, axis=1).T)
        return np.array(walk(*np.zeros((2, 16)), slips, indentations, heights, weights)[0])

    for phase in np.arange(16) * np.pi / 8:
        truth = friction(400_000, phase)
        errors += [np.abs(friction(n, phase) - truth).max() for n in steps]
    order = -np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert order == pytest.approx(2.0, abs=0.1)


def test_a_turn_of_the_frame_turns_the_friction():
    random = np.random.default_rng(7)
    heights, weights = spring_profile("hertz", 16, 3.0)
    for _ in range(30):
        slips = random.standard_normal((40, 2))
        indentations = random.uniform(0.0, 3.0, 41)
        angle = random.uniform(-np.pi, np.pi)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        here, _ = walk(*np.zeros((2, 16)), slips, indentations, heights, weights)
        there, _ = walk(*np.zeros((2, 16)), slips @ turn.T, indentations, heights, weights)
        assert there == pytest.approx(tuple(turn @ here), abs=1e-12)


def test_along_a_line_the_short_way_is_the_same():
    random = np.random.default_rng(8)
    heights, weights = spring_profile("hertz", 16, 3.0)
    plane, line = np.zeros((2, 16)), np.zeros(16)
    indentations = random.uniform(-0.5, 3.0, 301)
    for n, slip in enumerate(random.standard_normal(300)):
        here = indentations[n : n + 2]
        share_x, share_y, stored = advance_springs(*plane, slip, 0.0, *here, heights, weights)
        along, kept = advance_springs_along(line, slip, *here, heights, weights)
        assert (share_x, share_y, stored) == pytest.approx((along, 0.0, kept), abs=1e-14)
        assert stored == pytest.approx(stored_in_springs(*plane, weights), rel=1e-13)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("flat", 16, 1.0), "linear, hertz, rough"),
        (("hertz", 0, 1.0), "number of springs is 0"),
        (("hertz", 16, -1.0), "deepest indentation is -1"),
        (("rough", 16, math.inf), "deepest indentation is inf"),
    ],
)
def test_a_profile_of_nothing_is_refused_in_one_line(given, words):
    with pytest.raises(InputError, match=words) as raised:
        spring_profile(*given)
    assert len(str(raised.value).splitlines()) == 1


@pytest.mark.parametrize("count", [4, 16, 37])
@pytest.mark.parametrize("law", ["hertz", "rough"])
@pytest.mark.parametrize("deeper", [0.0, 0.003, 0.4, 1.1])
def test_springs_carry_the_reference_load_whatever_they_reach(law, count, deeper):
    reference = REFERENCE_INDENTATION[law]
    heights, weights = spring_profile(law, count, reference + deeper)
    assert weights @ np.maximum(reference - heights, 0.0) == pytest.approx(1.0, abs=1e-12)
    assert heights.max() <= reference + deeper + 0.7 * 16 / count
