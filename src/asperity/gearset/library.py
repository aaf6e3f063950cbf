"""Named materials, lubricants and bearings from data files, each value with its source.

A data file is TOML. ``[source.ID]`` says where values come from (``name``, ``confidence``,
``note``), and every other table holds one thing: ``[wheel.NAME]``, ``[plastic.NAME]``,
``[worm.NAME]``, ``[steel.NAME]``, ``[base_oil.NAME]``, ``[lubricant.NAME]``,
``[bearings.NAME]``, ``[motor.NAME]``, ``[bearing.NAME]``, ``[shaft_steel.NAME]`` or
``[hob.NAME]``, with the keys of its class. Its
key ``from`` names the source of each value by key, with ``"*"`` for all others::

    [source.maker]
    name = "data sheet of the foundry, 2024"
    confidence = "one source"

    [wheel."our bronze"]
    family = "tin bronze"
    youngs_modulus = "95 GPa"
    # ... the other keys of WheelMaterial
    from = { "*" = "maker" }

Files of your own are named on the command line, ``asperity --materials FILE COMMAND``, or in the
environment variable ``ASPERITY_MATERIALS`` (several with the separator of ``PATH``). The last file
that has a name wins.
"""

import functools
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, NamedTuple, TypeVar

from pydantic import Field

from asperity.casefile import Table
from asperity.errors import InputError, nearest, shown, suggestion
from asperity.files import store
from asperity.sources import Source

VARIABLE = "ASPERITY_MATERIALS"
SECTIONS: Mapping[str, str] = {
    "wheel": "wheel material",
    "worm": "worm material",
    "plastic": "plastic of wheels",
    "steel": "steel",
    "base_oil": "base oil",
    "lubricant": "lubricant",
    "bearings": "arrangement of bearings",
    "motor": "motor",
    "bearing": "rolling bearing",
    "shaft_steel": "steel of shafts",
    "hob": "hob",
}
"""The tables of a data file, and what they hold."""

GIVEN = Source("the case", "one source", "given by the user")
"""Source of a value that the user wrote."""

_SHIPPED = Path(__file__).parent / "data"
_TEXT_ONLY = {"text_only": True}


class Sourced(Table):
    """What a data file holds by name, each value with its source.

    Attributes
    ----------
    section : str
        The table of a data file that holds it.
    also : str
        The table of those that may stand for it by their name or number; ``""`` for none.
    """

    section: ClassVar[str]
    also: ClassVar[str] = ""

    name: str = ""
    sources: Annotated[Mapping[str, Source], Field(exclude=True)] = {}

    def source(self, key: str) -> Source:
        """Return where a value comes from."""
        return self.sources.get(key, GIVEN)


T = TypeVar("T", bound=Sourced)


class _Entry(NamedTuple):
    file: str
    values: dict[str, Any]
    sources: dict[str, Source]


_Library = Mapping[tuple[str, str], _Entry]


def find(model: type[T], name: str) -> T:
    """Return a thing by the name it has in a data file.

    Parameters
    ----------
    model : type
        Such as `WheelMaterial`, a table of data files.
    name : str
        As the data file has it.

    Returns
    -------
    table
        Of that class.

    Raises
    ------
    InputError
        There is none of that name, or a data file is wrong.
    """
    found = _find(model, name, _stamps())
    assert isinstance(found, model)
    return found


def every(model: type[T]) -> tuple[T, ...]:
    """Return all things of a kind, in the order of the data files; raises InputError as `find`.

    Parameters
    ----------
    model : type
        Such as `WheelMaterial`, a table of data files.

    Returns
    -------
    tuple of table
        Of that class.
    """
    library = _library(_stamps())
    return tuple(find(model, name) for section, name in library if section == model.section)


def resolve(model: type[T], value: object, context: Any = None) -> T:
    """Return the thing that a name or an inline table of a case stands for."""
    if isinstance(value, str):
        try:
            return find(model, value)
        except InputError as error:
            raise InputError(f"{model.table} is {value!r}; {error}") from None
    if isinstance(value, Mapping):
        if "sources" in value:
            raise InputError(f"{model.table}.sources is given; leave it out")
        return model.model_validate({"name": "given in the case", **value}, context=context)
    if not isinstance(value, model):
        raise InputError(f"{model.table} is {value!r}; it must be a name or a table of values")
    return value


_Stamps = tuple[tuple[Path, tuple[int, int, int]], ...]


@functools.lru_cache(maxsize=256)
def _find(model: type[Sourced], name: str, stamps: _Stamps) -> Sourced:
    section, library = model.section, _library(stamps)
    if (section, name) not in library:
        known = [other for kind, other in library if kind == section]
        others = [
            word
            for (kind, other), entry in library.items()
            if kind == model.also
            for word in (other, str(entry.values.get("number", "")))
        ]
        near = suggestion(name, (*known, *others)) or f"{nearest(name, known)}{_where(known)}"
        raise InputError(f"no {SECTIONS[section]} of that name is known{near}")
    entry = library[section, name]
    try:
        return model.model_validate(
            {"name": name, **entry.values, "sources": entry.sources}, context=_TEXT_ONLY
        )
    except InputError as error:
        raise InputError(f'{entry.file}: [{section}."{name}"]: {error}') from None


def _where(known: Sequence[str]) -> str:
    """Say what to do about a name that is nowhere."""
    if not own_files():
        return "; where a data file of your own has it, name that as asperity --materials FILE"
    return "" if known else "; none of the data files that are named has one"


def add_files(paths: Sequence[str]) -> None:
    """Take data files of one's own beside those that the environment names, in this process.

    Raises
    ------
    InputError
        One cannot be read, or its name cannot stand in the environment.
    """
    for path in paths:
        if os.pathsep in path or not path:
            raise InputError(
                f"--materials {path}: a name with {os.pathsep!r} in it, or none, is not possible; "
                "give the file another name"
            )
    named = [path for path in os.environ.get(VARIABLE, "").split(os.pathsep) if path]
    os.environ[VARIABLE] = os.pathsep.join([*named, *(str(Path(p).absolute()) for p in paths)])
    _library(_stamps())


def own_files() -> tuple[str, ...]:
    """Return the data files that the user named."""
    return tuple(filter(None, os.environ.get(VARIABLE, "").split(os.pathsep)))


def _stamps() -> _Stamps:
    stamps = []
    for path in map(Path, own_files()):
        try:
            stamps.append((path.absolute(), store.stamp(path)))
        except OSError as error:
            raise InputError(
                f"{path} cannot be read: {store.reason(error)}; name a data file in --materials "
                f"or {VARIABLE}"
            ) from None
    return tuple(stamps)


@functools.lru_cache(maxsize=16)
def _library(stamps: _Stamps) -> _Library:
    library: dict[tuple[str, str], _Entry] = {}
    for path in (*sorted(_SHIPPED.glob("*.toml")), *(path for path, _ in stamps)):
        library.update(_read(path))
    return library


def _read(path: Path) -> dict[tuple[str, str], _Entry]:
    file = path.name
    raw = store.read_toml(path)
    sources = _sources(file, raw.pop("source", {}))
    entries: dict[tuple[str, str], _Entry] = {}
    for section, things in raw.items():
        if section not in SECTIONS:
            known = nearest(section, ("source", *SECTIONS))
            raise InputError(f"{file}: [{section}] is not a table of a data file{known}")
        for name, values in _tables(file, section, things):
            given = values.pop("from", {})
            where = f'{file}: [{section}."{name}"]'
            entries[section, name] = _Entry(file, values, _assign(where, given, values, sources))
    return entries


def _tables(file: str, section: str, things: Any) -> list[tuple[str, dict[str, Any]]]:
    if not isinstance(things, dict) or not all(isinstance(v, dict) for v in things.values()):
        raise InputError(f'{file}: [{section}] must hold tables with names, as in [{section}."x"]')
    return [(name, dict(values)) for name, values in things.items()]


def _sources(file: str, raw: Any) -> dict[str, Source]:
    sources = {}
    for key, values in _tables(file, "source", raw):
        try:
            sources[key] = Source(**values)
        except TypeError:
            raise InputError(
                f"{file}: [source.{key}] must have name, confidence and perhaps note"
            ) from None
        except InputError as error:
            raise InputError(f"{file}: [source.{key}]: {error}") from None
    return sources


def _assign(
    where: str, given: Any, values: Mapping[str, Any], sources: Mapping[str, Source]
) -> dict[str, Source]:
    if not isinstance(given, dict):
        raise InputError(f"{where}: from is {given!r}; it must be a table of keys and sources")
    for key, source in given.items():
        if not isinstance(source, str) or source not in sources:
            near = nearest(source, sources) if isinstance(source, str) else ""
            raise InputError(f"{where}: from.{key} is {shown(source)}{near}")
    rest = sources[given["*"]] if "*" in given else GIVEN
    return {
        key: sources[given[key]] if key in given else rest
        for key in (*values, *given)
        if key != "*"
    }
