import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from asperity.friction import LAWS, VECTOR, lugre_update, update
from asperity.friction.coulomb import project
from asperity.friction.dahl import advance

pytestmark = pytest.mark.usefixtures("plain_kernels")

EXPONENTS = [0.0, 0.5, 1.0, 1.5, 2.0]

laws = st.sampled_from(list(LAWS.values()))
exponents = st.sampled_from(EXPONENTS).map(np.float64)
# Far from the numbers that underflow when squared.
angles = st.floats(-math.pi, math.pi).map(lambda angle: round(angle, 9))
limits = st.floats(-9.0, -5.0).map(lambda x: 10.0**x)


def polar(length, angle):
    return length * math.cos(angle), length * math.sin(angle)


def rotated(vector, angle):
    c, s = math.cos(angle), math.sin(angle)
    return c * vector[0] - s * vector[1], s * vector[0] + c * vector[1]


def scaled(vector, factor):
    return vector[0] * factor, vector[1] * factor


deflections = st.builds(polar, st.floats(0.0, 1.0).map(lambda size: round(size, 9)), angles)
slips = st.builds(lambda x, a: polar(10.0**x, a), st.floats(-8.0, 3.0), angles)
moderate_slips = st.builds(lambda x, a: polar(10.0**x, a), st.floats(-2.5, 1.0), angles)


@given(deflections, slips, slips, exponents, laws, limits)
def test_the_deflection_stays_inside_the_limit_for_slip_up_to_a_thousand_limits(
    deflection, slip_1, slip_2, exponent, law, limit
):
    new, share, _ = update(
        scaled(deflection, limit), scaled(slip_1, limit), scaled(slip_2, limit),
        limit, exponent, law,
    )  # fmt: skip
    assert math.hypot(*share) <= 1.0 + 1e-12
    assert new == pytest.approx(scaled(share, limit), rel=1e-14)


@given(deflections, slips, exponents, angles)
def test_turning_the_frame_turns_the_vector_update(deflection, slip, exponent, angle):
    new, _, _ = update(deflection, slip, (0.0, 0.0), 1.0, exponent, VECTOR)
    turned, _, _ = update(
        rotated(deflection, angle), rotated(slip, angle), (0.0, 0.0), 1.0, exponent, VECTOR
    )
    assert turned == pytest.approx(rotated(new, angle), abs=1e-12)


@given(deflections, slips, st.sampled_from([1.0, 1.5, 2.0]), angles)
def test_turning_the_frame_turns_the_vector_tangent(deflection, slip, exponent, angle):
    # At the limit exponents between 1 and 2 have a root of what is left, which magnifies rounding.
    deflection = scaled(deflection, 0.99)
    turn = np.column_stack([rotated((1.0, 0.0), angle), rotated((0.0, 1.0), angle)])
    _, _, (tangent, _) = update(deflection, slip, (0.0, 0.0), 1.0, exponent, VECTOR)
    _, _, (turned, _) = update(
        rotated(deflection, angle), rotated(slip, angle), (0.0, 0.0), 1.0, exponent, VECTOR
    )
    expected = turn @ np.reshape(tangent, (2, 2)) @ turn.T
    assert turned == pytest.approx(expected.ravel(), abs=1e-12)


@given(deflections, st.floats(-3.0, 1.0).map(lambda x: 10.0**x), angles, exponents)
def test_slip_under_the_vector_law_never_gives_back_more_than_was_stored(
    deflection, length, angle, exponent
):
    places, weights = np.polynomial.legendre.leggauss(60)
    n = polar(1.0, angle)

    def after(part):
        slip = scaled(n, part * length)
        return update(deflection, slip, (0.0, 0.0), 1.0, exponent, VECTOR)[0]

    along = [np.dot(after(0.5 * (1.0 + place)), n) for place in places]
    work = 0.5 * length * np.dot(weights, along)
    stored = 0.5 * (np.square(after(1.0)).sum() - np.square(deflection).sum())
    # Half a permille: the quadrature crosses the limit reached by exponents below one.
    assert work - stored >= -5e-4 * length * (exponent < 1.0) - 1e-13


@given(deflections, slips, exponents)
def test_two_half_steps_of_the_vector_update_are_one_whole(deflection, slip, exponent):
    whole = advance(*deflection, *slip, 0.0, 0.0, exponent, VECTOR)
    half = scaled(slip, 0.5)
    middle = advance(*deflection, *half, 0.0, 0.0, exponent, VECTOR)
    halves = advance(*middle, *half, 0.0, 0.0, exponent, VECTOR)
    assert halves == pytest.approx(whole, abs=1e-12)


def difference(function, parts, place, step):
    """Central difference of a pair by one slip component; None next to a kink."""
    moved = []
    for times in (-2, -1, 0, 1, 2):
        changed = np.array(parts)
        changed[place] += times * step
        moved.append(np.array(function(*map(tuple, changed))))
    near = (moved[3] - moved[1]) / (2 * step)
    far = (moved[4] - moved[0]) / (4 * step)
    turn = (moved[3] - 2 * moved[2] + moved[1]) / step
    smooth = np.all(abs(near - far) < 3e-7) and np.all(abs(turn) < 1e-3)
    return near if smooth else None


@given(deflections, moderate_slips, moderate_slips, exponents, laws)
def test_the_tangents_are_the_derivatives_by_both_slip_parts(
    deflection, slip_1, slip_2, exponent, law
):
    parts = np.array([slip_1, slip_2])
    slip = parts.sum(axis=0)
    # The slip, and the asperity half-way through it, must have a direction.
    assume(np.hypot(*slip) > 1e-3 and np.hypot(*(deflection + 0.5 * slip)) > 1e-2)
    _, _, tangents = update(deflection, slip_1, slip_2, 1.0, exponent, law)
    step = 1e-5 * min(np.hypot(*slip_1), np.hypot(*slip_2), 1.0)
    for part, tangent in enumerate(tangents):
        for axis in (0, 1):
            measured = difference(
                lambda *moved: update(deflection, *moved, 1.0, exponent, law)[0],
                parts,
                (part, axis),
                step,
            )
            assume(measured is not None)
            assert tangent[axis::2] == pytest.approx(measured, abs=1e-6)


@pytest.mark.slow
@given(
    deflections, moderate_slips, moderate_slips, st.floats(1.0, 2.0), st.floats(0.1, 10.0),
    st.floats(0.0, 2.0), st.floats(0.0, 2.0), laws,
)  # fmt: skip
def test_the_lugre_tangents_are_the_derivatives_of_the_force_by_both_slip_parts(
    deflection, slip_1, slip_2, static_ratio, stribeck_speed, rate_damping, slip_damping, law
):
    parts = np.array([slip_1, slip_2])
    slip = parts.sum(axis=0)
    assume(np.hypot(*slip) > 1e-3 and np.hypot(*(deflection + 0.5 * slip)) > 1e-2)
    numbers = static_ratio, stribeck_speed, rate_damping, slip_damping, law
    _, _, tangents = lugre_update(deflection, slip_1, slip_2, 1.0, 1.0, *numbers)
    step = 1e-5 * min(np.hypot(*slip_1), np.hypot(*slip_2), 1.0)
    for part, tangent in enumerate(tangents):
        for axis in (0, 1):
            measured = difference(
                lambda *moved: lugre_update(deflection, *moved, 1.0, 1.0, *numbers)[1],
                parts,
                (part, axis),
                step,
            )
            assume(measured is not None)
            assert tangent[axis::2] == pytest.approx(measured, abs=1e-6)


@given(deflections, slips, slips, exponents, laws)
def test_opposite_slip_of_an_opposite_deflection_gives_the_opposite(
    deflection, slip_1, slip_2, exponent, law
):
    new, _, tangents = update(deflection, slip_1, slip_2, 1.0, exponent, law)
    other, _, other_tangents = update(
        scaled(deflection, -1.0), scaled(slip_1, -1.0), scaled(slip_2, -1.0), 1.0, exponent, law
    )
    assert other == scaled(new, -1.0)
    u = np.dot(deflection, slip_1), np.dot(deflection, slip_2)
    if law == VECTOR or all(abs(x) > 1e-9 for x in u):
        assert other_tangents == tangents


@given(deflections, slips, slips, exponents, laws)
def test_the_mirror_image_of_a_slip_gives_the_mirror_image(
    deflection, slip_1, slip_2, exponent, law
):
    new, _, _ = update(deflection, slip_1, slip_2, 1.0, exponent, law)
    mirrored = [(x, -y) for x, y in (deflection, slip_1, slip_2)]
    other, _, _ = update(*mirrored, 1.0, exponent, law)
    assert other == (new[0], -new[1])


@given(st.floats(-1.0, 1.0), st.floats(-8.0, 3.0), st.sampled_from([-1.0, 1.0]), angles)
def test_along_one_line_the_three_laws_are_one(start, size, sign, angle):
    deflection = polar(start, angle)
    slip = polar(sign * 10.0**size, angle)
    answers = [update(deflection, slip, (0.0, 0.0), 1.0, 1.0, law)[0] for law in LAWS.values()]
    assert answers[1] == pytest.approx(answers[0], abs=2e-15)
    assert answers[2] == pytest.approx(answers[0], abs=2e-15)


@given(deflections, moderate_slips, moderate_slips, exponents, laws, limits)
def test_the_update_knows_no_unit_of_length(deflection, slip_1, slip_2, exponent, law, limit):
    new, share, tangents = update(deflection, slip_1, slip_2, 1.0, exponent, law)
    metres = [scaled(v, limit) for v in (deflection, slip_1, slip_2)]
    new_m, share_m, tangents_m = update(*metres, limit, exponent, law)
    # Below an exponent of 1 the root of what is left to the limit magnifies rounding.
    slack = 1e-12 if exponent >= 1.0 or exponent == 0.0 else 1e-7
    assert share_m == pytest.approx(share, abs=slack)
    assert new_m == pytest.approx(scaled(new, limit), abs=slack * limit)
    # Next to a kink rounding of the input may choose the other side.
    assume(all(abs(np.dot(deflection, s)) > 1e-6 for s in (slip_1, slip_2)))
    assert np.ravel(tangents_m) == pytest.approx(np.ravel(tangents), abs=1e-6)


gives = st.one_of(st.just(0.0), st.floats(-6.0, 4.0).map(lambda x: 10.0**x))
free_slips = st.one_of(st.just((0.0, 0.0)), slips)


@given(free_slips, gives, gives)
def test_coulomb_friction_sticks_inside_the_disc_or_opposes_the_slip(free, give_x, give_y):
    x, y = project(*free, give_x, give_y, 0.0, 0.0)
    left = np.array([free[0] - give_x * x, free[1] - give_y * y])
    slip = np.hypot(*left)
    rounding = 1e-14 * (np.hypot(*free) + give_x + give_y)
    assert math.hypot(x, y) <= 1.0 + 1e-14
    if slip > 1e3 * rounding:
        assert (x, y) == pytest.approx(tuple(left / slip), abs=max(1e-9, 10 * rounding / slip))


@given(free_slips, free_slips, gives, gives)
def test_the_coulomb_projection_is_monotone(one, other, give_x, give_y):
    shares = [project(*free, give_x, give_y, 0.0, 0.0) for free in (one, other)]
    along = np.dot(np.subtract(one, other), np.subtract(*shares))
    assert along >= -1e-9 * (np.hypot(*one) + np.hypot(*other))
