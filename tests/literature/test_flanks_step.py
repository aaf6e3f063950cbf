"""Worm and wheel as STEP: exact, closed, and the same when read again.

Sources: the volume of a screw is its section's area times its length (Cavalieri); the distance to
the worm and the point of the wheel at a radius and a place are the package's own, proved elsewhere.
"""

import numpy as np
import pytest
from apparatus.grid import slow
from apparatus.step import read_step, sampled

from asperity.flanks.export.cad.step import write_step
from asperity.flanks.export.tooth import FLANK_ERROR, tooth_body
from asperity.flanks.export.worm import worm_body
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset

GEARSET_3B = {
    "starts": 4,
    "wheel_teeth": 60,
    "axial_module": "2.15380 mm",
    "diameter_factor": 8.4,
    "tooth_proportions": "bs721",
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}


def pair(**changes):
    gearset = Gearset.model_validate(GEARSET_3B | changes)
    return Pair.of(gearset, Hob(oversize=1.12, tilt="2 deg"))


@pytest.fixture(scope="module")
def wheel():
    return Wheel.cut(pair())


def between(shape):
    """Points on the surface of each face, 8 by 8, away from the points it was made through."""
    return sampled(shape, np.linspace(0.013, 0.987, 8))


def screw_volume(worm, length):
    """Length by the area of the section across the axis, half the integral of rho^2 dz / p."""
    node, weight = np.polynomial.legendre.leggauss(60)
    first = worm.curve(np.array([0.0]))[:2]
    area = worm.root_radius**2 * first[1][0]
    for start in (0.0, 1.0, 2.0):
        rho, _, _, slope = worm.curve(start + 0.5 * (1.0 + node))
        area += 0.5 * np.sum(weight * rho**2 * slope)
    # Both sides of each start make the section, each half of rho^2 dtheta = rho^2 dz / p.
    return length * worm.starts * area / worm.reduced_lead


@pytest.mark.slow
@pytest.mark.parametrize("flank", ["ZI", slow("ZA"), slow("ZN"), slow("ZK"), slow("ZC")])
def test_the_worm_has_the_volume_of_a_screw(flank, tmp_path):
    made = pair(flank=flank)
    written = write_step(tmp_path / "worm.step", worm_body(made, 30.0))
    assert written.check.valid
    assert written.check.free_edges == 0
    assert written.check.volume == pytest.approx(screw_volume(made.worm, 30.0), rel=1e-7)


@pytest.mark.slow
def test_every_face_of_the_worm_lies_on_the_exact_worm(tmp_path):
    made = pair()
    path = tmp_path / "worm.step"
    write_step(path, worm_body(made, 30.0))
    count = 0
    for points in between(read_step(path).shape):
        assert np.abs(distances(points, made.worm)).max() < FLANK_ERROR
        count += 1
    # Root, two flanks, two roundings and a land for each start.
    assert count == 6 * made.worm.starts


@pytest.mark.slow
def test_every_flank_of_the_tooth_lies_on_the_exact_wheel(wheel, tmp_path):
    path = tmp_path / "tooth.step"
    write_step(path, tooth_body(wheel))
    found = {1: 0, -1: 0}
    for points in between(read_step(path).shape):
        radius, z = np.hypot(points[:, 0], points[:, 1]), points[:, 2]
        for side in found:
            start, tip = wheel.flank(side).limits(z)
            if ((start < radius) & (radius < tip - 1e-6)).all():
                exact = wheel.flank(side).at(radius, z)
                offset = np.einsum("ij,ij->i", points - exact.points, exact.normals)
                if np.abs(offset).max() < 0.1:
                    assert np.abs(offset).max() < FLANK_ERROR
                    found[side] += 1
    # One on the throat, one on each side of it where the blank is a cylinder.
    assert found == {1: 3, -1: 3}


@pytest.mark.slow
def test_the_tooth_is_closed_and_the_same_when_read_again(wheel, tmp_path):
    path = tmp_path / "tooth.step"
    written = write_step(path, tooth_body(wheel)).check
    read = read_step(path).check
    for check in (written, read):
        assert check.valid
        assert check.free_edges == 0
    assert read.faces == written.faces
    assert read.volume == pytest.approx(written.volume, rel=1e-12)
    assert read.area == pytest.approx(written.area, rel=1e-12)


@pytest.mark.slow
def test_the_tooth_has_the_volume_of_its_mesh(wheel, tmp_path):
    volume = write_step(tmp_path / "tooth.step", tooth_body(wheel)).check.volume
    assert tooth(wheel, "fine", order=2).volume() == pytest.approx(volume, rel=1e-6)


@pytest.mark.slow
def test_three_teeth_are_thrice_one_tooth(wheel, tmp_path):
    one = write_step(tmp_path / "one.step", tooth_body(wheel)).check
    three = write_step(tmp_path / "three.step", tooth_body(wheel, 3)).check
    assert three.valid
    assert three.volume == pytest.approx(3 * one.volume, rel=1e-9)


@pytest.mark.slow
def test_a_left_hand_gearset_is_the_mirror_image(tmp_path):
    left = Wheel.cut(pair(hand="left"))
    right = Wheel.cut(pair())
    mirrored = tooth_body(left).moved(np.diag([1.0, 1.0, -1.0]))
    for ours, theirs in zip(mirrored.patches, tooth_body(right).patches, strict=True):
        np.testing.assert_allclose(ours.points, theirs.points, atol=1e-12)
    volumes = [
        write_step(tmp_path / "tooth.step", tooth_body(wheel)).check.volume
        for wheel in (left, right)
    ]
    assert volumes[0] == pytest.approx(volumes[1], rel=1e-9)
    assert write_step(tmp_path / "worm.step", worm_body(left.pair, 20.0)).check.volume > 0


@pytest.mark.campaign
@pytest.mark.parametrize(
    "changes",
    [
        slow({"starts": 1, "wheel_teeth": 30, "diameter_factor": 10, "profile_shift": 0.5}),
        slow({"starts": 6, "wheel_teeth": 82, "diameter_factor": 14, "pressure_angle": "25 deg"}),
        slow({"starts": 2, "wheel_teeth": 45, "pressure_angle": "30 deg"}),
    ],
)
def test_other_gearsets_close_as_well(changes, tmp_path):
    shift = changes.pop("profile_shift", None)
    numbers = GEARSET_3B | changes
    if shift is not None:
        numbers["profile_shift"] = shift
    made = Pair.of(Gearset.model_validate(numbers), Hob(oversize=1.1))
    for body in (tooth_body(Wheel.cut(made)), worm_body(made)):
        written = write_step(tmp_path / "body.step", body).check
        assert written.valid
        assert written.free_edges == 0
        assert read_step(tmp_path / "body.step").check.volume == pytest.approx(
            written.volume, rel=1e-12
        )
