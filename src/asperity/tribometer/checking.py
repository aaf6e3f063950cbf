"""The command ``asperity rig check``: what is wrong with what was heard, by which evidence."""

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np

from asperity.arrays import FloatArray
from asperity.results import Result, quantity
from asperity.results.table import Columns, Table, table_of, table_of_rows
from asperity.runs import Run
from asperity.tribometer.reduction import study as reduction
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.reduction.study import Series


@dataclasses.dataclass(frozen=True)
class DrawnFinding:
    """A finding in a recording.

    Attributes
    ----------
    file : str
        The recording.
    start : float or None
        Of the vibration of the segment it is in, s; None: all of the recording.
    name, evidence, remedy : str
        What is wrong, by which numbers, and what to do.
    signals : tuple of str
        What it is seen in.
    spoils : bool
        Whether numbers rest on it, so that they are not good.
    """

    file: str
    start: float | None
    name: str
    evidence: str
    remedy: str
    signals: tuple[str, ...]
    spoils: bool

    @property
    def where(self) -> str:
        """The segment it is in."""
        return "all of it" if self.start is None else f"{self.start:.0f} s"

    @property
    def caption(self) -> str:
        """What stands above its picture."""
        return f"{self.file}, {self.where}: {self.name}"


class Checked(Result):
    """What was heard, checked.

    Attributes
    ----------
    found : tuple of DrawnFinding
        In the order of recordings.
    """

    title = "What was heard, checked"
    stem = "check"
    drawings: ClassVar[Mapping[str, str]] = {"check": "asperity.tribometer.plots:plot_findings"}

    found: tuple[DrawnFinding, ...]
    recordings: int = quantity("", "", "recordings")
    segments: int = quantity("", "", "segments with vibration")
    refused: int = quantity("", "", "of these refused, and not checked")
    findings: int = quantity("", "", "findings", key="count")
    spoiling: int = quantity("", "", "of these such that numbers are not good")
    x: FloatArray = quantity("", "", "across each picture", dims=("finding", "point"), only="file")
    y: FloatArray = quantity("", "", "up each picture", dims=("finding", "point"), only="file")
    marks: FloatArray = quantity(
        "", "", "where along x a finding lies", dims=("finding", "end"), only="file"
    )
    across: Any = quantity("", "", "what x is", dims=("finding",), only="file")
    up: Any = quantity("", "", "what y is", dims=("finding",), only="file")
    told: Any = quantity("", "", "what is found", dims=("finding",), only="file")

    def headline(self) -> tuple[str, ...]:
        """Say whether numbers can rest on it."""
        if self.found:
            return ()
        if self.notes:
            return ("Nothing is found, but not all could be checked.",)
        return ("Nothing is wrong with what was heard.",)

    def to_json(self) -> dict[str, Any]:
        """Return the findings."""
        listed = [
            {"file": one.file, "start_s": one.start, "name": one.name, "evidence": one.evidence,
             "remedy": one.remedy, "signals": list(one.signals), "spoils": one.spoils}
            for one in self.found
        ]  # fmt: skip
        return super().to_json() | {"findings": listed}

    def tables(self) -> tuple[Table, ...]:
        """Return the counts, and a row a finding with what to do below."""
        told = [
            f"{place}: {one.evidence}; {one.remedy}"
            for place, one in enumerate(self.found, start=1)
        ]
        number = itertools.count(1)
        columns: Columns = {
            "": lambda one: str(next(number)), "file": "file",
            "vibration at": "where", "finding": "name",
            "numbers": lambda one: "not good" if one.spoils else "to know",
        }  # fmt: skip
        return table_of(self), table_of_rows(self.found, columns, remarks=(*told, *self.notes))


_POINTS = 240  # of a picture's course

read, prepare = reduction.read, reduction.prepare


def answer(series: Series, run: Run) -> Checked:
    """Listen to recordings, one after the other."""
    problem = series.reducible
    found, courses, notes = [], [], []
    segments = refused = 0
    for done, one in enumerate(problem):
        run.checkpoint(done, len(problem), what="recordings")
        parts, listened = reduction.heard_in(one)
        segments += len(parts)
        refused += sum(bool(part.refused) for part in parts)
        name = one.recording.name
        if not parts:
            notes.append(f"{name}: no vibration was found, so that only channels are checked")
        if not listened.at_rest:
            notes.append(f"{name}: no seconds at rest were found, so that zeros are not known")
        notes += [
            f"{name}: segment at {part.start:.1f} s is refused: {part.refused}"
            for part in parts
            if part.refused
        ]
        for finding in listened.findings:
            start = None if finding.index is None else parts[finding.index].start
            found.append(
                DrawnFinding(name, start, finding.name, finding.evidence, finding.remedy,
                      finding.signals, finding.spoils)
            )  # fmt: skip
            courses.append(finding.curve)
    return Checked(
        found=tuple(found), recordings=len(problem), segments=segments, refused=refused,
        findings=len(found), spoiling=sum(one.spoils for one in found), notes=tuple(notes),
        **_drawn(found, courses),
    )  # fmt: skip


def _drawn(findings: Sequence[DrawnFinding], courses: Sequence[Curve]) -> dict[str, Any]:
    """Return the courses of the findings, each in so many points."""
    shape = len(courses), _POINTS
    x, y, marks = np.zeros(shape), np.zeros(shape), np.zeros((len(courses), 2))
    for place, course in enumerate(courses):
        x[place], y[place] = _points(course.x), _points(course.y)
        if course.marked:
            marks[place] = min(course.marked)[0], max(course.marked)[1]
    return {
        "x": x, "y": y, "marks": marks,
        "across": np.array([one.across for one in courses], dtype=object),
        "up": np.array([one.up for one in courses], dtype=object),
        "told": np.array([one.caption for one in findings], dtype=object),
    }  # fmt: skip


def _points(values: FloatArray) -> FloatArray:
    if values.size <= _POINTS:
        return np.pad(values, (0, _POINTS - values.size), mode="edge") if values.size else (
            np.zeros(_POINTS)
        )  # fmt: skip
    edges = np.linspace(0, values.size, _POINTS + 1).astype(int)[:-1]
    return np.asarray(np.add.reduceat(values, edges) / np.diff(np.append(edges, values.size)))
