"""Wheel teeth in quadratic tetrahedra of their own, fine at one fillet, by scikit-fem.

A section is filled with triangles of Delaunay about points whose distance grows with that from the
fillet; all sections are the middle one's triangles, moved to their own outline by Laplace's
equation. Prisms between sections are cut into three tetrahedra each, the nodes in the middle of
edges on the exact surfaces. Lengths in m, stresses in Pa.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import skfem
from scipy import sparse
from scipy.sparse.linalg import splu
from scipy.spatial import Delaunay, cKDTree
from skfem.models.elasticity import linear_elasticity
from skfem.models.poisson import laplace

from asperity.flanks.wheel.enveloped import Wheel

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

# Shares of a flank's height at which nodes lie: closer towards its foot.
_FLANK = np.linspace(0.0, 1.0, 12) ** 1.8
_FREE = np.linspace(0.0, 1.0, 7) ** 1.5
_GROWING, _LARGEST = 0.35, 1.4  # of a triangle's size with the distance, and at most, mm
_FINE_ROOT, _ROOT, _ARC, _TIP, _CUT, _UNDER = 6, 2, 5, 3, 7, 4
_SMOOTHING = 25


def _outline(wheel: Wheel, side: int, z: FloatArray, root: int, arc: int) -> FloatArray:
    """Root, fillet and flank of a side by section, polar, with points between nodes, (n, z, 2)."""
    flank = wheel.flank(side)
    nodes = _FLANK if side > 0 else _FREE
    shares = np.sort(np.concatenate([nodes, 0.5 * (nodes[1:] + nodes[:-1])]))
    parts = flank.root(2 * root + 1, z), flank.fillet(2 * arc + 1, z), flank.at_shares(shares, z)
    rows = [np.stack([part.radius, part.angle], axis=-1) for part in parts]
    return np.concatenate([rows[0], rows[1][1:], rows[2][1:]])


# What acts on the loaded flank of a tooth, (3, ...), Pa, at shares of its height and places z.
Traction = Callable[[int, FloatArray, FloatArray], FloatArray]

_SIDES = (0, 1), (1, 2), (0, 2)


@dataclasses.dataclass(frozen=True)
class FineTeeth:
    """Teeth on a rim whose inside is held; the middle one's loaded fillet is fine."""

    mesh: skfem.MeshTet2
    fillet: IntArray  #: Vertices of the fine fillet and its root
    #: By tooth: vertices of the loaded flank by share and place over the face
    flanks: list[IntArray]
    shares: FloatArray  #: Of the flank's height, by its vertices' rows
    z: FloatArray  #: (sections,): m

    @classmethod
    def of(cls, wheel: Wheel, teeth: int, arc: int, sections: int) -> FineTeeth:
        """Mesh them, with so many elements along the fine fillet, and sections over the face."""
        geometry = wheel.pair.geometry
        pitch = 2.0 * np.pi / geometry.wheel_teeth
        z = wheel.blank.columns(sections)
        levels = np.sort(np.concatenate([z, 0.5 * (z[1:] + z[:-1])]))
        inner = geometry.wheel_root_diameter / 2.0 - geometry.rim_thickness
        loop: list[FloatArray] = []  # Points round the section by level, with those between nodes
        marks: dict[int, list[int]] = {}
        at = 0

        def add(points: FloatArray, name: int | None = None) -> None:
            nonlocal at
            loop.append(points)
            if name is not None:
                marks[name] = list(range(at, at + len(points)))
            at += len(points)

        for tooth in range(teeth):
            turn = np.array([0.0, (tooth - teeth // 2) * pitch])
            fine = (_FINE_ROOT, arc) if tooth == teeth // 2 else (_ROOT, _ARC)
            low = _outline(wheel, -1, levels, _ROOT, _ARC) + turn
            high = _outline(wheel, 1, levels, *fine) + turn
            add(low[1 if tooth else 0 :])
            tip = np.linspace(0.0, 1.0, 2 * _TIP + 1)[1:-1, None, None]
            add(low[-1] + tip * (high[-1] - low[-1]))
            add(high[::-1], tooth)
        first, last = loop[0][0], loop[-1][-1]
        end = np.stack([np.full_like(last[:, 0], inner), last[:, 1]], axis=-1)
        start = np.stack([np.full_like(first[:, 0], inner), first[:, 1]], axis=-1)
        # From the root inwards, and back.
        way = (np.linspace(0.0, 1.0, 2 * _CUT + 1) ** 1.8)[:, None, None]
        add((last + way * (end - last))[1:])
        under = np.linspace(0.0, 1.0, 2 * _UNDER * teeth + 1)[1:, None, None]
        add(end + under * (start - end))
        add((first + way * (start - first))[-2:0:-1])
        around = np.concatenate(loop)
        # Where the middle of the face is widest apart from the ends is the section to fill.
        middle = len(levels) // 2
        polygon = _plane(around[:, middle])
        fillet = np.array(marks[teeth // 2])[2 * (len(_FLANK) - 1) :][: 2 * arc + 1]
        size = 1.0 * np.linalg.norm(np.diff(polygon[fillet[::2]], axis=0), axis=1).mean()
        points, triangles = _filled(polygon[::2], polygon[fillet], size)
        flat = skfem.MeshTri(np.ascontiguousarray(points.T), np.ascontiguousarray(triangles.T))
        sites = _moved(flat, around, middle)
        return cls._stacked(flat, sites, levels, marks, teeth)

    @classmethod
    def _stacked(
        cls,
        flat: skfem.MeshTri,
        sites: FloatArray,
        levels: FloatArray,
        marks: dict[int, list[int]],
        teeth: int,
    ) -> FineTeeth:
        """Return the tetrahedra over sections whose nodes are at sites, (levels, nodes, 2), mm."""
        count, layers = flat.p.shape[1], len(levels) // 2
        a, b, c = np.sort(flat.t, axis=0)
        cells = []
        for n in range(layers):
            low, up = n * count, (n + 1) * count
            cells += [
                np.stack([a + low, b + low, c + low, c + up]),
                np.stack([a + low, b + low, b + up, c + up]),
                np.stack([a + low, a + up, b + up, c + up]),
            ]
        space = np.concatenate(
            [sites, np.broadcast_to(levels[:, None, None], (*sites.shape[:2], 1))], 2
        )
        space[..., :2] = _plane(space[..., :2])
        space *= 1e-3
        corners = space[::2, :count].reshape(-1, 3)
        straight = skfem.MeshTet(np.ascontiguousarray(corners.T), np.concatenate(cells, axis=1))
        mesh = skfem.MeshTet2.from_mesh(straight)
        dofs = skfem.Dofs(straight, skfem.ElementTetP2())
        level, plane = np.divmod(straight.edges, count)
        between = {tuple(edge): count + k for k, edge in enumerate(np.sort(flat.facets, axis=0).T)}
        own = [i if i == j else between[min(i, j), max(i, j)] for i, j in plane.T]
        places = mesh.doflocs.copy()
        places[:, dofs.edge_dofs[0]] = space[level.sum(axis=0), own].T
        mesh = dataclasses.replace(mesh, doflocs=places)

        def column(ring: list[int]) -> IntArray:
            return np.array(ring)[None, :] // 2 + count * np.arange(layers + 1)[:, None]

        high = [[k for k in marks[tooth] if k % 2 == 0] for tooth in range(teeth)]
        flanks = [column(ring[: len(_FLANK)]) for ring in high]
        fillet = column(high[teeth // 2][len(_FLANK) - 1 :]).ravel()
        return cls(mesh, fillet, flanks, _FLANK[::-1], 1e-3 * levels[::2])

    def solve(
        self, youngs_modulus: float, poissons_ratio: float, loads: list[Traction]
    ) -> tuple[FloatArray, FloatArray]:
        """Return forces, (loads, teeth, 3), and principal stresses at the fillet, (loads, f, 3).

        In N, and in Pa, rising.
        """
        lame = (
            youngs_modulus * poissons_ratio / (1 + poissons_ratio) / (1 - 2 * poissons_ratio),
            0.5 * youngs_modulus / (1 + poissons_ratio),
        )
        element = skfem.ElementVector(skfem.ElementTetP2())
        basis = skfem.Basis(self.mesh, element, intorder=3)
        stiffness = skfem.asm(linear_elasticity(*lame), basis).tocsc()
        work = np.zeros((basis.N, len(loads)))
        forces = np.zeros((len(loads), len(self.flanks), 3))
        scalar = skfem.Dofs(self.mesh, skfem.ElementTetP2())
        of = np.empty((self.mesh.doflocs.shape[1], 3), dtype=np.int64)
        of[scalar.nodal_dofs[0]], of[scalar.edge_dofs[0]] = basis.nodal_dofs.T, basis.edge_dofs.T
        edges = {tuple(e): k for e, k in zip(self.mesh.edges.T, scalar.edge_dofs[0], strict=True)}
        (x, y), weights = skfem.quadrature.get_quadrature(skfem.refdom.RefTri, 8)
        corner = np.stack([1.0 - x - y, x, y])
        slopes = np.array([[-1.0, 1.0, 0.0], [-1.0, 0.0, 1.0]])[:, :, None]
        middles = [4.0 * corner[a] * corner[b] for a, b in _SIDES]
        shapes = np.concatenate([corner * (2.0 * corner - 1.0), middles])
        steep = [4.0 * (slopes[:, a] * corner[b] + slopes[:, b] * corner[a]) for a, b in _SIDES]
        turns = np.concatenate([slopes * (4.0 * corner - 1.0), np.stack(steep, axis=1)], axis=1)
        for tooth, vertices in enumerate(self.flanks):
            share = np.full(self.mesh.nvertices, np.nan)
            share[vertices] = self.shares
            faces = self.mesh.facets[:, np.isfinite(share[self.mesh.facets]).all(axis=0)]
            mids = [[edges[tuple(sorted(pair))] for pair in faces[list(side)].T] for side in _SIDES]
            nodes = np.concatenate([faces, mids])
            places = self.mesh.doflocs[:, nodes]
            at = np.einsum("aq,ak->kq", corner, share[faces])
            z = np.einsum("aq,ak->kq", shapes, places[2])
            one, other = np.einsum("daq,cak->dkqc", turns, places)
            area = np.linalg.norm(np.cross(one, other), axis=-1) * weights
            for k, load in enumerate(loads):
                given = np.einsum("ckq,kq,aq->akc", load(tooth, at, z), area, shapes)
                forces[k, tooth] = given.sum(axis=(0, 1))
                np.add.at(work[:, k], of[nodes], given)
        radius = np.hypot(*basis.doflocs[:2])
        free = np.flatnonzero(radius > radius.min() * (1.0 + 1e-4))
        moved = np.zeros_like(work)
        halves = _linear(basis, of, scalar, edges)[free]
        moved[free] = _solved(stiffness[free][:, free].tocsr(), work[free], halves)
        return forces, np.array([self._at_fillet(u, lame, basis) for u in moved.T])

    def _at_fillet(
        self, moved: FloatArray, lame: tuple[float, float], basis: skfem.Basis
    ) -> FloatArray:
        """Principal stresses at the fillet's vertices: means of the elements about them."""
        wanted = np.zeros(self.mesh.p.shape[1], dtype=bool)
        wanted[self.fillet] = True
        cells = np.flatnonzero(wanted[self.mesh.t].any(axis=0))
        corners = np.array([[0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], dtype=float)
        near = skfem.Basis(
            self.mesh, basis.elem, elements=cells, quadrature=(corners, np.full(4, 1.0 / 24.0))
        )
        slope = near.interpolate(moved).grad
        strain = 0.5 * (slope + slope.swapaxes(0, 1))
        stress = 2.0 * lame[1] * strain + lame[0] * np.trace(strain) * np.eye(3)[:, :, None, None]
        weight = near.dx.sum(axis=1)
        total = np.zeros((self.mesh.p.shape[1], 3, 3))
        sums = np.zeros(self.mesh.p.shape[1])
        for k in range(4):
            np.add.at(total, self.mesh.t[k, cells], (stress[..., k] * weight).transpose(2, 0, 1))
            np.add.at(sums, self.mesh.t[k, cells], weight)
        return np.linalg.eigvalsh(total[self.fillet] / sums[self.fillet, None, None])


def _linear(basis: skfem.Basis, of: IntArray, scalar: skfem.Dofs, edges: dict) -> sparse.csr_array:
    """Return what carries freedoms of the vertices to all: half to the middle of each edge."""
    corners = scalar.nodal_dofs[0]
    count = 3 * len(corners)
    own = np.arange(count).reshape(-1, 3)
    pairs = np.array(list(edges))
    middles = of[list(edges.values())]
    rows = np.concatenate([of[corners].ravel(), middles.ravel(), middles.ravel()])
    columns = np.concatenate([own.ravel(), own[pairs[:, 0]].ravel(), own[pairs[:, 1]].ravel()])
    values = np.concatenate([np.ones(count), np.full(2 * middles.size, 0.5)])
    return sparse.csr_array((values, (rows, columns)), shape=(basis.N, count))


def _solved(
    matrix: sparse.csr_array, right: FloatArray, linear: sparse.csr_array, close: float = 1e-8
) -> FloatArray:
    """Solve by conjugate gradients on two levels: a polynomial of the matrix, linear elements.

    M. Adams et al.: Parallel multigrid smoothing: polynomial versus Gauss-Seidel. J. Comput. Phys.
    188 (2003) 593-610.
    """
    linear = linear[:, np.diff(linear.tocsc().indptr) > 0]
    # A vertex that is held has halves on the edges to it, which are none of its own.
    coarse = (linear.T @ matrix @ linear).tocsc()
    solver = splu(coarse, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    scale = 1.0 / matrix.diagonal()[:, None]
    guess = np.random.default_rng(0).standard_normal((len(right), 1))
    for _ in range(15):
        guess = scale * (matrix @ guess)
        largest = np.linalg.norm(guess)
        guess /= largest
    high, low = 1.1 * largest, largest / 15.0

    def smooth(b: FloatArray) -> FloatArray:
        """Return a polynomial of Chebyshev of the matrix, times b."""
        middle, half = 0.5 * (high + low), 0.5 * (high - low)
        sigma = middle / half
        rho, step = 1.0 / sigma, scale * b / middle
        x = step
        for _ in range(3):
            new = 1.0 / (2.0 * sigma - rho)
            step = new * rho * step + 2.0 * new / half * scale * (b - matrix @ x)
            rho, x = new, x + step
        return x

    def better(b: FloatArray) -> FloatArray:
        x = smooth(b)
        x = x + linear @ solver.solve(linear.T @ (b - matrix @ x))
        return x + smooth(b - matrix @ x)

    x, rest = np.zeros_like(right), right.copy()
    z = better(rest)
    way, energy = z, (rest * z).sum(axis=0)
    for _ in range(500):
        along = matrix @ way
        step = energy / (way * along).sum(axis=0)
        x, rest = x + step * way, rest - step * along
        if (np.linalg.norm(rest, axis=0) < close * np.linalg.norm(right, axis=0)).all():
            return x
        z = better(rest)
        new = (rest * z).sum(axis=0)
        way, energy = z + new / energy * way, new
    raise AssertionError("conjugate gradients did not converge")


def _plane(polar: FloatArray) -> FloatArray:
    radius, angle = polar[..., 0], polar[..., 1]
    return np.stack([radius * np.sin(angle), radius * np.cos(angle)], axis=-1)


def _filled(border: FloatArray, fillet: FloatArray, size: float) -> tuple[FloatArray, IntArray]:
    """Points and triangles of a polygon, its corners first."""
    from matplotlib.path import Path

    tree = cKDTree(fillet)
    edges = 0.5 * (border + np.roll(border, -1, axis=0))
    lengths = np.linalg.norm(border - np.roll(border, -1, axis=0), axis=1)
    sides = cKDTree(edges)

    def wanted(places: FloatArray) -> FloatArray:
        away, near = sides.query(places)
        grown = np.minimum(size + _GROWING * tree.query(places)[0], _LARGEST)
        return np.maximum(
            np.minimum(grown, lengths[near] + _GROWING * away), lengths[near] - 0.6 * away
        )

    def free(places: FloatArray) -> npt.NDArray[np.bool_]:
        """Outside of the circles over the sides, which so are sides of triangles."""
        way = np.linalg.norm(places[:, None] - edges, axis=2)
        return path.contains_points(places) & (way > 0.56 * lengths).all(axis=1)

    path = Path(border)
    rng = np.random.default_rng(0)
    low, high = border.min(axis=0), border.max(axis=0)
    kept: list[FloatArray] = []
    # Darts, the coarse region first: each keeps its distance from those before.
    for scale in (1.0, 0.5, 0.25, 0.12, 0.06):
        number = int(np.prod(high - low) / (scale * _LARGEST) ** 2 * 12)
        darts = low + (high - low) * rng.random((number, 2))
        h = wanted(darts)
        darts, h = (v[(h > 0.5 * scale * _LARGEST)] for v in (darts, h))
        darts, h = (v[good] for good in (free(darts),) for v in (darts, h))
        for place, reach in zip(darts, h, strict=True):
            if len(kept) and np.linalg.norm(np.array(kept) - place, axis=1).min() < 0.8 * reach:
                continue
            if np.linalg.norm(border - place, axis=1).min() < 0.6 * reach:
                continue
            kept.append(place)
    points = np.concatenate([border, np.array(kept)])
    for _ in range(_SMOOTHING):
        triangles = _inside(points, border, path)
        force = np.zeros_like(points)
        bars = np.unique(
            np.sort(
                np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [0, 2]]]),
                axis=1,
            ),
            axis=0,
        )
        way = points[bars[:, 1]] - points[bars[:, 0]]
        length = np.linalg.norm(way, axis=1)
        h = wanted(points[bars].mean(axis=1))
        scale = 1.15 * h * np.sqrt((length**2).sum() / (h**2).sum())
        push = np.maximum(scale - length, 0.0)[:, None] * way / length[:, None]
        np.add.at(force, bars[:, 1], push)
        np.add.at(force, bars[:, 0], -push)
        force[: len(border)] = 0.0
        new = points + 0.2 * force
        good = free(new)
        good[: len(border)] = False
        points[good] = new[good]
    return points, _inside(points, border, path)


def _inside(points: FloatArray, border: FloatArray, path) -> IntArray:
    triangles = Delaunay(points).simplices.astype(np.int64)
    middles = points[triangles].mean(axis=1)
    one, other = (points[triangles[:, k]] - points[triangles[:, 0]] for k in (1, 2))
    area = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0])
    # Corners in a row, on a straight side, are none.
    flat = area < 1e-6 * (one**2 + other**2).sum(axis=1)
    return triangles[path.contains_points(middles) & ~flat]


def _moved(flat: skfem.MeshTri, around: FloatArray, middle: int) -> FloatArray:
    """Polar places of the nodes of quadratic triangles at each level, (levels, nodes, 2), mm."""
    basis = skfem.Basis(flat, skfem.ElementTriP2())
    xy = np.concatenate([flat.p, flat.p[:, flat.facets].mean(axis=1)], axis=1).T
    polar = np.stack([np.hypot(*xy.T), np.arctan2(xy[:, 0], xy[:, 1])], axis=-1)
    count, ring = flat.p.shape[1], len(around) // 2
    between = {tuple(e): k for k, e in enumerate(np.sort(flat.facets, axis=0).T)}
    border = [(k, 2 * k) for k in range(ring)]
    for k in range(ring):
        pair = tuple(sorted((k, (k + 1) % ring)))
        assert pair in between, f"the side {pair} of the outline is no side of a triangle"
        border.append((count + between[pair], 2 * k + 1))
    nodes, marks = np.array(border).T
    number = np.concatenate([basis.nodal_dofs[0], basis.facet_dofs[0]])
    matrix = skfem.asm(laplace, basis).tocsc()
    found = np.empty((around.shape[1], len(polar), 2))
    free = np.setdiff1d(np.arange(basis.N), number[nodes])
    solver = splu(matrix[free][:, free].tocsc())
    for level in range(around.shape[1]):
        for axis in range(2):
            off = np.zeros(basis.N)
            off[number[nodes]] = around[marks, level, axis] - polar[nodes, axis]
            off[free] = solver.solve(-(matrix @ off)[free])
            found[level, :, axis] = polar[:, axis] + off[number]
    return found
