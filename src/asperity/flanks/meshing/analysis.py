"""Tooth contact analysis of a worm and its wheel: one call for all that is known of both flanks."""

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.meshing.backlash import Play, play, set_backlash
from asperity.flanks.meshing.contact_lines import ContactLines, contact_lines
from asperity.flanks.meshing.ease_off import EaseOff, ease_off
from asperity.flanks.meshing.kinematics import Kinematics, kinematics
from asperity.flanks.meshing.lubrication import Load, LoadedLines, loaded_lines
from asperity.flanks.meshing.pattern.area import node_areas
from asperity.flanks.meshing.pattern.marking import MARKING, Pattern, pattern
from asperity.flanks.meshing.transmission import SAMPLES, Transmission, transmission
from asperity.flanks.meshing.vibration_share import VibrationShare, vibration_share
from asperity.flanks.wheel.conjugacy import conjugacy_residual
from asperity.flanks.wheel.enveloped import FlankGrid, Wheel
from asperity.flanks.worm.setting import Pair

if TYPE_CHECKING:
    import xarray as xr

ROWS, COLUMNS = 41, 49
"""Points of a flank that the maps are made of, along its height and across its face."""

_MICROMETRES = 1e3
_ANGLES = 8


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class FlankAnalysis:
    """What is known of one flank of the wheel. Maps have the shape of the grid.

    All is in the right-handed frame; `to_json` and `to_dataset` answer in the gearset's own.

    Attributes
    ----------
    side : int
        :math:`s`, 1 or -1.
    transmission : Transmission
        Transmission error over a pitch.
    grid : FlankGrid
        Points of the flank.
    pattern : Pattern
        Contact pattern and smallest gap.
    ease_off : EaseOff
        Against the wheel of an identical hob.
    motion : Kinematics
        Velocities and curvatures where each point is nearest to the worm.
    share : VibrationShare
        What each vibration direction touches of the sliding.
    play : Play
        Backlash and axial clearance.
    undercut : bool
        Whether the hob undercuts the flank anywhere.
    conjugacy_residual : float
        Largest distance of a point, at its own phase, to the hob that made it, mm.
    loaded : tuple of LoadedLines
        Contact lines under load at angles of the worm over a pitch; empty without a load.
    """

    side: int
    transmission: Transmission
    grid: FlankGrid
    pattern: Pattern
    ease_off: EaseOff
    motion: Kinematics
    share: VibrationShare
    play: Play
    undercut: bool
    conjugacy_residual: float
    loaded: tuple[LoadedLines, ...] = ()

    @property
    def pair(self) -> Pair:
        """Worm and wheel, the worm with the threads that leave the backlash asked for."""
        return self.transmission.search.pair

    @property
    def mirror(self) -> int:
        """Sign of Z between the right-handed frame and the gearset's own."""
        return self.pair.mirror

    @property
    def vibration(self) -> dict[str, dict[str, float]]:
        """Root mean square of the parts of each vibration direction.

        Over the marked area; over all of the flank that the worm reaches where nothing is marked.
        """
        area = node_areas(self.grid.points)
        marked = self.pattern.marked & self.motion.on_flank
        return self.share.mean(area * (marked if marked.any() else self.motion.on_flank))

    def contact_lines(self, worm_angle: float) -> ContactLines:
        """Return the contact lines of all teeth at an angle of the worm, rad."""
        return contact_lines(self.motion, self.grid, self.pair.geometry.starts, worm_angle)

    def to_json(self) -> dict[str, Any]:
        """Scalar results, each key with its unit, in the gearset's own frame."""
        face, radial = self.pattern.centre
        answer: dict[str, Any] = {
            "transmission_error_rad": self.transmission.peak_to_peak,
            "transmission_error_mean_rad": self.transmission.mean,
            "contact_ratio": self.transmission.contact_ratio(),
            "contact_ratio_marked": self.transmission.contact_ratio(self.pattern.thickness),
            "backlash_normal_mm": self.play.normal[self.side],
            "axial_clearance_mm": self.play.axial,
            "axial_amplitude_max_mm": self.play.amplitude,
            "ease_off_max_um": _MICROMETRES * self.ease_off.largest,
            "ease_off_min_um": _MICROMETRES * self.ease_off.smallest,
            "pattern_area_fraction": self.pattern.area_fraction,
            "pattern_centre_mm": [self.mirror * face, radial],
            "undercut": self.undercut,
            "conjugacy_residual_mm": self.conjugacy_residual,
            "vibration": self.vibration,
        }
        if self.loaded:
            answer["loaded"] = [lines.to_json() for lines in self.loaded]
        return answer

    def to_dataset(self) -> "xr.Dataset":
        """Return maps over the flank and curves over a pitch, in the gearset's own frame."""
        from asperity.flanks.analysis_dataset import to_dataset

        return to_dataset(self)


@dataclasses.dataclass(frozen=True, eq=False)
class Analysis:
    """Both flanks of a wheel.

    Attributes
    ----------
    pair : Pair
        Worm and wheel, the worm with the threads that leave the backlash asked for.
    play : Play
        Backlash and axial clearance.
    flanks : mapping of int to FlankAnalysis
        By side, 1 and -1.
    """

    pair: Pair
    play: Play
    flanks: Mapping[int, FlankAnalysis]

    def to_json(self) -> dict[str, Any]:
        """Scalar results of the worm, of the flank s = +1, and of both by side under ``flanks``."""
        worm = self.pair.worm
        base = worm.profile.base_radius
        return {
            "lead_angle_deg": math.degrees(worm.lead_angle),
            "base_radius_mm": base,
            "base_lead_angle_deg": None
            if base is None
            else math.degrees(math.atan2(worm.reduced_lead, base)),
            **self.flanks[1].to_json(),
            "flanks": {f"{side:+d}": flank.to_json() for side, flank in self.flanks.items()},
        }


def analyse(
    pair: Pair,
    wheel: Wheel,
    *,
    rows: int = ROWS,
    columns: int = COLUMNS,
    samples: int = SAMPLES,
    thickness: float = MARKING,
    worm_speed: float = 1.0,
    load: Load | None = None,
) -> Analysis:
    r"""Analyse the contact of a worm with its wheel, on both flanks.

    Parameters
    ----------
    pair : Pair
        The worm and how it stands. Where it asks for a backlash, the thickness of its threads is
        solved for; else it is as it is.
    wheel : Wheel
        The wheel as it is cut.
    rows, columns : int
        Points of the maps over a flank.
    samples : int
        Places of the wheel in a pitch.
    thickness : float
        Of the marking compound, mm.
    worm_speed : float
        :math:`\omega_1` of the velocities, rad/s; that of the load where there is one.
    load : Load, optional
        For load, pressure and film along the contact lines.

    Raises
    ------
    InputError
        The backlash asked for is more than the worm's threads have.
    ConvergenceError
        The worm does not reach the wheel's teeth all over the pitch.
    """
    meshes = {side: transmission(pair, wheel.flank(side), samples) for side in (1, -1)}
    if pair.backlash is not None:
        meshes = set_backlash(meshes, pair.backlash)
    free = play(meshes)
    speed = worm_speed if load is None else load.worm_speed
    flanks = {
        side: _flank(meshes[side], free, rows, columns, thickness, speed, load) for side in (1, -1)
    }
    return Analysis(meshes[1].search.pair, free, flanks)


def _flank(
    mesh: Transmission,
    free: Play,
    n_radial: int,
    n_face: int,
    thickness: float,
    speed: float,
    load: Load | None,
) -> FlankAnalysis:
    flank, pair = mesh.search.flank, mesh.search.pair
    grid = flank.grid(n_radial, n_face)
    motion = kinematics(pair, grid, flank.side, speed, mesh.ahead)
    loaded = []
    if load is not None:
        starts = pair.geometry.starts
        for n in range(_ANGLES):
            angle = 2.0 * math.pi / starts * n / _ANGLES
            loaded.append(loaded_lines(mesh, contact_lines(motion, grid, starts, angle), load))
    return FlankAnalysis(
        side=flank.side,
        transmission=mesh,
        grid=grid,
        pattern=pattern(mesh, grid, thickness),
        ease_off=ease_off(flank, grid),
        motion=motion,
        share=vibration_share(pair, motion),
        play=free,
        undercut=bool(flank.undercut_at(grid.z[0]).any()),
        conjugacy_residual=float(np.abs(conjugacy_residual(flank, grid)).max()),
        loaded=tuple(loaded),
    )
