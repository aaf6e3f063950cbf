"""How much the efficiency depends on each input: one at a time, the others as they are.

This is thesis 3.2.3 (Figure 3.2, Table 3.4): each input is raised in steps of 5 % to 40 %, the
ratio without rounding the teeth, with the centre distance as it is and the profile shift making up
for the rest.
"""

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import InputError, nearest, shown
from asperity.formulas import Reasons
from asperity.gearset.parameters import Gearset
from asperity.rating.inputs import inputs as given_inputs
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate
from asperity.rating.standards import STANDARDS, tables_of
from asperity.rating.variants import Variants, variants
from asperity.results import Result, quantity
from asperity.results.dataset import described
from asperity.results.table import Table
from asperity.runs import Run
from asperity.studies.gears import Gears
from asperity.studies.layout import percent, points, words
from asperity.studies.quantities import Quantity, varied_quantity
from asperity.studies.requirements import Requirements, broken_by

if TYPE_CHECKING:
    import xarray as xr

INPUTS = (
    "pressure_angle",
    "centre_distance",
    "worm_speed",
    "gear_ratio",
    "diameter_factor",
    "axial_module",
    "worm_roughness",
)
"""What is varied: alpha_n, c, n1, U, q1, m_x1, Ra1."""

RISES: tuple[float, ...] = tuple(0.05 * step for step in range(9))
"""By how much of itself an input is raised."""

LARGE, SMALL = 0.5, 0.2
"""Elasticities from which on an influence is called large, and below which it is called small."""

_STANDARD = "iso14521"
_EFFICIENCY = "iso14521.eta_z1_2"
_NEARBY = 1e-4
_SAME = 1e-9
_PARTS = 64
_ROUNDS = 5


@dataclasses.dataclass(frozen=True, eq=False)
class Influence:
    """What one input does to the efficiency.

    Attributes
    ----------
    quantity : Quantity
        The input.
    values : ndarray, shape (rises,)
        Its values, in its unit.
    efficiency : ndarray, shape (rises,)
        Efficiency of the teeth with each; NaN where there is none.
    reason : ndarray of int, shape (rises,)
        0 where there is an efficiency, else a code of `legend`.
    legend : mapping of int to str
        The codes as sentences.
    elasticity : float
        Change of the efficiency over the change of the input, both in parts of themselves, at the
        gearset as it is.
    fails_above : float or None
        The rise, within those studied, above which the calculation has no answer.
    broken_above : mapping of str to float
        By what is required and no longer kept, the rise above which it is not; 0 where it is not
        kept as it is.
    """

    quantity: Quantity
    values: FloatArray
    efficiency: FloatArray
    reason: Reasons
    legend: Mapping[int, str]
    elasticity: float
    fails_above: float | None
    broken_above: Mapping[str, float] = dataclasses.field(default_factory=dict)

    @property
    def change(self) -> float:
        """From the gearset as it is to the highest rise that has an answer, as a share of one."""
        found = self.efficiency[~np.isnan(self.efficiency)]
        return float(found[-1] - found[0])

    @property
    def effect(self) -> str:
        """What a rise of the input does."""
        steps = np.diff(self.efficiency[~np.isnan(self.efficiency)])
        signs = np.sign(steps[np.abs(steps) > _SAME])
        turns = signs[np.insert(np.diff(signs) != 0.0, 0, True)] if signs.size else signs
        return ", then ".join("raises" if sign > 0.0 else "lowers" for sign in turns) or "none"

    @property
    def size(self) -> str:
        """Whether the influence is large, medium or small, by the elasticity."""
        size = abs(self.elasticity)
        return "large" if size >= LARGE else "small" if size < SMALL else "medium"

    @property
    def failure(self) -> str:
        """Why there is no answer beyond `fails_above`; empty where there always is."""
        codes = self.reason[self.reason != 0]
        return self.legend[int(codes[0])] if codes.size else ""


class Sensitivity(Result):
    """The efficiency of a worm gearset over each of its inputs.

    Attributes
    ----------
    name : str
        Of the gearset.
    efficiency : float
        Of the teeth, as the gearset is.
    rises : ndarray, shape (rises,)
        By how much of itself an input is raised.
    influences : tuple of Influence
        One for each input.
    """

    title: ClassVar[str] = "Sensitivity of the efficiency"
    stem: ClassVar[str] = "sensitivity"
    drawings: ClassVar[Mapping[str, str]] = {
        "sensitivity": "asperity.studies.plots:plot_sensitivity"
    }

    name: str
    efficiency: float = quantity("eta_z1-2", "", "efficiency of the teeth")
    rises: FloatArray
    influences: tuple[Influence, ...]

    def __getitem__(self, name: str) -> Influence:
        """Return the influence of an input by its name."""
        for influence in self.influences:
            if influence.quantity.name == name:
                return influence
        names = [influence.quantity.name for influence in self.influences]
        raise InputError(f"{shown(name)} is not varied in this study{nearest(name, names)}")

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys, None is where no answer is."""
        return {
            "name": self.name,
            "eta_z1_2": self.efficiency,
            "rises_percent": [round(100.0 * rise, 9) for rise in self.rises.tolist()],
            "inputs": {i.quantity.name: _plain(i) for i in self.influences},
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return efficiencies over input and rise, what ends them, and the elasticities."""
        found = self.influences
        both = ("input", "rise")
        ends = [np.nan if i.fails_above is None else 100.0 * i.fails_above for i in found]
        dataset = described(
            f"Sensitivity of the efficiency of {self.name or 'a worm gearset'}",
            input=(
                ("input",), words(i.quantity.name for i in found), "1", "input that is raised",
            ),
            rise=(("rise",), 100.0 * self.rises, "percent", "rise of the input"),
            symbol=(
                ("input",), words(i.quantity.symbol for i in found), "1", "symbol of the input",
            ),
            eta_z1_2=(
                both, np.array([i.efficiency for i in found]), "1", "efficiency of the teeth",
            ),
            reason=(
                both,
                np.array([[i.legend.get(int(c), "") for c in i.reason] for i in found], object),
                "1",
                "why there is no efficiency",
            ),
            elasticity=(
                ("input",), np.array([i.elasticity for i in found]), "1",
                "relative change of the efficiency over that of the input",
            ),
            fails_above=(
                ("input",), np.array(ends), "percent", "rise above which there is no efficiency",
            ),
            **{
                i.quantity.name: (("rise",), i.values, i.quantity.unit or "1", i.quantity.meaning)
                for i in found
            },
        )  # fmt: skip
        dataset.attrs["eta_z1_2"] = self.efficiency
        return dataset

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.name or "worm gearset"

    def tables(self) -> tuple[Table, ...]:
        """Return efficiencies over the rises, and a summary of the influences."""
        rises = [f"{100.0 * rise:+.0f} %" if rise else "as is" for rise in self.rises]
        curves, summary, remarks = [], [], []
        for found in self.influences:
            what = found.quantity
            curves.append([what.symbol, *map(percent, found.efficiency)])
            summary.append(
                [
                    what.symbol,
                    what.text(found.values[0]),
                    found.effect,
                    found.size,
                    f"{found.elasticity:+.2f}",
                    points(found.change),
                ]
            )
            if found.fails_above is not None:
                remarks.append(
                    f"{what.symbol} raised by more than {100.0 * found.fails_above:.1f} %: "
                    f"{found.failure}"
                )
            remarks += [
                f"{what.symbol} raised by more than {100.0 * rise:.1f} %: requirements.{name} is "
                "no longer kept"
                if rise
                else f"{what.symbol} as it is: requirements.{name} is not kept"
                for name, rise in found.broken_above.items()
            ]
        remarks.append(
            "points: change of the efficiency up to the last rise with an answer; elasticity: "
            "change over the input's, both in parts of themselves"
        )
        headings = ("", "at", "effect", "how much", "elasticity", "points")
        return (
            Table.of(["", *rises], curves, title="Efficiency of the teeth eta_z in percent"),
            Table.of(headings, summary, title="Influence", left=4, remarks=remarks),
        )


def sensitivity(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    *,
    inputs: Sequence[str] = INPUTS,
    rises: npt.ArrayLike = RISES,
    requirements: Requirements | None = None,
    folder: Path | None = None,
) -> Sensitivity:
    """Raise one input after the other and follow the efficiency by ISO/TR 14521.

    Parameters
    ----------
    gearset, operation, options : Gearset, Operation, RatingOptions
        As in `asperity.rating.rate`.
    inputs : sequence of str
        What to vary, by the names of `asperity.rating.variants`.
    rises : array_like
        By how much of itself, increasing from 0.
    requirements : Requirements, optional
        Where a rise no longer keeps what is asked is found.
    folder : path, optional
        Where a relative file name among the options starts.

    Returns
    -------
    Sensitivity
        A value without an answer is masked with its reason; where answers end is found.

    Raises
    ------
    InputError
        An input that cannot be varied, or a gearset that has no efficiency to begin with;
        `asperity.rating.iso14521.film_failure.FilmParameterError` where h* is not above zero.
    """
    options = options or RatingOptions()
    base: Any = rate(gearset, operation, options, (_STANDARD,)).found[_STANDARD]["eta_z1_2"]
    steps = _increasing(rises)
    given = given_inputs(gearset, operation, options)

    def at(name: str, shares: npt.ArrayLike) -> Variants:
        what = varied_quantity(name)
        values = what.to_si(what.of(given) * (1.0 + np.asarray(shares, dtype=np.float64)))
        return variants(gearset, operation, options, (_STANDARD,), capacity=False, **{name: values})

    def broken(name: str, shares: npt.ArrayLike) -> dict[str, npt.NDArray[np.bool_]]:
        what = varied_quantity(name)
        values = what.to_si(what.of(given) * (1.0 + np.asarray(shares, dtype=np.float64)))
        found = variants(gearset, operation, options, STANDARDS, **{name: values})
        return broken_by(asked, found, tables)

    asked = requirements or Requirements()
    tables = tables_of(options, folder) if asked.said else None
    influences = []
    for name in inputs:
        found = at(name, steps)
        below, above = at(name, [-_NEARBY, _NEARBY])[_EFFICIENCY]
        influences.append(
            Influence(
                quantity=varied_quantity(name),
                values=varied_quantity(name).of(given) * (1.0 + steps),
                efficiency=found[_EFFICIENCY],
                reason=found.reason(_EFFICIENCY),
                legend=MappingProxyType(dict(found.legend(_STANDARD))),
                elasticity=float((above - below) / (2.0 * _NEARBY * base)),
                fails_above=_end(lambda s, n=name: np.isnan(at(n, s)[_EFFICIENCY]), steps),
                broken_above={
                    key: _end(lambda s, n=name, k=key: broken(n, s)[k], steps) or 0.0
                    for key, breaks in (broken(name, steps).items() if asked.said else ())
                    if breaks.any()
                },
            )
        )
    return Sensitivity(
        name=gearset.name, efficiency=float(base), rises=steps, influences=tuple(influences)
    )


def prepare(case: Case) -> Gears:
    """Return the gearset of a case and how it runs."""
    return Gears.of(case)


def answer(gears: Gears, _: Run) -> Sensitivity:
    """Return the sensitivity of a case's gearset."""
    return sensitivity(
        gears.gearset,
        gears.operation,
        gears.options,
        requirements=gears.requirements,
        folder=gears.folder,
    )


def _increasing(rises: npt.ArrayLike) -> FloatArray:
    steps = np.array(rises, dtype=np.float64)
    if steps.ndim != 1 or steps.size < 2 or steps[0] != 0.0 or not np.all(np.diff(steps) > 0.0):
        raise InputError(f"rises is {str(rises)[:60]}; it must increase from 0, as in [0, 0.05]")
    return steps


def _end(failing: Any, steps: FloatArray) -> float | None:
    """Return where the first failure is, between the rises before and at it."""
    failed = failing(steps)
    if not failed.any():
        return None
    first = int(np.argmax(failed))
    if not first:
        return 0.0
    low, high = steps[first - 1], steps[first]
    for _ in range(_ROUNDS):
        grid = np.linspace(low, high, _PARTS + 1)
        first = int(np.argmax(failing(grid)))
        low, high = grid[first - 1], grid[first]
    return float(low)


def _plain(influence: Influence) -> dict[str, Any]:
    what = influence.quantity
    efficiency = [None if np.isnan(value) else value for value in influence.efficiency.tolist()]
    fails = influence.fails_above
    return {
        "symbol": what.symbol,
        what.key: influence.values.tolist(),
        "eta_z1_2": efficiency,
        "effect": influence.effect,
        "size": influence.size,
        "elasticity": influence.elasticity,
        "change_points": 100.0 * influence.change,
        "fails_above_percent": None if fails is None else 100.0 * fails,
        "reason": influence.failure or None,
    } | (
        {"broken_above_percent": {k: 100.0 * v for k, v in influence.broken_above.items()}}
        if influence.broken_above
        else {}
    )
