"""The path of a vibrating contact, against the mean of its speed over a cycle."""

import math

import numpy as np
import pytest

from asperity.tribometer.reduction.wear import path_share


@pytest.mark.parametrize("k", [0.0, 0.5, 1.0, 1.02, 1.09, 2.0, 7.0])
def test_the_path_is_the_mean_of_the_sliding_speed(k):
    phase = 2.0 * math.pi * (np.arange(200_000) + 0.5) / 200_000
    along = np.abs(1.0 - k * np.cos(phase)).mean()
    across = np.hypot(1.0, k * np.cos(phase)).mean()
    assert path_share(k, "longitudinal") == pytest.approx(along, rel=1e-6)
    assert path_share(k, "transverse") == pytest.approx(across, rel=1e-6)
