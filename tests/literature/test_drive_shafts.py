"""The worm's shaft and bearings against beam tables and the thesis's shaft.

Roark's Formulas for Stress and Strain, simply supported beam: force P at a, deflection there
P a^2 b^2/(3 E I L); in the middle P L^3/(48 E I); couple in the middle, slope M L/(12 E I).
"""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.parameters import Shaft
from asperity.drive.point import MeshPoint
from asperity.drive.shafts import (
    MeshAction,
    beam_with_ends,
    bending_of,
    bending_stiffness,
    compliances,
    compliances_of,
    wheel_compliances,
)
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating.iso14521.strength import worm_deflection

E, D, SPAN, TORQUE, MU = 209e9, 0.017, 0.150, 366.0, 0.1344


def at(geometry, friction, radius=None):
    pitch = 0.5e-3 * geometry.worm_pitch_diameter
    return MeshAction.of(MeshPoint.of(geometry, radius or pitch), friction)


@pytest.fixture(scope="module")
def geometry():
    return read_case("gearset-3b", case_tables()).require(Gearset).geometry


@pytest.fixture(scope="module")
def action(geometry):
    return at(geometry, MU, 9.81e-3)


def test_a_beam_is_that_of_the_tables():
    stiff, rigid = bending_stiffness(D, E), math.inf
    middle = beam_with_ends(SPAN, 0.5 * SPAN, stiff, rigid, rigid)
    assert middle == pytest.approx(
        np.diag([SPAN**3 / (48.0 * stiff), SPAN / (12.0 * stiff)]), rel=1e-12, abs=1e-20
    )
    third = beam_with_ends(SPAN, SPAN / 3.0, stiff, rigid, rigid)
    assert third[0, 0] == pytest.approx(4.0 * SPAN**3 / (243.0 * stiff), rel=1e-12)
    assert third[1, 0] > 0.0  # still rising at a load left of the middle


def test_the_beam_bends_as_its_differential_equation_integrated():
    place, stiff = 0.04, 50.0
    x = np.linspace(0.0, SPAN, 15001)
    for load, column in (("force", 0), ("moment", 1)):
        b = SPAN - place
        left, right = (b / SPAN, place / SPAN) if load == "force" else (-1.0 / SPAN, 1.0 / SPAN)
        moment = np.where(x <= place, left * x, right * (SPAN - x))
        slope = np.concatenate([[0.0], np.cumsum(0.5 * (moment[1:] + moment[:-1]))]) * x[1] / stiff
        sag = np.concatenate([[0.0], np.cumsum(0.5 * (slope[1:] + slope[:-1]))]) * x[1]
        # The beam's curvature is minus moment over stiffness; its ends stay in place.
        deflection = x / SPAN * sag[-1] - sag
        turned = sag[-1] / SPAN - slope
        found = beam_with_ends(SPAN, place, stiff, math.inf, math.inf)[:, column]
        at = np.searchsorted(x, place)
        assert found == pytest.approx([deflection[at], turned[at]], rel=1e-3)


def test_a_rigid_shaft_in_the_middle_of_two_bearings_has_both_under_it():
    beam = beam_with_ends(SPAN, 0.5 * SPAN, math.inf, 1e8, 1e8)
    assert beam == pytest.approx(np.diag([0.5e-8, 2e-8 / SPAN**2]), abs=1e-22)


def test_the_action_at_the_mesh_is_the_closed_form_of_an_involute_worm(geometry):
    # T_B 34.67, reversed 15.36, without friction 24.4 N m at an effective radius of 9.81 mm.
    found = [TORQUE * at(geometry, mu, 9.81e-3).worm_torque for mu in (MU, -MU, 0.0)]
    assert found == pytest.approx([34.67, 15.36, 24.4], abs=0.02)


def test_the_thesis_shaft_twists_by_its_stiffness_over_the_ratio(action, geometry):
    shaft = Shaft(diameter=D, span=SPAN, units="SI")
    stiffness = shaft.torsion
    assert round(stiffness) == 4394
    parts = compliances_of(shaft, action.radius)
    assert set(parts) == {"bending", "torsion"}
    turn = TORQUE * action.at_wheel(parts["torsion"])
    worm = TORQUE * action.worm_torque / stiffness
    assert turn == pytest.approx(worm / geometry.gear_ratio, rel=1e-12)


def test_an_axial_bearing_costs_the_wheel_the_turn_of_its_shift(action):
    for stiffness, expected in ((1e8, 877e-6), (5e8, 175e-6)):
        part = compliances(action.radius, bearing_axial=stiffness)["bearing_axial"]
        assert TORQUE * action.at_wheel(part) == pytest.approx(expected, rel=5e-3)


def test_the_worm_shaft_of_17_mm_bends_by_a_quarter_millimetre_and_costs_3600_microradians(action):
    part = compliances(action.radius, span=SPAN, bending=bending_stiffness(D, E))["bending"]
    turn, axial, tangential, radial = TORQUE * action.yielded(part)
    assert turn == 0.0
    assert (axial, tangential, radial) == pytest.approx((7.95e-6, 0.290e-3, 0.220e-3), rel=2e-3)
    assert TORQUE * action.at_wheel(part) == pytest.approx(3603e-6, rel=1e-3)


def test_without_friction_the_standard_s_deflection_is_that_of_1_1_root_diameters(geometry):
    # ISO/TR 14521 prints 6.592 where the beam of a round shaft has 64/(3 pi) = 6.79.
    pitch = at(geometry, 0.0)
    found = worm_deflection(
        TORQUE / pitch.wheel_radius, geometry.lead_angle, 0.0, geometry.pressure_angle,
        geometry.worm_root_diameter, 75.0, 75.0, 1e-6 * E,
    )  # fmt: skip
    stiff = bending_stiffness(1.1e-3 * geometry.worm_root_diameter, E)
    part = compliances(pitch.radius, span=SPAN, bending=stiff)["bending"]
    sag = 1e3 * TORQUE * np.hypot(*pitch.yielded(part)[2:])
    assert sag == pytest.approx(found * 64.0 / (3.0 * np.pi) / 6.592, rel=1e-9)


def test_without_friction_every_part_is_symmetric_in_force_and_turn(geometry):
    frictionless = at(geometry, 0.0)
    part = compliances(
        frictionless.radius, span=SPAN, position=0.06, bending=90.0, bearing_radial=1e8
    )["bending"]
    assert part == pytest.approx(part.T)
    forces = np.array([frictionless.worm_torque, *frictionless.force])
    assert frictionless.at_wheel(part) == pytest.approx(forces @ part @ forces, rel=1e-12)


def test_a_housing_is_in_series_with_the_bearings_along_the_centre_distance(action):
    parts = compliances_of(
        Shaft(bearing_radial="100 kN/mm", span="150 mm", housing="40 kN/mm"), action.radius
    )
    whole = sum(parts.values(), np.zeros((4, 4)))
    # Two bearings side by side, the housing behind both; along the wheel's axis it gives nothing.
    assert whole[3, 3] == pytest.approx(1.0 / 200e6 + 1.0 / 40e6, rel=1e-12)
    assert whole[2, 2] == pytest.approx(1.0 / 200e6, rel=1e-12)
    # The flanks part by the radial shift's share along the normal, which the wheel turns back.
    turn = action.normal[2] / (action.normal[0] * action.wheel_radius) * action.force[2] / 40e6
    assert wheel_compliances(action, parts)["housing"] == pytest.approx(turn, rel=1e-12)
    soft = bending_of(Shaft(bearing_radial="100 kN/mm", span="150 mm", housing="40 kN/mm"),
                      action.radius, 0.3)  # fmt: skip
    assert soft.stiffness[2] == pytest.approx(1.0 / (1.0 / 200e6 + 1.0 / 40e6), rel=1e-12)
    assert soft.mass[2] == pytest.approx(0.3, rel=1e-12)


def test_parts_add_and_what_is_left_out_is_rigid(action):
    given = {"bearing_axial": 2e8, "torsion": 4394.0, "seat": 5e8}
    found = wheel_compliances(action, compliances(action.radius, **given))
    assert list(found) == list(given)
    alone = [
        wheel_compliances(action, compliances(action.radius, **{name: value}))[name]
        for name, value in given.items()
    ]
    assert list(found.values()) == alone
    assert compliances(action.radius) == {}
    shaft = Shaft(bearing_axial=2e8, seat=5e8, units="SI")
    assert list(compliances_of(shaft, action.radius)) == ["bearing_axial", "seat"]
    assert shaft.axial == pytest.approx(1.0 / (1.0 / 2e8 + 1.0 / 5e8))
    assert Shaft().axial is None


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"bending": 90.0}, "span is missing"),
        ({"seat": 0.0}, "seat is 0; a stiffness must be positive"),
        ({"bending": -1.0, "span": SPAN}, "bending is -1"),
        (
            {"bending": 90.0, "span": SPAN, "position": 0.15},
            "position is 150 mm; it must lie between",
        ),
    ],
)
def test_what_cannot_be_a_shaft_is_refused_in_one_line(given, says):
    with pytest.raises(InputError, match=says):
        compliances(9e-3, **given)


def test_a_worm_that_cannot_drive_is_refused(geometry):
    with pytest.raises(InputError, match="so much that the worm cannot turn the wheel"):
        at(geometry, 3.0)


def test_a_shaft_that_bends_swings_as_an_even_beam_and_on_soft_bearings_as_a_rigid_one():
    # First mode of a simply supported beam: pi^2 sqrt(E I/(m l^3)); on springs 2k/m, and turning
    # (k l^2/2)/(m l^2/12).
    mass, radius, soft = 0.3, 9.8e-3, 1e5
    thin = bending_of(Shaft(diameter="17 mm", span="150 mm"), radius, mass)
    own = math.sqrt(bending_stiffness(D, E) / (mass * SPAN**3))
    swings = np.sqrt(thin.stiffness / thin.mass)
    assert swings[1:] == pytest.approx(math.pi**2 * own, rel=1e-2)
    assert swings[0] == pytest.approx(4.0 * math.pi**2 * own, rel=0.3)
    held = bending_of(Shaft(span="150 mm", bearing_radial="1e5 N/m"), radius, mass)
    swings = np.sqrt(held.stiffness / held.mass)
    assert swings[1:] == pytest.approx(math.sqrt(2.0 * soft / mass), rel=1e-9)
    assert swings[0] == pytest.approx(math.sqrt(6.0 * soft / mass), rel=1e-9)
