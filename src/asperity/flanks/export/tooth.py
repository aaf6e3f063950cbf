"""The body of a wheel tooth with its share of the rim, of several teeth, of the whole wheel."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.export.turned import Beside, blanks_of, merged
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import on_cylinder, turned
from asperity.gearset.blanks import rim_radius, wheel_section

FLANK_ERROR = 4e-7
"""Largest distance of a tooth's splines from the flanks, mm, but for corners of undercut."""

FILLET_ERROR = 4e-6
"""The same for the fillets."""

WHEEL_FLANK_ERROR = 5e-5
"""The same for the flanks of a whole wheel, whose file would be several times as long, mm."""

WHEEL_FILLET_ERROR = 2e-4
"""The same for its fillets."""


class Spacing(NamedTuple):
    """How many points a tooth's grids have at least, and how far their splines may be off, mm."""

    across_throat: int = 21
    across_rim: int = 13
    up_flank: int = 17
    on_fillet: int = 25
    on_arc: int = 11
    flank_error: float = FLANK_ERROR
    fillet_error: float = FILLET_ERROR

    def rows(self, steps: int) -> "Spacing":
        """Return grids round the tooth whose steps are divided by a whole number."""
        counts = (_rows(count, steps) for count in (self.up_flank, self.on_fillet, self.on_arc))
        return self._replace(**dict(zip(("up_flank", "on_fillet", "on_arc"), counts, strict=True)))


_EXACT = Spacing()
_WHOLE = Spacing(11, 6, 9, 13, 6, WHEEL_FLANK_ERROR, WHEEL_FILLET_ERROR)
SHOWN = Spacing(9, 3, 6, 5, 3, math.inf, math.inf)
"""What a picture needs."""

# Enough for most wheels; where it is not, the steps are halved, and halved again. Where undercut
# begins the flank has a corner that no number of points smooths.
_HALVINGS = 2
_BELOW = ("cut_plus", "cut_minus", "inner")


def tooth_body(wheel: Wheel, teeth: int = 1) -> Body:
    """Return teeth with the rim below them, cut in the middle of the tooth spaces.

    The first tooth is the one that stands in the worm's thread space at phase 0; each further one
    follows on the side of the flank s = +1. In the gearset's own frame, mm, mirrored if it is
    left-handed. For each tooth and each part of the face width between the kinks of the blank there
    are roots, fillets, flanks, tip and inside of the rim; i runs round the tooth, j along the
    wheel's axis.
    """
    most = wheel.pair.geometry.wheel_teeth
    if not 1 <= teeth < most:
        raise InputError(f"teeth is {teeth}; 1 to {most - 1} can be cut out of the wheel")
    bands = _bands(wheel, _EXACT)
    patches: list[Patch] = []
    rings = []
    for number in range(teeth):
        inside = {"cut_minus"} if number else set()
        inside |= {"cut_plus"} if number + 1 < teeth else set()
        turn = turned(2.0 * math.pi * number / most)
        for band in bands:
            kept = [grid for name, grid in band.items() if name not in inside]
            patches += [Patch(grid @ turn.T) for grid in kept]
        rings += [[row @ turn.T for row in ring] for ring in _ends(bands)]
    name = "tooth" if teeth == 1 else "teeth"
    return Body(name, patches, rings).moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def centred_teeth(wheel: Wheel, teeth: int) -> Body:
    """Return teeth on both sides of the one that stands in the worm's thread space."""
    teeth = min(teeth, wheel.pair.geometry.wheel_teeth - 1)
    angle = -2.0 * math.pi * (teeth // 2) / wheel.pair.geometry.wheel_teeth
    return tooth_body(wheel, teeth).moved(turned(angle))


def wheel_body(wheel: Wheel, beside: Beside = None, spacing: Spacing = _WHOLE) -> Body:
    """Return the whole wheel: all its teeth, rim, web, hub and bore.

    In the gearset's own frame, mm, mirrored if it is left-handed; the first tooth is the one that
    stands in the worm's thread space at phase 0. Its flanks are within `WHEEL_FLANK_ERROR` of the
    exact ones.
    """
    most = wheel.pair.geometry.wheel_teeth
    bands = _bands(wheel, spacing)
    low, high = _ends(bands, _BELOW)
    turns = [turned(2.0 * math.pi * number / most).T for number in range(most)]
    patches = [
        Patch(grid @ turn)
        for turn in turns
        for band in bands
        for name, grid in band.items()
        if name not in _BELOW
    ]
    rings = [
        [row @ turn for turn in turns for row in low],
        [row @ turn for turn in reversed(turns) for row in high],
    ]
    section = wheel_section(wheel.pair.geometry, blanks_of(beside))
    made = Body("wheel", patches, rings, [merged(section)])
    return made.moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def shown_tooth(wheel: Wheel) -> Body:
    """Return an open surface for pictures: a tooth of the whole wheel, down to inside the rim."""
    bands = _bands(wheel, SHOWN)
    patches = [Patch(grid) for band in bands for name, grid in band.items() if name not in _BELOW]
    made = Body("tooth", patches, _ends(bands))
    return made.moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def beside_flanks(wheel: Wheel, z: FloatArray) -> Body:
    """Return an open surface for pictures: `shown_tooth` without its flanks.

    Its columns are at ``z``, so that it meets grids of the flanks at the same columns.
    """
    grids = _outline(wheel, z, SHOWN.rows(1), SHOWN.on_arc)
    left_out = (*_BELOW, "flank_plus", "flank_minus")
    patches = [Patch(grid) for name, grid in grids.items() if name not in left_out]
    made = Body("tooth", patches, _ends([grids]))
    return made.moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def _bands(wheel: Wheel, spacing: Spacing) -> list[dict[str, FloatArray]]:
    """Return the grids round the first tooth, for each part of the face between kinks.

    All have the same rows: where two meet, the curve that they share is through the same points.
    """
    half, kink = wheel.blank.face_width / 2.0, wheel.blank.kink
    if kink is None:
        return _fitted(wheel, [(-half, half, spacing.across_throat)], spacing)
    rim, throat = spacing.across_rim, spacing.across_throat
    return _fitted(wheel, [(-half, -kink, rim), (-kink, kink, throat), (kink, half, rim)], spacing)


def _ends(
    bands: list[dict[str, FloatArray]], without: tuple[str, ...] = ()
) -> tuple[list[FloatArray], list[FloatArray]]:
    """Return the rows round the first tooth on the lower and on the upper face of the wheel."""
    first, last = (
        [grid for name, grid in band.items() if name not in without]
        for band in (bands[0], bands[-1])
    )
    return [grid[::-1, 0] for grid in reversed(first)], [grid[:, -1] for grid in last]


def _fitted(
    wheel: Wheel, parts: Sequence[tuple[float, float, int]], spacing: Spacing
) -> list[dict[str, FloatArray]]:
    """Return the grids round one tooth over parts of its face, fine enough for the splines.

    A part is its lower and its upper end, mm, and the columns it has at least.
    """

    def made(part: int, columns: int, rows: int) -> dict[str, FloatArray]:
        low, high, least = parts[part]
        z = np.linspace(low, high, _rows(least, columns))
        return _outline(wheel, z, spacing.rows(rows), spacing.on_arc)

    def coarse(grids: dict[str, FloatArray], finer: dict[str, FloatArray]) -> bool:
        return any(_error(grids[name], finer[name]) > error for name, error in allowed.items())

    allowed = {
        f"{part}_{side}": error
        for part, error in (("flank", spacing.flank_error), ("fillet", spacing.fillet_error))
        for side in ("plus", "minus")
        if math.isfinite(error)
    }
    columns = [1] * len(parts)
    bands = [made(part, 1, 1) for part in range(len(parts))]
    for halving in range(1, _HALVINGS + 1 if allowed else 1):
        finer = [made(part, 2 * columns[part], 2**halving) for part in range(len(parts))]
        rough = list(map(coarse, bands, finer))
        if not any(rough):
            break
        # A part that is fine already takes the rows of its neighbours, no columns.
        for part, halved in enumerate(rough):
            columns[part] *= 2 if halved else 1
            bands[part] = finer[part] if halved else made(part, columns[part], 2**halving)
    return bands


def _error(grid: FloatArray, finer: FloatArray) -> float:
    """Return how far the spline through a grid is from exact points between, across the surface."""
    normal = np.cross(np.gradient(finer, axis=0), np.gradient(finer, axis=1))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    between = Patch(grid).finer(2).points - finer
    return float(np.abs(np.einsum("ijk,ijk->ij", between, normal)).max())


def _outline(wheel: Wheel, z: FloatArray, rows: Spacing, on_arc: int) -> dict[str, FloatArray]:
    """Return the grids round one tooth, counterclockwise seen from +Z, columns at ``z``."""
    inner = rim_radius(wheel.pair.geometry)
    sides = {}
    for side in (1, -1):
        flank = wheel.flank(side)
        root = flank.root(rows.on_arc, z)
        # The last row of each is the first of the next, to the last digit.
        fillet = flank.fillet(rows.on_fillet, z)
        face = flank.grid(rows.up_flank, len(z), z)
        sides[side] = root, fillet, face
    first, last = sides[-1][0].angle[0], sides[1][0].angle[0]
    left, right = sides[-1][2].angle[-1], sides[1][2].angle[-1]
    tip = wheel.blank.tip_radius(z)
    below = [on_cylinder(inner, angle[None], z) for angle in (first, last)]
    share = np.linspace(0.0, 1.0, on_arc)[:, None]
    middle = {
        "tip": on_cylinder(tip, right + share * (left - right), z),
        "inner": on_cylinder(inner, first + share * (last - first), z),
    }
    plus = [grid.points for grid in sides[1]]
    minus = [grid.points for grid in sides[-1]]
    return {
        "cut_plus": np.concatenate([below[1], plus[0][:1]]),
        "root_plus": plus[0],
        "fillet_plus": plus[1],
        "flank_plus": plus[2],
        "tip": middle["tip"],
        "flank_minus": minus[2][::-1],
        "fillet_minus": minus[1][::-1],
        "root_minus": minus[0][::-1],
        "cut_minus": np.concatenate([minus[0][:1], below[0]]),
        "inner": middle["inner"],
    }


def _rows(count: int, steps: int) -> int:
    return steps * (count - 1) + 1
