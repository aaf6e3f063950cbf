"""The mean tangent of points in contact: tangential, and turned as they are."""

from typing import NamedTuple

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from asperity.contact.increment.coupling import mean_tangent
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.records import ContactPoints
from asperity.friction import VECTOR

COUNT = 3
LAW = PointFriction(DAHL, 0.3, 7e-8, VECTOR)


class Interface(NamedTuple):
    """What is asked of an interface."""

    weights: np.ndarray
    friction: object


class Committed(NamedTuple):
    """What is asked of the state before an increment."""

    deflection: np.ndarray
    size: np.ndarray


def tangent(turn):
    """Of points on a plane that is turned with all that lies in it."""
    rng = np.random.default_rng(8)
    bent, slip_1, slip_2 = (
        turn.apply(size * rng.uniform(0.5, 1.0, (COUNT, 3)) * [1.0, 1.0, 0.0])
        for size in (0.3, 2e-8, 3e-8)
    )
    points = ContactPoints.empty(COUNT)
    points.pressure[:] = [1e6, 2e6, 1.5e6]
    points.normal[:] = turn.apply([0.0, 0.0, 1.0])
    points.slip_1[:], points.slip_2[:] = slip_1, slip_2
    out = np.empty((3, 3))
    mean_tangent(
        points, Committed(bent, np.full(COUNT, 0.4)), Interface(np.ones(COUNT), LAW.numbers(1e-5)),
        SurfaceMotion().numbers(), out,
    )  # fmt: skip
    return out


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("angles", [(0, 0, 50), (40, 0, 0), (0, 70, 0), (20, -50, 130)])
def test_the_mean_tangent_is_tangential_and_turns_with_the_surface(angles):
    turn = Rotation.from_euler("xyz", angles, degrees=True)
    flat, turned = tangent(Rotation.identity()), tangent(turn)
    size = np.abs(flat).max()
    assert size > 0.0
    matrix, normal = turn.as_matrix(), turn.apply([0.0, 0.0, 1.0])
    assert turned == pytest.approx(matrix @ flat @ matrix.T, abs=1e-12 * size)
    assert turned @ normal == pytest.approx(np.zeros(3), abs=1e-12 * size)
    assert normal @ turned == pytest.approx(np.zeros(3), abs=1e-12 * size)
