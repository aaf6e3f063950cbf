"""What a command prints: one JSON object, or tables for people; notes and progress beside it."""

import contextlib
import io
import itertools
import json
import math
import sys
import textwrap
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.errors import StorageError

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console
    from rich.table import Table

    from asperity.sweep import Axis, SweepResult

_DOTS_PER_INCH = 150
_MOST_ROWS = 60
_CELL = 9

# What is shown of a slide: key in its JSON, name, symbol, unit.
_SLIDE = (
    ("drive_force_N", "mean drive force", "F_dv", "N"),
    ("static_drive_force_N", "drive force without vibration", "mu F_N", "N"),
    ("ratio", "ratio of the two", "F_dv/F_ds", ""),
    ("breakaway_time_s", "breakaway", "t_b", "s"),
    ("friction_x_mean_N", "friction along the drive, mean", "F_x", "N"),
    ("friction_x_max_N", "friction along the drive, greatest", "F_x,max", "N"),
    ("friction_x_min_N", "friction along the drive, least", "F_x,min", "N"),
    ("friction_y_max_N", "friction across, greatest size", "|F_y|,max", "N"),
    ("power_drive_W", "power of the drive", "P_d", "W"),
    ("power_vibration_W", "power of the vibration", "P_v", "W"),
    ("power_friction_W", "power lost to friction", "P_f", "W"),
    ("power_damping_W", "power lost to damping", "P_h", "W"),
    ("power_stored_W", "power stored", "P_s", "W"),
    ("power_untransferred_W", "power of the untransferred vibration", "P_u", "W"),
    ("power_residual", "error of the power balance", "", ""),
    ("residual", "residual of the method", "", ""),
)

# What is shown of a block beside that.
_BLOCK = (
    ("power_loads_W", "power of gravity and pressure", "P_g", "W"),
    ("power_numerical_W", "power taken by the time integration", "P_n", "W"),
    ("normal_force_N", "normal force", "F_N", "N"),
    ("pressure_mean_MPa", "contact pressure, mean", "p", "MPa"),
    ("pressure_max_MPa", "contact pressure, greatest at an integration point", "p_max", "MPa"),
    ("iterations_mean", "iterations of an increment, mean", "", ""),
    ("iterations_max", "iterations of an increment, most", "", ""),
    ("residual_increment_max", "residual of an increment, greatest", "", ""),
    ("ms_per_increment", "time of an increment", "", "ms"),
)


def note(line: str) -> None:
    """Print a line to standard error."""
    print(line, file=sys.stderr, flush=True)


def print_text(text: str) -> None:
    """Print to standard output."""
    try:
        print(text, flush=True)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise StorageError(f"standard output cannot be written: {error.strerror}") from error


def print_json(answer: Mapping[str, Any]) -> None:
    """Print one JSON object to standard output."""
    print_text(json.dumps(answer, allow_nan=False))


def write_json(answer: Mapping[str, Any], path: Path) -> None:
    """Write one JSON object, atomically."""
    from asperity.store import write_text

    write_text(path, json.dumps(answer, indent=2, allow_nan=False) + "\n")


def write_picture(figure: "Figure", path: Path) -> None:
    """Write a picture as PNG, atomically."""
    from asperity.store import write_atomically

    write_atomically(path, lambda target: figure.savefig(target, dpi=_DOTS_PER_INCH))


def print_cases(cases: Sequence[Mapping[str, str]]) -> None:
    """Print names and descriptions."""
    table = _table("case", "what it is")
    table.columns[1].no_wrap = False
    for case in cases:
        table.add_row(case["name"], case["description"])
    _print(table)


def print_slide(case: str, answer: Mapping[str, Any]) -> None:
    """Print the scalars of a slide with their symbols and units."""
    how = ", ".join(str(answer[key]) for key in ("method", "scheme"))
    print_text(f"{case}: {how}, law {answer['law']}, {answer['steps']} steps\n")
    table = _table("", "symbol", "value", "unit")
    for key, name, symbol, unit in _SLIDE:
        if answer.get(key) is not None:
            table.add_row(name, symbol, f"{answer[key]:.5g}", unit)
    _print(table)
    for line in answer["notes"]:
        print_text("\n" + textwrap.fill(f"Note: {line}.", 79))


def print_block(case: str, answer: Mapping[str, Any]) -> None:
    """Print the scalars of an elastic block with their symbols and units."""
    print_text(
        f"{case}: {answer['contact_nodes']} contact nodes of {answer['unknowns']} unknowns, "
        f"{answer['modes']} modes,\n"
        f"{answer['scheme']}, law {answer['law']}, {answer['increments']} increments\n"
    )
    table = _table("", "symbol", "value", "unit")
    for key, name, symbol, unit in (*_SLIDE, *_BLOCK):
        if answer.get(key) is not None:
            table.add_row(name, symbol, f"{answer[key]:.5g}", unit)
    _print(table)
    for line in answer["notes"]:
        print_text("\n" + textwrap.fill(f"Note: {line}.", 79))


def print_sweep(result: "SweepResult") -> None:
    """Print the ratio over the grid: a matrix where it fits, a list where not."""
    print_text(f"{result.source}: mean drive force over mu F_N\n")
    table, rows = _matrix(result) if _is_narrow(result) else _list(result)
    _print(table)
    if rows > _MOST_ROWS:
        print_text(f"... and {rows - _MOST_ROWS} more rows; --out or --json gives all")
    known = f", {result.cached} known from before" if result.cached else ""
    print_text(f"\n{result.points} points{known}, {result.seconds:.3g} s")


def _is_narrow(result: "SweepResult") -> bool:
    columns = [_cell(value) for value in result.axes[-1].shown[:_MOST_ROWS]]
    width = sum(max(len(cell), _CELL) for cell in columns) + len(_corner(result))
    return len(result.axes) == 2 and len(columns) < _MOST_ROWS and width <= _console().width


def _corner(result: "SweepResult") -> str:
    return " \\ ".join(map(_heading, result.axes))


def _heading(axis: "Axis") -> str:
    return f"{axis.key} ({axis.unit})" if axis.unit else axis.key


def _matrix(result: "SweepResult") -> tuple["Table", int]:
    down, across = result.axes
    table = _table(_corner(result), *map(_cell, across.shown))
    rows = zip(down.shown, result.arrays["ratio"], strict=True)
    for shown, row in itertools.islice(rows, _MOST_ROWS):
        table.add_row(_cell(shown), *map(_cell, row))
    return table, len(down.shown)


def _list(result: "SweepResult") -> tuple["Table", int]:
    table = _table(*map(_heading, result.axes), "ratio")
    places = itertools.product(*(axis.shown for axis in result.axes))
    rows = zip(places, result.arrays["ratio"].flat, strict=True)
    for place, ratio in itertools.islice(rows, _MOST_ROWS):
        table.add_row(*map(_cell, place), _cell(ratio))
    return table, result.points


@contextlib.contextmanager
def progress_bar(what: str = "points") -> Iterator[Callable[[int, int], None]]:
    """Show a bar on standard error where that is a terminal; yields what moves it."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    console = Console(stderr=True)
    columns = BarColumn(), MofNCompleteColumn(), what, TimeRemainingColumn()
    with Progress(*columns, console=console, disable=not console.is_terminal) as progress:
        bar = progress.add_task("", total=None)
        yield lambda done, points: progress.update(bar, completed=done, total=points)


def _console() -> "Console":
    from rich.console import Console

    # It writes to memory: what goes to standard output goes by `print_text`, errors and all.
    return Console(file=io.StringIO(), highlight=False, markup=False)


def _table(*headings: str) -> "Table":
    from rich.table import Table

    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in headings:
        table.add_column(heading, no_wrap=True)
    return table


def _print(table: "Table") -> None:
    console = _console()
    with console.capture() as capture:
        console.print(table)
    print_text("\n".join(line.rstrip() for line in capture.get().splitlines()))


def _cell(value: float | str) -> str:
    if isinstance(value, str):
        return value
    return "-" if math.isnan(value) else f"{value:.5g}"
