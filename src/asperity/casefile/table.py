"""A table of a case file: frozen, in SI, refusing in one line what it cannot hold."""

import json
import math
import re
import threading
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Self, get_args

import pydantic
from pydantic_core import ErrorDetails

from asperity.errors import InputError, choices, is_plain, nearest, shown, suggestion
from asperity.units import LARGEST, Held, Named, quantity_of

MOST_DIGITS = 2**128 - 1
"""The largest seed; no other whole number that a key takes is as large."""
_TOO_LARGE = f"it is too large: no number of a machine is above {LARGEST:g} either way"
_BUILDING = threading.Lock()


def _held(value: Any) -> Any:
    """Return a value with the numbers of a checked table marked as such, in lists too."""
    if isinstance(value, tuple | list):
        return tuple(_held(part) for part in value)
    return Held(value) if isinstance(value, float) else value


class Table(pydantic.BaseModel):
    """Base of the tables of a case file: frozen, no unknown keys, InputError in one line.

    A subclass names its table in `table`; no answer depends on one whose `counts` is false. Keys
    that are forms of the same thing stand together in `alternatives` (at most one is given) or
    `required_alternatives` (exactly one), and default to None. A check over several keys is a
    ``model_validator(mode="after")`` that raises ValueError with a whole sentence beginning with
    ``table.key``. A file name is a field of type :class:`pathlib.Path`, so that
    :meth:`Case.canonical` follows the file's content.

    Parameters
    ----------
    *arguments
        Refused: every key is named.
    units : str, sequence of str or mapping, optional
        What bare numbers are in: ``"SI"``, units such as ``"mm, rpm"``, or a unit by key. Left
        out, what has a unit must be text such as ``"75 mm"`` or a quantity of pint.
    **data
        The keys of the table.
    """

    model_config = pydantic.ConfigDict(frozen=True, extra="forbid", defer_build=True)

    table: ClassVar[str] = ""
    counts: ClassVar[bool] = True
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = ()
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = ()

    def __init__(self, /, *arguments: Any, units: Any = None, **data: Any) -> None:
        name = type(self).__name__
        if arguments:
            first = next(iter(type(self).model_fields), "key")
            raise InputError(
                f"{name} is given {shown(arguments[0])} without a key; name each, as in "
                f"{name}({first}=...)"
            )
        self.built()
        try:
            self.__pydantic_validator__.validate_python(
                data, self_instance=self, context={"units": Named(units)}
            )
        except pydantic.ValidationError as error:
            raise InputError(self._one_line(error)) from None

    # Pydantic would otherwise take the constructor for part of the validation and lose the
    # context that says what bare numbers are.
    __init__.__pydantic_base_init__ = True  # type: ignore[attr-defined]

    @classmethod
    def built(cls) -> None:
        """Make what validates the table, which takes its time and is left until it is wanted."""
        if not cls.__pydantic_complete__:
            with _BUILDING:
                cls.model_rebuild()

    @classmethod
    def model_validate(cls, obj: Any, **options: Any) -> Self:
        """Validate a mapping of keys to values, bare numbers in SI; raises InputError.

        Parameters
        ----------
        obj : mapping of str to object
            Values by key.
        **options
            Of `pydantic.BaseModel.model_validate`.

        Returns
        -------
        Table
            Of the class it is called on.
        """
        cls.built()
        try:
            return super().model_validate(obj, **options)
        except pydantic.ValidationError as error:
            raise InputError(cls._one_line(error)) from None

    @classmethod
    def own_keys(cls) -> list[str]:
        """Return the keys that a case file may give; others are put there by the program alone."""
        return [key for key, field in cls.model_fields.items() if not field.exclude]

    @classmethod
    def each_of(cls, values: Sequence[Any], context: Any, path: str) -> tuple[Self, ...]:
        """Validate a list of tables at a ``table.key``; what is refused says which of them is.

        Parameters
        ----------
        values : sequence
            The tables: made already, or mappings of their keys.
        context : object
            That of the validation they are part of.
        path : str
            The ``table.key``.

        Returns
        -------
        tuple of Table
            They, made.

        Raises
        ------
        InputError
            One of them is refused.
        """
        made = []
        for place, each in enumerate(values, 1):
            try:
                made.append(
                    each if isinstance(each, cls) else cls.model_validate(each, context=context)
                )
            except InputError as error:
                said = str(error).replace(f"{path}.", "")
                raise InputError(f"{path}, {numbered(place)}: {said}") from None
        return tuple(made)

    def model_copy(
        self, *, update: Mapping[str, Any] | None = None, deep: bool = False, units: Any = None
    ) -> Self:
        """Return a copy with keys replaced, checked like a new table; raises InputError.

        Parameters
        ----------
        update : mapping of str to object, optional
            Values by key. One form of the same thing replaces another; None removes a key.
        deep : bool
            Without meaning: what a table holds cannot be changed.
        units : str, sequence of str or mapping, optional
            As in the constructor, for the numbers of `update`.

        Returns
        -------
        Table
            Of the same class.
        """
        replaced: set[str] = set()
        for key, value in (update or {}).items():
            replaced |= same_thing(type(self), key) if value is not None else {key}
        kept = {key: getattr(self, key) for key in self.model_fields_set - replaced}
        held = {key: _held(value) for key, value in kept.items()}
        given = {key: value for key, value in (update or {}).items() if value is not None}
        return type(self)(units=units, **held, **given)

    def __repr__(self) -> str:
        """Return what was given, quantities as text: what would make the table again."""
        given = (
            f"{key}={self._written(key)}" for key in self.own_keys() if key in self.model_fields_set
        )
        return f"{type(self).__name__}({', '.join(given)})"

    __str__ = __repr__

    def _written(self, key: str) -> str:
        value, quantity = getattr(self, key), quantity_of(type(self), key)
        if quantity is not None and quantity.unit and isinstance(value, float):
            return repr(quantity.text(value))
        name = getattr(value, "name", "")
        return repr(name) if isinstance(value, Table) and name else shown(value)

    @pydantic.model_validator(mode="before")
    @classmethod
    def _harmless(cls, data: Any) -> Any:
        if isinstance(data, Mapping):
            for key, value in data.items():
                if trouble := trouble_with(value, cls._most(key)):
                    raise ValueError(f"{cls.table}.{key} is {shown(value)}; {trouble}")
        return data

    @classmethod
    def _most(cls, key: str) -> float:
        """Return how large a whole number of a key may be that does not say so itself."""
        field = cls.model_fields.get(key)
        said = field is not None and any(
            getattr(each, "le", None) is not None for each in field.metadata
        )
        return MOST_DIGITS if said else LARGEST

    @pydantic.model_validator(mode="after")
    def _one_form(self) -> Self:
        given = [key for key in type(self).model_fields if getattr(self, key) is not None]
        for sentence in self.forms(given):
            raise ValueError(sentence)
        return self

    @classmethod
    def forms(cls, given: Collection[str]) -> Iterator[str]:
        """Yield a sentence for each thing that is given in two forms, or in none.

        Parameters
        ----------
        given : collection of str
            Keys that have a value.

        Yields
        ------
        str
            What to keep or to add.
        """
        for group in (*cls.alternatives, *cls.required_alternatives):
            found = [f"{cls.table}.{key}" for key in group if key in given]
            if len(found) > 1:
                yield f"{' and '.join(found)} are given; keep one of them"
            if not found and group in cls.required_alternatives:
                yield f"{cls.table}.{group[0]} is missing; give one of {choices(group)}"

    @classmethod
    def _one_line(cls, error: pydantic.ValidationError) -> str:
        details = error.errors(include_url=False)
        # A misspelt key also makes the right one missing; the misspelling is the news.
        first = min(details, key=lambda detail: detail["type"] != "extra_forbidden")
        return cls.sentence(first)

    @classmethod
    def sentence(cls, detail: ErrorDetails) -> str:
        """Return what is wrong as a line that begins with ``table.key``.

        Parameters
        ----------
        detail : dict
            One of pydantic's errors.

        Returns
        -------
        str
            What was given and what is allowed.
        """
        return " ".join(cls._sentence(detail).split())

    @classmethod
    def _sentence(cls, detail: ErrorDetails) -> str:
        cause = detail.get("ctx", {}).get("error")
        reason = str(cause) if cause is not None else detail["msg"]
        if not detail["loc"]:
            return reason
        field = str(detail["loc"][0])
        key = f"{cls.table}.{field}"
        if reason.startswith((f"{key} ", f"{key}.")):
            return reason
        if detail["type"] == "extra_forbidden":
            return f"{key} is not a key of [{cls.table}]{nearest(field, cls.own_keys())}"
        if detail["type"] == "missing":
            quantity = quantity_of(cls, field)
            return f"{key} is missing" + (f"; {quantity.expected()}" if quantity else "")
        given = detail["input"]
        if detail["type"] == "literal_error":
            allowed = detail["ctx"]["expected"].replace(" or ", ", ")
            words = re.findall(r"'([^']*)'", allowed)
            hint = suggestion(given, words) if isinstance(given, str) else ""
            reason = f"it must be one of {allowed}{hint}"
        elif detail["type"] in ("tuple_type", "list_type"):
            within = json.dumps(given, ensure_ascii=False) if isinstance(given, str) else given
            reason = f"it must be a list, as [{within}]"
        elif cause is None:
            reason = reason.partition(", ")[0].replace("Input should be", "it must be", 1)
        place = detail["loc"][1] if len(detail["loc"]) > 1 else None
        where = f", {numbered(place + 1)}" if isinstance(place, int) else ""
        return f"{key} is {shown(given)}{where}; {reason}"


def trouble_with(value: object, most: float = MOST_DIGITS) -> str:
    """Return what no value of any key may be; nothing for one that may.

    Parameters
    ----------
    value : object
        As a file has it.
    most : float
        Size of a whole number, either way.

    Returns
    -------
    str
        A line, or nothing.
    """
    if isinstance(value, str):
        return "" if is_plain(value) else "it must be one line without control characters"
    if isinstance(value, int):
        return "" if abs(value) <= most else _TOO_LARGE
    if isinstance(value, float):
        # What is not finite is told what it must be.
        return _TOO_LARGE if LARGEST < abs(value) < math.inf else ""
    if isinstance(value, Mapping):
        return next(
            filter(None, (trouble_with(each, most) for each in (*value, *value.values()))), ""
        )
    if isinstance(value, list | tuple):
        return next(filter(None, (trouble_with(each, most) for each in value)), "")
    return ""


def numbered(place: int) -> str:
    """Return which of a list is meant, the first of it number 1."""
    return f"number {place} of the list"


def same_thing(model: type[Table], key: str) -> set[str]:
    """Return the key and those that are other forms of the same thing.

    Parameters
    ----------
    model, key : type of Table, str
        The table and one of its keys.

    Returns
    -------
    set of str
        The key alone where it has no other form.
    """
    groups = (*model.alternatives, *model.required_alternatives)
    return {key}.union(*(group for group in groups if key in group))


def names_file(model: type[Table], key: str) -> bool:
    """Whether a key's value is the name of a file.

    Parameters
    ----------
    model : type of Table
        The table.
    key : str
        Of the table.

    Returns
    -------
    bool
        False of a key that the table does not have.
    """
    field = model.model_fields.get(key)
    return field is not None and Path in (field.annotation, *get_args(field.annotation))
