"""A case: its tables validated, its settings, and where each value came from."""

import contextlib
import dataclasses
import hashlib
import json
import numbers
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, overload

from asperity.casefile.setting import PATH, Raw, apply, known_table, listed
from asperity.casefile.table import Table, same_thing
from asperity.errors import InputError, nearest, plain, shown
from asperity.files import store
from asperity.files.shipped import SPEAKING, case_file, shipped_cases
from asperity.units import quantity_of

_TEXT_ONLY = {"text_only": True}


T = TypeVar("T", bound=Table)


@dataclasses.dataclass(frozen=True)
class Case:
    """A validated case.

    Attributes
    ----------
    source : str
        The file or shipped case it was read from, as given.
    folder : pathlib.Path
        Where relative file names inside the case start.
    tables : dict of str to Table
        The validated tables, in SI.
    raw : dict of str to dict
        The same as they would be written in a case file.
    known : mapping of str to type of Table
        Every table a case file may have.
    settings : dict of str to str
        The setting that gave a ``table.key``, for those that did not come from the file.
    axes : dict of str to str
        What gave a ``table.key`` all the values of a grid, of which the case has one.
    written : frozenset of str
        The ``table.key`` that the file gives, whatever came of it.
    """

    source: str
    folder: Path
    tables: dict[str, Table]
    raw: Raw
    known: Mapping[str, type[Table]] = dataclasses.field(repr=False)
    settings: dict[str, str] = dataclasses.field(default_factory=dict)
    axes: dict[str, str] = dataclasses.field(default_factory=dict)
    written: frozenset[str] = frozenset()

    def __repr__(self) -> str:
        return f"Case({self.source!r}: {', '.join(f'[{name}]' for name in self.tables)})"

    def __contains__(self, name: object) -> bool:
        return name in self.tables

    def __getitem__(self, name: str) -> Table:
        return self.require(name)

    @overload
    def require(self, table: str) -> Table: ...
    @overload
    def require(self, table: type[T]) -> T: ...
    def require(self, table: str | type[T]) -> Table | T:
        """Return a table by name or class; raises InputError if the case does not have it.

        Parameters
        ----------
        table : str or type of Table
            Its name, or its class.

        Returns
        -------
        Table
            Of that class.
        """
        name = getattr(table, "table", table)
        if not isinstance(name, str):
            raise InputError(f"{shown(table)} is no table of a case; name one, such as 'slider'")
        if name not in self.tables:
            raise InputError(f"{self.source}: the table [{name}] is missing; add it")
        return self.tables[name]

    @overload
    def get(self, table: type[T], default: T) -> T: ...
    @overload
    def get(self, table: type[T], default: None = None) -> T | None: ...
    def get(self, table: type[T], default: T | None = None) -> T | None:
        """Return a table by its class, or the default if the case does not have it.

        Parameters
        ----------
        table : type of Table
            Its class.
        default : Table, optional
            What stands in for it.

        Returns
        -------
        Table or None
            Of that class.
        """
        return self.require(table) if table.table in self.tables else default

    def origin(self, key: str) -> str:
        """Return what gave the value of a ``table.key``: a setting, or else the file.

        Parameters
        ----------
        key : str
            ``table.key``.

        Returns
        -------
        str
            The file's name, or ``--set`` with what was set.
        """
        setting = self.settings.get(key)
        return self.source if setting is None else f"--set {setting}"

    def replace(self, settings: Iterable[str]) -> "Case":
        """Return the case with ``table.key=value`` settings applied, all validated afterwards.

        Parameters
        ----------
        settings : iterable of str
            ``table.key=value``, units with their numbers.

        Returns
        -------
        Case
            Another one; this one stays as it is.

        Raises
        ------
        InputError
            A key that no table has, or a value that is not allowed.
        """
        raw = {name: dict(entries) for name, entries in self.raw.items()}
        given = dict(self.settings)
        for setting in listed(settings):
            given[apply(raw, setting, self.known)] = " ".join(setting.split())
        case = dataclasses.replace(self, tables={}, raw=raw, settings=given)
        with naming_source(case):
            for name, entries in raw.items():
                model = known_table(name, self.known)
                case.tables[name] = model.model_validate(entries, context=_TEXT_ONLY)
        return case

    def replace_values(self, values: Mapping[str, object]) -> "Case":
        """Return the case with values of ``table.key`` replaced, quantities as numbers in SI.

        This is the fast way for many cases: only the tables concerned are validated. None removes
        a key; one form of the same thing replaces another.

        Parameters
        ----------
        values : mapping of str to object
            Values by ``table.key``, in SI; None removes a key.

        Returns
        -------
        Case
            As of `replace`.

        Raises
        ------
        InputError
            A key that no table has, or a value that is not allowed.
        """
        changed: dict[str, dict[str, Any]] = {}
        raw = dict(self.raw)
        for path, value in values.items():
            name, _, key = path.partition(".")
            with naming_source(self):
                model = known_table(name, self.known)
            if name not in changed:
                old = self.tables.get(name)
                changed[name] = {k: getattr(old, k) for k in old.model_fields_set} if old else {}
                raw[name] = dict(raw.get(name, {}))
            for entries, entry in (
                (changed[name], value),
                (raw[name], _as_text(model, key, value)),
            ):
                for other in same_thing(model, key):
                    entries.pop(other, None)
                if value is not None:
                    entries[key] = entry
        tables = dict(self.tables)
        for name, entries in changed.items():
            with naming_source(self):
                tables[name] = self.known[name].model_validate(entries)
        return dataclasses.replace(self, tables=tables, raw=raw)

    def files(self) -> Iterator[tuple[str, Path]]:
        """Yield every file that a table names, with its ``table.key``."""
        for name, table in self.tables.items():
            for key, value in table:
                for path in _paths(value):
                    yield f"{name}.{key}", self.folder / path

    def canonical(self) -> str:
        """Return all values in SI, and the content of the files they name, as one fixed text.

        Cases that calculate the same have the same text, however they are written. Of a file that
        is named deeper in a table than by one of its keys the name alone counts.
        """
        counting = {name: table for name, table in self.tables.items() if table.counts}
        dumped = {name: table.model_dump(mode="json") for name, table in counting.items()}
        for name, table in counting.items():
            for key, value in table:
                if isinstance(value, Path) and (self.folder / value).is_file():
                    content = store.read_bytes(self.folder / value)
                    dumped[name][key] = f"sha256:{hashlib.sha256(content).hexdigest()}"
        return json.dumps(dumped, sort_keys=True, allow_nan=False)


def _paths(value: object) -> Iterator[Path]:
    """Yield the names of files in a value, however deep they stand in it."""
    if isinstance(value, Path):
        yield value
    parts: Iterable[object] = ()
    if isinstance(value, Table):
        parts = (each for _, each in value)
    elif isinstance(value, Mapping | list | tuple):
        parts = value.values() if isinstance(value, Mapping) else value
    for part in parts:
        yield from _paths(part)


@contextlib.contextmanager
def naming_source(case: Case, *others: str) -> Iterator[None]:
    """Let what is refused of a case name the file or the setting that gave it.

    Parameters
    ----------
    case : Case
        What is read.
    *others : str
        Names of other files that are read; what begins with one of them is no fault of the case.
    """
    try:
        yield
    except InputError as error:
        text = str(error)
        names = [f"{plain(n)}{end}" for o in others for n in (o, str(Path(o))) for end in ": "]
        if not text.startswith((f"{case.source}: ", f"{case.source} ", "--", *names)):
            key = PATH.match(text)
            origin = case.origin(key.group()) if key else case.source
            error.args = (f"{origin}: {text}", *error.args[1:])
        raise


def read_case(
    name_or_path: str | os.PathLike[str],
    tables: Mapping[str, type[Table]],
    settings: Sequence[str] = (),
) -> Case:
    """Read and validate a case file.

    Parameters
    ----------
    name_or_path : str or path
        A TOML file, or the name of a case that ships.
    tables : mapping of str to type of Table
        Every table a case file may have; all that are present are validated.
    settings : sequence of str
        ``table.key=value`` to add or replace. What has a unit needs it, as in the file; an angle
        without one is in degrees. A relative file name starts at the working directory, where one
        in the file starts at the file's folder.

    Returns
    -------
    Case
        Its tables, and what it was read from.

    Raises
    ------
    InputError
        One line that names the file or setting, the key, the value and what is allowed.
    """
    case, _ = read_raw(name_or_path, tables)
    for name, entries in case.raw.items():
        if isinstance(entries, list):
            raise InputError(
                f"{case.source}: [{name}] is given as a list; write it once, as [{name}]"
            )
        if not isinstance(entries, dict):
            raise InputError(
                f"{case.source}: {name} stands outside a table; put it below a heading such as "
                "[slider]"
            )
    return case.replace(settings)


def read_raw(
    name_or_path: str | os.PathLike[str], tables: Mapping[str, type[Table]]
) -> tuple[Case, str]:
    """Return a case whose tables are not validated yet, and the text of its file."""
    path = case_file(name_or_path)
    source = plain(str(name_or_path))
    try:
        text, raw = store.read_toml_text(path, source)
    except InputError as error:
        if not isinstance(error.__cause__, FileNotFoundError):
            raise
        known = nearest(plain(path.name).removesuffix(".toml"), (*shipped_cases(), *SPEAKING))
        raise InputError(f"{source} is neither a file nor a case that ships{known}") from None
    case = Case(source, path.parent.absolute(), {}, raw, tables)
    tabled = ((name, entries) for name, entries in raw.items() if isinstance(entries, dict))
    keys = frozenset(f"{name}.{key}" for name, entries in tabled for key in entries)
    return dataclasses.replace(case, written=keys), text


def _as_text(model: type[Table], key: str, value: object) -> object:
    quantity = quantity_of(model, key)
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        return value
    if quantity:
        return f"{float(value)!r} {quantity.unit}" if quantity.unit else float(value)
    return value
