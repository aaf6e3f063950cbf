"""Life by BS 721: from turns of the wheel to hours, and from hours to factors."""

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError, choices
from asperity.rating.formula import Argument, Invalid, evaluate, positive

LIFE_HOURS = 26000.0
"""Running time for which both life factors are 1, hours."""

_EXPONENTS = {"wear": 3.0, "strength": 7.0}


def running_hours(
    wheel_revolutions: npt.ArrayLike, wheel_speed: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Running time of a number of turns, :math:`U = N / (60\, n_2)`.

    Parameters
    ----------
    wheel_revolutions : array_like
        Turns of the wheel :math:`N`.
    wheel_speed : array_like
        :math:`n_2`, rpm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        Hours. Wear is judged by all of them, strength by a tenth (thesis 3.3.1).

    Examples
    --------
    >>> round(running_hours(500_000, 96.0), 2)
    86.81
    """
    return evaluate(
        lambda turns, n: turns / (60.0 * n),
        Argument("wheel_revolutions", wheel_revolutions, "", 0.0),
        positive("wheel_speed", wheel_speed, "rpm"),
        on_invalid=on_invalid,
    )


def wear_life_factor(hours: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Factor on the permissible torque for wear.

    .. math:: \left(\frac{27000}{1000 + U}\right)^{1/3}

    Parameters
    ----------
    hours : array_like
        Equivalent running time :math:`U`, hours.
    on_invalid
        As in `running_hours`.

    Returns
    -------
    float, ndarray or Masked
        [-]; 1 for 26000 hours.

    Notes
    -----
    BS 721-2:1983, from memory.

    Examples
    --------
    >>> wear_life_factor(26000)
    1.0
    """
    return evaluate(
        lambda u: np.cbrt(27000.0 / (1000.0 + u)),
        Argument("hours", hours, "h", 0.0),
        on_invalid=on_invalid,
    )


def strength_life_factor(hours: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Factor on the permissible torque for strength.

    .. math:: \left(\frac{26200}{200 + U}\right)^{1/7}

    Parameters
    ----------
    hours : array_like
        Equivalent running time :math:`U`, hours.
    on_invalid
        As in `running_hours`.

    Returns
    -------
    float, ndarray or Masked
        [-]; 1 for 26000 hours.

    Notes
    -----
    BS 721-2:1983, from memory.
    """
    return evaluate(
        lambda u: (26200.0 / (200.0 + u)) ** (1.0 / 7.0),
        Argument("hours", hours, "h", 0.0),
        on_invalid=on_invalid,
    )


def equivalent_hours(
    hours: npt.ArrayLike,
    speeds: npt.ArrayLike,
    torques: npt.ArrayLike,
    at_speed: float,
    at_torque: float,
    *,
    of: Literal["wear", "strength"],
) -> float:
    r"""Running time at one speed and torque that is worth a duty cycle.

    .. math:: U_e = \sum_i U_i \frac{n_i}{n} \left(\frac{T_i}{T}\right)^p, \qquad
       p = 3 \text{ for wear, } 7 \text{ for strength}

    Parameters
    ----------
    hours, speeds, torques : array_like
        :math:`U_i`, hours; :math:`n_i`, rpm; :math:`T_i`, N m, of each part of the duty cycle.
    at_speed, at_torque : float
        :math:`n`, rpm; :math:`T`, N m.
    of : {'wear', 'strength'}
        What is judged.

    Returns
    -------
    float
        Hours.

    Notes
    -----
    BS 721-2:1983, from memory.

    Examples
    --------
    >>> equivalent_hours([10, 10], 96, [100, 200], 96, 200, of="wear")
    11.25
    """
    if of not in _EXPONENTS:
        raise InputError(f"of is {of!r}; it must be one of {choices(_EXPONENTS)}")
    exponent = _EXPONENTS[of]
    parts = evaluate(
        lambda u, n, t, n0, t0: u * (n / n0) * (t / t0) ** exponent,
        Argument("hours", hours, "h", 0.0),
        Argument("speeds", speeds, "rpm", 0.0),
        Argument("torques", torques, "N m", 0.0),
        positive("at_speed", at_speed, "rpm"),
        positive("at_torque", at_torque, "N m"),
    )
    with np.errstate(over="ignore"):
        total = float(np.sum(parts))
    if not np.isfinite(total):
        raise InputError(f"the equivalent hours are {total}; give a shorter duty cycle")
    return total
