"""All that is heard of a recording: its zeros, taken off, and what is found."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.tribometer.options import Reduction
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.blocks import Blocks
from asperity.tribometer.reduction.heard import acceleration, drive, level, motors, moving, pulses
from asperity.tribometer.reduction.heard.acceleration import Heard as Tones
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.rest import resting
from asperity.tribometer.reduction.heard.zero import Tare, tare, zeros_of
from asperity.tribometer.reduction.segments import Segment


@dataclasses.dataclass(frozen=True)
class Listened:
    """What was found in a recording.

    Attributes
    ----------
    blocks : Blocks
        Without the zeros that are known.
    tare : Tare
        These zeros.
    findings : tuple of Finding
        In the order of signals and time.
    tones : mapping of int to Tones
        What the accelerometer hears of each segment.
    at_rest : bool
        Whether the rig is seen at rest, so that zeros are known.
    """

    blocks: Blocks
    tare: Tare
    findings: tuple[Finding, ...]
    tones: Mapping[int, Tones]
    at_rest: bool

    def of_segment(self, index: int) -> list[Finding]:
        """Return what concerns a segment."""
        return [one for one in self.findings if one.index in (None, index)]

    def rows(self, segments: Sequence[Segment]) -> tuple[dict[str, Any], ...]:
        """Return the findings, as JSON has them; those of the whole recording have no start."""
        return tuple(
            {
                "start_s": None if one.index is None else segments[one.index].start,
                "name": one.name, "evidence": one.evidence, "remedy": one.remedy,
                "signals": list(one.signals), "spoils": one.spoils, "flag": one.flag,
            }
            for one in self.findings
        )  # fmt: skip


# A scale that is no sensor's may be in a file.
@np.errstate(all="ignore")
def listen(
    recording: Recording,
    case: Case,
    blocks: Blocks,
    segments: Sequence[Segment],
    options: Reduction,
) -> Listened:
    """Find what is wrong with what was heard."""
    if not all(
        np.isfinite(one).all() for one in (*blocks.means.values(), *blocks.deviations.values())
    ):
        return Listened(blocks, Tare({}), (), {}, at_rest=False)
    of = Material(recording, case, pair_of(case), blocks, segments, options)
    rest = resting(of)
    taken, found = tare(of, zeros_of(of, rest))
    of = dataclasses.replace(of, blocks=taken.off(blocks))
    tones = {}
    for index, one in enumerate(segments):
        if not one.refused and (heard := acceleration.heard(of, index)) is not None:
            tones[index] = heard
    found += moving.findings(of, rest)
    found += motors.findings(of)
    found += pulses.findings(of)
    found += level.findings(of, {name for one in found for name in one.signals})
    found += drive.findings(of)
    found += acceleration.findings(of, tones)
    return Listened(of.blocks, taken, tuple(found), tones, at_rest=bool(rest.stretches))
