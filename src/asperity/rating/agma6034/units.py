"""The inch units AGMA's formulas are written in, and what takes their place in SI."""

import dataclasses
import math
from typing import Literal

import numpy.typing as npt

from asperity.errors import InputError
from asperity.rating.formula import Argument

Units = Literal["si", "inch"]

_POUND_FORCE = 0.45359237 * 9.80665
_INCH = 0.0254
_FOOT = 12.0 * _INCH
_MINUTE = 60.0
_FAHRENHEIT = 5.0 / 9.0


@dataclasses.dataclass(frozen=True)
class Kind:
    """A kind of quantity.

    Parameters
    ----------
    si, inch : str
        Its units.
    size : float
        The inch unit in SI units.
    """

    si: str
    inch: str
    size: float

    def argument(
        self,
        name: str,
        value: npt.ArrayLike,
        units: Units,
        *,
        lower: float = 0.0,
        upper: float = math.inf,
        above: bool = True,
        because: str = "",
    ) -> Argument:
        """Return an argument that reaches the formula in the inch unit; so are the bounds."""
        size = self.size if _is_si(units) else 1.0
        unit = self.si if _is_si(units) else self.inch
        return Argument(
            name, value, unit, lower * size, upper * size, above, because, scale=1.0 / size
        )

    def scale(self, units: Units) -> float:
        """Return what turns a result in the inch unit into these units."""
        return self.size if _is_si(units) else 1.0


def _is_si(units: Units) -> bool:
    if units not in ("si", "inch"):
        raise InputError(f"units is {units!r}; it must be 'si' or 'inch'")
    return units == "si"


LENGTH = Kind("mm", "in", 1e3 * _INCH)
AREA = Kind("m2", "in2", _INCH**2)
VELOCITY = Kind("m/s", "ft/min", _FOOT / _MINUTE)
FORCE = Kind("N", "lbf", _POUND_FORCE)
TORQUE = Kind("N m", "lbf in", _POUND_FORCE * _INCH)
STRESS = Kind("MPa", "psi", 1e-6 * _POUND_FORCE / _INCH**2)
POWER = Kind("W", "hp", 550.0 * _FOOT * _POUND_FORCE)
TEMPERATURE_RISE = Kind("K", "degF", _FAHRENHEIT)
HEAT_TRANSFER = Kind(
    "W/(m2 K)",
    "ft lbf/(min in2 degF)",
    _FOOT * _POUND_FORCE / (_MINUTE * _INCH**2 * _FAHRENHEIT),
)
