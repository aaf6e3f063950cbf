"""Resolved pressures of loaded teeth: balance, three meshes, edges and what removes them.

Source: figures of another implementation with dense matrices on gearset 3 of 2.9 in, rigid shaft,
at phase 0.75 rad of the worm: 389, 623, 822, 1294 and 1526 MPa at 10, 41, 100, 366 and 600 N m;
elastic 5,500 to 7,200 MPa on the rounding of the worm's tip at 1.40 and 0.10 rad, 1,540 with 20 um
of relief. Four of the five are within 3 % of ours; 822 MPa is 4.4 % below. What it assumed is found
again here to 0.5 % at all five loads: each tooth has the force of the condensed contact, and what
the tooth gives beside a half-space is taken at the nodes of the coarse mesh as it is, and linear
between them. At a node, and beside it, that is what the elements make of a point, 8 nm/N where
pairs further apart lead to 1 nm/N, and the contact goes round it. With half-spaces alone, at one
and the same force, the dense patches have Hertz's peak, and ours. Hertz decides: the ellipse of the
curvatures that worm and wheel have where they touch (Johnson, Contact Mechanics, 4.26 to 4.29),
found from exact distances alone, gives 79.32 MPa/N^(1/3) on the middle tooth and 104.5 on the one
before it. Ours stand within 2e-3 of it under a small load; from 10 to 366 N m the middle tooth
stays within 5e-3, the other, which bears near its tip, within 1.5e-2.
"""

import functools

import numpy as np
import pytest
from apparatus.dense_patches import love, pressed
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.contact import _Teeth
from asperity.drive.resolved.strip import BESIDE, FLANK, WHEEL_TIP, WORM_TIP, Frame, Strip
from asperity.drive.static.pressure import resolved
from asperity.drive.static.solve import StaticModel
from asperity.drive.teeth.sector import lattice
from asperity.drive.teeth.threads import thread_flexibility
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


OTHER = {10.0: 389.0, 41.0: 623.0, 100.0: 822.0, 366.0: 1294.0, 600.0: 1526.0}
OFF = 100.0
PATCH = 30e-6, 100e-6


def middle(load):
    _, found = at(0.75, ELASTIC, load=load)
    return next(tooth for tooth in found.teeth if tooth.number == 0)


@functools.cache
def dense(load, edges=PATCH):
    """Dense patches over what bears on the middle tooth, gaps of the rigid bodies, what they give.

    With the force that the condensed contact has there.
    """
    made = model(ELASTIC)
    balance, _ = at(0.75, ELASTIC, load=load)
    teeth = _Teeth.of(made.resolved, balance.contact, 0.75, balance.wheel_angle, balance.shift)
    tooth = middle(load)
    frame = tooth.strip.frame
    places = np.stack(np.meshgrid(frame.x, frame.y, indexing="ij"), axis=-1).reshape(-1, 2)
    bears = places[tooth.force > 0.0]
    low, high = bears.min(axis=0) - 3.0 * np.array(edges), bears.max(axis=0) + 3.0 * np.array(edges)
    x, y = (np.arange(a, b, step) for a, b, step in zip(low, high, edges, strict=True))
    approach = teeth.approaches[teeth.numbers.index(0)]
    strip = Strip.of(made.resolved.flank, Frame(frame.origin, frame.axes, x, y), approach)
    assert strip.off < 2e-9
    gap = np.where(strip.inside, approach.gaps(strip.points)[0], BESIDE)
    x, y = (values.ravel() for values in np.meshgrid(x, y, indexing="ij"))
    force = float(balance.action.normal[list(balance.action.teeth).index(0)])
    return strip, gap, love(x, y, edges, made.resolved.modulus), force


@functools.cache
def rest():
    """What a tooth gives beside a half-space at its nodes, (n, n), m/N, as the mesh has it."""
    flank, wheel = model(ELASTIC).resolved.flank, model(ELASTIC).problem.gearset.wheel_material
    surface = flank.sector.surface
    space = thread_flexibility(surface, wheel.youngs_modulus, wheel.poisson_ratio)
    count, normals = len(surface.positions), surface.nodal_normals
    block = (flank.sector.body.flexibility - space).reshape(count, 3, count, 3)
    return np.einsum("ic,icjd,jd->ij", normals, block, normals)


def linear(strip):
    """What makes values at patches of values at the nodes, linear between these."""
    surface = model(ELASTIC).resolved.flank.sector.surface
    nodes = lattice(surface)
    rows, columns = nodes.shape
    z = surface.positions[nodes[0], 2]
    u = np.interp(strip.share, np.linspace(0.0, 1.0, rows), np.arange(rows))
    v = np.interp(strip.points[:, 2], z, np.arange(columns))
    i, j = np.minimum(u.astype(int), rows - 2), np.minimum(v.astype(int), columns - 2)
    found, patches = np.zeros((len(u), nodes.size)), np.arange(len(u))
    for a, b in ((0, 0), (0, 1), (1, 0), (1, 1)):
        found[patches, nodes[i + a, j + b]] = np.abs(1 - a - u + i) * np.abs(1 - b - v + j)
    return found


@pytest.mark.parametrize("load", [load for load in OTHER if load != OFF])
def test_the_middle_of_a_flank_bears_as_in_another_implementation(load):
    assert middle(load).peaks()[FLANK] / 1e6 == pytest.approx(OTHER[load], rel=0.03)


@pytest.mark.parametrize("load", OTHER)
def test_what_the_other_implementation_assumed_gives_its_figures(load):
    strip, gap, sunk, force = dense(load)
    nodes = linear(strip)
    given = sunk + nodes @ rest() @ nodes.T * strip.area
    peak = pressed(gap, given, strip.area, force).max()
    assert peak / 1e6 == pytest.approx(OTHER[load], rel=5e-3)


def test_what_it_took_at_the_nodes_is_the_mesh_s_own():
    own, smooth = rest(), model(ELASTIC).resolved.flank.smooth[0]
    nodes = lattice(model(ELASTIC).resolved.flank.sector.surface)
    inner = nodes[3:-3, 3:-3]
    # Three elements apart both are the same; at the nodes themselves one is several times larger.
    far = inner[:, :-3].ravel(), inner[:, 3:].ravel()
    np.testing.assert_allclose(smooth[far], own[far], rtol=1e-12)
    ratio = (np.diag(own) / np.diag(smooth))[inner]
    assert ratio.min() > 2.0
    assert np.median(ratio) > 4.0


@pytest.mark.parametrize("load", OTHER)
def test_under_its_force_a_tooth_bears_as_dense_patches_on_half_spaces(load):
    strip, gap, sunk, _ = dense(load)
    tooth = middle(load)
    peak = pressed(gap, sunk, strip.area, tooth.normal).max()
    assert tooth.peaks()[FLANK] == pytest.approx(peak, rel=0.01)
    # The figure that is off ours is off theirs too, under the one force as under the other.
    if load == OFF:
        assert peak / 1e6 > 1.03 * OTHER[load]


def test_the_dense_patches_are_fine_enough():
    tooth = middle(OFF)
    coarse, fine = dense(OFF), dense(OFF, (20e-6, 67e-6))
    peaks = [pressed(gap, sunk, s.area, tooth.normal).max() for s, gap, sunk, _ in (coarse, fine)]
    assert peaks[0] == pytest.approx(peaks[1], rel=5e-3)
    assert peaks[1] == pytest.approx(hertz(0) * tooth.normal ** (1.0 / 3.0), rel=5e-3)


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


def test_root_relief_takes_the_wheel_s_edge_away_and_not_the_worm_s():
    def forces(*settings):
        pairs = []
        for beta in EDGE_BEARS:
            _, found = at(beta, ELASTIC, *settings)
            pairs.append(
                np.sum([tooth.forces()[[WHEEL_TIP, WORM_TIP]] for tooth in found.teeth], 0)
            )
        return np.array(pairs).T

    wheel, worm = forces()
    some, _ = forces("modification.root_relief=40 um")
    late, _ = forces("modification.root_relief=40 um", "modification.root_relief_start=0.5")
    none, still = forces("modification.root_relief=80 um", "modification.root_relief_start=0.1")
    bears = wheel > 10.0
    assert bears.any()
    assert (some[bears] < wheel[bears]).all()
    # Begun where the tips reach to it takes off more than half-way down the dedendum.
    assert some.sum() < late.sum()
    assert none.sum() < 0.1 * wheel.sum()
    # The worm's tip edge is not relieved by it, and bears what the rest of the flank lacks.
    assert (still > worm).all()


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
