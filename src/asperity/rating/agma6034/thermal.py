"""Power and heat by AGMA 6034-B92."""

from typing import Any

import numpy.typing as npt

from asperity.rating.agma6034.units import (
    AREA,
    FORCE,
    HEAT_TRANSFER,
    LENGTH,
    POWER,
    TEMPERATURE_RISE,
    VELOCITY,
    Units,
)
from asperity.rating.formula import Argument, Invalid, evaluate, positive


def friction_power(
    sliding_velocity: npt.ArrayLike,
    friction_force: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power lost in the mesh.

    .. math:: H_f = \frac{V_s W_f}{33000} \qquad \text{hp, ft/min, lbf}

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`V_s`, m/s [ft/min].
    friction_force : array_like
        :math:`W_f`, N [lbf], see `friction_force`.
    units : {'si', 'inch'}
        The units of arguments and result; the second in brackets.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W [hp].

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    return evaluate(
        lambda v, w: v * w / 33000.0,
        VELOCITY.argument("sliding_velocity", sliding_velocity, units, above=False),
        FORCE.argument("friction_force", friction_force, units, above=False),
        on_invalid=on_invalid,
        scale=POWER.scale(units),
    )


def output_power(
    worm_speed: npt.ArrayLike,
    tangential_load: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    gear_ratio: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power of the wheel.

    .. math:: H_o = \frac{n_W W_t D}{126000\, m_G} \qquad \text{hp, rpm, lbf, in}

    Parameters
    ----------
    worm_speed : array_like
        :math:`n_W`, rpm.
    tangential_load : array_like
        :math:`W_t`, N [lbf].
    wheel_diameter : array_like
        Mean diameter of the wheel :math:`D`, mm [in].
    gear_ratio : array_like
        :math:`m_G`, [-].
    units, on_invalid
        As in `friction_power`.

    Returns
    -------
    float, ndarray or Masked
        W [hp]. The standard's 126000 is rounded: the result is 0.04 % above torque times speed.

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    return evaluate(
        lambda n, w, d, m: n * w * d / (126000.0 * m),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        FORCE.argument("tangential_load", tangential_load, units, above=False),
        LENGTH.argument("wheel_diameter", wheel_diameter, units),
        positive("gear_ratio", gear_ratio),
        on_invalid=on_invalid,
        scale=POWER.scale(units),
    )


def input_power(
    output_power: npt.ArrayLike,
    friction_power: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power the worm needs, :math:`H_i = H_o + H_f`.

    Parameters
    ----------
    output_power, friction_power : array_like
        W [hp].
    units, on_invalid
        As in `friction_power`.

    Returns
    -------
    float, ndarray or Masked
        W [hp].

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    return evaluate(
        lambda out, lost: out + lost,
        POWER.argument("output_power", output_power, units, above=False),
        POWER.argument("friction_power", friction_power, units, above=False),
        on_invalid=on_invalid,
        scale=POWER.scale(units),
    )


def heat_transfer_coefficient(
    worm_speed: npt.ArrayLike,
    *,
    fan: bool = False,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Heat transfer from the housing to the air.

    .. math:: \hbar_{CR} = \frac{n_W}{6494} + 0.13 \;\text{(no fan)}, \qquad
       \frac{n_W}{3939} + 0.13 \;\text{(fan)}, \qquad
       \text{ft lbf/(min in}^2\,{}^\circ\text{F)}

    Parameters
    ----------
    worm_speed : array_like
        :math:`n_W`, rpm.
    fan : bool
        Whether there is a fan on the worm shaft.
    units, on_invalid
        As in `friction_power`.

    Returns
    -------
    float, ndarray or Masked
        W/(m2 K) [ft lbf/(min in2 degF)].

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    slope = 3939.0 if fan else 6494.0
    return evaluate(
        lambda n: n / slope + 0.13,
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        on_invalid=on_invalid,
        scale=HEAT_TRANSFER.scale(units),
    )


def minimum_housing_area(
    centre_distance: npt.ArrayLike, *, units: Units = "si", on_invalid: Invalid = "raise"
) -> Any:
    r"""Least area of a housing that a designer should provide.

    .. math:: A_{min} = 43.20\, C^{1.7} \qquad \text{in}^2, \text{in}

    Parameters
    ----------
    centre_distance : array_like
        :math:`C`, mm [in].
    units, on_invalid
        As in `friction_power`.

    Returns
    -------
    float, ndarray or Masked
        m2 [in2].

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    return evaluate(
        lambda c: 43.20 * c**1.7,
        LENGTH.argument("centre_distance", centre_distance, units),
        on_invalid=on_invalid,
        scale=AREA.scale(units),
    )


def sump_temperature(
    ambient_temperature: npt.ArrayLike,
    input_power: npt.ArrayLike,
    efficiency: npt.ArrayLike,
    heat_transfer_coefficient: npt.ArrayLike,
    housing_area: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Temperature of the oil sump.

    .. math:: t_s = t_a + \frac{33000 (1 - e) H_W}{\hbar_{CR} A}

    Parameters
    ----------
    ambient_temperature : array_like
        :math:`t_a`, degC [degF].
    input_power : array_like
        Power of the worm :math:`H_W`, W [hp].
    efficiency : array_like
        :math:`e`, 0 to 1.
    heat_transfer_coefficient : array_like
        :math:`\hbar_{CR}`, W/(m2 K) [ft lbf/(min in2 degF)].
    housing_area : array_like
        Lateral area of the housing :math:`A`, m2 [in2].
    units, on_invalid
        As in `friction_power`.

    Returns
    -------
    float, ndarray or Masked
        degC [degF].

    Notes
    -----
    AGMA 6034-B92, one source.
    """
    degree = TEMPERATURE_RISE.scale(units)
    unit, absolute_zero = ("degC", -273.15) if units == "si" else ("degF", -459.67)
    return evaluate(
        # The rise is a difference, so that the zero of the scale does not matter.
        lambda t, h, e, k, a: t + 33000.0 * (1.0 - e) * h / (k * a) * degree,
        Argument("ambient_temperature", ambient_temperature, unit, absolute_zero),
        POWER.argument("input_power", input_power, units, above=False),
        Argument("efficiency", efficiency, "", 0.0, 1.0),
        HEAT_TRANSFER.argument("heat_transfer_coefficient", heat_transfer_coefficient, units),
        AREA.argument("housing_area", housing_area, units),
        on_invalid=on_invalid,
    )
