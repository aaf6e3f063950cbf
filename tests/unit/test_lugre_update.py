"""LuGre's update: its tangent, and Dahl where there is nothing but the asperity."""

import numpy as np
import pytest

from asperity.friction import LAWS, lugre_update, update

pytestmark = pytest.mark.usefixtures("plain_kernels")

LIMIT = 1e-5
STEP = 1e-3


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_tangent_equals_finite_differences(law):
    rng = np.random.default_rng(2)
    rest = (LIMIT, STEP, 1.5, 0.01, 3.0, 0.4, law)
    for _ in range(100):
        angle, size = rng.uniform(0.0, 2.0 * np.pi), rng.uniform(0.0, 1.3)
        deflection = (LIMIT * size * np.cos(angle), LIMIT * size * np.sin(angle))
        slips = LIMIT * 10 ** rng.uniform(-2.0, 0.7) * rng.normal(size=(2, 2))
        tangents = lugre_update(deflection, tuple(slips[0]), tuple(slips[1]), *rest)[2]
        for part in (0, 1):
            numeric = np.empty((2, 2))
            for axis in (0, 1):
                change = np.zeros((2, 2))
                change[part, axis] = 1e-6 * LIMIT
                ahead, behind = (
                    lugre_update(deflection, tuple(moved[0]), tuple(moved[1]), *rest)[1]
                    for moved in (slips + change, slips - change)
                )
                numeric[:, axis] = (np.array(ahead) - np.array(behind)) / (2e-6 * LIMIT)
            assert np.array(tangents[part]) == pytest.approx(
                numeric.ravel(), abs=1e-6 * np.abs(numeric).max()
            )


@pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
def test_without_stribeck_and_damping_it_is_dahl(law):
    deflection, slip_1, slip_2 = (2e-6, -5e-6), (3e-6, 1e-6), (0.0, 4e-6)
    dahl = update(deflection, slip_1, slip_2, LIMIT, 1.0, law)
    lugre = lugre_update(deflection, slip_1, slip_2, LIMIT, STEP, 1.0, 0.0, 0.0, 0.0, law)
    for mine, its in zip(lugre[:2], dahl[:2], strict=True):
        assert mine == pytest.approx(its, rel=1e-15)
    for mine, its in zip(lugre[2], dahl[2], strict=True):
        assert np.array(mine) * LIMIT == pytest.approx(np.array(its), rel=1e-14)
