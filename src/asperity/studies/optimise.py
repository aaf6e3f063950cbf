"""The most efficient design of a worm gearset that does not lose load capacity.

This is thesis 3.3.5: pressure angle, diameter factor, axial module and roughness are changed
together for the highest efficiency of the teeth, without lowering the torques that BS 721 permits
for wear and strength.
"""

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case, naming_source
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate
from asperity.rating.rated import Rated
from asperity.rating.verdict_rows import Row
from asperity.results import Result, labelled, quantity
from asperity.results.table import Table
from asperity.runs import Run
from asperity.shafts.study import overhang_by, rows_by
from asperity.studies.climb import climb, spread
from asperity.studies.constraints import TORQUES, Limit, limits_of, number_of
from asperity.studies.design import VARIABLES, Bounds, Space, refuse_given_friction
from asperity.studies.design_compared import (
    design_numbers,
    falls,
    locking_of,
    safeties_json,
    safety_rows,
)
from asperity.studies.gears import Gears
from asperity.studies.layout import points
from asperity.studies.quantities import varied_quantity
from asperity.studies.requirements import Requirements, special_hob
from asperity.studies.rounding import rounded_near
from asperity.studies.search import bounds_of, known_safeties, least_safeties, notes_of
from asperity.studies.tradeoff import TradeOff, curve_in
from asperity.studies.with_shafts import Borne, with_shafts

if TYPE_CHECKING:
    import xarray as xr

STARTS = 8
"""Starts beside the gearset as it is."""


class Optimum(Result):
    """The most efficient design within the limits.

    Attributes
    ----------
    gearset : Gearset
        The design.
    before, after : Rated
        The gearset as it was, and the design, rated by all standards.
    limits : tuple of Limit
        Every constraint, and whether it holds the design back.
    starts, agreed : int
        How many starts there were, and how many came to this design's efficiency.
    curve : TradeOff or None
        What a higher permissible torque costs.
    made : Rated or None
        The design in numbers that can be made, rated again; None where none near keeps all limits.
    """

    title: ClassVar[str] = "Most efficient design"
    stem: ClassVar[str] = "optimise"
    drawings: ClassVar[Mapping[str, str]] = {"optimise": "asperity.studies.plots:plot_trade_off"}

    gearset: Gearset
    before: Rated
    after: Rated
    limits: tuple[Limit, ...]
    starts: int = quantity("", "", "starts")
    agreed: int = quantity("", "", "starts that agree")
    curve: TradeOff | None = None
    made: Rated | None = None

    @property
    def gain(self) -> float:
        """By how much the efficiency of the teeth rises, as a share of one."""
        return number_of(self.after, "eta_z1_2") - number_of(self.before, "eta_z1_2")

    @property
    @labelled("", "", "rise of the efficiency of the teeth, points", only="json")
    def gain_points(self) -> float:
        """By how many points of a hundred the efficiency of the teeth rises."""
        return 100.0 * self.gain

    @property
    def active(self) -> tuple[Limit, ...]:
        """The constraints that hold the design back."""
        return tuple(limit for limit in self.limits if limit.active)

    @property
    def settings(self) -> tuple[str, ...]:
        """What turns the case into the design, for ``--set``."""
        return self._settings(self.gearset)

    @property
    def made_settings(self) -> tuple[str, ...]:
        """What turns the case into the design that can be made."""
        return () if self.made is None else self._settings(self.made.gearset)

    def _settings(self, design: Gearset) -> tuple[str, ...]:
        settings = [
            f"gearset.{name}={varied_quantity(name).from_si(getattr(design, name)):.12g} "
            f"{varied_quantity(name).unit}".rstrip()
            for name in VARIABLES
        ]
        g = design.geometry
        if self.before.gearset.centre_distance is None:
            settings.append(f"gearset.centre_distance={g.centre_distance:.12g} mm")
        if self.before.gearset.profile_shift is not None:
            settings.append(f"gearset.profile_shift={g.profile_shift:.12g}")
        return tuple(settings)

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        answer = super().to_json() | {
            "name": self.before.gearset.name,
            "given": design_numbers(self.before),
            "optimum": design_numbers(self.after),
            "constraints": [limit._asdict() for limit in self.limits],
            "settings": list(self.settings),
            "made": None if self.made is None else design_numbers(self.made),
            "made_settings": list(self.made_settings),
            "safeties": safeties_json(self.before, self.after, self.made),
            "locking": locking_of(self.before, self.after, self.made),
            **self._of_shafts(),
        }
        return answer if self.curve is None else {**answer, "trade_off": self.curve.to_json()}

    def _of_shafts(self) -> dict[str, Any]:
        """Return what shafts and bearings come to, where the case has any."""
        designs = {"given": self.before, "optimum": self.after, "made": self.made}
        rows = {
            name: [row.to_json() for row in rated.rows]
            for name, rated in designs.items()
            if rated is not None
        }
        return {"rows": rows} if self.before.rows else {}

    def to_dataset(self) -> "xr.Dataset":
        """Return the designs over the permissible torque, and the optimum as attributes."""
        curve = self.curve
        dataset = super().to_dataset() if curve is None else curve.to_dataset()
        after = design_numbers(self.after)
        for standard, key in (("bs721", "M_permissible_Nm"), ("iso14521", "eta_z1_2")):
            if after[standard]:
                dataset.attrs[f"optimum.{key}"] = after[standard][key]
        return dataset

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.before.gearset.name or "worm gearset"

    def tables(self) -> tuple[Table, ...]:
        """Return the gearset and its best design side by side, and what holds the design back."""
        designs = [self.before, self.after, *([self.made] if self.made else [])]
        before, *others = map(design_numbers, designs)
        rows = []
        for key, value in before.items():
            if isinstance(value, dict):
                now = [other[key] or {} for other in others]
                rows += [
                    [f"{key}.{own}", value[own], *(n[own] for n in now)]
                    for own in value
                    if all(own in n for n in now)
                ]
            elif value is not None:
                rows.append([key, value, *(other[key] for other in others)])
        rows += [
            [f"{path} (asked {asked:g})", *values] for path, asked, *values in safety_rows(*designs)
        ]
        rows += [
            [
                f"{row.name} (asked {row.asked:g}{row.unit and f' {row.unit}'})",
                *(own.rows[place].value for own in designs),
            ]
            for place, row in enumerate(self.before.rows)
        ]
        words = list(locking_of(self.before, self.after, self.made).values())
        rows += [[key, *(one[key] for one in words)] for key in words[0]]
        symbols = [limit.symbol for limit in self.limits if limit.relation != "<="]
        active = [[limit.key, limit.relation, limit.bound, limit.value] for limit in self.active]
        remarks = [
            f"eta_z {points(self.gain)} points; {self.agreed} of {self.starts} starts agree",
            "other constraints do not hold it back: "
            + ", ".join(
                # Two standards may have one symbol for what each of them asks.
                f"{limit.key if symbols.count(limit.symbol) > 1 else limit.symbol} "
                f"{limit.relation} {limit.bound:.4g}"
                for limit in self.limits
                if not limit.active
            ),
            "rate it with "
            + " ".join(f'--set "{text}"' for text in self.made_settings or self.settings),
            *self.notes,
        ]
        headings = "", "as it is", "best", *(["to be made"] if self.made else [])
        held = "Constraints that hold it back"
        tables = (
            Table.of(headings, rows, title="Highest efficiency of the teeth"),
            Table.of(("", "", "limit", "best"), active, title=held, left=2, remarks=remarks),
        )
        return tables if self.curve is None else (*tables, self.curve.table())


def optimise(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    bounds: Bounds | None = None,
    *,
    starts: int = STARTS,
    folder: Path | None = None,
    least: Mapping[str, float] | None = None,
    begin: FloatArray | None = None,
    requirements: Requirements | None = None,
    borne: Borne | None = None,
) -> Optimum:
    """Find the design of the highest efficiency by ISO/TR 14521 that keeps its load capacity.

    Parameters
    ----------
    gearset, operation, options : Gearset, Operation, RatingOptions
        As in `asperity.rating.rate`; what is not free stays.
    bounds : Bounds, optional
        How far the design may be changed; the default is assumed.
    starts : int
        How many starts beside the gearset as it is, a power of two.
    folder : path, optional
        Where a relative file name among the options starts.
    least : mapping of str to float, optional
        Least safeties by ``standard.key``. Where they are given the permissible torque of BS 721,
        the lower of those for wear and strength, is kept; else each of the two is, as in the
        thesis (3.3.5), and no other safety.
    begin : ndarray, shape (designs, variables), optional
        Designs to begin from as well, rows of the variables in SI.
    requirements : Requirements, optional
        What the design keeps beside its load capacity, even where the gearset does not as it is.
        Its safety is part of ``least``, see `asperity.studies.search.least_safeties`.
    borne : Borne, optional
        What shafts and bearings must bear. Each design then takes a hundred times as long, so that
        the climbs are from the gearset as it is, ``begin``, and the thickest worm alone.

    Returns
    -------
    Optimum
        Load capacity and safeties are at least what they must be, h* is above zero, and the profile
        shift keeps its bounds.

    Raises
    ------
    InputError
        The gearset cannot be rated as it is, by ISO/TR 14521 or by BS 721, or no design within the
        bounds has what is required.
    """
    if starts < 1 or starts & (starts - 1):
        raise InputError(f"starts is {starts}; it must be a power of two, such as {STARTS}")
    refuse_given_friction(options)
    space = Space(gearset, operation, options, bounds, folder, least, requirements)
    return _best_in(space, bounds, least, starts, begin, borne)


def _best_in(
    space: Space,
    bounds: Bounds | None,
    least: Mapping[str, float] | None,
    starts: int = STARTS,
    begin: FloatArray | None = None,
    borne: Borne | None = None,
) -> Optimum:
    kept = space.numbers(space.start)
    torque = None if least is None else float(kept["M_permissible_Nm"])
    capacity = {key: float(kept[key]) if torque is None else torque for key in TORQUES}
    first = [space.start, *spread(space.dimensions, starts)]
    first += space.best_of_sample("eta_z1_2", **capacity)
    first += [] if begin is None else list(space.points(begin))
    if borne is not None:
        first = [space.start, *space.points(begin)] if begin is not None else first
        first = [*first, space.thickest(first[-1])]

    def merit(points: FloatArray) -> FloatArray:
        rows = space.merit(space.worth(points), capacity)
        return rows if borne is None else np.hstack([rows, borne.room(space.gearset_at, points)])

    top, near = climb(merit, first), None
    if top is None:
        raise space.nothing_keeps()
    if least is not None:
        top, near = rounded_near(space, top, merit, capacity, borne)
    design = space.gearset_at(top.point)
    before, after = (space.rated(g) for g in (space.gearset, design))
    made = None if near is None else space.rated(space.gearset_at(near))
    return Optimum(
        gearset=design,
        before=before,
        after=after,
        limits=limits_of(space, capacity, after, top.point),
        starts=len(first),
        agreed=top.agreed,
        made=made,
        notes=(
            *notes_of(before, bounds, top.agreed, len(first)),
            *special_hob((made or after).gearset.pressure_angle),
            *space.kept,
            *(falls(before, made or after) if least else ()),
        ),
    )


class Problem(NamedTuple):
    """What is asked of the command.

    Attributes
    ----------
    gears : Gears
        The gearset and how it runs.
    bounds : Bounds or None
        How far it may be changed.
    keep : tuple of str
        Safeties that may not fall.
    rows : callable or None
        What the case's shafts come to with a gearset.
    overhang : str
        Where the worm's mesh lies beyond its bearings; empty between them.
    """

    gears: Gears
    bounds: Bounds | None
    keep: tuple[str, ...]
    rows: Callable[[Gearset], tuple[Row, ...]] | None = None
    overhang: str = ""


def prepare(
    case: Case,
    *,
    free: str = "",
    bounds: Sequence[str] | None = None,
    keep: Sequence[str] | None = None,
) -> Problem:
    """Return the gearset of a case, how it runs, and what is asked of its best design."""
    gears = Gears.of(case)
    for name in keep or ():
        known_safeties(name)
    span = bounds_of(gears.gearset, free, bounds or ())
    with naming_source(case):
        return Problem(gears, span, tuple(keep or ()), rows_by(case), overhang_by(case))


def answer(problem: Problem, _: Run) -> Optimum:
    """Return the best design of a case's gearset, with the trade-off it lies on."""
    gears = problem.gears
    tables = gears.gearset, gears.operation, gears.options, problem.bounds
    now = rate(*tables[:3], folder=gears.folder)
    kept = gears.requirements
    least = least_safeties(now, problem.keep, kept.safety)
    refuse_given_friction(gears.options)
    # Of one space, whose sample all climbs begin from.
    space = Space(*tables, gears.folder, least, kept)
    curve = curve_in(space)
    begin = np.stack(
        [
            varied_quantity(name).to_si(curve.numbers[varied_quantity(name).key])
            for name in VARIABLES
        ],
        axis=-1,
    )

    def search(begin: FloatArray, borne: Borne | None = None) -> Optimum:
        return _best_in(space, problem.bounds, least, begin=begin, borne=borne)

    best = search(begin)
    if problem.rows is not None:
        top = best.gearset
        near = [top.pressure_angle, top.geometry.diameter_factor,
                1e-3 * top.geometry.axial_module, top.worm_roughness]  # fmt: skip
        best = with_shafts(
            best, problem.rows, lambda borne: search(np.array([near]), borne), kept.safety
        )
    notes = best.notes
    if problem.overhang:
        notes += (
            f"the worm overhangs, its mesh {problem.overhang}: the deflection by ISO/TR 14521 is "
            "that of a worm between its bearings; the row of the worm as a beam has its own",
        )
    return dataclasses.replace(best, curve=curve, notes=notes)
