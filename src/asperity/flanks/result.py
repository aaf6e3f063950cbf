"""What is found of the flanks of a worm gearset."""

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.backlash import Play
from asperity.flanks.ease_off import EaseOff
from asperity.flanks.kinematics import Kinematics
from asperity.flanks.pattern import Pattern
from asperity.flanks.pattern_area import node_areas
from asperity.flanks.plots import (
    FlankMap,
    plot_contact_lines,
    plot_ease_off,
    plot_pattern,
    plot_transmission_error,
    plot_vibration,
)
from asperity.flanks.profiles import FloatArray
from asperity.flanks.transmission import Transmission
from asperity.flanks.vibration_share import DIRECTIONS, PARTS, VibrationShare
from asperity.flanks.wheel import FlankGrid, Wheel
from asperity.mesh import HexMesh

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure
    from rich.console import Group

MICROMETRES = 1e3
"""Of a millimetre."""

SHAKEN = {"axial": "worm, axial", "torsional": "worm, torsional", "wheel_axial": "wheel, axial"}
"""The directions of a vibration that are drawn, by their names in `VibrationShare`."""


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FlankResult:
    """What is found of one flank.

    Attributes
    ----------
    side : int
        Which, 1 or -1.
    mirror : int
        -1 if the gearset is left-handed: what was calculated is its mirror image.
    transmission : Transmission
        How the mesh transmits over a pitch.
    pattern : Pattern
        Where the flank bears, and the smallest gap at the points of its grid.
    ease_off : EaseOff
        How far it stands back from that of an identical hob.
    motion : Kinematics
        Velocities and curvatures where each point is nearest to the worm.
    share : VibrationShare
        Parts of a vibration at each point.
    area : float
        Of the trimmed flank, mm^2.
    undercut : bool
        Whether the hob cuts into it.
    conjugacy_residual : float
        Largest distance of a point to the hob that makes it, mm.
    """

    side: int
    mirror: int
    transmission: Transmission
    pattern: Pattern
    ease_off: EaseOff
    motion: Kinematics
    share: VibrationShare
    area: float
    undercut: bool
    conjugacy_residual: float

    @property
    def grid(self) -> FlankGrid:
        """The points."""
        return self.pattern.grid

    @property
    def vibration(self) -> dict[str, dict[str, float]]:
        """Root mean squares over the flank of the parts of each vibration."""
        # Beside the flank the worm is nearest with its tip, where nothing slides.
        return self.share.mean(node_areas(self.grid.points) * self.motion.on_flank)

    def map(self, values: FloatArray) -> FlankMap:
        """Return values at the points as they are drawn, in the gearset's own frame."""
        return FlankMap(self.side, self.mirror * self.grid.z, self.grid.radius, values)

    def to_json(self) -> dict[str, Any]:
        """Return the numbers by name and unit."""
        face, radial = self.pattern.centre
        return {
            "transmission_error_rad": self.transmission.peak_to_peak,
            "transmission_error_mean_rad": self.transmission.mean,
            "ease_off_max_um": MICROMETRES * self.ease_off.largest,
            "ease_off_min_um": MICROMETRES * self.ease_off.smallest,
            "pattern_area_fraction": self.pattern.area_fraction,
            "pattern_centre_mm": [self.mirror * face, radial],
            "undercut": self.undercut,
            "conjugacy_residual_mm": self.conjugacy_residual,
            "flank_area_mm2": self.area,
            "vibration": self.vibration,
        }


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
    flanks : mapping of int to FlankResult
        Each flank by its side, 1 and -1.
    play : Play
        Backlash and axial clearance.
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
    flanks: Mapping[int, FlankResult]
    play: Play
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
        return min(self.play.normal.values())

    @property
    def pitch(self) -> float:
        """Angle of the worm from one tooth of the wheel to the next, rad."""
        return 2.0 * math.pi / self.wheel.pair.geometry.starts

    def to_json(self) -> dict[str, Any]:
        """Return the numbers by name and unit: those of the flank s = +1, and both in ``flanks``.

        ``base_radius_mm`` and ``base_lead_angle_deg`` are None for flanks without a base cylinder.
        """
        pair = self.wheel.pair
        g = pair.geometry
        quality = self.mesh.scaled_jacobian()
        return {
            "name": self.name,
            "flank": pair.flank,
            "hand": pair.hand,
            "lead_angle_deg": math.degrees(g.lead_angle),
            "base_radius_mm": g.base_radius,
            "base_lead_angle_deg": (
                None if g.base_lead_angle is None else math.degrees(g.base_lead_angle)
            ),
            **self.flanks[1].to_json(),
            "backlash_normal_mm": self.backlash,
            "axial_clearance_mm": self.play.axial,
            "flanks": {f"{side:+d}": found.to_json() for side, found in self.flanks.items()},
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
        found = list(self.flanks.values())
        middle = self.wheel.pair.geometry.wheel_mean_diameter / 2.0
        centres = [
            (flank.mirror * flank.pattern.centre[0], middle + flank.pattern.centre[1])
            for flank in found
        ]
        phases = [
            flank.map(np.where(flank.motion.on_flank, flank.motion.phase, np.nan))
            for flank in found
        ]
        one = self.flanks[1]
        angle = one.transmission.wheel_angle
        closed = np.append(angle, one.transmission.search.pitch) * self.wheel.pair.ratio
        errors = {
            side: np.append(flank.transmission.error, flank.transmission.error[0])
            for side, flank in self.flanks.items()
        }
        return {
            "pattern": plot_pattern(
                [flank.map(MICROMETRES * flank.pattern.gap) for flank in found],
                MICROMETRES * one.pattern.thickness,
                centres,
            ),
            "ease-off": plot_ease_off(
                [flank.map(MICROMETRES * flank.ease_off.distance) for flank in found]
            ),
            "contact-lines": plot_contact_lines(phases, self.pitch),
            "transmission-error": plot_transmission_error(closed, errors, self.pitch),
            "vibration": plot_vibration(
                {
                    direction: {part: one.map(one.share.of(direction, part)) for part in PARTS}
                    for direction in DIRECTIONS
                    if direction in SHAKEN
                },
                SHAKEN,
            ),
        }
