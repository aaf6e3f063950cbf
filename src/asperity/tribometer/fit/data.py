"""Measured ratios or forces, a row each, with the conditions they were measured under."""

import dataclasses
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Self

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case, naming_source
from asperity.casefile.columns import KEY, UNIT, read_rows
from asperity.errors import InputError, nearest, shown
from asperity.units import Quantity, quantity_of, to_si

RATIO, FORCE, DEVIATION = "ratio", "force", "sd"
_HEAD = re.compile(rf"\s*(?:(sd)\s+)?({KEY}|[A-Za-z_][\w-]*){UNIT}")

Value = float | str

_UNITS = {RATIO: "", FORCE: "N"}
# What anything measured lies far within; beyond, squares of it over its deviation overflow.
_MOST = {RATIO: 1e9, FORCE: 1e15}
_LEAST_SD = {RATIO: 1e-15, FORCE: 1e-30}
_MOST_SDS = 1e7  # of a value, which no prediction meets more closely
_MOST_OF_CONDITION = 1e30
_SHARE = 0.01  # of the largest value, for a deviation that is not known


@dataclasses.dataclass(frozen=True)
class Measurements:
    """A table of measurements.

    Attributes
    ----------
    name : str
        The file.
    forces : bool
        Whether forces were measured, in N, or ratios.
    values, deviations : ndarray
        What was measured, and its standard deviation; of a table without deviations a
        hundredth of the largest value, for each.
    weighed : bool
        Whether the table has deviations.
    conditions : tuple of dict
        Of each row: values in SI and words by ``table.key``.
    uncertain : mapping of str to ndarray
        Standard deviations of conditions, in SI.
    rows : tuple of int
        Numbers of the file's rows.
    """

    name: str
    forces: bool
    values: FloatArray
    deviations: FloatArray
    conditions: tuple[dict[str, Value], ...]
    uncertain: dict[str, FloatArray]
    rows: tuple[int, ...]
    weighed: bool = True

    @property
    def keys(self) -> tuple[str, ...]:
        """Conditions that the table has columns of."""
        return tuple(self.conditions[0])

    def everywhere(self, values: Mapping[str, Value]) -> Self:
        """Return them with conditions that all share, where they have no column of their own."""
        shared = tuple({**values, **one} for one in self.conditions)
        return dataclasses.replace(self, conditions=shared)


@dataclasses.dataclass(frozen=True)
class _Column:
    index: int
    deviation: bool  # of the key, rather than the key itself
    key: str
    unit: str
    quantity: Quantity | None

    def read(self, cell: str, name: str, row: int) -> Value:
        """Return a cell in SI."""
        text = cell.strip()
        where = f"{name}: row {row}: {self.key}"
        if self.quantity is None:
            if not text:
                raise InputError(f"{where} is empty")
            return text
        try:
            # An interval of temperature, say, has no zero of its own.
            value = to_si(f"{text} {self.unit}".strip(), self.quantity.unit)
            if self.deviation and self.unit:
                value -= to_si(f"0 {self.unit}", self.quantity.unit)
            return value if self.deviation else self.quantity.check(value)
        except InputError as error:
            raise InputError(f"{where} is {shown(text)}; {error}") from None


def read_measurements(path: Path, case: Case) -> Measurements:
    """Read a CSV file of measurements.

    Raises
    ------
    InputError
        With the row or the column: an unknown key, a cell that is no number, sd not above zero.
    """
    name, lines = read_rows(path, "measurements")
    columns = [_column(index, cell, case, name) for index, cell in enumerate(lines[0][1])]
    seen = [(one.key, one.deviation) for one in columns]
    if again := next((one for one in seen if seen.count(one) > 1), None):
        raise InputError(f"{name}: the column {again[0]} is there twice; keep one of them")
    measured = [one for one in columns if one.key in (RATIO, FORCE)]
    if len(measured) > 1:
        raise InputError(f"{name}: the columns hold 'ratio' and 'force'; keep one of them")
    if len(measured) != 1:
        raise InputError(
            f"{name}: the columns must hold 'ratio' or 'force [N]', and may hold 'sd', its "
            "standard deviation"
        )
    weighed = (DEVIATION, False) in seen
    columns = [_as(measured[0], one) if one.key == DEVIATION else one for one in columns]
    if measured[0].key == RATIO and any(one.key == DEVIATION and one.unit for one in columns):
        raise InputError(f"{name}: the column sd has a unit beside 'ratio'; leave it out")
    table = [_row(columns, cells, name, number) for number, cells in lines[1:]]
    values = np.array([row[measured[0].key, False] for row in table], dtype=float)
    conditions = [
        {key: value for (key, deviation), value in row.items()
         if "." in key and not deviation}
        for row in table
    ]  # fmt: skip
    uncertain = {
        key: np.array([row[key, True] for row in table], dtype=float)
        for key, deviation in seen
        if deviation
    }
    for key in uncertain:
        if (key, False) not in seen:
            raise InputError(f"{name}: 'sd {key}' is there without a column {key}")
        if not weighed:
            raise InputError(
                f"{name}: 'sd {key}' is there without 'sd', the deviation of what is measured; "
                "give both, or neither"
            )
    _see_sizes(table, measured[0], name, [number for number, _ in lines[1:]])
    deviations = np.full(len(table), _SHARE * float(np.abs(values).max()) or _SHARE)
    if weighed:
        deviations = np.array([row[DEVIATION, False] for row in table], dtype=float)
    return Measurements(
        name, measured[0].key == FORCE, values, deviations, tuple(conditions), uncertain,
        tuple(number for number, _ in lines[1:]), weighed,
    )  # fmt: skip


def _see_sizes(
    table: list[dict[tuple[str, bool], Value]], measured: _Column, name: str, rows: list[int]
) -> None:
    """Refuse numbers of which the squares, weighed, would leave what a computer holds."""
    what = f" {_UNITS[measured.key]}".rstrip()
    for number, row in zip(rows, table, strict=True):
        value = abs(float(row[measured.key, False]))
        deviation = float(row.get((DEVIATION, False), 1.0))
        where = f"{name}: row {number}:"
        if value > _MOST[measured.key]:
            raise InputError(
                f"{where} {measured.key} is {float(row[measured.key, False]):g}{what}; it must be "
                f"at most {_MOST[measured.key]:g}{what} either way: look at the column's unit"
            )
        if deviation > _MOST[measured.key]:
            raise InputError(
                f"{where} sd is {deviation:g}{what}; it must be at most "
                f"{_MOST[measured.key]:g}{what}: look at the column's unit"
            )
        if deviation < _LEAST_SD[measured.key] or value / deviation > _MOST_SDS:
            least = max(_LEAST_SD[measured.key], value / _MOST_SDS)
            raise InputError(
                f"{where} sd is {deviation:g}{what} beside {measured.key} {value:g}{what}, more "
                f"closely than anything is measured; it must be at least {least:.3g}{what}"
            )


def _as(measured: _Column, deviation: _Column) -> _Column:
    """Return a column of deviations, in the unit of what is measured where it has none."""
    unit = deviation.unit or measured.unit
    return dataclasses.replace(deviation, unit=unit, quantity=measured.quantity)


def _row(
    columns: list[_Column], cells: list[str], name: str, number: int
) -> dict[tuple[str, bool], Value]:
    row = {(one.key, one.deviation): one.read(cells[one.index], name, number) for one in columns}
    for (key, deviation), value in row.items():
        if key == DEVIATION and not (isinstance(value, float) and value > 0.0):
            raise InputError(f"{name}: row {number}: sd is {value:g}; it must be above zero")
        if deviation and not (isinstance(value, float) and value >= 0.0):
            raise InputError(f"{name}: row {number}: 'sd {key}' must be zero or above")
        if deviation and isinstance(value, float) and value > _MOST_OF_CONDITION:
            raise InputError(
                f"{name}: row {number}: 'sd {key}' is {value:g}; it must be at most "
                f"{_MOST_OF_CONDITION:g}: look at the column's unit"
            )
        if isinstance(value, float) and not math.isfinite(value):
            raise InputError(f"{name}: row {number}: {key} is not finite")
    return row


def _column(index: int, text: str, case: Case, name: str) -> _Column:
    head = _HEAD.fullmatch(text)
    if head is None or ("." not in head[2] and head[2] not in (RATIO, FORCE, DEVIATION)):
        what = "ratio', 'force [N]', 'sd' or a key of the case such as 'vibration.frequency [Hz]"
        raise InputError(
            f"{name}: the column {shown(text)} must be '{what}'; of recordings rig reduce --out "
            "writes such a table, measurements.csv"
        )
    deviation, key, unit = bool(head[1]), head[2], (head[3] or "").strip()
    if "." not in key:
        wanted = "N" if key == FORCE else ""
        if unit and key == RATIO:
            raise InputError(f"{name}: the column ratio has a unit, {unit!r}; leave it out")
        return _Column(index, False, key, unit or wanted, Quantity(wanted, "a number", "1 N"))
    table, _, own = key.partition(".")
    with naming_source(case):
        if table not in case.known:
            raise InputError(f"{name}: [{table}] is not a table{nearest(table, case.known)}")
    model = case.known[table]
    if own not in model.own_keys():
        raise InputError(f"{name}: {key} is not a key{nearest(own, model.own_keys())}")
    quantity = quantity_of(model, own)
    if quantity is not None and quantity.unit and not unit:
        raise InputError(
            f"{name}: the column {key} has no unit; write it behind, as in '{key} "
            f"[{quantity.example.split()[-1]}]'"
        )
    if quantity is None and (unit or deviation):
        raise InputError(f"{name}: {key} is a word; its column has neither unit nor sd")
    return _Column(index, deviation, key, unit, quantity)


def numeric(measurements: Measurements) -> list[str]:
    """Return the conditions that are numbers and differ between rows."""
    return [
        key
        for key in measurements.keys
        if len({row[key] for row in measurements.conditions}) > 1
        and all(isinstance(row[key], float) for row in measurements.conditions)
    ]
