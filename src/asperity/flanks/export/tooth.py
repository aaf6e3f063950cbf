"""The body of a wheel tooth with its share of the rim, of several teeth, of the whole wheel."""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import on_cylinder, turned

FLANK_ERROR = 4e-7
"""Largest distance of the spline surfaces from the flanks, mm, but for corners of undercut."""

FILLET_ERROR = 4e-6
"""The same for the fillets."""

_ALLOWED = {
    "flank_plus": FLANK_ERROR,
    "flank_minus": FLANK_ERROR,
    "fillet_plus": FILLET_ERROR,
    "fillet_minus": FILLET_ERROR,
}
# Enough for most wheels; where it is not, the steps are halved, and halved again. Where undercut
# begins the flank has a corner that no number of points smooths.
_HALVINGS = 2
_ACROSS_THROAT, _ACROSS_RIM = 21, 13
_UP_FLANK = 17
_ON_FILLET = 25
_ON_ARC = 11


def tooth_body(wheel: Wheel, teeth: int = 1) -> Body:
    """Return teeth with the rim below them, cut in the middle of the tooth spaces.

    The first tooth is the one that stands in the worm's thread space at phase 0; each further one
    follows on the side of the flank s = +1, and a whole wheel has no cuts. In the gearset's own
    frame, mm, mirrored if it is left-handed. For each tooth and each part of the face width between
    the kinks of the blank there are roots, fillets, flanks, tip and inside of the rim; i runs round
    the tooth, j along the wheel's axis.
    """
    most = wheel.pair.geometry.wheel_teeth
    if not 1 <= teeth <= most:
        raise InputError(f"teeth is {teeth}; the wheel has 1 to {most}")
    half, kink = wheel.blank.face_width / 2.0, wheel.blank.kink
    if kink is None:
        bands = [_fitted(wheel, -half, half, _ACROSS_THROAT)]
    else:
        bands = [
            _fitted(wheel, -half, -kink, _ACROSS_RIM),
            _fitted(wheel, -kink, kink, _ACROSS_THROAT),
            _fitted(wheel, kink, half, _ACROSS_RIM),
        ]
    patches: list[Patch] = []
    rings = []
    for number in range(teeth):
        # The whole wheel closes: its first cut is its last.
        inside = {"cut_minus"} if number or teeth == most else set()
        inside |= {"cut_plus"} if number + 1 < teeth or teeth == most else set()
        turn = turned(2.0 * math.pi * number / most)
        for band in bands:
            kept = [grid for name, grid in band.items() if name not in inside]
            patches += [Patch(grid @ turn.T) for grid in kept]
        low = [grid[::-1, 0] @ turn.T for grid in reversed(bands[0].values())]
        high = [grid[:, -1] @ turn.T for grid in bands[-1].values()]
        rings += [low, high]
    name = "wheel" if teeth == most else "tooth" if teeth == 1 else "teeth"
    return Body(name, patches, rings).moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def centred_teeth(wheel: Wheel, teeth: int) -> Body:
    """Return teeth on both sides of the one that stands in the worm's thread space."""
    angle = -2.0 * math.pi * (teeth // 2) / wheel.pair.geometry.wheel_teeth
    return tooth_body(wheel, teeth).moved(turned(angle))


def _fitted(wheel: Wheel, low: float, high: float, columns: int) -> dict[str, FloatArray]:
    """Return the grids round one tooth over a part of its face, fine enough for the splines."""
    grids = _outline(wheel, np.linspace(low, high, columns), 1)
    for halving in range(1, _HALVINGS + 1):
        steps = 2**halving
        finer = _outline(wheel, np.linspace(low, high, _rows(columns, steps)), steps)
        errors = {name: _error(grids[name], finer[name]) for name in _ALLOWED}
        if all(errors[name] <= allowed for name, allowed in _ALLOWED.items()):
            break
        grids = finer
    return grids


def _error(grid: FloatArray, finer: FloatArray) -> float:
    """Return how far the spline through a grid is from exact points between, across the surface."""
    normal = np.cross(np.gradient(finer, axis=0), np.gradient(finer, axis=1))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    between = Patch(grid).finer(2).points - finer
    return float(np.abs(np.einsum("ijk,ijk->ij", between, normal)).max())


def _outline(wheel: Wheel, z: FloatArray, steps: int) -> dict[str, FloatArray]:
    """Return the grids round one tooth, counterclockwise seen from +Z, columns at ``z``.

    ``steps`` is by how many each step of the coarsest grids round the tooth is divided.
    """
    g = wheel.pair.geometry
    inner = g.wheel_root_diameter / 2.0 - g.rim_thickness
    sides = {}
    for side in (1, -1):
        flank = wheel.flank(side)
        root = flank.root(_rows(_ON_ARC, steps), z)
        # The last row of each is the first of the next, to the last digit.
        fillet = flank.fillet(_rows(_ON_FILLET, steps), z)
        face = flank.grid(_rows(_UP_FLANK, steps), len(z), z)
        sides[side] = root, fillet, face
    first, last = sides[-1][0].angle[0], sides[1][0].angle[0]
    left, right = sides[-1][2].angle[-1], sides[1][2].angle[-1]
    tip = wheel.blank.tip_radius(z)
    below = [on_cylinder(inner, angle[None], z) for angle in (first, last)]
    share = np.linspace(0.0, 1.0, _ON_ARC)[:, None]
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
