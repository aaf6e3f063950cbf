r"""Transmission error of the unloaded mesh, with misalignment, refined below the grid.

The wheel stands at :math:`\beta`; the worm's flank :math:`s` touches a tooth once it has turned to
the least :math:`s\varphi` over the tooth's flank
(`asperity.flanks.meshing.kernels.transmission`), and the tooth that comes first bears. Teeth differ
by whole pitches alone, so that one tooth, followed through the mesh, tells of all. With the lead of
the worm over its nominal place :math:`D = \min s\varphi - s\,i\beta`, the wheel is ahead
of :math:`\varphi/i` by :math:`-D/i` in the direction in which the flank drives it.

The worm's threads are taken as long as the wheel reaches. Lengths are in mm, angles in rad; the
frame is that of the right-handed gearset.
"""

import dataclasses
import functools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.errors import ConvergenceError
from asperity.flanks.meshing.kernels import transmission as kernels
from asperity.flanks.wheel.cutting.bracket import minimum
from asperity.flanks.wheel.flank import RESOLVED, FlankGrid, WheelFlank
from asperity.flanks.worm.curve import Thread
from asperity.flanks.worm.setting import Pair
from asperity.results import Quantities, labelled, quantity

SAMPLES = 32
"""Places of the wheel in a pitch."""

_ROWS, _COLUMNS = 24, 25
_STEPS = 25
# Points of the grid are at most this much further from contact than what lies between them, in mm
# of axial way; teeth still further away than that need no exact place.
_NEAR = 2e-2
_CONSTANT = 1e-13
_RIGID = 1e-9
# Of what is even there is no dip between places; one deeper than this part of its bend is not
# missed, and one is found to this part of a step.
_EVEN, _DEEPER, _NARROW = 1e-13, 0.5, 3e-4
# Of the step between places, to which extremes are found.
_FINE = 1e-4


@dataclasses.dataclass(frozen=True, eq=False)
class ToothSearch:
    """The flank of one tooth, and the worm it is to meet with how both stand."""

    pair: Pair
    flank: WheelFlank

    @functools.cached_property
    def grid(self) -> FlankGrid:
        """Points from which every search begins."""
        return self.flank.grid(_ROWS, _COLUMNS)

    @property
    def pitch(self) -> float:
        """Angle between teeth."""
        return 2.0 * math.pi / self.pair.geometry.wheel_teeth

    def places(self, samples: int) -> FloatArray:
        """Angles of the wheel, whole parts of a pitch, over which a tooth is in the mesh."""
        step = self.pitch / samples
        own = self.grid.phase / self.pair.ratio
        first = math.floor(float(own.min()) / step) - samples // 2
        last = math.ceil(float(own.max()) / step) + samples // 2
        return np.asarray(np.arange(first, last + 1) * step, dtype=np.float64)

    def _least(
        self, mode: int, worm: Thread, beta: FloatArray, phase: FloatArray, near: FloatArray
    ) -> FloatArray:
        pair, side = self.pair, self.flank.side
        blank = self.flank.blank
        out = np.empty((beta.size, 3))
        kernels.least_each(
            np.ascontiguousarray(self.grid.points),
            np.ascontiguousarray(self.grid.z[0]),
            beta,
            phase,
            mode,
            float(side),
            pair.hob.thread,
            pair.cut,
            worm,
            pair.mount,
            blank,
            near,
            out,
        )
        return out

    def lead(self, beta: FloatArray, exact: FloatArray | None = None) -> FloatArray:
        r"""Return by rows what the tooth needs at angles of the wheel: :math:`D`, radius and z.

        :math:`D` is infinite where the worm does not reach the tooth. ``exact`` tells where the
        place is to be found below the grid; radius is 0 where it is not.
        """
        nominal = self.flank.side * self.pair.ratio * beta
        near = np.full(beta.size, math.inf) if exact is None else exact + nominal
        worm = self.pair.worm.facing(self.flank.side)
        found = self._least(kernels.TURN, worm, beta, np.zeros(beta.size), near)
        found[:, 0] -= nominal
        return found

    @functools.cached_property
    def turns(self) -> FloatArray:
        """Whole pitches by which the wheel is turned to bring each tooth of a mesh to one place."""
        places = self.places(SAMPLES)
        first = math.floor(float(places[0]) / self.pitch) - 1
        last = math.ceil(float(places[-1]) / self.pitch) + 1
        return np.asarray(self.pitch * np.arange(first, last + 1), dtype=np.float64)

    def least_lead(self, beta: float) -> float:
        """Return :math:`D` of the tooth that bears at an angle of the wheel, rad."""
        beta_of = beta + self.turns
        rough = self.lead(beta_of, np.full(beta_of.size, -math.inf))[:, 0]
        near = np.full(beta_of.size, float(rough.min()) + _NEAR / self.pair.worm.reduced_lead)
        return float(self.lead(beta_of, near)[:, 0].min())

    def gap(self, beta: FloatArray, phase: FloatArray, exact: FloatArray) -> FloatArray:
        """Return by rows the least distance to the worm's thread, mm, and where, as `lead` does."""
        worm = self.pair.worm.facing(self.flank.side, core=False)
        return self._least(kernels.NEAR, worm, beta, phase, exact)


class Transmission(Quantities):
    r"""How the unloaded mesh transmits over a pitch of the wheel, on one flank.

    Attributes
    ----------
    lead : ndarray
        :math:`D` at each place: by how much the worm turns further than :math:`i\beta` until it
        touches, rad.
    tooth_angle, tooth_lead : ndarray
        Angles of one tooth from where it enters the mesh to where it leaves it, rad, and :math:`D`
        of that tooth alone; infinite where the worm does not reach it.
    contact : ndarray
        (n, 2) radius and z of the place that bears, on the tooth that bears, mm.
    """

    wheel_angle: FloatArray = quantity("beta", "rad", "angle of the wheel", dims=("place",))
    peak_to_peak: float = quantity(
        "", "rad", "transmission error, peak to peak",
        key="transmission_error_rad", variable="transmission_error_range",
    )  # fmt: skip
    search: ToothSearch
    lead: FloatArray
    tooth_angle: FloatArray
    tooth_lead: FloatArray
    contact: FloatArray

    @property
    @labelled(
        "", "rad", "the wheel ahead of the worm", variable="transmission_error", dims=("place",)
    )
    def error(self) -> FloatArray:
        r"""Transmission error at each place of the pitch, rad.

        By how much the wheel is ahead of :math:`\varphi_1 z_1/z_2` in the direction in which the
        flank drives it.
        """
        return -self.lead / self.search.pair.ratio

    @property
    @labelled(
        "", "rad", "transmission error, mean",
        key="transmission_error_mean_rad", variable="transmission_error_mean",
    )  # fmt: skip
    def mean(self) -> float:
        """Mean of `error`, rad."""
        return float(np.mean(self.error))

    @property
    @labelled("", "mm", "where it bears, from the axis", dims=("place",))
    def contact_radius(self) -> FloatArray:
        """Radius of the place that bears, mm."""
        return self.contact[:, 0]

    @property
    @labelled("", "mm", "where it bears, from mid-face", dims=("place",))
    def contact_face(self) -> FloatArray:
        """Place along the wheel's axis that bears, mm."""
        return self.contact[:, 1]

    @property
    def ahead(self) -> float:
        r"""Mean angle by which the wheel stands further than :math:`\varphi_1 z_1/z_2`, rad."""
        return self.search.flank.side * self.mean

    @property
    @labelled("phi_1", "rad", "angle of the worm in contact", dims=("place",))
    def worm_angle(self) -> FloatArray:
        r"""Angle :math:`\varphi_1` of the worm in contact at each place of the pitch."""
        side = self.search.flank.side
        return self.search.pair.ratio * self.wheel_angle + side * self.lead

    def resolution(self, name: str) -> float:
        """Return the size below which an angle of the wheel is rounding, rad."""
        return 2.0 * RESOLVED / self.search.pair.geometry.wheel_mean_diameter

    def contact_ratio(self, gap: float = 0.0) -> float:
        """Mean number of teeth that bear, to about one place in the pitch.

        What is nearer than the ``gap``, normal to the flanks, mm, counts as bearing; 0 is for rigid
        teeth.
        """
        missing = self._missing(gap)
        before, after = missing[:-1], missing[1:]
        steps = np.where((before <= 0.0) & (after <= 0.0), 1.0, 0.0)
        # Between two places the line between both, or half the way from where a tooth bears itself.
        cross = (before <= 0.0) != (after <= 0.0)
        low, high = np.minimum(before, after)[cross], np.maximum(before, after)[cross]
        steps[cross] = np.where(low > -2.0 * _RIGID, 0.5, -low / (high - low))
        return float(steps.sum()) / self.wheel_angle.size

    def teeth(self, gap: float = 0.0) -> IntArray:
        """Return how many teeth count as bearing at each place of the pitch."""
        counts = np.zeros(self.wheel_angle.size, dtype=np.int64)
        np.add.at(counts, self._index()[self._missing(gap) <= 0.0], 1)
        return counts

    def _missing(self, gap: float) -> FloatArray:
        """By how much the worm would have to turn further for the tooth to count, rad."""
        worm = self.search.pair.worm
        normal = worm.reduced_lead * math.cos(worm.lead_angle) * math.cos(worm.pressure_angle)
        return self.tooth_lead - self.along_tooth() - max(gap / normal, _RIGID)

    def with_worm(self, half_space: float) -> "Transmission":
        """Return the same with worm threads of another thickness; half the space in mm.

        The worm then turns further by the same angle everywhere until it touches.
        """
        pair = self.search.pair
        further = (half_space - pair.worm.half_space) / pair.worm.reduced_lead
        return dataclasses.replace(
            self,
            search=dataclasses.replace(self.search, pair=pair.with_worm(half_space)),
            lead=self.lead + further,
            tooth_lead=self.tooth_lead + further,
        )

    def along_tooth(self) -> FloatArray:
        """`lead` at the places of ``tooth_angle``."""
        return np.asarray(self.lead[self._index()])

    def _index(self) -> IntArray:
        """Place of the pitch that each of ``tooth_angle`` is."""
        samples = self.wheel_angle.size
        steps = np.rint(self.tooth_angle / (self.search.pitch / samples))
        return np.asarray(np.mod(steps.astype(np.int64), samples))


class Touch(NamedTuple):
    """Where a flank bears over a pitch: what a `Transmission` has but its range."""

    search: ToothSearch
    wheel_angle: FloatArray
    lead: FloatArray
    tooth_angle: FloatArray
    tooth_lead: FloatArray
    contact: FloatArray


def transmission(pair: Pair, flank: WheelFlank, samples: int = SAMPLES) -> Transmission:
    """Return the transmission of a pair on one flank, at so many places of the wheel in a pitch.

    Raises
    ------
    ConvergenceError
        There are places at which the worm reaches no tooth.
    """
    found = touching(pair, flank, samples)
    range_ = _range(found.search, found.lead) / pair.ratio
    return Transmission(**found._asdict(), peak_to_peak=range_)


def touching(pair: Pair, flank: WheelFlank, samples: int = SAMPLES) -> Touch:
    """Return where a flank bears over a pitch, as `transmission` has it; errors as there."""
    search = ToothSearch(pair, flank)
    angle = search.places(samples)
    index = np.mod(np.arange(angle.size) + round(angle[0] / (search.pitch / samples)), samples)
    rough = search.lead(angle, np.full(angle.size, -math.inf))[:, 0]
    least = np.full(samples, math.inf)
    np.minimum.at(least, index, rough)
    if not np.isfinite(least).all():
        raise ConvergenceError(
            "the worm reaches no tooth of the wheel in a part of the pitch: look at "
            "mount.centre_distance_error and mount.axial_offset",
            reached={"share_of_pitch": float(np.mean(np.isfinite(least)))},
        )
    near = _NEAR / pair.worm.reduced_lead
    found = search.lead(angle, least[index] + near)
    lead = np.full(samples, math.inf)
    contact = np.empty((samples, 2))
    for k in np.argsort(-found[:, 0]):
        if found[k, 0] <= lead[index[k]]:
            lead[index[k]] = found[k, 0]
            contact[index[k]] = found[k, 1:]
    beta = np.asarray(np.arange(samples) * (search.pitch / samples), dtype=np.float64)
    return Touch(search, beta, lead, angle, found[:, 0], contact)


def _range(search: ToothSearch, lead: FloatArray) -> float:
    """Difference of the extremes of the lead, looked for between the places as well."""
    low, high = float(lead.min()), float(lead.max())
    if (high - low) / search.pair.ratio <= _CONSTANT:
        return high - low
    step = search.pitch / lead.size

    def at(beta: float, sign: float) -> float:
        return sign * search.least_lead(beta)

    def extreme(sign: float) -> float:
        values = sign * lead
        k = int(np.argmin(values))
        a, b, c = (k - 1) * step, k * step, (k + 1) * step
        fa, fb, fc = values[k - 1], values[k], values[(k + 1) % lead.size]
        bracket = (a, fa, b, fb, c, fc)
        return float(minimum(at, (sign,), *bracket, _FINE * step, _STEPS, -math.inf)[1])

    return -extreme(-1.0) - extreme(1.0)


def least_between(values: FloatArray, step: float, at: Callable[[float], float]) -> float:
    """Return the least of a function of the wheel's angle, looked for between its places as well.

    Parameters
    ----------
    values : ndarray
        At places over a pitch from angle 0, after which they repeat themselves.
    step : float
        Between the places, rad.
    at : callable
        The function.
    """
    least = float(values.min())
    before, after = np.roll(values, 1), np.roll(values, -1)
    bend = before + after - 2.0 * values
    dips = (values <= before) & (values <= after) & (bend > _EVEN)
    # A parabola's depth between its places, twice, and what another curve may go deeper.
    depth = (before - after)[dips] ** 2 / (4.0 * bend[dips]) + _DEEPER * bend[dips]
    dips[dips] = values[dips] - depth <= least
    for k in np.flatnonzero(dips):
        bracket = ((k - 1) * step, before[k], k * step, values[k], (k + 1) * step, after[k])
        found = minimum(at, (), *bracket, _NARROW * step, _STEPS, -math.inf)
        least = min(least, float(found[1]))
    return least
