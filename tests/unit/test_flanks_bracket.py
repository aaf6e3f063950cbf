"""The least value between three places: how the bracket narrows, and what it ends at."""

import numpy as np
import pytest

from asperity.flanks.wheel.cutting.bracket import minimum, next_place


@pytest.mark.parametrize("middle", [0.2, 0.8])
def test_a_bracket_that_is_slow_to_shrink_is_cut_in_its_longer_part(middle):
    longer, way = max(middle, 1.0 - middle), 1.0 if middle < 0.5 else -1.0
    golden = 0.5 * (3.0 - 5.0**0.5)
    for values in ((1.0, 0.0, 1.0), (5.0, 4.9, 300.0)):
        a, b, c = values
        place = next_place(0.0, a, middle, b, 1.0, c, 1e-9, True)
        assert place == pytest.approx(middle + way * golden * longer, rel=1e-12)


@pytest.mark.parametrize("end", [-1.0, 1.0])
@pytest.mark.parametrize("sharp", [1.0, 1e2, 1e6])
def test_the_least_value_of_what_bends_sharply_at_one_end_is_found(sharp, end):
    found = {}

    def function(x):
        found[x] = (x - 0.1) ** 2 + sharp * max(end * (x - 0.1), 0.0) ** 2
        return found[x]

    a, b, c = -1.0, 0.1 - 0.05 * end, 1.3
    place, value = minimum(
        function, (), a, function(a), b, function(b), c, function(c), 1e-6, 100, -np.inf
    )
    assert place == pytest.approx(0.1, abs=2e-6)
    assert value == found[place] == min(found.values())
    assert all(a <= x <= c for x in found)
    assert len(found) < 60
