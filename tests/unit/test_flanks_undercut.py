"""Undercut and interference: maps, and the flank that remains."""

import numpy as np
import pytest
from apparatus.gearsets import of_module_2

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.gaps import gaps
from asperity.flanks.wheel.interference import interference
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

pytestmark = pytest.mark.usefixtures("plain_kernels")


def _small(teeth=17):
    gearset = of_module_2(1, teeth, 10, "14.5 deg")
    return Wheel.cut(Pair.of(gearset))


def _edged():
    """A wheel with an edge on its flank: the base tangent plane is at the pitch cylinder."""
    gearset = of_module_2(4, 82, 8, "14.5 deg", -0.5)
    return Wheel.cut(Pair.of(gearset))


@pytest.mark.parametrize("make", [_small, _edged])
@pytest.mark.parametrize("side", [1, -1])
def test_hob_leaves_all_of_an_undercut_tooth(make, side):
    wheel = make()
    pair, flank = wheel.pair, wheel.flank(side)
    face = flank.grid(16, 13)
    for part in (face, flank.fillet(8, face.z[0])):
        least = gaps(part, pair.hob, pair.cut)
        assert np.abs(least).max() < 1e-12


def test_flank_of_an_undercut_tooth_begins_where_the_fillet_leaves_it():
    flank = _small().flank(1)
    z = np.linspace(-3.0, 3.0, 7)
    face, fillet = flank.grid(8, 7, z), flank.fillet(12, z)
    assert np.abs(fillet.points[-1] - face.points[0]).max() < 1e-12
    # There is an edge, the hob's flank ends lower, and the fillet ends before the hob's does.
    cosine = np.sum(fillet.normals[-1] * face.normals[0], axis=-1)
    assert np.all(cosine < 0.995)
    assert np.all(face.u[0] < 1.0)
    assert np.all(fillet.u[-1] > 1.0)
    # In the mid-plane the neck below is thinner than the tooth at the edge.
    assert fillet.angle[:, 3].min() < face.angle[0, 3]


def test_undercut_grows_as_teeth_become_fewer():
    lost = []
    for teeth in (30, 24, 20, 17):
        wheel = _small(teeth)
        start = wheel.flank(1).limits([0.0])[0][0]
        lost.append(start - wheel.pair.geometry.wheel_root_diameter / 2.0)
    assert np.all(np.diff(lost) > 0.0)


def test_edge_on_a_flank_is_flagged_and_the_flank_goes_on_behind_it():
    wheel = _edged()
    assert wheel.undercut
    flank = wheel.flank(1)
    column = flank.grid(60, 1, [-4.0])
    turned = np.sum(column.normals[1:] * column.normals[:-1], axis=-1)[:, 0]
    edge = int(np.argmin(turned))
    assert 0 < edge < 58
    # From one row to the next the hob has turned far; elsewhere it turns a little.
    steps = np.abs(np.diff(column.phase[:, 0]))
    assert steps[edge] > 5.0 * np.median(steps)
    assert np.all(np.diff(column.radius[:, 0]) > 0.0)


def test_map_has_the_hob_s_end_first_and_the_tip_last():
    wheel = _small(60)
    found = wheel.flank(1).undercut_map(9, 7)
    assert found.u.shape == found.radius.shape == found.z.shape == found.regularity.shape == (9, 7)
    assert np.all(found.u[0] == 1.0)
    assert np.all(found.radius[-1] >= wheel.blank.tip_radius(found.z[0]) - 1e-12)
    assert not found.undercut


def test_wheel_that_its_hob_cuts_again_is_refused():
    gearset = of_module_2(6, 60, 8, "17.5 deg", -0.5)
    with pytest.raises(InputError, match="undercuts the flank again"):
        Wheel.cut(Pair.of(gearset))


def test_worm_like_its_hob_touches_the_flank_and_clears_the_root():
    case = read_case("gearset-3b", case_tables(), ())
    wheel = Wheel.cut(Pair.of(case.require(Gearset), Hob()))
    found = interference(wheel)
    assert abs(found.flank_gap.min()) < 1e-12
    assert found.fillet_gap.min() > 0.0
    assert found.root_gap.min() == pytest.approx(wheel.pair.geometry.clearance, abs=1e-9)
    assert found.least > 0.0


def test_worm_that_stands_too_near_interferes_with_the_root():
    case = read_case("gearset-3b", case_tables(), ())
    too_near = Mount(centre_distance_error="-0.45 mm")
    wheel = Wheel.cut(Pair.of(case.require(Gearset), Hob(), too_near))
    found = interference(wheel)
    expected = wheel.pair.geometry.clearance - 0.45
    assert found.least < 0.0
    assert found.root_gap[:, 6].min() == pytest.approx(expected, abs=1e-6)
    assert found.root.z[0, 6] == pytest.approx(0.0, abs=1e-12)
