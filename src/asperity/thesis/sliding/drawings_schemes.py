"""Pictures of an increment of the schemes, drawn from their datasets alone."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.figures import BLACK, BLUE, COLOURS, panels

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ARC = 0.14
_SIZES = ("s", "s'", "s₁")
_BODIES, _ROOTS = ("N'", "N'₁"), ("M", "M'¹", "M'²", "M₁")
_BESIDE_ROOTS = ((-16, -4), (-26, -6), (-26, 2), (6, 4))


def increment(dataset: "xr.Dataset") -> "Figure":
    """Draw body and root of an asperity through the two phases, the base moving."""
    figure, (axes,) = panels(1, 1, width=6.4, height=5.0)
    body, root = dataset["body"].values, dataset["root"].values
    base = dataset["base"].values
    stretched = ((root[0], body[0]), (root[1], body[1]), (root[3], body[1]))
    for n, (one, other) in enumerate(stretched):
        axes.plot(*zip(one, other, strict=True), color=COLOURS[n], linewidth=2.0)
    axes.plot(*body.T, "o-", color=BLACK, linewidth=0.9, markersize=4)
    axes.plot(*root.T, "s:", color=BLACK, linewidth=0.9, markersize=4)
    for at, name, beside in zip(body, _BODIES, ((-14, -14), (8, -8)), strict=True):
        axes.annotate(name, at, beside, textcoords="offset points")
    for at, name, beside in zip(root, _ROOTS, _BESIDE_ROOTS, strict=True):
        axes.annotate(name, at, beside, textcoords="offset points")
    if base[0]:
        own = body[0] + dataset["own"].values
        axes.plot(*zip(body[0], own, strict=True), color=BLACK, linewidth=0.9, dashes=(5, 2))
        _arrow(axes, own, body[1], "$-Δx_b$", (-8, -16))
    sizes, shifts = dataset["deflection"].values, ((-64, -14), (-12, 14), (6, 8))
    for (one, other), name, size, shift in zip(stretched, _SIZES, sizes, shifts, strict=True):
        axes.annotate(
            f"{name} = {size:.2f}", 0.5 * (one + other), shift, textcoords="offset points"
        )
    for at, angle, name, n in zip((body[1], body[1]), dataset["angle"].values, "αβ", (1, 2),
                                  strict=True):  # fmt: skip
        turn = np.linspace(0.0, angle, 30)
        size = _ARC * n
        arc = at[:, None] + size * np.array([-np.cos(turn), np.sin(turn)])
        axes.plot(*arc, color=COLOURS[n], linewidth=1.2)
        axes.annotate(name, arc[:, 12], (-12, -2), textcoords="offset points", color=COLOURS[n])
    axes.plot([body[1][0] - 2.6 * _ARC, body[1][0]], [body[1][1]] * 2, color=BLACK, linewidth=0.6)
    edge = np.array([body[1][0] + 0.12, root[1][1]])
    _arrow(axes, edge, edge + np.array([0.0, base[1]]), "EF = Δy$_b$ of the base")
    axes.set_aspect("equal")
    axes.set(xlabel="along x, over $s_{max}$", ylabel="across y, over $s_{max}$")
    axes.margins(0.16)
    return figure


def _arrow(
    axes: "Axes", start: Any, end: Any, name: str, beside: tuple[float, float] = (5.0, 4.0)
) -> None:
    axes.annotate(
        "", end, start, arrowprops={"arrowstyle": "->", "color": BLUE, "shrinkA": 0, "shrinkB": 0}
    )
    axes.annotate(name, 0.5 * (np.asarray(start) + end), beside, textcoords="offset points",
                  color=BLUE)  # fmt: skip
    axes.update_datalim([start, end])


def base(dataset: "xr.Dataset") -> "Figure":
    """Draw the displacement along the axis of vibration and its two components."""
    figure, (axes,) = panels(1, 1, width=5.4, height=4.4)
    theta, share = float(dataset["theta"]), float(dataset["share"])
    way = np.array([np.cos(theta), np.sin(theta)])
    axes.plot(*np.transpose([-way, way]), color=BLACK, dashes=(1, 1.5), linewidth=1.0)
    at = share * way
    vectors: tuple[tuple[Any, str, tuple[int, int], str], ...] = (
        (at, "u", (-16, 4), COLOURS[0]),
        (np.array([at[0], 0.0]), "$x_b$", (-20, -16), COLOURS[1]),
        (np.array([0.0, at[1]]), "$y_b$", (-22, -12), COLOURS[2]),
    )
    for end, name, beside, colour in vectors:
        axes.annotate(
            "", end, (0.0, 0.0),
            arrowprops={"arrowstyle": "-|>", "color": colour, "linewidth": 1.8, "shrinkB": 0},
        )  # fmt: skip
        axes.annotate(name, end, beside, textcoords="offset points", color=colour)
    for end in (np.array([at[0], 0.0]), np.array([0.0, at[1]])):
        axes.plot(*np.transpose([at, end]), color=BLACK, linewidth=0.6)
    turn = np.linspace(0.0, theta, 40)
    axes.plot(0.25 * np.cos(turn), 0.25 * np.sin(turn), color=BLACK, linewidth=1.0)
    axes.annotate("θ", (0.25, 0.0), (4, 8), textcoords="offset points")
    axes.set_aspect("equal")
    axes.set(
        xlabel="along the drive, over $u_a$", ylabel="across it, over $u_a$",
        xlim=(-1.0, 1.0), ylim=(-0.75, 0.75),
    )  # fmt: skip
    return figure
