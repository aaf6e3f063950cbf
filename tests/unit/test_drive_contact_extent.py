"""Length and width of what bears on a tooth: of Hertz's ellipse, and of a line that is bent."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.resolved.pressures import ToothPressure


def extent(bears):
    x, y = np.linspace(-1.0, 1.0, 401), np.linspace(-10.0, 10.0, 401)
    spacing = x[1] - x[0], y[1] - y[0]
    frame = SimpleNamespace(x=x, y=y, shape=(len(x), len(y)), spacing=spacing)
    force = bears(*np.meshgrid(x, y, indexing="ij")).ravel().astype(float)
    area = np.full(force.size, (x[1] - x[0]) * (y[1] - y[0]))
    strip = SimpleNamespace(frame=frame, area=area)
    return ToothPressure(0, strip, force, force).extent()


def test_an_ellipse_has_its_own_axes():
    turn = 0.02
    c, s = np.cos(turn), np.sin(turn)

    def bears(x, y):
        return ((c * x - s * y) / 0.3) ** 2 + ((s * x + c * y) / 6.0) ** 2 < 1.0

    # Patches are 0.05 long and 0.005 wide.
    assert extent(bears) == pytest.approx((12.0, 0.6), rel=1e-2)


@pytest.mark.parametrize("turn", [0.0, 0.05])
def test_a_straight_band_has_its_own_edges(turn):
    c, s = np.cos(turn), np.sin(turn)

    def bears(x, y):
        return (np.abs(c * x - s * y) < 0.2) & (np.abs(s * x + c * y) < 7.0)

    assert extent(bears) == pytest.approx((14.0, 0.4), rel=0.02)


def test_a_contact_across_the_patches_is_as_long_as_along_them():
    def bears(x, y):
        return (x / 0.9) ** 2 + (y / 0.3) ** 2 < 1.0

    assert extent(bears) == pytest.approx((1.8, 0.6), rel=0.06)


def test_a_bent_line_is_no_wider_than_its_band():
    def bears(x, y):
        return np.abs(x - 0.8 * np.sin(np.pi * y / 20.0)) < 0.125

    length, width = extent(bears)
    assert length == pytest.approx(np.hypot(20.0, 1.6), rel=0.01)
    assert width == pytest.approx(0.25, rel=0.02)


def test_nothing_that_bears_has_no_extent():
    assert extent(lambda x, y: x > 5.0) == (0.0, 0.0)
