"""Bodies of patches and their files: closed, silent, and clear about what is missing."""

import subprocess
import sys
from collections import Counter

import numpy as np
import pytest
from apparatus.step import read_step

from asperity.errors import ConvergenceError, InputError, MissingExtraError, StorageError
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.brep import Solid
from asperity.flanks.export.cad.solids import Solids
from asperity.flanks.export.cad.step import write_step
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.export.space import views
from asperity.flanks.export.space.scene import gearset_scene, write_gearset
from asperity.flanks.export.tooth import SHOWN as TOOTH_SHOWN
from asperity.flanks.export.tooth import tooth_body, wheel_body
from asperity.flanks.export.turned import merged, shaft_sections, volume
from asperity.flanks.export.worm import SHOWN, whole_worm, worm_body
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.parameters import Hob
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.blanks import Blanks, wheel_section
from asperity.mesh.glb import Node, write_glb
from asperity.mesh.stl import write_stl

GEARSET = {
    "starts": 2,
    "wheel_teeth": 31,
    "axial_module": "2 mm",
    "diameter_factor": 10.0,
    "hand": "left",
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}


@pytest.fixture(scope="module")
def wheel():
    return Wheel.cut(Pair.of(Gearset(**GEARSET), Hob(oversize=1.1)))


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
    bodies = [worm_body(wheel.pair), *(tooth_body(wheel, teeth) for teeth in (1, 3))]
    bodies += [whole_worm(wheel.pair), wheel_body(wheel)]
    for body in bodies:
        assert set(edges(body).values()) == {2}, body.name
    assert [body.name for body in bodies] == ["worm", "tooth", "teeth", "worm", "wheel"]


@pytest.mark.slow
def test_the_skins_of_whole_worm_and_wheel_are_closed(wheel):
    import trimesh

    for body in (whole_worm(wheel.pair, spacing=SHOWN), wheel_body(wheel, spacing=TOOTH_SHOWN)):
        surface = body.surface()
        assert trimesh.Trimesh(surface.points, surface.triangles, process=False).is_volume


PLAIN = {"bore": "30 mm", "hub_width": "10 mm", "web_width": "10 mm", "chamfer": "0 mm"}


@pytest.mark.parametrize(
    ("sizes", "pieces"),
    [
        ({}, 11),
        # No web, no chamfer: the hub's faces are those of the wheel, and all that is left is bore.
        (PLAIN | {"wheel": "10 mm"}, 1),
        ({"web_width": "5 mm", "hub_width": "5 mm", "chamfer": "0 mm"}, 5),
    ],
)
def test_what_lies_in_one_plane_or_on_one_cylinder_is_one_face(sizes, pieces):
    sizes = dict(sizes)
    numbers = GEARSET | {"wheel_face_width": sizes.pop("wheel", "13 mm")}
    geometry = Gearset(**numbers).geometry
    section = wheel_section(geometry, Blanks(**sizes))
    assert len(merged(section)) - 1 == pieces
    # From the axis to the section, the same missing volume.
    assert volume(merged(section)) == pytest.approx(volume(section), rel=1e-12) or pieces == 1


@pytest.mark.parametrize(
    ("sizes", "line"),
    [
        ({"bore": "70 mm"}, "blank.bore is 70 mm; the inside of the rim has"),
        ({"bore": "20 mm", "hub_diameter": "20 mm"}, "blank.bore is 20 mm; the hub has 20 mm"),
        ({"hub_diameter": "70 mm"}, "blank.hub_diameter is 70 mm; the inside of the rim has"),
        ({"web_width": "20 mm"}, "blank.web_width is 20 mm; the wheel's face is"),
        ({"chamfer": "9 mm"}, "blank.chamfer is 9 mm; there is room for at most"),
        ({"shaft_diameter": "16 mm"}, "blank.shaft_diameter is 16 mm; the worm's root"),
        ({"free_end": "0.1 mm", "chamfer": "1 mm"}, "blank.chamfer is 1 mm; there is room for"),
    ],
)
def test_sizes_that_leave_no_room_are_refused_in_a_line(wheel, sizes, line):
    def both():
        wheel_section(wheel.pair.geometry, Blanks(**sizes))
        shaft_sections(wheel.pair, Blanks(**sizes))

    with pytest.raises(InputError, match=line):
        both()


@pytest.mark.slow
def test_a_part_that_does_not_close_costs_no_other_and_a_remedy_is_told(
    wheel, tmp_path, monkeypatch
):
    def unclosed(body):
        if body.name == "wheel":
            raise ConvergenceError("the wheel's 9 faces do not close")
        return Solid(body.name, body, None)

    monkeypatch.setattr("asperity.flanks.export.cad.solids.solid", unclosed)
    for body in ("tooth_body", "whole_worm", "wheel_body"):
        name = body.partition("_")[0] if body != "whole_worm" else "worm"
        monkeypatch.setattr(
            f"asperity.flanks.export.cad.solids.{body}", lambda *_, name=name: Body(name, [], [])
        )
    monkeypatch.setattr(
        "asperity.flanks.export.cad.solids.write_step", lambda path, _: path.write_text("")
    )
    made = Solids.of(wheel, Assembly(pair=wheel.pair, thinned=0.0, wheel_angle=0.0))
    assert made.write(tmp_path) == ["tooth.step", "worm.step"]
    assert {file.name for file in tmp_path.iterdir()} == {"tooth.step", "worm.step"}
    assert str(made.failure) == (
        "wheel.step and gearset.step cannot be written, all else is: the wheel's 9 faces do not "
        "close; another hob.tip_radius or a narrower gearset.wheel_face_width may close them"
    )


@pytest.mark.slow
def test_the_gearset_to_mail_is_small_and_turns_by_its_ratio(wheel, tmp_path):
    import trimesh

    assembly = Assembly(pair=wheel.pair, thinned=0.0, wheel_angle=0.0)
    path = write_gearset(tmp_path / "gearset.glb", gearset_scene(wheel, assembly))
    assert path.stat().st_size < 2e6
    scene = trimesh.load_scene(path)
    assert set(scene.geometry) == {"worm", "hub", "tooth 1"}
    assert len(scene.graph.nodes_geometry) == 2 + 31
    # Upright, the worm above the wheel by the centre distance, in metres.
    worm = scene.geometry["worm"].copy().apply_transform(scene.graph["worm"][0])
    assert worm.bounds.mean(axis=0)[1] == pytest.approx(
        1e-3 * wheel.pair.geometry.centre_distance, rel=1e-3
    )
    assert scene.bounds[0, 1] == pytest.approx(
        -0.5e-3 * wheel.pair.geometry.wheel_outside_diameter, rel=0.01
    )


def finer(body):
    """A body with each step of its patches' grids halved."""
    rings = [
        [Patch(np.stack([row, row])).finer(2).points[0] for row in ring] for ring in body.rings
    ]
    return Body(body.name, [patch.finer(2) for patch in body.patches], rings)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["tooth", "worm"])
def test_the_triangles_of_a_body_are_closed_and_hold_its_volume(wheel, tmp_path, name):
    import trimesh

    body = tooth_body(wheel) if name == "tooth" else worm_body(wheel.pair, 10.0)
    volume = write_step(tmp_path / "a.step", body).check.volume
    surfaces = [body.surface(), finer(body).surface()]
    for surface in surfaces:
        assert trimesh.Trimesh(surface.points, surface.triangles, process=False).is_volume
    errors = [abs(surface.volume() / volume - 1) for surface in surfaces]
    assert errors[0] < 3e-3
    assert errors[1] < 0.35 * errors[0]


@pytest.mark.slow
def test_bodies_go_into_stl_and_glb(wheel, tmp_path):
    import trimesh

    worm, teeth = worm_body(wheel.pair, 15.0).surface(), tooth_body(wheel, 2).surface()
    solid = trimesh.load_mesh(write_stl(tmp_path / "worm.stl", worm))
    assert solid.volume == pytest.approx(worm.volume(), rel=1e-5)
    scene = trimesh.load_scene(
        write_glb(tmp_path / "both.glb", [Node("worm", worm), Node("wheel", teeth)])
    )
    assert set(scene.geometry) == {"worm", "wheel"}


@pytest.mark.slow
def test_step_names_the_body_and_prints_nothing(tmp_path, capfd):
    path = tmp_path / "block.step"
    write_step(path, block())
    read_step(path)
    assert capfd.readouterr() == ("", "")
    assert "PRODUCT('block" in path.read_text()
    assert "'asperity'" in path.read_text()


@pytest.mark.slow
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
    with pytest.raises(InputError, match="1 to 30 can be cut out of the wheel"):
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


@pytest.mark.slow
def test_a_mesh_is_drawn(wheel, tmp_path):
    _, share = drawn(views.mesh_view(tmp_path / "plain.png", tooth(wheel, "coarse")))
    assert 0.1 < share < 0.9


@pytest.mark.slow
def test_importing_the_package_imports_no_extra():
    code = (
        "import sys, asperity.mesh.vtu\n"
        "import asperity.flanks.export.space.views, asperity.flanks.export.cad.step\n"
        "assert not {'OCP', 'pyvista', 'vtkmodules', 'trimesh'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
