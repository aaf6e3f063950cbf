"""Pictures of the studies of drives; each takes the dataset of an answer."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, BLUE, GREEN, ORANGE, VERMILION, legend, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_DARK = 0.35  # of the way of the colours, from where letters on them are white


def plot_map(dataset: "xr.Dataset") -> "Figure":
    """Draw ratio and energy over frequency and k_w; crossed where they are of no periodic state."""
    figure, (left, right) = panels(1, 2, width=11.0, height=4.8)
    k = dataset["velocity_ratio"].values
    form = ", ".join(f"{x:.2f}" for x in dataset["closed_form"].values)
    for axes, name, title in (
        (left, "torque_ratio", f"torque ratio; {_balances(dataset)}"),
        (right, "energy_ratio", "power put in over that without vibration"),
    ):
        _plane(axes, dataset, name)
        axes.set_title(title)
    left.annotate(
        f"a screw far above resonance: {form}\nat k = {', '.join(f'{x:g}' for x in k)}", (0.0, 1.1),
        xycoords="axes fraction", fontsize=8.0,
    )  # fmt: skip
    return figure


def _balances(dataset: "xr.Dataset") -> str:
    """Return how well the wheel is balanced where the state is periodic, and where it is not."""
    off = 100.0 * np.abs(dataset["torque_balance"].values)
    settled = dataset["settled"].values == 1
    parts = [
        f"{name} in balance to {off[where].max():.1g} %"
        for name, where in (
            ("settled ones", settled & np.isfinite(off)), ("crossed", ~settled & np.isfinite(off)),
        )
        if where.any()
    ]  # fmt: skip
    return ", ".join(parts) or "none marched"


def _plane(axes: "Axes", dataset: "xr.Dataset", name: str) -> None:
    from matplotlib.colors import TwoSlopeNorm

    values = dataset[name].values
    low, high = float(np.nanmin(values)), min(float(np.nanmax(values)), 2.0)
    norm = TwoSlopeNorm(1.0, min(low, 0.95), max(high, 1.05))
    rows, columns = values.shape
    image = axes.imshow(values, cmap="RdBu_r", norm=norm, origin="lower", aspect="auto")
    for row in range(rows):
        for column in range(columns):
            if np.isfinite(values[row, column]):
                # Told by its size, so that no ratio is read by colour alone.
                dark = abs(float(norm(values[row, column])) - 0.5) > _DARK
                axes.annotate(
                    f"{values[row, column]:.2f}", (column, row), ha="center", va="center",
                    fontsize=8.0, color="white" if dark else BLACK,
                )  # fmt: skip
    loose = np.argwhere(dataset["settled"].values == 0)
    axes.plot(loose[:, 1], loose[:, 0], "x", color=BLACK, markersize=14, alpha=0.5)
    frequency = dataset["frequency"].values
    for key, label in (("resonance_worm", "$f_1$"), ("resonance_wheel", "$f_2$")):
        if key in dataset:
            at = np.interp(float(dataset[key]), frequency, np.arange(rows))
            axes.axhline(at, color=BLACK, dashes=(4, 2), linewidth=1.2)
            axes.annotate(label, (columns - 0.45, at), annotation_clip=False)
    axes.set_xticks(range(columns), [f"{x:g}" for x in dataset["velocity_ratio"].values])
    axes.set_yticks(range(rows), [f"{1e-3 * x:g}" for x in frequency])
    axes.grid(False)
    axes.set(xlabel="velocity ratio $k_w$", ylabel="frequency (kHz)")
    figure = axes.get_figure()
    assert figure is not None
    figure.colorbar(image, ax=axes)


def plot_on_demand(dataset: "xr.Dataset") -> "Figure":
    """Draw the motor's torque over a stroke without and with vibration at the seats."""
    figure, (axes,) = panels(1, 1, height=4.4)
    ends = np.degrees(np.concatenate([[0.0], dataset["part_turn"].values]))

    def steps(name: str) -> tuple[np.ndarray, np.ndarray]:
        values = dataset[name].values
        return np.repeat(ends, 2)[1:-1], np.repeat(values, 2)

    axes.plot(*steps("part_plain"), color=BLACK, label="without vibration")
    axes.plot(*steps("part_shaken"), color=BLUE, dashes=(5, 2), label="shaken at the seats")
    for n in (0, 2):
        axes.axvspan(ends[n], ends[n + 1], color=ORANGE, alpha=0.25, linewidth=0,
                     label="vibration on" if n == 0 else None)  # fmt: skip
    settled = "settled" if dataset.attrs["settled"] else "not settled"
    holds = "holds" if dataset.attrs["holds_after"] else "does not hold"
    axes.set_title(
        f"ratio {float(dataset['torque_ratio']):.2f} ({settled}, in balance to "
        f"{100.0 * abs(float(dataset['torque_balance'])):.1g} %); motor "
        f"{dataset.attrs['motor_plain']} to {dataset.attrs['motor_shaken']}; {holds} after",
        fontsize=10.0,
    )
    axes.set(xlabel="turn of the wheel (deg)", ylabel="torque of the motor (N m)")
    axes.set_ylim(0.0, None)
    legend(axes, loc="upper center")
    return figure


def plot_gains(dataset: "xr.Dataset") -> "Figure":
    """Draw what each gearset keeps of its torque over its efficiency."""
    figure, (axes,) = panels(1, 1, height=4.6)
    efficiency, ratio = dataset["efficiency"].values, dataset["shaken_ratio"].values
    locks = dataset["locks"].values > 0.5
    for where, colour, marker, label in (
        (locks, VERMILION, "s", "locks itself"),
        (~locks, BLUE, "o", "does not"),
    ):
        axes.plot(efficiency[where], ratio[where], marker, color=colour, label=label)
    free = locks & (dataset["locks_shaken"].values < 0.5)
    axes.plot(efficiency[free], ratio[free], "o", markersize=13, markerfacecolor="none",
              color=GREEN, label="no longer locks while it is shaken")  # fmt: skip
    for name, x, y in zip(dataset["gearset"].values, efficiency, ratio, strict=True):
        axes.annotate(str(name), (x, y), (5, -10), textcoords="offset points", fontsize=8.0)
    axes.plot([0.0, 1.0], [0.0, 1.0], color=BLACK, dashes=(1, 1.5), label="without any friction")
    axes.set(
        xlabel="efficiency of the teeth without vibration", xlim=(0.0, 1.0), ylim=(0.0, 1.05),
        ylabel=f"torque ratio, screw at $k_w$ = {float(dataset['velocity_ratio']):g}, in balance",
    )  # fmt: skip
    legend(axes, loc="lower right")
    return figure
