"""Solids with the shafts of a case: their volumes are those of threads, rings and keyways."""

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.export.cad.brep import solid
from asperity.flanks.export.cad.keyway import cut_volume, keyed
from asperity.flanks.export.patch import Body
from asperity.flanks.export.turned import Bodies, sections_of, shaft_sections, threads_of, volume
from asperity.flanks.export.worm import whole_worm, worm_body
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

pytestmark = pytest.mark.slow


def bodies_of(*settings):
    case = read_case("actuator-shafts", case_tables(), settings)
    pair = Pair.of(case.require(Gearset))
    return pair, Bodies.of(case, pair)


@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("beside", ["30 mm", "36 mm", "50 mm"])
def test_a_worm_on_its_shaft_has_the_volume_of_both(hand, beside):
    # The root diameter is 31.9 mm, the tip diameter 45.7 mm: below, between and above.
    sections = (
        "worm_shaft.section=[{length='20 mm', diameter='25 mm', notch='keyway', fillet='1 mm'}, "
        f"{{length='40 mm', diameter='{beside}'}}, {{length='80 mm'}}, "
        "{length='50 mm', diameter='30 mm'}]"
    )
    pair, bodies = bodies_of(sections, f"gearset.hand={hand}")
    made = solid(whole_worm(pair, bodies))
    threads = solid(worm_body(pair, between=threads_of(pair, bodies))).check.volume
    turned = sum(-volume(section) for section in shaft_sections(pair, bodies))
    assert made.check.valid
    assert made.check.free_edges == 0
    assert made.check.volume == pytest.approx(threads + turned, rel=1e-6)
    cut = keyed(made, pair, bodies)
    lost = made.check.volume - cut.check.volume
    assert lost == pytest.approx(cut_volume("worm", pair, bodies), rel=1e-4)


def test_the_wheels_shaft_has_the_volume_of_its_section():
    pair, bodies = bodies_of()
    sections = sections_of(bodies.wheel)
    made = solid(Body("wheel_shaft", [], [], sections))
    assert made.check.volume == pytest.approx(-volume(sections[0]), rel=1e-9)
    cut = keyed(made, pair, bodies)
    lost = made.check.volume - cut.check.volume
    assert lost == pytest.approx(cut_volume("wheel_shaft", pair, bodies), rel=1e-4)
