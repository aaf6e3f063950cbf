"""AGMA 6034-B92 against worked examples and published numbers.

Sources: Budynas and Nisbett, Shigley's Mechanical Engineering Design, examples 15-3 and 15-4 (the
book rounds as it goes, the exact numbers of 15-4 are from the formulas); closed-form efficiencies;
gearset 3 of the thesis as reconstructed from its text.
"""

import doctest
import math

import numpy as np
import pytest
from apparatus.formulas import formulas_of

from asperity.rating import agma6034 as agma
from asperity.rating.agma6034 import capacity, forces, mesh, thermal
from asperity.sources import Source

IN = {"units": "inch"}
RAD = math.radians


def rated(
    *, starts, teeth, axial_pitch, worm_diameter, speed, phi_deg, power, design, face, casting
):
    """The chain of formulas in inches, pounds and horsepower."""
    phi, ratio = RAD(phi_deg), teeth / starts
    wheel = teeth * axial_pitch / math.pi
    centre = 0.5 * (worm_diameter + wheel)
    lead = math.atan(starts * axial_pitch / (math.pi * worm_diameter))
    sliding = agma.mesh.sliding_velocity(worm_diameter, lead, speed, **IN)
    f = agma.mesh.friction(sliding, **IN)
    e = agma.mesh.worm_driving_efficiency(f, lead, phi)
    # The design power in horsepower, the pitch line in ft/min.
    w_g = 33000.0 * design * power * 1.25 / (math.pi / 12.0 * wheel * speed / ratio * e)
    c_s = agma.capacity.materials_factor(centre, wheel, casting, **IN)
    c_m = agma.capacity.ratio_correction_factor(ratio)
    c_v = agma.capacity.velocity_factor(sliding, **IN)
    f_e = agma.capacity.effective_face_width(face, worm_diameter, **IN)
    return {
        "lead_deg": math.degrees(lead),
        "V_s": sliding,
        "f": f,
        "e": e,
        "W_G": w_g,
        "W_W": agma.forces.worm_tangential_load(w_g, f, lead, phi, **IN),
        "C_s": c_s,
        "C_m": c_m,
        "C_v": c_v,
        "W_all": agma.capacity.allowable_tangential_load(c_s, wheel, f_e, c_m, c_v, **IN),
        "sigma": agma.forces.bending_stress(
            w_g, axial_pitch, lead, f_e, agma.forces.lewis_form_factor(phi), **IN
        ),
    }


def example_15_3():
    return rated(
        starts=1,
        teeth=24,
        axial_pitch=math.pi / 4.0,
        worm_diameter=3.0,
        speed=1800.0,
        phi_deg=14.5,
        power=3.0,
        design=1.0,
        face=2.0,
        casting="chill",
    )


def example_15_4():
    return rated(
        starts=2,
        teeth=22,
        axial_pitch=1.5,
        worm_diameter=2.5,
        speed=1720.0,
        phi_deg=20.0,
        power=10.0,
        design=1.2,
        face=1.5,
        casting="sand",
    )


@pytest.mark.parametrize(
    ("key", "published", "digits"),
    [
        ("lead_deg", 4.764, 3),
        ("V_s", 1419, 0),
        ("f", 0.0178, 4),
        ("e", 0.818, 3),
        ("W_G", 1284, 0),
        ("C_s", 1000, 0),
        ("C_m", 0.823, 3),
        ("C_v", 0.211, 3),
        ("W_all", 1456, 0),
    ],
)
def test_example_15_3_of_shigley_to_the_published_digits(key, published, digits):
    assert round(example_15_3()[key], digits) == published


@pytest.mark.parametrize(
    ("key", "published"),
    [
        ("C_s", 702.8),
        ("C_m", 0.772),
        ("f", 0.0191),
        ("e", 0.942),
        ("W_G", 1222),
        ("W_W", 495.4),
        ("W_all", 1239),
        ("sigma", 4652),
    ],
)
def test_example_15_4_of_shigley_within_two_parts_in_a_thousand(key, published):
    assert example_15_4()[key] == pytest.approx(published, rel=2e-3)


@pytest.mark.parametrize(
    ("key", "exact", "digits"), [("W_all", 1237.2, 1), ("W_W", 495.3, 1), ("sigma", 4650, 0)]
)
def test_example_15_4_without_the_rounding_of_the_book(key, exact, digits):
    assert round(example_15_4()[key], digits) == exact


def test_load_in_newtons_and_millimetres_is_divided_by_75_948():
    in_inches = 1000.0 * 150.0**0.8 * 20.0 * 0.8 * 0.4
    load = agma.capacity.allowable_tangential_load(1000.0, 150.0, 20.0, 0.8, 0.4)
    assert load == pytest.approx(in_inches / 75.948, rel=1e-5)


@pytest.mark.parametrize(("v", "expected"), [(1.0, 0.0435), (5.0, 0.0209)])
def test_friction_at_published_velocities(v, expected):
    assert round(agma.mesh.friction(v), 4) == expected


def test_friction_in_si_has_the_metric_constants():
    assert agma.mesh.friction(0.0) == 0.15
    v = np.array([1e-4, 0.01, 0.05])
    np.testing.assert_allclose(agma.mesh.friction(v), 0.124 * np.exp(-2.233 * v**0.645), rtol=2e-4)
    v = np.array([0.0509, 1.0, 10.0])
    metric = 0.103 * np.exp(-1.185 * v**0.45) + 0.012
    np.testing.assert_allclose(agma.mesh.friction(v), metric, rtol=2e-4)


def test_velocity_factor_in_si_has_the_metric_constants():
    # 0.0011, 13.31 and 65.52 for ft/min, with 196.85 ft/min to the metre a second.
    assert agma.capacity.velocity_factor(0.0) == 0.659
    v = np.array([0.01, 1.0, 3.5])
    np.testing.assert_allclose(
        agma.capacity.velocity_factor(v), 0.659 * np.exp(-0.216535 * v), rtol=3e-5
    )
    v = np.array([3.56, 8.0, 15.2])
    np.testing.assert_allclose(agma.capacity.velocity_factor(v), 0.65197 * v**-0.571, rtol=3e-5)
    v = np.array([15.3, 20.0, 30.0])
    np.testing.assert_allclose(agma.capacity.velocity_factor(v), 1.09828 * v**-0.774, rtol=3e-5)


@pytest.mark.parametrize(("lead", "mu", "expected"), [(20.0, 0.05, 0.85556), (5.0, 0.1, 0.44699)])
def test_efficiency_of_closed_form(lead, mu, expected):
    assert round(agma.mesh.worm_driving_efficiency(mu, RAD(lead), RAD(20.0)), 5) == expected


def test_large_ratios_fall_with_0_00658():
    assert agma.capacity.ratio_correction_factor(100) == pytest.approx(1.1483 - 0.658, abs=1e-12)


def test_small_centre_distances_meet_1000_at_three_inches():
    below = agma.capacity.materials_factor(np.nextafter(3.0, 0.0), 2.0, "sand", **IN)
    assert below == pytest.approx(720.0 + 10.37 * 27.0, rel=1e-12)
    assert below == pytest.approx(1000.0, rel=2e-5)
    assert agma.capacity.materials_factor(2.0, 2.0, "sand", **IN) == pytest.approx(802.96)


@pytest.mark.parametrize(
    ("casting", "diameter", "expected"),
    [
        ("sand", 2.4, 1000.0),
        ("sand", 10.0, 713.0),
        ("chill", 8.0, 1000.0),
        ("chill", 10.0, 956.0),
        ("centrifugal", 20.0, 1000.0),
        ("centrifugal", 100.0, 891.0),
    ],
)
def test_materials_factor_by_casting_and_wheel(casting, diameter, expected):
    assert agma.capacity.materials_factor(6.0, diameter, casting, **IN) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("phi", "y", "lead"),
    [(14.5, 0.1, 16.0), (20.0, 0.125, 25.0), (25.0, 0.15, 35.0), (30.0, 0.175, 45.0)],
)
def test_form_factor_and_lead_angle_limit_by_pressure_angle(phi, y, lead):
    assert agma.forces.lewis_form_factor(RAD(phi)) == pytest.approx(y, rel=1e-12)
    assert math.degrees(agma.mesh.maximum_lead_angle(RAD(phi))) == pytest.approx(lead, rel=1e-12)


def test_heat_of_example_15_4():
    values = example_15_4()
    coefficient = agma.thermal.heat_transfer_coefficient(1720.0, **IN)
    assert coefficient == pytest.approx(1720.0 / 6494.0 + 0.13)
    assert agma.thermal.heat_transfer_coefficient(1720.0, fan=True, **IN) == pytest.approx(
        0.566659, abs=1e-6
    )
    area = agma.thermal.minimum_housing_area(6.502, **IN)
    assert area == pytest.approx(43.2 * 6.502**1.7)
    lost = 33000.0 * (1.0 - values["e"]) * 12.0
    hot = agma.thermal.sump_temperature(70.0, 12.0, values["e"], coefficient, area, **IN)
    assert hot == pytest.approx(70.0 + lost / (coefficient * area))


def gearset_3(q):
    """What the thesis's sliding velocity leaves of gearset 3, without profile shift; mm, rad."""
    lead = math.atan(4.0 / q)
    d1 = 20.0376 * math.cos(lead)
    m = d1 / q
    return lead, d1, 60.0 * m, 0.5 * (d1 + 60.0 * m), 2.0 * m * math.sqrt(q + 1.0)


def allowable_torque(q):
    _, d1, d2, centre, face = gearset_3(q)
    load = agma.capacity.allowable_tangential_load(
        agma.capacity.materials_factor(centre, d2, "centrifugal"),
        d2,
        agma.capacity.effective_face_width(face, d1),
        agma.capacity.ratio_correction_factor(15.0),
        agma.capacity.velocity_factor(1.5108),
    )
    return agma.capacity.wheel_torque(load, d2)


@pytest.mark.parametrize(("q", "torque"), [(8.36, 188), (8.2, 195)])
def test_allowable_torque_of_gearset_3(q, torque):
    assert round(allowable_torque(q)) == torque


def test_efficiency_of_gearset_3():
    lead = gearset_3(8.36)[0]
    e = agma.mesh.worm_driving_efficiency(agma.mesh.friction(1.5108), lead, RAD(20.0))
    assert round(100.0 * e, 1) == 90.7


FORMULAS = formulas_of(agma)

# Place in the standard's units, and height in percent.
JUMPS = {
    "friction": {0.0: -17.33, 10.0: -2.12},
    "ratio_correction_factor": {20.0: -0.07, 76.0: 0.62},
    "velocity_factor": {700.0: 3.55, 3000.0: -3.10},
}


def in_inches(name):
    formula = FORMULAS[name]
    return formula if name == "ratio_correction_factor" else lambda v: formula(v, **IN)


@pytest.mark.parametrize(
    ("name", "at", "percent"), [(n, at, p) for n, known in JUMPS.items() for at, p in known.items()]
)
def test_jumps_are_as_high_as_the_formulas_say(name, at, percent):
    formula = in_inches(name)
    before, after = formula(max(np.nextafter(at, -np.inf), 0.0)), formula(np.nextafter(at, np.inf))
    assert 100.0 * (after / before - 1.0) == pytest.approx(percent, abs=5e-3)
    assert f"{percent:.2f} %" in FORMULAS[name].__doc__


def largest_step(formula, lower, upper, points, known):
    x = np.linspace(lower, upper, points)
    values = formula(x)
    spans_known = np.zeros(points - 1, dtype=bool)
    for at in known:
        spans_known |= (x[:-1] <= at) & (at <= x[1:])
    return np.abs(np.diff(values) / values[:-1])[~spans_known].max()


@pytest.mark.ordinary(5)
@pytest.mark.parametrize(
    ("name", "formula", "lower", "upper"),
    [
        ("friction", in_inches("friction"), 0.0, 40.0),
        ("friction", in_inches("friction"), 20.0, 6000.0),
        ("ratio_correction_factor", agma.capacity.ratio_correction_factor, 3.0, 110.0),
        ("velocity_factor", in_inches("velocity_factor"), 0.0, 6000.0),
        ("C", lambda c: agma.capacity.materials_factor(c, 2.0, "sand", **IN), 1.0, 9.0),
        ("sand", lambda d: agma.capacity.materials_factor(9.0, d, "sand", **IN), 1.0, 40.0),
        ("chill", lambda d: agma.capacity.materials_factor(9.0, d, "chill", **IN), 1.0, 40.0),
        (
            "centrifugal",
            lambda d: agma.capacity.materials_factor(9.0, d, "centrifugal", **IN),
            1.0,
            60.0,
        ),
        ("phi", agma.forces.lewis_form_factor, RAD(14.5), RAD(30.0)),
        ("phi", agma.mesh.maximum_lead_angle, RAD(14.5), RAD(30.0)),
    ],
)
def test_there_are_no_other_jumps(name, formula, lower, upper):
    known = JUMPS.get(name, ())
    coarse, fine = (largest_step(formula, lower, upper, n, known) for n in (20_001, 640_001))
    # A step between neighbours falls with their distance, here 32 times; a jump would stay.
    # Friction rises from rest with the power 0.645 of the velocity, 32**0.645 = 9.3.
    assert fine < coarse / 9.0


def test_every_formula_has_a_source():
    assert all(isinstance(formula.source, Source) for formula in FORMULAS.values())
    assert agma.mesh.maximum_lead_angle.source.name.endswith("table 15-9")


def test_limits_of_the_standard_are_reported():
    assert agma.limits.VALIDITY["sliding_velocity"].upper == pytest.approx(30.48)
    assert agma.limits.VALIDITY["worm_speed"].violation(3700.0) is not None
    assert agma.limits.VALIDITY["gear_ratio"].violation(15.0) is None


@pytest.mark.parametrize("module", [capacity, forces, mesh, thermal])
def test_examples_in_the_documentation_hold(module):
    results = doctest.testmod(module)
    assert results.failed == 0
