"""The frame of patches about what bears: no more than one coarse patch beside it and a margin."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.resolved.strip import Frame, Strip


@pytest.mark.parametrize(
    ("bears", "ends"),
    [
        # Patches of 0.1 by 0.2 mm, from -1 to 1 mm across and from 0 to 4 mm along.
        ([(4, 7)], ((-0.7, -0.4), (1.2, 1.8))),
        ([(4, 7), (6, 11)], ((-0.7, -0.2), (1.2, 2.6))),
        ([(0, 19)], ((-1.1, -0.8), (3.6, 4.2))),
    ],
)
def test_a_cropped_frame_holds_what_bears_and_a_coarse_patch_beside_it(bears, ends):
    x, y = -0.95e-3 + 0.1e-3 * np.arange(20), 0.1e-3 + 0.2e-3 * np.arange(20)
    coarse = Frame(np.zeros(3), np.eye(3), x, y)
    bearing = np.zeros((20, 20), dtype=bool)
    bearing[tuple(np.transpose(bears))] = True
    frame = Strip.cropped(SimpleNamespace(frame=coarse), bearing.ravel(), (15, 31))
    assert frame.shape == (15, 31)
    for middles, spacing, (low, high) in zip(
        (frame.x, frame.y), frame.spacing, 1e-3 * np.array(ends), strict=True
    ):
        # A fiftieth of it to either side.
        margin = 0.02 * (high - low)
        assert middles[0] - 0.5 * spacing == pytest.approx(low - margin, abs=1e-12)
        assert middles[-1] + 0.5 * spacing == pytest.approx(high + margin, abs=1e-12)
