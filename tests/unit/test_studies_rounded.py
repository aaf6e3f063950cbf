"""Rounding a design to numbers that can be made, and climbers who go on without the others."""

import threading
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.studies.climb import climb_together
from asperity.studies.design import VARIABLES
from asperity.studies.rounding import rounded

CENTRES = 0.05  # m
TEETH_AND_SHIFT = 40.0  # what is left of twice the centre distance over the module


def space(worth):
    """Designs whose points are their numbers, worth what a function says of each row."""
    low, high = np.transpose([(0.35, 0.52), (6.0, 12.0), (1.9e-3, 2.1e-3), (0.8e-6, 1.6e-6)])
    return SimpleNamespace(
        gearset=SimpleNamespace(geometry=SimpleNamespace(centre_distance=1e3 * CENTRES)),
        lower=low,
        upper=high,
        values=lambda point: dict(zip(VARIABLES, point, strict=True)),
        points=lambda designs: designs,
        worth=lambda points: points,
        merit=lambda rows, least: np.array([[worth(*row), 1.0] for row in rows]),
    )


def test_the_diameter_follows_a_module_of_the_series_at_the_same_profile_shift():
    # Best with 9.26 at 2.03 mm; at 2 mm, which there are tools for, with 10.
    def worth(angle, factor, module, roughness):
        return -abs(2.0 * CENTRES / module - factor - TEETH_AND_SHIFT)

    factor = 2.0 * CENTRES / 2.03e-3 - TEETH_AND_SHIFT
    found = rounded(space(worth), np.array([0.4, factor, 2.03e-3, 1e-6]), {})
    assert found[2] == pytest.approx(2e-3, rel=1e-12)
    assert found[1] == pytest.approx(10.0, rel=1e-12)


def test_a_climber_goes_on_when_the_others_are_at_their_ends():
    found = []

    def hill(rows):
        return -((rows - 0.3) ** 2)

    def climb():
        # One begins on its top; in a daemon, which does not keep Python from ending.
        starts = np.array([0.3]), np.array([0.9])
        found.extend(climb_together(lambda rows: rows, [(hill, [start]) for start in starts]))

    climber = threading.Thread(target=climb, daemon=True)
    climber.start()
    climber.join(5.0)
    assert [float(top.point[0]) for top in found] == pytest.approx([0.3, 0.3], abs=1e-5)
