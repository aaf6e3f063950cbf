"""Tables 3.2 to 3.7, as far as their inputs survive, each row with what the thesis says of it."""

import functools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

from asperity.rating import Rated
from asperity.rating.result import Entry
from asperity.studies.constraints import Limit
from asperity.thesis.exhibits import table
from asperity.thesis.products import Grid
from asperity.thesis.rating.rated import GEARSET_2, GEARSETS, OPTIMISED, quoted_methods
from asperity.thesis.said import exhibit_entry

_BY = {"agma6034": ", AGMA 6034", "bs721": ", BS 721"}


class _Row(NamedTuple):
    """A number of a rating, what survives of it in the thesis, and where the one here is from."""

    key: str
    thesis: str = "lost"
    here: str = "computed"
    standard: str = "iso14521"

    def entry(self, rated: Rated) -> Entry:
        return rated.found[self.standard].entry(self.key)

    def meaning(self, rated: Rated) -> str:
        return f"{self.entry(rated).meaning}{_BY.get(self.standard, '')}"


def _rows(number: str) -> list[_Row]:
    return [_Row(**row) for row in exhibit_entry(f"table {number}")["rows"]]


@table("3.2")
def _efficiency() -> Grid:
    rated = GEARSET_2.rated
    return Grid.of(
        _rows("3.2"),
        {
            "symbol": lambda row: row.entry(rated).symbol,
            "quantity": lambda row: row.meaning(rated),
            "value": lambda row: row.entry(rated).value,
            "unit": lambda row: row.entry(rated).unit,
            "thesis": lambda row: row.thesis,
            "here": lambda row: row.here,
        },
        GEARSET_2,
    )


@table("3.3")
def _methods() -> Grid:
    study = GEARSET_2.comparison
    quoted = {study.rows[0].key: "0.0715"}
    for method in quoted_methods():
        less = method.reduction
        number = f"{method.base_friction:.4f}" if less is None else f"{100.0 * less:.0f} % less"
        quoted.setdefault(method.key, number)
    return Grid.of(
        study.rows,
        {
            "method": lambda row: row.name,
            "kind": lambda row: row.kind,
            "mu_0T by the thesis": lambda row: quoted.get(row.key, "not in the thesis"),
            "mu_0T": lambda row: row.base_friction,
            "mu_zm": lambda row: row.friction,
            "eta_z": lambda row: row.efficiency,
            "gain, points": lambda row: 100.0 * row.gain,
            "v_a over v_g": lambda row: row.vibration and row.vibration.velocity_ratio,
            "eta_z with the vibration's power": lambda row: (
                row.vibration and row.efficiency_with_vibration
            ),
            "source": lambda row: str(row.source),
        },
        GEARSET_2.command("methods"),
    )


@table("3.4")
def _influences() -> Grid:
    effects = exhibit_entry("table 3.4")["effects"]
    return Grid.of(
        GEARSET_2.sensitivity.influences,
        {
            "symbol": lambda found: found.quantity.symbol,
            "quantity": lambda found: found.quantity.meaning,
            "value": lambda found: float(found.values[0]),
            "unit": lambda found: found.quantity.unit,
            "effect": lambda found: found.effect,
            "size": lambda found: found.size,
            "elasticity": lambda found: found.elasticity,
            "eta_z at +40 %": lambda found: _number(float(found.efficiency[-1])),
            "fails above, %": lambda found: found.fails_above and 100.0 * found.fails_above,
            "thesis": lambda found: effects[found.quantity.name],
        },
        GEARSET_2.command("sensitivity"),
    )


def _number(value: float) -> float | None:
    return None if math.isnan(value) else value


@table("3.5")
def _as_they_are() -> Grid:
    rated = {name: gear.rated for name, gear in GEARSETS.items()}
    columns = _beside(rated) | {"here": lambda row: row.here}
    return Grid.of(_rows("3.5"), columns, *GEARSETS.values())


def _beside(rated: dict[str, Rated]) -> dict[str, Callable[[_Row], Any]]:
    """Columns of gearsets beside each other."""
    first = next(iter(rated.values()))
    return {
        "symbol": lambda row: row.entry(first).symbol,
        "quantity": lambda row: row.meaning(first),
        "unit": lambda row: row.entry(first).unit,
        **{name: functools.partial(_value, one) for name, one in rated.items()},
        "thesis": lambda row: row.thesis,
    }


def _value(rated: Rated, row: _Row) -> Any:
    return row.entry(rated).value


@table("3.6")
def _constraints() -> Grid:
    bounds = exhibit_entry("table 3.6")["bounds"]
    limits: dict[tuple[str, str], list[Limit]] = {}
    for name, gear in GEARSETS.items():
        for limit in gear.optimum.limits:
            limits.setdefault((name, limit.symbol), []).append(limit)

    def bound(own: list[Limit], *, above: bool) -> float | None:
        return next((one.bound for one in own if (one.relation == "<=") is above), None)

    return Grid.of(
        limits,
        {
            "gearset": lambda at: at[0],
            "symbol": lambda at: at[1],
            "at least": lambda at: bound(limits[at], above=False),
            "at most": lambda at: bound(limits[at], above=True),
            "optimum": lambda at: limits[at][0].value,
            "unit": lambda at: bounds[at[1]][0],
            "effect": lambda at: "holds it back" if any(one.active for one in limits[at]) else "",
            "thesis": lambda at: bounds[at[1]][1],
            "bounds here": lambda at: bounds[at[1]][2],
        },
        *OPTIMISED,
    )


@table("3.7")
def _at_the_optimum() -> Grid:
    designs: dict[str, Rated] = {}
    for name, gear in GEARSETS.items():
        optimum = gear.optimum
        designs |= {name: optimum.before, f"{name}, optimum": optimum.after}
    return Grid.of(_rows("3.7"), _beside(designs), *OPTIMISED)
