"""Stress at the fillets of a wheel on its web against CalculiX, which solves the whole wheel.

Three teeth of sixty have the mesh of `RootModel`, the others are coarse; all are 20-node hexahedra,
as is the web, held at the hub. A tooth is pulled along the edge of its tip.
"""

import math
import shutil

import numpy as np
import pytest
from apparatus.calculix import solved
from apparatus.drives import problem
from scipy.spatial import cKDTree

from asperity.contact.interface.surface import contact_surface
from asperity.drive.root_stress.model import GRADING, RootModel, Roots
from asperity.drive.static.solve import wheel_of
from asperity.drive.teeth.rim_moves import MovingRim
from asperity.drive.teeth.sector import right_handed
from asperity.flanks.mesh.tooth import Counts, _cells, tooth
from asperity.flanks.wheel.frame import turned
from asperity.gearset.blanks import WheelBody, rim_radius

FINE = Counts(flank=4, face=4, thickness=4, rim=3, land=2, low_fillet=3, high_fillet=3)
FAR = Counts(flank=1, face=4, thickness=1, rim=3, land=1, low_fillet=1, high_fillet=1)
# The package's own way to the rim's motion: linear hexahedra.
LINEAR = Counts(flank=4, face=8, thickness=3, rim=3, land=2, low_fillet=2, high_fillet=2)
WEB = WheelBody(6.6, 23.2)
PULL = np.array([-1e3, 200.0, 400.0])
LAYERS = 6

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not shutil.which("ccx"), reason="CalculiX is not installed"),
]


def pulled(mesh, tooth_there, turn=None):
    """Forces, (N, 3), along the edge of a tooth's tip, as much a length everywhere."""
    turn = np.eye(3) if turn is None else turn
    edge = np.intersect1d(mesh.face_nodes(tooth_there), mesh.face_nodes("tip"))
    edge = edge[np.argsort(mesh.points[edge, 2])]
    z, order = mesh.points[edge, 2], mesh.order
    share = np.array([0.5, 0.5]) if order == 1 else np.array([1.0, 4.0, 1.0]) / 6.0
    weights = np.zeros(len(z))
    for k in range(0, len(z) - 1, order):
        weights[k : k + order + 1] += (z[k + order] - z[k]) * share
    forces = np.zeros_like(mesh.points)
    forces[edge] = (weights / weights.sum())[:, None] * (turn @ PULL)
    return forces


def whole(wheel):
    """Points, mm, and 27-node cells of the wheel, its hub's nodes, and those of the first tooth."""
    geometry = wheel.pair.geometry
    count = geometry.wheel_teeth
    fine, far = (tooth(wheel, counts, order=2, grading=GRADING) for counts in (FINE, FAR))
    points, cells, size = [], [], 0
    for k in range(count):
        one = fine if min(k, count - k) <= 1 else far
        points.append(one.points @ turned(2.0 * math.pi * k / count).T)
        cells.append(one.cells + size)
        size += len(one.points)
    every = np.concatenate(points)
    # Teeth share the nodes of their cuts.
    least = np.arange(size)
    pairs = cKDTree(every).query_pairs(1e-5, output_type="ndarray")
    np.minimum.at(least, pairs.max(axis=1), pairs.min(axis=1))
    kept, number = np.unique(least, return_inverse=True)
    every, cells = every[kept], number[np.concatenate(cells)]
    first = number[: len(fine.points)]
    inner = rim_radius(geometry)
    inside = np.flatnonzero(np.abs(np.hypot(*every[:, :2].T) - inner) < 1e-6)
    angle, z = np.arctan2(*every[inside, :2].T), np.round(every[inside, 2], 6)
    columns = np.unique(z)
    top = inside[np.lexsort((angle, z))].reshape(len(columns), -1).T
    # The edges of hexahedra that are nearest to the web's faces.
    ends = np.arange(0, len(columns) // 2, 2)
    start = ends[np.argmin(np.abs(columns[ends] + 0.5 * WEB.web_width))]
    top, at = (v[..., start : len(columns) - start] for v in (top, columns))
    radii = np.linspace(inner, WEB.hub_radius, 2 * LAYERS + 1)[1:, None, None]
    over = np.broadcast_to(0.5 * at * WEB.web_width / at[-1], (2 * LAYERS, 1, len(at))).copy()
    over[0] = 0.5 * (over[0] + at)
    made = np.stack(
        np.broadcast_arrays(radii * np.sin(a := np.arctan2(*every[top, :2].transpose(2, 0, 1))),
                            radii * np.cos(a), over), axis=-1,
    )  # fmt: skip
    numbers = len(every) + np.arange(made[..., 0].size).reshape(made.shape[:3])
    grid = np.concatenate([top[None], numbers])[::-1].transpose(1, 0, 2)
    web, _ = _cells(np.concatenate([grid, grid[:1]]), 2)
    every = np.concatenate([every, made.reshape(-1, 3)])
    return fine, every, np.concatenate([cells, web]), grid[:, 0].ravel(), first


def test_calculix_finds_the_same_stress_on_a_web(tmp_path):
    wheel = right_handed(wheel_of(problem()))
    own = RootModel(wheel, problem().gearset.wheel_material, FINE)
    fine, points, cells, hub, first = whole(wheel)
    forces = np.zeros_like(points)
    forces[first] = pulled(fine, "flank_plus")
    moved, _ = solved(tmp_path, points, cells, hub, forces, own.material)

    turn = own._turn(1)
    one = tooth(wheel, LINEAR)
    surface = contact_surface(one, "flank_plus")
    rim = MovingRim.of(one, surface, WEB, wheel.pair.geometry, own.material)
    on_flank = pulled(one, "flank_plus")[surface.nodes]
    nodal = pulled(own.mesh, "flank_plus_1", turn).reshape(-1, 1)
    held = own.on_web(rim, on_flank[None]).reshape(-1, 1)
    found, still = own.solve(nodal, held), own.solve(nodal)

    away, at = cKDTree(points).query(1e3 * own.mesh.points @ turn)
    assert away.max() < 1e-4
    theirs = 1e-3 * moved[at] @ turn.T
    known = np.isfinite(theirs[:, 0])
    tied = own.body.tied[known[own.body.tied]]
    gives = held.reshape(-1, 3)
    assert np.abs(gives - theirs)[tied].max() < 0.02 * np.abs(theirs[tied]).max()
    # Both of what the fillet's surface is strained by: CalculiX carries its own on to the nodes
    # otherwise, which on so coarse a mesh is a quarter more.
    stress, _ = own.stress(own.fillets[0], theirs.reshape(-1, 1))
    asked = Roots((stress, stress), (stress, stress)).principal(0)[..., 2].max()
    assert found.principal(0)[..., 2].max() == pytest.approx(asked, rel=0.02)
    assert still.principal(0)[..., 2].max() < 0.95 * asked
