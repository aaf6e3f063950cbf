"""A worm that stands off by tolerances stands where one does whose [mount] says the same."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.measuring.corners import Offset
from asperity.flanks.parameters import Mount
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset


@pytest.mark.parametrize("hand", ["right", "left"])
def test_an_offset_is_what_mount_has_of_either_hand_and_adds_to_what_is_there(hand):
    gearset = read_case("gearset-3", case_tables(), [f"gearset.hand={hand}"]).require(Gearset)
    off = Mount(
        centre_distance_error="0.03 mm", axial_offset="-0.2 mm", shaft_angle_error="0.1 deg",
        units="SI",
    )  # fmt: skip
    offset = Offset(0.03, -0.2, math.radians(0.1))
    there, twice = Pair.of(gearset, None, off), offset.of(offset.of(Pair.of(gearset)))
    found = offset.of(Pair.of(gearset)).mounting
    for name in ("centre_distance", "axial_offset", "tilt"):
        wanted, nominal = (getattr(pair.mounting, name) for pair in (there, Pair.of(gearset)))
        assert getattr(found, name) == pytest.approx(wanted, rel=1e-12)
        assert getattr(twice.mounting, name) == pytest.approx(2.0 * wanted - nominal, rel=1e-12)
