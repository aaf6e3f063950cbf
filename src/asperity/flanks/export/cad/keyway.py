"""Keyways of DIN 6885-1 in the solids of shafts and of the wheel's bore.

Solids are made without a cut; a keyway, of planes alone, is cut from one that is closed.
"""

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from asperity.errors import ConvergenceError, InputError
from asperity.flanks.export.turned import Beside, Bodies, blanks_of, worm_shape
from asperity.flanks.worm.setting import Pair
from asperity.gearset.blanks import wheel_sizes
from asperity.gearset.keys import key_of
from asperity.shafts.shape import Shape

if TYPE_CHECKING:
    from asperity.flanks.export.cad.brep import Solid

_BEYOND = 1.0


class _Cut(NamedTuple):
    """What is cut away: a corner and the size of a box, mm; and the volume of it that is solid."""

    corner: tuple[float, float, float]
    size: tuple[float, float, float]
    volume: float


def require_keys(pair: Pair, beside: Beside) -> None:
    """Refuse keyways for which there is no key or no room; raises InputError."""
    blanks = blanks_of(beside)
    if blanks is not None and blanks.keyways in ("wheel", "both"):
        sizes = wheel_sizes(pair.geometry, blanks)
        key = key_of(sizes["bore"], "blank.bore")
        room = 0.5 * (sizes["hub_diameter"] - sizes["bore"])
        if key.in_hub >= room:
            raise InputError(
                f"blank.keyways is {blanks.keyways!r}; the hub's wall is {room:.4g} mm and its "
                f"keyway {key.in_hub:g} mm deep: take a larger blank.hub_diameter"
            )
    worm_shape(pair, beside)


def keyed(made: "Solid", pair: Pair, beside: Beside) -> "Solid":
    """Return a solid of worm, wheel or the wheel's shaft with its keyways, where there are any.

    Raises
    ------
    ConvergenceError
        What is left is no valid solid.
    """
    cuts = _cuts(made.name, pair, beside)
    if not cuts:
        return made
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Cut
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeBox
    from OCP.gp import gp_Pnt
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    from asperity.flanks.export.cad.brep import Solid, check

    shape: Any = made.shape
    for corner, size, _ in cuts:
        box = BRepPrimAPI_MakeBox(gp_Pnt(*corner), *size).Shape()
        found = TopExp_Explorer(BRepAlgoAPI_Cut(shape, box).Shape(), TopAbs_ShapeEnum.TopAbs_SOLID)
        if not found.More():
            raise ConvergenceError(f"the keyway leaves no solid of the {made.name}")
        shape = TopoDS.Solid(found.Current())
    seen = check(shape)
    if not seen.valid:
        raise ConvergenceError(f"the {made.name} with its keyway is no valid solid")
    return Solid(made.name, shape, seen)


def cut_volume(name: str, pair: Pair, beside: Beside) -> float:
    """Return the volume that keyways take from a body, chamfers left out, mm^3."""
    return sum(cut.volume for cut in _cuts(name, pair, beside))


def _cuts(name: str, pair: Pair, beside: Beside) -> list[_Cut]:
    """Return what is cut away from a body, in its frame."""
    if name == "worm":
        return _of_shaft(worm_shape(pair, beside), pair.mirror)
    if name == "wheel_shaft":
        wheel = beside.wheel if isinstance(beside, Bodies) else None
        return [] if wheel is None else _of_shaft(wheel, 1)
    blanks = blanks_of(beside)
    if name != "wheel" or blanks is None or blanks.keyways not in ("wheel", "both"):
        return []
    sizes = wheel_sizes(pair.geometry, blanks)
    key, width = key_of(sizes["bore"], "blank.bore"), sizes["hub_width"]
    outer = 0.5 * sizes["bore"] + key.in_hub
    half = 0.5 * width + _BEYOND
    volume = width * (outer * key.width - _segment(0.5 * sizes["bore"], key.width))
    return [_Cut((0.0, -0.5 * key.width, -half), (outer, key.width, 2.0 * half), volume)]


def _of_shaft(shape: Shape, mirror: int) -> list[_Cut]:
    made = []
    for way in shape.keyways:
        # A left-handed worm is the mirror image of a right-handed one, along its axis.
        low = shape.mesh - way.end if mirror > 0 else way.start - shape.mesh
        deep, length = 0.5 * way.diameter - way.depth, way.end - way.start
        volume = length * (_segment(0.5 * way.diameter, way.width) - deep * way.width)
        size = way.depth + _BEYOND, way.width, length
        made.append(_Cut((deep, -0.5 * way.width, low), size, volume))
    return made


def _segment(radius: float, width: float) -> float:
    """Return the area between a circle and a line across it through its middle, mm^2."""
    half = 0.5 * width
    return half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
