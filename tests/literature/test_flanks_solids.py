"""The whole worm, the whole wheel and both in mesh as STEP: closed, exact, named, and in place.

Sources: in a closed shell of ISO 10303-42 every edge is used twice, in opposite senses; its faces,
edges and vertices obey Euler and Poincare's rule; a turned body's volume is Pappus's; the distance
to the worm and the volume of the tooth's mesh are the package's own, proved elsewhere.
"""

import re
from collections import Counter, defaultdict

import numpy as np
import pytest
from apparatus.step import faces, parts, read_step, sampled

from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.cad.brep import solid
from asperity.flanks.export.cad.solids import Solids
from asperity.flanks.export.tooth import WHEEL_FLANK_ERROR, wheel_body
from asperity.flanks.export.turned import merged, shaft_sections, volume
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.meshing.analysis import analyse
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.blanks import Blanks, rim_radius, wheel_section

pytestmark = pytest.mark.slow

GEARSET = {
    "starts": 2,
    "wheel_teeth": 23,
    "axial_module": "2 mm",
    "diameter_factor": 10.0,
    "hand": "left",
    "profile_shift": 0.3,
    "wheel_face_width": "7 mm",
    "worm_material": "case-hardened steel",
    "wheel_material": "CuAl10Fe5Ni5-C-GZ",
}
BLANKS = Blanks(bore="14 mm", hub_diameter="24 mm", web_width="4 mm", drive_end="30 mm")


def rim_and_disc(wheel, blanks, density="intermediate"):
    """Volume of the teeth's mesh, and of what is turned below them."""
    geometry = wheel.pair.geometry
    rim = tooth(wheel, density, order=2).volume() * geometry.wheel_teeth
    disc = np.pi * rim_radius(geometry) ** 2 * geometry.wheel_face_width
    return rim + disc - volume(wheel_section(geometry, blanks))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The pair as analysed, how it stands, and the folder of its files."""
    gearset = Gearset(**GEARSET)
    # The raw flanks of an oversized hob would overlap.
    pair = Pair.of(gearset, Hob(oversize=1.1), Mount(shaft_angle_error="0.05 deg"))
    wheel = Wheel.cut(pair)
    assembly = Assembly.of(analyse(pair, wheel, rows=8, columns=9), made=True)
    folder = tmp_path_factory.mktemp("solids")
    Solids.of(wheel, assembly, BLANKS).write(folder, "two to twenty-three")
    return wheel, assembly, folder


def entities(path):
    """The entities of a STEP file: number to name and arguments."""
    text = path.read_text().split("DATA;")[1]
    found = re.findall(r"#(\d+)\s*=\s*([A-Z_0-9]+)\s*\((.*?)\);\s*\n", text, re.DOTALL)
    return {int(number): (name, words.replace("\n", "")) for number, name, words in found}


def references(words):
    return [int(number) for number in re.findall(r"#(\d+)", words)]


def topology(path):
    """The shells of a STEP file: uses of each edge by sense, and Euler and Poincare's number."""
    known = entities(path)
    for name, words in known.values():
        if name != "CLOSED_SHELL":
            continue
        uses, loops, vertices = defaultdict(list), 0, set()
        faces = references(words)
        for face in faces:
            assert known[face][0] == "ADVANCED_FACE"
            *bounds, _ = references(known[face][1])
            loops += len(bounds)
            for bound in bounds:
                assert known[bound][0] in ("FACE_BOUND", "FACE_OUTER_BOUND")
                along = known[bound][1].rstrip().endswith(".T.")
                (loop,) = references(known[bound][1])
                for used in references(known[loop][1]):
                    (edge,) = references(known[used][1])
                    forward = known[used][1].rstrip().endswith(".T.")
                    uses[edge].append(forward == along)
                    vertices |= set(references(known[edge][1])[:2])
        yield uses, len(vertices) - len(uses) + len(faces) - (loops - len(faces))


@pytest.mark.parametrize(("name", "holes"), [("wheel", 1), ("worm", 0)])
def test_every_edge_is_used_twice_in_opposite_senses(made, name, holes):
    ((uses, euler),) = topology(made[2] / f"{name}.step")
    assert {tuple(sorted(senses)) for senses in uses.values()} == {(False, True)}
    assert euler == 2 - 2 * holes


def test_the_assembly_holds_both_by_name_in_millimetres(made):
    path = made[2] / "gearset.step"
    assert [euler for _, euler in topology(path)] == [2, 0]
    known = entities(path)
    products = [words.split("'")[1] for name, words in known.values() if name == "PRODUCT"]
    assert products == ["two to twenty-three", "worm", "wheel"]
    used = [
        words.split("'")[3]
        for name, words in known.values()
        if name == "NEXT_ASSEMBLY_USAGE_OCCURRENCE"
    ]
    assert used == ["worm", "wheel"]
    lengths = re.findall(r"LENGTH_UNIT\(\)[^;]*;", path.read_text())
    assert all("SI_UNIT(.MILLI.,.METRE.)" in words for words in lengths)
    assert len(lengths) == 3


def held(shape):
    """The volume by the divergence theorem over the faces, tessellated to a few micrometres."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepMesh import BRepMesh_IncrementalMesh
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopLoc import TopLoc_Location

    BRepMesh_IncrementalMesh(shape, 4e-3, False, 0.12)
    total = 0.0
    for face in faces(shape):
        mesh = BRep_Tool.Triangulation_s(face, TopLoc_Location())
        nodes = [mesh.Node(k + 1) for k in range(mesh.NbNodes())]
        points = np.array([(node.X(), node.Y(), node.Z()) for node in nodes])
        corners = np.array([mesh.Triangle(k + 1).Get() for k in range(mesh.NbTriangles())]) - 1
        a, b, c = points[corners].swapaxes(0, 1)
        part = np.einsum("mi,mi->", a, np.cross(b, c)) / 6
        total += -part if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else part
    return total


def test_the_wheel_has_the_volume_of_its_mesh_and_of_what_is_turned(made):
    wheel, _, folder = made
    read = read_step(folder / "wheel.step")
    assert read.check.valid
    assert read.check.volume == pytest.approx(rim_and_disc(wheel, BLANKS), rel=1e-5)


@pytest.mark.campaign
@pytest.mark.parametrize(
    "changes",
    [
        {"starts": 4, "wheel_teeth": 25, "hand": "left", "flank": "ZK", "axial_module": "8 mm"},
        # The rim beside the throat needs finer grids than the throat.
        {"starts": 2, "wheel_teeth": 60, "axial_module": "4 mm", "diameter_factor": 9.0},
    ],
)
def test_wheels_whose_parts_need_grids_of_their_own_close(changes):
    materials = {key: GEARSET[key] for key in ("worm_material", "wheel_material")}
    wheel = Wheel.cut(Pair.of(Gearset(**{"diameter_factor": 9.5} | materials | changes)))
    made = solid(wheel_body(wheel)).check
    assert made.valid
    assert made.free_edges == 0
    assert made.volume == pytest.approx(rim_and_disc(wheel, None, "coarse"), rel=1e-4)


def test_the_tessellated_faces_hold_the_same_volume(made):
    wheel, _, folder = made
    read = read_step(folder / "wheel.step").shape
    assert held(read) == pytest.approx(rim_and_disc(wheel, BLANKS), rel=1e-4)


def test_the_worm_is_a_screw_on_a_shaft(made):
    _, assembly, folder = made
    pair = assembly.pair
    length = pair.geometry.worm_face_width
    node, weight = np.polynomial.legendre.leggauss(60)
    first = pair.worm.curve(np.array([0.0]))[:2]
    area = pair.worm.root_radius**2 * first[1][0]
    for start in (0.0, 1.0, 2.0):
        rho, _, _, slope = pair.worm.curve(start + 0.5 * (1.0 + node))
        area += 0.5 * np.sum(weight * rho**2 * slope)
    ends = [-volume(section) for section in shaft_sections(pair, BLANKS)]
    expected = length * pair.worm.starts * area / pair.worm.reduced_lead + sum(ends)
    read = read_step(folder / "worm.step")
    assert read.check.valid
    assert read.check.volume == pytest.approx(expected, rel=1e-7)


def test_worm_and_wheel_of_the_assembly_stand_in_mesh_and_do_not_overlap(made):
    _, assembly, folder = made
    pair = assembly.pair
    assert assembly.thinned > 1e-3
    shape = read_step(folder / "gearset.step").shape
    screw, mate = parts(shape, "SOLID")
    worm = screw.Location().Transformation()
    moved = np.array([[worm.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
    np.testing.assert_allclose(moved[:, 3], [0.0, pair.geometry.centre_distance, 0.0], atol=1e-9)
    # The shafts cross at a right angle, but for the error they are mounted with.
    assert abs(moved[2, 2]) == pytest.approx(np.sin(np.radians(0.05)), abs=1e-9)
    mirror = np.array([1.0, 1.0, -1.0])
    least = {1: np.inf, -1: np.inf}
    for points in sampled(mate, np.linspace(0.0, 1.0, 7)):
        if points[:, 1].max() > 15.0 and np.abs(points[:, 0]).min() < 10.0:
            place = pair.mounting.to_helicoid(points * mirror)
            for side in least:
                least[side] = min(least[side], distances(place, pair.worm, side).min())
    for gap in least.values():
        assert -WHEEL_FLANK_ERROR < gap < 5e-3
    # Both flanks are as near to the thread: the wheel stands in the middle of what play there is.
    assert least[1] == pytest.approx(least[-1], abs=2e-3)


def test_merged_sections_are_what_the_files_have(made):
    wheel, _, folder = made
    known = Counter(name for name, _ in entities(folder / "wheel.step").values())
    section = merged(wheel_section(wheel.pair.geometry, BLANKS))
    cylinders = np.count_nonzero(np.diff(section[:, 0]) == 0.0)
    assert known["CYLINDRICAL_SURFACE"] == cylinders
    # Two chamfers; the hub's faces, the web's and the wheel's own.
    assert known["CONICAL_SURFACE"] == 2
    assert known["PLANE"] == 6
