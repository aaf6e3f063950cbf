"""Picture of a fit: measured against predicted, and the residuals."""

from typing import TYPE_CHECKING

from asperity.results.figures import BLACK, BLUE, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def plot_fit(dataset: "xr.Dataset") -> "Figure":
    """Draw the measurements over what the law says of them, and below what is left."""
    figure, (upper, lower) = panels(2, height=6.4)
    predicted, measured = dataset["predicted"].values, dataset["measured"].values
    upper.errorbar(
        predicted, measured, 1.96 * dataset["deviation"].values, color=BLUE, marker="o",
        linestyle="none", markerfacecolor="none", capsize=2,
    )  # fmt: skip
    ends = [min(predicted.min(), measured.min()), max(predicted.max(), measured.max())]
    upper.plot(ends, ends, color=BLACK, linewidth=1.0, dashes=(4, 2))
    upper.set(xlabel="by the law", ylabel="measured, with 95 %")
    lower.axhline(0.0, color=BLACK, linewidth=0.8)
    for limit in (-1.96, 1.96):
        lower.axhline(limit, color=BLACK, linewidth=0.8, dashes=(1, 2))
    lower.plot(
        predicted, dataset["residuals"].values, color=BLUE, marker="o", linestyle="none",
        markerfacecolor="none",
    )  # fmt: skip
    lower.set(xlabel="by the law", ylabel="residual over its deviation")
    return figure
