"""What is found of the flanks of a worm gearset."""

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.meshing.analysis import Analysis, FlankAnalysis
from asperity.flanks.meshing.vibration_share import PARTS
from asperity.flanks.plots import (
    FlankMap,
    plot_contact_lines,
    plot_ease_off,
    plot_pattern,
    plot_transmission_error,
    plot_vibration,
)
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.profiles import FloatArray
from asperity.mesh import HexMesh

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure
    from rich.console import Group

MICROMETRES = 1e3
"""Of a millimetre."""

_SHAKEN = {"axial": "worm, axial", "torsional": "worm, torsional", "wheel_axial": "wheel, axial"}


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FlankStudy:
    """The flanks of a worm gearset: how they were made, how they touch, and a mesh.

    Attributes
    ----------
    name : str
        Of the gearset.
    wheel : Wheel
        The wheel as it is cut, with the pair it belongs to; the worm's threads are as thick as the
        backlash asks for.
    analysis : Analysis
        How both flanks touch.
    mesh : HexMesh
        One tooth with its share of the rim.
    density : str
        As it was asked for.
    element_size : float
        On the flank, mm.
    assumed, from_memory : mapping of str to str
        What was not given, and what no document at hand confirms.
    notes : tuple of str
        What else a reader of the numbers should know.
    seconds : float
        What it took.
    """

    name: str
    wheel: Wheel
    analysis: Analysis
    mesh: HexMesh
    density: str
    element_size: float
    assumed: Mapping[str, str]
    from_memory: Mapping[str, str]
    notes: tuple[str, ...]
    seconds: float

    @property
    def backlash(self) -> float:
        """Least play normal to the flanks, mm."""
        return min(self.analysis.play.normal.values())

    def to_json(self) -> dict[str, Any]:
        """Return the numbers by name and unit: those of the flank s = +1, and both in ``flanks``.

        ``base_radius_mm`` and ``base_lead_angle_deg`` are None for flanks without a base cylinder.
        """
        pair = self.analysis.pair
        g = pair.geometry
        quality = self.mesh.scaled_jacobian()
        return {
            "name": self.name,
            "flank": pair.flank,
            "hand": pair.hand,
            **self.analysis.to_json(),
            "backlash_normal_mm": self.backlash,
            "pitch_radius_mm": g.wheel_mean_diameter / 2.0,
            "flank_area_mm2": self.wheel.flank(1).area(),
            "hob": {
                "pitch_diameter_mm": 2.0 * pair.hob.pitch_radius,
                "lead_angle_deg": math.degrees(pair.hob.lead_angle),
                "tip_rounding_mm": pair.hob.tip_rounding,
                "centre_distance_mm": pair.cutting.centre_distance,
                "tilt_deg": math.degrees(pair.cutting.tilt),
            },
            "worm": {
                "tip_rounding_mm": pair.worm.tip_rounding,
                "thread_thickness_mm": 2.0 * (pair.worm.half_pitch - pair.worm.half_space),
            },
            "mesh": {
                "density": self.density,
                "element_size_mm": self.element_size,
                "nodes": len(self.mesh.points),
                "elements": len(self.mesh.cells),
                "scaled_jacobian_min": float(quality.min()),
                "scaled_jacobian_median": float(np.median(quality)),
                "volume_mm3": self.mesh.volume(),
            },
            "seconds": self.seconds,
            "assumed": dict(self.assumed),
            "from_memory": dict(self.from_memory),
            "notes": list(self.notes),
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return what lies over the flanks and over a pitch, labelled, in the gearset's frame."""
        from asperity.flanks.dataset import flank_dataset

        return flank_dataset(self)

    def to_rich(self) -> "Group":
        """Return tables for the terminal, with notes below them."""
        from asperity.flanks.report import to_rich

        return to_rich(self)

    def pictures(self) -> "dict[str, Figure]":
        """Return the pictures by name."""
        found = list(self.analysis.flanks.values())
        one = self.analysis.flanks[1]
        g = self.analysis.pair.geometry
        pitch = 2.0 * math.pi / g.starts
        centres = [
            (
                flank.mirror * flank.pattern.centre[0],
                g.wheel_mean_diameter / 2.0 + flank.pattern.centre[1],
            )
            for flank in found
        ]
        phases = [np.where(flank.motion.on_flank, flank.motion.phase, np.nan) for flank in found]
        removed = [
            np.where(flank.ease_off.compared, MICROMETRES * flank.ease_off.distance, np.nan)
            for flank in found
        ]
        # A period ends where the next begins.
        angle = g.gear_ratio * np.append(
            one.transmission.wheel_angle, 2.0 * math.pi / g.wheel_teeth
        )
        errors = {
            flank.side: np.append(flank.transmission.error, flank.transmission.error[0])
            for flank in found
        }
        # Across is a normal times a velocity, and turns round in a mirror.
        sign = {"across": one.mirror}
        shaken = {
            direction: {
                part: _map(one, sign.get(part, 1) * one.share.of(direction, part)) for part in PARTS
            }
            for direction in _SHAKEN
        }
        return {
            "pattern": plot_pattern(
                [_map(flank, MICROMETRES * flank.pattern.gap) for flank in found],
                MICROMETRES * one.pattern.thickness,
                centres,
            ),
            "ease-off": plot_ease_off(
                [_map(flank, values) for flank, values in zip(found, removed, strict=True)]
            ),
            "contact-lines": plot_contact_lines(
                [_map(flank, phase) for flank, phase in zip(found, phases, strict=True)], pitch
            ),
            "transmission-error": plot_transmission_error(angle, errors, pitch),
            "vibration": plot_vibration(shaken, _SHAKEN),
        }


def _map(flank: FlankAnalysis, values: FloatArray) -> FlankMap:
    """Values at the points of a flank as they are drawn, in the gearset's own frame."""
    return FlankMap(flank.side, flank.mirror * flank.grid.z, flank.grid.radius, values)
