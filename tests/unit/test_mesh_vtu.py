"""What is written for ParaView is what VTK itself reads."""

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.mesh import HexMesh, box, shape
from asperity.mesh.vtu import write_series, write_vtu


@pytest.fixture(scope="module")
def pyvista():
    import pyvista

    return pyvista


def shaken(order):
    mesh = box((1, 2, 3), (3, 3, 3), order)
    noise = np.random.default_rng(1).normal(scale=0.05, size=mesh.points.shape)
    return HexMesh(mesh.points + noise, mesh.cells)


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


def test_vtk_finds_the_same_volume_and_quality(pyvista):
    mesh = shaken(1)
    grid = pyvista.UnstructuredGrid({12: mesh.cells}, mesh.points)
    quality = grid.cell_quality("scaled_jacobian")["scaled_jacobian"]
    np.testing.assert_allclose(mesh.scaled_jacobian(), quality, atol=1e-14)


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


def test_a_series_plays_in_its_order(pyvista, tmp_path):
    mesh = box((1, 1, 1), (1, 1, 1))
    frames = ((0.5 * step, {"displacement": mesh.points * step}) for step in range(3))
    reader = pyvista.get_reader(write_series(tmp_path / "motion.pvd", mesh, frames))
    assert reader.time_values == [0.0, 0.5, 1.0]
    reader.set_active_time_value(1.0)
    np.testing.assert_array_equal(reader.read()[0].point_data["displacement"], mesh.points * 2)


def test_an_interrupted_series_keeps_what_was_written(pyvista, tmp_path):
    mesh = box((1, 1, 1), (1, 1, 1))

    def frames():
        yield 0.0, {}
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_series(tmp_path / "motion.pvd", mesh, frames())
    assert pyvista.get_reader(tmp_path / "motion.pvd").time_values == [0.0]


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
