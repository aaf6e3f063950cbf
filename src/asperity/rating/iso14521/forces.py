"""ISO/TR 14521: the forces between the teeth of a driving worm and its wheel."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, angle, evaluate, positive


def wheel_tangential_force(
    wheel_torque: npt.ArrayLike,
    wheel_pitch_diameter: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Tangential force on the wheel, which is the worm's axial force.

    .. math:: F_{tm2} = 2000\, T_2/d_{m2}

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    wheel_pitch_diameter : array_like
        :math:`d_{m2} = 2a - d_{m1}`, mm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        N.

    Notes
    -----
    One source.

    Examples
    --------
    >>> wheel_tangential_force(366.0, 131.85)  # doctest: +ELLIPSIS
    5551.7...
    """
    return evaluate(
        lambda t, d: 2000.0 * t / d,
        positive("wheel_torque", wheel_torque, "N m"),
        positive("wheel_pitch_diameter", wheel_pitch_diameter, "mm"),
        on_invalid=on_invalid,
    )


def worm_tangential_force(
    wheel_force: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    mean_friction: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Tangential force on the driving worm, which is the wheel's axial force.

    .. math:: F_{tm1} = F_{tm2}\tan(\gamma_{m1} + \arctan\mu_{zm})

    Parameters
    ----------
    wheel_force : array_like
        :math:`F_{tm2}`, N.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    mean_friction : array_like
        :math:`\mu_{zm}`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where lead angle and friction
        angle reach 90 degrees.

    Returns
    -------
    float, ndarray or Masked
        N.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda force, lead, mu: force * np.tan(lead + np.arctan(mu)),
        positive("wheel_force", wheel_force, "N"),
        angle("lead_angle", lead_angle),
        Argument("mean_friction", mean_friction, lower=0.0),
        on_invalid=on_invalid,
        result="F_tm1",
        accept=lambda force: force > 0.0,
        because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
    )


def separating_force(
    worm_force: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    mean_friction: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Radial force that pushes worm and wheel apart.

    .. math:: F_{rm} = \frac{F_{tm1}\tan\alpha_n}{\sin(\gamma_{m1} + \arctan\mu_{zm})}

    Parameters
    ----------
    worm_force : array_like
        :math:`F_{tm1}`, N.
    pressure_angle : array_like
        :math:`\alpha_n`, rad.
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    mean_friction : array_like
        :math:`\mu_{zm}`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        N.

    Notes
    -----
    One source.
    """
    return evaluate(
        lambda force, alpha, lead, mu: force * np.tan(alpha) / np.sin(lead + np.arctan(mu)),
        positive("worm_force", worm_force, "N"),
        angle("pressure_angle", pressure_angle),
        angle("lead_angle", lead_angle),
        Argument("mean_friction", mean_friction, lower=0.0),
        on_invalid=on_invalid,
    )
