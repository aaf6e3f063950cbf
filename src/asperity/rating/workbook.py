"""A rating as a workbook: the inputs to be changed, and every number as a live formula.

The formulas are those of the calculation: it runs once more on numbers that remember how they were
found (`asperity.formulas.traced`), each of which becomes a cell. What is chosen by a word (a
material's family, the way of lubrication, the flank's type) is chosen as in the case.
"""

import dataclasses
import functools
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

from asperity.formulas import masking
from asperity.formulas.traced import Traced
from asperity.gearset import relations
from asperity.rating.agma6034.rating import rated as rated_agma6034
from asperity.rating.bs721.rating import rated as rated_bs721
from asperity.rating.bs721.tables import Tables
from asperity.rating.demands import DEMANDS
from asperity.rating.entries import Fact, facts
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import rated_capacity, rated_efficiency
from asperity.rating.result import Rating
from asperity.rating.variation import derived
from asperity.rating.verdict_rows import Shafts
from asperity.results.formula_sheets import Cells, Page, write_live
from asperity.units import unit_of

_GEOMETRY = "geometry"
_REMARKS = (
    "Coloured cells are there to be changed; all other numbers follow.",
    "A number without a formula on another sheet is fixed by a word of the case.",
    "Limits of validity and notes are those of asperity rate, and are not checked here.",
)
_FREE = (
    "starts", "wheel_teeth", "axial_module", "diameter_factor", "profile_shift", "pressure_angle",
    "worm_roughness", "worm_speed", "output_torque", "through_travel_torque", "base_friction",
    "friction", "friction_factor",
)  # fmt: skip


def write_rating(
    inputs: Inputs,
    tables: Tables,
    ratings: Mapping[str, Rating],
    path: Path,
    shafts: Shafts | None = None,
) -> Path:
    """Write the workbook of a rating.

    Parameters
    ----------
    inputs : Inputs
        What was rated.
    tables : Tables
        Of BS 721.
    ratings : mapping of str to Rating
        The ratings, by standard.
    path : path
        The file.
    shafts : Shafts, optional
        What has sheets of its own.
    """
    cells = Cells(_fact)
    traced, own = _traced(inputs, cells), _tables(tables, cells)
    values = {standard: _rated(standard, traced, own) for standard in ratings}
    others = {} if shafts is None else shafts.sheets(cells, traced, values.get("iso14521", {}))
    cells.settle(number for rated in values.values() for number in rated.values())
    cells.settle(number for rows in others.values() for number, *_ in rows)
    geometry = Page(_GEOMETRY, cells)
    for name, value in vars(traced).items():
        if isinstance(value, Traced) and value.operation:
            geometry.add(value, *_about_geometry(name))
    pages = [geometry]
    for standard, rating in ratings.items():
        parts = Page(f"{standard} parts", cells)
        for key, value in values[standard].items():
            if key.startswith("part_"):
                parts.add(value, *_about_part(standard, key))
        if len(parts.rows) > 1:
            pages.append(parts)
        page = Page(standard, cells)
        asked = {demand.key: demand.asked for demand in DEMANDS if demand.standard == standard}
        for entry in rating.entries:
            if entry.key in values[standard]:
                about = entry.symbol, entry.unit, entry.meaning, entry.equation, str(entry.source)
                page.add(values[standard][entry.key], *about, asked=asked.get(entry.key))
        pages.append(page)
    for title, rows in others.items():
        pages.append(Page.of(title, cells, rows))
    return write_live(cells, pages, _REMARKS, path)


def _greater(one: Any, other: Any) -> Any:
    return np.maximum(one, other)


def _traced(inputs: Inputs, cells: Cells) -> Inputs:
    """Return the inputs with cells in place of numbers, the geometry found from five of them."""
    gearset: Any = _Part(inputs.gearset, "gearset", cells)
    free: dict[str, Any] = {
        name: None if getattr(inputs, name) is None else cells.input(name, getattr(inputs, name))
        for name in _FREE
    }
    operation = inputs.operation
    if inputs.duty:
        # What BS 721 refers equivalent times of wear to: the greatest of the parts, as they are.
        of_parts = (
            cells.input(f"duty_cycle_{number}_output_torque", part.torque, "N m")
            for number, part in enumerate(inputs.duty, 1)
        )
        free["through_travel_torque"] = functools.reduce(_greater, of_parts)
    elif operation.through_travel_torque is None:
        free["through_travel_torque"] = operation.travel_share * free["output_torque"]
    z1, z2, m, q, x = (free[name] for name in _FREE[:5])
    numbers = {
        **free,
        "gear_ratio": relations.gear_ratio(z1, z2),
        "centre_distance": relations.centre_distance(m, q, z2, x),
    }
    follows, _ = derived(gearset, inputs.options, numbers)
    own = {field.name: getattr(inputs, field.name) for field in dataclasses.fields(inputs)}
    run: Any = _Part(inputs.operation, "operation", cells)
    own |= {"gearset": gearset, "operation": run, **numbers, **follows}
    return _TracedInputs(**own, cells=cells, plain=inputs)


def _about_geometry(name: str) -> tuple[str, str, str, str]:
    """Symbol, unit, meaning and equation."""
    fact = _fact(name)
    if fact is None:
        return "", "", name.replace("_", " "), ""
    # An angle is calculated with in radians.
    unit = "rad" if fact.unit == "deg" else fact.unit
    return fact.symbol, unit, fact.meaning, fact.derived or fact.equation


def _about_part(standard: str, path: str) -> tuple[str, str, str, str]:
    """Symbol, unit, meaning and equation of a number of a part of a duty cycle."""
    part, _, key = path.partition(".")
    fact = next((fact for fact in facts(standard) if fact.key == key), None)
    said = part.replace("_", " ")
    if fact is None:
        return "", "", f"{said}, {key.replace('_', ' ')}", ""
    return fact.symbol, fact.unit, f"{said}, {fact.meaning}", fact.equation


def _rated(standard: str, inputs: Inputs, tables: Tables) -> Values:
    if standard == "iso14521":
        values = rated_efficiency(inputs)
        # As the rating itself: a stress whose formula does not reach so far has no cell.
        with masking():
            return rated_capacity(inputs, values)
    return rated_bs721(inputs, tables)[0] if standard == "bs721" else rated_agma6034(inputs)


def _tables(tables: Tables, cells: Cells) -> Tables:
    """Return BS 721's tables with cells for what is looked up by materials."""

    def looked_up(name: str) -> Any:
        stresses = getattr(tables, name)
        return lambda *words: cells.input(f"{name}: {', '.join(words)}", stresses(*words), "MPa")

    names = "bending_stress_factor", "surface_stress_factor", "worm_surface_stress_factor"
    return dataclasses.replace(tables, **{name: looked_up(name) for name in names})


def _fact(path: str) -> Fact | None:
    """What the rating says of an input, by its place or its name."""
    known = facts("given")
    by_place = {fact.of: fact for fact in known}
    by_name = {fact.of.rpartition(".")[2]: fact for fact in known}
    return by_place.get(path) or by_name.get(path.rpartition(".")[2])


class _Part:
    """A table of a case whose numbers are cells."""

    def __init__(self, thing: Any, path: str, cells: Cells) -> None:
        self._thing, self._path, self._cells = thing, path, cells

    def __getattr__(self, name: str) -> Any:
        value, path = getattr(self._thing, name), f"{self._path}.{name}"
        if isinstance(value, BaseModel) or dataclasses.is_dataclass(value):
            return _Part(value, path, self._cells)
        if isinstance(value, Mapping):
            return {key: self._number(f"{path}.{key}", one) for key, one in value.items()}
        return self._number(path, value)

    def _number(self, path: str, value: Any) -> Any:
        if isinstance(value, bool) or not isinstance(value, int | float):
            return value
        kind, name = type(self._thing), path.rpartition(".")[2]
        unit = unit_of(kind, name) if issubclass(kind, BaseModel) else None
        return self._cells.input(path, value, unit or "")


@dataclasses.dataclass(frozen=True, kw_only=True)
class _TracedInputs(Inputs):
    """Inputs whose numbers are cells; those that are rounded on their way into Python as well."""

    cells: Cells
    plain: Inputs

    def _cell(self, name: str, unit: str = "") -> Any:
        value = getattr(self.plain, name)
        return None if value is None else self.cells.input(name, value, unit)

    ambient_temperature = property(lambda self: self._cell("ambient_temperature"))
    oil_temperature = property(lambda self: self._cell("oil_temperature", "degC"))
    sump_limit = property(lambda self: self._cell("sump_limit", "degC"))

    def _of_step(self, number: int, name: str, value: float, unit: str = "") -> Any:
        return self.cells.input(f"duty_cycle_{number}_{name}", float(value), unit)

    @property
    def life(self) -> Any:
        operation = self.plain.operation
        given = operation.steps is None and operation.wheel_revolutions is None
        return self._cell("life") if given else super().life

    @property
    def measured_at(self) -> Any:
        housing = self.plain.operation.housing
        if housing is None or housing.measured_at is None:
            # The rated speed, also in a part that runs at another.
            return self.cells.input("worm_speed", float(self.plain.worm_speed))
        return self._cell("measured_at", "rpm")

    @property
    def bearing_span(self) -> Any:
        if self.plain.operation.bearing_span is None:
            return super().bearing_span
        return self._cell("bearing_span")
