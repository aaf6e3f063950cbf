import math

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.friction import LAWS
from asperity.friction.dahl import advance
from asperity.friction.loaded import DEFLECTION, KEEPS, STIFFNESS, advance_loaded, friction_loss
from asperity.friction.loaded_tangent import update_loaded
from asperity.kernels.compiled import kernel

pytestmark = pytest.mark.usefixtures("plain_kernels")

EXPONENTS = [0.0, 1 / 3, 0.5, 1.0, 1.5, 2.0]
# Differences of squares of numbers of order one, added up over a path.
ROUNDING = 1e-13


@kernel
def walk(limits, slips, exponent, law, keeps):
    """Least loss of any step, and what friction took and stores over a path of loads and slips."""
    sx, sy, least, taken = 0.0, 0.0, 1e300, 0.0
    for n in range(len(slips)):
        parts = slips[n]
        wx, wy, fx, fy = advance_loaded(
            sx, sy, parts[0], parts[1], parts[2], parts[3], limits[n], limits[n + 1],
            exponent, law, keeps,
        )  # fmt: skip
        dx = parts[0] + parts[2]
        dy = parts[1] + parts[3]
        loss = friction_loss(sx, sy, wx, wy, dx, dy, limits[n], limits[n + 1], keeps)
        least = min(least, loss)
        taken += fx * dx + fy * dy
        sx, sy = wx, wy
    return least, taken, 0.5 * (sx * sx + sy * sy)


def random_path(random, steps=40):
    """Loads that fall to nothing and slips from far below to far above the limit."""
    limits = random.uniform(0.0, 2.0, steps + 1) * (random.random(steps + 1) > 0.1)
    sizes = 10.0 ** random.uniform(-3.0, 1.5, (steps, 1))
    return limits, sizes * random.standard_normal((steps, 4))


@pytest.mark.ordinary(10)
@pytest.mark.parametrize("keeps", KEEPS.values(), ids=KEEPS)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_at_a_constant_load_the_update_is_that_without_one_to_the_last_bit(exponent, law, keeps):
    random = np.random.default_rng(1)
    for _ in range(100):
        s = random.uniform(-0.7, 0.7, 2)
        slip = 10.0 ** random.uniform(-4, 1) * random.standard_normal(4)
        wanted = advance(*s, *slip, exponent, law)
        assert advance_loaded(*s, *slip, 1.0, 1.0, exponent, law, keeps) == (*wanted, *wanted)
        # In powers of two a scale is exact too.
        scale = 4.0 if keeps == STIFFNESS else 1.0
        *found, fx, fy = advance_loaded(
            *(s * scale), *(slip * scale), 4.0, 4.0, exponent, law, keeps
        )
        assert (found[0] / scale, found[1] / scale, fx / 4, fy / 4) == (*wanted, *wanted)


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_loads_deflections_and_slips_four_times_as_large_make_four_times_the_friction(
    exponent, law
):
    random = np.random.default_rng(4)
    limits, slips = random_path(random, 100)
    for first, last, slip in zip(limits, limits[1:], 0.1 * slips, strict=False):
        s = first * random.uniform(-0.7, 0.7, 2)
        wanted = advance_loaded(*s, *slip, first, last, exponent, law, STIFFNESS)
        found = advance_loaded(
            *(4.0 * s), *(4.0 * slip), 4.0 * first, 4.0 * last, exponent, law, STIFFNESS
        )
        assert np.abs(np.array(found) / 4.0 - wanted).max() <= 1e-14 * (first + last)


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_with_the_stiffness_kept_ten_thousand_paths_of_load_and_slip_gain_nothing(law):
    random = np.random.default_rng(2)
    for n in range(10_000):
        limits, slips = random_path(random)
        least, taken, stored = walk(limits, slips, EXPONENTS[n % 6], law, STIFFNESS)
        scale = np.abs(slips).max() ** 2
        assert least >= -ROUNDING * scale
        assert taken - stored >= -ROUNDING * scale


@pytest.mark.parametrize("start", [1.0, 1.9])
def test_where_the_load_falls_below_the_deflection_the_asperity_slips_back(start):
    s = (0.6 * start, -0.8 * start)
    found = advance_loaded(*s, 0.0, 0.0, 0.0, 0.0, 2.0, 0.5, 1.0, LAWS["vector"], STIFFNESS)
    assert found == pytest.approx((0.3, -0.4, 0.3, -0.4), rel=1e-15)
    lost = friction_loss(*s, *found[:2], 0.0, 0.0, 2.0, 0.5, STIFFNESS)
    assert lost == pytest.approx(0.5 * (start**2 - 0.5**2))
    again = advance_loaded(*found[:2], 0.0, 0.0, 0.0, 0.0, 0.5, 2.0, 1.0, LAWS["vector"], STIFFNESS)
    assert again == pytest.approx(found, rel=1e-15)


@pytest.mark.parametrize("keeps", KEEPS.values(), ids=KEEPS)
@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_a_contact_that_opens_forgets_and_lands_straight(law, exponent, keeps):
    slip = (0.3, 0.1, 0.0, 0.2)
    for limits in ((1.0, 0.0), (1e-300, 1e-200), (0.0, 0.0)):
        assert advance_loaded(0.3, 0.1, *slip, *limits, exponent, law, keeps) == (0, 0, 0, 0)
    for load in (1e-140, 1e-12, 1.0):
        _, _, fx, fy = advance_loaded(0.0, 0.0, *slip, 0.0, load, exponent, law, keeps)
        assert 0.0 < math.hypot(fx, fy) <= load * (1.0 + 1e-12)


def test_no_slip_and_no_fall_of_the_load_moves_nothing():
    for law in LAWS.values():
        found = advance_loaded(0.5, -0.2, 0.0, 0.0, 0.0, 0.0, 1.0, 1.7, 1.0, law, STIFFNESS)
        assert found == pytest.approx((0.5, -0.2, 0.5, -0.2), rel=1e-15)


def test_only_a_kept_deflection_gains_energy_where_an_asperity_is_sheared_unpressed():
    # Sheared at half the load, pressed to three halves, sheared back, let go: per step 1/1000.
    steps, shear = 1000, 0.01
    ramp = np.linspace(0.0, 1.0, steps + 1)[1:]
    limits = np.concatenate(
        [[0.5], np.full(steps, 0.5), 0.5 + ramp, np.full(steps, 1.5), 1.5 - ramp]
    )
    slips = np.zeros((4 * steps, 4))
    slips[:steps, 0] = shear / steps
    slips[2 * steps : 3 * steps, 0] = -shear / steps
    _, kept, _ = walk(limits, slips, 1.0, LAWS["vector"], STIFFNESS)
    _, gained, _ = walk(limits, slips, 1.0, LAWS["vector"], DEFLECTION)
    elastic = 0.5 * shear**2
    assert kept > 0.0
    assert -gained / elastic == pytest.approx(0.977, abs=5e-3)


def shares(s, varied, limit_0, exponent, law, keeps):
    """Friction as a function of the four slips and the limit of the end."""
    return np.array(advance_loaded(*s, *varied[:4], limit_0, varied[4], exponent, law, keeps)[2:])


def differences(step, s, varied, *rest):
    """Central differences of `shares` by slips and limit, by columns."""
    sides = [
        [shares(s, varied + sign * step * unit, *rest) for unit in np.eye(5)] for sign in (1, -1)
    ]
    return np.subtract(*sides).T / (2 * step)


def tangents(s, varied, limit_0, exponent, law, keeps):
    _, _, _, (first, second), (_, slope) = update_loaded(
        tuple(s), tuple(varied[:2]), tuple(varied[2:4]), limit_0, varied[4], exponent, law, keeps
    )
    return np.column_stack([np.reshape(first, (2, 2)), np.reshape(second, (2, 2)), slope])


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("law", "exponent", "keeps"), grid(LAWS.values(), EXPONENTS, KEEPS.values(), ordinary=5)
)
def test_the_tangents_by_slip_and_load_are_the_differences(law, exponent, keeps):
    random = np.random.default_rng(3)
    smooth = 0
    for _ in range(50):
        limit_0, limit_1 = random.uniform(0.2, 2.0, 2)
        size, angle = limit_0 * random.random(), random.uniform(-np.pi, np.pi)
        s = size * np.array([np.cos(angle), np.sin(angle)])
        varied = np.append(10.0 ** random.uniform(-2, 0.5) * random.standard_normal(4), limit_1)

        point = s, varied, limit_0, exponent, law, keeps
        found = differences(1e-6, *point)
        if np.abs(found - differences(2e-6, *point)).max() > 1e-6:
            continue  # a kink between the points has no derivative
        smooth += 1
        assert tangents(*point) == pytest.approx(found, abs=1e-5)
    assert smooth > 45


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
def test_at_the_limit_and_a_load_that_stays_the_tangent_by_load_is_that_of_a_rise(law, exponent):
    s, varied = np.array([0.6, 0.8]), np.array([0.2, 0.1, 0.0, 0.05, 1.0])
    risen = varied + 1e-9 * np.eye(5)[4]
    here, there = (shares(s, at, 1.0, exponent, law, STIFFNESS) for at in (varied, risen))
    found = (there - here) / 1e-9
    slope = tangents(s, varied, 1.0, exponent, law, STIFFNESS)[:, 4]
    assert slope == pytest.approx(found, abs=1e-5)


@pytest.mark.parametrize("keeps", KEEPS.values(), ids=KEEPS)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_the_update_with_tangents_goes_where_the_plain_one_goes(law, keeps):
    random = np.random.default_rng(4)
    for n in range(100):
        s, slip = random.uniform(-0.7, 0.7, 2), random.standard_normal(4)
        loads = random.uniform(0.0, 2.0, 2) if n % 10 else (1.0, 0.0)
        exponent = EXPONENTS[n % 6]
        wanted = advance_loaded(*s, *slip, *loads, exponent, law, keeps)
        new, share, loss, _, _ = update_loaded(
            tuple(s), tuple(slip[:2]), tuple(slip[2:]), *loads, exponent, law, keeps
        )
        assert (*new, *share) == pytest.approx(wanted, abs=1e-14)
        lost = friction_loss(*s, *new, *(slip[:2] + slip[2:]), *loads, keeps)
        assert loss == pytest.approx(lost, abs=1e-14)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_a_turn_of_the_frame_turns_the_friction_under_a_changing_load(exponent):
    random = np.random.default_rng(5)
    for _ in range(100):
        s, slip = random.uniform(-0.7, 0.7, 2), random.standard_normal(2)
        loads, angle = random.uniform(0.1, 2.0, 2), random.uniform(-np.pi, np.pi)
        c, sine = np.cos(angle), np.sin(angle)
        turn = np.array([[c, -sine], [sine, c]])

        there, here = (
            advance_loaded(
                *(by @ s), *(by @ slip), 0.0, 0.0, *loads, exponent, LAWS["vector"], STIFFNESS
            )[2:]
            for by in (turn, np.eye(2))
        )
        assert there == pytest.approx(tuple(turn @ here), abs=1e-12)
