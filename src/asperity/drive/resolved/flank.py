"""The wheel's exact flank beside the nodes of its condensed tooth: places, normals, smooth give.

Lengths are in m, in the frame of a tooth that stands about +Y (`asperity.drive.teeth.placing`).
"""

from __future__ import annotations

import dataclasses
import functools
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy import sparse

from asperity.arrays import FloatArray, IntArray
from asperity.drive.resolved.smooth import smoothed
from asperity.drive.teeth.sector import Sector, lattice
from asperity.drive.teeth.threads import thread_flexibility
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import FlankGrid
from asperity.gearset.materials import Material

if TYPE_CHECKING:
    from scipy.interpolate import CubicSpline, RectBivariateSpline

_MILLIMETRES = 1e3
_ROWS, _COLUMNS = 41, 61
_LIMITS = 401
# Of an edge, in axial modules: as the usual rounding of a worm's tip.
_EDGE = 0.05
# Total degree of the polynomial that the flank is fitted with in the frame of a strip, points for
# the square of it, and how far about the strip they are taken: in its extent and that of the grid.
# The exact points lie on it to a nanometre.
_DEGREE, _POINTS = 10, 1.6
_ABOUT, _BESIDE = 0.15, 2.5
_RIDGE = 1e-14


@dataclasses.dataclass(frozen=True, eq=False)
class ExactFlank:
    """The flank of one tooth, with the smooth part of what a condensed tooth gives.

    The smooth part is the condensed tooth's flexibility less that of a half-space of its own
    material, at the nodes and along their normals: the half-space is the patches' own.
    """

    sector: Sector
    #: (1 + b, n, n): Inward motion of the nodes under forces along the normals on the same tooth,
    #: less that of a half-space, and on one 1 .. b pitches before it, m/N
    smooth: FloatArray
    #: (k,): Depth worn off at the points of `grid`, m; None: new
    worn: FloatArray | None = None

    @classmethod
    def of(cls, sector: Sector, wheel: Material, flexibility: FloatArray) -> ExactFlank:
        """Return the flank of a sector whose teeth's own flexibility, (3n, 3n), is given, m/N."""
        surface = sector.surface
        space = thread_flexibility(surface, wheel.youngs_modulus, wheel.poisson_ratio)
        normals = surface.nodal_normals
        blocks = (flexibility - space, *sector.neighbours)
        count = len(normals)
        smooth = [
            np.einsum("ic,icjd,jd->ij", normals, block.reshape(count, 3, count, 3), normals)
            for block in blocks
        ]
        smooth[0] = smoothed(smooth[0], lattice(surface))
        return cls(sector, np.array(smooth))

    @cached_property
    def grid(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Exact points (k, 3), their normals, shares of the flank's height, and face places."""
        return grid_of(self.sector.wheel)

    @cached_property
    def on_grid(self) -> sparse.csr_array:
        """What makes values at the points of `grid` of values at the nodes."""
        _, _, share, z = self.grid
        return self.interpolation(share, z)

    @property
    def nodes(self) -> int:
        """Number of points of `grid`."""
        return len(self.grid[0])

    @property
    def faces(self) -> IntArray:
        """Faces between the points of `grid`, (m, 4)."""
        return grid_faces()

    @property
    def rows(self) -> int:
        """Rows of points of `grid` over the flank's height."""
        return _ROWS

    def nearest(self, share: FloatArray, z: FloatArray) -> IntArray:
        """Return the number of the nearest point of `grid` to places on the flank."""
        columns = self.grid[3][: self.nodes // _ROWS]
        middles = 0.5 * (columns[1:] + columns[:-1])
        row = np.clip(np.rint(share * (_ROWS - 1)), 0, _ROWS - 1).astype(np.int64)
        return row * len(columns) + np.searchsorted(middles, z)

    @cached_property
    def half_face(self) -> float:
        """Half the face width, m."""
        return 0.5 * self.sector.wheel.blank.face_width / _MILLIMETRES

    @property
    def edge(self) -> float:
        """How far from an edge of the worm or wheel what bears counts as borne by the edge, m."""
        return _EDGE * self.sector.wheel.pair.geometry.axial_module / _MILLIMETRES

    @cached_property
    def height(self) -> float:
        """Of the flank in mid-face, from the fillet to the tip, m."""
        start, stop = self.sector.wheel.flank(1).limits([0.0])
        return float(stop[0] - start[0]) / _MILLIMETRES

    @property
    def least_reach(self) -> float:
        """How far apart the points of the grid are, m."""
        return 2.0 * self.half_face / (_COLUMNS - 1)

    @cached_property
    def _limits(self) -> tuple[FloatArray, FloatArray]:
        half = _MILLIMETRES * self.half_face
        z = np.linspace(-half, half, _LIMITS)
        start, _ = self.sector.wheel.flank(1).limits(z)
        return z / _MILLIMETRES, start / _MILLIMETRES

    def share_at(self, points: FloatArray) -> FloatArray:
        """Return the share of the flank's height of points on it, (k, 3): 0 fillet, 1 tip."""
        z = np.clip(points[:, 2], -self.half_face, self.half_face)
        start = np.interp(z, *self._limits)
        stop = self.sector.wheel.blank.tip_radius(_MILLIMETRES * z) / _MILLIMETRES
        radius = np.hypot(points[:, 0], points[:, 1])
        return np.asarray((radius - start) / (stop - start))

    @cached_property
    def _lattice(self) -> tuple[IntArray, FloatArray, FloatArray]:
        """Nodes by row and column, the rows' shares and the columns' places."""
        nodes = lattice(self.sector.surface)
        z = self.sector.surface.positions[nodes[0], 2]
        return nodes, np.linspace(0.0, 1.0, len(nodes)), z

    def interpolation(self, share: FloatArray, z: FloatArray) -> sparse.csr_array:
        """Return what makes values at points of values at the nodes, smooth over the elements.

        Rows are of equal share, along which the radius has a kink where the throat ends. To give
        what the teeth give the shape that a depth worn off has there (`_bends`) moves it by 0.02 um
        for a force of 1 kN beside it, of which a coarse mesh is off by 0.06 um, and comes no nearer
        to a fine mesh: at a free edge a tooth gives by how far one is from the edge, as shares are.
        Peaks would move by less than 1 %, by 3 % where the wheel's tip edge hardly begins to bear.
        """
        nodes, shares, places = self._lattice
        row, row_weight = hermite(shares, share)
        column, column_weight = hermite(places, z)
        count = len(share)
        values = np.einsum("ka,kb->kab", row_weight, column_weight).reshape(count, -1)
        columns = nodes[row[:, :, None], column[:, None, :]].reshape(count, -1)
        starts = np.arange(count + 1) * values.shape[1]
        shape = count, len(self.sector.surface.positions)
        return sparse.csr_array((values.ravel(), columns.ravel(), starts), shape=shape)

    @cached_property
    def _worn_at(self) -> RectBivariateSpline | None:
        from scipy.interpolate import RectBivariateSpline

        if self.worn is None:
            return None
        _, _, share, z = self.grid
        rows = share.reshape(_ROWS, -1)[:, 0], z.reshape(_ROWS, -1)[0]
        # Smooth: a kink in the gap would bear.
        return RectBivariateSpline(*rows, self.worn.reshape(_ROWS, -1))

    @cached_property
    def _bends(self) -> list[tuple[float, float, CubicSpline, CubicSpline]]:
        """Where rows of equal share have a kink: place, slope, depth by share, and its shape.

        The tip's radius has a slope on the throat and none beside it, so that at an equal share
        the slope of a depth that is smooth on the flank jumps. The spline through |z - place|/2
        has no jump: what it lacks is the shape.
        """
        from scipy.interpolate import CubicSpline

        blank = self.sector.wheel.blank
        if self.worn is None or blank.kink is None:
            return []
        shares = self.grid[2].reshape(_ROWS, -1)[:, 0]
        z, depth = self.grid[3][:_COLUMNS], self.worn.reshape(_ROWS, -1)
        found = []
        for kink in (-blank.kink, blank.kink):
            place = kink / _MILLIMETRES
            column = int(np.argmin(np.abs(z - place)))
            start = float(np.interp(place, *self._limits))
            height = blank.outside_radius / _MILLIMETRES - start
            turn = -blank.kink / (blank.centre_distance - blank.outside_radius) / height
            slope = CubicSpline(shares, depth[:, column]).derivative()
            found.append((place, turn, slope, CubicSpline(z, 0.5 * np.abs(z - place))))
        return found

    def depth_at(self, share: FloatArray, z: FloatArray) -> FloatArray:
        """Return the depth worn off at places on the flank, m."""
        if self._worn_at is None:
            return np.zeros(len(share))
        share, z = np.clip(share, 0.0, 1.0), np.clip(z, -self.half_face, self.half_face)
        depth = np.asarray(self._worn_at.ev(share, z))
        # So much that the slope at an equal radius does not jump, whatever has worn.
        for place, turn, slope, even in self._bends:
            depth += turn * share * slope(share) * (0.5 * np.abs(z - place) - even(z))
        return depth

    def heights(
        self, origin: FloatArray, axes: FloatArray, x: FloatArray, y: FloatArray
    ) -> Heights:
        """Return the flank's heights over a grid in a plane, by a polynomial through its points.

        Parameters
        ----------
        origin : ndarray, shape (3,)
            Of the plane, m.
        axes : ndarray, shape (3, 3)
            Unit vectors along x, y and the plane's normal as rows.
        x, y : ndarray
            Places of the grid along its axes, m.
        """
        places = (self.grid[0] - origin) @ axes.T
        ends = np.array([[x[0], x[-1]], [y[0], y[-1]]])
        about = _ABOUT * np.ptp(ends, axis=1) + _BESIDE * self.least_reach
        near = (
            np.abs(places[:, :2] - ends.mean(axis=1)) <= 0.5 * np.ptp(ends, axis=1) + about
        ).all(axis=1)
        # Of the flank's other parts a plane may see the back.
        places = places[near & (self.grid[1] @ axes[2] > 0.0)]
        degree = min(_DEGREE, int(np.sqrt(len(places) / _POINTS)))
        middle = ends.mean(axis=1)
        reach = 0.5 * np.ptp(ends, axis=1) + about

        def powers(at: FloatArray, axis: int) -> tuple[FloatArray, FloatArray]:
            u = (at - middle[axis]) / reach[axis]
            values = np.polynomial.chebyshev.chebvander(u, degree)
            slopes = np.einsum("ki,ij->kj", values, _derivative(degree)) / reach[axis]
            return values, slopes

        one, _ = powers(places[:, 0], 0)
        other, _ = powers(places[:, 1], 1)
        pairs = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
        first, second = np.array(pairs).T
        basis = one[:, first] * other[:, second]
        # Small, and by hand: threads of BLAS cost more than they save on it.
        square = np.einsum("ki,kj->ij", basis, basis)
        square[np.diag_indices_from(square)] += _RIDGE * len(basis)
        found = np.linalg.solve(square, np.einsum("ki,k->i", basis, places[:, 2]))
        off = float(np.abs(basis @ found - places[:, 2]).max())
        matrix = np.zeros((degree + 1, degree + 1))
        matrix[first, second] = found
        (px, dx), (py, dy) = powers(x, 0), powers(y, 1)
        return Heights(px @ matrix @ py.T, dx @ matrix @ py.T, px @ matrix @ dy.T, off)


def grid_of(wheel: Wheel) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return exact points of a wheel's flank, as `ExactFlank.grid`."""
    made = exact_grid(wheel)
    share = np.repeat(np.linspace(0.0, 1.0, _ROWS), _COLUMNS)
    return (
        made.points.reshape(-1, 3) / _MILLIMETRES,
        made.normals.reshape(-1, 3),
        share,
        made.z.reshape(-1) / _MILLIMETRES,
    )


def exact_grid(wheel: Wheel) -> FlankGrid:
    """Return the exact flank at the points of `grid_of`, mm."""
    return wheel.flank(1).at_shares(np.linspace(0.0, 1.0, _ROWS), wheel.blank.columns(_COLUMNS))


def grid_faces() -> IntArray:
    """Return the faces between the points of `grid_of`, (m, 4)."""
    at = np.arange(_ROWS * _COLUMNS).reshape(_ROWS, -1)
    corners = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    return np.stack([corner.ravel() for corner in corners], axis=1)


@functools.cache
def _derivative(degree: int) -> FloatArray:
    """Slopes of Chebyshev's polynomials in terms of themselves, one polynomial a column."""
    found = np.zeros((degree + 1, degree + 1))
    for k in range(1, degree + 1):
        found[:degree, k] = np.polynomial.chebyshev.chebder(np.eye(degree + 1)[k])
    return found


@dataclasses.dataclass(frozen=True, eq=False)
class Heights:
    """The flank over a plane."""

    height: FloatArray  #: (nx, ny): m
    slope_x: FloatArray
    slope_y: FloatArray
    off: float  #: By which the exact points lie off the polynomial, m


def hermite(knots: FloatArray, at: FloatArray) -> tuple[IntArray, FloatArray]:
    """Return which four knots a smooth interpolation takes at places, (k, 4), and their weights.

    A cubic between two knots, its slopes at them those of parabolas through three; beyond the ends
    the values at the ends.
    """
    last = len(knots) - 2
    x = np.clip(at, knots[0], knots[-1])
    k = np.clip(np.searchsorted(knots, x, side="right") - 1, 0, last)
    step = knots[k + 1] - knots[k]
    t = (x - knots[k]) / step
    h00, h10 = (1.0 + 2.0 * t) * (1.0 - t) ** 2, t * (1.0 - t) ** 2 * step
    h01, h11 = t**2 * (3.0 - 2.0 * t), t**2 * (t - 1.0) * step
    slopes = _slopes(knots)
    index = np.clip(k[:, None] + np.arange(-1, 3), 0, len(knots) - 1)
    weights = np.zeros((len(x), 4))
    weights[:, 1] += h00
    weights[:, 2] += h01
    for end, share in ((0, h10), (1, h11)):
        for offset in range(3):
            # Knots that the slope at this end is of, as the four count.
            first = np.clip(k + end - 1, 0, len(knots) - 3)
            place = first + offset - (k - 1)
            weights[np.arange(len(x)), np.clip(place, 0, 3)] += share * slopes[k + end, offset]
    return index, weights


def _slopes(knots: FloatArray) -> FloatArray:
    """Weights of three knots in the slope of the parabola through them at each knot, (n, 3)."""
    count = len(knots)
    found = np.empty((count, 3))
    for k in range(count):
        first = min(max(k - 1, 0), count - 3)
        a, b, c = knots[first : first + 3]
        x = knots[k]
        found[k] = (
            (2.0 * x - b - c) / ((a - b) * (a - c)),
            (2.0 * x - a - c) / ((b - a) * (b - c)),
            (2.0 * x - a - b) / ((c - a) * (c - b)),
        )
    return found
