"""Blok's flash temperature against moving bands of heat, integrated."""

import math

import numpy as np
import pytest

from asperity.drive.static.flash import HEAT, effusivity, flash_temperature, passing
from asperity.gearset.masses import DENSITY


def highest(heat, width, speed, effusivity):
    """Highest rise under a fast band of elliptic heat, W/m, by superposing instant sources."""
    s, weight = np.polynomial.legendre.leggauss(200)
    best = 0.0
    for end in np.linspace(0.3, 1.0, 1401):
        # What passed at x' has had (end - x')/u to spread; x' = end - r^2 takes its pole away.
        r = 0.5 * math.sqrt(end) * (s + 1.0)
        flux = 2.0 * heat / (math.pi * 0.5 * width) * np.sqrt(1.0 - (2.0 * (end - r**2) - 1.0) ** 2)
        rise = np.sum(weight * flux) * math.sqrt(end) * math.sqrt(width / speed)
        best = max(best, rise / (effusivity * math.sqrt(math.pi)))
    return best


def test_it_is_the_highest_temperature_of_a_band_of_elliptic_heat():
    load, sliding, rolling, width, own = 3e5, 2.0, 0.7, 0.3e-3, 12900.0
    found = flash_temperature(
        0.1, np.array([load]), np.array([sliding]),
        (np.array([rolling]), np.array([0.0])), np.array([width]), (own, 1.0),
    )  # fmt: skip
    heat = 0.1 * load * sliding
    assert found[0] == pytest.approx(highest(heat, width, rolling, own), rel=5e-3)


@pytest.mark.parametrize(("across", "along"), [(0.7, 0.0), (0.0, 1.8), (0.1, 1.5), (0.3, -0.9)])
def test_it_is_the_highest_of_an_ellipse_whichever_way_it_moves(across, along):
    width, length, flux, own = 0.4e-3, 2.2e-3, 1e8, 12900.0
    way = np.array([2.0 * across / width, 2.0 * along / length])
    speed = math.hypot(*way)
    # Where the ellipse is a circle of radius 1, paths are beside its middle by `aside`.
    s, weight = np.polynomial.legendre.leggauss(100)
    best = 0.0
    for aside in (-0.3, 0.0, 0.3):
        half = math.sqrt(1.0 - aside**2)
        for end in np.linspace(-0.2, 1.0, 601) * half:
            r = 0.5 * math.sqrt(end + half) * (s + 1.0)
            heat = flux * np.sqrt(np.maximum(1.0 - aside**2 - (end - r**2) ** 2, 0.0))
            rise = np.sum(weight * heat) * math.sqrt((end + half) / speed)
            best = max(best, rise / (own * math.sqrt(math.pi)))
    load = 0.25 * math.pi * flux * width
    moved = passing(np.array([across]), np.array([along]), np.array([width / length]))
    still = np.zeros(1)
    found = flash_temperature(
        1.0, np.array([load]), np.ones(1), (moved, still), np.array([width]), (own, 1.0)
    )
    assert found[0] == pytest.approx(best, rel=5e-3)


def test_both_bodies_take_the_heat_that_makes_them_equally_warm():
    rng = np.random.default_rng(4)
    load, sliding, one, other, width = rng.uniform(0.5, 2.0, (5, 20)) * np.array(
        [[3e5], [2.0], [0.7], [0.2], [3e-4]]
    )
    both = 12900.0, 11800.0

    def alone(body, share):
        rolling = (one, 0.0 * one) if body == 0 else (0.0 * one, -other)
        return flash_temperature(0.1, share * load, sliding, rolling, width, both)

    found = flash_temperature(0.1, load, sliding, (one, -other), width, both)
    share = both[0] * np.sqrt(one) / (both[0] * np.sqrt(one) + both[1] * np.sqrt(other))
    assert found == pytest.approx(alone(0, share), rel=1e-12)
    assert found == pytest.approx(alone(1, 1.0 - share), rel=1e-12)


def test_every_kind_of_wheel_spreads_heat_as_such_bodies_do():
    # A plastic's surface is an order warmer than a metal's.
    found = {
        kind: effusivity(conductivity, DENSITY.get(kind, 1400.0), heat_capacity)
        for kind, (conductivity, heat_capacity) in HEAT.items()
    }
    plastic = found.pop("plastic")
    assert 500.0 < plastic < 1000.0
    assert all(10e3 < each < 15e3 for each in found.values())
