"""What an increment begins with: the last ones continued."""

import numpy as np
import pytest

from asperity.contact.increment.predictor import Predictor

MARK = (1e-6, 2.0)
VECTORS = np.array([1.0, -2.0, 0.5])


def followed(path, count, mark=MARK):
    predictor = Predictor()
    for time in range(count):
        predictor = predictor.followed_by(path(time) * VECTORS, -path(time) * VECTORS, mark)
    return predictor


@pytest.mark.parametrize("unit", [1.0, 1e-9])
@pytest.mark.parametrize(
    ("path", "order"),
    [(lambda t: 3.0, 0), (lambda t: 3.0 - t, 1), (lambda t: 3.0 - t + t * t, 2)],
    ids=["constant", "linear", "quadratic"],
)
def test_a_path_is_continued_to_the_order_it_has(path, order, unit):
    """Which order it has does not depend on the unit: forces of light loads are tiny."""
    predictor = followed(lambda t: unit * path(t), 5)
    assert predictor.order == order
    force, displacement = predictor.predicted(MARK)
    np.testing.assert_allclose(force, unit * path(5) * VECTORS, rtol=1e-13)
    np.testing.assert_allclose(displacement, -unit * path(5) * VECTORS, rtol=1e-13)


def test_a_path_is_continued_no_further_than_its_past_allows():
    force, _ = followed(lambda t: 1.0 + t, 1).predicted(MARK)
    assert force == pytest.approx(VECTORS)
    force, _ = followed(lambda t: 1.0 + t * t, 2).predicted(MARK)
    assert force == pytest.approx(2.0 * VECTORS)


def test_another_step_begins_without_a_past():
    predictor = followed(lambda t: 1.0 + t, 4)
    assert predictor.predicted((2e-6, 2.0)) is None
    other = predictor.followed_by(VECTORS, VECTORS, (2e-6, 2.0))
    assert len(other.forces) == 1
