"""Pictures of the studies of drives; each takes the dataset of an answer."""

from typing import TYPE_CHECKING

import numpy as np

from asperity.results.figures import BLACK, BLUE, ORANGE, axes_grid, legend

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def plot_on_demand(dataset: "xr.Dataset") -> "Figure":
    """Draw the motor's torque over a stroke without and with vibration at the seats."""
    figure, (axes,) = axes_grid(1, 1, height=4.4)
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
    holds = "holds" if dataset.attrs["held_after"] else "does not hold"
    axes.set_title(
        f"{float(dataset['torque_ratio']):.2f} of the torque at the seats ({settled}, in balance "
        f"to {100.0 * abs(float(dataset['torque_balance'])):.1g} %)\nmotor "
        f"{dataset.attrs['motor_shaken']} for {dataset.attrs['motor_plain']}; it {holds} after",
        loc="left", fontsize=10.0,
    )  # fmt: skip
    axes.set(xlabel="turn of the wheel (deg)", ylabel="torque of the motor (N m)")
    axes.set_ylim(0.0, None)
    legend(axes, loc="upper center")
    return figure
