"""A part of a duty is like the rated load where its speed and its torque are the same numbers."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.rating.agma6034.rating import _is_alike


def load(speed, torque):
    return SimpleNamespace(worm_speed=speed, output_torque=torque)


@pytest.mark.parametrize(
    ("part", "alike"),
    [
        (load(150.0, 300.0), True),
        (load(150.0, 301.0), False),
        (load(151.0, 300.0), False),
        (load(np.array([150.0]), 300.0), False),
        (load(150.0, np.array([300.0])), False),
        (load(np.float64(150.0), 300.0), False),
    ],
)
def test_only_the_same_speed_and_torque_are_alike(part, alike):
    assert _is_alike(part, load(150.0, 300.0)) is alike
