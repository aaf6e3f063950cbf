"""A worm with a helical wheel: both flanks touch where they are said to, as closed forms have it.

The flanks are written down here once more, as what the tangents of a base helix sweep.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.gearset.crossed import crossed
from asperity.gearset.point_contact import point_contact

CASES = ("gearset-2", "gearset-3", "gearset-3b", "actuator-duty")
INVOLUTE = np.vectorize(lambda x: x - math.atan(x))


def pair_of(name, *settings):
    return crossed(read_case(name, case_tables(), settings).require(Gearset).geometry)


def frame(gear):
    """Two directions across the axis that turn from the first to the second about it."""
    first = np.cross(gear.axis, [0.3, 0.5, 0.7])
    first /= np.linalg.norm(first)
    return first, np.cross(gear.axis, first)


def phase(gear, point, side):
    """By how much the flank through a point is turned, that of one side of a right-hand thread."""
    first, second = frame(gear)
    away = np.asarray(point) - gear.foot
    x, y, z = away @ first, away @ second, away @ gear.axis
    tangent = np.sqrt(x * x + y * y - gear.base_radius**2) / gear.base_radius
    return (
        np.arctan2(y, x)
        - z * math.tan(gear.base_helix) / gear.base_radius
        + side * (INVOLUTE(tangent))
    )


def normal_of(gear, point, side):
    """Of that flank, by differences of its phase."""
    step = 1e-5
    found = [
        (phase(gear, point + d, side) - phase(gear, point - d, side)) / (2 * step)
        for d in step * np.eye(3)
    ]
    return np.array(found) / np.linalg.norm(found)


def side_of(gear, point, normal):
    """The side whose flank has the normal there."""
    close = {s: abs(normal_of(gear, point, s) @ normal) for s in (1, -1)}
    return max(close, key=close.get), max(close.values())


@pytest.mark.parametrize("name", CASES)
def test_both_flanks_touch_along_the_line_and_turn_in_the_ratio_of_their_teeth(name):
    case = read_case(name, case_tables())
    g, pair = case.require(Gearset).geometry, pair_of(name)
    ways = np.linspace(*pair.ends, 9)
    for gear, teeth in ((pair.worm, g.starts), (pair.wheel, g.wheel_teeth)):
        side, _ = side_of(gear, pair.at(ways[4]), pair.normal)
        for way in ways:
            _, close = side_of(gear, pair.at(way), pair.normal)
            assert close == pytest.approx(1.0, abs=1e-8)
        turned = [phase(gear, pair.at(way), side) for way in ways]
        # A tooth further on the line is one base pitch.
        angle = 2.0 * math.pi / teeth * (ways - ways[0]) / pair.base_pitch
        assert np.abs(np.diff(turned)) == pytest.approx(np.diff(angle), rel=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_flanks_lie_apart_around_the_point_as_hertz_takes_them(name):
    pair = pair_of(name)
    point = pair.at(0.5 * sum(pair.ends))
    across = np.cross(pair.normal, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    other = np.cross(pair.normal, across)

    def height(gear, u, v):
        side, _ = side_of(gear, point, pair.normal)
        zero, at = phase(gear, point, side), point + u * across + v * other
        return brentq(lambda h: phase(gear, at + h * pair.normal, side) - zero, -1, 1, xtol=1e-15)

    step = 0.05
    gap = {(i, j): height(pair.wheel, i * step, j * step) - height(pair.worm, i * step, j * step)
           for i in (-1, 0, 1) for j in (-1, 0, 1)}  # fmt: skip
    bend = np.array(
        [[gap[1, 0] + gap[-1, 0], (gap[1, 1] + gap[-1, -1] - gap[1, -1] - gap[-1, 1]) / 4.0],
         [0.0, gap[0, 1] + gap[0, -1]]]
    ) / step**2  # fmt: skip
    found = np.abs(np.linalg.eigvalsh(bend, UPLO="U"))
    one, two = (1.0 / r for r in pair.radii_of_curvature(0.5 * sum(pair.ends)))
    turn = 2.0 * pair.between_generators
    apart = math.sqrt(one**2 + two**2 + 2.0 * one * two * math.cos(turn))
    assert np.sort(found) == pytest.approx([(one + two - apart) / 2, (one + two + apart) / 2],
                                           rel=2e-3)  # fmt: skip
    # Nowhere into each other.
    signs = {np.sign(value) for place, value in gap.items() if place != (0, 0)}
    assert len(signs) == 1


@pytest.mark.parametrize("name", CASES)
def test_what_the_references_have_in_closed_form(name):
    g, pair = read_case(name, case_tables()).require(Gearset).geometry, pair_of(name)
    m, gamma = g.normal_module, g.lead_angle
    z_1, z_2 = g.starts, g.wheel_teeth
    without = 0.5 * m * (z_1 / math.sin(gamma) + z_2 / math.cos(gamma))
    assert without + pair.shift * m == pytest.approx(g.centre_distance, rel=1e-12)
    # Textbooks' base diameters: d cos(alpha_t), tan(alpha_t) = tan(alpha_n)/cos(beta).
    for gear, d, beta in ((pair.worm, g.worm_pitch_diameter, math.pi / 2 - gamma),
                          (pair.wheel, pair.wheel_diameter, gamma)):  # fmt: skip
        of_plane = math.atan(math.tan(g.pressure_angle) / math.cos(beta))
        assert 2.0 * gear.base_radius == pytest.approx(d * math.cos(of_plane), rel=1e-12)
    # Where both reference cylinders touch, the worm slides along its thread.
    slid = pair.sliding(0.0, 100.0)
    if abs(pair.shift) < 1e-4:
        along = 100.0 * 0.5 * g.worm_pitch_diameter / math.cos(gamma)
        assert np.linalg.norm(slid) == pytest.approx(along, rel=1e-4)
    for way in np.linspace(*pair.ends, 5):
        slid = pair.sliding(way, 100.0)
        assert slid @ pair.normal == pytest.approx(0.0, abs=1e-10 * np.linalg.norm(slid))


def test_the_contact_ratio_is_that_of_both_tips():
    # Equal gears at 45 degrees without shift: from tip to tip, each half by its own triangle.
    pair = pair_of("gearset-3", "gearset.starts=30", "gearset.wheel_teeth=30",
                   "gearset.diameter_factor=30", "gearset.axial_module=2 mm",
                   "gearset.centre_distance=60 mm", "gearset.worm_face_width=60 mm",
                   "gearset.wheel_face_width=60 mm")  # fmt: skip
    assert pair.shift == pytest.approx(0.0, abs=1e-12)
    assert math.degrees(pair.helix) == pytest.approx(45.0)
    own = [
        (math.sqrt(gear.tip_radius**2 - gear.base_radius**2)
         - math.sqrt(30.0**2 - gear.base_radius**2)) / math.cos(gear.base_helix)
        for gear in (pair.worm, pair.wheel)
    ]  # fmt: skip
    assert pair.path == pytest.approx(sum(own), rel=1e-12)
    assert pair.contact_ratio == pytest.approx(sum(own) / pair.base_pitch)
    assert set(pair.ended_by) == {"tip of the worm", "tip of the wheel"}
    narrow = pair_of("gearset-3", "gearset.wheel_face_width=2 mm")
    assert narrow.ended_by == ("end of the wheel", "end of the wheel")
    # Along the line the wheel is left at its base helix.
    lean = math.sin(narrow.wheel.base_helix)
    assert narrow.path == pytest.approx(2.0 / lean, rel=1e-12)


def test_point_contacts_by_hertz():
    # Crossed equal cylinders are a ball on a plane.
    ball = point_contact(100.0, (10.0, 10.0), math.pi / 2.0, 1e5)
    assert ball.long == pytest.approx((3.0 * 100.0 * 10.0 / (4.0 * 1e5)) ** (1.0 / 3.0))
    assert ball.pressure == pytest.approx(1.5 * 100.0 / (math.pi * ball.long**2))
    near = point_contact(100.0, (10.0, 10.0 * (1.0 + 1e-6)), math.pi / 2.0, 1e5)
    assert near[:] == pytest.approx(ball[:], rel=1e-6)
    # Nearly parallel ones are a line under the force for each length in the middle, p a pi/2.
    line = point_contact(100.0, (10.0, 20.0), 1e-5, 1e5)
    load = 0.5 * math.pi * line.short * line.pressure
    width = math.sqrt(4.0 * load / (math.pi * 1e5 * (1 / 10.0 + 1 / 20.0)))
    assert line.short == pytest.approx(width, rel=1e-4)
    assert 2.0 / 3.0 * math.pi * line.long * line.short * line.pressure == pytest.approx(100.0)
    # By the root of three: eightfold force, twice the size.
    more = point_contact(800.0, (10.0, 20.0), 1.0, 1e5)
    assert more.long == pytest.approx(2.0 * point_contact(100.0, (10.0, 20.0), 1.0, 1e5).long)
    for wrong in ((0.0, (1.0, 1.0), 1.0, 1.0), (1.0, (1.0, -1.0), 1.0, 1.0),
                  (1.0, (1.0, 1.0), 2.0, 1.0), (1.0, (1.0, 1.0), 1.0, 0.0)):  # fmt: skip
        with pytest.raises(InputError, match="is none: all must be above 0"):
            point_contact(*wrong)
