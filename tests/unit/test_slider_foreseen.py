"""Means that go to a state much faster than its modes would take them there."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.slider.foreseen import _outruns
from asperity.slider.nearby import Nearby


def outruns(growth=0.9999, size=0.5, change=0.1):
    """When a mean of 0.4 is at a state of 0.9, of 100 Hz after 1 s, that goes so far in 25 cycles.

    The state has one mode.
    """
    end = Nearby(0.9, np.array([growth], complex), np.array([size]), linear=False)
    window = SimpleNamespace(
        model=SimpleNamespace(duration=1.0, frequency=100.0),
        table=SimpleNamespace(cycles=50),
        quarters=(0.25, 0.3, 0.35, 0.4),
        change=change,
    )
    return _outruns(window, end)


def test_it_is_there_when_it_has_gone_on_as_it_goes():
    # 0.004 a cycle, of which the mode would have 5e-5: 125 cycles.
    assert outruns() == pytest.approx(1.0 + 1.25)


@pytest.mark.parametrize(
    "other",
    [
        {"change": -0.1},  # it goes the other way
        {"change": 0.0},
        {"growth": 0.9},  # its mode goes as fast
        {"growth": 0.9999 * np.exp(1e-4j)},  # that turns
        {"size": 0.2},  # something else takes it most of the way
    ],
)
def test_else_its_modes_tell(other):
    assert outruns(**other) is None
