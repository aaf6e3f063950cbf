"""Bodies of patches and their files: closed, silent, and clear about what is missing."""

import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
import trimesh
from apparatus.step import read_step

from asperity.errors import ConvergenceError, InputError, MissingExtraError, StorageError
from asperity.flanks.export import views
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.export.step import write_step
from asperity.flanks.export.tooth import tooth_body
from asperity.flanks.export.worm import worm_body
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.mesh.surface_files import write_glb, write_stl


@pytest.fixture(scope="module")
def wheel():
    gearset = Gearset(
        starts=2,
        wheel_teeth=31,
        axial_module="2 mm",
        diameter_factor=10.0,
        hand="left",
        worm_material="case-hardened steel",
        wheel_material="CuAl10Fe5Ni5-C-GZ",
    )
    return Wheel.cut(Pair.of(gearset, Hob(oversize=1.1)))


def block():
    """A body of four smooth sides and two plane ends."""
    low, high = np.array([-1.0, 1.0]), np.linspace(-1.0, 1.0, 5)
    x, y = np.meshgrid(low, high, indexing="ij")
    side = np.stack([y.T, -1 - 0.2 * np.cos(np.pi * y.T / 2), x.T], axis=-1)
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    patches = [Patch(side)]
    for _ in range(3):
        patches.append(patches[-1].moved(quarter))
    low_ring = [patch.points[::-1, 0] for patch in reversed(patches)]
    high_ring = [patch.points[:, -1] for patch in patches]
    return Body("block", patches, [low_ring, high_ring])


def test_a_patch_goes_through_its_points_and_a_cubic_is_itself():
    x, y = np.meshgrid(np.linspace(0, 1, 7), np.linspace(0, 1, 12), indexing="ij")

    def surface(a, b):
        return np.stack([a, b, a**3 - 2 * a * b**2 + b**5 * a], axis=-1)

    patch = Patch(surface(x, y))
    assert patch.degrees == (3, 5)
    a, b = np.random.default_rng(1).uniform(0, 1, (2, 6))
    expected = surface(*np.meshgrid(a, b, indexing="ij"))
    np.testing.assert_allclose(patch.at(a, b), expected, atol=1e-14)
    np.testing.assert_allclose(patch.finer(3).points[::3, ::3], patch.points, atol=1e-14)


def test_patches_with_the_same_points_on_an_edge_have_the_same_edge():
    rng = np.random.default_rng(2)
    first, second = rng.normal(size=(2, 9, 13, 3))
    second[0] = first[-1]
    places = np.linspace(0, 1, 50)
    np.testing.assert_array_equal(Patch(first).at([1.0], places), Patch(second).at([0.0], places))


def edges(body):
    """Each edge of each face by its ends and middle, as often as it occurs."""
    rows = []
    for patch in body.patches:
        grid = patch.points
        rows += [grid[0], grid[-1], grid[:, 0], grid[:, -1]]
    for ring in body.rings:
        rows += ring
        for row, following in zip(ring, [*ring[1:], ring[0]], strict=True):
            np.testing.assert_allclose(row[-1], following[0], atol=1e-12)
    marks = [np.sort(np.round(row[[0, -1]], 7), axis=0) for row in rows]
    middles = [np.round(0.5 * (row[len(row) // 2] + row[(len(row) - 1) // 2]), 7) for row in rows]
    return Counter(
        (*(ends + 0.0).ravel().tolist(), *(middle + 0.0).tolist())
        for ends, middle in zip(marks, middles, strict=True)
    )


@pytest.mark.slow
def test_every_edge_of_worm_tooth_teeth_and_wheel_joins_two_faces(wheel):
    bodies = [worm_body(wheel.pair), *(tooth_body(wheel, teeth) for teeth in (1, 3, 31))]
    for body in bodies:
        assert set(edges(body).values()) == {2}, body.name
    assert [body.name for body in bodies] == ["worm", "tooth", "teeth", "wheel"]


def finer(body):
    """A body with each step of its patches' grids halved."""
    rings = [
        [Patch(np.stack([row, row])).finer(2).points[0] for row in ring] for ring in body.rings
    ]
    return Body(body.name, [patch.finer(2) for patch in body.patches], rings)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tooth", "worm"])
def test_the_triangles_of_a_body_are_closed_and_hold_its_volume(wheel, tmp_path, name):
    body = tooth_body(wheel) if name == "tooth" else worm_body(wheel.pair, 10.0)
    volume = write_step(tmp_path / "a.step", body).check.volume
    surfaces = [body.surface(), finer(body).surface()]
    for surface in surfaces:
        assert trimesh.Trimesh(surface.points, surface.triangles, process=False).is_volume
    errors = [abs(surface.volume() / volume - 1) for surface in surfaces]
    assert errors[0] < 3e-3
    assert errors[1] < 0.35 * errors[0]


def test_bodies_go_into_stl_and_glb(wheel, tmp_path):
    worm, teeth = worm_body(wheel.pair, 15.0).surface(), tooth_body(wheel, 2).surface()
    solid = trimesh.load_mesh(write_stl(tmp_path / "worm.stl", worm))
    assert solid.volume == pytest.approx(worm.volume(), rel=1e-5)
    scene = trimesh.load_scene(write_glb(tmp_path / "both.glb", {"worm": worm, "wheel": teeth}))
    assert set(scene.geometry) == {"worm", "wheel"}


def test_step_names_the_body_and_prints_nothing(tmp_path, capfd):
    path = tmp_path / "block.step"
    write_step(path, block())
    read_step(path)
    assert capfd.readouterr() == ("", "")
    assert "PRODUCT('block" in path.read_text()
    assert "'asperity'" in path.read_text()


def test_what_open_cascade_keeps_is_put_back(tmp_path):
    from OCP.Interface import Interface_Static
    from OCP.Message import Message

    def kept():
        keys = ("write.step.product.name", "write.step.unit", "xstep.cascade.unit")
        return [
            *map(Interface_Static.CVal_s, keys),
            len(list(Message.DefaultMessenger_s().Printers())),
        ]

    write_step(tmp_path / "block.step", block())
    before = kept()
    write_step(tmp_path / "block.step", block())
    assert kept() == before


def test_a_body_that_is_not_closed_is_refused(tmp_path):
    open_body = Body("block", block().patches[:3], block().rings)
    with pytest.raises(ConvergenceError, match="faces do not close"):
        write_step(tmp_path / "block.step", open_body)
    assert not list(tmp_path.iterdir())


def test_a_step_file_that_cannot_be_written_is_named(tmp_path, capfd):
    with pytest.raises(StorageError, match=r"none/a\.step cannot be written: no such file"):
        write_step(tmp_path / "none" / "a.step", block())
    assert capfd.readouterr() == ("", "")


def test_impossible_bodies_are_refused(wheel):
    with pytest.raises(InputError, match="the wheel has 1 to 31"):
        tooth_body(wheel, 32)
    with pytest.raises(InputError, match="must be positive"):
        worm_body(wheel.pair, 0.0)


def test_a_missing_extra_says_how_to_install_it(wheel, tmp_path, monkeypatch):
    for name in ("OCP", "OCP.Geom", "pyvista"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=r"pip install asperity\[cad\]"):
        write_step(tmp_path / "a.step", block())
    with pytest.raises(MissingExtraError, match=r"pip install asperity\[view\]"):
        views.pair_view(tmp_path / "a.png", wheel)


@pytest.fixture(autouse=True)
def small_pictures(monkeypatch):
    monkeypatch.setattr(views, "SIZE", (400, 300))


def drawn(path):
    """The picture's numbers, and the share of it that is not paper."""
    from matplotlib.image import imread

    picture = imread(path)[..., :3]
    assert picture.shape == (*views.SIZE[::-1], 3)
    return picture, float((picture.min(axis=-1) < 0.95).mean())


@pytest.mark.slow
def test_worm_and_wheel_are_drawn(wheel, tmp_path, capfd):
    _, share = drawn(views.pair_view(tmp_path / "pair.png", wheel, teeth=3))
    assert 0.1 < share < 0.9
    assert capfd.readouterr() == ("", "")


def test_a_mesh_is_drawn(wheel, tmp_path):
    _, share = drawn(views.mesh_view(tmp_path / "plain.png", tooth(wheel, "coarse")))
    assert 0.1 < share < 0.9


def test_importing_the_package_imports_no_extra():
    code = (
        "import sys, asperity.flanks.export.views, asperity.flanks.export.step, asperity.mesh.vtu\n"
        "assert not {'OCP', 'pyvista', 'vtkmodules', 'trimesh'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
