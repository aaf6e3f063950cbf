"""What holds for any gearset that is rated."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate, variants
from asperity.rating.demands import DEMANDS
from asperity.rating.iso14521.efficiency import wheel_driving_efficiency
from asperity.rating.self_locking import locking_friction
from asperity.rating.standards import judge_of

VARIED = {
    "diameter_factor": (6.0, 18.0),
    "axial_module": (1.5e-3, 12e-3),
    "pressure_angle": (math.radians(14.6), math.radians(29.9)),
    "worm_roughness": (0.2e-6, 3e-6),
    "worm_speed": (30.0, 300.0),
    "output_torque": (20.0, 900.0),
    "friction_factor": (0.0, 1.5),
}
MATERIALS = [
    "CuSn12-C-GZ", "CuSn12Ni2-C-GZ", "CuAl10Fe5Ni5-C-GZ", "EN-GJS-400-15", "EN-GJL-250"
]  # fmt: skip
OILS = ["ISO VG 220 mineral", "ISO VG 220 polyalphaolefin", "ISO VG 220 polyglycol"]


@st.composite
def tables(draw):
    starts = draw(st.integers(1, 4))
    numbers = {name: draw(st.floats(*bounds)) for name, bounds in VARIED.items()}
    gearset = {
        "starts": starts,
        "wheel_teeth": starts * draw(st.integers(8, 40)),
        "axial_module": numbers["axial_module"],
        "diameter_factor": numbers["diameter_factor"],
        "profile_shift": draw(st.floats(-0.5, 0.5)),
        "pressure_angle": numbers["pressure_angle"],
        "worm_roughness": numbers["worm_roughness"],
        "flank": draw(st.sampled_from(["ZI", "ZA", "ZC"])),
        "tooth_proportions": draw(st.sampled_from(["bs721", "iso"])),
        "worm_material": "case-hardened steel",
        "wheel_material": draw(st.sampled_from(MATERIALS)),
    }
    operation = {
        "worm_speed": numbers["worm_speed"],
        "output_torque": numbers["output_torque"],
        "lubricant": draw(st.sampled_from(OILS)),
        "lubrication": draw(st.sampled_from(["bath", "spray"])),
        "bearings": draw(st.sampled_from(["fixed-floating", "preloaded"])),
        "life": draw(st.floats(1e5, 1e9)),
        "oil_temperature": draw(st.sampled_from([None, 333.15])),
    }
    options = {
        "iso14521_edition": draw(st.sampled_from(["1998", "2010"])),
        "friction_factor": numbers["friction_factor"],
    }
    try:
        return (
            Gearset(**gearset, units="SI"),
            Operation(**operation, units="SI"),
            RatingOptions(**options, units="SI"),
        )
    except InputError:
        # The teeth of a steep worm vanish by BS 721.
        assume(False)


def numbers_of(rating):
    return {
        entry.key: float(entry.value)
        for entry in rating
        if isinstance(entry.value, int | float) and not isinstance(entry.value, bool)
    }


@pytest.mark.slow
@given(tables())
def test_input_is_output_and_losses(case):
    iso = rate(*case).iso14521
    assume(iso is not None)
    losses = sum(iso[f"loss_{part}_W"] for part in ("meshing", "idle", "bearing", "seal"))
    assert iso["input_power_W"] == pytest.approx(iso["output_power_W"] + losses, rel=1e-12)
    assert iso["eta_ges"] == pytest.approx(iso["output_power_W"] / iso["input_power_W"], rel=1e-12)
    shaft = iso["input_torque_Nm"] * iso["worm_speed_rpm"] * 2.0 * math.pi / 60.0
    assert shaft == pytest.approx(iso["input_power_W"], rel=1e-12)


@pytest.mark.slow
@settings(max_examples=30)
@given(tables())
def test_a_safety_judged_alone_is_that_of_the_whole_rating(case):
    gearset, operation, options = case
    rated = rate(*case)
    for demand in DEMANDS:
        judge = judge_of(demand, options, rated.tables_bs721)
        if demand.standard in rated.found and demand.key in rated.found[demand.standard]:
            assert judge(gearset, operation) == rated.found[demand.standard][demand.key]
        else:
            with pytest.raises(InputError):
                judge(gearset, operation)


@pytest.mark.slow
@given(tables())
def test_efficiency_falls_with_friction(case):
    gearset, operation, options = case
    factors = np.linspace(0.0, 1.5, 16)
    found = variants(gearset, operation, options, friction_factor=factors)
    for key in ("iso14521.eta_z1_2", "iso14521.eta_z2_1", "bs721.eta", "agma6034.eta"):
        if key in found:
            eta = found[key][np.isfinite(found[key])]
            assert (np.diff(eta) < 0.0).all()


@pytest.mark.slow
@given(tables())
def test_wheel_can_drive_exactly_where_the_lead_angle_is_above_the_friction_angle(case):
    rated = rate(*case)
    lead = case[0].geometry.lead_angle
    for rating, mu, eta in (
        (rated.iso14521, "mu_zm", "eta_z2_1"),
        (rated.bs721, "mu", "eta_back"),
    ):
        if rating is not None:
            assert (rating[eta] <= 0.0) == (lead <= math.atan(rating[mu]))
    for verdict in rated.self_locking:
        if abs(verdict.friction / verdict.limit - 1.0) > 1e-12:
            assert verdict.locks == (verdict.friction > verdict.limit)


@given(st.floats(0.02, 1.4), st.floats(-1e-9, 1e-9))
def test_worm_at_its_limit_locks_and_a_little_less_friction_sets_it_free(lead, nudge):
    limit = locking_friction(lead)
    assume(abs(nudge) > 1e-12)
    assert (wheel_driving_efficiency(lead, limit * (1.0 + nudge)) <= 0.0) == (nudge > 0.0)


def assert_first_is_alone(rated, found):
    for name, rating in rated.found.items():
        alone = numbers_of(rating)
        for key in found:
            standard, _, number = key.partition(".")
            if standard == name and number in alone:
                assert found[key][0] == pytest.approx(alone[number], rel=1e-13, abs=1e-300), key
            elif standard == name and "worm" not in number:
                assert math.isnan(found[key][0]), key


@pytest.mark.slow
@given(tables(), st.floats(6.0, 18.0))
def test_a_variant_in_an_array_is_the_gearset_alone(case, q):
    gearset, operation, options = case
    found = variants(
        *case,
        starts=[gearset.starts] * 2,
        wheel_teeth=[gearset.wheel_teeth] * 2,
        diameter_factor=[gearset.diameter_factor, q],
        pressure_angle=[gearset.pressure_angle] * 2,
        output_torque=[operation.output_torque] * 2,
        friction_factor=[options.friction_factor, 1.0],
    )
    assert_first_is_alone(rate(*case), found)


@pytest.mark.slow
@given(tables(), st.floats(6.0, 18.0))
def test_efficiency_of_a_variant_whose_numbers_come_in_si_is_that_of_the_gearset_alone(case, q):
    # Not all numbers: a difference of near ones multiplies the last digit of a conversion.
    gearset, operation, _ = case
    found = variants(
        *case,
        ("iso14521",),
        capacity=False,
        diameter_factor=[gearset.diameter_factor, q],
        axial_module=[gearset.axial_module] * 2,
        centre_distance=[gearset.geometry.centre_distance * 1e-3] * 2,
        worm_speed=[operation.worm_speed] * 2,
        worm_roughness=[gearset.worm_roughness] * 2,
    )
    iso = rate(*case).iso14521
    assume(iso is not None and iso["h_star"] > 0.02)
    for key in ("sliding_velocity_m_s", "mu_zm", "eta_z1_2", "eta_ges", "input_power_W"):
        assert found[f"iso14521.{key}"][0] == pytest.approx(iso[key], rel=1e-13)


@pytest.mark.slow
@given(tables())
def test_units_of_the_input_change_nothing(case):
    gearset, operation, options = case
    metres = {
        **{key: getattr(gearset, key) for key in gearset.model_fields_set},
        "axial_module": f"{gearset.axial_module * 1e3!r} mm",
        "pressure_angle": f"{math.degrees(gearset.pressure_angle)!r} deg",
        "worm_roughness": f"{gearset.worm_roughness!r} m",
    }
    turns = {
        **{key: getattr(operation, key) for key in operation.model_fields_set},
        "worm_speed": f"{operation.worm_speed / (2.0 * math.pi)!r} rev/s",
        "output_torque": f"{operation.output_torque * 1e3!r} N mm",
        "life": f"{operation.life / 3600.0!r} h",
    }
    one, other = (
        rate(*case),
        rate(Gearset(**metres, units="SI"), Operation(**turns, units="SI"), options),
    )
    assert one.found.keys() == other.found.keys()
    for name, rating in one.found.items():
        changed = numbers_of(other.found[name])
        for key, value in numbers_of(rating).items():
            assert changed[key] == pytest.approx(value, rel=1e-11, abs=1e-11)


@pytest.mark.slow
@given(tables())
def test_nothing_in_a_rating_is_missing_without_a_note(case):
    rated = rate(*case)
    for name in ("iso14521", "bs721", "agma6034"):
        rating = getattr(rated, name)
        if rating is None:
            assert any(note.startswith(f"{name}: ") for note in rated.notes)
        else:
            assert all(math.isfinite(value) for value in numbers_of(rating).values())
            if name == "iso14521" and "safety_wear" not in rating:
                assert rating.notes
