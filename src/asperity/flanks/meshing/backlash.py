r"""Backlash of the mesh, the worm's axial clearance in it, and the threads that give a backlash.

One flank of the worm touches; the other is away from the next flank of the wheel. Their shortest
distance is the normal backlash. How far the worm can be turned between both, the wheel held, is in
closed form the sum of what both flanks need, :math:`\Delta\varphi = D_+ + D_-`
(`asperity.flanks.meshing.transmission`), and since a turn carries the thread along, the worm can be
shifted by :math:`p\,\Delta\varphi` instead: its axial clearance, the most that an axial vibration
can have from peak to peak. All are the least over a pitch, between its places too, and negative
where the flanks interfere. The wheel's tips may stand nearer to the worm's core than that:
`core_clearance`.

Lengths are in mm, angles in rad.
"""

import math
from collections.abc import Mapping

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.meshing.transmission import (
    ToothSearch,
    Touch,
    Transmission,
    least_between,
)
from asperity.flanks.sides import both
from asperity.flanks.wheel.flank import RESOLVED
from asperity.flanks.wheel.frame import on_cylinder
from asperity.flanks.worm.setting import Pair
from asperity.gearset.wheel_blank import Blank
from asperity.results import Quantities, labelled, quantity

# Further than this from the least no place is looked at below the grid, mm.
_NEAR = 3e-3
_STEPS = 20
_TOLERANCE = 1e-10
# Places across the face, and over an angle to both sides of the line of centres, rad.
_CLOSE, _SWEPT = 201, 0.2


class Play(Quantities):
    """The play of a worm between both flanks of the wheel, the least over a pitch.

    The normal backlash is by the flank that bears, mm; the angles are the worm's turn with the
    wheel held, and the wheel's with the worm held, rad.
    """

    normal: dict[int, float]
    axial: float = quantity(
        "", "mm", "axial clearance of the worm",
        key="axial_clearance_mm", variable="axial_clearance",
    )  # fmt: skip
    worm_angle: float
    wheel_angle: float

    @property
    @labelled(
        "", "mm", "greatest amplitude of its axial vibration",
        key="axial_amplitude_max_mm", variable="axial_amplitude_max",
    )  # fmt: skip
    def amplitude(self) -> float:
        """Largest amplitude of an axial vibration of the worm about mid-play, mm; at least 0."""
        return max(0.0, 0.5 * self.axial)

    def resolution(self, name: str) -> float:
        """Return the size below which a length is rounding, mm."""
        return RESOLVED


def normal_backlash(bearing: Transmission, other: ToothSearch) -> float:
    """Return the shortest distance to the other flank of the thread, least over a pitch, mm.

    Negative: the depth by which the flanks interfere.
    """
    samples = bearing.wheel_angle.size
    step = other.pitch / samples
    beta = other.places(samples)
    index = np.mod(np.rint(beta / step).astype(np.int64), samples)
    near = _gaps(other, beta, bearing, bearing.lead[index])
    values = np.full(samples, math.inf)
    np.minimum.at(values, index, near)

    def at(angle: float) -> float:
        lead = bearing.search.least_lead(angle)
        return float(_gaps(other, angle + other.turns, bearing, lead).min())

    return least_between(values, step, at)


def _gaps(
    other: ToothSearch, beta: FloatArray, bearing: Transmission, lead: FloatArray | float
) -> FloatArray:
    """Return distances to the other flank at angles of the wheel, exact where they are least."""
    phase = other.pair.ratio * beta + bearing.search.flank.side * lead
    rough = other.gap(beta, phase, np.full(beta.size, -math.inf))[:, 0]
    near = np.full(beta.size, float(rough.min()) + _NEAR)
    return np.asarray(other.gap(beta, phase, near)[:, 0])


def play(meshes: dict[int, Transmission]) -> Play:
    """Return the play of a mesh from the transmission on both flanks, over the same places."""
    pair = meshes[1].search.pair
    turn = worm_turn(meshes)
    return Play(
        normal=_normal(meshes),
        axial=pair.worm.reduced_lead * turn,
        worm_angle=turn,
        wheel_angle=turn / pair.ratio,
    )


def _normal(meshes: dict[int, Transmission]) -> dict[int, float]:
    """Return the normal backlash by the flank that bears, mm."""
    return both(lambda side: normal_backlash(meshes[side], meshes[-side].search))


def _thinned(meshes: dict[int, Transmission], half_space: float) -> dict[int, Transmission]:
    """Return the mesh with threads of another thickness."""
    return both(lambda side: meshes[side].with_worm(half_space))


def worm_turn(meshes: Mapping[int, Transmission | Touch]) -> float:
    """Return by how much the worm can be turned with the wheel held, rad, least over a pitch."""
    searches = [meshes[side].search for side in (1, -1)]
    leads = meshes[1].lead + meshes[-1].lead
    step = searches[0].pitch / leads.size
    return least_between(leads, step, lambda beta: sum(one.least_lead(beta) for one in searches))


def core_clearance(pair: Pair, blank: Blank) -> float:
    """Return the least distance of the wheel's tips to the worm's core as it is mounted, mm."""
    z, turn = blank.columns(_CLOSE), np.linspace(-_SWEPT, _SWEPT, _CLOSE)[:, None]
    place = pair.mounting.to_helicoid(on_cylinder(blank.tip_radius(z), turn, z))
    return float(np.hypot(place[..., 0], place[..., 1]).min()) - pair.worm.root_radius


def set_backlash(meshes: dict[int, Transmission], backlash: float) -> dict[int, Transmission]:
    """Return a mesh whose worm threads leave a normal backlash (mm), the least with either flank.

    Raises
    ------
    InputError
        The threads would be pointed.
    ConvergenceError
        No thickness leaves it.
    """
    worm = meshes[1].search.pair.worm
    widest = worm.half_space + worm.half_pitch - float(worm.curve(2.0)[1])
    normal = math.cos(worm.lead_angle) * math.cos(worm.pressure_angle)
    turn = worm_turn(meshes)
    slope = 2.0 * normal
    tried: list[tuple[float, float]] = []
    # For ZI this is the answer.
    half_space = worm.half_space + 0.5 * (backlash / normal - worm.reduced_lead * turn)
    for _ in range(_STEPS):
        if half_space >= widest:
            most = normal * (worm.reduced_lead * turn + 2.0 * (widest - worm.half_space))
            # What there is beyond is less than this where both flanks do not touch alike.
            room = math.floor(90.0 * most) / 100.0
            if 0.0 < room < backlash:
                advice = f"take one of at most about {room:g} mm"
                if worm.tip_relief:
                    advice += ", or less modification.tip_relief"
            else:
                advice = (
                    "none is possible as the worm is mounted and modified: look at mount and "
                    "modification"
                )
                if worm.tip_relief:
                    advice += ".tip_relief"
            raise InputError(
                f"mount.backlash is {backlash:g} mm; the worm's threads would be pointed: {advice}"
            )
        thinned = _thinned(meshes, half_space)
        least = min(_normal(thinned).values())
        missing = backlash - least
        if abs(missing) <= _TOLERANCE:
            return thinned
        tried.append((half_space, least))
        if len(tried) > 1 and tried[-1][0] != tried[-2][0]:
            (w0, j0), (w1, j1) = tried[-2:]
            # Far from the answer the flanks may miss each other, and the secant be useless.
            slope = max((j1 - j0) / (w1 - w0), 0.5 * slope)
        half_space += missing / slope
    raise ConvergenceError(
        f"no thickness of the worm's threads leaves a backlash of {backlash:g} mm",
        reached={"backlash_mm": least},
    )
