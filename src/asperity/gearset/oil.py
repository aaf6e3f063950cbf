r"""Viscosity and density of an oil at temperature, by the formulas of ISO/TR 14521.

Kinematic viscosities are in mm²/s, temperatures in degC, densities in kg/m³. Every function takes
numbers or arrays. With ``on_invalid="mask"`` an array call returns `Masked` instead of raising.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.gearset.arrays import FloatArray, Real, plain, relation
from asperity.sources import Range, Source

FORMULAS = Source("ISO/TR 14521:2010, DIN 3996:2012", "one source")
"""Where the formulas of this module come from."""

TEMPERATURE = Range("oil temperature", -20.0, 150.0, "degC", Source("ASTM D341", "from memory"))
"""Where an oil follows them: above its pour point and before it boils off."""

VISCOSITY = Range("kinematic viscosity", 2.0, 2e7, "mm²/s", Source("ASTM D341", "from memory"))
"""Where the constant 0.7 of the viscosity formula holds."""

COLDEST, HOTTEST = -60.0, 300.0
"""Temperatures in degC beyond which nothing is calculated."""

THINNEST = 0.5
"""Viscosity in mm²/s from below which nothing is calculated."""

TOO_COLD, TOO_HOT, NO_OIL, TOO_THICK = 1, 2, 3, 4

REASONS: Mapping[int, str] = {
    TOO_COLD: f"the oil temperature is below {COLDEST:g} degC",
    TOO_HOT: f"the oil temperature is above {HOTTEST:g} degC",
    NO_OIL: "viscosities must be finite, fall from 40 to 100 degC and be at least "
    f"{THINNEST:g} mm²/s; a density must be positive and its coefficient below 0.01 1/K",
    TOO_THICK: "the viscosity is beyond all bounds at this temperature: the oil is solid",
}
"""The reason codes as sentences."""

_LG_40, _LG_100 = math.log10(313.15), math.log10(373.15)

Invalid = Literal["raise", "mask"]


class Masked(NamedTuple):
    """What an array call returns with ``on_invalid="mask"``.

    Attributes
    ----------
    values : ndarray of float
        The results; NaN where there is none.
    reason : ndarray of int
        0 where there is a result, else its code in `REASONS`.
    legend : mapping of int to str
        `REASONS`.
    """

    values: FloatArray
    reason: npt.NDArray[np.int8]
    legend: Mapping[int, str] = REASONS


def kinematic_viscosity(
    temperature: Real,
    viscosity_40: Real,
    viscosity_100: Real,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Kinematic viscosity at a temperature, :math:`\nu_M`, mm²/s.

    :math:`\lg\lg(\nu + 0.7) = A \lg T + B` with :math:`T` in K through the two given points. The
    standard rounds its constants to :math:`A = -13.129 \lg[\lg(\nu_{40} + 0.7)/\lg(\nu_{100} +
    0.7)]` and :math:`B = \lg\lg(\nu_{40} + 0.7) - 2.496 A`, and so misses the points themselves by
    about 1 %; here they are met exactly.

    Parameters
    ----------
    temperature : float or array
        :math:`\vartheta`, degC; valid in `TEMPERATURE`.
    viscosity_40, viscosity_100 : float or array
        :math:`\nu_{40}`, :math:`\nu_{100}` at 40 and 100 degC, mm²/s; valid in `VISCOSITY`.
    on_invalid : {'raise', 'mask'}
        What an array call does where there is no answer.

    Raises
    ------
    InputError
        A temperature that no oil survives, or viscosities that do not fall.

    Examples
    --------
    >>> round(kinematic_viscosity(60.0, 220.0, 19.0), 2)
    78.82
    """

    def walther(theta: FloatArray, nu_40: FloatArray, nu_100: FloatArray) -> FloatArray:
        w_40 = np.log10(np.log10(nu_40 + 0.7))
        w_100 = np.log10(np.log10(nu_100 + 0.7))
        share = (np.log10(theta + 273.15) - _LG_40) / (_LG_100 - _LG_40)
        nu: FloatArray = 10.0 ** (10.0 ** (w_40 + (w_100 - w_40) * share)) - 0.7
        return nu

    def oil(theta: FloatArray, nu_40: FloatArray, nu_100: FloatArray) -> npt.NDArray[np.bool_]:
        return (nu_100 >= THINNEST) & (nu_40 > nu_100) & (nu_40 <= VISCOSITY.upper)

    return _evaluate(walther, oil, on_invalid, temperature, viscosity_40, viscosity_100)


def density(
    temperature: Real, density_15: Real, density_coefficient: Real, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Density at a temperature, :math:`\rho_M = \rho_{15}/[1 + k_\rho (\vartheta - 15)]`, kg/m³.

    Parameters
    ----------
    temperature : float or array
        :math:`\vartheta`, degC; valid in `TEMPERATURE`.
    density_15 : float or array
        :math:`\rho_{15}` at 15 degC, kg/m³.
    density_coefficient : float or array
        :math:`k_\rho`, 1/K.
    on_invalid : {'raise', 'mask'}
        What an array call does where there is no answer.

    Examples
    --------
    >>> round(density(60.0, 890.0, 7e-4), 2)
    862.82
    """

    def expanded(theta: FloatArray, rho: FloatArray, k: FloatArray) -> FloatArray:
        return rho / (1.0 + k * (theta - 15.0))

    def oil(theta: FloatArray, rho: FloatArray, k: FloatArray) -> npt.NDArray[np.bool_]:
        return (rho > 0.0) & np.isfinite(rho) & (k >= 0.0) & (k < 0.01)

    return _evaluate(expanded, oil, on_invalid, temperature, density_15, density_coefficient)


@relation
def dynamic_viscosity(kinematic_viscosity: Real, density: Real) -> Any:
    r"""Dynamic viscosity, :math:`\eta_{0M} = \nu_M \rho_M`, Pa s, from mm²/s and kg/m³.

    Examples
    --------
    >>> round(dynamic_viscosity(100.0, 890.0), 12)
    0.089
    """
    return kinematic_viscosity * density * 1e-6


def _evaluate(
    formula: Callable[..., FloatArray],
    oil: Callable[..., npt.NDArray[np.bool_]],
    on_invalid: Invalid,
    *given: Real,
) -> Any:
    if on_invalid not in ("raise", "mask"):
        raise InputError(f"on_invalid is {on_invalid!r}; it must be 'raise' or 'mask'")
    try:
        arrays = np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in given))
    except (TypeError, ValueError):
        raise InputError(
            f"{', '.join(str(value)[:40] for value in given)} are not numbers, or arrays of one "
            "shape; make them so"
        ) from None
    reason = np.select(
        [~oil(*arrays), ~(arrays[0] >= COLDEST), ~(arrays[0] <= HOTTEST)],
        [NO_OIL, TOO_COLD, TOO_HOT],
        0,
    )
    reason = np.asarray(reason, dtype=np.int8)
    valid = reason == 0
    values = np.full(reason.shape, np.nan)
    with np.errstate(over="ignore"):
        values[valid] = formula(*(array[valid] for array in arrays))
    reason[valid & ~np.isfinite(values)] = TOO_THICK
    values[reason > 0] = np.nan
    if on_invalid == "mask" and reason.ndim > 0:
        return Masked(values, reason)
    if reason.any():
        raise InputError(REASONS[int(reason[reason > 0].flat[0])])
    return plain(values)
