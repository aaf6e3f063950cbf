r"""The enveloped worm wheel: flanks, fillets and roots exactly as a hob leaves them.

A tooth stands in the thread space :math:`\theta = 0` of the hob at phase 0: its middle is at X = 0,
on the side +Y, and its flanks :math:`s = \pm 1` look towards :math:`\pm X`. Lengths are in mm,
angles in rad, in the frame of the right-handed gearset (`asperity.flanks.setting`).
"""

import dataclasses
import functools
import itertools
import math

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.flanks import trim, trim_grid
from asperity.flanks.blank import Blank
from asperity.flanks.conjugate import conjugate_each, cut_params
from asperity.flanks.profiles import FloatArray
from asperity.flanks.setting import Pair

_CHECKED_COLUMNS = 17
_GAUSS = 12


@dataclasses.dataclass(frozen=True, eq=False)
class FlankGrid:
    """Points of the cut wheel, each with the phase at which the hob cuts it.

    All arrays have the shape of the grid: rows from the inside out, columns along the wheel's axis.

    Attributes
    ----------
    points : ndarray
        (..., 3), in the wheel, mm.
    normals : ndarray
        (..., 3), unit normals out of the tooth.
    phase : ndarray
        Angle of the hob at which the point is cut; the wheel is then at its ``z_1/z_2``-fold.
    u, psi : ndarray
        Place on the hob's curve (0 to 1 flank, to 2 tip arc, to 3 land) and standing angle.
    radius, z : ndarray
        Distance from the wheel's axis and place on it, mm.
    """

    points: FloatArray
    normals: FloatArray
    phase: FloatArray
    u: FloatArray
    psi: FloatArray
    radius: FloatArray
    z: FloatArray

    @property
    def angle(self) -> FloatArray:
        """Angle about the wheel's axis from the middle of the tooth, positive towards +X."""
        return np.arctan2(self.points[..., 0], self.points[..., 1])


@dataclasses.dataclass(frozen=True, eq=False)
class WheelFlank:
    r"""One side of the wheel's tooth: flank, fillet and root.

    Attributes
    ----------
    pair : Pair
        What cuts it.
    side : int
        :math:`s`, 1 or -1.
    """

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
    def _hob(self) -> tuple[float, FloatArray, FloatArray]:
        cutting = cut_params(self.pair.ratio, self.pair.cutting)
        return float(self.side), self.pair.hob.params, cutting

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

    def _refuse(self, status: npt.NDArray[np.int64], z: FloatArray) -> None:
        bad = np.flatnonzero(status != trim.REACHED)
        if bad.size:
            worst = bad[np.argmin(np.abs(z[bad]))]
            raise InputError(_refusal(self.pair, int(status[worst]), float(z[worst])))

    def _points(self, u: FloatArray, psi: FloatArray) -> FlankGrid:
        side, hob, cut = self._hob
        points = np.empty((u.size, 3))
        normals = np.empty((u.size, 3))
        phase = np.empty(u.size)
        conjugate_each(u.reshape(-1), psi.reshape(-1), side, hob, cut, points, normals, phase)
        shape = u.shape
        points = points.reshape(*shape, 3)
        radius = np.hypot(points[..., 0], points[..., 1])
        z = points[..., 2].copy()
        return FlankGrid(
            points, normals.reshape(*shape, 3), phase.reshape(shape), u, psi, radius, z
        )

    def grid(self, n_radial: int, n_face: int, z: npt.ArrayLike | None = None) -> FlankGrid:
        """Return a grid over the flank, from the end of the fillet to the tip.

        Parameters
        ----------
        n_radial, n_face : int
            Rows, evenly spaced in radius on each column, and columns.
        z : array_like, optional
            The columns' places, mm, instead of ``n_face`` of them with the blank's kinks among
            them.

        Raises
        ------
        InputError
            No flank there, with the cause.
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
        u = np.empty((rows.size, places.size))
        psi = np.empty_like(u)
        status = np.empty(places.size, dtype=np.int64)
        trim_grid.flank_grid(places, stop, *self._hob, rows, u, psi, status)
        self._refuse(status, places)
        return self._points(u, psi)

    def fillet(self, n: int, z: npt.ArrayLike) -> FlankGrid:
        """Return ``n`` rows of the fillet from the root to the flank, by columns at ``z`` (mm).

        The last row is the first of `grid` on the same columns.
        """
        places, stop = self._columns(0, z)
        share = np.linspace(0.0, 1.0, n)
        u = np.empty((n, places.size))
        psi = np.empty_like(u)
        status = np.empty(places.size, dtype=np.int64)
        trim_grid.fillet_grid(places, stop, *self._hob, share, u, psi, status)
        self._refuse(status, places)
        return self._points(u, psi)

    def root(self, n: int, z: npt.ArrayLike) -> FlankGrid:
        """Return ``n`` rows of the root from the middle of the tooth space to the fillet."""
        places, _ = self._columns(0, z)
        share = np.linspace(0.0, 1.0, n)
        u = np.empty((n, places.size))
        psi = np.empty_like(u)
        status = np.empty(places.size, dtype=np.int64)
        trim_grid.root_grid(places, *self._hob, share, u, psi, status)
        self._refuse(status, places)
        return self._points(u, psi)

    def limits(self, z: npt.ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Return the radii where the flank begins and ends at places ``z``, mm."""
        places, stop = self._columns(0, z)
        return self._starts(places, stop)[0], stop

    def _starts(
        self, places: FloatArray, stop: FloatArray
    ) -> tuple[FloatArray, npt.NDArray[np.bool_]]:
        start = np.empty(places.size)
        undercut = np.empty(places.size, dtype=np.bool_)
        status = np.empty(places.size, dtype=np.int64)
        trim_grid.limits_each(places, stop, *self._hob, start, undercut, status)
        self._refuse(status, places)
        return start, undercut

    def at(self, radius: npt.ArrayLike, z: npt.ArrayLike) -> FlankGrid:
        """Return the points of flank or fillet at radii and places, broadcast, mm.

        Raises
        ------
        InputError
            A point lies outside the blank or below the fillet.
        """
        r, places = np.broadcast_arrays(
            np.asarray(radius, dtype=np.float64), np.asarray(z, dtype=np.float64)
        )
        flat, stop = self._columns(0, places)
        radii = np.ascontiguousarray(r).reshape(-1)
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

    def area(self, points: int = _GAUSS) -> float:
        r"""Return the area of the trimmed flank, mm^2.

        :math:`A = \int\int dR\,dZ/|n_\varphi|` by Gauss's rule of ``points`` in each direction,
        separately inside and outside the kinks of the blank.
        """
        knots, weights = np.polynomial.legendre.leggauss(points)
        half = self.blank.face_width / 2.0
        kink = self.blank.kink
        bounds = [-half, half] if kink is None else [-half, -kink, kink, half]
        total = 0.0
        for low, high in itertools.pairwise(bounds):
            z = 0.5 * (low + high) + 0.5 * (high - low) * knots
            grid = self.at_shares(0.5 * (1.0 + knots), z)
            start, stop = self.limits(z)
            x, y = grid.points[..., 0], grid.points[..., 1]
            nx, ny = grid.normals[..., 0], grid.normals[..., 1]
            around = np.abs(nx * y - ny * x) / grid.radius
            height = 0.5 * (stop - start)
            inner = np.sum(weights[:, None] / around, axis=0) * height
            total += float(np.sum(weights * inner)) * 0.5 * (high - low)
        return total


@dataclasses.dataclass(frozen=True, eq=False)
class Wheel:
    """A wheel as it is cut.

    Attributes
    ----------
    pair : Pair
        The gearset, its hob and how it cuts.
    """

    pair: Pair

    @classmethod
    def cut(cls, pair: Pair) -> "Wheel":
        """Cut the wheel of a pair with its hob.

        Raises
        ------
        InputError
            No tooth can be cut: undercut, pointed, or out of the hob's reach.
        """
        wheel = cls(pair)
        z = wheel.blank.columns(_CHECKED_COLUMNS)
        top = [wheel.flank(side).at_shares([1.0], z).angle[0] for side in (1, -1)]
        thickness = (top[0] - top[1]) * wheel.blank.tip_radius(z)
        if np.min(thickness) <= 0.0:
            at = float(z[np.argmin(thickness)])
            raise InputError(_pointed(pair, at))
        return wheel

    @functools.cached_property
    def blank(self) -> Blank:
        """The blank before it is cut."""
        return Blank.of(self.pair.geometry)

    def flank(self, side: int) -> WheelFlank:
        """Return the flank ``side``, 1 or -1."""
        return WheelFlank(self.pair, side)


def _pointed(pair: Pair, z: float) -> str:
    return (
        f"gearset.pressure_angle is {math.degrees(pair.geometry.pressure_angle):.4g} deg; with it "
        f"the wheel's teeth are pointed before their tip at {z:.4g} mm from mid-face: take a "
        "smaller pressure angle, a smaller profile shift or a narrower wheel face"
    )


def _refusal(pair: Pair, status: int, z: float) -> str:
    g = pair.geometry
    if status == trim.SHORT:
        return (
            f"hob too short: its threads begin at the radius {pair.hob.root_radius:.5g} mm and do "
            f"not reach the wheel's tip at {z:.4g} mm from mid-face: take a narrower wheel face, a "
            "larger diameter factor or a larger pressure angle"
        )
    if status == trim.UNDERCUT:
        return (
            f"gearset.wheel_teeth is {g.wheel_teeth}; the hob undercuts the whole flank at "
            f"{z:.4g} mm from mid-face: take more teeth, a larger pressure angle or a larger "
            "profile shift"
        )
    return (
        f"gearset.wheel_face_width is {g.wheel_face_width:.5g} mm; at {z:.4g} mm from mid-face the "
        "hob's flank does not reach the wheel: take a narrower wheel face, a larger diameter "
        "factor or fewer starts"
    )
