"""Figures of chapter 7 that show gearset 3 in space; drawn by `drawings`."""

import functools
import math
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.export.worm import mounted_worm, worm_body
from asperity.flanks.mesh.tooth import CONTACT_FLANKS, contact_counts, flank_height, tooth
from asperity.flanks.wheel.enveloped import FlankGrid, Wheel, WheelFlank
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair
from asperity.mesh import HexMesh
from asperity.results.dataset import described
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.flanks import drawings
from asperity.thesis.flanks.meshing import Gear, pair_of, stood
from asperity.thesis.flanks.shapes import Shape, joined

GEAR = Gear("gearset-3b")

STEP = math.radians(30.0)
"""Turn of the hob between two cuts of the stepwise simulation."""

_ENLARGED = 30.0
_FLANK = GEAR.command()
_SECTOR = 9
_NOT_FLANK = (
    "flank_minus", "fillet_plus", "fillet_minus", "tip", "inner", "cut_minus", "cut_plus",
    "face_low", "face_high",
)  # fmt: skip


@functools.cache
def _wheel() -> Wheel:
    return Wheel.cut(pair_of(GEAR))


@functools.cache
def _mesh(density: str, teeth: int) -> HexMesh:
    return tooth(_wheel(), density, teeth=teeth)


def _centred(shape: Shape, teeth: int) -> Shape:
    return shape.turned(-2.0 * math.pi * (teeth // 2) / _wheel().pair.geometry.wheel_teeth)


def facet_height(flank: WheelFlank, grid: FlankGrid, step: float) -> FloatArray:
    """Return how far a hob that cuts at steps alone, rad, leaves material beyond a flank, mm."""
    pair: Pair = flank.pair
    first = math.floor(float(grid.phase.min()) / step)
    last = math.ceil(float(grid.phase.max()) / step)
    height = np.zeros(grid.radius.shape)
    # The hob's surface is as good as flat over a facet, and its normal there the flank's.
    for _ in range(2):
        points = grid.points + height[..., None] * grid.normals
        left = np.full(height.shape, math.inf)
        for number in range(first, last + 1):
            phase = number * step
            place = pair.cutting.to_helicoid(stood(points, phase / pair.ratio))
            place[..., 2] += pair.hob.reduced_lead * phase
            left = np.minimum(left, distances(place, pair.hob, flank.side))
        height = height + left
    return height


@figure("7.1", drawings.gearset)
def _gearset() -> Computed:
    wheel = _wheel()
    teeth = wheel.pair.geometry.wheel_teeth
    ring = tooth(wheel, 1.2, teeth=teeth)
    whole = joined([Shape.of_mesh(ring), Shape.of_body(mounted_worm(wheel.pair), 1, every=(2, 1))])
    flank = wheel.flank(1)
    grid = flank.grid(61, 97)
    height = facet_height(flank, grid, STEP)
    rest = Shape.of_mesh(_mesh("intermediate", 1), _NOT_FLANK)
    raised = grid.points + _ENLARGED * height[..., None] * grid.normals
    dataset = described(
        **whole.variables("gearset"),
        **joined([rest, Shape.of_grid(grid.points), Shape.of_grid(raised)]).variables("stepped"),
        **joined([rest, Shape.of_grid(grid.points)]).variables("exact"),
        face=(("row", "column"), grid.z, "mm", "distance from mid-face"),
        radius=(("row", "column"), grid.radius, "mm", "distance from the wheel's axis"),
        facet_height=(("row", "column"), height, "mm", "material left by cuts at steps"),
        step=((), math.degrees(STEP), "deg", "turn of the hob between cuts"),
        enlargement=((), _ENLARGED, "1", "how many times the facets are drawn enlarged"),
    )
    how = [
        "asperity.flanks.mesh.tooth, asperity.flanks.export.worm.mounted_worm of gearset-3b",
        "asperity.thesis.flanks.solids.facet_height",
    ]
    return dataset, how


@figure("7.2", drawings.sector)
def _sector() -> Computed:
    teeth = _centred(Shape.of_mesh(_mesh("coarse", _SECTOR)), _SECTOR)
    both = joined([teeth, Shape.of_body(mounted_worm(_wheel().pair), 1, every=(2, 1))])
    dataset = described(**both.variables("gearset"))
    return dataset, [f"{_FLANK} --out out/flank"]


@figure("7.3", drawings.shell)
def _shell() -> Computed:
    worm = Shape.of_body(worm_body(_wheel().pair), 1, every=(5, 1), ends=False)
    dataset = described(**worm.variables("worm"))
    return dataset, [f"{_FLANK} --out out/flank"]


@figure("7.4", drawings.topology)
def _topology() -> Computed:
    mesh = _mesh("intermediate", 1)
    groups = (
        ("inner", "cut_minus", "cut_plus", "face_low", "face_high"),
        ("flank_plus", "flank_minus"), ("fillet_plus", "fillet_minus"), ("tip",),
    )  # fmt: skip
    parts = [Shape.of_mesh(mesh, sets, part) for part, sets in enumerate(groups)]
    dataset = described(
        **joined(parts).variables("tooth"),
        **Shape.of_mesh(mesh).variables("mesh"),
        elements=((), len(mesh.cells), "1", "hexahedra"),
        scaled_jacobian=((), float(mesh.scaled_jacobian().min()), "1", "least scaled Jacobian"),
    )
    return dataset, [f"{_FLANK} --density intermediate --out out/flank"]


@figure("7.11", drawings.densities)
def _densities() -> Computed:
    numbers = {name: contact_counts(name) for name in CONTACT_FLANKS}
    meshes = {name: tooth(_wheel(), counts) for name, counts in numbers.items()}
    variables: dict[str, Any] = {}
    for name, mesh in meshes.items():
        variables |= Shape.of_mesh(mesh).variables(name)
    wheel = _wheel()
    height, face = flank_height(wheel), wheel.pair.geometry.wheel_face_width
    at = ("density",)
    count = [len(mesh.cells) for mesh in meshes.values()]
    least = [float(mesh.scaled_jacobian().min()) for mesh in meshes.values()]
    dataset = described(
        density=(at, np.array(list(meshes), dtype=object), "1", "mesh density"),
        element_height=(
            at, [height / each.flank for each in numbers.values()], "mm",
            "of an element over the height of the flank",
        ),
        element_width=(
            at, [face / each.face for each in numbers.values()], "mm",
            "of an element along the face",
        ),
        elements=(at, count, "1", "hexahedra of a tooth"),
        scaled_jacobian=(at, least, "1", "least scaled Jacobian"),
        **variables,
    )  # fmt: skip
    return dataset, [
        f"asperity drive drive-thesis --static --set drive.density={name}" for name in meshes
    ]
