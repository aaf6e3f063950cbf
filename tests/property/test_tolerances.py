"""Assemblies made at random lie within the backlash that their tolerances leave.

By the exact flanks: how thick thread and tooth are turns out in the play exactly, where the worm
stands is solved for. Deviations are normal, cut off at their limits, three standard deviations from
their middle.
"""

import dataclasses
import functools

import numpy as np
import pytest
from apparatus.duties import A100

from asperity.flanks.measuring.corners import Mounted, Place
from asperity.flanks.meshing.backlash import worm_turn
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.parameters import Hob
from asperity.flanks.sides import both
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset.tolerancing.backlash import backlash
from asperity.gearset.tolerancing.table import Tolerances

GIVEN = Tolerances(centre_distance="js7", thread=["-40 um", "-70 um"], tooth=["-50 um", "-100 um"])
ASSEMBLIES, PARTS = 10_000, 100
THREAD, TOOTH, OFF = (40.0, 70.0), (50.0, 100.0), 17.5


@functools.cache
def mounted(oversize=1.05):
    pair = Pair.of(A100, Hob(oversize=oversize))
    return Mounted.of(pair, Wheel.cut(pair), GIVEN)


@functools.cache
def interval(oversize=1.05):
    own = mounted(oversize)
    nominal = worm_turn(own.meshes(Place()))
    return own.backlash(A100, GIVEN, nominal).states["new"]


def drawn(count, seed):
    """Thicknesses that are missing, normal thread and tooth, and offsets of the centre, um."""
    rng = np.random.default_rng(seed)
    sigmas = np.empty((count, 3))
    for column in range(3):
        values = rng.standard_normal(2 * count)
        sigmas[:, column] = values[np.abs(values) <= 3.0][:count]
    middle = np.array([np.mean(THREAD), np.mean(TOOTH), 0.0])
    half = np.array([np.ptp(THREAD), np.ptp(TOOTH), 2.0 * OFF]) / 2.0
    return middle + half * sigmas / 3.0


def assembled(thread, tooth, off, oversize=1.05):
    """Backlash on the mean circle of an assembly, um, from its own threads and place."""
    own = mounted(oversize)
    pair, g = own.pair, own.pair.geometry
    slant = np.cos(pair.worm.lead_angle)
    thin = pair.with_worm(pair.worm.half_space + 0.5e-3 * thread / slant)
    stood = Place(1e-3 * off).of(thin)
    turn = worm_turn(both(lambda side: transmission(stood, own.wheel.flank(side))))
    return 0.5e3 * g.wheel_mean_diameter * turn / pair.ratio + tooth


@pytest.mark.slow
def test_centre_distance_moves_the_exact_backlash_smoothly():
    # Between its ends a polynomial through nine distances is as good as the flanks themselves.
    plays = plays_of(1.05)
    for off in np.random.default_rng(3).uniform(-OFF, OFF, 4):
        assert plays(off) == pytest.approx(mounted().play(Place(1e-3 * off)), abs=1e-5)


@functools.cache
def plays_of(oversize):
    nodes = OFF * np.cos(np.pi * (np.arange(9) + 0.5) / 9)
    values = [mounted(oversize).play(Place(1e-3 * off)) for off in nodes]
    return np.polynomial.Polynomial.fit(nodes, values, 8)


@pytest.mark.slow
def test_of_ten_thousand_assemblies_the_squares_contain_99_7_percent_and_the_worst_case_all():
    own, found = mounted(), interval()
    g = own.pair.geometry
    thread, tooth, off = drawn(ASSEMBLIES, 1).T
    # In units of the mean circle, which turns as the reference circle does.
    along = thread / np.cos(g.lead_angle) * g.wheel_mean_diameter / g.wheel_reference_diameter
    values = plays_of(1.05)(off) + along + tooth
    assert found.least <= values.min() < values.max() <= found.greatest
    share = np.mean((values >= found.likely_least) & (values <= found.likely_greatest))
    assert share >= 0.997
    # Not by being too wide: what is wider than three standard deviations says nothing.
    assert found.likely_greatest - found.likely_least < 6.2 * values.std()


@pytest.mark.slow
@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(PARTS))
def test_assemblies_solved_one_by_one_lie_within(part):
    found = interval()
    rows = drawn(ASSEMBLIES, 2)[part::PARTS]
    values = np.array([assembled(*row) for row in rows])
    assert found.least <= values.min() <= values.max() <= found.greatest
    inside = (values >= found.likely_least) & (values <= found.likely_greatest)
    assert np.mean(inside) >= 0.97


@pytest.mark.slow
def test_the_worst_assembly_is_the_least_of_the_interval():
    found = interval()
    assert assembled(THREAD[0], TOOTH[0], -OFF) == pytest.approx(found.least, abs=1e-5)
    assert assembled(THREAD[1], TOOTH[1], OFF) == pytest.approx(found.greatest, abs=1e-5)


@pytest.mark.slow
def test_an_identical_hob_makes_the_centre_distance_count_more_where_it_closes():
    # The flanks touch at the edges of the face there, under another angle than in its middle.
    pair = Pair.of(A100)
    own = Mounted.of(pair, Wheel.cut(pair), GIVEN)
    closed, opened = own.play(Place(-1e-3 * OFF)), own.play(Place(1e-3 * OFF))
    middle = backlash(A100, GIVEN).parts[2].greatest
    assert 0.0 < opened < middle < -closed


@pytest.mark.slow
def test_no_place_within_the_mounting_tolerances_has_less_play_than_their_corners():
    given = dataclasses.replace(mounted(), deviations=Place(0.02, 0.03, 1e-3))
    least = min(given.play(place) for place in given.places((-1, 1)))
    rng = np.random.default_rng(5)
    for _ in range(12):
        place = Place(*(rng.uniform(-1, 1, 3) * given.deviations))
        assert given.play(place) >= least - 1e-6
