"""The command ``asperity rig reduce``: recordings to what vibration did in each segment."""

import dataclasses
import math
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.casefile import Case, read_case
from asperity.errors import InputError
from asperity.runs import Run
from asperity.tribometer.channels import Channels
from asperity.tribometer.options import Plan, Reduction
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Lubricant, Rig, Sonotrode
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction import wear
from asperity.tribometer.reduction.blocks import Blocks, blocks_of
from asperity.tribometer.reduction.budget_tables import not_counted
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.file import reduce_file
from asperity.tribometer.reduction.heard.listen import Listened, listen
from asperity.tribometer.reduction.result import REFUSED, FileResult, Reduced, SegmentResult
from asperity.tribometer.reduction.segments import Segment, running_of, segments_of
from asperity.tribometer.reduction.wear_rate import Stretch as Worn
from asperity.tribometer.reduction.wear_rate import wear_rates
from asperity.tribometer.reduction.wear_result import WearResult
from asperity.tribometer.sheets import broken_classes

_OFTEN = 0.01  # share of samples
_USUAL = 0.95  # confidence that intervals are named by


@dataclasses.dataclass(frozen=True)
class Reducible:
    """A recording with its configuration."""

    recording: Recording
    case: Case

    @property
    def reduction(self) -> Reduction:
        """How it is reduced."""
        return self.case.get(Reduction, Reduction())

    @property
    def plan(self) -> Plan:
        """Which frequencies there are."""
        return self.case.get(Plan, Plan())

    @property
    def sonotrode(self) -> Sonotrode | None:
        """How fast the disc is shaken."""
        return self.case.get(Sonotrode)


@dataclasses.dataclass(frozen=True)
class Series:
    """Recordings that are reduced together.

    Attributes
    ----------
    reducible : tuple of Reducible
        In the order given.
    budget : bool
        Whether the answer tells what every number is uncertain by.
    """

    reducible: tuple[Reducible, ...]
    budget: bool = False


@dataclasses.dataclass(frozen=True)
class _Opened(Case):
    """A case that brings its recordings along."""

    reducible: tuple[Reducible, ...] = ()


def read(
    case: str,
    known: Mapping[str, Any],
    settings: Sequence[str],
    *,
    recordings: Sequence[str],
    config: str = "",
    budget: bool = False,
) -> Case:
    """Open recordings; each is reduced by the configuration that is given, or by its own."""
    given = read_case(config, known, settings) if config else None
    if given is not None and Rig.table not in given:
        raise InputError(
            f"--config {config}: it is a case of another kind, without [{Rig.table}]; give the "
            "configuration of a rig, such as rig-final"
        )
    opened = [Recording.open(Path(name)) for name in recordings]
    places = [one.path.resolve() for one in opened]
    if again := next((one for one in opened if places.count(one.path.resolve()) > 1), None):
        raise InputError(f"{again.name} is given twice; a recording is no repeat of itself")
    found = []
    for recording in opened:
        own = given
        if own is None:
            if not recording.configuration:
                raise InputError(
                    f"{recording.name} holds no configuration; give one, as in --config rig-final"
                )
            own = recording.case(known).replace(settings)
        found.append(Reducible(recording, own))
    first = found[0].case
    values = {field.name: getattr(first, field.name) for field in dataclasses.fields(Case)}
    many = len(found) > 1
    values["source"] = f"{len(found)} recordings" if many else found[0].recording.name
    return _Opened(**values, reducible=tuple(found))


def prepare(case: Case, budget: bool = False, **_: Any) -> Series:
    """Return the recordings, refused where a configuration lacks what is needed."""
    found = case.reducible if isinstance(case, _Opened) else ()
    for one in found:
        pair_of(one.case)
        one.case.require(Channels)
    return Series(found, budget)


def answer(series: Series, run: Run) -> Reduced:
    """Reduce recordings, one after the other."""
    problem = series.reducible
    segments: list[SegmentResult] = []
    files: list[FileResult] = []
    with run.interruptible():
        for done, one in enumerate(problem):
            run.checkpoint(done, len(problem), what="recordings")
            of_file, of_segments = reduce_recording(one)
            files.append(of_file)
            segments += of_segments
    deviation, freedom = repeats(segments)
    pair, notes = pair_of(problem[0].case), list(_notes(problem))
    journals = list(wear.of_journals([one.recording.path for one in problem], files, notes))
    rates = tuple(_rates(problem, journals, segments, notes))
    if not rates and not any(segment.quality != REFUSED for segment in segments):
        raise InputError(_nothing(problem, segments))
    for segment in segments:
        if segment.quality == REFUSED:
            run.notify(f"{segment.file}: {refusal(segment)}")
    weighed = [*wear.between_weighings(pair, files)]
    for weighing, between in journals:
        weighed += wear.of_weighing(pair, weighing, between)
    return Reduced(
        segments=tuple(segments), files=tuple(files), repeat_deviation=deviation,
        repeat_freedom=freedom, notes=tuple(notes),
        weighed=tuple(weighed), rates=rates, told=series.budget,
        not_counted=tuple(_not_counted(problem)),
    )  # fmt: skip


def _rates(
    problem: Sequence[Reducible],
    journals: Sequence[tuple[wear.Weighing, Sequence[FileResult]]],
    segments: Sequence[SegmentResult],
    notes: list[str],
) -> Iterator[WearResult]:
    """Yield wear rates of the runs of a plan of wear."""
    cases = {one.recording.name: one.case for one in problem}
    found = []
    for weighing, files in journals:
        names = [one.file for one in files]
        case = cases[names[0]]
        if case.get(Plan, Plan()).distance is not None:
            within = [one for one in segments if one.file in names]
            oil = case.get(Lubricant)
            found.append(
                Worn(weighing, files, within, case.require(Rig).mode, oil.kind if oil else "")
            )
    if not found:
        return
    given = problem[0].reduction
    pair = pair_of(problem[0].case)
    yield from wear_rates(pair, found, given.weighing_uncertainty, given.confidence, notes)
    notes.append(
        "wear rates count no uncertainty of the force between the discs and of their density"
    )


def _not_counted(problem: Sequence[Reducible]) -> Iterator[str]:
    told: dict[str, None] = {}
    for one in problem:
        signals = [source.signal for source in one.recording.sources]
        told |= dict.fromkeys(not_counted(one.case, signals))
    yield from told


def heard_in(reducible: Reducible) -> tuple[list[Segment], Listened]:
    """Return the segments of a recording, and what its sensors say of themselves."""
    blocks = blocks_of(
        reducible.recording, reducible.case.require(Channels), reducible.reduction.block
    )
    running = running_of(blocks, reducible.reduction)
    segments, heard = _heard(reducible, blocks, running)
    # A speed whose zero is far off seems to turn at rest: windows would hold the seconds there.
    seen = running_of(blocks, reducible.reduction, heard.tare.at_rest(blocks, "speed_steel"))
    if len(seen) > len(running):
        segments, heard = _heard(reducible, blocks, seen)
    return segments, heard


def _heard(
    reducible: Reducible, blocks: Blocks, running: Sequence[Stretch]
) -> tuple[list[Segment], Listened]:
    segments = segments_of(
        reducible.recording, blocks, reducible.plan, reducible.reduction, running
    )
    return segments, listen(
        reducible.recording, reducible.case, blocks, segments, reducible.reduction
    )


def reduce_recording(reducible: Reducible) -> tuple[FileResult, list[SegmentResult]]:
    """Reduce one recording."""
    segments, heard = heard_in(reducible)
    return reduce_file(
        reducible.recording,
        reducible.case,
        heard,
        segments,
        reducible.reduction,
        reducible.sonotrode,
    )


def refusal(segment: SegmentResult) -> str:
    """Return why a segment is refused, with its time."""
    return f"segment at {segment.start or 0.0:.1f} s is refused: {'; '.join(segment.flags)}"


def _nothing(problem: Sequence[Reducible], segments: Sequence[SegmentResult]) -> str:
    if segments:
        return f"{segments[0].file}: {refusal(segments[0])}"
    one = problem[0]
    if told := beyond(one):
        return f"{one.recording.name}: no vibration found: {told}"
    return (
        f"{one.recording.name}: no vibration found: its drive signal never varies by more than "
        f"reduction.least_drive = {one.reduction.least_drive:g} V for long; look at the map of "
        "[channels]"
    )


def beyond(reducible: Reducible) -> str:
    """Return what is wrong with a drive signal that is past its range; nothing if it is not."""
    share = float(np.isnan(reducible.recording.values("drive_voltage")).mean())
    if share < _OFTEN:
        return ""
    return f"{share:.0%} of drive_voltage is missing or past its range; widen the channel's range"


def repeats(segments: Sequence[SegmentResult]) -> tuple[float | None, int]:
    """Return the deviation of repeats about the mean of their cell, pooled over cells.

    Returns
    -------
    deviation : float or None
        Points of the torque's change; None without repeats.
    freedom : int
        Its degrees of freedom.
    """
    cells: dict[tuple[Any, ...], list[float]] = defaultdict(list)
    for one in segments:
        if one.torque_change is not None:
            cells[one.cell].append(one.torque_change.value)
    freedom = sum(len(values) - 1 for values in cells.values())
    if not freedom:
        return None, 0
    squares = sum(float(np.var(values)) * len(values) for values in cells.values())
    return math.sqrt(squares / freedom), freedom


def _notes(problem: Sequence[Reducible]) -> Iterator[str]:
    yield (
        "the model's ratio is at the sliding velocity with vibration, k_v at the mean of before "
        "and with"
    )
    asked = sorted({one.reduction.confidence for one in problem} - {_USUAL})
    if asked:
        yield (
            f"intervals are of {', '.join(f'{100.0 * one:g}' for one in asked)} %, as "
            "reduction.confidence asks, where they are called those of 95 %"
        )
    if any(one.recording.simulated for one in problem):
        yield "simulated recordings are among these: no rig stands behind their numbers"
    mapped = [one.case.require(Channels).mapped() for one in problem]
    yield from dict.fromkeys(told for one in mapped for told in broken_classes(one))
    if any(one.case.require(Rig).bearing_torque_steel == 0.0 for one in problem):
        yield (
            "the bearing torque is taken as zero: it stands in both torques, and the friction "
            "falls by more than the torque does if it is not"
        )
