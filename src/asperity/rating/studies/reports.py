"""The studies as tables for the terminal."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table

    from asperity.rating.studies.sensitivity import Sensitivity


def table(title: str, *headings: str, left: int = 1) -> "Table":
    """Return an empty table: numbers to the right, the first columns to the left."""
    from rich.table import Table

    made = Table(title=title, title_justify="left", box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for place, heading in enumerate(headings):
        made.add_column(heading, justify="left" if place < left else "right", no_wrap=True)
    return made


def points(change: float) -> str:
    """Return a change of an efficiency in points."""
    return f"{100.0 * change:+.1f}"


def percent(efficiency: float) -> str:
    """Return an efficiency in percent."""
    return "-" if np.isnan(efficiency) else f"{100.0 * efficiency:.1f}"


def sensitivity_report(study: "Sensitivity") -> "Group":
    """Return efficiencies over the rises, and a summary of the influences."""
    from rich.console import Group
    from rich.text import Text

    rises = [f"{100.0 * rise:+.0f} %" if rise else "as is" for rise in study.rises]
    curves = table("Efficiency of the teeth eta_z in percent", "", *rises)
    summary = table("Influence", "", "at", "effect", "size", "elasticity", "points", left=4)
    notes = []
    for found in study.influences:
        what = found.quantity
        curves.add_row(what.symbol, *map(percent, found.efficiency))
        summary.add_row(
            what.symbol,
            what.text(found.values[0]),
            found.effect,
            found.size,
            f"{found.elasticity:+.2f}",
            points(found.change),
        )
        if found.fails_above is not None:
            notes.append(
                f"- {what.symbol} raised by more than {100.0 * found.fails_above:.1f} %: "
                f"{found.failure}"
            )
    notes.append(
        "- points: change of the efficiency up to the last rise with an answer; elasticity: "
        "change over the input's, both in parts of themselves"
    )
    return Group(curves, Text(), summary, Text(), *map(Text, notes))
