"""Resolved pressures of loaded teeth: balance, three meshes, edges and what removes them.

Source: figures of another implementation with dense matrices on gearset 3 of 2.9 in, rigid shaft,
at phase 0.75 rad of the worm: 389, 623, 822, 1294 and 1526 MPa at 10, 41, 100, 366 and 600 N m;
elastic 5,500 to 7,200 MPa on the rounding of the worm's tip at 1.40 and 0.10 rad, 1,540 with 20 um
of relief. It subtracts a half-space from the coarse mesh as it is, and its peaks at 41 to 366 N m
are 1 to 5 % below ours. Hertz decides: the ellipse of the curvatures that worm and wheel have where
they touch (Johnson, Contact Mechanics, 4.26 to 4.29), found from exact distances alone, gives
79.32 MPa/N^(1/3) on the middle tooth and 104.5 on the one before it. Ours stand within 2e-3 of it
under a small load; from 10 to 366 N m the middle tooth stays within 5e-3, the other, which bears
near its tip, within 1.5e-2. The other implementation's 822 MPa at 100 N m is off it.
"""

import functools

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.contact import _Teeth
from asperity.drive.resolved.strip import FLANK, WORM_TIP
from asperity.drive.static.seen import resolved
from asperity.drive.static.solve import StaticModel
from asperity.runs import Run

ELASTIC = "drive.plastic=false"
LOAD = 366.0

pytestmark = pytest.mark.slow


@functools.cache
def model(*settings):
    case = read_case("drive-screw", case_tables(), settings)
    return StaticModel(DriveProblem.from_case(case), Run(), 4)


def at(beta, *settings, load=LOAD):
    made = model(*settings)
    balance = made.equilibrium.balance(beta, load)
    return balance, resolved(made.resolved, balance)


def peak(found, zone):
    return max(tooth.peaks()[zone] for tooth in found.teeth) / 1e6


def hertz_peak(sharp, flat, modulus):
    """Largest pressure under a unit force where the gap is sharp x^2 + flat y^2."""

    def off(ratio):
        first, second = ellipk(1.0 - ratio**2), ellipe(1.0 - ratio**2)
        return (second / ratio**2 - first) / (first - second) - sharp / flat

    ratio = brentq(off, 1e-3, 1.0 - 1e-9)
    longer = 3.0 * ellipe(1.0 - ratio**2) / (2.0 * np.pi * modulus * ratio**2 * (sharp + flat))
    return 1.5 / (np.pi * ratio * longer ** (2.0 / 3.0))


@functools.cache
def hertz(number, reach=0.4e-3):
    """Hertz's peak, Pa under 1 N, of a tooth at phase 0.75, from exact distances to the worm."""
    made = model(ELASTIC)
    balance, found = at(0.75, ELASTIC, load=1.0)
    teeth = _Teeth.of(made.resolved, balance.contact, 0.75, balance.wheel_angle, balance.shift)
    tooth = next(tooth for tooth in found.teeth if tooth.number == number)
    most = int(np.argmax(tooth.pressure))
    middle, out = tooth.strip.points[most], tooth.strip.normals[most]
    flank = made.resolved.flank
    shares = tooth.strip.share[most] + np.linspace(-0.5, 0.5, 25) * reach / flank.height
    places = 1e3 * (middle[2] + np.linspace(-2.0, 2.0, 31) * reach)
    points = flank.sector.wheel.flank(1).at_shares(shares, places).points.reshape(-1, 3) / 1e3
    gap, *_ = teeth.approaches[teeth.numbers.index(number)].gaps(points)
    across = np.cross(out, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    x, y = 1e3 * (points - middle) @ across, 1e3 * (points - middle) @ np.cross(out, across)
    powers = [(i, j) for i in range(7) for j in range(7 - i)]
    basis = np.stack([x**i * y**j for i, j in powers], axis=1)
    found_ = dict(zip(powers, np.linalg.lstsq(basis, gap, rcond=None)[0], strict=True))
    half = 0.5 * found_[1, 1]
    form = 1e6 * np.array([[found_[2, 0], half], [half, found_[0, 2]]])
    flat, sharp = np.linalg.eigvalsh(form)
    return hertz_peak(sharp, flat, made.resolved.modulus)


def over_hertz(load, number):
    _, found = at(0.75, ELASTIC, load=load)
    tooth = next(tooth for tooth in found.teeth if tooth.number == number)
    return tooth.peaks()[FLANK] / (hertz(number) * tooth.normal ** (1.0 / 3.0))


def test_hertz_s_ellipse_of_like_curvatures_is_his_sphere():
    radius, modulus = 10e-3, 1e11
    sphere = (6.0 * modulus**2 / (np.pi**3 * radius**2)) ** (1.0 / 3.0)
    found = hertz_peak(0.50001 / radius, 0.5 / radius, modulus)
    assert found == pytest.approx(sphere, rel=2e-5)


@pytest.mark.parametrize("number", [0, -1])
def test_a_small_contact_is_hertz_s_ellipse_of_the_curvatures_there(number):
    assert over_hertz(1.0, number) == pytest.approx(1.0, rel=2e-3)


@pytest.mark.parametrize("load", [10.0, 41.0, 100.0, LOAD])
@pytest.mark.parametrize(("number", "within"), [(0, 5e-3), (-1, 1.5e-2)])
def test_clean_contacts_stay_with_hertz_under_load(load, number, within):
    assert over_hertz(load, number) == pytest.approx(1.0, rel=within)


@pytest.mark.parametrize(
    ("load", "other"), [(10.0, 389.0), (41.0, 623.0), (100.0, 822.0), (366.0, 1294.0)]
)
def test_the_middle_of_a_flank_bears_as_in_another_implementation(load, other):
    _, found = at(0.75, ELASTIC, load=load)
    middle = next(tooth for tooth in found.teeth if tooth.number == 0)
    assert middle.peaks()[FLANK] / 1e6 == pytest.approx(other, rel=0.05)


def test_the_patches_bear_the_moment_of_the_condensed_teeth():
    balance, found = at(1.4, ELASTIC)
    moment = sum(float(tooth.force @ tooth.strip.arm) for tooth in found.teeth)
    friction = balance.action.wrench[5] / moment
    # Friction pushes the wheel back; without it the normal forces bear the load alone.
    assert 0.9 < friction < 1.0
    normal = sum(tooth.normal for tooth in found.teeth)
    assert normal == pytest.approx(balance.action.normal.sum(), rel=0.01)


EDGE_BEARS = (0.1, 0.4, 1.4)


def edge(relief):
    """Peaks on the worm's tip edge and the flank, MPa, and the edge's force, N, by phase."""
    rows = []
    for beta in EDGE_BEARS:
        settings = (ELASTIC, f"modification.tip_relief={relief} um") if relief else (ELASTIC,)
        _, found = at(beta, *settings)
        force = sum(tooth.forces()[WORM_TIP] for tooth in found.teeth)
        rows.append((peak(found, WORM_TIP), peak(found, FLANK), force))
    return np.array(rows).T


def test_20_um_of_tip_relief_take_the_worm_s_edge_away_and_10_um_do_not():
    sharp, half, whole = edge(0), edge(10), edge(20)
    assert ((sharp[0] > 5500.0) & (sharp[0] < 7800.0)).all()
    # The more relief the less the edge bears, at each phase.
    assert (half[2] < 0.55 * sharp[2]).all()
    assert (whole[2] < 0.12 * sharp[2]).all()
    # With 10 um it still stands far above the flank at two of three phases.
    assert (half[0] > 1.5 * half[1]).sum() == 2
    # With 20 um it bears less than the flank, whose own peak rises by less than a fifth.
    assert (whole[0] < whole[1]).all()
    assert (whole[1] < 1.2 * sharp[1]).all()
    # So the largest on the worm's side falls to a third.
    assert whole[:2].max() < 0.33 * sharp[:2].max()


def test_an_edge_flows_at_the_hardness_of_the_wheel():
    made = model()
    _, found = at(1.4)
    assert peak(found, WORM_TIP) == pytest.approx(150 * 9.80665, rel=1e-9)
    assert made.resolved.cap == pytest.approx(150 * 9.80665e6)
    assert 1e-6 < found.depth < 50e-6


@pytest.mark.campaign(tried_by="test_a_small_contact_is_hertz_s_ellipse_of_the_curvatures_there")
def test_peaks_are_the_same_on_three_meshes():
    flank, edge = [], []
    for density in ("coarse", "intermediate", "fine"):
        settings = ELASTIC, f"drive.density={density}"
        flank.append(peak(at(0.75, *settings)[1], FLANK))
        edge.append(peak(at(1.4, *settings)[1], WORM_TIP))
    for values in (flank, edge):
        assert np.ptp(values) < 0.05 * np.mean(values)
