"""ISO/TR 14521: the parameter of the lubricant film and the film's thickness."""

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate, positive
from asperity.rating.iso14521.film_failure import limits_of, too_thin
from asperity.rating.iso14521.tables import Edition, Flank, check_words

_TOO_THIN = "the formula has no answer for this geometry"


def film_parameter(
    starts: npt.ArrayLike,
    wheel_teeth: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    profile_shift: npt.ArrayLike = 0.0,
    *,
    wheel_face_width: npt.ArrayLike | None = None,
    edition: Edition = "2010",
    flank: Flank = "ZI",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Parameter of the mean thickness of the lubricant film.

    .. math::
        h^* &= -0.393 + 2.9157\cdot 10^{-6} P \quad \text{(A, I, N, K)}, \qquad
        h^* = -0.511 + 3.7904\cdot 10^{-6} P \quad \text{(C)} \\
        P &= z_2^{-0.0847}\, \alpha_0^{0.0595}\,
        (7.947\cdot 10^{-7} x_2 + 5.927\cdot 10^{-5})\,
        \left((1 - 0.038 q_1) q_1 + 65.576\right) \\
        &\quad \left((108.8547\, z_1/q_1 - 1) z_1/q_1 - 3294.921\right)
        \left((0.003291 B + 1) B - 13064.58\right)

    with :math:`\alpha_0` in degrees and :math:`B = \sqrt{6 m_{x1} d_{m1} - 9 m_{x1}^2 + m_{x1}}`.
    Edition 1998, for every flank:

    .. math::
        h^* = 0.018 + \frac{q_1}{7.86 (q_1 + z_2)} + \frac{1}{z_2} + \frac{x_2}{110}
        - \frac{u}{36300} + \frac{b_{2H}}{370.4\, m_{x1}} - \frac{\sqrt{2 q_1 - 1}}{213.9}

    Parameters
    ----------
    starts, wheel_teeth : array_like
        :math:`z_1`, :math:`z_2`; need not be whole, so that a ratio can be varied smoothly.
    diameter_factor : array_like
        :math:`q_1`, above 1.6 (where the width :math:`B` ends).
    axial_module : array_like
        :math:`m_{x1}`, mm.
    pressure_angle : array_like
        :math:`\alpha_0`, rad.
    profile_shift : array_like
        :math:`x_2`.
    wheel_face_width : array_like, optional
        :math:`b_{2H}`, mm, for edition 1998; left out: :math:`2 m_{x1}\sqrt{q_1 + 1}`.
    edition : {'1998', '2010'}
        Family of formulas.
    flank : {'ZA', 'ZI', 'ZN', 'ZK', 'ZC'}
        Of the worm.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed, or where :math:`h^* \le 0`.

    Returns
    -------
    float, ndarray or Masked
        :math:`h^*`, above zero.

    Raises
    ------
    FilmParameterError
        It is not; the message tells which input drives it, and what change of the ratio, the
        module and others brings it back at the same centre distance.

    Notes
    -----
    Verified but for the width :math:`B`, of which programs differ: without the last term under the
    root :math:`h^*` changes by less than 1e-3 of itself.

    Examples
    --------
    >>> round(film_parameter(1, 60, 10.8, 1.70, np.radians(20)), 4)
    0.0586
    """
    check_words(edition=edition, flank=flank)
    gearset: dict[str, npt.ArrayLike] = {
        "starts": starts,
        "wheel_teeth": wheel_teeth,
        "diameter_factor": diameter_factor,
        "axial_module": axial_module,
        "pressure_angle": pressure_angle,
        "profile_shift": profile_shift,
    }
    if wheel_face_width is not None:
        gearset["wheel_face_width"] = wheel_face_width
    arguments = [_argument(name, value) for name, value in gearset.items()]
    formula = _formula(edition, flank)
    if on_invalid == "mask" and any(np.ndim(value) for value in gearset.values()):
        return evaluate(
            formula,
            *arguments,
            on_invalid=on_invalid,
            result="h*",
            accept=lambda h: h > 0.0,
            because="it is not above zero; " + _TOO_THIN,
        )
    values = evaluate(formula, *arguments, on_invalid=on_invalid, result="h*")
    wrong = np.asarray(values) <= 0.0
    if wrong.any():
        rows = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in gearset.values()))
        first = {name: float(row[wrong][0]) for name, row in zip(gearset, rows, strict=True)}
        raise too_thin(formula, first, float(np.asarray(values)[wrong][0]))
    return values


def film_limits(
    starts: float,
    wheel_teeth: float,
    diameter_factor: float,
    axial_module: float,
    pressure_angle: float,
    profile_shift: float = 0.0,
    *,
    wheel_face_width: float | None = None,
    edition: Edition = "2010",
    flank: Flank = "ZI",
) -> dict[str, float | None]:
    """Return the value of each input at which h* is zero, the others as they are.

    The centre distance stays unless it is the one that changes; the profile shift follows.

    Parameters
    ----------
    starts, wheel_teeth, diameter_factor, axial_module, pressure_angle, profile_shift : float
        As in `film_parameter`.
    wheel_face_width : float, optional
        As in `film_parameter`.
    edition, flank : str
        As in `film_parameter`.

    Returns
    -------
    dict of str to float or None
        ``ratio``, ``axial_module`` (mm), ``centre_distance`` (mm), ``diameter_factor``,
        ``pressure_angle`` (rad); None where no value between a fifth of it and five times does.

    Examples
    --------
    >>> limits = film_limits(1, 60, 10.8, 1.70, np.radians(20))
    >>> round(limits["ratio"] / 60, 3), round(limits["axial_module"] / 1.70, 3)
    (1.277, 1.375)
    """
    check_words(edition=edition, flank=flank)
    gearset = {
        "starts": starts,
        "wheel_teeth": wheel_teeth,
        "diameter_factor": diameter_factor,
        "axial_module": axial_module,
        "pressure_angle": pressure_angle,
        "profile_shift": profile_shift,
    }
    if wheel_face_width is not None:
        gearset["wheel_face_width"] = wheel_face_width
    formula = _formula(edition, flank)
    evaluate(formula, *(_argument(name, value) for name, value in gearset.items()), result="h*")
    return limits_of(formula, gearset)


def film_thickness(
    film_parameter: npt.ArrayLike,
    pressure_coefficient: npt.ArrayLike,
    dynamic_viscosity: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    centre_distance: npt.ArrayLike,
    reduced_modulus: npt.ArrayLike,
    wheel_torque: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Minimum thickness of the lubricant film, a mean over the contact.

    .. math:: h_{min,m} = 21\, h^* \frac{c_\alpha^{0.6}\, \eta_{0M}^{0.7}\, n_1^{0.7}\, a^{1.39}\,
        E_{red}^{0.03}}{T_2^{0.13}}

    Parameters
    ----------
    film_parameter : array_like
        :math:`h^*`.
    pressure_coefficient : array_like
        Pressure coefficient of the viscosity :math:`c_\alpha`, m2/N.
    dynamic_viscosity : array_like
        :math:`\eta_{0M}`, Pa s.
    worm_speed : array_like
        :math:`n_1`, rpm.
    centre_distance : array_like
        :math:`a`, mm.
    reduced_modulus : array_like
        :math:`E_{red}`, MPa.
    wheel_torque : array_like
        :math:`T_2` with the application factor, N m.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        um.

    Notes
    -----
    Verified.
    """
    return evaluate(
        lambda h, c, eta, n, a, e, t: (
            21.0 * h * c**0.6 * eta**0.7 * n**0.7 * a**1.39 * e**0.03 / t**0.13
        ),
        positive("film_parameter", film_parameter),
        positive("pressure_coefficient", pressure_coefficient, "m2/N"),
        positive("dynamic_viscosity", dynamic_viscosity, "Pa s"),
        positive("worm_speed", worm_speed, "rpm"),
        positive("centre_distance", centre_distance, "mm"),
        positive("reduced_modulus", reduced_modulus, "MPa"),
        positive("wheel_torque", wheel_torque, "N m"),
        on_invalid=on_invalid,
    )


def _argument(name: str, value: npt.ArrayLike) -> Argument:
    if name == "pressure_angle":
        return angle(name, value)
    if name == "profile_shift":
        return Argument(name, value)
    if name == "diameter_factor":
        return Argument(name, value, lower=1.5, above=True)
    return positive(name, value, "mm" if name in ("axial_module", "wheel_face_width") else "")


def _formula(edition: Edition, flank: Flank) -> Callable[..., FloatArray]:
    if edition == "1998":
        return _film_1998
    return _film_concave if flank == "ZC" else _film_convex


def _product(
    z1: FloatArray, z2: FloatArray, q: FloatArray, m: FloatArray, alpha: FloatArray, x2: FloatArray
) -> FloatArray:
    slope = z1 / q
    width = np.sqrt(m * (m * (6.0 * q - 9.0) + 1.0))
    return np.asarray(
        np.power(z2, -0.0847)
        * np.power(np.degrees(alpha), 0.0595)
        * (7.947e-7 * x2 + 5.927e-5)
        * ((1.0 - 0.038 * q) * q + 65.576)
        * ((108.8547 * slope - 1.0) * slope - 3294.921)
        * ((0.003291 * width + 1.0) * width - 13064.58)
    )


def _film_convex(*gearset: FloatArray) -> FloatArray:
    return -0.393 + 2.9157e-6 * _product(*gearset[:6])


def _film_concave(*gearset: FloatArray) -> FloatArray:
    return -0.511 + 3.7904e-6 * _product(*gearset[:6])


def _film_1998(
    z1: FloatArray,
    z2: FloatArray,
    q: FloatArray,
    m: FloatArray,
    alpha: FloatArray,
    x2: FloatArray,
    width: FloatArray | None = None,
) -> FloatArray:
    relative = 2.0 * np.sqrt(q + 1.0) if width is None else width / m
    return np.asarray(
        0.018
        + q / (7.86 * (q + z2))
        + 1.0 / z2
        + x2 / 110.0
        - z2 / z1 / 36300.0
        + relative / 370.4
        - np.sqrt(2.0 * q - 1.0) / 213.9
    )
