"""What a gearset is drawn from in space: lines that lie on both flanks, and a size that is kept."""

import functools
import json
import struct

import numpy as np
import pytest
from apparatus.grid import slow
from scipy.spatial import KDTree

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.export.space.packed import MOST_BYTES, MOST_TRIANGLES
from asperity.flanks.study.flank import prepare, prepare_gearset, study
from asperity.gearset import Gearset

NEAR = 0.3
TURNED = ("+1", "-1")


@functools.cache
def made(hand):
    settings = [f"gearset.hand={hand}", "mount.backlash=0.4 mm"]
    answer = study(prepare(read_case("gearset-3", case_tables(), settings), density="coarse"))
    return answer, answer.attached()["flanks.bin"]


def opened(content):
    """The header and the arrays, read as the page reads them."""
    length = struct.unpack("<I", content[:4])[0]
    header = json.loads(content[4 : 4 + length])
    data = content[4 + length :]
    arrays = {
        name: np.frombuffer(
            data, "<" + told["dtype"], int(np.prod(told["shape"])), told["offset"]
        ).reshape(told["shape"])
        for name, told in header["arrays"].items()
    }
    return header, arrays


def spread(points, triangles, steps=4):
    """Points all over triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    shares = [(i / steps, j / steps) for i in range(steps + 1) for j in range(steps + 1 - i)]
    return np.concatenate([a + u * (b - a) + v * (c - a) for u, v in shares])


def about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


@functools.cache
def surfaces(hand):
    header, arrays = opened(made(hand)[1])
    points, triangles = arrays["worm.points"].astype(float), arrays["worm.triangles"]
    # Only the threads, and only where they can meet a tooth.
    met = (np.abs(points[:, 2]) < 22.0) & (np.hypot(*points[:, :2].T) < 2 * header["worm_radius"])
    worm = spread(points, triangles[met[triangles].all(axis=1)])
    teeth = {}
    for side in TURNED:
        one = spread(
            arrays[f"flank.points.{side}"].reshape(-1, 3).astype(float),
            arrays[f"flank.triangles.{side}"],
            3,
        )
        step = 2 * np.pi / header["teeth"]
        teeth[side] = KDTree(np.concatenate([one @ about_z(k * step).T for k in range(-3, 4)]))
    return header, arrays, KDTree(worm), teeth


def distances(hand, side, n, worm_sign=1.0, wheel_sign=1.0):
    """The greatest distances of an angle's contact lines to worm and wheel, turned by it."""
    header, arrays, worm, teeth = surfaces(hand)
    begin = arrays[f"lines.begin.{side}"]
    ends = arrays[f"lines.points.{side}"][begin[n] : begin[n + 1]].reshape(-1, 3).astype(float)
    phi = header["pitch"] * n / header["angles"]
    placed = np.array(header["worm"]["rotation"]) @ about_z(worm_sign * phi)
    on_worm = (ends - header["worm"]["place"]) @ placed
    wheel = wheel_sign * phi * header["starts"] / header["teeth"] + header["sides"][side]["ahead"]
    on_wheel = ends @ about_z(wheel)
    return worm.query(on_worm)[0].max(), teeth[side].query(on_wheel)[0].max()


@pytest.mark.slow
@pytest.mark.parametrize("hand", ["right", "left"])
def test_contact_lines_lie_on_worm_and_wheel_turned_by_their_ratio(hand):
    header, *_ = surfaces(hand)
    for side in TURNED:
        for n in range(3, header["angles"], 19):
            worm, wheel = distances(hand, side, n)
            assert worm < NEAR
            assert wheel < NEAR


@pytest.mark.slow
@pytest.mark.parametrize("side", TURNED)
def test_no_contact_line_turns_back_where_the_flank_of_the_worm_ends(side):
    header, arrays = opened(made("right")[1])
    begin, tooth = arrays[f"lines.begin.{side}"], arrays[f"lines.tooth.{side}"]
    for n in range(header["angles"]):
        these = slice(begin[n], begin[n + 1])
        z = arrays[f"lines.points.{side}"].reshape(-1, 2, 3)[these, :, 2]
        for one in np.unique(tooth[these]):
            pieces = z[tooth[these] == one]
            assert np.abs(np.diff(pieces)).sum() <= np.ptp(pieces) + 1e-3


@pytest.mark.slow
@pytest.mark.parametrize("hand", ["right", slow("left")])
def test_turned_the_other_way_neither_meets_the_lines(hand):
    worm = [distances(hand, "+1", n, worm_sign=-1.0)[0] for n in (14, 20)]
    wheel = [distances(hand, "+1", n, wheel_sign=-1.0)[1] for n in (14, 20)]
    assert min(worm) > 2 * NEAR
    assert min(wheel) > 2 * NEAR


@pytest.mark.slow
def test_a_left_handed_pair_is_drawn_as_the_mirror_image():
    right, left = opened(made("right")[1])[1], opened(made("left")[1])[1]
    for side in TURNED:
        for name in ("flank.points", "lines.points"):
            turned_round = left[f"{name}.{side}"] * np.array([1, 1, -1], "f4")
            assert np.abs(turned_round - right[f"{name}.{side}"]).max() < 1e-5
        for layer in ("gap", "line_load", "sliding"):
            both = (found[f"layer.{layer}.{side}"] for found in (left, right))
            np.testing.assert_allclose(*both, rtol=1e-4, atol=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("hand", ["right", "left"])
def test_flanks_are_seen_from_outside_the_tooth(hand):
    answer, content = made(hand)
    arrays = opened(content)[1]
    for side, flank in answer.analysis.flanks.items():
        points = arrays[f"flank.points.{side:+d}"].reshape(-1, 3).astype(float)
        a, b, c = (points[arrays[f"flank.triangles.{side:+d}"][:, k]] for k in range(3))
        outside = flank.grid.normals[0, 0] * [1.0, 1.0, flank.mirror]
        assert np.cross(b - a, c - a)[0] @ outside > 0


@pytest.mark.slow
def test_the_map_of_line_load_is_the_load_when_the_line_passes():
    answer, _ = made("right")
    for flank in answer.analysis.flanks.values():
        over = flank.line_load(flank.under_load())
        lines = flank.loaded[3]
        there = lines.lines.at_ends(over).mean(axis=1)
        force = lines.load * lines.lines.length
        assert np.sum(there * lines.lines.length) == pytest.approx(force.sum(), rel=0.02)
        assert np.abs(there - lines.load).max() < 0.15 * lines.load.max()


@pytest.mark.slow
def test_layers_are_those_of_the_study():
    answer, content = made("right")
    header, arrays = opened(content)
    assert [layer["key"] for layer in header["layers"]] == [
        "gap", "ease_off", "line_load", "sliding",
    ]  # fmt: skip
    flank = answer.analysis.flanks[-1]
    gap = 1e3 * np.maximum(flank.pattern.gap, 0.0)
    np.testing.assert_allclose(arrays["layer.gap.-1"], gap, atol=1e-4)
    assert header["sides"]["-1"]["contact_ratio_marked"] == flank.contact_ratio_marked


def test_teeth_that_bear_come_to_the_contact_ratio():
    flank = made("right")[0].analysis.flanks[1]
    teeth = flank.transmission.teeth(flank.pattern.thickness)
    assert np.mean(teeth) == pytest.approx(flank.contact_ratio_marked, abs=0.1)
    assert flank.transmission.teeth().min() >= 1


@pytest.mark.slow
def test_without_a_load_there_is_neither_line_load_nor_sliding():
    gearset = read_case("gearset-3", case_tables(), ()).require(Gearset)
    header, arrays = opened(
        study(prepare_gearset(gearset, density="coarse")).attached()["flanks.bin"]
    )
    assert [layer["key"] for layer in header["layers"]] == ["gap", "ease_off"]
    assert not any("line_load" in name for name in arrays)


@pytest.mark.slow
def test_the_whole_is_small_enough_for_a_page():
    for hand in ("right", "left"):
        content = made(hand)[1]
        header, arrays = opened(content)
        count = {name: len(values) for name, values in arrays.items() if "triangles" in name}
        fine = sum(count[name] for name in ("beside.triangles", "flank.triangles.+1",
                                            "flank.triangles.-1"))  # fmt: skip
        drawn = count["worm.triangles"] + count["hub.triangles"] + header["fine"] * fine
        drawn += (header["teeth"] - header["fine"]) * count["tooth.triangles"]
        assert len(content) <= MOST_BYTES
        assert drawn <= MOST_TRIANGLES
        assert header["fine"] % 2 == 1
