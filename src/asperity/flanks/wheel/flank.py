"""One side of the wheel's tooth: points of flank, fillet and root, each with its phase.

Lengths are in mm, angles in rad, in the frame of the right-handed gearset.
"""

import dataclasses
import functools

import numpy as np
import numpy.typing as npt

from asperity.arrays import BoolArray, FloatArray, IntArray
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.wheel.cutting import trim, trim_grid, undercut
from asperity.flanks.wheel.cutting.conjugate import conjugate_each
from asperity.flanks.wheel.refusal import refusal, widest_face
from asperity.flanks.worm.curve import Thread
from asperity.flanks.worm.distance import distances
from asperity.flanks.worm.setting import Pair, Stand
from asperity.gearset.wheel_blank import Blank
from asperity.kernels.compiled import Kernel
from asperity.results import Quantities, quantity

MAP = ("row", "column")
"""Dimensions of what lies over a flank: from the fillet to the tip, and across the face."""

RESOLVED = 1e-9
"""Differences of lengths smaller than this are rounding, mm: points are found to a tenth of it."""

GAUSS = 16
"""Points of Gauss's rule for areas."""

_TOLERANCE = 0.1 * RESOLVED


class FlankGrid(Quantities):
    """Points of the cut wheel, each with the phase at which the hob cuts it.

    All arrays have the shape of the grid: rows from the inside out, columns along the wheel's axis;
    points and normals one more axis of 3. The wheel is at the ``z_1/z_2``-fold of the hob's phase;
    ``u`` is the place on the hob's curve (0 to 1 flank, to 2 tip arc, to 3 land), ``psi`` the
    standing angle.
    """

    radius: FloatArray = quantity("", "mm", "distance from the wheel's axis", dims=MAP)
    z: FloatArray = quantity(
        "", "mm", "distance from mid-face along the wheel's axis", variable="face", dims=MAP
    )
    points: FloatArray = quantity(
        "", "mm", "point of the flank, in the wheel", variable="point", dims=(*MAP, "axis")
    )
    normals: FloatArray = quantity(
        "", "", "normal out of the tooth", variable="flank_normal", dims=(*MAP, "axis")
    )
    phase: FloatArray
    u: FloatArray
    psi: FloatArray

    @property
    def angle(self) -> FloatArray:
        """Angle about the wheel's axis from the middle of the tooth, positive towards +X."""
        return np.arctan2(self.points[..., 0], self.points[..., 1])


@dataclasses.dataclass(frozen=True, eq=False)
class UndercutMap:
    """The criterion of undercut over the part of the hob's flank that cuts the blank.

    All arrays have rows from the end of the hob's flank to the wheel's tip and columns along the
    wheel's axis: place ``u`` on the hob's curve, 1 at the end of the flank; where it cuts, mm; and
    ``regularity``, the area on the wheel for an area on the hob, along the normal. Where that is
    negative the hob undercuts.
    """

    u: FloatArray
    radius: FloatArray
    z: FloatArray
    regularity: FloatArray

    @property
    def undercut(self) -> bool:
        """Whether the sign changes."""
        return bool(np.any(self.regularity <= 0.0))


@dataclasses.dataclass(frozen=True, eq=False)
class WheelFlank:
    """One side :math:`s`, 1 or -1, of the wheel's tooth: flank, fillet and root."""

    pair: Pair
    side: int

    def __post_init__(self) -> None:
        if self.side not in (1, -1):
            raise InputError(f"side is {self.side}; it must be 1 or -1")

    @functools.cached_property
    def blank(self) -> Blank:
        """The blank that the flank is trimmed to."""
        return Blank.of(self.pair.geometry)

    @functools.cached_property
    def _hob(self) -> tuple[float, Thread, Stand]:
        return float(self.side), self.pair.hob.thread, self.pair.cut

    def tip_radius(self, z: npt.ArrayLike) -> FloatArray:
        """Return the radius of the blank at places ``z``, mm."""
        return self.blank.tip_radius(z)

    def _columns(self, count: int, z: npt.ArrayLike | None) -> tuple[FloatArray, FloatArray]:
        half = self.blank.face_width / 2.0
        if z is None:
            if count < 2:
                raise InputError(f"the columns are {count}; a grid needs at least 2")
            places = self.blank.columns(count)
        else:
            places = np.ascontiguousarray(z, dtype=np.float64).reshape(-1)
            # Written so that a NaN is refused as well.
            if not np.all(np.abs(places) <= half * (1.0 + 1e-12)):
                raise InputError(f"z must lie on the face, from {-half:.6g} to {half:.6g} mm")
        return places, self.tip_radius(places)

    def _refuse(self, status: IntArray, z: FloatArray) -> None:
        bad = np.flatnonzero(status != trim.REACHED)
        if bad.size:
            worst = bad[np.argmin(np.abs(z[bad]))]
            widest = widest_face(self._sound, self.blank.face_width / 2.0)
            raise InputError(refusal(self.pair, int(status[worst]), float(z[worst]), widest))

    def _sound(self, z: float) -> bool:
        places = np.array([-z, z])
        status = self._limits(places, self.tip_radius(places))[2]
        return bool(np.all(status == trim.REACHED))

    def _made(
        self, fill: Kernel, rows: FloatArray, places: FloatArray, *stop: FloatArray, count: int = 2
    ) -> list[FloatArray]:
        """What a kernel fills in by row and column, if the hob cuts all columns."""
        out = [np.empty((rows.size, places.size)) for _ in range(count)]
        status = np.empty(places.size, dtype=np.int64)
        fill(places, *stop, *self._hob, rows, *out, status)
        self._refuse(status, places)
        return out

    def _points(self, u: FloatArray, psi: FloatArray) -> FlankGrid:
        side, hob, cut = self._hob
        points, normals, phase = np.empty((*u.shape, 3)), np.empty((*u.shape, 3)), np.empty(u.shape)
        rows = points.reshape(-1, 3), normals.reshape(-1, 3), phase.reshape(-1)
        conjugate_each(u.reshape(-1), psi.reshape(-1), side, hob, cut, *rows)
        return FlankGrid(
            radius=np.hypot(points[..., 0], points[..., 1]),
            z=points[..., 2].copy(),
            points=points,
            normals=normals,
            phase=phase,
            u=u,
            psi=psi,
        )

    def grid(self, n_radial: int, n_face: int, z: npt.ArrayLike | None = None) -> FlankGrid:
        """Return a grid over the flank, from the end of the fillet to the tip.

        Rows are evenly spaced in radius on each column. The columns lie at ``z``, mm, or are so
        many with the blank's kinks among them.

        Raises
        ------
        InputError
            No flank there, with the cause.
        ConvergenceError
            A point was not found to 1e-10 mm.
        """
        if n_radial < 2:
            raise InputError(f"the rows are {n_radial}; a grid needs at least 2")
        return self.at_shares(np.linspace(0.0, 1.0, n_radial), self._columns(n_face, z)[0])

    def at_shares(self, share: npt.ArrayLike, z: npt.ArrayLike) -> FlankGrid:
        """Return the points at shares of the flank's height (0 start, 1 tip), by columns ``z``."""
        rows = np.ascontiguousarray(share, dtype=np.float64)
        if not np.all((rows >= 0.0) & (rows <= 1.0)):
            raise InputError("the shares of the flank's height must lie within 0 and 1")
        places, stop = self._columns(0, z)
        u, psi, radius = self._made(trim_grid.flank_grid, rows, places, stop, count=3)
        grid = self._points(u, psi)
        residual = max(np.abs(grid.radius - radius).max(), np.abs(grid.z - places).max())
        # Written so that a NaN is refused as well.
        if not residual <= _TOLERANCE:
            raise ConvergenceError(
                "the wheel's flank was not found at every point", reached={"residual_mm": residual}
            )
        return grid

    def fillet(self, n: int, z: npt.ArrayLike) -> FlankGrid:
        """Return ``n`` rows of the fillet from the root to the flank, by columns at ``z`` (mm).

        The last row is the first of `grid` on the same columns.
        """
        places, stop = self._columns(0, z)
        share = np.linspace(0.0, 1.0, n)
        return self._points(*self._made(trim_grid.fillet_grid, share, places, stop))

    def root(self, n: int, z: npt.ArrayLike) -> FlankGrid:
        """Return ``n`` rows of the root from the middle of the tooth space to the fillet."""
        places, _ = self._columns(0, z)
        return self._points(*self._made(trim_grid.root_grid, np.linspace(0.0, 1.0, n), places))

    def limits(self, z: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the radii where the flank begins and ends at places ``z``, mm."""
        places, stop = self._columns(0, z)
        start, _, status = self._limits(places, stop)
        self._refuse(status, places)
        return start, stop

    def undercut_at(self, z: npt.ArrayLike) -> BoolArray:
        """Return whether the hob undercuts at places ``z``."""
        places, stop = self._columns(0, z)
        return self._limits(places, stop)[1]

    def _limits(
        self, places: FloatArray, stop: FloatArray
    ) -> tuple[FloatArray, BoolArray, IntArray]:
        start = np.empty(places.size)
        cut_under = np.empty(places.size, dtype=np.bool_)
        status = np.empty(places.size, dtype=np.int64)
        trim_grid.limits_each(places, stop, *self._hob, start, cut_under, status)
        return start, cut_under, status

    def undercut_map(self, n_radial: int, n_face: int) -> UndercutMap:
        """Return the undercut criterion over all that the hob's flank cuts, trimmed or not."""
        places, stop = self._columns(n_face, None)
        share = np.linspace(0.0, 1.0, n_radial)
        u, radius, regularity = self._made(undercut.regularity_map, share, places, stop, count=3)
        return UndercutMap(u, radius, np.broadcast_to(places, u.shape), regularity)

    def at(self, radius: npt.ArrayLike, z: npt.ArrayLike) -> FlankGrid:
        """Return the points of flank or fillet at radii and places, broadcast, mm."""
        r, places = np.broadcast_arrays(
            np.asarray(radius, dtype=np.float64), np.asarray(z, dtype=np.float64)
        )
        flat, stop = self._columns(0, places)
        radii = r.reshape(-1)
        # Points of one column follow each other, so that each section is traced once.
        order = np.argsort(flat, kind="stable")
        u = np.empty(flat.size)
        psi = np.empty(flat.size)
        status = np.empty(flat.size, dtype=np.int64)
        trim_grid.locate_each(radii[order], flat[order], stop[order], *self._hob, u, psi, status)
        self._refuse(status, flat[order])
        lost = np.flatnonzero(u < 0.0)
        if lost.size:
            k = order[lost[0]]
            raise InputError(
                f"radius is {radii[k]:.6g} mm at z = {flat[k]:.6g} mm; flank and fillet lie inside "
                f"the blank's {stop[k]:.6g} mm and outside the root"
            )
        back = np.empty_like(order)
        back[order] = np.arange(order.size)
        return self._points(u[back].reshape(r.shape), psi[back].reshape(r.shape))

    def conjugacy_residual(self, grid: FlankGrid) -> FloatArray:
        """Return the distances of points to the hob at the phase at which it cuts them, mm.

        They are zero but for the rounding of floats and, for the flanks of grinding discs, for the
        table their profile is in. Shaped as the grid; negative inside the hob.
        """
        pair = self.pair
        angle = grid.phase / pair.ratio
        cosine, sine = np.cos(angle), np.sin(angle)
        x, y, z = np.moveaxis(grid.points, -1, 0)
        stood = np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)
        place = pair.cutting.to_helicoid(stood)
        # A turn of a helicoid is a shift along its axis.
        place[..., 2] += pair.hob.reduced_lead * grid.phase
        return distances(place, pair.hob, self.side)

    def area(self, points: int = GAUSS) -> float:
        r"""Return the area of the trimmed flank, mm^2.

        :math:`A = \int\int dR\,dZ/|n_\varphi|` by Gauss's rule of ``points`` in each direction,
        separately inside and outside the kinks of the blank.
        """
        knots, weights = np.polynomial.legendre.leggauss(points)
        z, weight = self.blank.quadrature(points)
        grid = self.at_shares(0.5 * (1.0 + knots), z)
        start, stop = self.limits(z)
        x, y = grid.points[..., 0], grid.points[..., 1]
        around = np.abs(grid.normals[..., 0] * y - grid.normals[..., 1] * x) / grid.radius
        inner = 0.5 * (stop - start) * np.sum(weights[:, None] / around, axis=0)
        return float(np.sum(weight * inner))
