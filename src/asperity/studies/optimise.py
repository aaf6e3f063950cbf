"""The most efficient design of a worm gearset that does not lose load capacity.

This is thesis 3.3.5: pressure angle, diameter factor, axial module and roughness are changed
together for the highest efficiency of the teeth, without lowering the torques that BS 721 permits
for wear and strength.
"""

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import Rated, rate
from asperity.results import Result, quantity
from asperity.results.table import Table
from asperity.runs import Run
from asperity.studies.climb import climb, spread
from asperity.studies.design import ASSUMED, VARIABLES, Bounds, Space
from asperity.studies.gears import Gears
from asperity.studies.layout import points
from asperity.studies.quantities import varied_quantity
from asperity.studies.tradeoff import TradeOff, trade_off

if TYPE_CHECKING:
    import xarray as xr

STARTS = 8
"""Starts beside the gearset as it is."""

SHOWN = {
    "iso14521": ("h_star", "mu_zm", "eta_z1_2", "eta_ges", "sigma_Hm_MPa"),
    "bs721": ("M_26k_Nm", "M_w_Nm", "M_s_Nm", "M_permissible_Nm"),
    "agma6034": ("eta", "allowable_torque_Nm", "bending_stress_MPa"),
}
"""Numbers of a rating that are shown of a design, by standard."""

_ACTIVE = 1e-6


class Limit(NamedTuple):
    """A constraint at the optimum.

    Attributes
    ----------
    key, symbol : str
        What is limited; the unit is part of the key.
    relation : {'>=', '<=', '>'}
        Which side is allowed.
    bound, value : float
        The limit, and what the optimum has.
    active : bool
        Whether the optimum lies on it.
    """

    key: str
    symbol: str
    relation: str
    bound: float
    value: float
    active: bool


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

    @property
    def gain(self) -> float:
        """By how much the efficiency of the teeth rises, as a share of one."""
        return _number(self.after, "eta_z1_2") - _number(self.before, "eta_z1_2")

    @property
    def active(self) -> tuple[Limit, ...]:
        """The constraints that hold the design back."""
        return tuple(limit for limit in self.limits if limit.active)

    @property
    def settings(self) -> tuple[str, ...]:
        """What turns the case into the design, for ``--set``."""
        design = self.gearset
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
        answer: dict[str, Any] = {
            "name": self.before.gearset.name,
            "given": design_numbers(self.before),
            "optimum": design_numbers(self.after),
            "gain_points": 100.0 * self.gain,
            "constraints": [limit._asdict() for limit in self.limits],
            "starts": self.starts,
            "agreed": self.agreed,
            "settings": list(self.settings),
            "notes": list(self.notes),
        }
        return answer if self.curve is None else {**answer, "trade_off": self.curve.to_json()}

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
        before, after = design_numbers(self.before), design_numbers(self.after)
        rows = []
        for key, value in before.items():
            if isinstance(value, dict):
                now = after[key] or {}
                rows += [[f"{key}.{own}", value[own], now[own]] for own in value if own in now]
            elif value is not None:
                rows.append([key, value, after[key]])
        active = [[limit.key, limit.relation, limit.bound, limit.value] for limit in self.active]
        remarks = [
            f"eta_z {points(self.gain)} points; {self.agreed} of {self.starts} starts agree",
            "other constraints do not hold it back: "
            + ", ".join(
                f"{limit.symbol} {limit.relation} {limit.bound:.4g}"
                for limit in self.limits
                if not limit.active
            ),
            "rate it with " + " ".join(f'--set "{setting}"' for setting in self.settings),
            *self.notes,
        ]
        held = "Constraints that hold it back"
        tables = (
            Table.of(("", "as it is", "self"), rows, title="Highest efficiency of the teeth"),
            Table.of(("", "", "limit", "self"), active, title=held, left=2, remarks=remarks),
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
) -> Optimum:
    """Find the design of the highest efficiency by ISO/TR 14521 that keeps its load capacity.

    Parameters
    ----------
    gearset, operation, options
        As in `asperity.rating.rate`; what is not free stays.
    bounds : Bounds, optional
        How far the design may be changed; the default is assumed.
    starts : int
        How many starts beside the gearset as it is, a power of two.
    folder : path, optional
        Where a relative file name among the options starts.

    Returns
    -------
    Optimum
        The permissible torques for wear and strength by BS 721 are at least what they were, h* is
        above zero, and the profile shift keeps its bounds.

    Raises
    ------
    InputError
        The gearset cannot be rated as it is, by ISO/TR 14521 or by BS 721.
    """
    if starts < 1 or starts & (starts - 1):
        raise InputError(f"starts is {starts}; it must be a power of two, such as {STARTS}")
    if options is not None and options.friction is not None:
        raise InputError(
            f"rating.friction is {options.friction:g}, on which pressure angle and roughness have "
            "no say; leave it out, or use rating.base_friction or rating.friction_factor"
        )
    space = Space(gearset, operation, options, bounds, folder)
    kept = space.numbers(space.start)
    least = {key: float(kept[key]) for key in ("M_w_Nm", "M_s_Nm")}
    begin = [space.start, *spread(space.dimensions, starts)]
    begin += space.best_of_sample("eta_z1_2", **least)
    top = climb(lambda points: space.merit(space.worth(points), least), begin)
    assert top is not None  # the gearset as it is keeps its own load capacity
    design = space.gearset_at(top.point)
    before, after = (rate(g, operation, options, folder=folder) for g in (gearset, design))
    return Optimum(
        gearset=design,
        before=before,
        after=after,
        limits=_limits(space, before, after),
        starts=len(begin),
        agreed=top.agreed,
        notes=_notes(before, bounds),
    )


def prepare(case: Case) -> Gears:
    """Return the gearset of a case and how it runs."""
    return Gears.of(case)


def answer(gears: Gears, _: Run) -> Optimum:
    """Return the best design of a case's gearset, with the trade-off."""
    best = optimise(gears.gearset, gears.operation, gears.options, folder=gears.folder)
    curve = trade_off(gears.gearset, gears.operation, gears.options, folder=gears.folder)
    return dataclasses.replace(best, curve=curve)


def design_numbers(rated: Rated) -> dict[str, Any]:
    """Return a design: what is free, what follows, and what it is worth by each standard."""
    g = rated.geometry
    return {
        **{varied_quantity(name).key: value for name, value in _free(rated).items()},
        "lead_angle_deg": math.degrees(g.lead_angle),
        **{
            standard: (
                {key: rating[key] for key in keys if key in rating}
                if (rating := rated.found.get(standard)) is not None
                else None
            )
            for standard, keys in SHOWN.items()
        },
    }


def _free(rated: Rated) -> dict[str, float]:
    """Return what is free, and the profile shift that follows, in the units of results."""
    g = rated.geometry
    return {
        "pressure_angle": varied_quantity("pressure_angle").shown(g.pressure_angle),
        "diameter_factor": g.diameter_factor,
        "axial_module": g.axial_module,
        "worm_roughness": varied_quantity("worm_roughness").shown(rated.gearset.worm_roughness),
        "profile_shift": g.profile_shift,
    }


def _number(rated: Rated, key: str) -> float:
    rating: Any = rated.iso14521 if key in SHOWN["iso14521"] else rated.bs721
    return float(rating[key])


def _limits(space: Space, before: Rated, after: Rated) -> tuple[Limit, ...]:
    limits = []
    for key, symbol in (("M_w_Nm", "M_w"), ("M_s_Nm", "M_s")):
        bound, value = _number(before, key), _number(after, key)
        limits.append(Limit(key, symbol, ">=", bound, value, value - bound < _ACTIVE * bound))
    h_star = _number(after, "h_star")
    limits.append(Limit("h_star", "h*", ">", 0.0, h_star, h_star < _ACTIVE))
    spans = {
        name: (varied_quantity(name).shown(low), varied_quantity(name).shown(high))
        for name, low, high in zip(VARIABLES, space.lower, space.upper, strict=True)
    } | {"profile_shift": space.profile_shift}
    values = _free(after)
    for name, (low, high) in spans.items():
        what, value = varied_quantity(name), values[name]
        near = _ACTIVE * (high - low)
        for relation, bound, gap in ((">=", low, value - low), ("<=", high, high - value)):
            limits.append(Limit(what.key, what.symbol, relation, bound, value, gap <= near))
    return tuple(limits)


def _notes(before: Rated, bounds: Bounds | None) -> tuple[str, ...]:
    notes = []
    if bounds is None:
        notes.append(f"the bounds are assumed: {ASSUMED.note}")
    rating = before.bs721
    if rating is not None and rating.entry("M_w_Nm").from_memory:
        notes.append("M_w and M_s rest on tables of BS 721 from memory; check them before use")
    return tuple(notes)
