"""What holds for every worm gearset by ISO/TR 14521."""

import functools
import math
from typing import get_args

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asperity.gearset import Gearset, relations
from asperity.gearset.materials import BaseOilName, Family
from asperity.rating import Operation, RatingOptions, variants
from asperity.rating import iso14521 as iso
from asperity.rating.iso14521.film_failure import film_limits
from asperity.rating.iso14521.tables import Lubrication

leads = st.floats(0.01, 1.2)
frictions = st.floats(0.0, 0.3)
numbers = st.fixed_dictionaries(
    {
        "starts": st.integers(1, 6).map(float),
        "wheel_teeth": st.integers(20, 100).map(float),
        "diameter_factor": st.floats(6.0, 18.0),
        "axial_module": st.floats(0.8, 20.0),
        "profile_shift": st.floats(-0.5, 0.5),
        "pressure_angle": st.floats(math.radians(14.5), math.radians(30.0)),
        "worm_speed": st.floats(5.0, 3600.0),
        "worm_roughness": st.floats(0.1, 6.3),
        "output_torque": st.floats(1.0, 1e4),
    }
)
options = st.fixed_dictionaries(
    {
        "lubrication": st.sampled_from(["bath", "spray"]),
        "edition": st.sampled_from(["1998", "2010"]),
        "flank": st.sampled_from(["ZI", "ZC"]),
    }
)
GEARSET = {
    "worm_material": "case-hardened steel",
    "wheel_material": "CuSn12-C-GZ",
    "starts": 2,
    "wheel_teeth": 40,
    "axial_module": 4e-3,
    "diameter_factor": 10.0,
    "profile_shift": 0.0,
}
OPERATION = {"worm_speed": 150.0, "output_torque": 300.0, "lubricant": "ISO VG 220 mineral"}


def rated(options, **varied):
    """Efficiencies and frictions of variants; in SI, but for what has no unit."""
    flank = {"flank": options["flank"]}
    gearset = Gearset(**GEARSET, **flank, units="SI")
    how = RatingOptions(iso14521_edition=options["edition"])
    operation = Operation(**OPERATION, lubrication=options["lubrication"], units="SI")
    return variants(gearset, operation, how, ("iso14521",), capacity=False, **varied)


def in_si(gearset):
    """Numbers of a gearset as variants take them."""
    size = {"axial_module": 1e-3, "worm_speed": math.pi / 30.0, "worm_roughness": 1e-6}
    return {name: np.array([value * size.get(name, 1.0)]) for name, value in gearset.items()}


@given(leads, frictions, frictions)
def test_efficiency_of_the_teeth_falls_with_friction(lead, one, other):
    low, high = sorted((one, other))
    assume(high - low > 1e-9 and lead + math.atan(high) < 1.5)
    assert iso.efficiency.worm_driving_efficiency(
        lead, low
    ) > iso.efficiency.worm_driving_efficiency(lead, high)
    assert iso.efficiency.wheel_driving_efficiency(
        lead, low
    ) > iso.efficiency.wheel_driving_efficiency(lead, high)


@given(leads)
def test_without_friction_nothing_is_lost_between_the_teeth(lead):
    assert iso.efficiency.worm_driving_efficiency(lead, 0.0) == 1.0
    assert iso.efficiency.wheel_driving_efficiency(lead, 0.0) == 1.0
    assert iso.losses.meshing_loss(100.0, 1000.0, 20.0, 1.0) == 0.0


@given(leads, st.floats(0.0, 3.0), st.integers(-3, 3))
def test_wheel_cannot_drive_exactly_where_the_lead_is_within_the_friction_angle(lead, mu, steps):
    near = math.tan(lead)
    for _ in range(abs(steps)):
        near = math.nextafter(near, math.inf if steps > 0 else 0.0)
    for friction in (mu, near):
        efficiency = iso.efficiency.wheel_driving_efficiency(lead, friction)
        assert (efficiency <= 0.0) == (lead <= np.arctan(friction))


@pytest.mark.slow
@given(numbers, options)
@settings(max_examples=50)
def test_centre_distance_and_profile_shift_lead_to_the_same_answer(gearset, words):
    numbers = in_si(gearset)
    shift = numbers["profile_shift"]
    del numbers["axial_module"]
    by_shift = rated(words, **numbers, axial_module=[4e-3])
    distance = 1e-3 * by_shift.rating_inputs.centre_distance
    del numbers["profile_shift"]
    by_distance = rated(words, **numbers, axial_module=[4e-3], centre_distance=distance)
    assert by_distance.rating_inputs.profile_shift == pytest.approx(shift, abs=1e-12)
    for key in ("iso14521.eta_z1_2", "iso14521.eta_ges"):
        np.testing.assert_allclose(by_distance[key], by_shift[key], rtol=1e-10)


@given(numbers, st.sampled_from(["1998", "2010"]), st.sampled_from(["ZI", "ZC"]))
@settings(max_examples=50)
def test_at_its_limits_the_film_parameter_is_zero(gearset, edition, flank):
    z1, z2, q = (gearset[name] for name in ("starts", "wheel_teeth", "diameter_factor"))
    m, alpha, x2 = (gearset[name] for name in ("axial_module", "pressure_angle", "profile_shift"))
    words = {"edition": edition, "flank": flank}
    shape = {n: v for n, v in gearset.items() if n in iso.film.film_parameter.parameters}
    limits = film_limits(iso.film.film_parameter.body, {**shape, **words})
    a = relations.centre_distance(m, q, z2, x2)
    for name, value in limits.items():
        if value is None:
            continue
        now = {"q": q, "m": m, "z2": z2, "a": a, "alpha": alpha}
        key = {
            "ratio": "z2",
            "axial_module": "m",
            "centre_distance": "a",
            "diameter_factor": "q",
            "pressure_angle": "alpha",
        }[name]
        now[key] = value * z1 if name == "ratio" else value
        sides = []
        for factor in (1.0 - 1e-6, 1.0 + 1e-6):
            side = {**now, key: now[key] * factor}
            shift = relations.profile_shift(side["a"], side["m"], side["q"], side["z2"])
            masked = iso.film.film_parameter(
                *(np.array([x]) for x in (z1, side["z2"], side["q"], side["m"], side["alpha"])),
                np.array([shift]),
                **words,
                on_invalid="mask",
            )
            sides.append(masked.reason[0] > 0)
        assert sides[0] != sides[1], name


@pytest.mark.slow
@given(numbers, options)
@settings(max_examples=50)
def test_more_roughness_or_base_friction_never_helps(gearset, words):
    numbers = in_si(gearset)
    rough = {**numbers, "worm_roughness": numbers["worm_roughness"] * np.array([1.0, 1.1])}
    for varied in ({**numbers, "base_friction": [0.03, 0.04]}, rough):
        eta = rated(words, **varied)["iso14521.eta_z1_2"]
        assert np.isnan(eta).all() or not eta[0] <= eta[1]


@given(leads, frictions, st.floats(1.0, 1e5), st.floats(0.2, 0.6))
def test_forces_give_the_work_that_the_efficiency_says(lead, mu, force, alpha):
    assume(lead + math.atan(mu) < 1.5)
    worm = iso.forces.worm_tangential_force(force, lead, mu)
    # One turn of the worm advances the wheel's pitch circle by the lead.
    assert force * math.tan(lead) / worm == pytest.approx(
        iso.efficiency.worm_driving_efficiency(lead, mu), rel=1e-12
    )
    assert iso.forces.separating_force(worm, alpha, lead, mu) > 0.0


def branch_points():
    """Where formulas bend, in their own units: name, formula and place."""
    for family in (each for each in get_args(Family) if each != "plastic"):
        for lubrication in get_args(Lubrication):
            for oil in get_args(BaseOilName):
                words = {"family": family, "lubrication": lubrication, "base_oil": oil}
                law = iso.tables.friction_constants(family, lubrication, oil)
                cap = (law.gain / (law.cap - law.offset)) ** (1.0 / law.exponent) - law.shift
                if cap > 0.0:
                    yield functools.partial(iso.friction.base_friction, **words), cap
                wear = iso.tables.wear_constants(family, lubrication, oil)
                if math.isfinite(wear.cap):
                    cap = (wear.scale / wear.cap) ** (1.0 / wear.exponent)
                    yield functools.partial(iso.wear.reference_wear_intensity, **words), cap
    yield iso.wear.pressure_factor, 450.0
    yield iso.wear.start_factor, 200.0
    yield iso.pitting.pitting_life_factor, 25000.0 / 1.6**6
    yield iso.pitting.pitting_ratio_factor, 20.5
    yield iso.thermal.heat_transfer_coefficient, 150.0


def test_no_formula_but_the_rim_factor_jumps_at_its_branch_points():
    places = list(branch_points())
    assert len(places) > 20
    for formula, at in places:
        below, above = (formula(math.nextafter(at, end)) for end in (-math.inf, math.inf))
        assert above == pytest.approx(below, rel=1e-12), formula


@given(st.floats(1e-3, 1e3), st.floats(1e-12, 1e-9))
def test_the_bent_curves_are_continuous_everywhere(value, step):
    for formula, scale in (
        (iso.friction.base_friction, 1.0),
        (iso.wear.pressure_factor, 1.0),
        (iso.wear.start_factor, 1.0),
        (iso.pitting.pitting_life_factor, 100.0),
        (iso.pitting.pitting_ratio_factor, 1.0),
        (iso.thermal.heat_transfer_coefficient, 1.0),
        (iso.wear.reference_wear_intensity, 0.01),
    ):
        one, other = formula(scale * value), formula(scale * value * (1.0 + step))
        assert other == pytest.approx(one, rel=10.0 * step + 1e-14), formula.__name__
