"""Meshes in the input files of Abaqus and CalculiX."""

import numpy as np
import pytest
from apparatus.inp import read_inp

from asperity.errors import InputError
from asperity.mesh import HexMesh, box
from asperity.mesh.inp import mesh_lines, write_inp


def shaken(order):
    mesh = box((1, 2, 3), (3, 2, 2), order, unit="mm")
    noise = np.random.default_rng(1).normal(scale=0.05, size=mesh.points.shape)
    return HexMesh(mesh.points + noise, mesh.cells, mesh.node_sets, mesh.face_sets, "mm")


@pytest.mark.parametrize(
    ("order", "element"), [(1, "C3D8"), (1, "C3D8I"), (1, "C3D8R"), (2, "C3D27")]
)
def test_a_mesh_comes_back_as_it_was_written(tmp_path, order, element):
    mesh = shaken(order)
    path = write_inp(tmp_path / "a.inp", mesh, element, element_sets={"some": [0, 3]})
    back = read_inp(path, "mm")
    assert back.element == element
    # The solvers read 20 characters of a number, 14 digits.
    np.testing.assert_allclose(back.mesh.points, mesh.points, rtol=1e-13, atol=0)
    np.testing.assert_array_equal(back.mesh.cells, mesh.cells)
    assert back.mesh.volume() == pytest.approx(mesh.volume(), rel=1e-12)
    for name in mesh.node_sets:
        np.testing.assert_array_equal(back.mesh.node_set(name), mesh.node_set(name))
        np.testing.assert_array_equal(back.mesh.face_set(name), mesh.face_set(name))
    np.testing.assert_array_equal(back.element_sets["some"], [0, 3])
    np.testing.assert_array_equal(back.element_sets["body"], np.arange(len(mesh.cells)))


def test_the_six_faces_of_an_element_bear_the_solvers_numbers(tmp_path):
    # Faces of the manual: S1 holds nodes 1-4, S2 5-8, S3 1, 2, 5, 6 and so on round the cell.
    manual = {
        1: {1, 2, 3, 4},
        2: {5, 6, 7, 8},
        3: {1, 2, 5, 6},
        4: {2, 3, 6, 7},
        5: {3, 4, 7, 8},
        6: {4, 1, 8, 5},
    }
    cube = box((1, 1, 1), (1, 1, 1))
    cube = HexMesh(cube.points[cube.cells[0]], [np.arange(8)])
    lines = [f"*SURFACE, TYPE=ELEMENT, NAME=f{face}\n1, S{face}" for face in manual]
    path = tmp_path / "a.inp"
    path.write_text("\n".join([*mesh_lines(cube), *lines]))
    mesh = read_inp(path).mesh
    for face, nodes in manual.items():
        assert set((mesh.face_nodes(f"f{face}") + 1).ravel().tolist()) == nodes


def test_the_middles_of_a_27_node_element_stand_in_the_manual_s_order():
    # 21 is the middle of the cell, 22 to 27 those of the faces S1 to S6.
    cube = box((2, 2, 2), (1, 1, 1), 2).transformed(offset=(0, 0, -1))
    lines = list(mesh_lines(cube))
    start = lines.index("*ELEMENT, TYPE=C3D27, ELSET=body") + 1
    words = ",".join(lines[start : start + 2]).split(",")
    numbers = [int(word) for word in words if word.strip()]
    middles = cube.points[np.array(numbers[21:]) - 1]
    expected = [[0, 0, 0], [0, 0, -1], [0, 0, 1], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]]
    np.testing.assert_allclose(middles, expected, atol=1e-15)


def test_no_line_is_longer_than_the_solvers_allow(tmp_path):
    path = write_inp(tmp_path / "a.inp", shaken(2))
    for line in path.read_text().splitlines():
        words = [word for word in line.split(",") if word.strip()]
        assert len(words) <= 16
        assert len(line) <= 256
        if not line.startswith("*") and "." in line:
            assert max(len(word.strip()) for word in words) <= 20


@pytest.mark.parametrize(
    ("arguments", "message"),
    [({"element": "C3D27"}, "8-node cells allow 'C3D8'"), ({"element_set": "two words"}, "name")],
)
def test_what_the_solvers_would_not_read_is_not_written(arguments, message):
    with pytest.raises(InputError, match=message):
        list(mesh_lines(shaken(1), **arguments))
