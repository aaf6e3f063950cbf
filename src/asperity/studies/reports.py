"""The studies as tables."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.table import Table

if TYPE_CHECKING:
    from asperity.studies.comparison import Comparison
    from asperity.studies.optimise import Optimum
    from asperity.studies.sensitivity import Sensitivity
    from asperity.studies.tradeoff import TradeOff


def points(change: float) -> str:
    """Return a change of an efficiency in points."""
    return f"{100.0 * change:+.1f}"


def percent(efficiency: float) -> str:
    """Return an efficiency in percent."""
    return "-" if np.isnan(efficiency) else f"{100.0 * efficiency:.1f}"


def sensitivity_tables(study: "Sensitivity") -> tuple[Table, ...]:
    """Return efficiencies over the rises, and a summary of the influences."""
    rises = [f"{100.0 * rise:+.0f} %" if rise else "as is" for rise in study.rises]
    curves, summary, remarks = [], [], []
    for found in study.influences:
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
    remarks.append(
        "points: change of the efficiency up to the last rise with an answer; elasticity: "
        "change over the input's, both in parts of themselves"
    )
    headings = ("", "at", "effect", "size", "elasticity", "points")
    return (
        Table.of(["", *rises], curves, title="Efficiency of the teeth eta_z in percent"),
        Table.of(headings, summary, title="Influence", left=4, remarks=remarks),
    )


def comparison_tables(comparison: "Comparison") -> tuple[Table, ...]:
    """Return friction and efficiency with each method, with the sources and notes below."""
    rows = [
        [
            row.name,
            f"{row.base_friction:.4f}",
            f"{row.friction:.4f}",
            percent(row.efficiency),
            points(row.gain),
            percent(row.total_efficiency),
            row.locks,
        ]
        for row in comparison.rows
    ]
    assumed = [f"{what} is assumed: {text}" for what, text in comparison.assumed.items()]
    names: dict[str, list[str]] = {}
    for row in comparison.rows:
        names.setdefault(str(row.source), []).append(row.name)
    sources = [f"friction of {'; '.join(of)}: {source}" for source, of in names.items()]
    return (
        Table.of(
            ("", "mu_0T", "mu_zm", "eta_z", "points", "eta_ges", "locks"),
            rows,
            title="Efficiency of the teeth eta_z and of the gearbox eta_ges in percent",
            remarks=(*comparison.notes, *assumed, *sources),
        ),
    )


def optimum_tables(
    optimum: "Optimum", before: Mapping[str, Any], after: Mapping[str, Any]
) -> tuple[Table, ...]:
    """Return the gearset and its best design side by side, and what holds the design back."""
    rows = []
    for key, value in before.items():
        if isinstance(value, dict):
            now = after[key] or {}
            rows += [[f"{key}.{own}", value[own], now[own]] for own in value if own in now]
        elif value is not None:
            rows.append([key, value, after[key]])
    active = [[limit.key, limit.relation, limit.bound, limit.value] for limit in optimum.active]
    remarks = [
        f"eta_z {points(optimum.gain)} points; {optimum.agreed} of {optimum.starts} starts agree",
        "other constraints do not hold it back: "
        + ", ".join(
            f"{limit.symbol} {limit.relation} {limit.bound:.4g}"
            for limit in optimum.limits
            if not limit.active
        ),
        "rate it with " + " ".join(f'--set "{setting}"' for setting in optimum.settings),
        *optimum.notes,
    ]
    held = "Constraints that hold it back"
    tables = (
        Table.of(("", "as it is", "optimum"), rows, title="Highest efficiency of the teeth"),
        Table.of(("", "", "limit", "optimum"), active, title=held, left=2, remarks=remarks),
    )
    return tables if optimum.curve is None else (*tables, trade_off_table(optimum.curve))


def trade_off_table(curve: "TradeOff") -> Table:
    """Return the most efficient designs for rising permissible torques."""
    keys = ("pressure_angle_deg", "diameter_factor", "axial_module_mm", "worm_roughness_um")
    columns = [curve.numbers[key] for key in (*keys, "profile_shift")]
    rows = [
        [
            f"{torque:.4g}",
            percent(curve.efficiency[place]),
            *(f"{column[place]:.4g}" for column in columns),
        ]
        for place, torque in enumerate(curve.torque)
    ]
    return Table.of(
        ("M_p (N m)", "eta_z (%)", "alpha_n (deg)", "q_1", "m_x1 (mm)", "Ra_1 (um)", "x_2"),
        rows,
        title="Most efficient designs for a permissible torque",
        left=0,
    )
