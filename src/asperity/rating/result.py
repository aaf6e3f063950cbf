"""What a rating is: every factor with its symbol, unit, equation and source; tables of them."""

import dataclasses
import html
import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from asperity.errors import InputError, nearest
from asperity.sources import Source

if TYPE_CHECKING:
    from rich.console import Group

Value = float | int | bool | str

COLUMNS = (
    "symbol",
    "value",
    "unit",
    "meaning",
    "equation",
    "source",
    "confidence",
    "note",
    "assumed",
)
"""Columns of a table of entries."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """One quantity of a rating.

    Parameters
    ----------
    key : str
        Name in JSON, with the unit the standard uses: ``"sigma_Hm_MPa"``.
    symbol : str
        The standard's symbol.
    value : float, int, bool or str
        Never NaN, nor infinite.
    unit : str
        Unit of the value; ``""`` for a ratio.
    meaning : str
        What it is, in a few words.
    equation : str
        How it is found, in the standard's symbols; ``"input"`` for what was given.
    source : Source
        Where the equation, or the weakest number it rests on, comes from.
    assumed : bool
        Whether it is a default and not what the user gave.
    """

    key: str
    symbol: str
    value: Value
    unit: str
    meaning: str
    equation: str
    source: Source
    assumed: bool = False

    def __post_init__(self) -> None:
        if isinstance(self.value, float) and not math.isfinite(self.value):
            raise ValueError(f"{self.key} is {self.value}; a rating holds finite numbers only")

    @property
    def from_memory(self) -> bool:
        """Whether it rests on something no document at hand confirms."""
        return self.source.confidence == "from memory"

    @property
    def text(self) -> str:
        """The value as a table shows it."""
        if isinstance(self.value, bool):
            return "yes" if self.value else "no"
        return f"{self.value:.5g}" if isinstance(self.value, float) else str(self.value)

    def row(self) -> dict[str, str]:
        """Return the texts of the columns `COLUMNS`."""
        return {
            "symbol": self.symbol,
            "value": self.text,
            "unit": self.unit,
            "meaning": self.meaning,
            "equation": self.equation,
            "source": self.source.name,
            "confidence": self.source.confidence,
            "note": self.source.note,
            "assumed": "assumed" if self.assumed else "",
        }


@dataclasses.dataclass(frozen=True)
class Rating:
    """A worm gearset rated by one standard.

    Parameters
    ----------
    standard : str
        Name of the standard with its edition.
    entries : tuple of Entry
        In the order of the calculation; each key once.
    violations : tuple of str
        Limits of validity that do not hold, a sentence each.
    notes : tuple of str
        What else a reader of the numbers should know.

    Examples
    --------
    >>> source = Source("ISO/TR 14521:2010", "verified")
    >>> ratio = Entry("ratio", "u", 15.0, "", "gear ratio", "z_2/z_1", source)
    >>> Rating("ISO/TR 14521:2010", (ratio,))["ratio"]
    15.0
    """

    standard: str
    entries: tuple[Entry, ...]
    violations: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        keys = [entry.key for entry in self.entries]
        twice = {key for key in keys if keys.count(key) > 1}
        if twice:
            raise ValueError(f"{', '.join(sorted(twice))}: an entry's key must occur once")

    def __getitem__(self, key: str) -> Value:
        return self.entry(key).value

    def __contains__(self, key: object) -> bool:
        return any(entry.key == key for entry in self.entries)

    def __iter__(self) -> Iterator[Entry]:
        return iter(self.entries)

    def __len__(self) -> int:
        return len(self.entries)

    def entry(self, key: str) -> Entry:
        """Return the entry with a key.

        Raises
        ------
        InputError
            There is none.
        """
        for entry in self.entries:
            if entry.key == key:
                return entry
        known = nearest(key, [entry.key for entry in self.entries])
        raise InputError(f"{key!r} is not part of the rating by {self.standard}{known}")

    @property
    def assumed(self) -> tuple[str, ...]:
        """Keys of the entries that are defaults."""
        return tuple(entry.key for entry in self.entries if entry.assumed)

    @property
    def from_memory(self) -> tuple[str, ...]:
        """Keys of the entries that rest on something no document at hand confirms."""
        return tuple(entry.key for entry in self.entries if entry.from_memory)

    def remarks(self) -> tuple[str, ...]:
        """Return the violations, what rests on memory, what was assumed, and the notes."""
        remarks = [f"outside its validity: {violation}" for violation in self.violations]
        for words, marked in (
            ("from memory, check before use", [e for e in self.entries if e.from_memory]),
            ("assumed, give them to replace the defaults", [e for e in self.entries if e.assumed]),
        ):
            if marked:
                names = ", ".join(entry.symbol or entry.key for entry in marked)
                remarks.append(f"{words}: {names}")
        return (*remarks, *self.notes)

    def to_json(self) -> dict[str, Any]:
        """Return the values by key, and lists: violations, notes, assumed and from_memory keys."""
        return {
            "standard": self.standard,
            **{entry.key: entry.value for entry in self.entries},
            "violations": list(self.violations),
            "assumed": list(self.assumed),
            "from_memory": list(self.from_memory),
            "notes": list(self.notes),
        }

    def to_rows(self) -> list[dict[str, str]]:
        """Return a row of texts for every entry, by the names in `COLUMNS`."""
        return [entry.row() for entry in self.entries]

    def to_rich(self) -> "Group":
        """Return a table for the terminal, with the remarks below it."""
        from rich.console import Group
        from rich.table import Table
        from rich.text import Text

        table = Table(title=self.standard, title_justify="left", box=None, pad_edge=False)
        for name in ("symbol", "value", "unit", "meaning", "equation", "source"):
            table.add_column(
                name,
                justify="right" if name == "value" else "left",
                no_wrap=name in ("symbol", "value", "unit"),
                overflow="fold",
            )
        for entry in self.entries:
            row = entry.row()
            mark = "*" if entry.assumed else ""
            # As text, because brackets in a formula would be taken for markup.
            cells = (row["symbol"], row["value"] + mark, row["unit"], row["meaning"])
            table.add_row(*map(Text, (*cells, row["equation"], str(entry.source))))
        remarks = list(self.remarks())
        return Group(table, *(Text(f"- {remark}") for remark in remarks))

    def to_html(self) -> str:
        """Return a table in HTML, with the remarks below it as a list."""
        head = "".join(f"<th>{name}</th>" for name in COLUMNS)
        body = "\n".join(
            "<tr>" + "".join(f"<td>{html.escape(row[name])}</td>" for name in COLUMNS) + "</tr>"
            for row in self.to_rows()
        )
        remarks = "".join(f"<li>{html.escape(remark)}</li>\n" for remark in self.remarks())
        return (
            f'<table class="rating">\n<caption>{html.escape(self.standard)}</caption>\n'
            f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody>\n</table>\n"
            + (f"<ul>\n{remarks}</ul>\n" if remarks else "")
        )

    def _repr_html_(self) -> str:
        return self.to_html()

    def to_frame(self) -> Any:
        """Return a pandas data frame indexed by key, values as numbers, remarks as attributes."""
        import pandas  # type: ignore[import-untyped]

        rows: list[Mapping[str, Any]] = [
            {**entry.row(), "value": entry.value, "assumed": entry.assumed}
            for entry in self.entries
        ]
        index = pandas.Index([entry.key for entry in self.entries], name="key")
        frame = pandas.DataFrame(rows, index=index, columns=list(COLUMNS))
        frame.attrs.update(
            standard=self.standard, violations=list(self.violations), notes=list(self.notes)
        )
        return frame
