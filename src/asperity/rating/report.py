"""A rated gearset as tables: for the terminal, as a page, as a data frame."""

import html
from typing import TYPE_CHECKING, Any

from asperity.gearset.library import GIVEN

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table

    from asperity.rating.rate import Rated
    from asperity.rating.result import Rating

_STYLE = """
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem 1rem 4rem; color: #1a1a1a;
  font: 1rem/1.45 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; }
table { border-collapse: collapse; width: 100%; margin-top: 2rem; font-size: .9rem; }
caption { text-align: left; font-size: 1.25rem; font-weight: 600; padding-bottom: .4rem; }
th, td { text-align: left; vertical-align: top; padding: .3rem .5rem; border-top: 1px solid #ddd; }
td:nth-child(2) { text-align: right; font-variant-numeric: tabular-nums; }
ul { max-width: 56rem; }
"""


def to_rich(rated: "Rated") -> "Group":
    """Return the tables of all ratings, the self-locking, and the notes, for the terminal."""
    from rich.console import Group
    from rich.table import Table
    from rich.text import Text

    parts: list[Any] = []
    for rating in rated.ratings:
        remarks = (Text(f"- {remark}") for remark in rating.remarks())
        parts += [_short(rating), *remarks, Text()]
    rows = rated.self_locking.to_rows()
    if rows:
        table = Table(title=_title(rated), title_justify="left", box=None, pad_edge=False)
        for name in rows[0]:
            table.add_column(name)
        for row in rows:
            table.add_row(*row.values())
        parts += [table, Text()]
    return Group(*parts, *(Text(f"- {note}") for note in rated.notes))


def _short(rating: "Rating") -> "Table":
    """Return a table narrow enough for a terminal: how far to trust it, but not by which source."""
    from rich.table import Table
    from rich.text import Text

    table = Table(title=rating.standard, title_justify="left", box=None, pad_edge=False)
    for name in ("symbol", "value", "unit", "meaning", "equation", "trust"):
        table.add_column(
            name,
            justify="right" if name == "value" else "left",
            no_wrap=name in ("symbol", "value", "unit", "trust"),
            overflow="fold",
            ratio={"meaning": 3, "equation": 4}.get(name),
        )
    for entry in rating:
        trust: str = entry.source.confidence
        if entry.assumed:
            trust = "assumed"
        elif entry.source is GIVEN:
            trust = "given"
        equation = "" if entry.equation == "input" else entry.equation
        cells = (entry.symbol or entry.key, entry.text, entry.unit, entry.meaning, equation, trust)
        table.add_row(*map(Text, cells))
    return table


def to_html(rated: "Rated") -> str:
    """Return a page of its own with the tables of all ratings."""
    name = html.escape(rated.gearset.name or "worm gearset")
    ratings = "\n".join(rating.to_html() for rating in rated.ratings)
    notes = "".join(f"<li>{html.escape(note)}</li>\n" for note in rated.notes)
    return (
        '<!doctype html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{name}, rated</title>\n<style>{_STYLE}</style>\n</head>\n<body>\n<main>\n"
        f"<h1>{name}, rated</h1>\n"
        + (f"<ul>\n{notes}</ul>\n" if notes else "")
        + f"{ratings}\n{_locking_html(rated)}</main>\n</body>\n</html>\n"
    )


def _locking_html(rated: "Rated") -> str:
    rows = rated.self_locking.to_rows()
    if not rows:
        return ""
    head = "".join(f"<th>{html.escape(name)}</th>" for name in rows[0])
    body = "\n".join(
        "<tr>" + "".join(f"<td>{html.escape(text)}</td>" for text in row.values()) + "</tr>"
        for row in rows
    )
    return (
        f"<table>\n<caption>{html.escape(_title(rated))}</caption>\n"
        f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table>\n"
    )


def to_frame(rated: "Rated") -> Any:
    """Return a pandas data frame of all ratings, indexed by standard and key."""
    import pandas  # type: ignore[import-untyped]

    found = rated.found
    if not found:
        return pandas.DataFrame()
    frames = {name: rating.to_frame() for name, rating in found.items()}
    # Attributes of frames are compared when they are joined, and lists in them have no equality.
    for frame in frames.values():
        frame.attrs = {}
    return pandas.concat(frames, names=["standard", "key"])


def _title(rated: "Rated") -> str:
    degrees = rated.self_locking.to_json()["lead_angle_deg"]
    return f"Self-locking at a lead angle of {degrees:.4g} deg"
