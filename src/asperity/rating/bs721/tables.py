"""The tables of BS 721: shipped ones from memory, and those a user puts in their place."""

import dataclasses
import functools
import math
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from asperity.arrays import FloatArray, Real
from asperity.errors import InputError, nearest
from asperity.files import store
from asperity.formulas import Bounds, Symbol, check, current_mask
from asperity.sources import Source, weakest

_SHIPPED = Path(__file__).parents[1] / "data" / "bs721.toml"
_ABOUT = ("source", "confidence", "note", "checked", "doubted")


class TableRangeError(InputError):
    """A table of BS 721 does not go that far."""


@dataclasses.dataclass(frozen=True)
class Curve:
    """A table of one quantity over another, linear between its points.

    Parameters
    ----------
    name : str
        What a message calls it.
    x, y : ndarray
        The points; ``x`` increases.
    source : Source
        Where it comes from.
    hold_above : bool
        Whether the last value holds above the last point.
    """

    name: str
    x: FloatArray
    y: FloatArray
    source: Source
    hold_above: bool = False

    def __call__(self, name: str, value: Real, unit: str = "") -> Real:
        """Return values at what is called ``name``; raises as `inside`."""
        return np.interp(self.inside(name, value, unit), self.x, self.y)

    def inside(self, name: str, value: Real, unit: str = "") -> Real:
        """Return a number or array that lies inside.

        Raises
        ------
        TableRangeError
            The table does not go that far.
        """
        upper = math.inf if self.hold_above else float(self.x[-1])
        because = f"the table of the {self.name} by {self.source.name} goes no further"
        over = Symbol(name, unit, Bounds(float(self.x[0]), upper), because, TableRangeError)
        return check(name, value, over)


@dataclasses.dataclass(frozen=True)
class ZoneFactor:
    """Table of the zone factor :math:`Z_0`.

    Parameters
    ----------
    rows : mapping of int to Curve
        By the number of starts, all over the same diameter factors.
    source : Source
        Where it comes from.
    """

    rows: Mapping[int, Curve]
    source: Source

    def __call__(self, starts: Real, diameter_factor: Real) -> Real:
        """Return Z_0.

        Raises
        ------
        TableRangeError
            There is no such row, or the table does not go that far.
        """
        listed = ", ".join(map(str, sorted(self.rows)))
        because = f"the table has rows for {listed} starts"
        between = Bounds(min(self.rows), max(self.rows))
        starts = check("starts", starts, Symbol("z_1", "", between, because, TableRangeError))
        q = next(iter(self.rows.values())).inside("diameter_factor", diameter_factor)
        found: Real = np.nan
        for row, curve in self.rows.items():
            found = np.where(starts == row, np.interp(q, curve.x, curve.y), found)
        missing = np.isnan(found) & ~(np.isnan(starts) | np.isnan(q))
        if np.any(missing):
            mask = current_mask()
            if mask is None:
                given = float(np.asarray(starts)[missing].flat[0])
                raise TableRangeError(f"starts is {given:.6g}; {because}")
            mask.refuse(missing, f"starts is not allowed; {because}")
        return found


@dataclasses.dataclass(frozen=True)
class Stresses:
    """Stress factors in MPa, by one or two materials.

    Parameters
    ----------
    name : str
        What a message calls it.
    values : mapping
        By material, or by material and the one it runs with.
    source : Source
        Where they come from.
    doubts : mapping of str to str
        What another document has instead, by ``"outer, inner"``.
    """

    name: str
    values: Mapping[str, Mapping[str, float]]
    source: Source
    doubts: Mapping[str, str] = dataclasses.field(default_factory=dict)

    def __call__(self, outer: str, inner: str) -> float:
        """Return one of them; raises InputError with the near names."""
        rows = self.values
        if outer not in rows:
            raise InputError(f"the {self.name} has no row for {outer!r}{nearest(outer, rows)}")
        if inner not in rows[outer]:
            raise InputError(
                f"the {self.name} has nothing for {outer!r} with {inner!r}"
                f"{nearest(inner, rows[outer])}"
            )
        return rows[outer][inner]


@dataclasses.dataclass(frozen=True, eq=False)
class Tables:
    r"""All tables of BS 721 that the formulas need.

    Attributes
    ----------
    zone_factor : ZoneFactor
        :math:`Z_0` over the diameter factor, by the number of starts.
    sliding_speed_factor, rotation_speed_factor : Curve
        :math:`K_V` over m/s, :math:`K_R` over rpm; their product is :math:`X_c`.
    strength_speed_factor : Curve
        :math:`X_b` over rpm.
    friction : Curve
        :math:`\mu` over m/s.
    bending_stress_factor : Stresses
        :math:`S_b`, by 'wheel' or 'worm' and its material.
    surface_stress_factor, worm_surface_stress_factor : Stresses
        :math:`S_c` of the wheel or worm, by its material and that of its mate.
    """

    zone_factor: ZoneFactor
    sliding_speed_factor: Curve
    rotation_speed_factor: Curve
    strength_speed_factor: Curve
    friction: Curve
    bending_stress_factor: Stresses
    surface_stress_factor: Stresses
    worm_surface_stress_factor: Stresses

    @property
    def sources(self) -> dict[str, Source]:
        """Where each table comes from, by its name in a file."""
        return {field.name: getattr(self, field.name).source for field in dataclasses.fields(self)}

    @property
    def source(self) -> Source:
        """The source of the table that can be trusted least."""
        return weakest(*self.sources.values())


def read_tables(path: str | os.PathLike[str] | None = None) -> Tables:
    """Return the tables that ship, with those of a file in their place.

    Parameters
    ----------
    path : path, optional
        A TOML file with any of the tables, written as in the shipped file: each whole, and with
        its own ``source`` and ``confidence``.

    Raises
    ------
    InputError
        Names the file and table, and what is wrong.
    """
    if path is None:
        return _read(None, ())
    file = Path(path).absolute()
    try:
        return _read(file, store.stamp(file))
    except OSError as error:
        raise InputError(
            f"{path} cannot be read: {store.reason(error)}; name a file of tables"
        ) from None


@functools.lru_cache(maxsize=16)
def _read(path: Path | None, stamp: tuple[int, ...]) -> Tables:
    raw = _parse(_SHIPPED)
    origin = dict.fromkeys(raw, _SHIPPED.name)
    if path is not None:
        own = _parse(path)
        for name in own:
            if name not in raw:
                raise InputError(
                    f"{path.name}: [{name}] is not a table of BS 721{nearest(name, raw)}"
                )
        raw.update(own)
        origin.update(dict.fromkeys(own, path.name))
    built: dict[str, Any] = {}
    for name, table in raw.items():
        try:
            built[name] = _build(name, table)
        except InputError as error:
            raise InputError(f"{origin[name]}: [{name}]: {error}") from None
    return Tables(**built)


def _parse(path: Path) -> dict[str, Any]:
    return store.read_toml(path, path.name)


def _build(name: str, table: Any) -> Any:
    if not isinstance(table, dict):
        raise InputError("it must be a table")
    source = Source(
        str(table.get("source", "")), table.get("confidence", ""), str(table.get("note", ""))
    )
    title = name.replace("_", " ")
    if name == "zone_factor":
        _keys(table, "diameter_factor", "starts")
        rows = table["starts"]
        if not isinstance(rows, dict) or not rows or not all(key.isdecimal() for key in rows):
            raise InputError("starts must be a table of rows by the number of starts")
        factors = table["diameter_factor"]
        return ZoneFactor(
            {int(key): _curve(title, factors, row, source) for key, row in rows.items()}, source
        )
    if name == "worm_surface_stress_factor":
        _keys(table, "worm")
        return Stresses(title, _numbers(table["worm"]), source)
    if name == "surface_stress_factor":
        _keys(table, "wheel")
        return Stresses(title, _numbers(table["wheel"]), source, _doubts(table))
    if name == "bending_stress_factor":
        _keys(table, "wheel", "worm")
        return Stresses(
            title, _numbers({member: table[member] for member in ("wheel", "worm")}), source
        )
    _keys(table, "x", "y", optional=("hold_above",))
    hold = table.get("hold_above", False)
    if not isinstance(hold, bool):
        raise InputError(f"hold_above is {hold!r}; it must be true or false")
    return _curve(title, table["x"], table["y"], source, hold)


def _keys(table: Mapping[str, Any], *needed: str, optional: tuple[str, ...] = ()) -> None:
    for key in needed:
        if key not in table:
            raise InputError(f"{key} is missing")
    allowed = (*needed, *optional, *_ABOUT)
    for key in table:
        if key not in allowed:
            raise InputError(f"{key} is not a key of this table{nearest(key, allowed)}")


def _curve(name: str, x: Any, y: Any, source: Source, hold_above: bool = False) -> Curve:
    try:
        points = np.array([x, y], dtype=np.float64)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.ndim != 2 or points.shape[1] < 2 or not np.all(np.isfinite(points)):
        raise InputError("its rows must be lists of numbers, all of the same length")
    if np.any(np.diff(points[0]) <= 0.0):
        raise InputError(f"{points[0].tolist()} must increase from point to point")
    if np.any(points[1] <= 0.0):
        raise InputError(f"{points[1].tolist()} must be positive throughout")
    points.setflags(write=False)
    return Curve(name, points[0], points[1], source, hold_above)


def _doubts(table: Mapping[str, Any]) -> dict[str, str]:
    doubted = table.get("doubted", {})
    if not isinstance(doubted, dict) or not all(isinstance(v, str) for v in doubted.values()):
        raise InputError("doubted must be a table of texts by the materials")
    return dict(doubted)


def _numbers(rows: Any) -> dict[str, dict[str, float]]:
    if not isinstance(rows, dict) or not all(isinstance(row, dict) for row in rows.values()):
        raise InputError("it must hold a table for each material")
    for outer, row in rows.items():
        for inner, value in row.items():
            if (
                isinstance(value, bool)
                or not isinstance(value, int | float)
                or not 0.0 < value < math.inf
            ):
                raise InputError(f"{outer}, {inner} is {value!r}; it must be positive, in MPa")
    return {outer: {inner: float(v) for inner, v in row.items()} for outer, row in rows.items()}
