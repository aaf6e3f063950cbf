"""The body of a wheel tooth with its share of the rim, of several teeth, of the whole wheel."""

import math

import numpy as np
from numpy.typing import NDArray

from asperity.errors import InputError
from asperity.flanks.export.patch import Body, Patch
from asperity.flanks.wheel import Wheel

Floats = NDArray[np.float64]

# Points that leave a quintic within 4e-7 mm of the flank of a wheel of module 2.
_ACROSS_THROAT, _ACROSS_RIM = 21, 13
_UP_FLANK = 17
_ON_FILLET = 33
_ON_ARC = 11


def tooth_body(wheel: Wheel, teeth: int = 1) -> Body:
    """Return teeth with the rim below them, cut in the middle of the tooth spaces.

    The first tooth is the one that stands in the worm's thread space at phase 0; each further one
    follows on the side of the flank s = +1.

    Parameters
    ----------
    wheel : Wheel
        The cut wheel.
    teeth : int
        Number of teeth, 1 to that of the wheel; a whole wheel has no cuts.

    Returns
    -------
    Body
        In the gearset's own frame, mm, mirrored if it is left-handed. For each tooth and each part
        of the face width between the kinks of the blank: roots, fillets, flanks, tip, inside of
        the rim; i runs round the tooth, j along the wheel's axis.

    Raises
    ------
    InputError
        A number of teeth that the wheel has not, or a flank that cannot be cut.
    """
    most = wheel.pair.geometry.wheel_teeth
    if not 1 <= teeth <= most:
        raise InputError(f"teeth is {teeth}; the wheel has 1 to {most}")
    half, kink = wheel.blank.face_width / 2.0, wheel.blank.kink
    columns = [np.linspace(-half, half, _ACROSS_THROAT)]
    if kink is not None:
        outer = np.linspace(kink, half, _ACROSS_RIM)
        columns = [-outer[::-1], np.linspace(-kink, kink, _ACROSS_THROAT), outer]
    bands = [_outline(wheel, z) for z in columns]
    patches: list[Patch] = []
    rings = []
    for number in range(teeth):
        # The whole wheel closes: its first cut is its last.
        inside = {"cut_minus"} if number or teeth == most else set()
        inside |= {"cut_plus"} if number + 1 < teeth or teeth == most else set()
        turn = _turned(2.0 * math.pi * number / most)
        for band in bands:
            kept = [grid for name, grid in band.items() if name not in inside]
            patches += [Patch(grid @ turn.T) for grid in kept]
        low = [grid[::-1, 0] @ turn.T for grid in reversed(bands[0].values())]
        high = [grid[:, -1] @ turn.T for grid in bands[-1].values()]
        rings += [low, high]
    name = "wheel" if teeth == most else "tooth" if teeth == 1 else "teeth"
    return Body(name, patches, rings).moved(np.diag([1.0, 1.0, wheel.pair.mirror]))


def _outline(wheel: Wheel, z: Floats) -> dict[str, Floats]:
    """Return the grids round one tooth, counterclockwise seen from +Z, columns at ``z``."""
    g = wheel.pair.geometry
    inner = g.wheel_root_diameter / 2.0 - g.rim_thickness
    sides = {}
    for side in (1, -1):
        flank = wheel.flank(side)
        root = flank.root(_ON_ARC, z)
        # The last row of each is the first of the next, to the last digit.
        fillet = flank.fillet(_ON_FILLET, z)
        face = flank.grid(_UP_FLANK, len(z), z)
        sides[side] = root, fillet, face
    first, last = sides[-1][0].angle[0], sides[1][0].angle[0]
    left, right = sides[-1][2].angle[-1], sides[1][2].angle[-1]
    tip = wheel.blank.tip_radius(z)
    below = [_cylinder(inner, angle[None], z) for angle in (first, last)]
    share = np.linspace(0.0, 1.0, _ON_ARC)[:, None]
    middle = {
        "tip": _cylinder(tip, right + share * (left - right), z),
        "inner": _cylinder(inner, first + share * (last - first), z),
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


def _cylinder(radius: Floats | float, angle: Floats, z: Floats) -> Floats:
    points = [radius * np.sin(angle), radius * np.cos(angle), np.broadcast_to(z, angle.shape)]
    return np.stack(points, axis=-1)


def _turned(angle: float) -> Floats:
    """The matrix that turns from +Y towards +X."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
