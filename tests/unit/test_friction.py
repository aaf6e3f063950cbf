import math

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.contact.interface.friction import PointFriction
from asperity.errors import InputError
from asperity.friction import KEEPS, LAWS, SPLIT, UNSPLIT, VECTOR, Friction, update
from asperity.friction.coulomb import mean_share, project
from asperity.friction.dahl import (
    OVERSHOOT_BOUND,
    SERIES_BOUND,
    advance,
    inverse_root,
    relaxation,
    relaxation_gain,
)
from asperity.kernels.compiled import kernel

pytestmark = pytest.mark.usefixtures("plain_kernels")

EXPONENTS = [*np.array([0.0, 0.5, 1.0, 1.5, 2.0])]
NOTHING = (0.0, 0.0)


def refusal(**entries):
    with pytest.raises(InputError) as raised:
        Friction(**entries, units="SI")
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def one_sided(function, at, direction, step=1e-5):
    """Forward difference of third order along a direction."""
    f = [np.array(function(np.add(at, n * step * np.array(direction)))) for n in range(4)]
    return (-11 * f[0] + 18 * f[1] - 9 * f[2] + 2 * f[3]) / (6 * step)


def matrices(deflection, slip_1, slip_2, exponent, law):
    _, _, tangents = update(deflection, slip_1, slip_2, 1.0, exponent, law)
    return [np.reshape(tangent, (2, 2)) for tangent in tangents]


@pytest.mark.parametrize("law", LAWS.values())
def test_an_iteration_moves_no_history(law):
    committed = (3e-8, -2e-8)
    slips = (4e-8, 1e-8), (0.0, 5e-8)
    first = update(committed, *slips, 7e-8, 1.0, law)
    for trial in ((9e-8, 0.0), (-3e-7, 1e-8), NOTHING):
        update(committed, trial, slips[1], 7e-8, 1.0, law)
    assert update(committed, *slips, 7e-8, 1.0, law) == first


@pytest.mark.parametrize("law", LAWS.values())
def test_the_force_share_is_the_deflection_over_the_limit(law):
    new, share, _ = update((1e-8, 0.0), (3e-8, 2e-8), (0.0, 1e-8), 5e-8, 1.0, law)
    assert np.multiply(share, 5e-8) == pytest.approx(np.array(new), rel=1e-15)


def test_only_split_tells_the_two_slip_parts_apart():
    deflection, parts = (0.3, 0.2), ((-0.6, 0.1), (0.5, 0.1))
    together = tuple(np.sum(parts, axis=0))
    for law in (UNSPLIT, VECTOR):
        apart, _, tangents = update(deflection, *parts, 1.0, 1.0, law)
        assert apart == pytest.approx(update(deflection, together, NOTHING, 1.0, 1.0, law)[0])
        assert tangents[0] == tangents[1]
    apart, _, tangents = update(deflection, *parts, 1.0, 1.0, SPLIT)
    joined = update(deflection, together, NOTHING, 1.0, 1.0, SPLIT)[0]
    assert math.dist(apart, joined) > 0.01
    assert tangents[0] != tangents[1]


@pytest.mark.parametrize("law", LAWS.values())
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_with_its_tangents_the_update_goes_where_it_goes_without_to_the_last_bit(exponent, law):
    random = np.random.default_rng(6)
    for _ in range(20):
        s, slip = random.uniform(-0.7, 0.7, 2), random.standard_normal(4)
        new, share, _ = update(
            tuple(7.0 * s), *map(tuple, 7.0 * slip.reshape(2, 2)), 7.0, exponent, law
        )
        wanted = advance(*(7.0 * s / 7.0), *(7.0 * slip / 7.0), exponent, law)
        assert share == wanted
        assert new == tuple(7.0 * np.array(wanted))


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS.values())
def test_a_compiled_contact_can_call_the_update(law):
    @kernel
    def contact(deflections, slip, limit, exponent, law):
        stiffness = 0.0
        for n in range(len(deflections)):
            here = (deflections[n, 0], deflections[n, 1])
            new, _, tangents = update(here, slip, (0.0, 0.0), limit, exponent, law)
            deflections[n, 0], deflections[n, 1] = new
            stiffness += tangents[0][0]
        return stiffness

    deflections = np.array([[0.0, 0.0], [0.2, 0.3], [-0.6, 0.1]])
    expected = [update(tuple(s), (0.1, 0.2), NOTHING, 1.0, 1.0, law) for s in deflections]
    stiffness = contact(deflections, (0.1, 0.2), 1.0, 1.0, law)
    assert deflections == pytest.approx(np.array([new for new, _, _ in expected]), abs=1e-15)
    assert stiffness == pytest.approx(sum(t[0][0] for _, _, t in expected), abs=1e-15)


@pytest.mark.parametrize("law", LAWS.values())
@pytest.mark.parametrize("exponent", EXPONENTS)
def test_no_slip_changes_nothing(law, exponent):
    new, _, _ = update((0.6, -0.2), NOTHING, NOTHING, 1.0, exponent, law)
    assert new == (0.6, -0.2)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("law", LAWS.values())
def test_steady_sliding_stays_at_the_limit(law, exponent):
    at_limit = (0.6, 0.8)
    for length in (1e-6, 0.3, 50.0):
        slip = (0.6 * length, 0.8 * length)
        new, _, _ = update(at_limit, slip, NOTHING, 1.0, exponent, law)
        assert new == pytest.approx(at_limit, abs=1e-7 if exponent == 0.5 else 1e-14)


@pytest.mark.parametrize("exponent", EXPONENTS)
def test_in_steady_sliding_the_vector_tangent_turns_the_friction_with_the_slip(exponent):
    (along, across), (turned, turning) = matrices(
        (1.0, 0.0), (2.0, 0.0), NOTHING, exponent, VECTOR
    )[0]
    # s1 = n - g(rho) w with rho -> 0: g is 0 below, exp(-L) at and 1 above an exponent of 1.
    left = 0.0 if exponent < 1.0 else math.exp(-2.0) if exponent == 1.0 else 1.0
    assert (along, across, turned) == pytest.approx((0.0, 0.0, 0.0), abs=1e-15)
    assert turning == pytest.approx((1.0 - left) / 2.0, abs=1e-15)


@pytest.mark.parametrize("exponent", EXPONENTS)
@pytest.mark.parametrize("length", [1e-6, 1e-9, 1e-12, 1e-15, 1e-100])
def test_for_a_small_slip_the_vector_tangent_goes_to_its_one_sided_limit(exponent, length):
    s, n = np.array([0.3, 0.4]), np.array([math.cos(0.7), math.sin(0.7)])
    w, across = n - s, np.eye(2) - np.outer(n, n)
    rho = np.hypot(*w)
    limit = rho ** (exponent - 1.0) * (
        across + np.outer(w, n) + (exponent - 1.0) / rho**2 * np.outer(w, across @ w)
    )
    tangent = matrices(tuple(s), tuple(length * n), NOTHING, exponent, VECTOR)[0]
    assert tangent == pytest.approx(limit, abs=3.0 * length + 1e-14)


def test_at_no_slip_the_vector_tangent_is_the_mean_of_its_two_sides():
    s = (0.5, -0.7)
    (tangent, _) = matrices(s, NOTHING, NOTHING, 1.0, VECTOR)
    for direction in ((1.0, 0.0), (0.0, 1.0), (0.6, -0.8)):
        sides = [
            sign
            * one_sided(
                lambda d: update(s, tuple(d), NOTHING, 1.0, 1.0, VECTOR)[0],
                NOTHING,
                sign * np.array(direction),
            )
            for sign in (1.0, -1.0)
        ]
        assert tangent @ direction == pytest.approx(np.mean(sides, axis=0), abs=1e-9)


KINKS = {
    "no slip, split": ((0.5, -0.3), NOTHING, NOTHING, SPLIT),
    "no slip, unsplit": ((0.5, -0.3), NOTHING, NOTHING, UNSPLIT),
    "the first part across the asperity": ((0.4, 0.0), (0.0, 0.0), (0.2, 0.1), SPLIT),
    "the second part across the asperity": ((0.4, 0.0), (0.2, 0.1), (0.0, 0.0), SPLIT),
    "the slip reverses along the asperity": ((0.5, 0.0), (-0.2, 0.4), NOTHING, UNSPLIT),
    "the deflection reaches the limit": ((1.0, 0.0), (1.0, 0.0), NOTHING, UNSPLIT),
}


@pytest.mark.parametrize("part", [0, 1])
@pytest.mark.parametrize("kink", KINKS.values(), ids=KINKS)
def test_at_a_kink_the_tangent_is_the_derivative_on_one_of_its_sides(kink, part):
    deflection, slip_1, slip_2, law = kink
    tangent = matrices(deflection, slip_1, slip_2, 1.0, law)[part]

    def moved(slip):
        parts = [slip_1, slip_2]
        parts[part] = tuple(slip)
        return update(deflection, *parts, 1.0, 1.0, law)[0]

    at = (slip_1, slip_2)[part]
    for direction in ((1.0, 0.0), (0.0, 1.0)):
        # One linear map serves the sides that belong to one branch; an axis may look into either.
        sides = [sign * one_sided(moved, at, sign * np.array(direction)) for sign in (1.0, -1.0)]
        error = min(np.abs(tangent @ direction - side).max() for side in sides)
        assert error < 1e-6


@pytest.mark.parametrize("decay", [1e-12, 1e-4, 0.1, 0.3, SERIES_BOUND, 0.5000001, 1.0, 30.0, 1e3])
def test_the_relaxation_is_exact_to_rounding(decay):
    left, gain = relaxation(decay)
    assert left == pytest.approx(math.exp(-decay), abs=1e-15)
    assert gain == pytest.approx(-math.expm1(-decay) / decay, rel=1e-15)


def test_the_series_of_the_lanes_stays_accurate_beyond_its_bound():
    for decay, error in ((0.5, 2e-16), (1.0, 1e-13), (2.0, 1e-9)):
        assert relaxation_gain(decay) == pytest.approx(-math.expm1(-decay) / decay, rel=error)
    for over in (0.0, 0.006, 0.01, OVERSHOOT_BOUND):
        assert inverse_root(over) == pytest.approx(1.0 / math.sqrt(1.0 + over), rel=1e-12)


def test_a_body_that_is_pushed_less_than_friction_sticks():
    # The free slip 0.3 and -0.2, of which a full friction force could take 0.5 and 1.0.
    assert project(0.3, -0.2, 0.5, 1.0, 0.0, 0.0) == pytest.approx((0.6, -0.2))


def test_a_body_that_is_pushed_harder_slips_against_full_friction():
    x, y = project(3.0, 4.0, 0.5, 0.5, 0.0, 0.0)
    assert (x, y) == pytest.approx((0.6, 0.8), abs=1e-15)


def test_without_a_slip_or_anything_that_gives_the_last_friction_stays():
    assert project(0.0, 0.0, 0.0, 0.0, 0.6, -0.8) == (0.6, -0.8)
    assert project(0.0, 0.0, 0.5, 0.0, 0.6, -0.8) == (0.0, 0.0)


def test_a_slip_prescribed_along_one_axis_takes_all_friction_from_a_body_free_across():
    # Nothing stops the slip along the drive, so the body is free to stick across only in part.
    x, y = project(1.0, 0.5, 0.0, 2.0, 0.0, 0.0)
    slip = (1.0, 0.5 - 2.0 * y)
    assert (x, y) == pytest.approx(tuple(np.array(slip) / np.hypot(*slip)), abs=1e-12)
    assert project(1.0, 0.0, 0.0, 2.0, 0.0, 0.0) == (1.0, 0.0)


def pushed(before, free, give):
    """Mean share of a steady push: the slip's sign until it stops, then what holds it or may."""
    push, sign = free - before, math.copysign(1.0, before)
    rate = push - give * sign
    stop = min(-before / rate, 1.0) if before * rate < 0.0 else 1.0
    return stop * sign + (1.0 - stop) * max(-1.0, min(push / give, 1.0))


@pytest.mark.parametrize("before", [-1.0, 0.4, 1.0])
@pytest.mark.parametrize("free", [-3.0, -0.6, -0.2, 0.3, 0.9, 2.5])
@pytest.mark.parametrize("give", [1e-9, 0.3, 1.0, 2.0])
def test_along_a_line_the_mean_share_is_that_of_a_steady_push(before, free, give):
    share, across = mean_share(before, 0.0, free, 0.0, give, give, 0.0, 0.0, 0.0, 0.0)
    assert share == pytest.approx(pushed(before, free, give), abs=1e-12)
    assert across == 0.0


def test_where_the_slip_velocity_jumps_both_sides_count_half():
    assert mean_share(-1.0, 0.0, 3.0, 0.0, 0.0, 0.0, -4.0, 0.0, 0.0, 0.0) == (0.0, 0.0)
    assert mean_share(0.0, 2.0, 3.0, 0.0, 0.0, 0.0, -3.0, 2.0, 0.0, 0.0) == (0.5, 0.5)


def test_a_contact_that_sticks_up_to_a_corner_holds_what_it_held_till_then():
    # Rounding is no slip, whichever way it points.
    for rest in (0.0, 1e-13, -1e-13):
        share, _ = mean_share(rest, 0.0, 50.0, 0.0, 0.1, 0.0, -50.0, 0.0, -0.4, 0.0)
        assert share == pytest.approx(0.5 * (-0.4 + 1.0), abs=1e-12)


def way_in_parts(slip, push, give, across, parts):
    """How far a contact slips in a step while a steady push and friction act on it."""
    way = 0.0
    for _ in range(parts):
        before = slip
        free = slip + push / parts
        share, _ = project(free, across, give / parts, 0.0, 0.0, 0.0)
        slip = free - give / parts * share
        way += 0.5 * (before + slip) / parts
    return way


@pytest.mark.parametrize(
    ("give", "push", "jump", "across"),
    grid([0.3, 1.0, 5.0], [-0.3, 0.0, 0.6], [-6.0, -0.4, 0.3, 1.5], [0.0, 0.7], ordinary=5),
)
def test_after_a_corner_the_way_of_the_step_is_right(give, push, jump, across):
    before = 0.8
    share, _ = mean_share(
        before, 0.0, before - jump + push * give, across, give, 0.0, jump, -across, 0.0, 0.0
    )
    start = before - jump + 0.5 * give * (push - 1.0)
    way = way_in_parts(start, push * give, give, across, 2_000)
    assert before - jump + (push - share) * give == pytest.approx(way, abs=0.02 * give)


def test_where_the_slip_velocity_turns_steadily_the_mean_share_is_its_mean_direction():
    ways = np.linspace([0.3, 1.0], [0.5, 0.9], 100_001)
    mean = np.mean(ways / np.hypot(*ways.T)[:, None], axis=0)
    share = mean_share(0.3, 1.0, 0.5, 0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert share == pytest.approx(tuple(mean), abs=4e-3)
    # A quarter of the error for half the turn: order two.
    near = np.linspace([0.3, 1.0], [0.4, 0.95], 100_001)
    closer = np.mean(near / np.hypot(*near.T)[:, None], axis=0)
    half = mean_share(0.3, 1.0, 0.4, 0.95, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    assert math.dist(half, closer) < 0.3 * math.dist(share, mean)


def test_stiffness_and_deflection_limit_are_two_forms_of_one_thing():
    by_limit = Friction(mu=0.1, max_deflection=68.75e-9, units="SI")
    by_stiffness = Friction(mu=0.1, tangential_stiffness=80e6, units="SI")
    assert by_limit.stiffness(55.0) == pytest.approx(80e6, rel=1e-12)
    assert by_stiffness.deflection_limit(55.0) == pytest.approx(68.75e-9, rel=1e-12)


def test_a_law_is_known_by_its_name():
    assert [
        Friction(mu=0.1, max_deflection=1e-7, law=law, units="SI").law_code for law in LAWS
    ] == [
        SPLIT,
        UNSPLIT,
        VECTOR,
    ]


@pytest.mark.parametrize("model", ["dahl", "lugre"])
def test_an_elastic_model_needs_a_limit_or_a_stiffness(model):
    assert "max_deflection is missing" in refusal(model=model, mu=0.1)
    assert "tangential_stiffness" in refusal(
        model=model, mu=0.1, max_deflection=1e-7, tangential_stiffness=1e7
    )


@pytest.mark.parametrize("key", ["mu", "max_deflection", "tangential_stiffness"])
def test_nothing_that_carries_the_friction_may_be_zero(key):
    entries = {"max_deflection": 1e-7} if key == "mu" else {"mu": 0.1}
    assert f"friction.{key}" in refusal(**entries, **{key: 0.0})


def test_coulomb_friction_needs_no_limit_and_has_none():
    friction = Friction(model="coulomb", mu=0.1)
    with pytest.raises(InputError, match="Coulomb friction has no deflection"):
        friction.deflection_limit(55.0)


@pytest.mark.parametrize(
    ("entries", "message"),
    [
        ({"contact_damping": 1.0}, "friction.contact_damping is for model 'lugre'"),
        ({"static_mu": 0.2}, "friction.static_mu is for model 'lugre'"),
        ({"model": "lugre", "exponent": 2.0}, "LuGre knows exponent 1 only"),
        ({"model": "lugre", "static_mu": 0.05}, "must not be below friction.mu"),
        ({"model": "lugre", "static_mu": 0.2}, "friction.stribeck_velocity must be given"),
        ({"exponent": -1.0}, "friction.exponent"),
        ({"transfer": 1.5}, "friction.transfer"),
        ({"law": "spilt"}, "friction.law"),
    ],
)
def test_friction_that_makes_no_sense_is_refused(entries, message):
    assert message in refusal(mu=0.1, max_deflection=1e-7, **entries)


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ({"model": "springs", "exponent": 0.5}, "friction.exponent is 0.5; springs have none"),
        ({"model": "springs", "law": "split"}, "friction.law is 'split'; springs"),
        ({"model": "springs", "keeps": "deflection"}, "springs keep their stiffness"),
        ({"model": "dahl", "springs": 8}, "friction.springs is for model 'springs'"),
        ({"model": "springs", "springs": 0}, "friction.springs is 0"),
        ({"model": "springs", "springs": 257}, "friction.springs is 257"),
        ({"model": "springs", "springs": 8.5}, "friction.springs is 8.5"),
        ({"load_exponent": 0.0}, "friction.load_exponent is 0"),
        ({"load_exponent": 2.5}, "friction.load_exponent is 2.5"),
        ({"keeps": "all"}, "friction.keeps is 'all'"),
    ],
)
def test_springs_and_loads_are_checked(entries, words):
    assert words in refusal(mu=0.1, max_deflection=1e-7, **entries)


def test_coulomb_friction_has_no_stiffness_to_keep():
    assert "do not deflect" in refusal(model="coulomb", mu=0.1, keeps="stiffness")
    assert Friction(model="coulomb", mu=0.1, keeps="deflection").model == "coulomb"


@pytest.mark.parametrize("model", ["dahl", "lugre"])
def test_an_asperity_keeps_its_stiffness_unless_told(model):
    assert (
        Friction(model=model, mu=0.1, max_deflection=1e-7, units="SI").keeps_code
        == KEEPS["stiffness"]
    )
    kept = Friction(model=model, mu=0.1, max_deflection=1e-7, keeps="deflection", units="SI")
    assert kept.keeps_code == KEEPS["deflection"]


def test_a_point_of_a_contact_takes_its_limit_at_the_mean_pressure_unless_the_deflection_stays():
    def reference(model="dahl", two_phase=False, **entries):
        table = Friction(model=model, mu=0.1, max_deflection=1e-7, **entries, units="SI")
        return PointFriction.of(table, 55.0, area=1e-3, two_phase=two_phase).reference

    assert reference() == reference("lugre") == pytest.approx(55e3, rel=1e-15)
    assert reference(keeps="deflection") == reference("lugre", keeps="deflection") == 0.0
    assert reference("coulomb") == reference(two_phase=True, law="split") == 0.0
    with pytest.raises(InputError, match="'two-phase' keeps the deflection"):
        reference(two_phase=True, law="split", keeps="stiffness")
    with pytest.raises(InputError, match="take 'dahl' of exponent 0"):
        reference("springs")
    with pytest.raises(InputError, match="proportional to the pressure"):
        reference(load_exponent=0.5)
