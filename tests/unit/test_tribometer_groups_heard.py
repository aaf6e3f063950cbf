"""Levels of a signal by groups of blocks, in which what changes on the way is sought."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard.drive import groups


def test_a_level_over_a_group_is_the_root_of_its_mean_square():
    deviations = np.repeat([0.3, 0.4, 9.0], [10, 10, 4])
    deviations[:10:2] = 0.5
    blocks = SimpleNamespace(length=0.02, deviations={"drive_voltage": deviations})
    found = groups(SimpleNamespace(blocks=blocks), "drive_voltage", Stretch(0, 20))
    assert found == pytest.approx([np.sqrt(0.5 * (0.3**2 + 0.5**2)), 0.4], rel=1e-14)
    short = groups(SimpleNamespace(blocks=blocks), "drive_voltage", Stretch(12, 15))
    assert short == pytest.approx([0.4], rel=1e-14)
