"""What a coarse flank says at the nodes of a finer one."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.teeth.sector import _interpolation, lattice


def flank(radii, faces, seed):
    """Nodes on circles about the axis and planes across it, in any order."""
    radius, z = np.meshgrid(np.linspace(30e-3, 34e-3, radii), np.linspace(-8e-3, 8e-3, faces))
    turn = 3.0 * z
    nodes = np.stack([radius * np.cos(turn), radius * np.sin(turn), z], axis=-1).reshape(-1, 3)
    return SimpleNamespace(positions=np.random.default_rng(seed).permutation(nodes))


def bilinear(surface):
    x, y, z = surface.positions.T
    height, along = np.hypot(x, y) / 30e-3 - 1.0, z / 8e-3
    return 0.3 + 2.0 * height - 0.7 * along + 5.0 * height * along


@pytest.mark.parametrize("fine", [(4, 5), (7, 9), (6, 4), (11, 13)])
def test_what_is_bilinear_over_a_flank_is_met_on_a_finer_one(fine):
    coarse, finer = flank(4, 5, seed=1), flank(*fine, seed=2)
    assert lattice(coarse).shape == (4, 5)
    matrix = _interpolation(coarse, finer)
    assert matrix @ bilinear(coarse) == pytest.approx(bilinear(finer), rel=1e-9, abs=1e-12)
    assert matrix.sum(axis=1) == pytest.approx(1.0, rel=1e-12)
