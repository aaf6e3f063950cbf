"""The unit cube of designs: what its sides stand for, also where bounds lie decades apart."""

import dataclasses

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions
from asperity.studies.climb import climb
from asperity.studies.cube import cube_of
from asperity.studies.design import Bounds, Space
from asperity.studies.optimise import optimise
from asperity.studies.rounding import rounded_near
from asperity.studies.search import notes_of

NAMES = ("pressure_angle", "diameter_factor", "axial_module", "worm_roughness")
ORDINARY = np.array([[0.25, 0.52], [6.0, 12.0], [2.1e-3, 2.3e-3], [0.8e-6, 1.6e-6]])
FAR = np.array([[0.25, 0.52], [1e-6, 1e6], [1e-12, 1e6], [1e-9, 1e-5]])
MODULE_FAR = 1e-12 / 2.1962e-3 - 1.0, 1e6 / 2.1962e-3 - 1.0


def subject():
    case = read_case("gearset-3", case_tables(), ["operation.output_torque=200 N m"])
    return case.require(Gearset), case.require(Operation), case.require(RatingOptions)


def test_sides_of_ordinary_bounds_go_evenly_from_the_lower_to_the_upper():
    cube = cube_of(NAMES, ORDINARY, (-0.5, 0.5), 0.15, 60)
    points = np.random.default_rng(1).random((50, 4))
    plain = ORDINARY[:, 0] + points * (ORDINARY[:, 1] - ORDINARY[:, 0])
    assert np.array_equal(cube.designs(points), plain)
    assert cube.points(plain) == pytest.approx(points, abs=1e-12)


def test_no_design_that_a_profile_shift_allows_is_left_out_of_far_bounds():
    cube = cube_of(NAMES, FAR, (-0.5, 0.5), 0.15, 60)
    rng = np.random.default_rng(2)
    factor, shift = 10.0 ** rng.uniform(-6.0, 6.0, 200), rng.uniform(-0.5, 0.5, 200)
    module = 0.15 / (factor + 60.0 + 2.0 * shift)
    designs = np.stack([0.3 + 0.0 * factor, factor, module, 1e-6 + 0.0 * factor], axis=-1)
    points = cube.points(designs)
    assert cube.designs(points) == pytest.approx(designs, rel=1e-9)
    # Decades are a side's even parts: a share of it is a power of the factor.
    assert np.ptp(points[:, 1]) > 0.9


def test_bounds_of_many_decades_come_to_the_design_of_near_ones():
    gearset, operation, options = subject()
    far = optimise(gearset, operation, options, Bounds(module_change=MODULE_FAR), starts=2)
    near = optimise(gearset, operation, options, Bounds(module_change=(-0.3, 0.3)), starts=1)
    assert far.gain == pytest.approx(near.gain, abs=1e-6)
    assert far.gain > 0.05
    assert far.agreed > far.starts / 2
    assert not any(limit.key == "axial_module_mm" for limit in far.active)


def test_a_climb_that_ends_badly_keeps_the_best_that_it_came_by():
    """A spike beside the start: its slope leads far beyond it, where nothing is."""

    def merit(points):
        at = points[:, 0]
        return np.stack(
            [np.where(np.abs(at - 0.500001) < 5e-7, 1.0, 0.1 * at), 1.0 + 0.0 * at], axis=-1
        )

    top = climb(merit, [np.array([0.5])])
    assert top.height == 1.0
    assert top.point[0] == pytest.approx(0.5, abs=2e-6)


def test_numbers_that_can_be_made_are_never_better_than_the_best():
    gearset, operation, options = subject()
    space = Space(gearset, operation, options, least={})

    def merit(points):
        return space.merit(space.worth(points), {})

    # As if all climbs had stayed where they began.
    poor = climb(merit, [space.start])
    height = float(merit(space.start[None])[0, 0])
    poor = dataclasses.replace(poor, point=space.start, height=height)
    top, near = rounded_near(space, poor, merit, {})
    assert top.height > height + 1e-3
    assert float(merit(near[None])[0, 0]) <= top.height + 1e-6


def test_starts_that_mostly_end_elsewhere_are_said():
    rated = Space(*subject()).rated(subject()[0])
    assert any("only 2 of 10 starts" in note for note in notes_of(rated, Bounds(), 2, 10))
    assert not any("starts" in note for note in notes_of(rated, Bounds(), 5, 10))
