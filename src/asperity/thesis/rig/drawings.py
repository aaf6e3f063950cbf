"""The pictures of chapter 6, each drawn from its dataset alone."""

from typing import TYPE_CHECKING

from asperity.results.panels import Panel, drawn, line, points

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_LOAD = r"normal load $F_N$ (N)"


def speeds(dataset: "xr.Dataset") -> "Figure":
    """Draw speeds above and currents below, over the load."""
    load = dataset["load"].values
    shown = []
    for suffix, label in (("", "speed (rpm)"), ("_current", "current (A)")):
        marks = []
        for index, disc in enumerate(("steel", "bronze")):
            values = dataset[f"{disc}{suffix}"].values
            marks += [line(index, load, values), points(index, load, values, f"{disc} disc")]
        shown.append(Panel(_LOAD, label, marks, legend={}, tight=False))
    return drawn(shown, height=6.0)


def sliding(dataset: "xr.Dataset") -> "Figure":
    """Draw velocities above and the slide-roll ratio below, with what is printed."""
    load = dataset["load"].values
    velocities, printed = [], dataset["printed_ratio"].values
    for index, name in enumerate(("sliding", "rolling")):
        there = 1e3 * dataset[f"printed_{name}"].values
        velocities += [
            line(index, load, 1e3 * dataset[name].values, f"{name} velocity"),
            points(index, load, there, marker="x"),
        ]
    ratios = [
        line(2, load, dataset["ratio"].values),
        points(2, load, printed, "printed", marker="x"),
    ]
    return drawn(
        [
            Panel(_LOAD, "velocity (mm/s)", velocities, legend={}, tight=False),
            Panel(_LOAD, "slide-roll ratio R", ratios, legend={}, tight=False),
        ],
        height=6.0,
    )


def waveforms(dataset: "xr.Dataset") -> "Figure":
    """Draw displacement above and velocity below, over two periods."""
    time, names = 1e3 * dataset["time"].values, [str(one) for one in dataset["waveform"].values]
    above, below = (
        [line(n, time, scale * dataset[what].sel(waveform=one).values, one * (what != "velocity"))
         for n, one in enumerate(names)]
        for what, scale in (("displacement", 1e6), ("velocity", 1e3))
    )  # fmt: skip
    return drawn(
        [
            Panel("", "displacement (µm)", above, legend={"loc": "upper right"}),
            Panel("time (ms)", "velocity (mm/s)", below),
        ],
        height=5.6,
    )
