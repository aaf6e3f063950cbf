"""Figures of chapter 2 about the flanks of worm and wheel; drawn by `drawings_flanks`."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.meshing.pattern import MARKING, Pattern, pattern
from asperity.flanks.wheel.flank import FlankGrid
from asperity.results.dataset import described
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.flanks import drawings
from asperity.thesis.flanks.meshing import Gear, Meshing, meshing, pair_of
from asperity.thesis.flanks.shapes import Shape, joined

if TYPE_CHECKING:
    pass

_CASE = "gearset-3b"
_MICROMETRES = 1e3
_ANGLES = 24
_INSTANTS = 5
_TEETH = 3
_ROWS, _COLUMNS = 81, 121

_FROM_PITCH_LINE = "modification.tip_relief_start=0"
_PLAIN = Gear(_CASE, ("hob.oversize=1", "hob.tilt=0 deg"))
_ASKEW = _PLAIN.plus("mount.shaft_angle_error=-0.1 deg")

DESIGNS = {
    "misaligned": _ASKEW,
    "lead": _ASKEW.plus("modification.lead_correction=0.07 deg"),
    "over_relieved": _PLAIN.plus(
        "modification.tip_relief=80 um", "modification.tip_relief_start=0"
    ),
    "relieved": _PLAIN.plus("modification.tip_relief=10 um"),
}
"""What figure 2.9 compares."""

HOBS = {
    "a": _PLAIN,
    "b": _ASKEW.plus("mount.centre_distance_error=0.05 mm"),
    "c": Gear(_CASE),
}
"""What figure 2.10 compares."""

TILTS = {0.0: Gear(_CASE, ("hob.tilt=0 deg",)), 2.0: Gear(_CASE)}
"""What figure 2.11 compares, by the hob's tilt in degrees."""

EPS = Gear(_CASE, ("modification.tip_relief=30 um", _FROM_PITCH_LINE))
"""The worm of figure 2.13."""

LOADS = {
    name: EPS.plus(
        f"operation.output_torque={torque:g} N m",
        f"operation.through_travel_torque={torque / 3.0:g} N m",
    )
    for name, torque in (("low", 18.3), ("high", 366.0))
}
"""What figure 2.12 compares."""


@figure("2.9", drawings.pressures, DESIGNS)
@figure("2.12", drawings.pressures, LOADS)
def _lines(gears: Mapping[str, Gear]) -> Computed:
    """Contact lines of some gearsets under their torque."""
    variables: dict[str, Any] = {}
    for name, gear in gears.items():
        found = meshing(gear)
        lines = found.loaded(_ANGLES)
        grid = found.grid
        ends = (
            np.stack([at.lines.at_ends(grid.z), at.lines.at_ends(grid.radius)], axis=-1)
            for at in lines
        )
        place = [end[at.carrying] for end, at in zip(ends, lines, strict=True)]
        pressure = [at.pressure[at.carrying] for at in lines]
        piece = f"{name}_piece"
        variables |= {
            f"{name}_place": (
                (piece, "end", "axis"), np.concatenate(place), "mm",
                "ends of each piece of a contact line: from mid-face, from the wheel's axis",
            ),
            f"{name}_pressure": (
                (piece,), np.concatenate(pressure), "MPa", "Hertzian pressure on it",
            ),
            f"{name}_outline": (
                (f"{name}_corner", "axis"), _outline(found), "mm", "edge of the flank",
            ),
            f"{name}_length": (
                (), float(np.mean([at.lines.length[at.carrying].sum() for at in lines])), "mm",
                "mean length of the lines that carry",
            ),
        }  # fmt: skip
    return described(**variables), [
        *gears.values(), "asperity.flanks.meshing.lubrication.loaded_lines"
    ]  # fmt: skip


def _outline(found: Meshing) -> Any:
    place = np.stack([found.grid.z, found.grid.radius], axis=-1)
    return np.concatenate([place[0], place[1:, -1], place[-1, -2::-1], place[-2::-1, 0]])


@figure("2.10", drawings.formation)
def _formation() -> Computed:
    fields: dict[str, list[Any]] = {key: [] for key in ("face", "height", "phase", "instant")}
    moving: dict[str, list[Any]] = {key: [] for key in ("gap", "worm_radius", "thread")}
    for gear in HOBS.values():
        found = meshing(gear)
        near = found.motion.on_flank & (found.motion.gap < MARKING)
        touched = found.motion.phase[near]
        low, high = float(touched.min()), float(touched.max())
        instants = low + (high - low) * (0.5 + np.arange(_INSTANTS)) / _INSTANTS
        at = [found.in_worm(float(angle)) for angle in instants]
        fields["face"].append(found.grid.z)
        fields["height"].append(found.grid.radius)
        fields["phase"].append(np.degrees(found.motion.phase))
        fields["instant"].append(np.degrees(instants))
        moving["gap"].append([_MICROMETRES * gap for gap, _, _ in at])
        moving["worm_radius"].append([radius for _, radius, _ in at])
        moving["thread"].append([np.degrees(thread) for _, _, thread in at])
    worm = meshing(HOBS["a"]).wheel.pair.worm
    flank = ("design", "row", "column")
    each = ("design", "time", "row", "column")
    dataset = described(
        design=(("design",), np.array(list(HOBS), dtype=object), "1", "design"),
        face=(flank, fields["face"], "mm", "distance from mid-face"),
        radius=(flank, fields["height"], "mm", "distance from the wheel's axis"),
        phase=(flank, fields["phase"], "deg", "angle of the worm when it is nearest"),
        instant=(("design", "time"), fields["instant"], "deg", "angle of the worm"),
        gap=(each, moving["gap"], "um", "distance from the worm at an instant"),
        worm_radius=(each, moving["worm_radius"], "mm", "distance from the worm's axis then"),
        thread=(each, moving["thread"], "deg", "place along the worm's thread then"),
        worm_root=((), worm.root_radius, "mm", "root radius of the worm"),
        worm_tip=((), worm.tip_radius, "mm", "tip radius of the worm"),
        film=((), _MICROMETRES * MARKING, "um", "gap that counts as contact"),
    )  # fmt: skip
    return dataset, [*HOBS.values(), "asperity.thesis.flanks.meshing.Meshing.in_worm"]


@figure("2.11", drawings.dye)
def _dye() -> Computed:
    variables: dict[str, Any] = {}
    gaps, faces, heights, shares, centres = [], [], [], [], []
    for tilt, gear in TILTS.items():
        found = meshing(gear)
        grid = found.wheel.flank(1).grid(_ROWS, _COLUMNS)
        marks = pattern(found.transmission, grid)
        gaps.append(_MICROMETRES * marks.gap)
        faces.append(grid.z)
        heights.append(grid.radius)
        shares.append(marks.area_fraction)
        centres.append(marks.centre[0])
        variables |= _dyed(found, grid, marks).variables(f"teeth_{tilt:g}")
    flank = ("tilt", "row", "column")
    dataset = described(
        tilt=(("tilt",), list(TILTS), "deg", "tilt of the hob"),
        gap=(flank, gaps, "um", "smallest distance from the worm"),
        face=(flank, faces, "mm", "distance from mid-face"),
        radius=(flank, heights, "mm", "distance from the wheel's axis"),
        marked_share=(("tilt",), shares, "1", "share of the flank that is marked"),
        centre=(("tilt",), centres, "mm", "middle of the mark, from mid-face"),
        film=((), _MICROMETRES * MARKING, "um", "thickness of the dye"),
        **variables,
    )
    return dataset, [*TILTS.values()]


def _dyed(found: Meshing, grid: FlankGrid, marks: Pattern) -> Shape:
    """Some teeth, the flanks that bear in fine faces, those that are marked with the number 1."""
    mesh = tooth(found.wheel, "coarse", teeth=_TEETH)
    sets = [name for name in mesh.face_sets if name.split("_")[0] in ("fillet", "tip", "face")]
    sets += ["flank_minus", "cut_minus", "cut_plus"]
    bare = Shape.of_mesh(mesh, [name for name in sets if not name[-1].isdigit()])
    corners = [marks.gap[:-1, :-1], marks.gap[1:, :-1], marks.gap[1:, 1:], marks.gap[:-1, 1:]]
    dyed = np.mean(corners, axis=0) < marks.thickness
    pitch = 2.0 * math.pi / found.wheel.pair.geometry.wheel_teeth
    flank = Shape.of_grid(grid.points, dyed.reshape(-1))
    flanks = [flank.turned(pitch * number) for number in range(_TEETH)]
    return joined([bare, *flanks]).turned(-pitch * (_TEETH // 2))


@figure("2.13", drawings.modified_profile)
def _profile() -> Computed:
    modified = pair_of(EPS).worm
    plain = pair_of(Gear(_CASE)).worm
    place = np.linspace(0.0, 2.0, 401)
    radius, axial, _, _ = plain.curve(place)
    # At equal radii, so that the difference is the modification and not the way along the curve.
    end = min(plain.flank_end, modified.flank_end)
    height = np.linspace(plain.root_radius, end, 201)
    normal = math.cos(plain.lead_angle) * math.cos(plain.pressure_angle)
    relief = _MICROMETRES * normal * (modified.width(height)[0] - plain.width(height)[0])
    dataset = described(
        outline_radius=(("place",), radius, "mm", "the plain thread: distance from the axis"),
        outline_axial=(
            ("place",), plain.half_pitch - axial, "mm", "the plain thread: from its middle",
        ),
        radius=(("height",), height, "mm", "distance from the worm's axis"),
        axial=(("height",), plain.half_pitch - plain.width(height)[0], "mm", "half the thread"),
        relief=(("height",), relief, "um", "what is taken off, normal to the flank"),
        pitch_radius=((), plain.pitch_radius, "mm", "pitch radius"),
        tip_radius=((), plain.tip_radius, "mm", "tip radius"),
        root_radius=((), plain.root_radius, "mm", "root radius"),
        normal=((), normal, "1", "normal over axial distance between flanks"),
    )  # fmt: skip
    return dataset, [EPS, "asperity.flanks.worm.helicoid.Helicoid.width"]
