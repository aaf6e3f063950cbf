"""A quantity of an answer: a field with symbol, unit and meaning, said once.

::

    class Pull(Result):
        ratio: float = quantity("F_d/(mu F_N)", "", "mean drive force over mu F_N")
        force: float = quantity("F_d", "N", "mean drive force")
        course: FloatArray = quantity("x", "m", "position", dims=("time",))
"""

import dataclasses
import types
import typing
from collections.abc import Callable, Iterable, Iterator
from typing import Any, ClassVar, Literal, Protocol, TypeVar, dataclass_transform

import numpy as np

from asperity.results.words import text_of

F = TypeVar("F", bound=Callable[..., Any])

_LABEL = "label"
_MOST_SHOWN = 8
CI95 = "_ci95"
"""What the name of an interval's ends ends in."""


@dataclasses.dataclass(frozen=True)
class Label:
    """What is said of a quantity wherever it appears.

    Attributes
    ----------
    symbol, unit, meaning : str
        As the field writes them; an empty unit is that of a ratio.
    key : str or None
        In JSON; None: the field's name with the unit behind it.
    variable : str or None
        In a dataset; None: the field's name.
    dims : tuple of str
        Of an array; a scalar has none.
    coordinate : bool
        Whether it is a coordinate of the dataset.
    only : {'json', 'file', None}
        Where it appears, if not in both. Arrays appear in datasets alone.
    shown : bool
        Whether tables have a row of it.
    swept : bool
        Whether a sweep keeps it, if it is a number.
    optional : bool
        Whether it is left out where it is None, instead of being told as such.
    is_ends : bool
        Whether it is both ends of an interval.
    """

    symbol: str
    unit: str
    meaning: str
    key: str | None = None
    variable: str | None = None
    dims: tuple[str, ...] = ()
    coordinate: bool = False
    only: Literal["json", "file"] | None = None
    shown: bool = True
    swept: bool = True
    optional: bool = False
    is_ends: bool = False


@dataclasses.dataclass(frozen=True)
class Measured:
    """A number with an interval: what is said of it, and of its ends."""

    label: Label
    ends: Label


@dataclasses.dataclass(frozen=True)
class Part:
    """An answer within an answer, its names behind a prefix."""

    of: "type[Quantities]"
    prefix: str


class Origin(Protocol):
    """Where a number comes from."""

    @property
    def equation(self) -> str:
        """Which it follows from."""

    @property
    def source(self) -> object:
        """Where that stands, or whoever measured it."""

    @property
    def of_equation(self) -> object:
        """Where the equation itself stands, if `source` is of what it rests on; else None."""

    @property
    def trust(self) -> str:
        """How far it can be relied upon."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """A quantity of one answer, or of a class of them, which have no value.

    Attributes
    ----------
    name : str
        Of the field, with the prefix of the part it stands in.
    label : Label
        What is said of it.
    value : object
        None where it does not exist.
    resolution : float
        Size below which it is rounding, in its unit.
    origin : Origin, optional
        Where it comes from, if that is known of each number.
    """

    name: str
    label: Label
    value: Any = None
    resolution: float = 0.0
    origin: "Origin | None" = None

    @property
    def key(self) -> str:
        """Name in JSON, which tells the unit."""
        return self.label.key or self.name + unit_suffix(self.label.unit)

    @property
    def variable(self) -> str:
        """Name in a dataset."""
        return self.label.variable or self.name

    @property
    def in_json(self) -> bool:
        """Whether JSON has it."""
        return self.label.only != "file" and not self.label.dims

    @property
    def in_file(self) -> bool:
        """Whether a dataset has it."""
        return self.label.only != "json"


def quantity(
    symbol: str,
    unit: str,
    meaning: str,
    *,
    default: Any = dataclasses.MISSING,
    key: str | None = None,
    variable: str | None = None,
    dims: tuple[str, ...] = (),
    coordinate: bool = False,
    only: Literal["json", "file"] | None = None,
    shown: bool = True,
    swept: bool = True,
    optional: bool = False,
) -> Any:
    """Declare a field as a quantity; the parameters are those of :class:`Label`."""
    label = Label(
        symbol, unit, meaning, key, variable, dims, coordinate, only, shown, swept, optional
    )
    return dataclasses.field(default=default, metadata={_LABEL: label})


def labelled(symbol: str, unit: str, meaning: str, **options: Any) -> Callable[[F], F]:
    """Declare what follows from fields as a quantity, between ``@property`` and its function.

    Parameters
    ----------
    symbol, unit, meaning : str
        As of :class:`Label`.
    **options
        The other attributes of :class:`Label`.

    Returns
    -------
    callable
        The decorator.
    """

    def mark(function: F) -> F:
        function.label = Label(symbol, unit, meaning, **options)  # type: ignore[attr-defined]
        return function

    return mark


def measured(
    symbol: str,
    unit: str,
    meaning: str,
    *,
    key: str | None = None,
    only: Literal["file"] | None = None,
    ends_only: Literal["json", "file"] | None = None,
) -> Any:
    """Declare a field as an `asperity.results.interval.Interval` or None, which it is by default.

    JSON has it as two keys, ``torque_Nm`` and ``torque_ci95_Nm``, a dataset as two variables.

    Parameters
    ----------
    symbol, unit, meaning, key, only : str
        Of the number, as of :class:`Label`; the key of the ends follows from its own.
    ends_only : {'json', 'file', None}
        Where the ends appear, if not wherever the number does.

    Returns
    -------
    object
        What a class derived from :class:`Quantities` takes as a field.
    """
    label = Label(symbol, unit, meaning, key, only=only, swept=False)
    ends = Label("", unit, f"{meaning}: interval of 95 %", only=ends_only or only, shown=False,
                 swept=False, is_ends=True)  # fmt: skip
    return dataclasses.field(default=None, metadata={_LABEL: Measured(label, ends)})


def part(of: "type[Quantities]", prefix: str = "", *, default: Any = dataclasses.MISSING) -> Any:
    """Declare a field as an answer within the answer, or None.

    Parameters
    ----------
    of, prefix : type of Quantities, str
        The class of the answer, and what stands before the names of its quantities.
    default : object
        As of a field; None where the answer may be missing.

    Returns
    -------
    dataclasses.Field
        The field.
    """
    return dataclasses.field(default=default, metadata={_LABEL: Part(of, prefix)})


@dataclass_transform(
    kw_only_default=True,
    frozen_default=True,
    eq_default=False,
    field_specifiers=(quantity, measured, part),
)
class Quantities:
    """Fields that are quantities; a class derived from it is a frozen dataclass."""

    _labels: ClassVar[dict[str, Label | Measured | Part]] = {}

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        # Read before the fields turn into descriptors, so that they keep their order.
        own = {name: found for name in vars(cls) if (found := _label(vars(cls)[name])) is not None}
        inherited: dict[str, Label | Measured | Part] = {}
        for base in reversed(cls.__mro__[1:]):
            inherited |= vars(base).get("_labels", {})
        cls._labels = inherited | own
        dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)(cls)

    def entries(self) -> Iterator[Entry]:
        """Yield every quantity with its value, those of parts behind their prefix."""
        yield from _entries(type(self), self, "")

    def keyed(self) -> Iterator[tuple[str, Entry]]:
        """Yield the numbers of JSON by where they stand in it."""
        for entry in self.entries():
            if entry.in_json:
                yield entry.key, entry

    @classmethod
    def declared(cls) -> Iterator[Entry]:
        """Yield every quantity the class declares, without values."""
        yield from _entries(cls, None, "")

    @classmethod
    def scalars(cls) -> tuple[Entry, ...]:
        """Return the scalars a sweep keeps: those declared as float, and truths as 0 or 1."""
        return tuple(entry for entry in _floats(cls, "") if entry.label.swept)

    def to_json(self) -> dict[str, Any]:
        """Return the scalars by key, each key with its unit."""
        return {entry.key: plain(entry.value) for entry in self.entries() if entry.in_json}

    def __repr__(self) -> str:
        shown = [
            f"{entry.name}={text_of(entry.value, entry.resolution)} {entry.label.unit}".rstrip()
            for entry in self.entries()
            if entry.label.shown and not entry.label.dims and entry.value is not None
        ]
        more = f", ... {len(shown) - _MOST_SHOWN} more" if len(shown) > _MOST_SHOWN else ""
        return f"{type(self).__name__}({', '.join(shown[:_MOST_SHOWN])}{more})"

    def resolution(self, name: str) -> float:
        """Return the size below which a quantity is rounding and shown as none, in its unit."""
        return 0.0


def _label(member: object) -> Label | Measured | Part | None:
    if isinstance(member, dataclasses.Field):
        found = member.metadata.get(_LABEL)
    else:
        found = getattr(getattr(member, "fget", None), _LABEL, None)
    return found if isinstance(found, Label | Measured | Part) else None


def _entries(cls: type[Quantities], holder: object, prefix: str) -> Iterator[Entry]:
    for name, label in cls._labels.items():
        value = None if holder is None else getattr(holder, name)
        if isinstance(label, Label):
            if label.optional and holder is not None and value is None:
                continue
            below = holder.resolution(name) if isinstance(holder, Quantities) else 0.0
            yield Entry(prefix + name, label, value, below)
        elif isinstance(label, Measured):
            yield from _measured(prefix + name, label, value)
        elif holder is None:
            yield from _entries(label.of, None, prefix + label.prefix)
        elif value is not None:
            yield from _entries(type(value), value, prefix + label.prefix)


def _measured(name: str, both: Measured, found: Any) -> Iterator[Entry]:
    value, ends = (None, None) if found is None else (found.value, found.ends)
    yield (number := Entry(name, both.label, value))
    key = f"{name}{CI95}{number.key.removeprefix(name)}"
    yield Entry(name + CI95, dataclasses.replace(both.ends, key=key), ends)


def _floats(cls: type[Quantities], prefix: str) -> Iterator[Entry]:
    for name, label in cls._labels.items():
        if isinstance(label, Part):
            yield from _floats(label.of, prefix + label.prefix)
        elif isinstance(label, Measured) or label.only == "file" or label.dims:
            continue
        elif _is_number(_annotation(cls, name)):
            yield Entry(prefix + name, label)


def _annotation(cls: type, name: str) -> Any:
    for base in cls.__mro__:
        member = vars(base).get(name)
        if isinstance(member, property):
            return member.fget.__annotations__.get("return")
        if name in vars(base).get("__annotations__", {}):
            return vars(base)["__annotations__"][name]
    return None


def _is_number(annotation: Any) -> bool:
    # An annotation may be text, where it names what is imported for types alone.
    if isinstance(annotation, str):
        return annotation.replace(" ", "") in ("float", "float|None", "bool")
    if isinstance(annotation, types.UnionType):
        return set(typing.get_args(annotation)) == {float, types.NoneType}
    return annotation in (float, bool)


def unit_suffix(unit: str) -> str:
    """Return what a key of JSON says of a unit: ``_N``, ``_mm_per_s``; nothing of a ratio."""
    if unit in ("", "1"):
        return ""
    words = unit.replace(" ", "").replace("*", "").replace("/", "_per_").replace("^", "")
    return f"_{words.replace('%', 'percent').replace('°', 'deg')}"


def unit_at_end(key: str, units: Iterable[str]) -> str:
    """Return the unit that a key of JSON ends with, of several the longest; empty of none."""
    ends = {end: unit for unit in units if (end := unit_suffix(unit)) and key.endswith(end)}
    return ends[max(ends, key=len)] if ends else ""


def plain(value: Any) -> Any:
    """Return a value as JSON has it: numbers of Python, lists, None for what is not finite."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, float):
        # A sum of nothing may carry a sign; nobody asked for it.
        return value + 0.0 if np.isfinite(value) else None
    if isinstance(value, dict):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return value
