"""Pictures of the simulation's model and of the shaken gearset, drawn from their datasets alone."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, COLOURS, GREEN, VERMILION, axes_grid, legend
from asperity.thesis.drawing import DOTTED, arrow, asperity, legend_above, limit, line, marks
from asperity.thesis.flanks.drawings import BRONZE, STEEL, View, paint
from asperity.thesis.flanks.shapes import Shape

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_K = r"velocity ratio $k_w = v_a/v_g$"
_RATIO = r"$T_{Bv}/T_{Bs}$"
_GREY = "#D9D9D9"
_TICKS = (0.1, 0.5, 1, 2, 3, 5, 10, 20)


def _over_k(axes: "Axes", label: str = _RATIO) -> None:
    axes.set_xscale("log")
    axes.set_xticks(_TICKS, [f"{tick:g}" for tick in _TICKS])
    axes.set_xticks([], minor=True)
    axes.set(xlabel=_K, ylabel=label, xlim=(0.09, 22.0))


def _not_settled(axes: "Axes", k: Any, values: Any, settled: Any, label: str | None = None) -> None:
    loose = np.asarray(settled) < 0.5
    axes.plot(
        np.asarray(k)[loose], np.asarray(values)[loose], "x", color=BLACK, markersize=9, zorder=4,
        label=label if loose.any() else None,
    )  # fmt: skip


def ratios(dataset: "xr.Dataset") -> "Figure":
    """Draw both readings of the ratio over k_w above, how the wheel is balanced below."""
    figure, (upper, lower) = axes_grid(2, height=7.2)
    _ratios(upper, lower, dataset)
    return figure


def laws(dataset: "xr.Dataset") -> "Figure":
    """Draw both readings, the balance, and the friction that three laws give."""
    figure, (upper, lower, last) = axes_grid(3, height=9.6)
    _ratios(upper, lower, dataset)
    for index, name in enumerate(dataset["law"].values):
        own = dataset["friction"].sel(law=name)
        line(last, index, dataset["k"], own, linewidth=0.8)
        marks(last, index, dataset["k"], own, str(name), filled=index == 0)
    _over_k(last, r"mean friction over $\mu N$")
    limit(last, 0.0, 1.0)
    legend(last, loc="lower left")
    return figure


def _ratios(upper: "Axes", lower: "Axes", dataset: "xr.Dataset") -> None:
    k = dataset["k"]
    for index, name in enumerate(dataset["series"].values):
        own = dataset.sel(series=name)
        marks(upper, index, k, own["ratio"], str(name), filled=True)
        line(upper, index, k, own["ratio"], linewidth=0.8)
        # Told once, by the first that has any.
        told = any("not settled" in str(each.get_label()) for each in upper.lines)
        words = None if told else "not settled"
        _not_settled(upper, k, own["ratio"], own["settled"], words)
        marks(upper, index, k, own["window"], f"{name}, first cycles")
        marks(lower, index, k, own["balance"], filled=True)
        marks(lower, index, k, own["window_balance"])
        line(lower, index, k, own["window_balance"], linewidth=0.8)
    limit(upper, 1.0)
    upper.axhline(
        float(dataset["floor"]), color=BLACK, dashes=DOTTED, linewidth=1.0,
        label="all friction reversed",
    )  # fmt: skip
    _over_k(upper)
    legend_above(upper, 2)
    _over_k(lower, "wheel's torque over its load, less 1")
    lower.set_yscale("symlog", linthresh=0.1)
    lower.axhspan(-0.1, 0.1, color=_GREY, alpha=0.5, zorder=0, label="even scale within")
    lower.margins(y=0.1)
    limit(lower, 0.0)
    legend(lower, loc="upper left")
    if "thesis" in dataset:
        _of_thesis(upper, float(dataset["thesis"]))
        legend_above(upper, 2)


def _of_thesis(axes: "Axes", value: float) -> None:
    axes.plot(20.0, value, "*", color=VERMILION, markersize=13, label="thesis", zorder=5)


def torque_over_time(dataset: "xr.Dataset") -> "Figure":
    """Draw the torque from the load on, its first cycles alone, and means so far.

    Contact lost is grey, in the first two.
    """
    figure, (whole, upper, lower) = axes_grid(3, height=9.6)
    begins = 1e3 * dataset["steps"].values
    time = 1e3 * dataset["time"].values
    _torque(whole, time, dataset)
    whole.set(xlabel="time from the load on (ms)", xlim=(0.0, time[-1]))
    top = whole.get_xaxis_transform()
    edges = [0.0, *begins, time[-1]]
    for name, left, right in zip(
        ("load", "run-up", "steady", "vibration"), edges[:-1], edges[1:], strict=True
    ):
        if left > 0.0:
            whole.axvline(left, color=BLACK, linewidth=0.7)
        whole.text(
            0.5 * (left + right), 0.96, name, transform=top, va="center", ha="center", fontsize=9,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.0},
        )  # fmt: skip
    whole.margins(y=0.15)
    legend_above(whole, 4)
    _torque(upper, time - begins[-1], dataset)
    upper.set(
        xlabel="time from the start of the vibration (ms)",
        xlim=(0.0, 1e3 * float(dataset["first"])),
    )
    cycles = dataset["cycles"]
    lower.plot(
        cycles, dataset["cycle"], ".", color="#8C8C8C", markersize=3,
        label=r"single cycles of the worm, over $T_{Bs}$",
    )  # fmt: skip
    line(lower, 0, cycles, dataset["worm"], r"worm, over $T_{Bs}$")
    line(lower, 1, cycles, dataset["wheel"], r"wheel, over $T_R$")
    lower.axhline(
        float(dataset["thesis"] / dataset["thesis_static"]), color=BLACK, dashes=DOTTED,
        linewidth=1.2, label="0.22 of the thesis",
    )  # fmt: skip
    at_end = "settled" if float(dataset["settled"]) > 0.5 else "not settled"
    lower.axhline(
        float(dataset["ratio"]), color=BLUE, dashes=(5, 2), linewidth=1.0,
        label=f"at the end ({at_end}, balanced to {abs(float(dataset['balance'])):.1%})",
    )  # fmt: skip
    limit(lower, 1.0)
    lower.set(xscale="log", xlabel="cycles from the start", ylabel="mean, so far or of a cycle")
    legend_above(lower, 2)
    return figure


def _torque(axes: "Axes", time: Any, dataset: "xr.Dataset") -> None:
    axes.fill_between(
        time, 0.0, 1.0, where=dataset["open"].values > 0.5, color=_GREY, linewidth=0,
        label="no contact", transform=axes.get_xaxis_transform(),
    )  # fmt: skip
    line(axes, 0, time, dataset["torque"], "$T_B$", linewidth=1.0)
    for value, name, dashes in (
        ("static", "without vibration", (5, 2)),
        ("thesis", "7.4 N m of the thesis", DOTTED),
    ):
        axes.axhline(float(dataset[value]), color=BLACK, dashes=dashes, label=name, linewidth=1.2)
    axes.set_ylabel("$T_B$ (N m)")


def advantage(dataset: "xr.Dataset") -> "Figure":
    """Draw ratio, advantage and system efficiency; rigid friction beside them."""
    figure, (left, right) = axes_grid(1, 2, width=11.0, height=4.6)
    k = dataset["k"]
    for index, (name, label) in enumerate(
        (("ratio", _RATIO), ("efficiency", r"$\eta_{sys}$ with the actuator"))
    ):
        line(left, index, k, dataset[name], linewidth=0.8)
        marks(left, index, k, dataset[name], label, filled=True)
        _not_settled(left, k, dataset[name], dataset["settled"])
    _over_k(left, r"$T_{Bv}/T_{Bs}$, $\eta_{sys}$")
    other = left.twinx()
    other.grid(False)
    line(
        left, 2, [], [], "$M_a$ (right)", color=GREEN, marker="D", markerfacecolor="none",
    )  # fmt: skip
    line(other, 2, k, dataset["advantage"], color=GREEN, marker="D", markerfacecolor="none")
    _not_settled(other, k, dataset["advantage"], dataset["settled"])
    _not_settled(left, [0.0], [0.0], [0.0], "not settled")
    _of_thesis(left, float(dataset["thesis_ratio"]))
    other.plot(20.0, float(dataset["thesis_advantage"]), "*", color=VERMILION, markersize=13)
    other.set_ylabel(r"mechanical advantage $M_a$", color=GREEN)
    other.set_ylim(0.0, None)
    low, high = dataset["thesis_efficiency"].values
    left.fill_between(
        [0.1, 5.0], low, high, color=VERMILION, alpha=0.3, linewidth=0.0,
        label=r"$\eta_{sys}$ of the thesis",
    )  # fmt: skip
    legend_above(left, 2)
    left.set_title("(a)", loc="left")
    for name, colour in (("across", BLUE), ("along", VERMILION)):
        right.plot(dataset["k_v"], dataset[name], color=colour, label=f"rigid friction, {name}")
        right.axhline(
            float(dataset["measured"].sel(test=name)), color=colour, dashes=DOTTED,
            label=f"least of the disc tests, {name}",
        )  # fmt: skip
    _over_k(right, r"$T_{sv}/T_{ss}$")
    right.set(xlabel="velocity ratio $k_v$", xlim=left.get_xlim(), ylim=(0, 1.05))
    legend(right, loc="upper right", fontsize=8)
    right.set_title("(b)", loc="left")
    return figure


_BORE = View((0.5, 0.35, 1.0))
_WHOLE = View((-0.5, 0.45, 1.0))
_GREEN = "#58A06B"


def _projected(view: View, points: Any) -> Any:
    return np.asarray(points) @ view.axes[:2].T


def bore(dataset: "xr.Dataset") -> "Figure":
    """Draw the ring of teeth with its inside in green, on the centre point."""
    figure, (axes,) = axes_grid(1, 1, width=7.0, height=5.6)
    paint(axes, Shape.read(dataset, "ring"), {0: BRONZE, 1: _GREEN}, _BORE, edges=0.1)
    centre = _projected(_BORE, dataset["centre"].values)
    for node in _projected(_BORE, dataset["linked"].values):
        axes.plot(*zip(centre, node, strict=True), color=BLACK, linewidth=0.6, zorder=3)
    axes.plot(*centre, "o", color=BLACK, markersize=5, zorder=4)
    axes.annotate("centre point", centre, (12, -16), textcoords="offset points")
    return figure


def model(dataset: "xr.Dataset") -> "Figure":
    """Draw the meshed wheel and the worm on its torsional spring."""
    figure, (axes,) = axes_grid(1, 1, width=8.0, height=6.0)
    paint(axes, Shape.read(dataset, "gearset"), {0: BRONZE, 1: STEEL}, _WHOLE, edges=0.08)
    axes.plot(*_projected(_WHOLE, dataset["spring"].values).T, color=COLOURS[0], linewidth=1.6)
    ends = _projected(_WHOLE, dataset["ends"].values)
    for name, end in zip("AB", ends, strict=True):
        axes.plot(*end, "o", color=BLACK, markersize=5)
        beside = (-8, 10) if name == "A" else (4, 8)
        axes.annotate(name, end, beside, textcoords="offset points", weight="bold")
    axes.annotate("AB: 4394 N m/rad", ends[1], (10, -22), textcoords="offset points")
    tip = ends[1] + _projected(_WHOLE, 26.0 * dataset["axis"].values)
    arrow(axes, ends[1], tip, BLACK, arrowstyle="->")
    axes.annotate("X", tip, (4, -2), textcoords="offset points")
    for name, direction in zip("YZ", dataset["across"].values, strict=True):
        end = ends[1] + _projected(_WHOLE, 26.0 * direction)
        arrow(axes, ends[1], end, BLACK, arrowstyle="->")
        axes.annotate(name, end, (4, -2), textcoords="offset points")
        axes.update_datalim([end])
    axes.update_datalim([tip])
    axes.autoscale_view()
    return figure


def increment(dataset: "xr.Dataset") -> "Figure":
    """Draw body and root of an asperity through the two phases of an increment."""
    figure, (axes,) = axes_grid(1, 1, width=7.2, height=4.6)
    body, root = dataset["body"].values, dataset["root"].values
    # M'2 is carried by dy, and the second phase begins there.
    stretched = ((root[0], body[0]), (root[1], body[1]), (root[3], body[2]))
    shifts = ((-74, -2), (8, -12), (8, -12))
    asperity(axes, body, root, stretched, dataset["deflection"].values, shifts)
    for place, names, offsets in ((body, _BODIES, _BESIDE_BODIES), (root, _ROOTS, _BESIDE_ROOTS)):
        for at, name, offset in zip(place, names, offsets, strict=True):
            axes.annotate(name, at, offset, textcoords="offset points")
    for (one, other), name, shift in zip(
        ((body[0], body[1]), (body[1], body[2])), ("Δx", "Δy"), ((0, 5), (6, 0)), strict=True
    ):
        axes.annotate(name, 0.5 * (one + other), shift, textcoords="offset points")
    for (root_at, _), angle, name, n in zip(
        stretched[1:], dataset["angle"].values, ("α", "β"), (1, 2), strict=True
    ):
        turn = np.linspace(0.0, angle, 30)
        arc = root_at[:, None] + 0.16 * np.array([np.cos(turn), np.sin(turn)])
        axes.plot(*arc, color=COLOURS[n], linewidth=1.2)
        axes.plot(
            [root_at[0], root_at[0] + 0.22], [root_at[1]] * 2, color=COLOURS[n], linewidth=0.7
        )
        axes.annotate(name, arc[:, 20], (4, 0), textcoords="offset points", color=COLOURS[n])
    _equal(axes, "along x, over $s_{max}$", "along y, over $s_{max}$")
    return figure


_BODIES, _BESIDE_BODIES = ("N'", "N''", "N'₁"), ((-6, 9), (8, -3), (-4, 9))
_ROOTS, _BESIDE_ROOTS = ("M", "M'¹", "M'²", "M₁"), ((-4, -16), (-4, -16), (-24, 4), (-4, -16))


def _equal(axes: "Axes", x: str, y: str) -> None:
    axes.set_aspect("equal")
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.margins(0.12)
