"""Where a worm stands to a tooth, and how its material moves past it, by rigid motions alone."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.teeth.placing import Stand, place_worm, sliding, to_space

pytestmark = pytest.mark.usefixtures("plain_kernels")

# Axes of a worm that lies askew over its wheel, as its mounting may have it.
TILT = 0.02
STAND = Stand(
    np.array([
        [0.0, 1.0, 0.0],
        [math.sin(TILT), 0.0, math.cos(TILT)],
        [math.cos(TILT), 0.0, -math.sin(TILT)],
    ]),
    np.array([1e-4, 0.07, -2e-4]),
    15.0,
    2.0 * math.pi / 60.0,
    2.5e-3,
)  # fmt: skip
NOWHERE = np.zeros(3)


def placed(beta, angle, side, shift=NOWHERE, y=0.0):
    rotation, translation = np.empty((3, 3)), np.empty(3)
    place_worm(STAND, beta, shift, angle, y, side, rotation, translation)
    return rotation, translation


def test_a_pitch_goes_into_a_turn_as_often_as_the_wheel_has_teeth():
    pair = SimpleNamespace(
        geometry=SimpleNamespace(wheel_teeth=60),
        mounting=SimpleNamespace(axes=STAND.axes, origin=1e3 * STAND.origin),
        ratio=15,
        worm=SimpleNamespace(reduced_lead=2.5),
    )
    found = Stand.of(pair)
    assert 60 * found.pitch == pytest.approx(2.0 * math.pi, rel=1e-12)
    assert found.origin == pytest.approx(STAND.origin)
    assert (found.ratio, found.lead) == pytest.approx((STAND.ratio, STAND.lead))


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_worm_material_moves_past_a_tooth_as_both_poses_have_it(side, sense):
    beta, angle, turned = 0.7, -0.11, 1e-6
    rotation, translation = placed(beta, angle, side)
    shift, turn = np.empty(3), np.empty((3, 3))
    sliding(STAND, rotation, translation, side, sense, shift, turn)
    later = placed(beta + sense * turned, angle + sense * turned / STAND.ratio, side)
    before = placed(beta - sense * turned, angle - sense * turned / STAND.ratio, side)
    for place in np.array([[0.01, 0.062, 0.003], [-0.004, 0.058, -0.007], [0.0, 0.0, 0.02]]):
        own = rotation.T @ (place - translation)
        moved = (later[0] @ own + later[1] - before[0] @ own - before[1]) / (2.0 * turned)
        assert shift + turn @ place == pytest.approx(moved, rel=1e-6, abs=1e-9)


@pytest.mark.parametrize("side", [1, -1])
def test_what_a_tooth_sees_of_the_worm_stands_in_space_where_the_worm_is(side):
    beta, angle, shift, y = -0.4, 0.23, np.array([3e-4, -1e-4, 2e-4]), 1.5e-4
    here = placed(beta, angle, side, shift, y)
    space = placed(beta, 0.0, 1, shift, y)
    vectors = np.ascontiguousarray(np.vstack([here[0].T, here[1]]))
    to_space(angle, side, vectors)
    assert vectors == pytest.approx(np.vstack([space[0].T, space[1]]), abs=1e-15)
    # The worm's axis does not turn, and its shift goes along its own axes.
    assert space[0][:, 2] == pytest.approx(STAND.axes[2])
    expected = STAND.origin + STAND.axes.T @ shift + [0.0, 0.0, y]
    assert space[1] == pytest.approx(expected, abs=1e-15)
