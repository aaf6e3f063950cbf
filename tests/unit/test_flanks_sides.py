"""Both flanks at once: each in a thread of its own, with what holds for both."""

import threading

import pytest

from asperity.flanks.sides import both
from asperity.formulas import masking
from asperity.formulas.masks import _MASK


def test_both_are_found_at_the_same_time_in_their_order():
    together = threading.Barrier(2, timeout=60.0)
    found = both(lambda side: (together.wait() >= 0, side))
    assert [*found] == [1, -1]
    assert found == {1: (True, 1), -1: (True, -1)}


def test_what_holds_where_they_are_asked_for_holds_for_both():
    with masking():
        found = both(lambda side: _MASK.get())
        assert found[1] is found[-1] is not None


@pytest.mark.parametrize("bad", [(1,), (-1,), (1, -1)])
def test_the_error_is_that_of_the_first_flank_that_has_one(bad):
    def refusing(side):
        if side in bad:
            raise ValueError(f"flank {side}")
        return side

    with pytest.raises(ValueError, match=f"flank {bad[0]}"):
        both(refusing)
