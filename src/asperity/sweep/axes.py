"""Axes of a grid, from text such as ``vibration.direction=0:360:15``."""

import contextlib
import dataclasses
import functools
import math
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import NoReturn

from asperity.casefile import Case, Table, bare_unit, names_file, read_case, same_thing
from asperity.casefile.columns import HEADING, KEY, read_rows
from asperity.errors import InputError, choices, nearest, shown
from asperity.files import store
from asperity.files.shipped import case_file, points_file
from asperity.sweep.axis import POINT, Axis, Value, spanned
from asperity.sweep.first import Reader, read_elsewhere
from asperity.sweep.subject import Subject, subject_of
from asperity.units import Quantity, quantity_of, split_unit, to_si

MOST_POINTS = 1_000_000  # some 300 MB, and a quarter of an hour where each takes a millisecond
_PATH = re.compile(KEY)
_OVER = "--over"
_FORMS = "1,2,3 or start:stop:step"
_GRAIN = Decimal("1e-9")


@dataclasses.dataclass(frozen=True)
class _Written:
    """An axis as it was written, with the key it belongs to."""

    text: str
    model: type[Table]
    key: str
    parts: tuple[str, ...]
    is_range: bool = False
    along: str = ""

    @property
    def path(self) -> str:
        return f"{self.model.table}.{self.key}"

    @property
    def quantity(self) -> Quantity | None:
        return quantity_of(self.model, self.key)

    def refuse(self, reason: str) -> NoReturn:
        raise InputError(f"{self.text}: {reason}")

    def unit_given(self) -> str:
        """Return the unit that counts for all parts that have none of their own."""
        last = split_unit(self.parts[-1])
        return last[1] if last and self.quantity else ""

    def first_setting(self) -> str:
        """Return the setting that makes a case the first point of the axis."""
        first = self.parts[0]
        number = split_unit(first)
        if self.quantity and number and not number[1]:
            first = f"{first} {self.unit_given()}".rstrip()
        return f"{self.path}={first}"


def read_grid(
    name_or_path: str,
    tables: Mapping[str, type[Table]],
    settings: Sequence[str],
    over: Sequence[str],
    points: str = "",
) -> tuple[Case, list[Axis]]:
    """Read a case and the axes of a grid over it.

    The case returned is the first point of the grid, so that an axis may give what the file does
    not, such as its amplitude; where points may be gaps, one that can be.

    Parameters
    ----------
    name_or_path : str
        As for :func:`asperity.casefile.read_case`.
    tables : mapping of str to type of Table
        As for :func:`asperity.casefile.read_case`.
    settings : sequence of str
        As for :func:`asperity.casefile.read_case`.
    over : sequence of str
        ``table.key=1,2,3`` or ``table.key=start:stop:step``, the stop included where it falls on
        the grid; a unit with each number, or after the last one for all.
    points : str
        A file of values that change together, see `_columns`.

    Returns
    -------
    case : Case
        The first point of the grid that can be one.
    axes : list of Axis
        As of `parse_axes`.

    Raises
    ------
    InputError
        One line that names the file, setting or axis, the key, the value and what is allowed.
    """
    subject = subject_of(_named_tables(name_or_path, settings))
    written = _written(over, points, tables, subject)
    first = [axis.first_setting() for axis in written]
    try:
        case = read_case(name_or_path, tables, [*settings, *first])
    except InputError as error:
        message = str(error)
        for setting, axis in zip(first, written, strict=True):
            message = message.replace(f"--set {setting}:", f"{axis.text}:")
        read = functools.partial(read_case, name_or_path, tables)
        case = _elsewhere(subject, written, settings, read, InputError(message))
    axes = {axis.path for axis in written}
    own = {path: setting for path, setting in case.settings.items() if path not in axes}
    case = dataclasses.replace(case, settings=own, axes={a.path: a.text for a in written})
    return case, _within_bounds([_axis(axis) for axis in written])


def _elsewhere(
    subject: Subject, written: Sequence[_Written], settings: Sequence[str], read: Reader,
    refusal: InputError,
) -> Case:  # fmt: skip
    """Return the case at another point than the first, where points may be gaps."""
    with contextlib.suppress(InputError):
        if subject.gaps and all(axis.quantity for axis in written):
            axes = _within_bounds([_axis(axis) for axis in written])
            return read_elsewhere(read, settings, axes, *spanned(axes))
    raise refusal from None


def read_first(
    name_or_path: str,
    tables: Mapping[str, type[Table]],
    settings: Sequence[str],
    *,
    over: Sequence[str] | None,
    points: str = "",
    **_: object,
) -> Case:
    """Return the first point of a grid, as `read_grid`."""
    return read_grid(name_or_path, tables, settings, over or (), points)[0]


def parse_axes(
    over: Sequence[str], case: Case, points: str = "", option: str = _OVER
) -> list[Axis]:
    """Parse the axes of a grid over a case that is complete without them.

    Parameters
    ----------
    over : sequence of str
        As for `read_grid`.
    case : Case
        Gives the tables.
    points : str
        As for `read_grid`.
    option : str
        Of the command, with which axes are given: refusals name it.

    Returns
    -------
    list of Axis
        Those of a file of points first, then the others as given.

    Raises
    ------
    InputError
        An axis that cannot be read, stands twice or is out of the bounds of its key, or too many
        points.
    """
    written = _written(over, points, case.known, subject_of(case), option)
    return _within_bounds([_axis(axis) for axis in written], option)


def _named_tables(name_or_path: str, settings: Sequence[str]) -> dict[str, object]:
    """Return the names of a case's tables before it is whole; none where it cannot be read."""
    named: dict[str, object] = {setting.partition(".")[0].strip(): 1 for setting in settings}
    path = case_file(name_or_path)
    with contextlib.suppress(InputError):
        named |= store.read_toml(path, name_or_path)
    return named


def _written(
    over: Sequence[str], points: str, tables: Mapping[str, type[Table]], subject: Subject,
    option: str = _OVER,
) -> list[_Written]:  # fmt: skip
    columns = _columns(points_file(points), tables, subject) if points else []
    written = [*columns, *(_split(text, tables, subject, option) for text in over)]
    _distinct(written, option)
    return written


def _columns(path: Path, tables: Mapping[str, type[Table]], subject: Subject) -> list[_Written]:
    """Return the axes of a table in CSV whose rows are points: keys with their units above."""
    name, rows = read_rows(path, "points")
    found = []
    for place, text in enumerate(rows[0][1]):
        heading = HEADING.fullmatch(text)
        if heading is None:
            raise InputError(
                f"{name}: the column {shown(text)} must be a key of the case with its unit, as in "
                "'vibration.frequency [Hz]'"
            )
        where = f"{name}: the column {heading[1]}"
        model, key = _key_of(heading[1], where, tables, subject)
        unit = (heading[2] or "").strip()
        parts = tuple(f"{cells[place].strip()} {unit}".strip() for _, cells in rows[1:])
        written = _Written(where, model, key, parts, along=POINT)
        if empty := next((row for row, cells in rows[1:] if not cells[place].strip()), None):
            written.refuse(f"row {empty} is empty; give every row a value")
        if unit and written.quantity is None:
            written.refuse(f"it holds words, which have no unit; leave out [{unit}]")
        found.append(written)
    return found


def _split(text: str, tables: Mapping[str, type[Table]], subject: Subject, option: str) -> _Written:
    text = " ".join(text.split())
    path, equals, values = (part.strip() for part in text.partition("="))
    where = f"{option} {text}".rstrip()
    if not equals or not _PATH.fullmatch(path):
        raise InputError(f"{where}: it must be table.key={_FORMS}, as in friction.mu=0.1,0.2")
    model, key = _key_of(path, where, tables, subject)
    is_range = ":" in values and quantity_of(model, key) is not None
    parts = tuple(part.strip() for part in values.split(":" if is_range else ","))
    written = _Written(where, model, key, parts, is_range)
    if is_range and (len(parts) != 3 or "," in values):
        written.refuse(f"{path} is {values!r}; it must be {_FORMS}")
    if not all(parts):
        written.refuse(f"{path} has an empty value; it must be {_FORMS}")
    return written


def _key_of(
    path: str, where: str, tables: Mapping[str, type[Table]], subject: Subject
) -> tuple[type[Table], str]:
    """Return the table and the key of a path that may be swept."""
    name, _, key = path.partition(".")
    if name not in tables:
        raise InputError(f"{where}: [{name}] is not a table of a case file{nearest(name, tables)}")
    if name not in subject.tables:
        raise InputError(
            f"{where}: [{name}] has no part in {subject.what}; take one of "
            f"{choices(subject.tables)}"
        )
    model = tables[name]
    if key not in model.own_keys():
        raise InputError(
            f"{where}: {path} is not a key of [{name}]{nearest(key, model.own_keys())}"
        )
    return model, key


def _distinct(axes: Sequence[_Written], option: str) -> None:
    for place, axis in enumerate(axes):
        for other in axes[:place]:
            if other.model is axis.model and other.key in same_thing(axis.model, axis.key):
                both = "twice" if other.key == axis.key else f"and so is {other.path}"
                again = f"{axis.path} is given {both}"
                only = "column" if axis.along else option
                axis.refuse(f"{again}; give one {only} for the same thing")


def _within_bounds(axes: list[Axis], option: str = _OVER) -> list[Axis]:
    points = math.prod(spanned(axes)[0])
    if points > MOST_POINTS:
        raise InputError(
            f"{option}: the grid has {points} points; at most {MOST_POINTS} are allowed: take "
            "coarser steps"
        )
    return axes


def _axis(written: _Written) -> Axis:
    quantity = written.quantity
    if quantity is None:
        return _words(written)
    unit = written.unit_given()
    parts = [_number(written, part, quantity) for part in written.parts]
    if any(given for _, given in parts) and not unit and quantity.unit:
        written.refuse("some values have a unit; give it with the last one, or with each")
    unit = unit or (bare_unit(quantity) if quantity.unit else "")
    if quantity.unit and not unit:
        written.refuse(f"{written.path} is without a unit; {quantity.expected()}")
    numbers = [_in_unit(written, quantity, *part, unit) for part in parts]
    if written.is_range:
        numbers = _range(written, *numbers)
    values = tuple(_si(written, quantity, number, unit) for number in numbers)
    return _once(written, Axis(written.path, values, tuple(float(n) + 0.0 for n in numbers), unit))


def _words(written: _Written) -> Axis:
    values = []
    for part in written.parts:
        try:
            value = store.parse_toml(f"value = {part}")["value"]
        except ValueError:
            value = part
        if isinstance(value, bool) or not isinstance(value, str | int | float):
            written.refuse(f"{written.path} is {part}; it must be words or numbers")
        values.append(value)
    shown = tuple(values)
    if names_file(written.model, written.key):
        # As with a setting, and not from the case's folder.
        values = [str(Path(str(value)).absolute()) for value in values]
    return _once(written, Axis(written.path, tuple(values), shown))


def _once(written: _Written, axis: Axis) -> Axis:
    seen: set[Value] = set()
    axis = dataclasses.replace(axis, along=written.along)
    for index, value in enumerate(axis.values if not axis.along else ()):
        if value in seen:
            written.refuse(f"{axis.text(index)} is given twice; give every value once")
        seen.add(value)
    return axis


def _number(written: _Written, part: str, quantity: Quantity) -> tuple[str, str]:
    number = split_unit(part)
    if number is None:
        written.refuse(f"{written.path} is {part!r}; {quantity.expected()}")
    return number


def _in_unit(written: _Written, quantity: Quantity, number: str, given: str, unit: str) -> Decimal:
    """Return a number in the axis's unit, exact where it was written in that unit."""
    try:
        value = to_si(f"{number} {given or unit}".strip(), quantity.unit)
        if given in ("", unit):
            return Decimal(number)
        # A unit may begin elsewhere, as degrees Celsius do.
        zero = to_si(f"0 {unit}".strip(), quantity.unit)
        scale = to_si(f"1 {unit}".strip(), quantity.unit) - zero
        return Decimal(f"{(value - zero) / scale:.15g}")
    except InputError:
        shown = f"{number} {given or unit}".strip()
        written.refuse(f"{written.path} is {shown!r}; {quantity.expected()}")


def _si(written: _Written, quantity: Quantity, number: Decimal, unit: str) -> float:
    try:
        return quantity.check(to_si(f"{number} {unit}".strip(), quantity.unit))
    except InputError as error:
        written.refuse(f"{written.path} is {f'{number} {unit}'.strip()}; {error}")


def _range(written: _Written, start: Decimal, stop: Decimal, step: Decimal) -> list[Decimal]:
    if step == 0:
        written.refuse("the step is 0; give one that leads from the start to the stop")
    count = (stop - start) / step
    if count < 0:
        written.refuse("the step leads away from the stop; change its sign")
    if count >= MOST_POINTS:
        written.refuse(
            f"the range has {count:.3g} values; at most {MOST_POINTS} are allowed: take a larger "
            "step"
        )
    # Numbers converted from another unit miss the grid by their rounding.
    last = math.floor(count + _GRAIN)
    values = [start + place * step for place in range(last + 1)]
    if abs(values[-1] - stop) <= _GRAIN * abs(step):
        values[-1] = stop
    return values
