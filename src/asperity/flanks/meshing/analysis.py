"""Tooth contact analysis of a worm and its wheel: one call for all that is known of both flanks."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.meshing.backlash import Play, play, set_backlash
from asperity.flanks.meshing.contact_lines import ContactLines, contact_lines
from asperity.flanks.meshing.ease_off import EaseOff, ease_off
from asperity.flanks.meshing.kinematics import Kinematics, kinematics
from asperity.flanks.meshing.lubrication import (
    Load,
    LoadedLines,
    NormalLoading,
    loaded_lines,
    pressed_lines,
)
from asperity.flanks.meshing.pattern import Pattern, node_areas, pattern
from asperity.flanks.meshing.transmission import SAMPLES, Transmission, transmission
from asperity.flanks.meshing.vibration_share import (
    DIRECTIONS,
    PARTS,
    VibrationShare,
    vibration_share,
)
from asperity.flanks.sides import both
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import RESOLVED, FlankGrid
from asperity.flanks.worm.setting import Pair
from asperity.results import Quantities, labelled, part, quantity
from asperity.results.dataset import Labels, to_dataset

if TYPE_CHECKING:
    import xarray as xr

ROWS, COLUMNS = 41, 49
"""Points of a flank that the maps are made of, along its height and across its face."""

MICROMETRES = 1e3
"""Of a millimetre."""

LABELS: Labels = {
    "axis": (("x", "y", "z"), "axes of the wheel, the third its own"),
    "direction": (DIRECTIONS, "direction of the vibration"),
    "part": (PARTS, "along and across the sliding velocity, along the normal"),
}

# Angles of the worm over a pitch at which the load is found: for numbers, and for maps.
_ANGLES, _MAPPED = 8, 32
# What changes its sign in the mirror image Z -> -Z. Across the sliding is a normal times a
# velocity, and turns round.
_MIRRORED: dict[str, float | tuple[float, ...]] = {
    "face": -1.0,
    "contact_face": -1.0,
    "point": (1.0, 1.0, -1.0),
    "flank_normal": (1.0, 1.0, -1.0),
    "sliding": (1.0, 1.0, -1.0),
    "vibration": (1.0, -1.0, 1.0),
}


class FlankAnalysis(Quantities):
    """What is known of one flank of the wheel. Maps have the shape of the grid.

    All is in the right-handed frame; `to_json` and `to_dataset` answer in the gearset's own.

    Attributes
    ----------
    motion : Kinematics
        Velocities and curvatures where each point is nearest to the worm.
    loaded : tuple of LoadedLines
        Contact lines under load at angles of the worm over a pitch; empty without a load.
    load : Load, optional
        What they are under.
    """

    transmission: Transmission = part(Transmission)
    ease_off: EaseOff = part(EaseOff)
    pattern: Pattern = part(Pattern)
    grid: FlankGrid = part(FlankGrid)
    motion: Kinematics = part(Kinematics)
    share: VibrationShare = part(VibrationShare)
    undercut: bool = quantity("", "", "undercut")
    conjugacy_residual: float = quantity("", "mm", "distance to the hob that cuts it")
    side: int
    play: Play
    loaded: tuple[LoadedLines, ...] = ()
    load: Load | None = None

    @property
    @labelled("", "mm", "centre of the pattern: face, radial", only="json")
    def pattern_centre(self) -> tuple[float, float]:
        """From mid-face and from the pitch radius outwards, in the gearset's own frame, mm."""
        face, radial = self.pattern.centre
        return self.mirror * face, radial

    @property
    @labelled("", "mm", "centre of the pattern, from mid-face", only="file", shown=False)
    def pattern_face(self) -> float:
        """Place of the pattern's centre across the face, mm."""
        return self.pattern_centre[0]

    @property
    @labelled("", "mm", "centre of the pattern, from the axis", only="file", shown=False)
    def pattern_radius(self) -> float:
        """Radius of the pattern's centre, mm."""
        return self.pair.geometry.wheel_mean_diameter / 2.0 + self.pattern_centre[1]

    @property
    @labelled("", "", "contact ratio, unloaded")
    def contact_ratio(self) -> float:
        """Mean number of teeth that bear, rigid."""
        return self.transmission.contact_ratio()

    @property
    @labelled("", "", "contact ratio, marked gaps as well")
    def contact_ratio_marked(self) -> float:
        """Mean number of teeth that bear or leave a gap that is marked."""
        return self.transmission.contact_ratio(self.pattern.thickness)

    @property
    @labelled("j_n", "mm", "backlash, normal, this flank bearing", shown=False)
    def backlash_normal(self) -> float:
        """Normal backlash while this flank bears, mm."""
        return self.play.normal[self.side]

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

    def under_load(self) -> tuple[LoadedLines, ...]:
        """Return the contact lines under load at angles of the worm over a pitch, for maps.

        None without a load. Errors as of `loaded_lines`.
        """
        if self.load is None:
            return ()
        return _over_a_pitch(self.transmission, self.motion, self.grid, self.load, _MAPPED)

    def line_load(self, loaded: Sequence[LoadedLines]) -> FloatArray:
        """Return the line load on the grid, N/mm: each point's when it lies on a contact line.

        How far the wheel yields is known at angles of the worm over a pitch, and linear between; 0
        where the worm does not touch.
        """
        assert self.load is not None
        pitch = 2.0 * math.pi / self.pair.geometry.starts
        at, twist = zip(*((lines.lines.worm_angle, lines.twist) for lines in loaded), strict=True)
        yields = np.interp(self.motion.phase, at, twist, period=pitch)
        return self.load.line_load(self.motion, yields)

    def resolution(self, name: str) -> float:
        """Return the size below which a quantity is rounding and shown as none, in its unit."""
        return RESOLVED if name in ("conjugacy_residual", "pattern_centre") else 0.0

    def to_json(self) -> dict[str, Any]:
        """Return the scalars, each key with its unit, in the gearset's own frame."""
        answer = {**super().to_json(), **self.play.to_json(), "vibration": self.vibration}
        if self.loaded:
            answer["loaded"] = [lines.numbers.to_json() for lines in self.loaded]
        return answer

    def to_dataset(self) -> "xr.Dataset":
        """Return maps over the flank and curves over a pitch, in the gearset's own frame, mm."""
        attributes = {"side": self.side, "hand": self.pair.hand, "flank": self.pair.flank}
        found = to_dataset(self, LABELS, attributes, title=f"flank s = {self.side:+d}")
        if self.mirror > 0:
            return found
        return found.assign(
            {
                name: found[name].copy(data=found[name].values * np.array(sign))
                for name, sign in _MIRRORED.items()
            }
        )


class Analysis(Quantities):
    """Both flanks of a wheel, by side: 1 and -1.

    The worm of the pair has the threads that leave the backlash asked for. Base radius and base
    lead angle are None for flanks without a base cylinder.
    """

    lead_angle: float = quantity("gamma", "deg", "lead angle")
    base_radius: float | None = quantity("r_b", "mm", "base radius")
    base_lead_angle: float | None = quantity("gamma_b", "deg", "base lead angle")
    play: Play = part(Play)
    pair: Pair
    flanks: Mapping[int, FlankAnalysis]

    def to_json(self) -> dict[str, Any]:
        """Scalar results of the worm, of the flank s = +1, and of both by side under ``flanks``."""
        return {
            **super().to_json(),
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
    worm_speed: float = 1.0,
    load: Load | None = None,
) -> Analysis:
    """Analyse the contact of a worm with its wheel, on both flanks.

    Where the pair asks for a backlash, the thickness of the worm's threads is solved for. Maps have
    ``rows`` and ``columns`` of points, a pitch ``samples`` places of the wheel. Velocities are at
    the worm's speed (rad/s), that of the load where there is one; with a load there are load,
    pressure and film along the contact lines.

    Raises
    ------
    InputError
        The backlash asked for is more than the worm's threads have.
    ConvergenceError
        The worm does not reach the wheel's teeth all over the pitch.
    """
    meshes = _meshes(pair, wheel, samples)
    free = play(meshes)
    speed = worm_speed if load is None else load.worm_speed
    flanks = both(lambda side: _flank(meshes[side], free, rows, columns, speed, load))
    thinned = meshes[1].search.pair
    worm, base = thinned.worm, thinned.worm.profile.base_radius
    return Analysis(
        lead_angle=math.degrees(worm.lead_angle),
        base_radius=base,
        base_lead_angle=base and math.degrees(math.atan2(worm.reduced_lead, base)),
        play=free,
        pair=thinned,
        flanks=flanks,
    )


def hertz_pressure_max(pair: Pair, wheel: Wheel, load: NormalLoading, side: int = 1) -> float:
    """Return the greatest Hertzian pressure on the contact lines of a flank over a pitch, MPa.

    It is that of `analyse` on the same maps and angles, without the rest.

    Raises
    ------
    InputError, ConvergenceError
        As of `analyse`, or no contact line bears the load.
    """
    mesh = _meshes(pair, wheel, SAMPLES)[side]
    flank = mesh.search.flank
    grid = flank.grid(ROWS, COLUMNS)
    motion = kinematics(mesh.search.pair, grid, side, load.worm_speed, mesh.ahead)
    return max(
        float(pressed_lines(mesh, lines, load).pressure.max())
        for lines in _lines_over_a_pitch(mesh, motion, grid, _ANGLES)
    )


def _meshes(pair: Pair, wheel: Wheel, samples: int) -> dict[int, Transmission]:
    """Both flanks in mesh, the worm's threads as thick as the backlash asked for leaves them."""
    meshes = both(lambda side: transmission(pair, wheel.flank(side), samples))
    return meshes if pair.backlash is None else set_backlash(meshes, pair.backlash)


def _flank(
    mesh: Transmission,
    free: Play,
    n_radial: int,
    n_face: int,
    speed: float,
    load: Load | None,
) -> FlankAnalysis:
    flank, pair = mesh.search.flank, mesh.search.pair
    grid = flank.grid(n_radial, n_face)
    motion = kinematics(pair, grid, flank.side, speed, mesh.ahead)
    loaded = () if load is None else _over_a_pitch(mesh, motion, grid, load, _ANGLES)
    return FlankAnalysis(
        side=flank.side,
        transmission=mesh,
        grid=grid,
        pattern=pattern(mesh, grid),
        ease_off=ease_off(flank, grid),
        motion=motion,
        share=vibration_share(pair, motion),
        play=free,
        undercut=bool(flank.undercut_at(grid.z[0]).any()),
        conjugacy_residual=float(np.abs(flank.conjugacy_residual(grid)).max()),
        loaded=loaded,
        load=load,
    )


def _over_a_pitch(
    mesh: Transmission, motion: Kinematics, grid: FlankGrid, load: Load, count: int
) -> tuple[LoadedLines, ...]:
    """Contact lines under load at so many angles of the worm over a pitch."""
    return tuple(
        loaded_lines(mesh, lines, load) for lines in _lines_over_a_pitch(mesh, motion, grid, count)
    )


def _lines_over_a_pitch(
    mesh: Transmission, motion: Kinematics, grid: FlankGrid, count: int
) -> Iterator[ContactLines]:
    """Yield the contact lines at so many angles of the worm over a pitch."""
    starts = mesh.search.pair.geometry.starts
    pitch = 2.0 * math.pi / starts
    for n in range(count):
        yield contact_lines(motion, grid, starts, pitch * n / count)
