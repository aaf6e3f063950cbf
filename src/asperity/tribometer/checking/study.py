"""The command ``asperity rig check``: what is wrong with what was heard."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.runs import Run
from asperity.tribometer.checking.result import Checked, Found
from asperity.tribometer.reduction import study as reduction
from asperity.tribometer.reduction.heard.finding import Course
from asperity.tribometer.reduction.study import Series

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
            start = None if finding.place is None else parts[finding.place].start
            found.append(
                Found(name, start, finding.name, finding.evidence, finding.remedy,
                      finding.signals, finding.spoils)
            )  # fmt: skip
            courses.append(finding.course)
    return Checked(
        found=tuple(found), recordings=len(problem), segments=segments, refused=refused,
        findings=len(found), spoiling=sum(one.spoils for one in found), notes=tuple(notes),
        **_drawn(found, courses),
    )  # fmt: skip


def _drawn(found: Sequence[Found], courses: Sequence[Course]) -> dict[str, Any]:
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
        "told": np.array([one.told for one in found], dtype=object),
    }  # fmt: skip


def _points(values: FloatArray) -> FloatArray:
    if values.size <= _POINTS:
        return np.pad(values, (0, _POINTS - values.size), mode="edge") if values.size else (
            np.zeros(_POINTS)
        )  # fmt: skip
    edges = np.linspace(0, values.size, _POINTS + 1).astype(int)[:-1]
    return np.asarray(np.add.reduceat(values, edges) / np.diff(np.append(edges, values.size)))
