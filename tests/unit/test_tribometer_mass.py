"""What a disc lost is its first weighing less its last, and what that is over force and path."""

from types import SimpleNamespace

import pytest

from asperity.tribometer.reduction.wear import (
    Weighing,
    archard,
    mass_loss,
    path_change,
    path_of,
    path_share,
)


def events(*pairs):
    return [SimpleNamespace(kind=kind, text=text) for kind, text in pairs]


def test_a_disc_lost_what_it_weighs_less_in_the_end():
    told = events(
        ("mass_steel", "182.3140 g"), ("mass_bronze", "96.5 g"), ("note", "1 g"),
        ("mass_steel", "182.3135 g"), ("mass_steel", "0.1823120 kg"), ("mass_bronze", "later"),
        ("mass_bronze", "12 bananas"),
    )  # fmt: skip
    assert mass_loss(told, "steel") == pytest.approx(2.0e-6, rel=1e-6)
    # What grew has lost less than nothing.
    assert mass_loss(told[::-1], "steel") == pytest.approx(-2.0e-6, rel=1e-6)
    # One weighing, or none, tells no loss.
    assert mass_loss(told, "bronze") is None
    assert mass_loss([], "steel") is None
    both = Weighing("a", {"steel": (3e-3, 2e-3), "bronze": (5e-3, 5.5e-3)}, ())
    assert both.losses == pytest.approx({"steel": 1e-3, "bronze": -0.5e-3})


def test_archard_s_coefficient_is_volume_times_hardness_over_force_and_path():
    disc = SimpleNamespace(density=8000.0, hardness=1.2e9)
    # 4 mg are 0.5 mm3.
    assert archard(4e-6, disc, 25.0, 300.0) == pytest.approx(0.5e-9 * 1.2e9 / (25.0 * 300.0))
    assert archard(None, disc, 25.0, 300.0) is None
    for path in (None, 0.0, -1.0):
        assert archard(4e-6, disc, 25.0, path) is None
    for name in ("density", "hardness"):
        unknown = SimpleNamespace(**{**vars(disc), name: None})
        assert archard(4e-6, unknown, 25.0, 300.0) is None


def test_paths_add_up_where_all_of_them_are_known():
    files = [SimpleNamespace(path=path) for path in (10.0, 2.5, 4.0)]
    assert path_of(files) == 16.5
    assert path_of([*files, SimpleNamespace(path=None)]) is None


@pytest.mark.parametrize("mode", ["longitudinal", "transverse"])
@pytest.mark.parametrize("k", [1.3, 2.0, 5.0])
def test_a_path_changes_by_its_slope(mode, k):
    slope = (path_share(k * (1 + 1e-6), mode) - path_share(k * (1 - 1e-6), mode)) / (2e-6 * k)
    assert path_change(k, mode, 1e-3) == pytest.approx(slope * k * 1e-3, rel=1e-4)
    # A vibration that outruns all lets go of the mean: the path goes as 2k/pi.
    assert path_share(1e4, mode) == pytest.approx(2e4 / 3.141592653589793, rel=1e-6)
