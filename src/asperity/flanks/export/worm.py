"""The body of a worm or hob: a few patches a start, between two planes."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.export.turned import (
    Beside,
    Bodies,
    sections_of,
    shaft_sections,
    threads_of,
)
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.setting import Pair

_LEAST_ALONG = 8
# Distance of the points on a ground flank at the root, to the mean distance.
_ROOT_SPACING = 0.2


class Spacing(NamedTuple):
    """How many points a worm's grids have, and how many along the axis at most."""

    per_turn: int
    on_flank: int
    on_arc: int
    most: int


EXACT = Spacing(60, 21, 13, 10_000)
"""Points that leave a quintic through a helix of the worm's size within 1e-8 mm."""
SHOWN = Spacing(48, 7, 4, 200)
"""What a picture needs."""


def worm_body(
    pair: Pair,
    length: float | None = None,
    *,
    spacing: Spacing = EXACT,
    between: tuple[float, float] | None = None,
) -> Body:
    """Return the worm of a pair between two planes across its axis, of its own length or another.

    The planes may be given, ``between`` two places along z; else they are as far to either side.

    About the z axis, mm, the middle of a thread space at z = 0 on the x axis; mirrored if the
    gearset is left-handed. Its threads are as thick as the backlash asks for. For each start root,
    flank, rounding of the tip, land, rounding and flank up to the root of the next; i runs round
    the axis, j along it.
    """
    worm = pair.worm
    if between is None:
        half = (pair.geometry.worm_face_width if length is None else length) / 2
        between = -half, half
    low_end, high_end = between
    length = high_end - low_end
    if not (math.isfinite(length) and length > 0):
        raise InputError(f"the worm's length is {length:g} mm; it must be positive")
    p = worm.reduced_lead
    count = 1 + math.ceil(spacing.per_turn * length / (2 * math.pi * p))
    count = min(max(_LEAST_ALONG, count), spacing.most)
    along = np.linspace(low_end, high_end, count)

    def swept(radius: ArrayLike, axial: ArrayLike, start: int) -> Patch:
        # A point of the axial section that stands `axial` beyond the space's middle.
        turn = (along - np.asarray(axial)[:, None]) / p - 2 * math.pi * start / worm.starts
        rho = np.broadcast_to(np.asarray(radius)[:, None], turn.shape)
        points = [rho * np.cos(turn), rho * np.sin(turn), np.broadcast_to(along, turn.shape)]
        # Angles fall as the axial place grows.
        return Patch(np.stack(points, axis=-1)[::-1])

    pieces = _axial_section(worm, spacing)
    patches = []
    for start in range(worm.starts):
        for radius, axial in pieces:
            patches.append(swept(radius, axial, start))
    low = [patch.points[::-1, 0] for patch in patches]
    high = [patch.points[:, -1] for patch in reversed(patches)]
    return Body(worm.name, patches, [low, high]).moved(np.diag([1.0, 1.0, pair.mirror]))


def whole_worm(pair: Pair, beside: Beside = None, spacing: Spacing = EXACT) -> Body:
    """Return the worm with its shaft ends, in the frame of `worm_body`."""
    sections = shaft_sections(pair, beside)
    thread = worm_body(pair, spacing=spacing, between=threads_of(pair, beside))
    shaft = Body("", [], [], sections).moved(np.diag([1.0, 1.0, pair.mirror]))
    return Body(thread.name, thread.patches, thread.rings, shaft.turned)


def wheel_shaft(beside: Beside) -> Body | None:
    """Return the wheel's shaft, its mesh at z = 0; None where it is not described."""
    shape = beside.wheel if isinstance(beside, Bodies) else None
    return None if shape is None else Body("wheel_shaft", [], [], sections_of(shape))


def mounted_worm(pair: Pair) -> Body:
    """Return the worm at phase 0 where it runs, in the frame of the gearset's wheel, mm."""
    mirror, place = np.diag([1.0, 1.0, pair.mirror]), pair.mounting.to_wheel
    worm = worm_body(pair).moved(mirror)
    patches = [Patch(place(patch.points)) for patch in worm.patches]
    return Body(worm.name, patches, [list(map(place, ring)) for ring in worm.rings]).moved(mirror)


def _axial_section(worm: Helicoid, spacing: Spacing) -> list[tuple[FloatArray, FloatArray]]:
    """Return radius and axial place of each piece of a start, in the order of their places."""
    side = [worm.curve(u)[:2] for u in _flank_places(worm, spacing)]
    if worm.tip_rounding > 0:
        side.append(worm.curve(np.linspace(1.0, 2.0, spacing.on_arc))[:2])
    inner = float(side[0][1][0])
    outer = float(side[-1][1][-1])
    even = np.linspace(-1.0, 1.0, spacing.on_flank)
    pitch = 2 * worm.half_pitch
    root = (np.full_like(even, worm.root_radius), inner * even)
    land = (np.full_like(even, worm.tip_radius), pitch / 2 + (pitch / 2 - outer) * even)
    back = [(radius[::-1], pitch - axial[::-1]) for radius, axial in reversed(side)]
    return [root, *side, land, *back]


def _flank_places(worm: Helicoid, spacing: Spacing) -> list[FloatArray]:
    """Return places on the flank, even in what it is smooth in, split where it is not."""
    base = worm.profile.base_radius
    root, end = worm.root_radius, worm.flank_end
    even = np.linspace(0.0, 1.0, spacing.on_flank)
    if base is None or base >= end:
        # Discs leave flanks that bend most at the root, near where they would undercut themselves.
        return [even * (_ROOT_SPACING + (1.0 - _ROOT_SPACING) * even)]
    # An involute helicoid is smooth in the length of its generator, not in the radius.
    least = max(root, base)
    low, high = math.sqrt(least**2 - base**2), math.sqrt(end**2 - base**2)
    radius = np.hypot(base, low + even * (high - low))
    radius[[0, -1]] = least, end
    flank = (radius - root) / (end - root)
    return [flank] if least == root else [np.linspace(0.0, flank[0], spacing.on_arc), flank]
