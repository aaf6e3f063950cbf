"""Loaded gearsets solved by the dozen: over all cores, each kept as soon as it is there."""

import functools
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from asperity.drive.problem import DriveProblem
from asperity.drive.static.loaded import Loaded, loaded
from asperity.errors import AsperityError
from asperity.results.table import Number, Table
from asperity.results.words import text_of
from asperity.runs import Interrupted, Run
from asperity.runs.cache import Cache
from asperity.runs.key import code_key, key
from asperity.runs.workers import Task, cores, done

_SECONDS_A_PHASE = 0.3
_LOADED = "asperity.drive.static.loaded"
_ROOM = "teeth"
_SHORT = {
    "mount.centre_distance_error": "centre",
    "mount.axial_offset": "offset",
    "mount.shaft_angle_error": "angle",
    "operation.output_torque": "torque",
}


def solve_points(
    problems: Sequence[DriveProblem], run: Run, *, what: str = "points"
) -> list[Loaded | str]:
    """Return what loaded gearsets come to, or why one comes to nothing.

    What was solved before, by whichever study, is not solved again.

    Parameters
    ----------
    problems : sequence of DriveProblem
        Each of a case.
    run : Run
        Who is told how many are done, and who may interrupt: what is done is kept.
    what : str
        What they are called.
    """
    kept = Cache.of_this_user("loaded", run.notify)
    names = [_name(problem) for problem in problems]
    found: dict[str, Loaded | str] = {}
    for name in names:
        if name not in found and (tree := kept.get(name)) is not None:
            found[name] = Loaded.from_tree(tree)
    missing = {
        name: problem for name, problem in zip(names, problems, strict=True) if name not in found
    }
    total = len(set(names))
    seconds = _SECONDS_A_PHASE * sum(problem.drive.phases for problem in missing.values())
    processes = min(cores(), len(missing))
    run.forecast(seconds / max(processes, 1), f"{len(missing)} {what}")

    def take(name: str, answer: Loaded | str) -> None:
        found[name] = answer
        if isinstance(answer, Loaded):
            kept.put(name, answer.to_tree())
        run.checkpoint(len(found), total, what=what)

    try:
        with run.interruptible():
            run.checkpoint(len(found), total, what=what)
            if processes <= 1:
                for name, problem in missing.items():
                    take(name, solved(problem))
            else:
                # The first condenses the teeth, which others then find.
                tasks = [
                    Task(name, functools.partial(solved, problem), _ROOM)
                    for name, problem in missing.items()
                ]
                tell = functools.partial(run.checkpoint, what=what)
                for task, future in done(tasks, processes, lambda: tell(len(found), total)):
                    take(task.name, future.result())
    except Interrupted:
        if kept.folder is None:
            raise
        raise Interrupted(
            f"interrupted: {len(found)} of {total} {what} are kept; the same command goes on from "
            "there"
        ) from None
    return [found[name] for name in names]


def solved(problem: DriveProblem) -> Loaded | str:
    """Return what a gearset comes to, or why it comes to nothing."""
    try:
        return loaded(problem, Run())
    except AsperityError as error:
        return str(error)


def _name(problem: DriveProblem) -> str:
    assert problem.case is not None
    return key(code_key(_LOADED), problem.case.canonical())


def points_for_json(
    axes: Iterable[Any],
    names: Iterable[Any],
    values: Iterable[Any],
    columns: Mapping[str, Any],
) -> list[dict[str, Any]]:
    """Return points for JSON: what each is called, its place on the axes and its numbers."""
    every = list(axes)
    return [
        {
            "name": str(name),
            "values": {
                f"{axis.path} [{axis.unit or '1'}]": float(value) if value == value else None
                for axis, value in zip(every, place, strict=True)
            },
            **{
                key: float(column[n]) if np.isfinite(column[n]) else None
                for key, column in columns.items()
            },
        }
        for n, (name, place) in enumerate(zip(names, values, strict=True))
    ]


def table_of_points(
    answer: Any,
    place: str,
    columns: Mapping[str, tuple[str, str, float]],
    remarks: Iterable[str],
    mark: tuple[str, ...] = (),
) -> Table:
    """Return a table of points: where each is on the axes, its numbers, and a mark.

    Columns are key, format and what it is shown over, by headings; ``answer`` has axes, value and
    rows as `points_for_json` gives them, which stand in JSON at a place.
    """
    names = [_SHORT.get(axis.path, axis.key.replace("_", " ")) for axis in answer.axes]
    units = [f" ({axis.unit})" if axis.unit else "" for axis in answer.axes]
    heads = *map("".join, zip(names, units, strict=True)), *columns, *([""] if mark else [])
    rows = [
        (
            *(text_of(float(value)) for value in answer.value[n]),
            *(
                "none" if row[key] is None
                else Number.of(row[key] + 0.0, form, f"{place}.{n}.{key}", times)
                for key, form, times in columns.values()
            ),
            *mark[n : n + 1],
        )
        for n, row in enumerate(answer.rows)
    ]  # fmt: skip
    return Table.of(heads, rows, left=0, remarks=remarks)
