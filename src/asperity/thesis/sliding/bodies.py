"""Sliding bodies and sweeps of them."""

import dataclasses
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider import TABLES, Model, SlideResult, solve
from asperity.slider.history import History
from asperity.sweep import read_grid, run
from asperity.thesis.cases import Shipped

RATIO = "vibration.velocity_ratio"
DIRECTION = "vibration.direction"
PERIODIC = "solve.method=periodic"
TWO_PHASE = "solve.scheme=two-phase"


class Body(Shipped):
    """A sliding body."""

    verb = "slide"
    known = TABLES

    @cached_property
    def result(self) -> SlideResult:
        """What it comes to, with its history."""
        return solve(Model.from_case(self.read()))

    @property
    def model(self) -> Model:
        """What is solved."""
        return self.result.model

    @property
    def history(self) -> History:
        """Its motion and forces over time."""
        if self.result.history is None:
            raise ValueError("solved without a history")
        return self.result.history


@dataclasses.dataclass(frozen=True)
class Sweep:
    """A sliding body over axes.

    Parameters
    ----------
    case : str
        Name of the shipped case.
    axes : tuple of (str, str)
        ``("vibration.direction", "0:360:15")``: key and values, angles in degrees.
    settings : tuple of str
        For every point.
    """

    case: str
    axes: tuple[tuple[str, str], ...]
    settings: tuple[str, ...] = ()

    @property
    def _over(self) -> tuple[str, ...]:
        return tuple(f"{key}={text}" for key, text in self.axes)

    def values(self, axis: int = 0) -> FloatArray:
        """Values along an axis as written."""
        _, axes = read_grid(self.case, TABLES, self.settings, self._over)
        return np.array(axes[axis].shown, dtype=np.float64)

    def ratios(self) -> FloatArray:
        """Drive force over mu F_N at every point, one dimension for each axis."""
        grid = read_grid(self.case, TABLES, self.settings, self._over)
        # What is shown of the whole tells how far it is.
        found = run(*grid, notify=lambda line: None)
        if found.failure is not None:
            raise found.failure
        return found.arrays["ratio"]

    def command(self) -> str:
        """The same on the command line."""
        return Shipped(self.case, self.settings).command("sweep", over=self._over)
