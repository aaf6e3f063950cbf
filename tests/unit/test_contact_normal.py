"""Laws of pressure against overclosure."""

import numpy as np
import pytest

from asperity.contact.normal import NormalLaw, aimed_overclosure, pressure
from asperity.errors import InputError

STIFF = 4e14
TWO = NormalLaw("two-stage", STIFF, 0.1 * STIFF, 2e-9, 6e-9)
LAWS = {
    "linear": (NormalLaw("linear", STIFF), 0.0),
    "two-stage": (TWO, 0.0),
    "hard": (NormalLaw("hard", STIFF), 3e5),
}


@pytest.mark.parametrize("name", LAWS)
def test_pressure_is_never_negative_grows_and_has_the_slope_it_says(name):
    law, multiplier = LAWS[name]
    overs = np.linspace(-5e-9, 2e-8, 401)
    values = np.array([pressure(over, multiplier, law.parameters) for over in overs])
    assert (values[:, 0] >= 0.0).all()
    assert (np.diff(values[:, 0]) >= 0.0).all()
    between = np.diff(values[:, 0]) / np.diff(overs)
    least = np.minimum(values[:-1, 1], values[1:, 1])
    most = np.maximum(values[:-1, 1], values[1:, 1])
    assert (between >= least * (1 - 1e-6) - 1.0).all()
    assert (between <= most * (1 + 1e-6) + 1.0).all()


def test_the_linear_law_is_proportional_to_the_overclosure_and_opens():
    law = NormalLaw("linear", STIFF).parameters
    assert pressure(3e-9, 0.0, law) == pytest.approx((STIFF * 3e-9, STIFF))
    assert pressure(-1e-12, 0.0, law) == (0.0, 0.0)


def test_the_two_stage_law_is_soft_first_stiff_last_and_smooth_between():
    law = TWO.parameters
    assert pressure(1e-9, 0.0, law) == pytest.approx((0.1 * STIFF * 1e-9, 0.1 * STIFF))
    assert pressure(2e-8, 0.0, law)[1] == STIFF
    # In the transition the stiffness rises linearly: the pressure grows by its mean.
    gained = pressure(6e-9, 0.0, law)[0] - pressure(2e-9, 0.0, law)[0]
    assert gained == pytest.approx(0.55 * STIFF * 4e-9)
    for joint in (2e-9, 6e-9):
        below, above = (pressure(joint * (1 + e), 0.0, law) for e in (-1e-9, 1e-9))
        assert below == pytest.approx(above, rel=1e-6)


def test_the_hard_law_bears_its_multiplier_without_overclosure():
    law = NormalLaw("hard", STIFF).parameters
    assert pressure(0.0, 3e5, law) == (3e5, STIFF)
    assert pressure(-3e5 / STIFF * 1.001, 3e5, law) == (0.0, 0.0)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("give", [1e12, 4e14, 1e17])
def test_an_aimed_overclosure_meets_its_aim(name, give):
    law, multiplier = LAWS[name]
    for aim in np.concatenate([-np.logspace(2, 9, 15), np.logspace(2, 9, 15)]):
        over = aimed_overclosure(aim, give, multiplier, law.parameters)
        value, _ = pressure(over, multiplier, law.parameters)
        assert value + give * over == pytest.approx(aim, rel=1e-9)


def test_two_stages_follow_from_the_size_of_the_elements():
    law = NormalLaw.two_stage(STIFF, 5e-3)
    assert (law.initial, law.start, law.end) == pytest.approx((0.1 * STIFF, 5e-5, 1.5e-4))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"name": "soft", "stiffness": 1.0}, "'linear', 'two-stage', 'hard'"),
        ({"stiffness": 0.0}, "positive"),
        ({"stiffness": np.nan}, "positive"),
        ({"name": "two-stage", "stiffness": 1.0, "initial": 2.0, "end": 1.0}, "at most"),
        ({"name": "two-stage", "stiffness": 1.0, "initial": 0.5, "start": 2.0, "end": 1.0}, "<"),
    ],
)
def test_a_law_that_cannot_be_is_refused(given, says):
    with pytest.raises(InputError, match=says):
        NormalLaw(**given)
