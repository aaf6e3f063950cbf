"""What AGMA 6034 and BS 721 hold for every gearset, and in every unit."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from asperity.errors import InputError
from asperity.formulas import Masked
from asperity.rating import agma6034 as agma
from asperity.rating import bs721, shaft
from asperity.rating.iso14521 import hertz

MM, M_S, N, N_M, MPA, W = (
    25.4,
    0.3048 / 60.0,
    4.4482216152605,
    4.4482216152605 * 0.0254,
    4.4482216152605 / 645.16,
    745.6998715822702,
)
IN = {"units": "inch"}


def floats(low, high):
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


leads = floats(0.01, 0.8)
pressures = floats(math.radians(14.5), math.radians(30.0))
frictions = floats(0.0, 0.3)
lengths = floats(0.5, 30.0)
velocities = floats(0.0, 6000.0)
castings = st.sampled_from(["sand", "chill", "centrifugal"])


@given(lengths, lengths, castings, velocities, floats(3.0, 100.0))
def test_capacity_does_not_depend_on_the_units(c, d, casting, v, ratio):
    c_s = agma.capacity.materials_factor(c, d, casting, **IN)
    assert agma.capacity.materials_factor(c * MM, d * MM, casting) == pytest.approx(c_s, rel=1e-12)
    # Not within a rounding of where the formulas themselves jump.
    assume(min(abs(v - at) for at in (10.0, 700.0, 3000.0)) > 1e-9)
    assume(v == 0.0 or v > 1e-9)
    c_v = agma.capacity.velocity_factor(v, **IN)
    assert agma.capacity.velocity_factor(v * M_S) == pytest.approx(c_v, rel=1e-12)
    assert agma.mesh.friction(v * M_S) == pytest.approx(agma.mesh.friction(v, **IN), rel=1e-12)
    c_m = agma.capacity.ratio_correction_factor(ratio)
    width = agma.capacity.effective_face_width(0.1 * d, 0.2 * d, **IN)
    load = agma.capacity.allowable_tangential_load(c_s, d, width, c_m, c_v, **IN)
    in_si = agma.capacity.allowable_tangential_load(c_s, d * MM, width * MM, c_m, c_v)
    assert in_si == pytest.approx(load * N, rel=1e-12)
    torque = agma.capacity.wheel_torque(load, d, **IN)
    assert agma.capacity.wheel_torque(load * N, d * MM) == pytest.approx(torque * N_M, rel=1e-12)


@given(floats(1.0, 1e4), frictions, leads, pressures, lengths, floats(1.0, 3600.0))
def test_forces_power_and_heat_do_not_depend_on_the_units(w, f, lead, phi, d, n):
    pairs = [
        (agma.mesh.sliding_velocity, (d, MM), (lead, 1.0), (n, 1.0), M_S),
        (agma.forces.worm_tangential_load, (w, N), (f, 1.0), (lead, 1.0), (phi, 1.0), N),
        (agma.forces.friction_force, (w, N), (f, 1.0), (lead, 1.0), (phi, 1.0), N),
        (agma.forces.bending_stress, (w, N), (0.1 * d, MM), (lead, 1.0), (d, MM), (0.1, 1.0), MPA),
        (agma.thermal.friction_power, (n, M_S), (w, N), W),
        (agma.thermal.heat_transfer_coefficient, (n, 1.0), W / 33000.0 / 0.0254**2 * 1.8),
        (agma.thermal.minimum_housing_area, (d, MM), 0.0254**2),
    ]
    for formula, *arguments, size in pairs:
        inch = formula(*(value for value, _ in arguments), **IN)
        si = formula(*(value * scale for value, scale in arguments))
        assert si == pytest.approx(inch * size, rel=1e-12), formula.__name__


@given(floats(-40.0, 120.0), floats(0.0, 100.0), floats(0.0, 1.0), floats(0.1, 1.0), lengths)
def test_temperatures_do_not_depend_on_the_units(celsius, power, e, h, area):
    inch = agma.thermal.sump_temperature(32.0 + 1.8 * celsius, power, e, h, area, **IN)
    coefficient = h * W / 33000.0 / 0.0254**2 * 1.8
    si = agma.thermal.sump_temperature(celsius, power * W, e, coefficient, area * 0.0254**2)
    assert 32.0 + 1.8 * si == pytest.approx(inch, rel=1e-11, abs=1e-10)


@given(floats(1.0, 1e4), frictions, leads, pressures, floats(0.1, 20.0))
def test_power_of_the_worm_is_that_of_the_wheel_and_of_friction(w, f, lead, phi, v):
    worm = agma.forces.worm_tangential_load(w, f, lead, phi) * v * math.cos(lead)
    wheel = w * v * math.sin(lead)
    lost = agma.forces.friction_force(w, f, lead, phi) * v
    assert worm == pytest.approx(wheel + lost, rel=1e-12)
    assert wheel / worm == pytest.approx(agma.mesh.worm_driving_efficiency(f, lead, phi), rel=1e-12)
    assert agma.thermal.friction_power(v, lost / v) == pytest.approx(lost, rel=1e-12)


@pytest.mark.slow
@given(frictions, frictions, leads, pressures)
def test_efficiency_falls_with_friction(f1, f2, lead, phi):
    assume(f2 - f1 > 1e-9)
    for efficiency in (agma.mesh.worm_driving_efficiency, agma.mesh.wheel_driving_efficiency):
        assert efficiency(f2, lead, phi) < efficiency(f1, lead, phi) <= 1.0 + 1e-15


@given(floats(0.0, 0.5), leads, pressures)
def test_gearset_locks_itself_where_the_lead_is_below_the_angle_of_friction(f, lead, phi):
    margin = math.tan(lead) - f / math.cos(phi)
    assume(abs(margin) > 1e-12)
    assert (agma.mesh.wheel_driving_efficiency(f, lead, phi) > 0.0) == (margin > 0.0)


VARIANTS = 400


def variants(rng):
    q = rng.uniform(6.0, 20.0, VARIANTS)
    z1 = rng.integers(1, 5, VARIANTS).astype(float)
    m = rng.uniform(1.0, 10.0, VARIANTS)
    lead = np.arctan(z1 / q)
    d2 = m * rng.integers(20, 80, VARIANTS)
    v = rng.uniform(0.0, 29.0, VARIANTS)
    return q, z1, m, lead, d2, v


@pytest.mark.slow
def test_arrays_give_what_their_numbers_give():
    q, z1, m, lead, d2, v = variants(np.random.default_rng(6034))
    phi = np.full(VARIANTS, math.radians(20.0))
    n, f = 60.0 + 3.0 * q, 0.02 + 0.1 * lead
    width = 2.0 * m * np.sqrt(q + 1.0)
    calls = [
        (agma.mesh.sliding_velocity, m * q, lead, n),
        (agma.mesh.friction, v),
        (agma.mesh.worm_driving_efficiency, f, lead, phi),
        (agma.mesh.wheel_driving_efficiency, f, lead, phi),
        (agma.mesh.maximum_lead_angle, phi),
        (lambda a, d: agma.capacity.materials_factor(a, d, "sand"), 0.6 * d2, d2),
        (agma.capacity.ratio_correction_factor, 5.0 * q),
        (agma.capacity.velocity_factor, v),
        (agma.capacity.effective_face_width, width, m * q),
        (agma.capacity.allowable_tangential_load, 100.0 * m, d2, width, f, f),
        (agma.capacity.wheel_torque, 100.0 * m, d2),
        (agma.forces.worm_tangential_load, d2, f, lead, phi),
        (agma.forces.friction_force, d2, f, lead, phi),
        (agma.forces.lewis_form_factor, phi),
        (agma.forces.bending_stress, d2, m, lead, width, f),
        (agma.thermal.friction_power, v, d2),
        (agma.thermal.heat_transfer_coefficient, n),
        (agma.thermal.minimum_housing_area, d2),
        (agma.thermal.sump_temperature, q, d2, 1.0 - f, m, q),
        (bs721.torque.zone_factor, z1, q, width, m),
        (bs721.torque.wear_speed_factor, v, n),
        (bs721.torque.strength_speed_factor, n),
        (bs721.torque.wear_torque, f, 15.2 * m, q, d2, m),
        (bs721.torque.root_arc, width, m * (q + 2.0), m, q, lead),
        (bs721.torque.strength_torque, f, 69.0 * m, m, width, d2, lead),
        (bs721.torque.friction, v),
        (bs721.life.wear_life_factor, d2),
        (bs721.life.strength_life_factor, d2),
        (hertz.contact_modulus, 1e4 * m, f, 1e5 * m, f),
        (hertz.line_contact_stress, d2, m, q, 1e4 * m),
        (hertz.worm_contact_stress, d2, d2, m, q, lead, phi, 1e4 * m),
        (shaft.torsional_stiffness, m, d2, 1e5 * q, f),
    ]
    for number, (formula, *arrays) in enumerate(calls):
        together = formula(*arrays)
        single = [formula(*map(float, values)) for values in zip(*arrays, strict=True)]
        assert all(type(value) is float for value in single)
        np.testing.assert_allclose(together, single, rtol=1e-13, atol=0.0, err_msg=str(number))


anything = st.one_of(st.floats(), st.floats(-10.0, 50.0), st.sampled_from([0.0, 3.0, 76.0, 174.6]))
SINGLE = [
    agma.mesh.friction,
    agma.capacity.velocity_factor,
    agma.capacity.ratio_correction_factor,
    agma.mesh.maximum_lead_angle,
    agma.forces.lewis_form_factor,
    agma.thermal.minimum_housing_area,
    agma.thermal.heat_transfer_coefficient,
    bs721.torque.friction,
    bs721.torque.strength_speed_factor,
    bs721.life.wear_life_factor,
    bs721.life.strength_life_factor,
]


@given(st.sampled_from(SINGLE), st.lists(anything, min_size=1, max_size=8))
def test_masked_elements_are_those_that_would_raise(formula, values):
    result = formula(values, on_invalid="mask")
    assert isinstance(result, Masked)
    for value, out, reason in zip(values, result.values, result.reason, strict=True):
        if reason:
            assert math.isnan(out)
            assert result.legend[int(reason)]
            with pytest.raises(InputError):
                formula(value)
        else:
            assert math.isfinite(out)
            assert formula(value) == pytest.approx(out, rel=1e-13)


@given(st.lists(st.floats(), min_size=7, max_size=7))
def test_no_number_leaves_that_is_not_finite(values):
    a, b, c, d, e, f, g = values
    calls = [
        lambda: agma.mesh.sliding_velocity(a, b, c),
        lambda: agma.capacity.materials_factor(a, b, "sand"),
        lambda: agma.capacity.allowable_tangential_load(a, b, c, d, e),
        lambda: agma.forces.worm_tangential_load(a, b, c, d),
        lambda: agma.forces.friction_force(a, b, c, d),
        lambda: agma.mesh.worm_driving_efficiency(a, b, c),
        lambda: agma.mesh.wheel_driving_efficiency(a, b, c),
        lambda: agma.forces.bending_stress(a, b, c, d, e),
        lambda: agma.thermal.sump_temperature(a, b, c, d, e),
        lambda: bs721.torque.zone_factor(a, b, c, d),
        lambda: bs721.torque.root_arc(a, b, c, d, e),
        lambda: bs721.torque.wear_torque(a, b, c, d, e),
        lambda: hertz.worm_contact_stress(a, b, c, d, e, f, g),
        lambda: shaft.torsional_stiffness(a, b, c, d),
    ]
    for call in calls:
        try:
            result = call()
        except InputError:
            continue
        assert math.isfinite(result)


@given(floats(6.0, 20.0), st.integers(1, 4), floats(0.5, 20.0), floats(0.1, 4.0))
def test_zone_factor_grows_with_the_face_width_up_to_2_3(q, starts, m, share):
    unit = m * math.sqrt(q + 1.0)
    here = bs721.torque.zone_factor(starts, q, share * unit, m)
    full = bs721.torque.zone_factor(starts, q, 2.3 * unit, m)
    assert here == pytest.approx(full * min(share / 2.3, 1.0), rel=1e-12)
    # Sizes do not matter, proportions do.
    assert bs721.torque.zone_factor(starts, q, 2.0 * share * unit, 2.0 * m) == pytest.approx(here)


@given(floats(0.0, 1e6), floats(0.0, 1e6))
@settings(max_examples=50)
def test_longer_lives_permit_less_torque(one, other):
    assume(other - one > 1e-3)
    assert bs721.life.wear_life_factor(other) < bs721.life.wear_life_factor(one)
    assert bs721.life.strength_life_factor(other) < bs721.life.strength_life_factor(one)
