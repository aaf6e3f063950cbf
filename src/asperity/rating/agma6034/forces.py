"""Forces at the teeth and bending stress, as used with AGMA 6034-B92."""

from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError, choices
from asperity.rating.agma6034.symbols import PRESSURE_ANGLES
from asperity.rating.agma6034.units import FORCE, LENGTH, POWER, STRESS, VELOCITY, Units
from asperity.rating.formula import Argument, FloatArray, Invalid, angle, evaluate, positive

_LEWIS_FORM_FACTORS = (0.100, 0.125, 0.150, 0.175)


def wheel_load_from_power(
    output_power: npt.ArrayLike,
    pitch_line_velocity: npt.ArrayLike,
    efficiency: npt.ArrayLike,
    *,
    design_factor: npt.ArrayLike = 1.0,
    application_factor: npt.ArrayLike = 1.0,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Tangential load on the wheel that the design power asks for.

    .. math:: W_G = \frac{33000\, n_d H_0 K_a}{V_G e} \qquad \text{lbf, hp, ft/min}

    Parameters
    ----------
    output_power : array_like
        :math:`H_0`, W [hp].
    pitch_line_velocity : array_like
        :math:`V_G`, m/s [ft/min].
    efficiency : array_like
        :math:`e`, above 0 and at most 1.
    design_factor, application_factor : array_like
        :math:`n_d, K_a`, [-].
    units : {'si', 'inch'}
        The units of arguments and result; the second in brackets.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        N [lbf].

    Notes
    -----
    Budynas and Nisbett, Shigley's Mechanical Engineering Design, ch. 15, verified.
    """
    return evaluate(
        lambda h, v, e, nd, ka: 33000.0 * nd * h * ka / (v * e),
        POWER.argument("output_power", output_power, units, above=False),
        VELOCITY.argument("pitch_line_velocity", pitch_line_velocity, units),
        Argument("efficiency", efficiency, "", 0.0, 1.0, above=True),
        positive("design_factor", design_factor),
        positive("application_factor", application_factor),
        on_invalid=on_invalid,
        scale=FORCE.scale(units),
    )


def worm_tangential_load(
    wheel_load: npt.ArrayLike,
    friction: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Tangential load on the worm.

    .. math:: W_W = W_G \frac{\cos\phi_n\sin\lambda + f\cos\lambda}
                             {\cos\phi_n\cos\lambda - f\sin\lambda}

    Parameters
    ----------
    wheel_load : array_like
        :math:`W_G`, N [lbf].
    friction : array_like
        :math:`f \ge 0`, [-]; small enough that the worm can drive.
    lead_angle, pressure_angle : array_like
        :math:`\lambda, \phi_n`, rad.
    units, on_invalid
        As in `wheel_load_from_power`.

    Returns
    -------
    float, ndarray or Masked
        N [lbf].

    Notes
    -----
    Budynas and Nisbett, ch. 15, verified.
    """
    return evaluate(
        lambda w, f, lam, phi: (
            w
            * (np.cos(phi) * np.sin(lam) + f * np.cos(lam))
            / (np.cos(phi) * np.cos(lam) - f * np.sin(lam))
        ),
        FORCE.argument("wheel_load", wheel_load, units, above=False),
        Argument("friction", friction, "", 0.0),
        angle("lead_angle", lead_angle),
        angle("pressure_angle", pressure_angle),
        on_invalid=on_invalid,
        scale=FORCE.scale(units),
        result="the load on the worm",
        accept=lambda load: ~np.signbit(load),
        because="with this friction and lead angle the worm cannot drive",
    )


def friction_force(
    wheel_load: npt.ArrayLike,
    friction: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    *,
    form: Literal["agma", "shigley"] = "agma",
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Friction force along the worm's thread.

    .. math:: W_f = \frac{f W}{\cos\lambda\cos\phi_n} \;\text{(AGMA)}, \qquad
       W_f = \frac{f W}{\cos\phi_n\cos\lambda - f\sin\lambda} \;\text{(Shigley)}

    Parameters
    ----------
    wheel_load : array_like
        Tangential load on the wheel :math:`W`, N [lbf].
    friction : array_like
        :math:`f \ge 0`, [-]; with Shigley's form small enough that the worm can drive.
    lead_angle, pressure_angle : array_like
        :math:`\lambda, \phi_n`, rad.
    form : {'agma', 'shigley'}
        Whether the normal force is that of a frictionless tooth, or balances the load together
        with the friction. The second closes the balance of power exactly.
    units, on_invalid
        As in `wheel_load_from_power`.

    Returns
    -------
    float, ndarray or Masked
        N [lbf]. Shigley prints it with the opposite sign.

    Notes
    -----
    AGMA 6034-B92 and Budynas and Nisbett, ch. 15; each one source.
    """
    if form not in ("agma", "shigley"):
        raise InputError(f"form is {form!r}; it must be one of {choices(('agma', 'shigley'))}")
    share = 0.0 if form == "agma" else 1.0
    return evaluate(
        lambda w, f, lam, phi: f * w / (np.cos(phi) * np.cos(lam) - share * f * np.sin(lam)),
        FORCE.argument("wheel_load", wheel_load, units, above=False),
        Argument("friction", friction, "", 0.0),
        angle("lead_angle", lead_angle),
        angle("pressure_angle", pressure_angle),
        on_invalid=on_invalid,
        scale=FORCE.scale(units),
        result="the friction force",
        accept=lambda force: ~np.signbit(force),
        because="with this friction and lead angle the worm cannot drive",
    )


def lewis_form_factor(pressure_angle: npt.ArrayLike, *, on_invalid: Invalid = "raise") -> Any:
    r"""Lewis form factor of the wheel's teeth.

    0.100, 0.125, 0.150 and 0.175 for 14.5, 20, 25 and 30 degrees; linear in between.

    Parameters
    ----------
    pressure_angle : array_like
        Normal pressure angle :math:`\phi_n`, rad.
    on_invalid
        As in `wheel_load_from_power`.

    Returns
    -------
    float, ndarray or Masked
        :math:`y`, [-], to be used with a circular pitch.

    Notes
    -----
    Budynas and Nisbett, ch. 15, verified.
    """
    return evaluate(
        _form_factor,
        tabulated_pressure_angle(pressure_angle),
        on_invalid=on_invalid,
    )


def _form_factor(phi: FloatArray) -> FloatArray:
    return np.interp(phi, PRESSURE_ANGLES, _LEWIS_FORM_FACTORS)


def tabulated_pressure_angle(pressure_angle: npt.ArrayLike) -> Argument:
    """Return a pressure angle that must lie among `PRESSURE_ANGLES`."""
    first, last = PRESSURE_ANGLES[0], PRESSURE_ANGLES[-1]
    # A whole degree turned into radians and back may end a rounding outside.
    return Argument(
        "pressure_angle",
        pressure_angle,
        "rad",
        float(np.nextafter(first, 0.0)),
        float(np.nextafter(last, 1.0)),
        because="AGMA 6034-B92 has values for 14.5 to 30 degrees",
    )


def bending_stress(
    wheel_load: npt.ArrayLike,
    axial_pitch: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    effective_face_width: npt.ArrayLike,
    pressure_angle: npt.ArrayLike,
    *,
    units: Units = "si",
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Bending stress of the wheel's teeth.

    .. math:: \sigma_a = \frac{W_G}{p_n F_e y}, \qquad p_n = p_x \cos\lambda

    Parameters
    ----------
    wheel_load : array_like
        :math:`W_G`, N [lbf].
    axial_pitch : array_like
        Axial pitch of the worm :math:`p_x`, mm [in].
    lead_angle : array_like
        :math:`\lambda`, rad.
    effective_face_width : array_like
        :math:`F_e`, mm [in].
    pressure_angle : array_like
        :math:`\phi_n`, rad, for the form factor :math:`y`, see `lewis_form_factor`.
    units, on_invalid
        As in `wheel_load_from_power`.

    Returns
    -------
    float, ndarray or Masked
        MPa [psi].

    Notes
    -----
    Buckingham's adaption of Lewis; Budynas and Nisbett, ch. 15, verified.
    """
    return evaluate(
        lambda w, px, lam, fe, phi: w / (px * np.cos(lam) * fe * _form_factor(phi)),
        FORCE.argument("wheel_load", wheel_load, units, above=False),
        LENGTH.argument("axial_pitch", axial_pitch, units),
        angle("lead_angle", lead_angle),
        LENGTH.argument("effective_face_width", effective_face_width, units),
        tabulated_pressure_angle(pressure_angle),
        on_invalid=on_invalid,
        scale=STRESS.scale(units),
    )
