"""ISO/TR 14521: efficiency of the teeth and of the gearbox, either side driving."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, angle, evaluate, positive


def worm_driving_efficiency(
    lead_angle: npt.ArrayLike, mean_friction: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Efficiency of the teeth, worm driving.

    .. math:: \eta_{z1-2} = \frac{\tan\gamma_{m1}}{\tan(\gamma_{m1} + \arctan\mu_{zm})}

    Parameters
    ----------
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    mean_friction : array_like
        :math:`\mu_{zm}`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where lead angle and friction
        angle reach 90 degrees: there the worm cannot drive.

    Returns
    -------
    float, ndarray or Masked
        :math:`\eta_{z1-2}`, above 0 and at most 1.

    Notes
    -----
    Verified; thesis (6).

    Examples
    --------
    >>> round(worm_driving_efficiency(np.radians(20), 0.05), 5)
    0.86322
    """
    return evaluate(
        lambda lead, mu: np.tan(lead) / np.tan(lead + np.arctan(mu)),
        angle("lead_angle", lead_angle),
        Argument("mean_friction", mean_friction, lower=0.0),
        on_invalid=on_invalid,
        result="eta_z1_2",
        accept=lambda eta: eta > 0.0,
        because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
    )


def wheel_driving_efficiency(
    lead_angle: npt.ArrayLike, mean_friction: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Efficiency of the teeth, wheel driving.

    .. math:: \eta_{z2-1} = \frac{\tan(\gamma_{m1} - \arctan\mu_{zm})}{\tan\gamma_{m1}}

    Parameters
    ----------
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    mean_friction : array_like
        :math:`\mu_{zm}`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`\eta_{z2-1}`; zero or negative, exactly where
        :math:`\gamma_{m1} \le \arctan\mu_{zm}`, the wheel cannot drive: self-locking.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> wheel_driving_efficiency(np.radians(5), 0.1) < 0
    True
    """
    return evaluate(
        lambda lead, mu: np.tan(lead - np.arctan(mu)) / np.tan(lead),
        angle("lead_angle", lead_angle),
        Argument("mean_friction", mean_friction, lower=0.0),
        on_invalid=on_invalid,
    )


def total_efficiency(
    output_power: npt.ArrayLike, losses: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Efficiency of the gearbox, worm driving.

    .. math:: \eta_{ges1-2} = \frac{P_2}{P_2 + P_V}

    Parameters
    ----------
    output_power : array_like
        :math:`P_2`, W.
    losses : array_like
        Sum of the four losses :math:`P_V`, W.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`\eta_{ges1-2}`.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> total_efficiency(300.0, 100.0)
    0.75
    """
    return evaluate(
        lambda p, lost: p / (p + lost),
        positive("output_power", output_power, "W"),
        Argument("losses", losses, "W", 0.0),
        on_invalid=on_invalid,
    )


def back_driving_total_efficiency(
    wheel_power: npt.ArrayLike, losses: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Efficiency of the gearbox, wheel driving.

    .. math:: \eta_{ges2-1} = \frac{P_2 - P_V}{P_2}

    Parameters
    ----------
    wheel_power : array_like
        :math:`P_2`, W, put in at the wheel.
    losses : array_like
        Sum of the four losses :math:`P_V`, W.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`\eta_{ges2-1}`; zero or negative where the gearbox locks itself.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> back_driving_total_efficiency(400.0, 100.0)
    0.75
    """
    return evaluate(
        lambda p, lost: (p - lost) / p,
        positive("wheel_power", wheel_power, "W"),
        Argument("losses", losses, "W", 0.0),
        on_invalid=on_invalid,
    )
