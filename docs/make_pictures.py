"""Draw the pictures of the README and of the theory anew: ``python docs/make_pictures.py``."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from asperity.friction.dahl import VECTOR
from asperity.friction.loaded import STIFFNESS, advance_loaded
from asperity.slider.closed_forms import master_curve, master_curve_approximated, normal_ratio
from asperity.slider.plots_normal import plot_master_curve
from asperity.store import write_atomically
from asperity.thesis.contents import FIGURES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PICTURES = Path(__file__).parent / "_static"
SWINGS = (0.1, 0.5, 0.9)
STEPS = 1000


def dragged(velocity: float, swing: float) -> float:
    """Mean friction over mu N_0 of a spring under a swinging load, the second of two cycles."""
    loads = 1.0 + swing * np.cos(2.0 * np.pi / STEPS * np.arange(2 * STEPS + 1))
    way = 2.0 * np.pi / STEPS * swing * velocity
    deflection, friction = loads[0], np.zeros(2 * STEPS)
    for step in range(2 * STEPS):
        deflection, _, friction[step], _ = advance_loaded(
            deflection, 0.0, way, 0.0, 0.0, 0.0, loads[step], loads[step + 1], 0.0, VECTOR,
            STIFFNESS,
        )  # fmt: skip
    return float(friction[STEPS:].mean())


def one_curve() -> "Figure":
    """Sliding under normal vibration: three swings, one master curve."""
    velocity = np.linspace(0.0, 1.2, 241)
    at = np.linspace(0.05, 1.15, 12)
    return plot_master_curve(
        velocity,
        {a: normal_ratio(velocity, a, "flat") for a in SWINGS},
        master_curve(velocity),
        master_curve_approximated(velocity),
        {a: (at, np.array([dragged(v, a) for v in at])) for a in SWINGS},
    )


if __name__ == "__main__":
    drawn = {"directions": FIGURES["4.23"].make().figure, "master_curve": one_curve()}
    for name, figure in drawn.items():
        write_atomically(
            PICTURES / f"{name}.png", lambda path, figure=figure: figure.savefig(path, dpi=150)
        )
