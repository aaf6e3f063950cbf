"""The analysis of a flank as a labelled dataset: maps over the flank, curves over a pitch."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.meshing.vibration_share import DIRECTIONS, PARTS
from asperity.flanks.worm.profiles import FloatArray

if TYPE_CHECKING:
    import xarray as xr

    from asperity.flanks.meshing.analysis import FlankAnalysis

_MAP = ("row", "column")
_AXES = ("x", "y", "z")


def to_dataset(flank: "FlankAnalysis") -> "xr.Dataset":
    """Return an analysis as a dataset, each variable with ``units`` and ``long_name``.

    Maps have the dimensions ``row`` (from the fillet to the tip) and ``column`` (across the face),
    vectors ``axis`` as well; curves over a pitch have ``place``. Lengths are in mm, in the
    gearset's own frame: those of a left-handed one are the mirror image of what was computed.
    """
    import xarray as xr

    mirror = flank.mirror
    grid, motion, mesh = flank.grid, flank.motion, flank.transmission
    variables: dict[str, Any] = {}

    def add(name: str, values: Any, units: str, long_name: str, *dims: str) -> None:
        variables[name] = (dims, values, {"units": units, "long_name": long_name})

    def vector(values: FloatArray) -> FloatArray:
        return np.asarray(values * np.array([1.0, 1.0, mirror]))

    def add_map(name: str, values: Any, units: str, long_name: str, *dims: str) -> None:
        add(name, values, units, long_name, *_MAP, *dims)

    add_map("radius", grid.radius, "mm", "distance from the wheel's axis")
    add_map("face", mirror * grid.z, "mm", "distance from mid-face along the wheel's axis")
    add_map("point", vector(grid.points), "mm", "point of the flank, in the wheel", "axis")
    add_map("flank_normal", vector(grid.normals), "1", "normal out of the tooth", "axis")
    add_map("gap", flank.pattern.gap, "mm", "smallest gap over all phases and teeth")
    add_map("ease_off", flank.ease_off.distance, "mm", "ease-off, positive where removed")
    add_map("compared", flank.ease_off.compared, "1", "whether an identical hob leaves a flank")
    add_map("phase", motion.phase, "rad", "angle of the worm at which the point is nearest to it")
    add_map("reach", motion.reach, "mm", "nearest place below the end of the worm's flank")
    add_map("sliding", vector(motion.sliding), "mm/s", "sliding velocity of the worm", "axis")
    add_map("sliding_speed", motion.sliding_speed, "mm/s", "size of the sliding velocity")
    add_map("worm_rolling", motion.worm_rolling, "mm/s", "worm's velocity over the contact line")
    add_map("wheel_rolling", motion.wheel_rolling, "mm/s", "wheel's velocity over the contact line")
    add_map("entrainment", motion.entrainment, "mm/s", "mean velocity over the contact line")
    for name in ("worm", "wheel", "relative"):
        values = getattr(motion, f"{name}_curvature")
        add_map(f"{name}_curvature", values, "1/mm", f"principal curvatures, {name}", "principal")
    add_map("line_curvature", motion.line_curvature, "1/mm", "relative, across the contact line")
    # Across is a normal times a velocity, and turns round in a mirror.
    parts = flank.share.parts * np.array([1.0, mirror, 1.0])
    add_map("vibration", parts, "1", "part of a unit vibration velocity", "direction", "part")

    add("wheel_angle", mesh.wheel_angle, "rad", "angle of the wheel", "place")
    add("worm_angle", mesh.worm_angle, "rad", "angle of the worm in contact", "place")
    add("transmission_error", mesh.error, "rad", "the wheel ahead of the worm", "place")
    add("contact_radius", mesh.contact[:, 0], "mm", "where it bears, from the axis", "place")
    add("contact_face", mirror * mesh.contact[:, 1], "mm", "where it bears, from mid-face", "place")
    coordinates = {
        "axis": _names(_AXES, "axes of the wheel, the third its own"),
        "direction": _names(DIRECTIONS, "direction of the vibration"),
        "part": _names(PARTS, "along and across the sliding velocity, along the normal"),
    }
    attributes = {"side": flank.side, "hand": flank.pair.hand, "flank": flank.pair.flank}
    return xr.Dataset(
        variables, {name: (name, *rest) for name, rest in coordinates.items()}, attributes
    )


def _names(names: tuple[str, ...], long_name: str) -> tuple[list[str], dict[str, str]]:
    return list(names), {"units": "", "long_name": long_name}
