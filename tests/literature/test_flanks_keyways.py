"""Keyways of DIN 6885-1 in the solids: what they take away is known in closed form."""

import pytest

from asperity.errors import InputError
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.brep import solid
from asperity.flanks.export.cad.keyway import cut_volume, key_of, keyed, require_keys
from asperity.flanks.export.worm import whole_worm
from asperity.flanks.study.flank import prepare_gearset, study
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.blanks import Blanks

GIVEN = {
    "starts": 2, "wheel_teeth": 30, "centre_distance": "50 mm", "axial_module": "2.5 mm",
    "worm_material": "case-hardened steel", "wheel_material": "CuSn12-C-GZ",
}  # fmt: skip
BOTH = Blanks(keyways="both", chamfer="0 mm")
NONE = Blanks(chamfer="0 mm")


@pytest.mark.parametrize(("diameter", "width"), [(8, 2), (8.5, 3), (25, 8), (30, 8), (30.5, 10)])
def test_widths_of_keys(diameter, width):
    assert key_of(diameter, "").width == width


@pytest.mark.slow
@pytest.mark.parametrize("hand", ["right", "left"])
def test_the_worm_loses_what_the_key_takes(hand):
    pair = Pair.of(Gearset(**GIVEN, hand=hand))
    plain = solid(whole_worm(pair, NONE))
    cut = keyed(plain, pair, BOTH)
    assert cut.check.valid
    assert cut.check.free_edges == 0
    lost = plain.check.volume - cut.check.volume
    assert lost == pytest.approx(cut_volume("worm", pair, BOTH), rel=1e-4)
    assert keyed(plain, pair, NONE) is plain


@pytest.mark.slow
def test_the_wheel_loses_what_the_key_takes():
    from asperity.flanks.export.tooth import wheel_body

    wheel = prepare_gearset(Gearset(**GIVEN), density="coarse").wheel
    plain = solid(wheel_body(wheel, NONE))
    cut = keyed(plain, wheel.pair, BOTH)
    assert cut.check.valid
    lost = plain.check.volume - cut.check.volume
    assert lost == pytest.approx(cut_volume("wheel", wheel.pair, BOTH), rel=1e-3)


def test_keys_that_do_not_fit_are_refused():
    pair = Pair.of(Gearset(**GIVEN))
    for blanks, said in (
        ({"bore": "5 mm", "keyways": "wheel"}, r"blank\.bore is 5 mm; keys are known above 6"),
        ({"bore": "20 mm", "hub_diameter": "24 mm", "keyways": "both"}, "the hub's wall is 2 mm"),
        ({"drive_end": "0 mm", "keyways": "worm"}, "no shaft at its driven end"),
    ):
        with pytest.raises(InputError, match=said):
            require_keys(pair, Blanks(**blanks))
    require_keys(pair, None)
    require_keys(pair, Blanks(bore="5 mm"))


@pytest.mark.slow
def test_a_study_without_keyways_is_what_it_was():
    assert Blanks().keyways == "none"
    found = study(prepare_gearset(Gearset(**GIVEN), density="coarse"))
    assert "keyways_mm" not in found.sizes
    assert isinstance(found.assembly, Assembly)
