"""What is written for ParaView is as VTK's formats are described, and what VTK itself reads."""

import re
import xml.etree.ElementTree as ET
from html import unescape

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.mesh import HexMesh, box, shape
from asperity.mesh.vtu import write_series, write_vtu


@pytest.fixture(scope="module")
def pyvista():
    import pyvista

    return pyvista


# Of vtkTriQuadraticHexahedron, as VTK has them.
VTK_EDGES = [
    (0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7),
]  # fmt: skip
VTK_FACES = [(0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7)]


def shaken(order):
    mesh = box((1, 2, 3), (3, 3, 3), order)
    noise = np.random.default_rng(1).normal(scale=0.05, size=mesh.points.shape)
    return HexMesh(mesh.points + noise, mesh.cells)


def arrays(path):
    """The arrays of a file, which stand behind it, each after its length."""
    head, _, data = path.read_bytes().partition(b'<AppendedData encoding="raw">\n_')
    found = re.findall(rb'type="(\w+)" Name="([^"]*)".*?offset="(\d+)"', head)
    return {
        unescape(name.decode()): np.frombuffer(
            data, kind.decode().lower(), *length_and_place(data, int(offset), kind)
        )
        for kind, name, offset in found
    }


def length_and_place(data, offset, kind):
    length = int.from_bytes(data[offset : offset + 8], "little")
    return length // np.dtype(kind.decode().lower()).itemsize, offset + 8


@pytest.mark.parametrize(("order", "kind"), [(1, 12), (2, 29)])
def test_a_file_holds_the_mesh_and_its_data(tmp_path, order, kind):
    mesh = shaken(order)
    scalar = np.arange(len(mesh.points), dtype=float)
    data = {"pressure <MPa> & more": scalar, "displacement": mesh.points * 2, "held": scalar > 5}
    found = arrays(write_vtu(tmp_path / "a.vtu", mesh, data, {"number": scalar[: len(mesh.cells)]}))
    count, nodes = mesh.cells.shape
    expected = data | {
        "Points": mesh.points, "connectivity": mesh.cells, "number": scalar[:count],
        "offsets": nodes * np.arange(1, count + 1), "types": np.full(count, kind),
    }  # fmt: skip
    assert found.keys() == expected.keys()
    for name, values in expected.items():
        np.testing.assert_array_equal(found[name], np.ravel(values), name)


@pytest.mark.slow
@pytest.mark.parametrize(("order", "kind"), [(1, 12), (2, 29)])
def test_vtk_reads_the_mesh_and_its_data(pyvista, tmp_path, order, kind):
    mesh = shaken(order)
    scalar = np.arange(len(mesh.points), dtype=float)
    data = {"pressure <MPa> & more": scalar, "displacement": mesh.points * 2, "held": scalar > 5}
    path = write_vtu(tmp_path / "a.vtu", mesh, data, {"number": np.arange(len(mesh.cells))})
    grid = pyvista.read(path)
    np.testing.assert_array_equal(grid.points, mesh.points)
    np.testing.assert_array_equal(grid.cells_dict[kind], mesh.cells)
    np.testing.assert_array_equal(grid.point_data["pressure <MPa> & more"], scalar)
    np.testing.assert_array_equal(grid.point_data["displacement"], mesh.points * 2)
    np.testing.assert_array_equal(grid.point_data["held"], scalar > 5)
    np.testing.assert_array_equal(grid.cell_data["number"], np.arange(len(mesh.cells)))


@pytest.mark.slow
def test_vtk_finds_the_same_volume_and_quality(pyvista):
    mesh = shaken(1)
    grid = pyvista.UnstructuredGrid({12: mesh.cells}, mesh.points)
    quality = grid.cell_quality("scaled_jacobian")["scaled_jacobian"]
    np.testing.assert_allclose(mesh.scaled_jacobian(), quality, atol=1e-14)


@pytest.mark.slow
def test_vtk_numbers_the_nodes_of_a_quadratic_cell_alike(pyvista):
    mesh = shaken(2)
    grid = pyvista.UnstructuredGrid({29: mesh.cells}, mesh.points)
    cell = grid.get_cell(0)
    for number, face in enumerate(cell.faces):
        ours = mesh.face_nodes([[0, number]])[0]
        assert set(face.point_ids[:4]) == set(ours[:4].tolist())
        assert set(face.point_ids[4:8]) == set(ours[4:8].tolist())
        assert face.point_ids[8] == ours[8]
    middles = {frozenset(edge.point_ids[:2]): edge.point_ids[2] for edge in cell.edges}
    for number, ends in enumerate(shape.EDGES):
        assert middles[frozenset(mesh.cells[0, ends].tolist())] == mesh.cells[0, 8 + number]


@pytest.mark.slow
def test_a_series_plays_in_its_order(pyvista, tmp_path):
    mesh = box((1, 1, 1), (1, 1, 1))
    frames = ((0.5 * step, {"displacement": mesh.points * step}) for step in range(3))
    reader = pyvista.get_reader(write_series(tmp_path / "motion.pvd", mesh, frames))
    assert reader.time_values == [0.0, 0.5, 1.0]
    reader.set_active_time_value(1.0)
    np.testing.assert_array_equal(reader.read()[0].point_data["displacement"], mesh.points * 2)


def played(path):
    """Times and files of a series."""
    sets = ET.parse(path).getroot().iter("DataSet")
    return [(float(each.get("timestep")), each.get("file")) for each in sets]


def test_a_series_names_its_files_in_their_order(tmp_path):
    mesh = box((1, 1, 1), (1, 1, 1))
    frames = ((0.5 * step, {"displacement": mesh.points * step}) for step in range(3))
    path = write_series(tmp_path / "motion.pvd", mesh, frames)
    times, files = zip(*played(path), strict=True)
    assert times == (0.0, 0.5, 1.0)
    last = arrays(path.with_name(files[2]))["displacement"]
    np.testing.assert_array_equal(last, mesh.points.ravel() * 2)


def test_an_interrupted_series_keeps_what_was_written(tmp_path):
    mesh = box((1, 1, 1), (1, 1, 1))

    def frames():
        yield 0.0, {}
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_series(tmp_path / "motion.pvd", mesh, frames())
    ((time, file),) = played(tmp_path / "motion.pvd")
    assert time == 0.0
    assert (tmp_path / file).is_file()


def test_of_cells_that_are_sheared_the_scaled_jacobian_is_that_of_their_edges():
    mesh = box((1, 2, 3), (2, 2, 2))
    shear = np.array([[1.0, 0.4, 0.1], [0.0, 1.0, -0.3], [0.2, 0.0, 1.0]])
    sheared = HexMesh(mesh.points @ shear.T, mesh.cells)
    edges = shear / np.linalg.norm(shear, axis=0)
    np.testing.assert_allclose(sheared.scaled_jacobian(), np.linalg.det(edges), rtol=1e-12)


def test_the_nodes_of_a_quadratic_cell_are_numbered_as_vtk_says():
    cell = box((1, 1, 1), (1, 1, 1), 2)
    nodes = cell.points[cell.cells[0]]
    middles = [nodes[list(each)].mean(axis=0) for each in (*VTK_EDGES, *VTK_FACES, range(8))]
    np.testing.assert_allclose(nodes[8:], middles, atol=1e-15)


@pytest.mark.slow
def test_what_vtk_says_of_a_quadratic_cell_is_what_it_does(pyvista):
    mesh = box((1, 1, 1), (1, 1, 1), 2)
    cell = pyvista.UnstructuredGrid({29: mesh.cells}, mesh.points).get_cell(0)
    place = {int(point): n for n, point in enumerate(mesh.cells[0])}
    said = [[place[i] for i in part.point_ids] for part in (*cell.edges, *cell.faces)]
    found = {frozenset(ids[: 2 if len(ids) == 3 else 4]): ids[-1] for ids in said}
    told = [*VTK_EDGES, *VTK_FACES]
    assert found == {frozenset(corners): 8 + n for n, corners in enumerate(told)}


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.zeros(3), "give 8 rows"),
        (np.full(8, np.nan), "not finite"),
        (np.full(8, "a"), "give numbers"),
        (np.zeros((8, 3, 3)), "give 8 rows"),
    ],
)
def test_data_that_do_not_fit_are_refused_and_nothing_is_written(tmp_path, values, message):
    with pytest.raises(InputError, match=message):
        write_vtu(tmp_path / "a.vtu", box((1, 1, 1), (1, 1, 1)), {"a": values})
    assert not list(tmp_path.iterdir())
