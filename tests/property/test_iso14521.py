"""What holds for every worm gearset by ISO/TR 14521."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asperity.gearset import relations
from asperity.rating import iso14521 as iso

leads = st.floats(0.01, 1.2)
frictions = st.floats(0.0, 0.3)
materials = st.sampled_from(["CuSn12-C-GZ", "CuAl10Fe5Ni5-C-GZ", "EN-GJS-400-15", "EN-GJL-250"])
oils = st.sampled_from(["mineral", "polyalphaolefin", "polyglycol"])
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
LOSSES = ("loss_meshing", "loss_idle", "loss_bearing", "loss_seal")
ANSWERS = (
    "centre_distance",
    "lead_angle",
    "sliding_velocity",
    "base_friction",
    "size_factor",
    "geometry_factor",
    "roughness_factor",
    "mean_friction",
    "efficiency",
    "output_power",
    *LOSSES,
    "input_power",
    "total_efficiency",
)


@given(leads, frictions, frictions)
def test_efficiency_of_the_teeth_falls_with_friction(lead, one, other):
    low, high = sorted((one, other))
    assume(high - low > 1e-9 and lead + math.atan(high) < 1.5)
    assert iso.worm_driving_efficiency(lead, low) > iso.worm_driving_efficiency(lead, high)
    assert iso.wheel_driving_efficiency(lead, low) > iso.wheel_driving_efficiency(lead, high)


@given(leads)
def test_without_friction_nothing_is_lost_between_the_teeth(lead):
    assert iso.worm_driving_efficiency(lead, 0.0) == 1.0
    assert iso.wheel_driving_efficiency(lead, 0.0) == 1.0
    assert iso.meshing_loss(100.0, 1000.0, 20.0, 1.0) == 0.0


@given(leads, st.floats(0.0, 3.0), st.integers(-3, 3))
def test_wheel_cannot_drive_exactly_where_the_lead_is_within_the_friction_angle(lead, mu, steps):
    near = math.tan(lead)
    for _ in range(abs(steps)):
        near = math.nextafter(near, math.inf if steps > 0 else 0.0)
    for friction in (mu, near):
        efficiency = iso.wheel_driving_efficiency(lead, friction)
        assert (efficiency <= 0.0) == (lead <= np.arctan(friction))


@given(numbers, options, materials, oils)
def test_powers_and_efficiency_add_up(gearset, words, material, oil):
    answer = iso.chain(**gearset, **words, material=material, base_oil=oil, friction=0.06)
    lost = sum(getattr(answer, name) for name in LOSSES)
    assert answer.input_power == pytest.approx(answer.output_power + lost, rel=1e-12)
    efficiency = answer.output_power / answer.input_power
    assert answer.total_efficiency == pytest.approx(efficiency, rel=1e-12)
    assert answer.total_efficiency < 1.0
    assert all(getattr(answer, name) > 0.0 for name in LOSSES)


@settings(max_examples=30)
@given(st.lists(st.tuples(numbers, materials, oils), min_size=2, max_size=12), options)
def test_a_gearset_alone_and_among_others_have_the_same_answer(gearsets, words):
    columns = {name: np.array([g[name] for g, _, _ in gearsets]) for name in gearsets[0][0]}
    together = iso.chain(
        **columns,
        **words,
        material=[material for _, material, _ in gearsets],
        base_oil=[oil for _, _, oil in gearsets],
        on_invalid="mask",
    )
    for i, (gearset, material, oil) in enumerate(gearsets):
        try:
            alone = iso.chain(**gearset, **words, material=material, base_oil=oil)
        except iso.FilmParameterError:
            assert together.reason[i] == iso.NO_FILM
            assert np.isnan(together.efficiency[i])
            continue
        assert together.reason[i] == 0
        assert together.film_parameter[i] == pytest.approx(alone.film_parameter, abs=1e-15)
        for name in ANSWERS:
            expected = pytest.approx(getattr(alone, name), rel=1e-13)
            assert getattr(together, name)[i] == expected, name
        back = pytest.approx(alone.back_driving_efficiency, abs=1e-14, rel=1e-13)
        assert together.back_driving_efficiency[i] == back


@given(numbers, options)
def test_centre_distance_and_profile_shift_lead_to_the_same_answer(gearset, words):
    rest = {"material": "CuSn12-C-GZ", "base_oil": "polyglycol", "friction": 0.05}
    shift = gearset.pop("profile_shift")
    by_shift = iso.chain(**gearset, **words, **rest, profile_shift=shift)
    by_distance = iso.chain(**gearset, **words, **rest, centre_distance=by_shift.centre_distance)
    assert by_distance.profile_shift == pytest.approx(shift, abs=1e-12)
    assert by_distance.total_efficiency == pytest.approx(by_shift.total_efficiency, rel=1e-12)


@given(numbers, st.sampled_from(["1998", "2010"]), st.sampled_from(["ZI", "ZC"]))
def test_at_its_limits_the_film_parameter_is_zero(gearset, edition, flank):
    z1, z2, q = (gearset[name] for name in ("starts", "wheel_teeth", "diameter_factor"))
    m, alpha, x2 = (gearset[name] for name in ("axial_module", "pressure_angle", "profile_shift"))
    words = {"edition": edition, "flank": flank}
    limits = iso.film_limits(z1, z2, q, m, alpha, x2, **words)
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
            masked = iso.film_parameter(
                *(np.array([x]) for x in (z1, side["z2"], side["q"], side["m"], side["alpha"])),
                np.array([shift]),
                **words,
                on_invalid="mask",
            )
            sides.append(masked.reason[0] > 0)
        assert sides[0] != sides[1], name


@given(numbers)
def test_more_roughness_or_base_friction_never_helps(gearset):
    rest = {"material": "CuSn12-C-GZ", "base_oil": "mineral"}
    shape = iso.chain(**gearset, **rest, base_friction=[0.03, 0.04], on_invalid="mask")
    assume(np.all(shape.reason == 0))
    assert shape.efficiency[0] > shape.efficiency[1]
    rough = {**gearset, "worm_roughness": gearset["worm_roughness"] * np.array([1.0, 1.1])}
    answer = iso.chain(**rough, **rest, on_invalid="mask")
    assume(np.all(answer.reason == 0))
    assert answer.efficiency[0] > answer.efficiency[1]


@given(leads, frictions, st.floats(1.0, 1e5), st.floats(0.2, 0.6))
def test_forces_give_the_work_that_the_efficiency_says(lead, mu, force, alpha):
    assume(lead + math.atan(mu) < 1.5)
    worm = iso.worm_tangential_force(force, lead, mu)
    # One turn of the worm advances the wheel's pitch circle by the lead.
    assert force * math.tan(lead) / worm == pytest.approx(
        iso.worm_driving_efficiency(lead, mu), rel=1e-12
    )
    assert iso.separating_force(worm, alpha, lead, mu) > 0.0


def test_no_formula_but_the_rim_factor_jumps_at_its_branch_points():
    jumps = iso.jumps()
    assert {jump.formula for jump in jumps} == {
        "base_friction",
        "reference_wear_intensity",
        "pressure_factor",
        "start_factor",
        "pitting_life_factor",
        "pitting_ratio_factor",
        "heat_transfer_coefficient",
        "rim_factor",
    }
    for jump in jumps:
        if jump.formula != "rim_factor":
            assert abs(jump.relative) < 1e-12, jump


@given(st.floats(1e-3, 1e3), st.floats(1e-12, 1e-9))
def test_the_bent_curves_are_continuous_everywhere(value, step):
    for formula, scale in (
        (iso.base_friction, 1.0),
        (iso.pressure_factor, 1.0),
        (iso.start_factor, 1.0),
        (iso.pitting_life_factor, 100.0),
        (iso.pitting_ratio_factor, 1.0),
        (iso.heat_transfer_coefficient, 1.0),
        (iso.reference_wear_intensity, 0.01),
    ):
        one, other = formula(scale * value), formula(scale * value * (1.0 + step))
        assert other == pytest.approx(one, rel=10.0 * step + 1e-14), formula.__name__
