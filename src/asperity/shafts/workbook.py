"""Shafts and bearings as a workbook of live formulas: forces, reactions, lives, safeties.

The formulas are those of the calculation, which runs once more on numbers that remember how they
were found. What is chosen (which factors of a bearing, which of an adjusted pair is pressed, which
load is the worst of a section) is chosen as in the case.
"""

import types
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel

from asperity.formulas import masking
from asperity.formulas.traced import Traced
from asperity.rating.inputs import Inputs, Values
from asperity.results.formula_sheets import Cells, Page, write_live
from asperity.shafts.bearings import Carried, life_of
from asperity.shafts.loads import Condition, Load, forces, on_wheel_shaft, on_worm_shaft
from asperity.shafts.options import BearingOptions
from asperity.shafts.shaft import LoadedShaft, Section
from asperity.shafts.statics import PointLoad, reactions
from asperity.shafts.statics import section as carried_at
from asperity.shafts.strength.section import Actions, judged, strength
from asperity.units import unit_of

MOST = 20
"""Loads above which there is no workbook."""

_REMARKS = (
    "Coloured cells are there to be changed; all other numbers follow.",
    "Friction and viscosity of each load are those of asperity rate. Which load and case is the "
    "worst of a section is that of the case as it was.",
    "Deflections are a beam's, which no sheet solves: asperity shafts.",
)
_CARRIED = (
    ("y_N", "F_y"), ("z_N", "F_z"), ("radial_N", "F_r"), ("axial_N", "F_a"),
)  # fmt: skip


def write_shafts(
    shafts: Mapping[str, LoadedShaft],
    loads: tuple[Load, ...],
    inputs: Inputs,
    options: BearingOptions,
    path: Path,
) -> Path | None:
    """Write the workbook of shafts; None where there are more than `MOST` loads.

    Parameters
    ----------
    shafts : mapping of str to LoadedShaft
        By ``worm_shaft`` and ``wheel_shaft``.
    loads : tuple of Load
        Of the life.
    inputs : Inputs
        The gearset that they belong to.
    options : BearingOptions
        What is asked of the bearings.
    path : path
        The file.
    """
    if len(loads) > MOST:
        return None
    cells = Cells()
    sheets = sheets_of(shafts, loads, inputs, options, cells)
    cells.settle(value for own in sheets.values() for value, *_ in own)
    pages = [Page.of(name, cells, own) for name, own in sheets.items()]
    return write_live(cells, pages, _REMARKS, path)


def sheets_of(
    shafts: Mapping[str, LoadedShaft],
    loads: tuple[Load, ...],
    inputs: Inputs,
    options: BearingOptions,
    cells: Cells,
    iso: Values | None = None,
) -> dict[str, list[tuple[Any, ...]]]:
    """Return the rows of a sheet for each shaft; none where there are more than `MOST` loads.

    Parameters
    ----------
    shafts, loads, inputs, options
        As of `write_shafts`; the numbers of ``inputs`` may be cells already.
    cells : Cells
        Of the workbook.
    iso : mapping, optional
        What ISO/TR 14521 finds from them as cells: friction is taken from there.
    """
    if len(loads) > MOST:
        return {}
    with masking():
        own = [
            _Shaft(name, each, loads, inputs, options, cells, iso) for name, each in shafts.items()
        ]
        return {sheet.name.replace("_", " "): list(sheet.rows()) for sheet in own}


def _number(value: Any, path: str, unit: str, cells: Cells) -> Any:
    """Return a number that is a cell already, or an input."""
    return value if isinstance(value, Traced) else cells.input(path, float(value), unit)


class _Live:
    """A table of a case, or an entry of a data file, whose numbers are cells."""

    def __init__(self, thing: BaseModel, path: str, cells: Cells, *fixed: str) -> None:
        self._thing, self._path, self._cells, self._fixed = thing, path, cells, fixed

    def __getattr__(self, name: str) -> Any:
        known = getattr(type(self._thing), name, None)
        if name in self._fixed:
            return getattr(self._thing, name)
        if isinstance(known, property):
            assert known.fget is not None
            return known.fget(self)
        if callable(known):
            return types.MethodType(known, self)
        value = getattr(self._thing, name)
        if isinstance(value, bool) or not isinstance(value, int | float):
            return value
        unit = unit_of(type(self._thing), name) or ""
        return self._cells.input(f"{self._path}.{name}", value, unit)


class _Shaft:
    """A shaft on traced numbers, and the rows of its sheet."""

    def __init__(
        self,
        name: str,
        shaft: LoadedShaft,
        loads: tuple[Load, ...],
        inputs: Inputs,
        options: BearingOptions,
        cells: Cells,
        iso: Values | None = None,
    ) -> None:
        self._given, self._iso = inputs, iso or {}
        self.name, self.found, self._cells = name, shaft, cells
        self._of_wheel = name == "wheel_shaft"
        self._right = inputs.gearset.hand == "right"
        self._shared = {
            key: _number(getattr(inputs, key), key, unit, cells)
            for key, unit in (
                ("worm_pitch_diameter", "mm"), ("wheel_mean_diameter", "mm"),
                ("lead_angle", "rad"), ("pressure_angle", "rad"), ("gear_ratio", ""),
            )
        }  # fmt: skip
        factor = inputs.operation.application_factor
        self._factor = _number(factor, "operation.application_factor", "", cells)
        self.loads = tuple(self._load(number, load) for number, load in enumerate(loads, 1))
        model = shaft.model
        self._mesh = cells.input(f"{name}.mesh", model.mesh, "mm")
        self._bearings = tuple(
            cells.input(f"{name}.bearing_{end}", at, "mm")
            for end, at in zip("AB", model.bearings, strict=True)
        )
        self._options: Any = types.SimpleNamespace(
            e_c=None if options.e_c is None else cells.input("bearings.e_C", options.e_c),
            a_1=cells.input("bearings.a_1", options.a_1),
            reliability=options.reliability,
        )

    def _load(self, number: int, load: Load) -> Load:
        """Return a load whose forces follow from torque and friction."""

        def cell(key: str, value: Any, unit: str = "") -> Any:
            return _number(value, f"load_{number}.{key}", unit, self._cells)

        hours: Any = load.hours
        torque: Any = load.torque
        speed: Any = load.speed
        given = self._given
        place = number - 1 if load.like is None else load.like
        if isinstance(given.output_torque, Traced):
            # A cell of the rating that the shafts stand beside.
            part = given.duty[place] if given.duty else None
            hours = given.life if part is None else part.hours
            torque = given.output_torque if part is None else part.torque
            speed = given.worm_speed if part is None else part.speed
            if load.like is not None:
                hours, torque = load.hours, given.output_torque
        there = f"part_{place + 1}.mu_zm" if given.duty else "mu_zm"
        torque, speed = cell("torque", torque, "N m"), cell("worm_speed", speed, "rpm")
        friction = cell("friction", self._iso.get(there, load.friction))
        of = self._shared
        angles = of["lead_angle"], of["pressure_angle"]
        found = forces(self._factor * torque, friction, of["wheel_mean_diameter"], *angles)
        return Load(
            cell("hours", hours, "h"), torque, speed, speed / of["gear_ratio"], *found,
            cell("viscosity", load.viscosity, ""), load.rotation, load.lets_down,
            like=load.like,
        )  # fmt: skip

    def _teeth(self, load: Load, condition: Condition) -> PointLoad:
        hand = 1.0 if self._right else -1.0
        force = load.on_worm(condition, hand)
        if self._of_wheel:
            return on_wheel_shaft(self._mesh, force, self._shared["wheel_mean_diameter"])
        return on_worm_shaft(self._mesh, force, self._shared["worm_pitch_diameter"])

    def _loaded(self, load: Load, case: Condition) -> tuple[list[PointLoad], Any, Any]:
        """Return the forces on it under a load, what its bearings carry, and the axial loads."""
        point = self._teeth(load, load.within(case))
        every = [point, *self.found.model.other_loads(1e-3 * point.couple[0])]
        carried = reactions(every, *self._bearings)
        return every, carried, self.found.model.axial_of(carried, carried.radial)

    def rows(self) -> Iterator[tuple[Any, ...]]:
        """Yield value, symbol, unit, meaning and equation of each number."""
        for case in self.found.cases:
            loaded = [self._loaded(load, case) for load in self.loads]
            for number, (_, carried, axial) in enumerate(loaded, 1):
                for end, place in enumerate("AB"):
                    across = (carried.first, carried.second)[end]
                    values = (*across, carried.radial[end], axial.loads[end])
                    for value, (_, symbol) in zip(values, _CARRIED, strict=True):
                        said = f"{case.text}, load {number}: bearing {place}"
                        yield value, f"{symbol},{place}", "N", said, ""
            for end, place in enumerate("AB"):
                yield from self._life(end, place, case, loaded)
        for section in self.found.sections:
            yield from self._section(section)

    def _life(
        self, end: int, name: str, case: Condition, loaded: list[tuple[Any, Any, Any]]
    ) -> Iterator[tuple[Any, ...]]:
        place = self.found.model.places[end]
        if place.bearing is None:
            return
        live: Any = types.SimpleNamespace(
            bearing=_Live(
                place.bearing, f"{self.name}.bearing_{name}", self._cells,
                "angle", "elements", "exponent", "kind", "pitch_diameter",
            ),
            pair=place.pair,
            opposed=place.opposed,
        )  # fmt: skip
        carried = [
            Carried(of.radial[end], axial.loads[end], load.hours,
                    load.wheel_speed if self._of_wheel else load.speed, load.viscosity,
                    load.like is None)
            for load, (_, of, axial) in zip(self.loads, loaded, strict=True)
        ]  # fmt: skip
        found = life_of(live, carried, self._options, self.found.model.table.peak)
        said = f"{case.text}: bearing {name}, {place.bearing.name}"
        for value, symbol, unit, meaning in (
            (found.equivalent, "P", "N", "equivalent load"),
            (found.rating_life, "L_10h", "h", "rating life"),
            (found.kappa, "kappa", "", "viscosity ratio"),
            (found.a_iso, "a_ISO", "", "life modification factor"),
            (found.modified, "L_nmh", "h", "modified life"),
            (found.static_safety, "s_0", "", "static safety"),
        ):
            if value is not None:
                yield value, symbol, unit, f"{said}, {meaning}", ""

    def _section(self, section: Section) -> Iterator[tuple[Any, ...]]:
        detail, table = section.detail, self.found.model.table
        path = f"{self.name}.{detail.name}"
        load = self.loads[section.load]
        every, carried, axial = self._loaded(load, section.condition)
        at = self._cells.input(f"{path}.at", detail.at, "mm")
        sides = [
            map(abs, carried_at(at, every, carried, self._bearings, axial.forces, behind=behind))
            for behind in (False, True)
        ]
        moment, torque, pull = (np.maximum(*pair) for pair in zip(*sides, strict=True))
        live = detail._replace(
            diameter=self._cells.input(f"{path}.diameter", detail.diameter, "mm"),
            roughness=self._cells.input(f"{path}.roughness", detail.roughness, "um"),
            largest=self._cells.input(f"{path}.largest_diameter", detail.largest, "mm"),
            **(
                {
                    "outer": self._cells.input(f"{path}.outer_diameter", detail.outer, "mm"),
                    "radius": self._cells.input(f"{path}.radius", detail.radius, "mm"),
                }
                if detail.kind in ("shoulder", "groove")
                else {}
            ),
        )
        assert table.material is not None
        steel: Any = _Live(table.material, f"{self.name}.material", self._cells, "size")
        borne = strength(live, steel, table.hardening)
        actions = Actions(1e-3 * moment, 1e-3 * torque, pull)
        found = judged(live, steel, borne, actions, torque=table.torque, peak=table.peak)
        where = f"{section.condition.text}, load {section.load + 1}"
        for value, symbol, unit, meaning in (
            (actions.bending, "M", "N m", "bending moment"),
            (actions.torque, "T", "N m", "torque"),
            (found.mises, "sigma_v", "MPa", "stress by distortion energy"),
            (found.fatigue_1, "S_D,1", "", "fatigue safety, mean constant"),
            (found.fatigue_2, "S_D,2", "", "fatigue safety, ratio constant"),
            (found.yielding, "S_F", "", "yield safety"),
            (found.goodman, "n", "", "safety by DE-Goodman"),
            (found.gerber, "n", "", "safety by DE-Gerber"),
        ):
            if isinstance(value, Traced):
                yield value, symbol, unit, f"{detail.name}, {meaning}", where
