"""Refined elastic bodies shared by the tests that hold contact to closed forms."""

import functools

import numpy as np
import pytest
from apparatus.halfspace import half_space
from apparatus.meshes import merged

from asperity.contact.elastic import ElasticMaterial, elastic_body
from asperity.contact.elastic.solver import factorise
from asperity.contact.interface.surface import contact_surface
from asperity.mesh import HexMesh, box

# Factors by which shells about the patch grow: in the end the body is a thousand patches large.
SHELLS = {
    "hex27": (*[1.5] * 4, *[2.0] * 3, *[3.0] * 3),
    "hex8i": (*[1.1] * 8, *[1.2] * 6, *[1.4] * 5, *[1.7] * 5, *[2.0] * 5),
}


class QuarterPatch:
    """A quarter of a large elastic body that is fine where it may be touched.

    A cube of ``count`` elements along each edge has its corner at the origin, its bottom (z = 0)
    may be touched; homothetic shells about it end at a surface that is tied. The planes x = 0 and
    y = 0 are those of the symmetry of the loads. With a thickness the body is a slab in plane
    strain, one element thick.

    The stiffness and its factorisation are those of the package's elastic bodies; what is done
    here is to hold the planes of symmetry, which a tied body of the package does not know.
    """

    def __init__(self, element, count, half_width, material, thickness=None):
        self.element = element
        self.flat = thickness is not None
        self.mesh = _mesh(element, count, half_width, thickness)
        self.body = elastic_body(self.mesh, material, element=element, tied="far")
        self.surface = contact_surface(self.mesh, "patch")

    @functools.cached_property
    def _symmetric(self):
        return self._held({"x": [0], "y": [1]})

    @functools.cached_property
    def _antisymmetric(self):
        return self._held({"x": [1, 2], "y": [1]})

    def _held(self, axes):
        held = [3 * self.mesh.node_set(name) + axis for name in axes for axis in axes[name]]
        moving = np.setdiff1d(self.body.moving, np.concatenate(held))
        return moving, factorise(self.body.stiffness[moving][:, moving])

    def _response(self, system, freedoms):
        moving, factors = system
        place = np.minimum(np.searchsorted(moving, freedoms), len(moving) - 1)
        free = moving[place] == freedoms
        forces = np.zeros((len(moving), int(free.sum())))
        forces[place[free], np.arange(free.sum())] = 1.0
        answer = np.zeros((3 * len(self.mesh.points), len(freedoms)))
        answer[np.ix_(moving, free)] = factors.solve(forces)
        return answer

    @functools.cached_property
    def _freedoms(self):
        return (3 * self.surface.nodes[:, None] + np.arange(3)).ravel()

    @functools.cached_property
    def _under_normal_loads(self):
        return self._response(self._symmetric, self._freedoms)

    @functools.cached_property
    def flexibility(self):
        """Of the patch's nodes, under loads symmetric about both planes."""
        return self._under_normal_loads[self._freedoms]

    def flexibility_of_pair(self):
        """Of the motion of two such bodies apart, mirror images of each other.

        Normal loads are symmetric about both planes, tangential loads along x about y = 0 alone.
        Of the two bodies' coupling between both kinds nothing is left.
        """
        normal = self.flexibility.reshape(len(self.surface.nodes), 3, -1, 3)
        rubbed = self._response(self._antisymmetric, self._freedoms)[self._freedoms]
        both = rubbed.reshape(normal.shape).copy()
        both[:, 2] = both[:, :, :, 2] = 0.0
        both[:, 2, :, 2] = normal[:, 2, :, 2]
        return 2.0 * both.reshape(self.flexibility.shape)

    def sunk(self, depth, force):
        """Depth of the node on the axis nearest to ``depth``, and how far it is pushed, m."""
        x, y, z = self.mesh.points.T
        axis = np.flatnonzero((x == 0.0) & (y == 0.0))
        node = axis[np.abs(z[axis] - depth).argmin()]
        return z[node], float(self._under_normal_loads[3 * node + 2] @ force)


def _mesh(element, count, half_width, thickness):
    flat = thickness is not None
    size = np.cumprod([1.0, *SHELLS[element]])
    layers, across = len(size) - 1, 1 if flat else count
    elements = {
        "core": (count, across, count),
        "x": (layers, across, count),
        "y": (count, layers, count),
        "z": (count, across, layers),
    }
    parts = []
    for side in ("core", "x", "z") if flat else elements:
        cube = box((1.0, 1.0, 1.0), elements[side], 2 if element == "hex27" else 1)
        points = cube.points + np.array([0.5, 0.5, 0.0])
        if side != "core":
            axis = "xyz".index(side)
            grown = np.interp(points[:, axis] * layers, np.arange(layers + 1), size)
            points[:, axis] = 1.0
            points *= grown[:, None] ** ([1, 0, 1] if flat else [1, 1, 1])
        points[:, 1] *= thickness / half_width if flat else 1.0
        parts.append(HexMesh(half_width * points, cube.cells))
    whole = merged(parts)
    points = whole.points
    reach = (points[:, [0, 2]] if flat else points).max(axis=1)
    sides = np.isin(points[:, 1], [0.0, thickness]) if flat else points[:, 1] == 0.0
    nodes = {
        "far": reach > half_width * size[-1] * (1.0 - 1e-9),
        "x": points[:, 0] == 0.0,
        "y": sides,
    }
    skin = whole.skin_faces()
    middles = points[whole.face_nodes(skin)[:, :4]].mean(axis=1)
    touched = (middles[:, 2] == 0.0) & (middles[:, :2].max(axis=1) < half_width)
    if flat:
        touched = (middles[:, 2] == 0.0) & (middles[:, 0] < half_width)
    sets = {name: np.flatnonzero(chosen) for name, chosen in nodes.items()}
    return HexMesh(points, whole.cells, sets, {"patch": skin[touched]})


@pytest.fixture(scope="session")
def quarter_patch():
    """Return the function that makes a `QuarterPatch`, each one once; steel, m."""
    material = ElasticMaterial(210e9, 0.3, 7850.0)

    @functools.lru_cache(maxsize=3)
    def made(element, count, half_width, thickness=None):
        return QuarterPatch(element, count, half_width, material, thickness)

    return made


def _quarter_of_half_space(per_width, half_width, poissons_ratio, *, pair, crown=0.0):
    """A quarter of the surface of a half-space about the origin, for loads like `QuarterPatch`'s.

    Returns the surface, square, a little larger than ``half_width``, with ``per_width`` elements
    in that; its flexibility under a load and its images; and the size of an element. With a crown
    its points stand on a ball's paraboloid of that curvature, 1/m.
    """
    size = half_width / per_width
    count = int(np.ceil(1.12 * per_width))
    steps = np.arange(-count, count + 1)
    x, y = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
    whole = half_space(
        size * np.column_stack([x, y]), (size, size), 210e9, poissons_ratio, pair=pair
    ).reshape(len(x), 3, len(x), 3)
    mesh = box((count * size, count * size, size), (count, count, 1))
    points = mesh.points + 0.5 * count * size * np.array([1.0, 1.0, 0.0])
    points[:, 2] += 0.5 * crown * (points[:, 0] ** 2 + points[:, 1] ** 2)
    surface = contact_surface(HexMesh(points, mesh.cells, face_sets=mesh.face_sets), "bottom")
    at = np.rint(surface.positions[:, :2] / size).astype(int)

    def number(i, j):
        return (i + count) * (2 * count + 1) + j + count

    rows = number(*at.T)
    flexibility = np.zeros((len(at), 3, len(at), 3))
    for i in (1, -1):
        for j in (1, -1):
            columns = number(i * at[:, 0], j * at[:, 1])
            part = whole[rows][:, :, columns]
            # A load along y changes its sign at either plane, those along x and z at none.
            flexibility += part * np.array([1.0, i * j, 1.0])
    return surface, flexibility.reshape(3 * len(at), -1), size


@pytest.fixture(scope="session")
def quarter_of_half_space():
    """Return the function that makes a quarter of a half-space's surface, each one once."""
    return functools.lru_cache(maxsize=4)(_quarter_of_half_space)
