"""Cases and sweeps of cases that know the command that solves them."""

import dataclasses
import itertools
import shlex

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import read_case
from asperity.errors import AsperityError
from asperity.slider import TABLES, Model, SlideResult, solve, solve_many

PERIODIC = "solve.method=periodic"
TWO_PHASE = "solve.scheme=two-phase"


@dataclasses.dataclass(frozen=True)
class Body:
    """A shipped case with settings."""

    case: str
    settings: tuple[str, ...] = ()

    def solve(self) -> SlideResult:
        """Solve it, with its history."""
        return solve(Model.from_case(read_case(self.case, TABLES, self.settings)))

    @property
    def command(self) -> str:
        """The same on the command line."""
        return _command("slide", self.case, self.settings)


@dataclasses.dataclass(frozen=True)
class Sweep:
    """A shipped case with settings, over axes written as on the command line.

    Parameters
    ----------
    case : str
        Name of the case.
    axes : tuple of (str, str)
        ``("vibration.direction", "0:360:15")``: key and values, angles in degrees. Lists
        ``1,2,3``, ranges ``start:stop:step`` with the stop included.
    settings : tuple of str
        ``table.key=value`` for every point.
    """

    case: str
    axes: tuple[tuple[str, str], ...]
    settings: tuple[str, ...] = ()

    def values(self, axis: int = 0) -> FloatArray:
        """Values along an axis as written, angles in degrees."""
        text = self.axes[axis][1]
        if ":" not in text:
            return np.array([float(part) for part in text.split(",")])
        start, stop, step = (float(part) for part in text.split(":"))
        steps = np.arange(round((stop - start) / step) + 1, dtype=np.float64)
        # Without the last bits, so that 0.1:20:0.1 holds 20.
        return np.round(start + step * steps, 12)

    def models(self) -> list[Model]:
        """Every point's model, the last axis running fastest."""
        case = read_case(self.case, TABLES, self.settings)
        keys = [key for key, _ in self.axes]
        grids = []
        for axis, key in enumerate(keys):
            values = self.values(axis)
            grids.append(np.deg2rad(values) if key == "vibration.direction" else values)
        return [
            Model.from_case(case.replace_values(dict(zip(keys, map(float, point), strict=True))))
            for point in itertools.product(*grids)
        ]

    def ratios(self) -> FloatArray:
        """Drive force over mu F_N at every point, one dimension for each axis."""
        shape = [self.values(axis).size for axis in range(len(self.axes))]
        ratios = []
        for answer in solve_many(self.models()):
            if isinstance(answer, AsperityError):
                raise answer
            ratios.append(answer.ratio)
        return np.array(ratios).reshape(shape)

    @property
    def command(self) -> str:
        """The same on the command line."""
        over = " ".join(f"--over {shlex.quote(f'{key}={text}')}" for key, text in self.axes)
        return _command("sweep", self.case, self.settings, over)


def _command(verb: str, case: str, settings: tuple[str, ...], over: str = "") -> str:
    words = ["asperity", verb, case, *([over] if over else [])]
    return " ".join(words + [f"--set {shlex.quote(setting)}" for setting in settings])
