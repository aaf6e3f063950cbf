"""Backlash and axial clearance are the least over a pitch, not of 32 places in it."""

import functools
import math

import numpy as np
import pytest

from asperity.flanks.meshing.backlash import normal_backlash, play, set_backlash
from asperity.flanks.meshing.transmission import SAMPLES, least_between, transmission
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

GEARSET = {
    "axial_module": "2.15380 mm",
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}
DENSE = 1024
RESOLVED = 1e-9  # mm
NEAR = 3e-6  # of the least over 1024 places, which lies a little above, mm


def random_pair(seed):
    """A gearset of any flank but ZI with an oversized hob, mounted beside its place."""
    rng = np.random.default_rng(seed)
    hob = Hob(oversize=rng.uniform(1.02, 1.2), tilt=math.radians(rng.uniform(-0.5, 1.0)),
              units="SI")  # fmt: skip
    gearset = Gearset(**GEARSET, starts=int(rng.integers(1, 5)),
                      wheel_teeth=int(rng.integers(30, 61)),
                      diameter_factor=round(rng.uniform(8.0, 12.0), 1),
                      flank=("ZA", "ZN", "ZK")[seed % 3])  # fmt: skip
    mount = Mount(
        centre_distance_error=1e-3 * rng.uniform(-0.02, 0.08),
        axial_offset=1e-3 * rng.uniform(-0.05, 0.05),
        shaft_angle_error=math.radians(rng.uniform(-0.1, 0.1)),
        units="SI",
    )
    return Pair.of(gearset, hob, mount=mount)


@functools.cache
def meshes(seed, samples=SAMPLES):
    pair = random_pair(seed)
    wheel = Wheel.cut(pair)
    return {side: transmission(pair, wheel.flank(side), samples) for side in (1, -1)}


def dense_normal(bearing, other):
    """The least distance to the other flank over many places of the wheel."""
    samples = bearing.wheel_angle.size
    beta = other.places(samples)
    index = np.mod(np.rint(beta / (other.pitch / samples)).astype(int), samples)
    phase = other.pair.ratio * beta + bearing.search.flank.side * bearing.lead[index]
    rough = other.gap(beta, phase, np.full(beta.size, -math.inf))[:, 0]
    near = np.full(beta.size, rough.min() + 1e-2)
    return float(other.gap(beta, phase, near)[:, 0].min())


def holds(seed, within=RESOLVED):
    """Return by how much the least of 32 places lies above the least, in mm."""
    coarse, dense = meshes(seed), meshes(seed, DENSE)
    found = play(coarse)
    worm = dense[1].search.pair.worm
    least = worm.reduced_lead * float((dense[1].lead + dense[-1].lead).min())
    assert -NEAR < found.axial - least < within
    for side in (1, -1):
        least = dense_normal(dense[side], dense[-side].search)
        assert -NEAR < found.normal[side] - least < within
    return dense_normal(coarse[1], coarse[-1].search) - found.normal[1]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 3])
def test_play_is_the_least_of_many_places(seed):
    assert holds(seed) > 1e-6


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_play_is_the_least_of_many_places")
@pytest.mark.parametrize("seed", range(10, 34))
def test_play_of_random_hobs_is_the_least_of_many_places(seed):
    # Two dips within one step, at a corner where teeth change, are looked into as one.
    holds(seed, within=1e-8 if seed == 14 else RESOLVED)


@pytest.mark.slow
def test_threads_that_give_a_backlash_leave_it_between_the_places_too():
    thinned = set_backlash(meshes(1), 0.15)
    # The worm is turned by half a step, so that other places are looked at.
    least = min(normal_backlash(thinned[side], thinned[-side].search) for side in (1, -1))
    assert least == pytest.approx(0.15, abs=1e-9)
    dense = {side: meshes(1, DENSE)[side].with_worm(thinned[1].search.pair.worm.half_space)
             for side in (1, -1)}  # fmt: skip
    beside = min(dense_normal(dense[side], dense[-side].search) for side in (1, -1))
    assert beside == pytest.approx(0.15, abs=2e-7)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("shift", [0.0, 0.1, 0.37, 0.5, 0.93])
def test_the_least_between_places_is_found_wherever_it_lies(shift):
    step = 2.0 * math.pi / SAMPLES
    at = step * np.arange(SAMPLES)

    def wave(beta):
        # Two dips nearly as deep; teeth change where the one of two lines comes first.
        turned = beta - shift * step
        return min(math.cos(turned), math.cos(2.0 * turned) + 1e-4 * math.sin(turned))

    found = least_between(np.array([wave(one) for one in at]), step, wave)
    fine = min(wave(one) for one in np.linspace(0.0, 2.0 * math.pi, 200001))
    assert found == pytest.approx(fine, abs=1e-9)
    assert found <= fine + 1e-11


def test_what_is_the_same_everywhere_is_looked_at_nowhere_else():
    assert least_between(np.full(SAMPLES, 0.3), 0.1, None) == 0.3


@pytest.mark.slow
@pytest.mark.parametrize("thinner", [0.0, 0.3])
def test_a_thinner_thread_turns_further_by_as_much_wherever_it_touches(thinner):
    """Turned by the angle that it is thinner, a helicoid's flank is where it was."""
    mesh = meshes(1)[1]
    thick = mesh.search.pair.worm
    thin = mesh.with_worm(thick.half_space + thinner)
    further = thinner / thick.reduced_lead
    for k in range(0, SAMPLES, 8):
        found = thin.search.least_lead(mesh.wheel_angle[k])
        assert found == pytest.approx(mesh.lead[k] + further, abs=RESOLVED / thick.reduced_lead)
