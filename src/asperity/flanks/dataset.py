"""What is found over flanks and over a pitch as a labelled dataset."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.vibration_share import DIRECTIONS, PARTS

if TYPE_CHECKING:
    import xarray as xr

    from asperity.flanks.result import FlankStudy

_FLANK = ("side", "row", "column")
_POINT = (*_FLANK, "axis")


def flank_dataset(study: "FlankStudy") -> "xr.Dataset":
    """Return what lies over the flanks and over a pitch, every variable with its unit.

    Vectors are in the frame of the gearset's wheel. Velocities are those at the worm's speed of the
    attribute ``worm_speed_rad_per_s``.
    """
    import xarray as xr

    flanks = list(study.flanks.values())

    def each(values: Any) -> Any:
        return np.stack([values(flank) for flank in flanks])

    def mirrored(vectors: Any) -> Any:
        return vectors * [1.0, 1.0, flanks[0].mirror]

    variables: dict[str, tuple[tuple[str, ...], Any, str, str]] = {
        "face": (
            _FLANK,
            each(lambda f: f.mirror * f.grid.z),
            "mm",
            "distance from mid-face along the wheel's axis",
        ),
        "radius": (_FLANK, each(lambda f: f.grid.radius), "mm", "distance from the wheel's axis"),
        "point": (_POINT, each(lambda f: mirrored(f.grid.points)), "mm", "point of the tooth"),
        "normal": (_POINT, each(lambda f: mirrored(f.grid.normals)), "1", "normal of the tooth"),
        "ease_off": (
            _FLANK,
            each(lambda f: 1e3 * f.ease_off.distance),
            "um",
            "ease-off, positive where material was removed",
        ),
        "gap": (_FLANK, each(lambda f: 1e3 * f.pattern.gap), "um", "smallest gap to the worm"),
        "cut_phase": (
            _FLANK,
            each(lambda f: f.grid.phase),
            "rad",
            "angle of the hob when it cuts the point",
        ),
        "contact_phase": (
            _FLANK,
            each(lambda f: f.motion.phase),
            "rad",
            "angle of the worm when it is nearest to the point",
        ),
        "on_flank": (
            _FLANK,
            each(lambda f: f.motion.on_flank.astype(np.int8)),
            "1",
            "1 where the worm is nearest with its flank, 0 where with its tip",
        ),
        "sliding_speed": (
            _FLANK,
            each(lambda f: f.motion.sliding_speed),
            "mm/s",
            "sliding speed of the worm on the wheel",
        ),
        "entrainment_speed": (
            _FLANK,
            each(lambda f: f.motion.entrainment),
            "mm/s",
            "speed that draws oil into the contact line",
        ),
        "line_curvature": (
            _FLANK,
            each(lambda f: f.motion.line_curvature),
            "1/mm",
            "relative curvature across the contact line",
        ),
        "vibration": (
            (*_FLANK, "direction", "part"),
            each(lambda f: f.share.parts),
            "1",
            "part of a vibration's velocity at the point",
        ),
        "transmission_error": (
            ("side", "place"),
            each(lambda f: f.transmission.error),
            "rad",
            "how far the wheel is ahead, in the direction in which the flank drives it",
        ),
        "wheel_angle": (
            ("place",),
            flanks[0].transmission.wheel_angle,
            "rad",
            "angle of the wheel over a pitch",
        ),
    }
    coordinates: dict[str, tuple[tuple[str, ...], Any, str, str]] = {
        "side": (("side",), [f.side for f in flanks], "1", "flank s"),
        "axis": (("axis",), _words(("x", "y", "z")), "1", "axis of the wheel's frame"),
        "direction": (("direction",), _words(DIRECTIONS), "1", "what vibrates"),
        "part": (("part",), _words(PARTS), "1", "which way, seen from the sliding"),
    }
    return xr.Dataset(
        _labelled(variables),
        _labelled(coordinates),
        {
            "title": f"flanks of {study.name or 'a worm gearset'}",
            "worm_speed_rad_per_s": flanks[0].motion.worm_speed,
            "backlash_normal_mm": study.backlash,
            "axial_clearance_mm": study.play.axial,
        },
    )


def _labelled(group: dict[str, tuple[tuple[str, ...], Any, str, str]]) -> dict[str, Any]:
    return {
        name: (dims, values, {"units": units, "long_name": long_name})
        for name, (dims, values, units, long_name) in group.items()
    }


def _words(values: tuple[str, ...]) -> Any:
    return np.array(values, dtype=object)
