"""ISO/TR 14521: temperature of the oil sump and of the wheel."""

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.gearset.materials import BaseOilName
from asperity.rating.formula import Argument, FloatArray, Invalid, evaluate, positive
from asperity.rating.iso14521.tables import check_words

Immersed = Literal["worm", "wheel"]

_OIL_CONSTANT = {"mineral": 9.0, "polyalphaolefin": 5.0, "polyglycol": 0.0}


def sump_temperature(
    wheel_torque: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    ratio: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    viscosity_40: npt.ArrayLike,
    ambient_temperature: npt.ArrayLike = 20.0,
    *,
    base_oil: BaseOilName = "mineral",
    fan: bool = False,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Temperature of the oil sump of a cast-iron housing with splash lubrication.

    .. math:: \vartheta_S = \vartheta_0 + \left(\frac{c_1 T_2}{(a/63)^3} + c_0\right) c_2

    without a fan

    .. math::
        c_0 &= 0.0523\left(\frac{n_1}{60} + 0.28\right)^{0.68}
        \left|\frac{\nu_{40}}{100} - 2.203\right|^{0.0237} (a + 22.36)^{0.915} \\
        c_1 &= 0.034\left(\frac{n_1}{60} + 0.22\right)^{0.43}
        \left(10.8 - \frac{\nu_{40}}{100}\right)^{-0.0636} u^{-0.18} (a - 20.4)^{0.26}

    with a fan

    .. math::
        c_0 &= 0.081\left(\frac{n_1}{60} - 0.23\right)^{0.7}
        \left(\frac{\nu_{40}}{100}\right)^{0.41} (a + 32)^{0.63} \\
        c_1 &= 0.039\left(\frac{n_1}{60} + 2\right)^{0.34}
        \left(\frac{\nu_{40}}{100}\right)^{-0.17} u^{-0.22} (a - 48)^{0.34}

    and

    .. math:: c_2 = 1 - \frac{k}{(0.012 u + 0.092)\sqrt{n_1} - 0.745 u + 82.877}, \quad
        k = 9 \text{ (mineral)},\ 5 \text{ (polyalphaolefin)},\ 0 \text{ (polyglycol)}

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    worm_speed : array_like
        :math:`n_1`, rpm; with a fan above 13.8.
    ratio : array_like
        :math:`u`.
    centre_distance : array_like
        :math:`a`, mm; above 20.4, with a fan above 48.
    viscosity_40 : array_like
        :math:`\nu_{40}`, mm2/s; below 1080.
    ambient_temperature : array_like
        :math:`\vartheta_0`, degC.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'}
        Of the lubricant.
    fan : bool
        Whether a fan sits on the worm's shaft.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where :math:`c_2` is not above
        zero (very large ratios).

    Returns
    -------
    float, ndarray or Masked
        degC.

    Notes
    -----
    One source; the sign in a + 32 and the range (a 63 to 400 mm, :math:`n_1` 60 to 3000 rpm, u 10
    to 40) from memory. Without a fan the printed :math:`c_0` drops to zero in a sharp dip at
    :math:`\nu_{40}` = 220.3 mm2/s.
    """
    check_words(base_oil=base_oil)
    heat = _fan if fan else _no_fan
    return evaluate(
        lambda t, n, u, a, nu, ambient: (
            ambient + heat(t, n, u, a, nu) * _oil_factor(n, u, base_oil)
        ),
        Argument("wheel_torque", wheel_torque, "N m", 0.0),
        Argument("worm_speed", worm_speed, "rpm", 13.8 if fan else 0.0, above=fan),
        positive("ratio", ratio),
        Argument("centre_distance", centre_distance, "mm", 48.0 if fan else 20.4, above=True),
        Argument("viscosity_40", viscosity_40, "mm2/s", 0.0, 1079.0, above=True),
        Argument("ambient_temperature", ambient_temperature, "degC", -100.0, 300.0),
        on_invalid=on_invalid,
        result="theta_S",
        because="c_2 is not above zero at this ratio and speed; lower the ratio",
    )


def heat_transfer_coefficient(
    worm_speed: npt.ArrayLike, *, immersed: Immersed = "worm", on_invalid: Invalid = "raise"
) -> Any:
    r"""Heat transfer from the wheel to the oil.

    .. math:: \alpha_L = c_k (1940 + 15\, n_1), \text{ at least } 4190\, c_k

    Parameters
    ----------
    worm_speed : array_like
        :math:`n_1`, rpm.
    immersed : {'worm', 'wheel'}
        What dips into the oil: :math:`c_k` is 1 for the worm and 0.8 for the wheel.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W/(m2 K); bends at 150 rpm and does not jump.

    Notes
    -----
    One source.

    Examples
    --------
    >>> heat_transfer_coefficient(1000.0)
    16940.0
    """
    check_words(immersed=immersed)
    share = 1.0 if immersed == "worm" else 0.8
    return evaluate(
        lambda n: share * np.maximum(1940.0 + 15.0 * n, 4190.0),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        on_invalid=on_invalid,
    )


def cooling_area(
    rim_width: npt.ArrayLike, wheel_pitch_diameter: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Surface over which the wheel gives its heat to the oil.

    .. math:: A_R = b_{2R}\, d_{m2}\, 10^{-6}

    Parameters
    ----------
    rim_width, wheel_pitch_diameter : array_like
        :math:`b_{2R}`, :math:`d_{m2}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        m2.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda b, d: b * d * 1e-6,
        positive("rim_width", rim_width, "mm"),
        positive("wheel_pitch_diameter", wheel_pitch_diameter, "mm"),
        on_invalid=on_invalid,
    )


def bulk_temperature(
    sump_temperature: npt.ArrayLike,
    meshing_loss: npt.ArrayLike,
    heat_transfer_coefficient: npt.ArrayLike,
    cooling_area: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Temperature of the wheel's teeth under splash lubrication.

    .. math:: \vartheta_M = \vartheta_S + \frac{P_{Vz}}{\alpha_L A_R}

    Parameters
    ----------
    sump_temperature : array_like
        :math:`\vartheta_S`, degC.
    meshing_loss : array_like
        :math:`P_{Vz}`, W.
    heat_transfer_coefficient : array_like
        :math:`\alpha_L`, W/(m2 K).
    cooling_area : array_like
        :math:`A_R`, m2.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        degC.

    Notes
    -----
    One source.

    Examples
    --------
    >>> bulk_temperature(60.0, 500.0, 20000.0, 0.0025)
    70.0
    """
    return evaluate(
        lambda theta, loss, alpha, area: theta + loss / (alpha * area),
        Argument("sump_temperature", sump_temperature, "degC", -273.15),
        Argument("meshing_loss", meshing_loss, "W", 0.0),
        positive("heat_transfer_coefficient", heat_transfer_coefficient, "W/(m2 K)"),
        positive("cooling_area", cooling_area, "m2"),
        on_invalid=on_invalid,
    )


def _fan(t: FloatArray, n: FloatArray, u: FloatArray, a: FloatArray, nu: FloatArray) -> FloatArray:
    turns, thick = n / 60.0, nu / 100.0
    idle = 0.081 * (turns - 0.23) ** 0.7 * thick**0.41 * (a + 32.0) ** 0.63
    load = 0.039 * (turns + 2.0) ** 0.34 * thick**-0.17 * u**-0.22 * (a - 48.0) ** 0.34
    return np.asarray(load * t / (a / 63.0) ** 3 + idle)


def _no_fan(
    t: FloatArray, n: FloatArray, u: FloatArray, a: FloatArray, nu: FloatArray
) -> FloatArray:
    turns, thick = n / 60.0, nu / 100.0
    idle = 0.0523 * (turns + 0.28) ** 0.68 * np.abs(thick - 2.203) ** 0.0237 * (a + 22.36) ** 0.915
    load = 0.034 * (turns + 0.22) ** 0.43 * (10.8 - thick) ** -0.0636
    return np.asarray(load * u**-0.18 * (a - 20.4) ** 0.26 * t / (a / 63.0) ** 3 + idle)


def _oil_factor(n: FloatArray, u: FloatArray, base_oil: BaseOilName) -> FloatArray:
    below = (0.012 * u + 0.092) * np.sqrt(n) - 0.745 * u + 82.877
    return np.where(below > _OIL_CONSTANT[base_oil], 1.0 - _OIL_CONSTANT[base_oil] / below, np.nan)
