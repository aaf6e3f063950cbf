"""What sizing keeps beside the safeties, and the loads that it follows."""

import math
import tomllib

import pytest

from asperity.cli.size import size
from asperity.errors import InputError
from asperity.start.gear import begun, proposals
from asperity.studies.requirements import special_hob

STEPS = [
    {"duration": "500 h", "output_torque": "250 N m"},
    {"duration": "3000 h", "output_torque": "60 N m"},
]


def sized(ratio=50, *, gearset=None, operation=None, **tables):
    values = begun()
    run = {"output_torque": "250 N m", "worm_speed": "1400 rpm",
           "lubricant": "ISO VG 220 polyglycol"}  # fmt: skip
    values["operation"] = {**values["operation"], **run, **(operation or {})}
    if operation and "duty_cycle" in operation:
        del values["operation"]["life"]
    values["gearset"] |= gearset or {}
    return proposals(values | tables, ratio)


def test_nothing_asked_is_what_is_proposed_without_the_table():
    assert sized().found == sized(requirements={}).found


def test_a_tolerance_of_the_ratio_is_kept():
    for tolerance in ("3 %", "1 %", "10 %"):
        found = sized(47.7, requirements={"ratio_tolerance": tolerance}).found
        off = [abs(one.wheel_teeth / one.starts / 47.7 - 1.0) for one in found]
        assert max(off) <= float(tolerance[:-2]) / 100.0
    assert max(off) > 0.0
    with pytest.raises(InputError, match=r"no gearset of the series has within 0\.1 %"):
        sized(47.7, requirements={"ratio_tolerance": "0.1 %"})


def test_self_locking_is_wanted_or_avoided_by_every_standard_at_rest():
    wanted = sized(requirements={"self_locking": "wanted"})
    assert all(len(one.locks_at_rest) == 3 for one in wanted.found)
    assert any("self-locking wanted" in note for note in wanted.notes)
    avoided = sized(15, requirements={"self_locking": "avoided"})
    assert all(one.locks_at_rest == () for one in avoided.found)
    with pytest.raises(InputError, match=r"self-locking wanted by 90 times, which no gearset"):
        sized(requirements={"self_locking": "wanted", "locking_margin": 90})


def test_a_margin_of_self_locking_leaves_fewer():
    plain = sized(requirements={"self_locking": "wanted"})
    wide = sized(requirements={"self_locking": "wanted", "locking_margin": 1.12})
    assert wide.holding < plain.holding
    # At 12.5 the friction at rest is 12 % above that which locks: 0.0897 of 0.08.
    assert all(one.starts / one.diameter_factor * 1.12 <= 0.0897 for one in wide.found)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("key", ["centre_distance", "wheel_diameter", "worm_length"])
def test_room_is_kept(key):
    def size(one):
        if key == "centre_distance":
            return one.centre_distance_mm
        throat = one.axial_module_mm * (one.wheel_teeth + 2.0 * one.profile_shift + 2.0)
        if key == "wheel_diameter":
            return throat
        # The chord that the line of the worm's tip cuts from the wheel's outside circle.
        outside = 0.5 * (throat + one.axial_module_mm)
        gap = one.centre_distance_mm - 0.5 * one.axial_module_mm * (one.diameter_factor + 2.0)
        return 2.0 * math.sqrt(outside**2 - gap**2)

    free = sorted(size(one) for one in sized(20).found)
    most = 0.5 * (free[0] + free[-1])
    kept = [size(one) for one in sized(20, requirements={key: f"{most} mm"}).found]
    assert free[0] <= max(kept) <= most < free[-1]


def test_a_pressure_angle_of_no_series_is_told():
    assert special_hob(math.radians(20.0)) == ()
    (said,) = special_hob(math.radians(15.0))
    assert said == "a pressure angle of 15 deg takes a special hob: the series is of 20 deg"
    assert said in sized(gearset={"pressure_angle": "15 deg"}).notes
    assert not any("special hob" in note for note in sized().notes)


def test_safeties_are_so_many_times_what_is_asked():
    found = sized(requirements={"safety": 1.5}).found
    assert all(one.margin >= 1.5 and one.holds for one in found)


@pytest.mark.slow
def test_sizes_follow_the_loads_of_a_life():
    constant = sized(operation={"life": "3500 h"})
    spectral = sized(spectrum={"step": STEPS})
    by_duty = sized(operation={"duty_cycle": STEPS})
    assert spectral.found == by_duty.found
    light = sized(spectrum={"step": STEPS[1:]})
    assert light.holding > constant.holding
    heavy = sized(spectrum={"step": STEPS, "hours_per_day": 24, "shock": "heavy"})
    assert heavy.holding < spectral.holding


def test_a_housing_counts_in_sizing():
    cool = sized(housing={"heat_transfer": "25 W/(m**2 K)"})
    warm = sized(housing={"heat_transfer": "5 W/(m**2 K)"})
    assert warm.found != cool.found


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"self_locking": "yes"}, r"requirements\.self_locking is 'yes'; it must be one of"),
        ({"ratio_tolerance": "90 %"}, r"requirements\.ratio_tolerance is '90 %'"),
        ({"locking_margin": 0.5}, r"requirements\.locking_margin is 0\.5; it must be at least 1"),
        ({"space": "1 m"}, r"requirements\.space is not a key of \[requirements\]"),
    ],
)
def test_what_requirements_cannot_be_is_one_line(given, said):
    with pytest.raises(InputError, match=said):
        sized(requirements=given)


def test_the_ratio_may_be_required():
    asked = {"requirements": {"ratio": 47.7, "ratio_tolerance": "1 %"}}
    assert sized(None, **asked).found == sized(47.7, requirements={"ratio_tolerance": "1 %"}).found
    with pytest.raises(InputError, match=r"ratio is 40, and requirements\.ratio 47\.7"):
        sized(40, **asked)
    with pytest.raises(InputError, match=r"ratio is missing: give --ratio 40, or --set require"):
        sized(None)


@pytest.mark.slow
def test_a_proposal_under_a_spectrum_is_written_without_another_life(tmp_path):
    spectrum = "spectrum.step=[{duration='5000 h', output_torque='250 N m'}]"
    asked = {"output_torque": "250 N m", "worm_speed": "1400 rpm"}

    def written(folder, *settings):
        out = tmp_path / folder
        size("", "50", asked, settings, "size", "", ("", ""), cut=False, as_json=True, out=out)
        return tomllib.loads((tmp_path / folder / "proposal-1.toml").read_text())

    assert "life" in written("plain")["operation"]
    assert "life" not in written("steps", spectrum)["operation"]
    # What somebody says stands.
    kept = written("both", spectrum, "operation.life=100 h")["operation"]
    assert kept["life"] == "100 h"
