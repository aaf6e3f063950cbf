"""Where sections of the cut wheel begin, and where the flank of a hob has a break."""

import pytest
from apparatus.gearsets import of_module_2

from asperity.flanks.wheel.cutting.conjugate import conjugate
from asperity.flanks.wheel.cutting.trim import base_break, first_psi, next_break
from asperity.flanks.worm.curve import curve, width
from asperity.flanks.worm.setting import Pair

pytestmark = pytest.mark.usefixtures("plain_kernels")


def _pair(flank, starts=1, diameter_factor=10.0):
    return Pair.of(of_module_2(starts, 40, diameter_factor, flank=flank))


@pytest.mark.parametrize("offset", [0.0, 0.7])
@pytest.mark.parametrize("u", [0.4, 1.3, 2.0, 3.0])
def test_a_hob_that_is_not_tilted_cuts_a_place_where_its_section_begins(u, offset):
    pair = _pair("ZA")
    hob, cut = pair.hob.thread, pair.cut._replace(axial_offset=offset)
    assert cut.sine == 0.0
    for z in (-6.0, -1.5, 0.0, 0.2, 5.0):
        psi = first_psi(u, z, hob, cut)
        for side in (1, -1):
            assert conjugate(u, psi, side, hob, cut)[2] == pytest.approx(z, abs=1e-13)


def test_below_the_base_cylinder_an_involute_hob_is_radial():
    # Of many starts and a thin core: its base cylinder is above the root.
    hob = _pair("ZI", starts=6, diameter_factor=8.0).hob
    form, break_at = hob.thread.form, base_break(hob.thread)
    base = float(form["base"])
    assert hob.root_radius < base < hob.flank_end
    assert curve(break_at, hob.thread)[0] == pytest.approx(base, rel=1e-13)
    assert curve(break_at, hob.thread)[3] == 0.0
    assert width(1.001 * base, hob.thread)[1] != 0.0
    assert [next_break(u, hob.thread) for u in (1.5, 1.0, break_at)] == [1.0, break_at, 0.0]


def test_a_straight_flank_has_no_break_but_its_ends():
    hob = _pair("ZA").hob.thread
    assert [next_break(u, hob) for u in (1.5, 1.0, 0.1)] == [1.0, 0.0, 0.0]
