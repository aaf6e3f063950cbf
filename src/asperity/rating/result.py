"""What a rating is: every factor with its symbol, unit, equation and source; tables of them."""

import dataclasses
import functools
import math
from collections.abc import Collection, Iterator, Mapping
from typing import Any

from asperity.errors import InputError, nearest, shown
from asperity.gearset.library import GIVEN
from asperity.results.table import Column, Table
from asperity.sources import Source

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
    of_equation : Source, optional
        Where the equation itself comes from, if `source` is that of a number it rests on.
    """

    key: str
    symbol: str
    value: Value
    unit: str
    meaning: str
    equation: str
    source: Source
    assumed: bool = False
    of_equation: Source | None = None

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

    @property
    def shown_equation(self) -> str:
        """The equation; nothing for what was given."""
        return "" if self.equation == "input" else self.equation

    @property
    def trust(self) -> str:
        """Whether it was given or assumed, or how far its source is to be trusted."""
        if self.assumed:
            return "assumed"
        return "given" if self.source is GIVEN else self.source.confidence

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
    gaps : tuple of str
        Those of the notes that say why something of the gearset has no answer.

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
    gaps: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        keys = [entry.key for entry in self.entries]
        if len(set(keys)) < len(keys):
            twice = {key for key in keys if keys.count(key) > 1}
            raise ValueError(f"{', '.join(sorted(twice))}: an entry's key must occur once")

    def __getitem__(self, key: str) -> Value:
        return self.entry(key).value

    def __contains__(self, key: object) -> bool:
        return self._entry(key) is not None

    def __iter__(self) -> Iterator[Entry]:
        return iter(self.entries)

    def __len__(self) -> int:
        return len(self.entries)

    def entry(self, key: str) -> Entry:
        """Return the entry with a key, or with a symbol as it is printed.

        Parameters
        ----------
        key : str
            Of an entry, or its symbol.

        Returns
        -------
        Entry
            Value, unit, equation and source.

        Raises
        ------
        InputError
            There is none.
        """
        found = self._entry(key)
        if found is not None:
            return found
        names = [name for entry in self.entries for name in (entry.key, entry.symbol) if name]
        raise InputError(
            f"{shown(key)} is not part of the rating by {self.standard}{nearest(key, names)}"
        )

    def _entry(self, key: object) -> Entry | None:
        return self._found.get(key) if isinstance(key, str) else None

    @functools.cached_property
    def _found(self) -> dict[str, Entry]:
        """The entries by symbol, the first that has it, and before that by key."""
        by_symbol = {entry.symbol: entry for entry in reversed(self.entries)}
        return by_symbol | {entry.key: entry for entry in self.entries}

    def without(self, keys: Collection[str], why: str) -> "Rating":
        """Return it without entries that do not hold for the gearset.

        Parameters
        ----------
        keys : collection of str
            Of the entries.
        why : str
            The reason, which is a gap of the rating then.

        Returns
        -------
        Rating
            With all others.
        """
        entries = tuple(entry for entry in self.entries if entry.key not in keys)
        return dataclasses.replace(
            self, entries=entries, notes=(*self.notes, why), gaps=(*self.gaps, why)
        )

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

    def table(self, *, sources: bool = False) -> Table:
        """Return the entries as a table with the remarks below it.

        Parameters
        ----------
        sources : bool
            Whether each number's source and its note are columns; else one tells how far to trust
            it, which a terminal has room for.

        Returns
        -------
        Table
            A row an entry.
        """
        if sources:
            columns = tuple(Column(name, right=name == "value") for name in COLUMNS)
            rows = [tuple(entry.row().values()) for entry in self.entries]
        else:
            names = "symbol", "value", "unit", "meaning", "equation", "trust"
            columns = tuple(
                Column(n, right=n == "value", folds=n in ("meaning", "equation")) for n in names
            )
            rows = [
                (e.symbol or e.key, e.text, e.unit, e.meaning, e.shown_equation, e.trust)
                for e in self.entries
            ]
        return Table(columns, tuple(rows), self.standard, self.remarks())

    def __repr__(self) -> str:
        return f"<Rating by {self.standard}: {len(self.entries)} numbers by key and by symbol>"

    def _repr_html_(self) -> str:
        from asperity.results.page import fragment

        return fragment([self.table(sources=True)])

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
