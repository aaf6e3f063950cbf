"""ISO/TR 14521: how much the wheel's flanks wear, and the safety against it."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.gearset.materials import BaseOilName, Family
from asperity.rating.formula import Argument, Invalid, angle, evaluate, positive
from asperity.rating.iso14521.tables import Lubrication, check_words, wear_constants

_IRON = ("grey iron", "nodular iron")


def lubricant_structure_factor(
    dynamic_viscosity: npt.ArrayLike,
    *,
    family: Family = "tin bronze",
    base_oil: BaseOilName = "mineral",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Lubricant structure factor.

    .. math:: W_S = 1 \text{ (mineral; polyalphaolefin on iron)}, \qquad
        W_S = \eta_{0M}^{-0.35} \text{ (other)}

    Parameters
    ----------
    dynamic_viscosity : array_like
        :math:`\eta_{0M}` of the oil at the wheel's temperature, Pa s.
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron'}
        Of the wheel's material.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'}
        Of the lubricant.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`W_S`.

    Notes
    -----
    One source.

    Examples
    --------
    >>> round(lubricant_structure_factor(0.05, base_oil="polyglycol"), 3)
    2.853
    """
    check_words(family=family, base_oil=base_oil)
    constant = base_oil == "mineral" or (base_oil == "polyalphaolefin" and family in _IRON)
    return evaluate(
        lambda eta: np.ones_like(eta) if constant else eta**-0.35,
        positive("dynamic_viscosity", dynamic_viscosity, "Pa s"),
        on_invalid=on_invalid,
    )


def pressure_factor(
    contact_stress: npt.ArrayLike,
    *,
    family: Family = "tin bronze",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Pressure factor of wear.

    .. math:: W_H = \min\left(1, (450/\sigma_{Hm})^{4.5}\right) \text{ (bronze)}, \qquad
        W_H = (300/\sigma_{Hm})^{1.4} \text{ (iron)}

    Parameters
    ----------
    contact_stress : array_like
        :math:`\sigma_{Hm}`, MPa.
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron'}
        Of the wheel's material.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`W_H`; bends at 450 MPa and does not jump.

    Notes
    -----
    One source.

    Examples
    --------
    >>> pressure_factor(300.0), pressure_factor(300.0, family="grey iron")
    (1.0, 1.0)
    """
    check_words(family=family)
    iron = family in _IRON
    return evaluate(
        lambda s: (300.0 / s) ** 1.4 if iron else np.minimum(1.0, (450.0 / s) ** 4.5),
        positive("contact_stress", contact_stress, "MPa"),
        on_invalid=on_invalid,
    )


def wear_parameter(
    film_thickness: npt.ArrayLike,
    lubricant_structure_factor: npt.ArrayLike,
    pressure_factor: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Film thickness that counts for wear.

    .. math:: K_W = h_{min,m}\, W_S\, W_H

    Parameters
    ----------
    film_thickness : array_like
        :math:`h_{min,m}`, um.
    lubricant_structure_factor, pressure_factor : array_like
        :math:`W_S`, :math:`W_H`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        um.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda h, ws, wh: h * ws * wh,
        positive("film_thickness", film_thickness, "um"),
        positive("lubricant_structure_factor", lubricant_structure_factor),
        positive("pressure_factor", pressure_factor),
        on_invalid=on_invalid,
    )


def reference_wear_intensity(
    wear_parameter: npt.ArrayLike,
    *,
    family: Family = "tin bronze",
    lubrication: Lubrication = "bath",
    base_oil: BaseOilName = "mineral",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Wear intensity of the standard's reference gearset.

    .. math:: J_{0T} = \min(A\, K_W^{-n},\ J_{max})

    Parameters
    ----------
    wear_parameter : array_like
        :math:`K_W`, um.
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron'}
        Of the wheel's material.
    lubrication : {'bath', 'spray'}
        Makes a difference for tin bronze only.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'}
        Of the lubricant.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`J_{0T}`, depth worn for each length slid.

    Notes
    -----
    One source. The constants stand in ``rating/data/iso14521.toml``; mineral oils have a cap, and
    so has polyalphaolefin on aluminium bronze.

    Examples
    --------
    >>> reference_wear_intensity(1.0)
    6.5e-11
    """
    law = wear_constants(family, lubrication, base_oil)
    return evaluate(
        lambda k: np.minimum(law.scale * k**-law.exponent, law.cap),
        positive("wear_parameter", wear_parameter, "um"),
        on_invalid=on_invalid,
    )


def start_factor(starts_per_hour: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Start factor of wear.

    .. math:: W_{NS} = \min(1 + 0.015\, N_S,\ 4)

    Parameters
    ----------
    starts_per_hour : array_like
        :math:`N_S`, 1/h.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`W_{NS}`.

    Notes
    -----
    One source.

    Examples
    --------
    >>> start_factor(100.0)
    2.5
    """
    return evaluate(
        lambda n: np.minimum(1.0 + 0.015 * n, 4.0),
        Argument("starts_per_hour", starts_per_hour, "1/h", 0.0),
        on_invalid=on_invalid,
    )


def wear_intensity(
    reference_wear_intensity: npt.ArrayLike,
    start_factor: npt.ArrayLike,
    wear_factor: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Wear intensity.

    .. math:: J_W = J_{0T}\, W_{NS}\, W_{ML}

    Parameters
    ----------
    reference_wear_intensity, start_factor : array_like
        :math:`J_{0T}`, :math:`W_{NS}`.
    wear_factor : array_like
        :math:`W_{ML}` of the wheel's material with the base oil.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`J_W`.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda j, ns, ml: j * ns * ml,
        positive("reference_wear_intensity", reference_wear_intensity),
        positive("start_factor", start_factor),
        positive("wear_factor", wear_factor),
        on_invalid=on_invalid,
    )


def flank_wear(
    wear_intensity: npt.ArrayLike, sliding_path: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Depth worn off the wheel's flanks, in the normal section.

    .. math:: \delta_{Wn} = J_W\, s_{Wm}

    Parameters
    ----------
    wear_intensity : array_like
        :math:`J_W`.
    sliding_path : array_like
        :math:`s_{Wm}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.

    Examples
    --------
    >>> flank_wear(1e-9, 2e8)
    0.2
    """
    return evaluate(
        lambda intensity, path: intensity * path,
        positive("wear_intensity", wear_intensity),
        positive("sliding_path", sliding_path, "mm"),
        on_invalid=on_invalid,
    )


def wear_limit(
    axial_module: npt.ArrayLike, lead_angle: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Depth that may be worn off, where nothing else is asked for.

    .. math:: \delta_{Wlim,n} = 0.3\, m_{x1}\cos\gamma_{m1}

    Parameters
    ----------
    axial_module : array_like
        :math:`m_{x1}`, mm.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda m, lead: 0.3 * m * np.cos(lead),
        positive("axial_module", axial_module, "mm"),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
    )
