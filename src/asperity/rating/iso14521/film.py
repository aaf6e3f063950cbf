"""ISO/TR 14521: the parameter of the lubricant film and the film's thickness."""

from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Bounds, Symbol, formula, once, positive
from asperity.rating.iso14521 import symbols as s
from asperity.rating.iso14521.film_failure import FilmParameterError, too_thin
from asperity.rating.iso14521.tables import Edition, Flank

# The width B ends at 1.5.
q_1 = Annotated[Real, Symbol("q_1", "", Bounds(1.5, above=True))]
n_1 = Annotated[Real, Symbol("n_1", "rpm", positive)]


def _film_1998(z1: Real, z2: Real, q: Real, x2: Real, relative_width: Real) -> Real:
    return (
        0.018
        + q / (7.86 * (q + z2))
        + 1.0 / z2
        + x2 / 110.0
        - z2 / z1 / 36300.0
        + relative_width / 370.4
        - np.sqrt(2.0 * q - 1.0) / 213.9
    )


def _film_2010(z1: Real, z2: Real, q: Real, m: Real, alpha: Real, x2: Real, flank: Flank) -> Real:
    slope = z1 / q
    width = np.sqrt(m * (m * (6.0 * q - 9.0) + 1.0))
    product = (
        np.power(z2, -0.0847)
        * np.power(np.degrees(alpha), 0.0595)
        * (7.947e-7 * x2 + 5.927e-5)
        * ((1.0 - 0.038 * q) * q + 65.576)
        * ((108.8547 * slope - 1.0) * slope - 3294.921)
        * ((0.003291 * width + 1.0) * width - 13064.58)
    )
    return -0.511 + 3.7904e-6 * product if flank == "ZC" else -0.393 + 2.9157e-6 * product


def _too_thin(value: float, /, **gearset: Real) -> FilmParameterError:
    return too_thin(film_parameter.body, {"profile_shift": 0.0, **gearset}, value)


@formula(
    symbol="h*",
    equation="-0.393 + 2.9157e-6 P(z_2, alpha_n, x_2, q_1, z_1/q_1, m_x1)",
    source=s.VERIFIED,
    result=positive,
    because="it is not above zero; the formula has no answer for this geometry",
    error=_too_thin,
)
def film_parameter(
    starts: s.z_1,
    wheel_teeth: s.z_2,
    diameter_factor: q_1,
    axial_module: s.m_x1,
    pressure_angle: s.alpha_n,
    profile_shift: s.x_2 = 0.0,
    *,
    wheel_face_width: s.b_2H | None = None,
    edition: Edition = "2010",
    flank: Flank = "ZI",
) -> Real:
    r"""Parameter of the mean thickness of the lubricant film.

    .. math::
        P &= z_2^{-0.0847}\, \alpha_0^{0.0595}\,
        (7.947\cdot 10^{-7} x_2 + 5.927\cdot 10^{-5})\,
        \left((1 - 0.038 q_1) q_1 + 65.576\right) \\
        &\quad \left((108.8547\, z_1/q_1 - 1) z_1/q_1 - 3294.921\right)
        \left((0.003291 B + 1) B - 13064.58\right)

    with :math:`\alpha_0` in degrees and :math:`B = \sqrt{6 m_{x1} d_{m1} - 9 m_{x1}^2 + m_{x1}}`,
    of which programs differ: without the last term under the root h* changes by less than 1e-3 of
    itself. Shown for flanks A, I, N and K; C has -0.511 + 3.7904e-6 P. The edition of 1998 has
    another formula, the same for every flank, and it alone heeds the face width, which is
    2 m_x1 sqrt(q_1 + 1) where it is left out. Where h* is not above zero the error is a
    `FilmParameterError`, which tells which input drives it and what brings it back.

    Examples
    --------
    >>> round(film_parameter(1, 60, 10.8, 1.70, np.radians(20)), 4)
    0.0586
    """
    if edition == "1998":
        width = 2.0 * np.sqrt(diameter_factor + 1.0)
        if wheel_face_width is not None:
            width = wheel_face_width / axial_module
        return _film_1998(starts, wheel_teeth, diameter_factor, profile_shift, width)
    shape = starts, wheel_teeth, diameter_factor, axial_module, pressure_angle, profile_shift
    return _film_2010(*shape, flank)


@formula(
    symbol="h_minm",
    unit="um",
    equation="21 h* c_alpha^0.6 eta_0M^0.7 n_1^0.7 a^1.39 E_red^0.03/T_2^0.13",
    source=s.VERIFIED,
)
def film_thickness(
    film_parameter: s.h_star,
    pressure_coefficient: s.c_alpha,
    dynamic_viscosity: s.eta_0M,
    worm_speed: n_1,
    centre_distance: s.a,
    reduced_modulus: s.E_red,
    wheel_torque: s.T_2,
) -> Real:
    """Minimum thickness of the lubricant film, a mean over the contact.

    The torque is that with the application factor.
    """
    speed, size = _speed_and_size(worm_speed, centre_distance, reduced_modulus)
    oil = pressure_coefficient**0.6 * dynamic_viscosity**0.7 * speed
    return 21.0 * film_parameter * oil * size / wheel_torque**0.13


@once
def _speed_and_size(speed: Real, centre_distance: Real, modulus: Real) -> tuple[Real, Real]:
    return speed**0.7, centre_distance**1.39 * modulus**0.03
