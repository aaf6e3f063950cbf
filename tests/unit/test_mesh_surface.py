"""Surfaces and their files, read back by a program of others."""

import itertools
import json
import struct

import numpy as np
import pytest
from apparatus.meshes import skin
from scipy.spatial.transform import Rotation

from asperity.errors import InputError
from asperity.mesh import HexMesh, box
from asperity.mesh.glb import Node, write_glb
from asperity.mesh.stl import write_stl
from asperity.mesh.surface import Surface, joined


def barrel(order, unit="mm"):
    mesh = box((1, 1, 1), (4, 4, 4), order, unit=unit)
    scale = 1 + 0.3 * np.sin(np.pi * mesh.points[:, 2:])
    return HexMesh(mesh.points * np.hstack([scale, scale, 1 + 0 * scale]), mesh.cells, unit=unit)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("order", [1, 2])
def test_the_skin_of_a_mesh_is_a_closed_surface_with_its_outside_outside(order):
    import trimesh

    mesh = barrel(order)
    surface = skin(mesh)
    solid = trimesh.Trimesh(surface.points, surface.triangles, process=False)
    assert solid.is_volume
    assert len(surface.triangles) == 2 * 96 * order**2
    assert solid.volume == pytest.approx(surface.volume(), rel=1e-12)
    # Triangles cut the corners of curved faces.
    assert surface.volume() == pytest.approx(mesh.volume(), rel=0.02)


def test_a_grid_has_its_outside_where_its_rows_turn_towards_its_columns():
    x, y = np.meshgrid(np.linspace(0, 1, 4), np.linspace(0, 2, 3), indexing="ij")
    surface = Surface.of_grid(np.stack([x, y, 0 * x], axis=-1))
    np.testing.assert_allclose(surface.normals(), [[0, 0, 1]] * 12)


def test_stl_comes_back_with_its_triangles(tmp_path):
    import trimesh

    surface = skin(barrel(1))
    solid = trimesh.load_mesh(write_stl(tmp_path / "a.stl", surface))
    assert solid.is_volume
    assert len(solid.faces) == len(surface.triangles)
    assert solid.volume == pytest.approx(surface.volume(), rel=1e-6)
    np.testing.assert_allclose(solid.face_normals, surface.normals(), atol=1e-5)


def test_glb_comes_back_in_metres_with_y_upwards_named_and_coloured(tmp_path):
    import trimesh

    mesh = barrel(1)
    surface = skin(mesh)
    colours = np.tile([1.0, 0.5, 0.0], (len(surface.points), 1))
    coloured = Surface(surface.points, surface.triangles, "mm", colours)
    path = write_glb(tmp_path / "a.glb", [Node("plain", surface), Node("coloured", coloured)])
    scene = trimesh.load_scene(path)
    assert set(scene.geometry) == {"plain", "coloured"}
    # z from 0 to 1 mm has become y from 0 to 1e-3 m.
    np.testing.assert_allclose(scene.bounds[:, 1], [0, 1e-3], atol=1e-9)
    solid = scene.to_mesh()
    assert solid.volume == pytest.approx(2 * surface.volume() * 1e-9, rel=1e-5)
    seen = scene.geometry["coloured"].visual.vertex_attributes["color"]
    np.testing.assert_allclose(seen[:, :3], [[1, 0.5**2.2, 0]] * len(seen), rtol=1e-6)


def test_glb_is_shaded_smoothly_but_for_creases(tmp_path):
    import trimesh

    cube = skin(box((1, 1, 1), (2, 2, 2)))
    scene = trimesh.load_scene(write_glb(tmp_path / "a.glb", [Node("cube", cube)]))
    normals = scene.geometry["cube"].vertex_normals
    # Every corner of a cube's triangle is shaded with its own face's normal.
    assert np.isclose(np.abs(normals).max(axis=1), 1).all()


def parts_of_glb(path):
    """The JSON of a GLB and a function that gives the numbers of its accessors."""
    content = path.read_bytes()
    magic, version, length = struct.unpack_from("<4sII", content)
    assert (magic, version, length) == (b"glTF", 2, len(content))
    size, kind = struct.unpack_from("<I4s", content, 12)
    assert kind == b"JSON"
    document = json.loads(content[20 : 20 + size])
    rest, kind = struct.unpack_from("<I4s", content, 20 + size)
    assert kind == b"BIN\0"
    assert size % 4 == rest % 4 == 0
    assert document["buffers"] == [{"byteLength": rest}]
    binary = content[28 + size :]

    def numbers(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        kind = {5126: "<f4", 5123: "<u2", 5125: "<u4"}[accessor["componentType"]]
        columns = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        start = view["byteOffset"]
        values = np.frombuffer(binary[start : start + view["byteLength"]], kind)
        return values.reshape(accessor["count"], columns)

    return document, numbers


def test_glb_stores_a_surface_once_and_turns_what_turns(tmp_path):
    cube = skin(box((1, 1, 1), (2, 2, 2)))
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    wheel = Node("wheel", children=[Node("a", cube), Node("b", cube, quarter)], turns=-0.3)
    path = write_glb(tmp_path / "a.glb", [wheel, Node("worm", cube, quarter.T, turns=1.0)])
    document, numbers = parts_of_glb(path)
    assert len(document["meshes"]) == 1
    (primitive,) = document["meshes"][0]["primitives"]
    indices = numbers(primitive["indices"])
    assert document["accessors"][primitive["indices"]]["componentType"] == 5123
    points = numbers(primitive["attributes"]["POSITION"])
    normals = numbers(primitive["attributes"]["NORMAL"])
    # Nine corners on each of six faces.
    assert len(points) == len(normals) == indices.max() + 1 == 54
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1.0, atol=1e-6)
    (animation,) = document["animations"]
    turned = {}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        times, turns = numbers(sampler["input"])[:, 0], numbers(sampler["output"])
        assert channel["target"]["path"] == "rotation"
        steps = [
            (one.inv() * two).as_rotvec()
            for one, two in itertools.pairwise(Rotation.from_quat(turns))
        ]
        assert np.abs(steps).max() < 0.6 * np.pi
        name = document["nodes"][channel["target"]["node"]]["name"]
        turned[name] = np.sum(steps, axis=0) / (2 * np.pi), times[-1]
    np.testing.assert_allclose(turned["wheel"][0], [0, 0, -0.3], atol=1e-6)
    np.testing.assert_allclose(turned["worm"][0], [0, 0, 1], atol=1e-6)
    assert turned["wheel"][1] == turned["worm"][1] == 4.0


def test_a_scene_has_one_unit(tmp_path):
    one = skin(box((1, 1, 1), (1, 1, 1)))
    other = Surface(one.points, one.triangles, "mm")
    with pytest.raises(InputError, match="one unit"):
        write_glb(tmp_path / "a.glb", [Node("a", one), Node("b", other)])


def test_surfaces_join_and_keep_their_colours():
    one = skin(box((1, 1, 1), (1, 1, 1)))
    both = joined([one, one])
    assert both.volume() == pytest.approx(2)
    red = Surface(one.points, one.triangles, "m", np.tile([1.0, 0, 0], (8, 1)))
    assert joined([red, one]).colours is None
    assert len(joined([red, red]).colours) == 16


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"points": np.full((8, 3), np.inf)}, "finite"),
        ({"triangles": np.zeros((1, 4), int)}, "triangles"),
        ({"triangles": np.array([[0, 1, 8]])}, "beyond the 8"),
        ({"unit": "ft"}, "allowed"),
        ({"colours": np.full((8, 3), 2.0)}, "between 0 and 1"),
    ],
)
def test_a_surface_cannot_hold_nonsense(change, message):
    one = skin(box((1, 1, 1), (1, 1, 1)))
    with pytest.raises(InputError, match=message):
        Surface(**{"points": one.points, "triangles": one.triangles} | change)


def test_nothing_is_no_scene(tmp_path):
    with pytest.raises(InputError, match="at least one"):
        write_glb(tmp_path / "a.glb", [])
