"""Dimensions over pins and balls against closed forms, brute force and each other.

Sources: DIN 3960 for involute helical gears, to which the ZI worm belongs with the helix angle of
90 deg less its lead angle: inv alpha_Kt = D_M/(z m_n cos alpha_n) - eta + inv alpha_t, with half
the space's angle eta, d_K = d cos alpha_t/cos alpha_Kt, M = d_K + D_M; a wheel whose hob grows
without bound is a spur gear of the same formula; distances to the worm are the package's own,
proved elsewhere.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from asperity.errors import InputError
from asperity.flanks.measuring.measures import measure
from asperity.flanks.measuring.wheel import Space
from asperity.flanks.measuring.worm import Groove
from asperity.flanks.meshing.backlash import play
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.parameters import Hob, MeasuringOptions
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import turned
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

GEARSET = {
    "starts": 4,
    "wheel_teeth": 60,
    "axial_module": "2.15380 mm",
    "diameter_factor": 8.4,
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}


def pair(hob=None, **changes):
    return Pair.of(Gearset(**GEARSET | changes), hob)


@pytest.fixture(scope="module")
def wheel():
    return Wheel.cut(pair(Hob(oversize=1.12, tilt="2 deg")))


def involute(angle):
    return math.tan(angle) - angle


def centres(diameter, teeth, reference, normal_module, pressure_angle, helix, space):
    """The closed form of the diameter on which the balls' centres lie."""
    transverse = math.atan(math.tan(pressure_angle) / math.cos(helix))
    known = diameter / (teeth * normal_module * math.cos(pressure_angle)) - space
    wanted = known + involute(transverse)
    at = brentq(lambda angle: involute(angle) - wanted, 1e-6, 1.57, xtol=1e-15)
    return reference * math.cos(transverse) / math.cos(at)


@pytest.mark.parametrize("starts", [1, 2, 3, 4, 6])
@pytest.mark.parametrize("thinned", [0.0, 0.06])
def test_a_zi_worm_over_pins_is_that_of_the_closed_form(starts, thinned):
    worm = pair(starts=starts).worm
    worm = worm.with_half_space(worm.half_space + thinned)
    groove = Groove(worm)
    for diameter in np.linspace(*groove.diameters, 5)[1:-1]:
        normal = 2.0 * worm.reduced_lead * math.cos(worm.lead_angle) / starts
        space = worm.half_space / worm.reduced_lead
        expected = diameter + centres(
            diameter,
            starts,
            2.0 * worm.pitch_radius,
            normal,
            worm.pressure_angle,
            math.pi / 2 - worm.lead_angle,
            space,
        )
        assert groove.over(diameter).dimension == pytest.approx(expected, abs=1e-9)


@pytest.mark.ordinary(4)
@pytest.mark.parametrize("flank", ["ZI", "ZA", "ZN", "ZK", "ZC"])
def test_a_pin_touches_both_flanks_and_stands_further_out_when_turned(flank):
    worm = pair(flank=flank).worm
    rest = Groove(worm).optimum(worm.pitch_radius)
    assert rest.contact == pytest.approx(worm.pitch_radius, abs=1e-9)
    centre = np.array([rest.radius, 0.0, 0.0])
    for side in (1, -1):
        assert distances(centre, worm, side) == pytest.approx(rest.diameter / 2, abs=1e-10)
    # Along the helix of its centre for ZI; turned from there it would cut in.
    along = np.linspace(-3.0, 3.0, 601)[:, None]
    least = []
    tilts = np.linspace(0.5, 1.5, 101)
    for tilt in tilts:
        points = centre + along * np.array([0.0, math.sin(tilt), math.cos(tilt)])
        near = np.hypot(*points[:, :2].T) < worm.tip_radius + rest.diameter / 2
        least.append(distances(points[near], worm).min() - rest.diameter / 2)
    best = int(np.argmax(least))
    assert least[best] == pytest.approx(0.0, abs=2e-3)
    assert max(least) <= 1e-9
    if flank == "ZI":
        helix = math.atan2(rest.radius, worm.reduced_lead)
        assert tilts[best] == pytest.approx(helix, abs=0.011)


def test_a_pin_that_does_not_rest_on_the_flanks_is_refused():
    groove = Groove(pair().worm)
    for diameter in (1.0, 9.0):
        with pytest.raises(InputError, match=r"measuring\.pin_diameter is .* rest on the worm"):
            groove.over(diameter)


def test_a_ball_touches_both_flanks_of_the_wheels_space_and_cuts_into_none(wheel):
    rest = Space(wheel).over(3.5)
    pitch = 2 * math.pi / wheel.pair.geometry.wheel_teeth
    centre = rest.radius * np.array([math.sin(pitch / 2), math.cos(pitch / 2), 0.0])
    beyond = turned(pitch)
    for points in (
        wheel.flank(1).grid(121, 121).points,
        wheel.flank(-1).grid(121, 121).points @ beyond.T,
    ):
        gap = np.linalg.norm(points - centre, axis=-1) - 1.75
        # Between the points of the grid the flank is nearer by a part of their distance squared.
        assert 0.0 <= gap.min() < 2e-4
    assert Space(wheel).optimum(rest.contact).diameter == pytest.approx(3.5, abs=1e-8)


def test_the_wheel_of_an_endless_hob_is_a_spur_gear():
    errors = []
    for factor in (100.0, 200.0, 400.0):
        made = pair(
            starts=1, wheel_teeth=40, axial_module="2 mm", diameter_factor=factor,
            wheel_face_width="4 mm", tooth_proportions="iso",
        )  # fmt: skip
        gear = made.geometry
        rest = Space(Wheel(made)).over(3.5)
        helix = gear.lead_angle
        expected = 3.5 + centres(
            3.5, 40, gear.wheel_reference_diameter, gear.normal_module, gear.pressure_angle,
            helix, math.pi / 80,
        )  # fmt: skip
        errors.append(abs(rest.dimension - expected))
    assert errors[-1] < 1e-4
    assert errors[2] < 0.6 * errors[1] < 0.6 * 0.6 * errors[0]


def test_over_an_odd_number_of_teeth_the_balls_stand_askew():
    made = Wheel(pair(wheel_teeth=61))
    rest = Space(made).over(3.5)
    expected = 2 * rest.radius * math.cos(math.pi / 122) + 3.5
    assert rest.dimension == pytest.approx(expected, rel=1e-14)


@pytest.mark.slow
def test_what_threads_and_teeth_are_thinner_turns_out_in_the_backlash(wheel):
    meshes = {side: transmission(wheel.pair, wheel.flank(side)) for side in (1, -1)}
    free = play(meshes)
    options = MeasuringOptions(thread_tolerance="40 um", tooth_tolerance="0 mm")
    found = measure(wheel, free, options)
    worm = wheel.pair.worm
    axial = 0.04 / math.cos(worm.lead_angle)
    thinner = worm.half_space + 0.5 * axial
    wider = play({side: mesh.with_worm(thinner) for side, mesh in meshes.items()})
    mean = wheel.pair.geometry.wheel_mean_diameter / 2
    assert found.backlash_circumferential_max == pytest.approx(wider.wheel_angle * mean, abs=1e-9)
    # Nearly: it is a distance between flanks that are not quite parallel.
    least = min(wider.normal.values())
    assert found.backlash_normal_max == pytest.approx(least, abs=2e-3)
    assert found.over_balls_lower == pytest.approx(found.over_balls_upper, abs=1e-9)
    assert found.over_pins_lower < found.over_pins_upper
    assert found.thread_allowance_lower == pytest.approx(-0.04, abs=1e-12)
