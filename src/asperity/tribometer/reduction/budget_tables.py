"""What makes the numbers of a reduction uncertain, as tables, JSON, CSV and variables."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from asperity.casefile import Case
from asperity.results.files import csv_text
from asperity.results.quantity import plain
from asperity.results.table import Table
from asperity.results.words import text_of
from asperity.tribometer.channels import Channels
from asperity.tribometer.reduction.combined_uncertainty import TORQUE
from asperity.tribometer.reduction.following import BRONZE, CURRENT, STEEL
from asperity.tribometer.uncertainty import Budget, Contribution

if TYPE_CHECKING:
    import xarray as xr

Budgets = Mapping[str, Budget]

NUMBERS = {
    "torque_before": ("torque before", "N m"),
    "torque_with": ("torque with vibration", "N m"),
    "torque_change": ("change of the torque", "%"),
    "power_change": ("change of the power", "%"),
    "efficiency_change": ("change of (75)", "points"),
    "full_efficiency_change": ("change of the efficiency with all losses", "points"),
    "sliding_velocity_before": ("sliding velocity before", "mm/s"),
    "sliding_velocity_with": ("sliding velocity with vibration", "mm/s"),
    "k_v": ("velocity ratio", ""),
}
"""What has a budget in a segment: its name in words and its unit."""

_TOLD = NUMBERS | {
    "wear_rate": ("volume lost by force and path", "mm3/(N m)"),
    "wear_rate_by_distance": ("volume lost by force and distance", "mm3/(N m)"),
}
"""What has one there, or in a run of a wear test."""

_CSV = (
    "file", "start_s", "number", "unit", "value", "standard_uncertainty", "effective_freedom",
    "coverage_factor", "expanded_uncertainty", "contribution", "type", "input_1", "uncertainty_1",
    "sensitivity_1", "input_2", "uncertainty_2", "sensitivity_2", "correlation", "size",
    "share_percent", "freedom",
)  # fmt: skip
_LEAST_SHARE = 5e-4
_MANY = 1000.0
_RESTED_ON = TORQUE, STEEL, BRONZE, CURRENT, "acceleration"

Row = tuple[str, float | None, Budgets]
"""Of a segment its file, its start and its budgets."""


def not_counted(case: Case, signals: Sequence[str]) -> Iterator[str]:
    """Yield what no budget of a recording counts, because nothing tells how uncertain it is.

    Parameters
    ----------
    case : Case
        The configuration.
    signals : sequence of str
        Those that are recorded.
    """
    mapped = case.require(Channels).mapped()
    for name in (one for one in _RESTED_ON if one in signals):
        channel = mapped.get(name)
        if channel is None or not channel.points:
            yield f"{name} has no calibration: it is taken as it was recorded"
        elif not channel.line().known:
            yield (
                f"the calibration of {name} is taken as exact: {len(channel.points)} points tell "
                f"no uncertainty; give channels.{name}.uncertainty"
            )
    yield (
        "the supply's set voltage, diameters, gear ratios and the bearings' torque are taken as "
        "exact"
    )
    yield (
        "what comes into a torque with its motor, as an offset that is not there at rest: a run "
        "with the discs apart shows it"
    )


def of_segment(budgets: Budgets) -> list[dict[str, Any]]:
    """Return budgets as JSON has them; degrees of freedom without end are null."""
    made = []
    for name, budget in budgets.items():
        made.append(
            {
                "number": name, "unit": _TOLD[name][1], "value": budget.value,
                "standard_uncertainty": budget.uncertainty, "effective_freedom": budget.freedom,
                "coverage_factor": budget.coverage_factor, "confidence": budget.confidence,
                "expanded_uncertainty": budget.expanded,
                "contributions": [
                    {
                        "contribution": one.name, "type": one.kind, "inputs": one.inputs,
                        "uncertainties": one.uncertainties, "sensitivities": one.sensitivities,
                        "correlation": one.correlation, "size": one.size,
                        "share_percent": 100.0 * budget.share(one), "freedom": one.freedom,
                    }
                    for one in budget.contributions
                ],
            }
        )  # fmt: skip
    found: list[dict[str, Any]] = plain(made)
    return found


def to_csv(rows: Sequence[Row]) -> str:
    """Return a row a contribution."""
    lines: list[Sequence[object]] = [_CSV]
    for file, start, budgets in rows:
        for name, budget in budgets.items():
            head = (
                file, start, name, _TOLD[name][1], budget.value, budget.uncertainty,
                _finite(budget.freedom), budget.coverage_factor, budget.expanded,
            )  # fmt: skip
            for one in budget.contributions:
                inputs = zip(one.inputs, one.uncertainties, one.sensitivities, strict=True)
                flat: list[str | float] = [cell for three in inputs for cell in three]
                flat += [""] * (6 - len(flat))
                lines.append((
                    *head, one.name, one.kind, *flat, one.correlation, one.size,
                    100.0 * budget.share(one), _finite(one.freedom),
                ))  # fmt: skip
    return csv_text(lines)


def tables(rows: Sequence[Row], left_out: Sequence[str]) -> tuple[Table, ...]:
    """Return every number with its uncertainty, and of each segment what that comes from."""
    return summary(rows, left_out), *(_detail(*row) for row in rows)


def summary(
    rows: Sequence[Row], left_out: Sequence[str], numbers: Sequence[str] = tuple(_TOLD)
) -> Table:
    """Return numbers with their uncertainties."""
    lines = [
        (file, _at(start), f"{_TOLD[name][0]} {_TOLD[name][1]}".strip(), _largest(budget),
         *map(_digits, (budget.value, budget.uncertainty)), _freedom(budget.freedom),
         *map(_digits, (budget.coverage_factor, budget.expanded)))
        for file, start, budgets in rows
        for name, budget in budgets.items() if name in numbers
    ]  # fmt: skip
    heads = ("file", "at s", "number", "most of it", "value", "u_c", "nu_eff", "k", "U")
    return Table.of(
        heads, lines, left=4, title="Uncertainty (GUM)",
        remarks=(
            "u_c: combined standard uncertainty; nu_eff: by Welch and Satterthwaite; k: Student's "
            "factor; U = k u_c, half the interval",
            *(f"not counted: {one}" for one in left_out),
        ),
    )  # fmt: skip


def _detail(file: str, start: float | None, budgets: Budgets) -> Table:
    rows = [
        (name, one.name, one.kind, *_pair(one.uncertainties), _mixed(one),
         *_pair(one.sensitivities), _digits(one.size), f"{100.0 * budget.share(one):.1f}",
         _freedom(one.freedom))
        for name, budget in budgets.items()
        for one in budget.contributions if abs(budget.share(one)) >= _LEAST_SHARE
    ]  # fmt: skip
    heads = (
        "number", "contribution", "type", "u before", "u with", "r", "c before", "c with", "u_i",
        "share %", "nu",
    )  # fmt: skip
    return Table.of(
        heads, rows, left=3, title=f"Contributions: {file} at {_at(start)} s",
        remarks=(
            "u of levels in N m, rad/s and A, of v_a in m/s, r their correlation; c: of the number "
            f"by these; what brings less than {100.0 * _LEAST_SHARE:g} % stands in files only",
        ),
    )  # fmt: skip


def variables(rows: Sequence[Row]) -> "xr.Dataset":
    """Return uncertainties of each segment's numbers, and what each contribution leaves in them."""
    import numpy as np
    import xarray as xr

    causes = list(dict.fromkeys(
        one.name for _, _, budgets in rows for budget in budgets.values()
        for one in budget.contributions
    ))  # fmt: skip
    numbers = list(NUMBERS)
    whole = {
        "standard_uncertainty": "combined standard uncertainty, in the number's unit",
        "inverse_freedom": "one over the effective degrees of freedom; zero where all are stated",
        "coverage_factor": "factor of the interval",
    }
    flat = {key: np.full((len(rows), len(numbers)), np.nan) for key in whole}
    size = np.full((len(rows), len(numbers), len(causes)), np.nan)
    freedom = size.copy()
    for row, (_, _, budgets) in enumerate(rows):
        for name, budget in budgets.items():
            place = row, numbers.index(name)
            values = budget.uncertainty, 1.0 / budget.freedom, budget.coverage_factor
            for key, value in zip(whole, values, strict=True):
                flat[key][place] = value
            for one in budget.contributions:
                size[*place, causes.index(one.name)] = one.size
                freedom[*place, causes.index(one.name)] = 1.0 / one.freedom
    made = xr.Dataset(
        {
            key: (("segment", "number"), flat[key], {"units": "1", "long_name": meaning})
            for key, meaning in whole.items()
        }
    )
    dims = "segment", "number", "contribution"
    made["contribution_size"] = dims, size, {
        "units": "1", "long_name": "u_i, in the number's unit; below zero where it cancels",
    }  # fmt: skip
    made["contribution_inverse_freedom"] = dims, freedom, {
        "units": "1", "long_name": "one over its degrees of freedom; zero where it is stated",
    }  # fmt: skip
    named = {"units": "1", "long_name": "what has a budget"}
    made["number"] = "number", np.array(numbers, dtype=object), named
    units = np.array([unit or "1" for _, unit in NUMBERS.values()], dtype=object)
    made["number_unit"] = "number", units, {"units": "1", "long_name": "unit of that"}
    made["contribution"] = "contribution", np.array(causes, dtype=object), {
        "units": "1", "long_name": "what a number is uncertain by",
    }  # fmt: skip
    return made


def _largest(budget: Budget) -> str:
    most = max(budget.contributions, key=lambda one: one.variance)
    return f"{most.name} ({100.0 * budget.share(most):.0f} %)"


def _finite(value: float) -> float | str:
    return value if value < math.inf else ""


def _at(start: float | None) -> str:
    return f"{start or 0.0:.0f}"


def _digits(value: float) -> float:
    return float(f"{value:.4g}")


def _freedom(value: float) -> str:
    return f"{value:.1f}" if value < _MANY else f"> {_MANY:g}" if value < math.inf else "inf"


def _pair(values: Sequence[float]) -> tuple[str, str]:
    first, last, *_ = (*(text_of(float(f"{one:.3g}")) for one in values), "", "")
    return first, last


def _mixed(contribution: Contribution) -> str:
    return f"{contribution.correlation:.2f}" if len(contribution.inputs) > 1 else ""
