"""A grid as a table: a matrix where it fits a terminal, a list where not."""

import itertools
from collections.abc import Sequence

from asperity.arrays import FloatArray
from asperity.results.table import Table
from asperity.sweep.axes import Axis

_MOST_ROWS = 60
_MOST_COLUMNS = 9


def grid_table(axes: Sequence[Axis], values: FloatArray, remarks: tuple[str, ...]) -> Table:
    """Return a variable over a grid of at most some rows; what is left out is remarked."""
    if len(axes) == 2 and len(axes[1].shown) <= _MOST_COLUMNS:
        headings = [" \\ ".join(map(_heading, axes)), *map(_text, axes[1].shown)]
        rows = [[shown, *row] for shown, row in zip(axes[0].shown, values.tolist(), strict=True)]
    else:
        headings = [*map(_heading, axes), "ratio"]
        places = itertools.product(*(axis.shown for axis in axes))
        pairs = zip(places, values.flat, strict=True)
        rows = [[*place, float(value)] for place, value in itertools.islice(pairs, _MOST_ROWS + 1)]
    more = max((len(axes[0].shown) if len(rows[0]) > len(axes) + 1 else values.size), 0)
    if more > _MOST_ROWS:
        left = f"... and {more - _MOST_ROWS} more rows; --out or --json gives all"
        remarks = (left, *remarks)
    return Table.of(headings, rows[:_MOST_ROWS], remarks=remarks)


def _heading(axis: Axis) -> str:
    return f"{axis.key} ({axis.unit})" if axis.unit else axis.key


def _text(value: object) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)
