"""Where the arrays of lanes stand: how fast they march depends on it."""

import pytest

from asperity.arrays import zeros_in_lines
from asperity.slider.batch import _arrays
from asperity.slider.batch_kernels import BLOCK
from asperity.slider.batch_rows import ROWS, WIDTH

LINE = 64


def place(numbers):
    return numbers.__array_interface__["data"][0]


@pytest.mark.parametrize("count", [1, 7, 8, 1760])
def test_zeros_in_lines_begin_where_a_line_of_the_cache_does(count):
    # Held together, so that each gets another place.
    every = [zeros_in_lines(count) for _ in range(20)]
    for numbers in every:
        assert numbers.shape == (count,)
        assert numbers.flags.c_contiguous
        assert not numbers.any()
        assert place(numbers) % LINE == 0


@pytest.mark.parametrize("pressed", [False, True])
def test_increments_stand_behind_the_buffer_of_lanes(pressed):
    buffer, increments, rises = _arrays(pressed=pressed)
    assert [each.size for each in (buffer, increments, rises)] == [
        ROWS * WIDTH,
        BLOCK * WIDTH,
        (BLOCK + 1) * WIDTH if pressed else 0,
    ]
    filled = [place(each) for each in (buffer, increments, rises) if each.size]
    assert filled == sorted(filled)
    assert [each % LINE for each in filled] == [0] * len(filled)
