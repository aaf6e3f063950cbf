"""ISO/TR 14521: the power at the wheel and the four losses."""

from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, Invalid, evaluate, positive


def output_power(
    wheel_torque: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    ratio: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power at the wheel.

    .. math:: P_2 = \frac{2\pi}{60}\frac{T_2 n_1}{u}

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    worm_speed : array_like
        :math:`n_1`, rpm.
    ratio : array_like
        :math:`u`.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    A definition; its 2 pi/60 stands beside the 0.1 of `meshing_loss`.

    Examples
    --------
    >>> round(output_power(66.0, 1440.0, 60.0), 2)
    165.88
    """
    return evaluate(
        lambda t, n, u: 2.0 * np.pi / 60.0 * t * n / u,
        positive("wheel_torque", wheel_torque, "N m"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        positive("ratio", ratio),
        on_invalid=on_invalid,
    )


def meshing_loss(
    wheel_torque: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    ratio: npt.ArrayLike,
    efficiency: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power lost between the teeth, worm driving.

    .. math:: P_{Vz} = 0.1\, \frac{T_2 n_1}{u} \left(\frac{1}{\eta_{z1-2}} - 1\right)

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    worm_speed : array_like
        :math:`n_1`, rpm.
    ratio : array_like
        :math:`u`.
    efficiency : array_like
        :math:`\eta_{z1-2}`, above 0 and at most 1.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    Verified. The standard's 0.1 rounds 2 pi/60 by 4.5 %, so that :math:`P_2/(P_2 + P_{Vz})` is a
    little above :math:`\eta_{z1-2}`.

    Examples
    --------
    >>> meshing_loss(100.0, 1500.0, 20.0, 0.5)
    750.0
    """
    return evaluate(
        lambda t, n, u, eta: 0.1 * t * n / u * (1.0 / eta - 1.0),
        positive("wheel_torque", wheel_torque, "N m"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        positive("ratio", ratio),
        Argument("efficiency", efficiency, lower=0.0, upper=1.0, above=True),
        on_invalid=on_invalid,
    )


def back_driving_meshing_loss(
    wheel_torque: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    ratio: npt.ArrayLike,
    efficiency: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power lost between the teeth, wheel driving.

    .. math:: P_{Vz} = 0.1\, \frac{T_2 n_1}{u} (1 - \eta_{z2-1})

    Parameters
    ----------
    wheel_torque : array_like
        :math:`T_2`, N m.
    worm_speed : array_like
        :math:`n_1`, rpm.
    ratio : array_like
        :math:`u`.
    efficiency : array_like
        :math:`\eta_{z2-1}`, at most 1; negative where the gearset locks itself.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    From memory.

    Examples
    --------
    >>> back_driving_meshing_loss(100.0, 1500.0, 20.0, 0.5)
    375.0
    """
    return evaluate(
        lambda t, n, u, eta: 0.1 * t * n / u * (1.0 - eta),
        positive("wheel_torque", wheel_torque, "N m"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        positive("ratio", ratio),
        Argument("efficiency", efficiency, upper=1.0),
        on_invalid=on_invalid,
    )


def idle_loss(
    centre_distance: npt.ArrayLike, worm_speed: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Power lost without load.

    .. math:: P_{V0} = 0.89\cdot 10^{-4}\, a\, n_1^{4/3}

    Parameters
    ----------
    centre_distance : array_like
        :math:`a`, mm.
    worm_speed : array_like
        :math:`n_1`, rpm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(idle_loss(60.17, 1440.0), 2)
    87.08
    """
    return evaluate(
        lambda a, n: 0.89e-4 * a * n * np.cbrt(n),
        positive("centre_distance", centre_distance, "mm"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        on_invalid=on_invalid,
    )


def bearing_loss(
    output_power: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    ratio: npt.ArrayLike,
    wheel_pitch_diameter: npt.ArrayLike,
    loss_coefficient: npt.ArrayLike = 0.013,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power lost in the bearings under load.

    .. math:: P_{VLP} = k\, P_2\, a^{0.44} \frac{u}{d_{m2}}

    Parameters
    ----------
    output_power : array_like
        :math:`P_2`, W.
    centre_distance : array_like
        :math:`a`, mm.
    ratio : array_like
        :math:`u`.
    wheel_pitch_diameter : array_like
        :math:`d_{m2}`, mm.
    loss_coefficient : array_like
        :math:`k`, 0.013 for a fixed and a floating bearing, 0.03 for preloaded ones.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(bearing_loss(165.876, 60.17, 60.0, 101.98), 2)
    7.7
    """
    return evaluate(
        lambda p, a, u, d, k: k * p * a**0.44 * u / d,
        Argument("output_power", output_power, "W", 0.0),
        positive("centre_distance", centre_distance, "mm"),
        positive("ratio", ratio),
        positive("wheel_pitch_diameter", wheel_pitch_diameter, "mm"),
        Argument("loss_coefficient", loss_coefficient, lower=0.0),
        on_invalid=on_invalid,
    )


def seal_loss(
    worm_pitch_diameter: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    seals: npt.ArrayLike = 2,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Power lost in the lip seals of the worm.

    .. math:: P_{VD} = 11.78\cdot 10^{-6}\, d_{m1}^2\, n_1 \text{ for each}

    Parameters
    ----------
    worm_pitch_diameter : array_like
        :math:`d_{m1}`, mm.
    worm_speed : array_like
        :math:`n_1`, rpm.
    seals : array_like
        Number of seals.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        W.

    Notes
    -----
    Verified.

    Examples
    --------
    >>> round(seal_loss(18.36, 1440.0), 2)
    11.44
    """
    return evaluate(
        lambda d, n, count: count * 11.78e-6 * d * d * n,
        positive("worm_pitch_diameter", worm_pitch_diameter, "mm"),
        Argument("worm_speed", worm_speed, "rpm", 0.0),
        Argument("seals", seals, lower=0.0),
        on_invalid=on_invalid,
    )
