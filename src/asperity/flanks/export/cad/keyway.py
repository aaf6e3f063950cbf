"""Keyways of DIN 6885-1 in the wheel's bore and the driven end of the worm's shaft.

Solids are made without a cut; a keyway, of planes alone, is cut from one that is closed.
"""

import math
from typing import TYPE_CHECKING, Any

from asperity.errors import ConvergenceError, InputError
from asperity.flanks.export.turned import shaft_sizes
from asperity.flanks.worm.setting import Pair
from asperity.gearset.blanks import Blanks, wheel_sizes
from asperity.gearset.keys import key_of

if TYPE_CHECKING:
    from asperity.flanks.export.cad.brep import Solid

_BEYOND = 1.0
_FROM_END, _LENGTH = 0.1, 0.7


def require_keys(pair: Pair, blanks: Blanks | None) -> None:
    """Refuse keyways for which there is no key or no room; raises InputError."""
    wanted = "none" if blanks is None else blanks.keyways
    if wanted in ("wheel", "both"):
        sizes = wheel_sizes(pair.geometry, blanks)
        key = key_of(sizes["bore"], "blank.bore")
        room = 0.5 * (sizes["hub_diameter"] - sizes["bore"])
        if key.in_hub >= room:
            raise InputError(
                f"blank.keyways is {wanted!r}; the hub's wall is {room:.4g} mm and its keyway "
                f"{key.in_hub:g} mm deep: take a larger blank.hub_diameter"
            )
    if wanted in ("worm", "both"):
        own = shaft_sizes(pair, blanks)
        key_of(own["shaft_diameter"], "blank.shaft_diameter")
        if own["drive_end"] <= 0.0:
            raise InputError(
                f"blank.keyways is {wanted!r}; the worm has no shaft at its driven end: give "
                "blank.drive_end"
            )


def keyed(made: "Solid", pair: Pair, blanks: Blanks | None) -> "Solid":
    """Return a solid of worm or wheel with its keyway, where one is wanted.

    Raises
    ------
    ConvergenceError
        What is left is no valid solid.
    """
    wanted = "none" if blanks is None else blanks.keyways
    if wanted not in (made.name, "both") or made.name not in ("worm", "wheel"):
        return made
    corner, size = _seat(made.name, pair, blanks)
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    from asperity.flanks.export.cad.brep import Solid, check

    box = BRepPrimAPI_MakeBox(gp_Pnt(*corner), *size).Shape()
    found = TopExp_Explorer(BRepAlgoAPI_Cut(made.shape, box).Shape(), TopAbs_ShapeEnum.TopAbs_SOLID)
    if not found.More():
        raise ConvergenceError(f"the keyway leaves no solid of the {made.name}")
    shape: Any = TopoDS.Solid(found.Current())
    seen = check(shape)
    if not seen.valid:
        raise ConvergenceError(f"the {made.name} with its keyway is no valid solid")
    return Solid(made.name, shape, seen)


def _seat(
    name: str, pair: Pair, blanks: Blanks | None
) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """Return a corner and the size of what is cut away, mm, in the frame of the body."""
    if name == "wheel":
        sizes = wheel_sizes(pair.geometry, blanks)
        key, width = key_of(sizes["bore"], "blank.bore"), sizes["hub_width"]
        outer = 0.5 * sizes["bore"] + key.in_hub
        half = 0.5 * width + _BEYOND
        return (0.0, -0.5 * key.width, -half), (outer, key.width, 2.0 * half)
    own = shaft_sizes(pair, blanks)
    radius, drive = 0.5 * own["shaft_diameter"], own["drive_end"]
    key = key_of(own["shaft_diameter"], "blank.shaft_diameter")
    high = 0.5 * pair.geometry.worm_face_width + drive * (1.0 - _FROM_END)
    length = _LENGTH * drive
    # A left-handed worm is the mirror image of a right-handed one, along its axis.
    low = high - length if pair.mirror > 0 else -high
    deep = radius - key.in_shaft
    return (deep, -0.5 * key.width, low), (key.in_shaft + _BEYOND, key.width, length)


def cut_volume(name: str, pair: Pair, blanks: Blanks | None) -> float:
    """Return the volume that a keyway takes from worm or wheel, chamfers left out, mm^3."""
    _, (_, width, length) = _seat(name, pair, blanks)
    half = 0.5 * width
    if name == "wheel":
        sizes = wheel_sizes(pair.geometry, blanks)
        radius, length = 0.5 * sizes["bore"], sizes["hub_width"]
        deep = radius + key_of(sizes["bore"], "blank.bore").in_hub
        segment = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
        return length * (deep * width - segment)
    own = shaft_sizes(pair, blanks)
    radius = 0.5 * own["shaft_diameter"]
    deep = radius - key_of(own["shaft_diameter"], "blank.shaft_diameter").in_shaft
    segment = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
    return length * (segment - deep * width)
