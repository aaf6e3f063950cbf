"""Tables as text for a terminal."""

import io
import textwrap
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from asperity.results.table import Table

_MOST_READABLE = 79


def rendered(tables: "Iterable[Table]", width: int | None = None) -> str:
    """Return tables as text, their remarks below each.

    Parameters
    ----------
    tables : iterable of Table
        What to show.
    width : int, optional
        In characters; left out: the terminal's.
    """
    from rich import table as rich_table
    from rich.console import Console
    from rich.text import Text

    console = Console(file=io.StringIO(), highlight=False, markup=False, width=width)
    with console.capture() as capture:
        for place, table in enumerate(tables):
            if place:
                console.print()
            if table.title:
                console.print(Text(table.title))
            shown = rich_table.Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
            for column in table.columns:
                shown.add_column(
                    column.heading,
                    justify="right" if column.right else "left",
                    no_wrap=not column.weight,
                    overflow="fold",
                    ratio=column.weight or None,
                )
            for row in table.rows:
                # As text, because brackets in a formula would be taken for markup.
                shown.add_row(*map(Text, row))
            if table.columns:
                console.print(shown)
            for remark in table.remarks:
                for line in textwrap.wrap(
                    f"- {remark}",
                    min(console.width, _MOST_READABLE),
                    subsequent_indent="  ",
                    break_on_hyphens=False,
                ):
                    console.print(Text(line))
    return "\n".join(line.rstrip() for line in capture.get().splitlines())
