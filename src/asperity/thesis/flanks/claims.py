"""Claims 2.1 to 2.3: where a wheel bears that an oversized hob has cut."""

import dataclasses
import math

import numpy as np

from asperity.flanks.meshing.pattern.marking import MARKING, pattern
from asperity.thesis.exhibits import claim
from asperity.thesis.flanks.meshing import Gear, meshing
from asperity.thesis.products import Finding

_CASE = "gearset-3b"
_ROWS, _COLUMNS = 81, 121
_NO_TILT = "hob.tilt=0 deg"
_IDENTICAL = ("hob.oversize=1", _NO_TILT)
HOBS = {"identical": _IDENTICAL, "oversized": (_NO_TILT,), "oversized, tilted": ()}
ASKEW = 0.1  # deg
_EDGE, _MIDDLE = 0.9, 1.0 / 3.0
_HERE = f"Gearset 3 with a centre distance of 2.9 in; dye {1e3 * MARKING:g} um thick, unloaded."


@dataclasses.dataclass(frozen=True)
class Mark:
    """Where dye is carried over, in half face widths from mid-face."""

    centre: float
    low: float
    high: float
    lead_angle: float

    @classmethod
    def of(cls, gear: Gear) -> "Mark":
        """The mark on the flank of a gearset's wheel."""
        found = meshing(gear)
        grid = found.wheel.flank(1).grid(_ROWS, _COLUMNS)
        marks = pattern(found.transmission, grid)
        half = 0.5 * float(np.ptp(grid.z))
        at = grid.z[marks.marked] / half
        lead = math.degrees(found.wheel.pair.worm.lead_angle)
        return cls(marks.centre[0] / half, float(at.min()), float(at.max()), lead)

    @property
    def reach(self) -> float:
        """Of its end that is nearer to an edge."""
        return max(-self.low, self.high)


@claim("2.1")
def _tilt() -> Finding:
    gears = [Gear(_CASE, (_NO_TILT,)), Gear(_CASE)]
    straight, tilted = (Mark.of(gear) for gear in gears)
    return Finding.judged(
        {
            "without tilt it bears at an edge": straight.reach > _EDGE,
            "with 2 deg in the middle": abs(tilted.centre) < _MIDDLE and tilted.reach < _EDGE,
        },
        f"the mark ends at {straight.reach:.2f} of half the face width without tilt; with it its "
        f"middle is at {tilted.centre:.2f} and its end at {tilted.reach:.2f}",
        f"The mark goes from {straight.low:.2f} to {straight.high:.2f}, its middle at "
        f"{straight.centre:.2f}, and with tilt from {tilted.low:.2f} to {tilted.high:.2f}. The "
        "gearset photographed is not named, and oversize and tilt hang on the teeth, as the thesis "
        "says: that another gearset does it with the same two is more than it claims.",
        {
            "centre_without_tilt": straight.centre,
            "centre_with_tilt": tilted.centre,
            "end_without_tilt": straight.reach,
            "end_with_tilt": tilted.reach,
        },
        gears,
        assumed=f"{_HERE} The yardsticks, of half the face width: at an edge where the mark ends "
        f"beyond {_EDGE:g}; in the middle where the mark's middle is within {_MIDDLE:.2f} and its "
        f"end short of {_EDGE:g}.",
    )


@claim("2.2")
def _misalignment() -> Finding:
    gears = {
        name: [
            Gear(_CASE, (*hob, f"mount.shaft_angle_error={error:g} deg"))
            for error in (-ASKEW, ASKEW)
        ]
        for name, hob in HOBS.items()
    }
    centres = {name: [Mark.of(gear).centre for gear in both] for name, both in gears.items()}
    moves = {name: abs(there - here) for name, (here, there) in centres.items()}
    return Finding.judged(
        {
            "an oversized hob makes misalignment matter less": moves["oversized"]
            < 0.2 * moves["identical"],
            "also with tilt": moves["oversized, tilted"] < 0.2 * moves["identical"],
        },
        "the mark moves by "
        + ", ".join(f"{move:.2f} ({name})" for name, move in moves.items())
        + " of half the face width",
        f"While the shaft angle goes from -{ASKEW:g} to {ASKEW:g} deg. That contact becomes "
        "centralised takes a tilt as well here: claim 2.1. What the thesis adds of the pressure is "
        "claim 2.7.",
        {f"move_{name}": move for name, move in moves.items()},
        [gear for both in gears.values() for gear in both],
        assumed=_HERE,
    )


@claim("2.3")
def _lead_angles() -> Finding:
    starts = (1, 2, 3, 4, 6)
    gears = [Gear(_CASE, (_NO_TILT, f"gearset.starts={n}")) for n in starts]
    marks = [Mark.of(gear) for gear in gears]
    ends = [mark.reach for mark in marks]
    return Finding.judged(
        {
            "the mark moves outwards as the lead angle grows": ends == sorted(ends),
            "in the end it is at the edge": ends[0] < _EDGE < ends[-1],
        },
        "its end at "
        + ", ".join(f"{mark.reach:.2f} ({mark.lead_angle:.0f} deg)" for mark in marks)
        + " of half the face width",
        f"{_HERE} The lead angle grows with the worm's starts, {starts[0]} to {starts[-1]}; the "
        "wheel keeps its teeth.",
        {f"end_at_{mark.lead_angle:.1f}_deg": mark.reach for mark in marks},
        gears,
        assumed=f"The yardstick of an edge: an end beyond {_EDGE:g} of half the face width.",
    )
