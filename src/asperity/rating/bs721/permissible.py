"""The permissible torques of a gearset by BS 721, wheel and worm together."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.rating.bs721 import kernels
from asperity.rating.bs721.life import strength_life_factor, wear_life_factor
from asperity.rating.bs721.tables import Curve, TableRangeError, Tables, read_tables
from asperity.rating.bs721.torque import TOO_WIDE
from asperity.rating.formula import (
    Argument,
    FloatArray,
    Invalid,
    Masked,
    angle,
    evaluate,
    positive,
)


@dataclasses.dataclass(frozen=True)
class Limit:
    """Torque of the wheel permitted by one kind of damage, N m, for a life of 26000 h.

    Attributes
    ----------
    wheel : float or ndarray
        For the wheel. NaN where masked.
    worm : float, ndarray or None
        For the worm. NaN, or None altogether, where the tables do not reach its speed.
    reason : ndarray or None
        Why the wheel is masked, as in `asperity.rating.formula.Masked`; None if nothing can be.
    legend : mapping of int to str
        The codes of the reasons.
    note : str
        Why the worm is not rated; ``""`` if it is.
    """

    wheel: Any
    worm: Any
    reason: npt.NDArray[np.int16] | None
    legend: Mapping[int, str]
    note: str

    @property
    def torque(self) -> Any:
        """The smaller of both; the wheel's where the worm is not rated."""
        return _smaller(self.wheel, self.worm)


@dataclasses.dataclass(frozen=True)
class Permissible:
    """Permissible torques of the wheel.

    Attributes
    ----------
    wear, strength : Limit
        M_c and M_b.
    """

    wear: Limit
    strength: Limit

    @property
    def m_26k(self) -> Any:
        """M_26k, N m: the smallest of all, for a life of 26000 h."""
        # A wheel that is masked for one of them stays masked.
        return _plain(np.minimum(self.wear.torque, self.strength.torque))

    def m_w(self, hours: npt.ArrayLike) -> Any:
        """M_w, N m: torque permitted by wear for a running time in hours."""
        return self.wear.torque * wear_life_factor(hours)

    def m_s(self, hours: npt.ArrayLike) -> Any:
        """M_s, N m: torque permitted by strength for a running time in hours.

        The thesis takes a tenth of the running time required.
        """
        return self.strength.torque * strength_life_factor(hours)


def permissible_torques(
    *,
    starts: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    worm_tip_diameter: npt.ArrayLike,
    face_width: npt.ArrayLike,
    sliding_velocity: npt.ArrayLike,
    worm_speed: npt.ArrayLike,
    wheel_speed: npt.ArrayLike,
    wheel_material: str,
    worm_material: str,
    tables: Tables | None = None,
    on_invalid: Invalid = "raise",
) -> Permissible:
    r"""Permissible torques of a worm gearset.

    :math:`M_c` and :math:`M_b` of wheel and worm, each with the stress factors of its own material
    and the speed factors of its own speed.

    Parameters
    ----------
    starts, diameter_factor : array_like
        :math:`z_1, q`.
    axial_module, wheel_diameter, worm_tip_diameter, face_width : array_like
        :math:`m, d_2, d_{a1}, b`, mm; the pitch diameter of the wheel.
    lead_angle : array_like
        :math:`\gamma`, rad.
    sliding_velocity : array_like
        :math:`v_s`, m/s.
    worm_speed, wheel_speed : array_like
        :math:`n_1, n_2`, rpm.
    wheel_material, worm_material : str
        As the tables of stress factors call them.
    tables : Tables, optional
        In place of those that ship.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed for the wheel.

    Returns
    -------
    Permissible
        The worm is left out, with a note, where the tables do not reach its speed.

    Raises
    ------
    TableRangeError
        A table does not reach what the wheel needs.
    InputError
        Something else is not allowed.
    """
    known = tables or read_tables()
    # A speed that no worm can have is a mistake; one beyond the tables only leaves the worm out.
    evaluate(np.positive, positive("worm_speed", worm_speed, "rpm"), on_invalid=on_invalid)
    geometry = (
        positive("axial_module", axial_module, "mm"),
        positive("wheel_diameter", wheel_diameter, "mm"),
        positive("face_width", face_width, "mm"),
    )

    def wear(*given: FloatArray) -> FloatArray:
        n, s, v, z1, q, m, d, b = given
        speed = known.sliding_speed_factor(v) * known.rotation_speed_factor(n)
        return kernels.wear(speed, s, kernels.zone(known.zone_factor(z1, q), q, b, m), d, m)

    def strength(*given: FloatArray) -> FloatArray:
        n, s, tip, q, g, m, d, b = given
        return kernels.strength(
            known.strength_speed_factor(n), s, m, kernels.arc(b, tip, m, q, g), d, g
        )

    return Permissible(
        wear=_limit(
            wear,
            known.rotation_speed_factor,
            {"wheel_speed": wheel_speed, "worm_speed": worm_speed},
            (
                known.surface_stress_factor(wheel_material, worm_material),
                known.worm_surface_stress_factor(worm_material, wheel_material),
            ),
            (
                known.sliding_speed_factor.argument("sliding_velocity", sliding_velocity, "m/s"),
                *known.zone_factor.arguments(starts, diameter_factor),
                *geometry,
            ),
            on_invalid,
            known.zone_factor.rows_there_are,
        ),
        strength=_limit(
            strength,
            known.strength_speed_factor,
            {"wheel_speed": wheel_speed, "worm_speed": worm_speed},
            (
                known.bending_stress_factor("wheel", wheel_material),
                known.bending_stress_factor("worm", worm_material),
            ),
            (
                positive("worm_tip_diameter", worm_tip_diameter, "mm"),
                positive("diameter_factor", diameter_factor),
                angle("lead_angle", lead_angle),
                *geometry,
            ),
            on_invalid,
            TOO_WIDE,
        ),
    )


def _limit(
    formula: Callable[..., FloatArray],
    factor: Curve,
    speeds: Mapping[str, npt.ArrayLike],
    stresses: tuple[float, float],
    shared: tuple[Argument, ...],
    on_invalid: Invalid,
    because: str,
) -> Limit:
    (wheel, worm) = (
        (factor.argument(name, speed, "rpm"), positive("stress factor", stress, "MPa"), *shared)
        for (name, speed), stress in zip(speeds.items(), stresses, strict=True)
    )
    rated = evaluate(formula, *wheel, on_invalid=on_invalid, because=because)
    note, other = "", None
    try:
        other = evaluate(formula, *worm, on_invalid="mask", because=because)
    except TableRangeError as error:
        note = f"the worm is not rated: {error}"
    if isinstance(other, Masked):
        if np.isnan(other.values).any():
            note = f"the worm is not rated everywhere: worm_speed: {worm[0].allowed()}"
        other = other.values
    if isinstance(rated, Masked):
        return Limit(rated.values, other, rated.reason, rated.legend, note)
    return Limit(rated, other, None, {}, note)


def _smaller(wheel: Any, worm: Any) -> Any:
    if worm is None:
        return wheel
    # A worm that is not rated does not limit; a wheel that is masked stays masked.
    return _plain(np.where(np.isnan(wheel), wheel, np.fmin(wheel, worm)))


def _plain(value: Any) -> Any:
    return float(value) if np.ndim(value) == 0 else value
