"""The peak on the worm's rounded tip edge against a plane model of both bodies, finely meshed.

A cut across the contact where the edge bears most, wheel and worm in plane strain, their elements
2 um wide at the edge. The wheel is a block with a flat side; the worm has its flank, the rounding
of its tip and the land behind it, turned away by 90 degrees less the pressure angle, where the
resolved contact has a half-space. Force and moment of the cut are those of the resolved contact,
for what lies far off the cut has no say in; the gap is that of the exact flanks.
"""

import functools

import numpy as np
import pytest
from apparatus.plane_edge import SIZE, compliance, pressed, rounded
from scipy.interpolate import CubicSpline

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.contact import _Teeth
from asperity.drive.resolved.strip import WORM_TIP
from asperity.drive.static.pressure import resolved
from asperity.drive.static.solve import StaticModel
from asperity.flanks.worm.distance import ARC
from asperity.runs import Run

FINE = 2e-6
DOWN, UP = np.array([0.0, -1.0]), np.array([0.0, 1.0])

pytestmark = pytest.mark.slow


@functools.cache
def model():
    case = read_case("drive-screw", case_tables(), ("drive.plastic=false",))
    return StaticModel(DriveProblem.from_case(case), Run(), 4)


@functools.cache
def cut(beta):
    """Places from the end of the worm's flank on, m, pressures, gaps where the edge bears most."""
    made = model()
    balance = made.equilibrium.balance(beta, 366.0)
    found = resolved(made.resolved, balance)
    tooth = max(found.teeth, key=lambda tooth: tooth.peaks()[WORM_TIP])
    strip, shape = tooth.strip, tooth.strip.frame.shape
    at_edge = np.where(strip.zone == WORM_TIP, tooth.pressure, 0.0).reshape(shape)
    column = int(np.unravel_index(at_edge.argmax(), shape)[1])
    teeth = _Teeth.of(made.resolved, balance.contact, beta, balance.wheel_angle, balance.shift)
    approach = teeth.approaches[teeth.numbers.index(tooth.number)]
    here = np.arange(len(strip.points)).reshape(shape)[:, column]
    here = here[strip.inside[here]]
    x = strip.frame.x[here // shape[1]]
    _, kinds, _ = approach.gaps((strip.points + strip.nodes @ approach.moved)[here])
    last = np.flatnonzero(kinds == ARC).max()
    # The worm's flank ends towards lower x, and its land is behind the rounding.
    assert (kinds[: last + 1] >= ARC).all()
    return x - 0.5 * (x[last] + x[last + 1]), tooth.pressure[here], strip.gap[here]


def surface_points(reach):
    """Arcs of points over a cut that bears from the edge so far, fine where the flank ends."""
    fine = np.arange(-80e-6, 60e-6, FINE)
    steps = FINE * 1.15 ** np.arange(400)
    on = fine[-1] + np.cumsum(np.minimum(steps, 15e-6))
    on = on[on < reach]
    off = 30e-6 * 1.3 ** np.arange(30)
    after = on[-1] + np.cumsum(off)
    before = fine[0] - np.cumsum(FINE * 1.25 ** np.arange(60))
    return np.concatenate([before[before > -SIZE][::-1], fine, on, after[after < SIZE]])


def planes(beta, *, corner):
    """Peak of the plane model and of the cut that it stands for, Pa."""
    x, pressure, gap = cut(beta)
    made = model()
    wheel = made.problem.gearset.wheel_material
    worm = made.problem.gearset.worm_material
    radius = 1e-3 * made.sector.wheel.pair.worm.tip_rounding
    turn = 0.5 * np.pi - made.sector.wheel.pair.worm.pressure_angle
    reach = x[pressure > 0.0].max() + 60e-6
    s = surface_points(reach)
    shape = rounded(s, radius, turn)
    keep = np.flatnonzero((s > -55e-6) & (s < reach))
    flat = np.stack([np.where(s > -60e-6, shape[:, 0], s), np.zeros_like(s)], axis=1)
    land = np.array([1.0 - np.cos(turn), np.sin(turn)])
    way = land / np.linalg.norm(land)
    above = compliance(shape, keep, worm, way, FINE) if corner else (
        compliance(flat, keep, worm, UP, FINE)
    )  # fmt: skip
    give = above + compliance(flat, keep, wheel, DOWN, FINE)
    at = shape[keep, 0]
    step = x[1] - x[0]
    forces = pressed(
        give, CubicSpline(x, gap)(at), at, pressure.sum() * step, (pressure * x).sum() * step
    )  # fmt: skip
    lengths = np.linalg.norm(np.diff(shape, axis=0), axis=1)
    width = 0.5 * (lengths[keep - 1] + lengths[keep])
    return float((forces / width).max()), float(pressure.max())


@pytest.mark.parametrize("beta", [0.1, 1.4])
def test_the_peak_on_the_edge_is_that_of_finely_meshed_bodies(beta):
    plane, strip = planes(beta, corner=True)
    assert strip > 5e9
    assert strip == pytest.approx(plane, rel=0.1)


def test_with_half_spaces_in_the_plane_model_too_it_is_closer():
    plane, strip = planes(1.4, corner=False)
    assert strip == pytest.approx(plane, rel=0.03)
