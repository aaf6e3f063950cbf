"""What holds for every worm gearset."""

import math

import hypothesis
import hypothesis.strategies as st
import numpy as np
import pytest

from asperity.errors import InputError
from asperity.gearset import Gearset, oil, relations
from asperity.gearset.geometry import Geometry
from asperity.gearset.macro import complete

MATERIALS = {"worm_material": "case-hardened steel", "wheel_material": "CuSn12-C-GZ"}

modules = st.floats(0.5, 20.0)
factors = st.floats(6.0, 20.0)
teeth = st.integers(20, 100)
starts = st.integers(1, 6)
shifts = st.floats(-1.0, 1.0)
rules = st.sampled_from(["bs721", "iso"])


@pytest.mark.slow
@hypothesis.given(m=modules, q=factors, z2=teeth, x2=shifts)
def test_centre_distance_and_profile_shift_give_each_other_back(m, q, z2, x2):
    a = relations.centre_distance(m, q, z2, x2)
    assert relations.profile_shift(a, m, q, z2) == pytest.approx(x2, abs=1e-11)
    assert relations.axial_module(a, q, z2, x2) == pytest.approx(m, rel=1e-12)
    assert relations.diameter_factor(a, m, z2, x2) == pytest.approx(q, rel=1e-11)


@pytest.mark.slow
@hypothesis.given(m=modules, q=factors, z2=teeth, x2=shifts)
def test_any_three_numbers_complete_to_the_same_gearset(m, q, z2, x2):
    a = relations.centre_distance(m, q, z2, x2)
    given = {
        "centre_distance": a,
        "axial_module": m,
        "diameter_factor": q,
        "profile_shift": x2,
    }
    for left_out in given:
        three = {key: value for key, value in given.items() if key != left_out}
        assert complete(z2, **three) == pytest.approx((m, q, x2), rel=1e-10, abs=1e-10)
    assert complete(z2, **given) == pytest.approx((m, q, x2), rel=1e-10, abs=1e-10)
    by_diameter = {**given, "worm_pitch_diameter": m * q}
    del by_diameter["diameter_factor"]
    for left_out in ("centre_distance", "axial_module", "profile_shift"):
        three = {key: value for key, value in by_diameter.items() if key != left_out}
        assert complete(z2, **three) == pytest.approx((m, q, x2), rel=1e-10, abs=1e-10)


@pytest.mark.slow
@hypothesis.given(
    m=modules, q=factors, z2=teeth, x2=shifts, error=st.floats(-0.1, 0.1).filter(bool)
)
def test_a_fourth_number_is_refused_beyond_the_tolerance_only(m, q, z2, x2, error):
    hypothesis.assume(abs(abs(error) - 5e-4) > 1e-9)
    a = relations.centre_distance(m, q, z2, x2) * (1.0 + error)
    # The tolerance is a share of the centre distance that was given.
    allowed = abs(error) / (1.0 + error) <= 5e-4
    hypothesis.assume(abs(abs(error) / (1.0 + error) - 5e-4) > 1e-9)
    given = {"centre_distance": a, "axial_module": m, "diameter_factor": q, "profile_shift": x2}
    if allowed:
        completed = complete(z2, **given)
        assert relations.centre_distance(
            completed.axial_module, completed.diameter_factor, z2, completed.profile_shift
        ) == pytest.approx(a, rel=1e-12)
    else:
        with pytest.raises(InputError, match=r"gearset\.centre_distance is .* leave one of"):
            complete(z2, **given)


@pytest.mark.slow
@hypothesis.given(
    z1=starts,
    m=modules,
    q=factors,
    z2=teeth,
    x2=shifts,
    alpha=st.floats(math.radians(10), math.radians(35)),
    rule=rules,
)
def test_the_identities_of_the_geometry_hold(z1, m, q, z2, x2, alpha, rule):
    g = Geometry.of(
        starts=z1,
        wheel_teeth=z2,
        axial_module=m,
        diameter_factor=q,
        profile_shift=x2,
        pressure_angle=alpha,
        tooth_proportions=rule,
    )
    close = {"rel": 1e-12, "abs": 1e-12}
    assert g.worm_pitch_diameter + g.wheel_mean_diameter == pytest.approx(
        2 * g.centre_distance, **close
    )
    assert g.wheel_mean_diameter == pytest.approx(g.wheel_reference_diameter + 2 * x2 * m, **close)
    # Tip of one, clearance and root of the other fill the centre distance, on both sides.
    assert (g.worm_tip_diameter / 2 + g.clearance + g.wheel_root_diameter / 2) == pytest.approx(
        g.centre_distance, **close
    )
    assert (g.worm_root_diameter / 2 + g.clearance + g.wheel_throat_diameter / 2) == pytest.approx(
        g.centre_distance, **close
    )
    assert g.wheel_throat_radius == pytest.approx(g.worm_root_diameter / 2 + g.clearance, **close)
    assert g.wheel_throat_diameter < g.wheel_outside_diameter
    # Once round the worm advances by the lead, which is as many pitches as it has starts.
    assert math.tan(g.lead_angle) * math.pi * g.worm_pitch_diameter == pytest.approx(
        g.lead, **close
    )
    assert g.lead == pytest.approx(z1 * g.axial_pitch, **close)
    assert g.normal_pitch == pytest.approx(g.axial_pitch * math.cos(g.lead_angle), **close)
    # The involute helicoid's generator touches the base cylinder and has the normal pressure angle.
    assert g.base_radius * math.tan(g.base_lead_angle) == pytest.approx(g.reduced_lead, **close)
    assert g.base_radius == pytest.approx(
        g.worm_pitch_diameter / 2 * math.cos(g.transverse_pressure_angle), **close
    )
    assert math.sin(alpha) == pytest.approx(
        math.sin(g.transverse_pressure_angle) * math.sin(g.base_lead_angle), **close
    )
    assert g.effective_face_width <= g.wheel_face_width
    assert g.worm_face_width > 0.0


@pytest.mark.slow
@hypothesis.given(z1=starts, m=modules, q=factors, z2=teeth, scale=st.floats(0.01, 100.0))
def test_similar_gearsets_have_similar_lengths_and_equal_angles(z1, m, q, z2, scale):
    one, other = (
        Geometry.of(starts=z1, wheel_teeth=z2, axial_module=module, diameter_factor=q)
        for module in (m, m * scale)
    )
    for key, value in one.to_json().items():
        factor = scale if "_mm" in key else 1.0
        assert other.to_json()[key] == pytest.approx(value * factor, rel=1e-10)


@pytest.mark.slow
@hypothesis.given(
    module=st.decimals("0.5", "20", places=4),
    q=factors,
    z2=teeth,
    unit=st.sampled_from([("m", -3), ("um", 3), ("cm", -1)]),
    alpha=st.integers(15, 30),
    hand=st.sampled_from(["right", "left"]),
)
def test_a_change_of_units_changes_nothing(module, q, z2, unit, alpha, hand):
    name, power = unit
    common = {"starts": 2, "wheel_teeth": z2, "diameter_factor": q, "hand": hand, **MATERIALS}
    millimetres = Gearset(
        **common, axial_module=f"{module} mm", pressure_angle=f"{alpha} deg", units="SI"
    )
    other = Gearset(
        **common,
        axial_module=f"{module.scaleb(power)} {name}",
        pressure_angle=f"{alpha * 60} arcmin",
        units="SI",
    )
    assert other == millimetres
    assert other.geometry == millimetres.geometry


@pytest.mark.slow
@hypothesis.given(z1=starts, m=modules, q=factors, z2=teeth)
def test_the_hand_of_the_worm_changes_no_length_and_no_angle(z1, m, q, z2):
    right, left = (
        Gearset(
            starts=z1,
            wheel_teeth=z2,
            axial_module=m * 1e-3,
            diameter_factor=q,
            hand=hand,
            **MATERIALS,
            units="SI",
        )
        for hand in ("right", "left")
    )
    assert right.geometry == left.geometry
    assert right.hand_sign == -left.hand_sign == 1


@pytest.mark.slow
@hypothesis.given(
    m=st.lists(modules, min_size=1, max_size=5), q=factors, z2=teeth, x2=shifts, z1=starts
)
def test_relations_give_the_same_for_numbers_and_arrays(m, q, z2, x2, z1):
    array = np.array(m)
    distance = relations.centre_distance(array, q, z2, x2)
    np.testing.assert_allclose(
        distance, [relations.centre_distance(each, q, z2, x2) for each in m], rtol=1e-13
    )
    np.testing.assert_allclose(
        relations.profile_shift(distance, array, q, z2),
        [relations.profile_shift(a, b, q, z2) for a, b in zip(distance, m, strict=True)],
        rtol=1e-13,
        atol=1e-13,
    )
    reach = relations.worm_reach(10.0 * distance, distance, array)
    np.testing.assert_allclose(
        reach,
        [relations.worm_reach(10.0 * a, a, b) for a, b in zip(distance, m, strict=True)],
        rtol=1e-13,
    )


@hypothesis.given(
    nu_100=st.floats(2.5, 100.0),
    times=st.floats(2.0, 40.0),
    theta=st.floats(-20.0, 140.0),
    step=st.floats(0.1, 10.0),
)
def test_an_oil_thins_as_it_warms(nu_100, times, theta, step):
    masked = oil.kinematic_viscosity(
        np.array([theta, theta + step]), nu_100 * times, nu_100, on_invalid="mask"
    )
    hypothesis.assume(not masked.reason.any())
    cold, warm = masked.values
    assert cold > warm > 0.0
