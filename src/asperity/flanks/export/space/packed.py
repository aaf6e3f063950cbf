"""What a page draws a worm gearset from in space: one small file of arrays (`mesh.packed`).

Lengths are in mm, angles in rad, the frame is the gearset's own: the wheel's axis is Z, the worm
lies above it.

At the angle phi the worm is turned by phi about the third axis of its own frame and then placed by
``worm.rotation`` and ``worm.place``; the wheel is turned by phi z_1/z_2 about Z, and by ``ahead``
of the flank that bears. The contact lines of that angle then lie on both.
"""

import dataclasses
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.patch import Body
from asperity.flanks.export.tooth import beside_flanks, shown_tooth
from asperity.flanks.export.turned import Beside, blanks_of
from asperity.flanks.export.worm import SHOWN, whole_worm
from asperity.flanks.meshing.analysis import MICROMETRES, Analysis, FlankAnalysis
from asperity.flanks.meshing.lubrication import LoadedLines
from asperity.flanks.wheel.enveloped import Wheel
from asperity.gearset.blanks import wheel_section
from asperity.mesh.packed import Arrays, floats, indices, packed, size_of
from asperity.mesh.surface import Surface

ANGLES = 60
"""Angles of the worm over a pitch that have contact lines."""
MOST_BYTES = 1_500_000
MOST_TRIANGLES = 150_000

_FINE = 7

Loaded = tuple[LoadedLines, ...]
Named = Iterator[tuple[str, npt.NDArray[Any]]]


@dataclasses.dataclass(frozen=True)
class Layer:
    """A quantity over a flank.

    Attributes
    ----------
    key, word, unit, meaning : str
        Its name in the header, in a word and in a sentence.
    """

    key: str
    word: str
    unit: str
    meaning: str


LAYERS = (
    Layer("gap", "Pattern", "µm", "least gap over all angles, where marking compound is squeezed"),
    Layer("ease_off", "Ease-off", "µm", "material removed beside the wheel of an identical hob"),
    Layer("line_load", "Line load", "N/mm", "load along the contact line when it passes"),
    Layer("sliding", "Sliding", "m/s", "sliding velocity when the contact line passes"),
)  # fmt: skip
"""In the order in which they are offered."""


def drawn_from(
    name: str, wheel: Wheel, analysis: Analysis, assembly: Assembly, beside: Beside = None
) -> bytes:
    """Return what draws a gearset: at most `MOST_BYTES` and `MOST_TRIANGLES`."""
    pair = analysis.pair
    pitch = 2.0 * math.pi / pair.geometry.starts
    arrays = dict(_bodies(wheel, analysis, beside))
    sides = {}
    for side, flank in analysis.flanks.items():
        loaded = _loaded(flank)
        sides[f"{side:+d}"] = _curves(flank, loaded)
        arrays |= {f"{name}.{side:+d}": values for name, values in _flank(flank, loaded)}
    angles = ANGLES
    while size_of(found := arrays | _lines(analysis, pitch, angles)) > MOST_BYTES and angles > 1:
        angles //= 2
    kept = (layer for layer in LAYERS if f"layer.{layer.key}.+1" in arrays)
    header = {
        "name": name,
        "flank": pair.flank,
        "hand": pair.hand,
        "starts": pair.geometry.starts,
        "teeth": pair.geometry.wheel_teeth,
        "pitch": pitch,
        "angles": angles,
        "fine": _fine(pair.geometry.wheel_teeth, found),
        "worm": {"rotation": assembly.worm_rotation, "place": assembly.worm_place},
        "centre_distance": pair.mounting.centre_distance,
        "worm_radius": pair.worm.tip_radius,
        "wheel_radius": float(wheel.blank.tip_radius(np.array([0.0]))[0]),
        "face_width": wheel.blank.face_width,
        "layers": [dataclasses.asdict(layer) for layer in kept],
        "sides": sides,
    }
    return packed(header, found)


def _bodies(wheel: Wheel, analysis: Analysis, beside: Beside) -> Named:
    """Yield points and triangles of worm, hub, a coarse tooth, and what is round fine flanks."""
    pair = analysis.pair
    columns = analysis.flanks[1].grid.z[0]
    hub = Body("hub", [], [], [wheel_section(pair.geometry, blanks_of(beside))])
    for name, body in (
        ("worm", whole_worm(pair, beside, SHOWN)),
        ("hub", hub),
        ("tooth", shown_tooth(wheel)),
        ("beside", beside_flanks(wheel, columns)),
    ):
        skin = body.skin()
        yield f"{name}.points", floats(skin.points)
        yield f"{name}.triangles", indices(skin.triangles)


def _flank(flank: FlankAnalysis, loaded: Loaded) -> Named:
    """Yield grid and layers of a flank: rows from the fillet to the tip, columns along Z."""
    mirror = flank.mirror
    points = flank.grid.points * [1.0, 1.0, mirror]
    triangles = Surface.of_grid(points).triangles
    yield "flank.points", floats(points)
    yield "flank.triangles", indices(triangles[:, :: flank.side * mirror])
    off = np.where(flank.ease_off.compared, flank.ease_off.distance, math.nan)
    yield "layer.gap", floats(MICROMETRES * np.maximum(flank.pattern.gap, 0.0))
    yield "layer.ease_off", floats(MICROMETRES * off)
    # Velocities mean nothing where no speed is given, which comes with a load.
    if loaded:
        touching = flank.motion.on_flank
        yield "layer.line_load", floats(np.where(touching, flank.line_load(loaded), math.nan))
        speed = flank.motion.sliding_speed / MICROMETRES
        yield "layer.sliding", floats(np.where(touching, speed, math.nan))


def _loaded(flank: FlankAnalysis) -> Loaded:
    try:
        return flank.under_load()
    except InputError:
        # At an angle of the worm where no tooth bears: as the study says in its notes.
        return ()


def _curves(flank: FlankAnalysis, loaded: Loaded) -> dict[str, Any]:
    """Return what one flank does over a pitch of the worm; lists end where the pitch does."""
    mesh, film = flank.transmission, flank.pattern.thickness
    # What is rounding is told as none, as everywhere.
    resolved = mesh.peak_to_peak > mesh.resolution("error")
    error = 1e6 * (mesh.error - mesh.mean) * resolved
    under = {
        "angle": [math.degrees(lines.lines.worm_angle) for lines in loaded],
        "teeth": [lines.teeth for lines in loaded],
        "line_load": [float(lines.load.max()) for lines in loaded],
    }
    return {
        "ahead": mesh.ahead,
        "film_um": MICROMETRES * film,
        "pattern_fraction": flank.pattern.area_fraction,
        "transmission_error_urad": 1e6 * mesh.peak_to_peak * resolved,
        "contact_ratio": flank.contact_ratio,
        "contact_ratio_marked": flank.contact_ratio_marked,
        "angle_deg": np.degrees(
            mesh.search.pair.ratio * np.append(mesh.wheel_angle, mesh.search.pitch)
        ),
        "error_urad": np.append(error, error[0]),
        "teeth": np.append(mesh.teeth(), mesh.teeth()[0]),
        "teeth_marked": np.append(mesh.teeth(film), mesh.teeth(film)[0]),
        "loaded": under if loaded else None,
    }


def _lines(analysis: Analysis, pitch: float, angles: int) -> Arrays:
    """Return the pieces of the contact lines in space by side, and where each angle's begin."""
    found: Arrays = {}
    for side, flank in analysis.flanks.items():
        lines = [flank.contact_lines(pitch * n / angles) for n in range(angles)]
        # Past the end of the worm's flank it is the tip that is nearest, at another angle: a piece
        # that reaches between both points back along that end.
        on_flank = flank.motion.on_flank.reshape(-1)
        kept = [on_flank[each.corners].all(axis=1) for each in lines]
        points = [each.points[these] for each, these in zip(lines, kept, strict=True)]
        teeth = [each.tooth[these] for each, these in zip(lines, kept, strict=True)]
        found[f"lines.points.{side:+d}"] = floats(np.concatenate(points) * [1.0, 1.0, flank.mirror])
        found[f"lines.tooth.{side:+d}"] = np.concatenate(teeth).astype("i1")
        begin = np.cumsum([0, *map(len, teeth)])
        found[f"lines.begin.{side:+d}"] = begin.astype("<u4")
    return found


def _fine(teeth: int, arrays: Arrays) -> int:
    """Return how many teeth may be drawn with the grids of their flanks."""
    counts = {name: len(values) for name, values in arrays.items() if "triangles" in name}
    one = counts["beside.triangles"] + sum(counts[f"flank.triangles.{s}"] for s in ("+1", "-1"))
    coarse = counts["tooth.triangles"]
    rest = counts["worm.triangles"] + counts["hub.triangles"] + teeth * coarse
    room = (MOST_TRIANGLES - rest) // (one - coarse)
    # An odd number, as many on either side.
    return max(1, min(_FINE, room - (room + 1) % 2, teeth - (teeth + 1) % 2))
