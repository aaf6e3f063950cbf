"""The picture of a sweep of drives over two numeric axes: maps of what they come to."""

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.results.figures import BLACK, ORANGE, axes_grid
from asperity.units import to_si

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_DARK = 0.35  # of the way of the colours, from where letters on them are white
_MOST_TICKS = 12
_MOST_WORDS = 150  # cells that are told in numbers
_TORQUE, _FORM, _ENERGY = "torque_ratio", "torque_ratio_closed_form", "energy_ratio"
_TITLES = {
    _TORQUE: "torque over that without vibration",
    _FORM: "the same far above the resonances, closed form",
    _ENERGY: "power put in over that without vibration",
}
_RESONANCES = (("resonance_worm", "$f_1$"), ("resonance_wheel", "$f_2$"))


def plot_map(dataset: "xr.Dataset") -> "Figure":
    """Draw ratio, its closed form and power over two axes; crossed where no state is periodic."""
    down, across = _axes(dataset)
    shown = [name for name in _TITLES if name in dataset]
    figure, axes = axes_grid(1, len(shown), width=1.0 + 5.0 * len(shown), height=4.8)
    order = dataset.sortby([down, across]).transpose(down, across)
    for panel, name in zip(axes, shown, strict=True):
        # The closed form has the colours of what it stands beside, and no state of its own.
        scale = _ENERGY if name == _ENERGY else _TORQUE
        settled = (order["settled"].values > 0.0) | (name == _FORM)
        plane(panel, order[name].values, order[scale].values)
        _cross_out(panel, ~settled)
        ticks(panel, order, down, across)
        panel.set_title(_TITLES[name], fontsize=11.0)
    _mark_resonances(axes[: shown.index(_TORQUE) + 1], order, down)
    figure.suptitle(balances(dataset), fontsize=11.0)
    return figure


def balances(dataset: "xr.Dataset") -> str:
    """Return how well the wheels are balanced where the state is periodic, and where it is not."""
    off = 100.0 * np.abs(dataset["torque_balance"].values)
    settled = dataset["settled"].values > 0.0
    found = np.isfinite(off)
    words = []
    for where, what in (
        (settled & found, "settled, the wheel in balance to"),
        (~settled & found, "crossed out: not settled, out of balance by up to"),
    ):
        if where.any():
            words.append(f"{int(where.sum())} {what} {off[where].max():.1g} %")
    return "; ".join(words) or "none marched"


def _axes(dataset: "xr.Dataset") -> tuple[str, str]:
    """Return the axis that runs up, a frequency if there is one, and the one across."""
    first, second = (str(dim) for dim in dataset[_TORQUE].dims)
    return (second, first) if second == "frequency" else (first, second)


def plane(
    panel: "Axes", values: FloatArray, ratios: FloatArray | None, colours: str = "RdBu_r"
) -> None:
    """Draw values over a grid, told in numbers where there is room.

    Parameters
    ----------
    panel : Axes
        Where to.
    values : ndarray, shape (rows, columns)
        From below and from the left.
    ratios : ndarray or None
        What has the same colours, which part at 1; None for values that are no ratios.
    colours : str
        Name of a colour map.
    """
    from matplotlib.colors import Normalize, TwoSlopeNorm

    scaled_by = values if ratios is None else ratios
    finite = scaled_by[np.isfinite(scaled_by)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (1.0, 1.0)
    norm: Normalize = TwoSlopeNorm(1.0, min(low, 0.95), min(max(high, 1.05), 2.0))
    if ratios is None:
        norm = Normalize(low, high)
    image = panel.imshow(values, cmap=colours, norm=norm, origin="lower", aspect="auto")
    if values.size <= _MOST_WORDS:
        for (row, column), value in np.ndenumerate(values):
            # Told by its size, so that no ratio is read by colour alone.
            place = float(norm(value))
            dark = place < 0.5 if ratios is None else abs(place - 0.5) > _DARK
            word = f"{value:.2f}" if np.isfinite(value) else "none"
            panel.annotate(
                word, (column, row), ha="center", va="center", fontsize=8.0,
                color="white" if dark else BLACK,
            )  # fmt: skip
    panel.grid(visible=False)
    figure = panel.get_figure()
    assert figure is not None
    figure.colorbar(image, ax=panel)


def _cross_out(panel: "Axes", which: npt.NDArray[np.bool_]) -> None:
    loose = np.argwhere(which)
    panel.plot(loose[:, 1], loose[:, 0], "x", color=ORANGE, markersize=14, markeredgewidth=2.0)


def ticks(panel: "Axes", dataset: "xr.Dataset", down: str, across: str) -> None:
    """Label the cells of a grid by the values of its axes."""
    for name, axis in ((across, panel.xaxis), (down, panel.yaxis)):
        values = dataset[name].values
        every = -(-values.size // _MOST_TICKS)
        axis.set_ticks(
            range(0, values.size, every), labels=[f"{value:.4g}" for value in values[::every]]
        )
        axis.set_label_text(axis_label(dataset[name]))


def axis_label(axis: "xr.DataArray") -> str:
    """Return the name of an axis with its unit."""
    unit = axis.attrs["units"]
    # Micro is an axis's letter, not a word's.
    shown = "" if unit == "1" else f" ({unit.replace('um', 'µm')})"
    return f"{axis.attrs['long_name']}{shown}"


def resonances(dataset: "xr.Dataset", axis: str) -> list[tuple[str, float]]:
    """Return natural frequencies of worm and wheel within an axis of frequencies, in its unit."""
    if axis != "frequency":
        return []
    try:
        unit = to_si(f"1 {dataset[axis].attrs['units']}", "Hz")
    except InputError:
        return []  # counted by turns of the worm
    low, high = float(dataset[axis].min()), float(dataset[axis].max())
    found = [
        (label, float(dataset[name].mean()) / unit)
        for name, label in _RESONANCES
        if name in dataset
    ]
    return [(label, at) for label, at in found if low <= at <= high]


def _mark_resonances(axes: "list[Axes]", dataset: "xr.Dataset", down: str) -> None:
    """Draw lines at the natural frequencies, between the cells."""
    for label, at in resonances(dataset, down):
        place = np.interp(at, dataset[down].values, np.arange(dataset[down].size))
        for panel in axes:
            panel.axhline(place, color=BLACK, dashes=(4, 2), linewidth=1.2)
            panel.annotate(
                label, (1.0, place), xycoords=("axes fraction", "data"), va="center",
                annotation_clip=False,
            )  # fmt: skip
