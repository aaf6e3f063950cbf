"""The studies as tables for the terminal."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.studies.optimise import design_numbers

if TYPE_CHECKING:
    from rich.console import Group
    from rich.table import Table

    from asperity.studies.comparison import Comparison
    from asperity.studies.optimise import Optimum
    from asperity.studies.sensitivity import Sensitivity
    from asperity.studies.tradeoff import TradeOff


def table(title: str, *headings: str, left: int = 1) -> "Table":
    """Return an empty table: numbers to the right, the first columns to the left."""
    from rich.table import Table

    made = Table(title=title, title_justify="left", box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for place, heading in enumerate(headings):
        made.add_column(heading, justify="left" if place < left else "right", no_wrap=True)
    return made


def points(change: float) -> str:
    """Return a change of an efficiency in points."""
    return f"{100.0 * change:+.1f}"


def percent(efficiency: float) -> str:
    """Return an efficiency in percent."""
    return "-" if np.isnan(efficiency) else f"{100.0 * efficiency:.1f}"


def sensitivity_report(study: "Sensitivity") -> "Group":
    """Return efficiencies over the rises, and a summary of the influences."""
    from rich.console import Group
    from rich.text import Text

    rises = [f"{100.0 * rise:+.0f} %" if rise else "as is" for rise in study.rises]
    curves = table("Efficiency of the teeth eta_z in percent", "", *rises)
    summary = table("Influence", "", "at", "effect", "size", "elasticity", "points", left=4)
    notes = []
    for found in study.influences:
        what = found.quantity
        curves.add_row(what.symbol, *map(percent, found.efficiency))
        summary.add_row(
            what.symbol,
            what.text(found.values[0]),
            found.effect,
            found.size,
            f"{found.elasticity:+.2f}",
            points(found.change),
        )
        if found.fails_above is not None:
            notes.append(
                f"- {what.symbol} raised by more than {100.0 * found.fails_above:.1f} %: "
                f"{found.failure}"
            )
    notes.append(
        "- points: change of the efficiency up to the last rise with an answer; elasticity: "
        "change over the input's, both in parts of themselves"
    )
    return Group(curves, Text(), summary, Text(), *map(Text, notes))


def comparison_report(comparison: "Comparison") -> "Group":
    """Return friction and efficiency with each method, with the sources and notes below."""
    from rich.console import Group
    from rich.text import Text

    shown = table(
        "Efficiency of the teeth eta_z and of the gearbox eta_ges in percent",
        "", "mu_0T", "mu_zm", "eta_z", "points", "eta_ges", "locks",
    )  # fmt: skip
    for row in comparison.rows:
        shown.add_row(
            row.name,
            f"{row.base_friction:.4f}",
            f"{row.friction:.4f}",
            percent(row.efficiency),
            points(row.gain),
            percent(row.total_efficiency),
            "yes" if row.locks else "no",
        )
    assumed = [f"{what} is assumed: {text}" for what, text in comparison.assumed.items()]
    names: dict[str, list[str]] = {}
    for row in comparison.rows:
        names.setdefault(str(row.source), []).append(row.name)
    sources = [f"{'; '.join(of)}: {source}" for source, of in names.items()]
    lines = [Text(f"- {line}") for line in (*comparison.notes, *assumed)]
    return Group(shown, Text(), *lines, Text(), *map(Text, ("Friction by", *sources)))


def optimum_report(optimum: "Optimum") -> "Group":
    """Return the gearset and its best design side by side, and what holds the design back."""
    from rich.console import Group
    from rich.text import Text

    shown = table("Highest efficiency of the teeth", "", "as it is", "optimum", "", left=1)
    before, after = design_numbers(optimum.before), design_numbers(optimum.after)
    for key, value in before.items():
        if isinstance(value, dict):
            now = after[key] or {}
            for own, number in value.items():
                if own in now:
                    shown.add_row(f"{key}.{own}", f"{number:.5g}", f"{now[own]:.5g}")
        elif value is not None:
            shown.add_row(key, f"{value:.5g}", f"{after[key]:.5g}")
    limits = table("Constraints that hold it back", "", "", "limit", "optimum", left=2)
    for limit in optimum.active:
        limits.add_row(limit.key, limit.relation, f"{limit.bound:.5g}", f"{limit.value:.5g}")
    lines = [
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
    return Group(shown, Text(), limits, Text(), *(Text(f"- {line}") for line in lines))


def trade_off_report(curve: "TradeOff") -> "Table":
    """Return the most efficient designs for rising permissible torques."""
    shown = table(
        "Most efficient designs for a permissible torque",
        "M_p (N m)", "eta_z (%)", "alpha_n (deg)", "q_1", "m_x1 (mm)", "Ra_1 (um)", "x_2", left=0,
    )  # fmt: skip
    keys = ("pressure_angle_deg", "diameter_factor", "axial_module_mm", "worm_roughness_um")
    columns = [curve.numbers[key] for key in (*keys, "profile_shift")]
    for place, torque in enumerate(curve.torque):
        design = [f"{column[place]:.4g}" for column in columns]
        shown.add_row(f"{torque:.4g}", percent(curve.efficiency[place]), *design)
    return shown
