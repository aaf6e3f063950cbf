"""Permissible torques of BS 721 for wear and strength, and their factors."""

from typing import Any

import numpy.typing as npt

from asperity.rating.bs721 import kernels
from asperity.rating.bs721.tables import Tables, read_tables
from asperity.rating.formula import Invalid, angle, evaluate, positive

TOO_WIDE = "the face width is above the worm's tip diameter; make it smaller"


def zone_factor(
    starts: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    face_width: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    *,
    tables: Tables | None = None,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Zone factor.

    .. math:: Z = Z_0(z_1, q) \min\left(\frac{b}{2 m \sqrt{q + 1}},\; 1.15\right)

    Parameters
    ----------
    starts : array_like
        :math:`z_1`, those of the table: 1 to 4.
    diameter_factor : array_like
        :math:`q`, 6 to 20.
    face_width, axial_module : array_like
        Face width of the wheel :math:`b`; :math:`m`, mm.
    tables : Tables, optional
        In place of those that ship.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        :math:`Z`, [-].

    Notes
    -----
    BS 721-2:1983; the formula is verified, the table from memory.

    Examples
    --------
    >>> round(zone_factor(1, 10, 2 * 10 * 11**0.5, 10), 3)
    1.143
    """
    table = (tables or read_tables()).zone_factor
    return evaluate(
        lambda z1, q, b, m: kernels.zone(table(z1, q), q, b, m),
        *table.arguments(starts, diameter_factor),
        positive("face_width", face_width, "mm"),
        positive("axial_module", axial_module, "mm"),
        on_invalid=on_invalid,
        result="the zone factor",
        because=table.rows_there_are,
    )


def wear_speed_factor(
    sliding_velocity: npt.ArrayLike,
    speed: npt.ArrayLike,
    *,
    tables: Tables | None = None,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Speed factor for wear, :math:`X_c = K_V(v_s) K_R(n)`.

    Parameters
    ----------
    sliding_velocity : array_like
        :math:`v_s`, m/s, 0 to 30.
    speed : array_like
        Speed of rotation of the member that is rated, rpm, 0.5 to 600.
    tables, on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        [-]

    Notes
    -----
    Tables of JGMA 405-01, from memory.
    """
    known = tables or read_tables()
    return evaluate(
        lambda v, n: known.sliding_speed_factor(v) * known.rotation_speed_factor(n),
        known.sliding_speed_factor.argument("sliding_velocity", sliding_velocity, "m/s"),
        known.rotation_speed_factor.argument("speed", speed, "rpm"),
        on_invalid=on_invalid,
    )


def strength_speed_factor(
    speed: npt.ArrayLike, *, tables: Tables | None = None, on_invalid: Invalid = "raise"
) -> Any:
    """Speed factor for strength X_b.

    Parameters
    ----------
    speed : array_like
        Speed of rotation of the member that is rated, rpm, 1 to 1200.
    tables, on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        [-]

    Notes
    -----
    BS 721-2:1983, from memory, within 0.03.
    """
    table = (tables or read_tables()).strength_speed_factor
    return evaluate(table, table.argument("speed", speed, "rpm"), on_invalid=on_invalid)


def strength_speed_factor_from_velocity(
    pitch_line_velocity: npt.ArrayLike, *, on_invalid: Invalid = "raise"
) -> Any:
    r"""Speed factor for strength by another fit, :math:`X_b = 0.521\, V^{-0.2}`.

    Parameters
    ----------
    pitch_line_velocity : array_like
        Velocity of the wheel's pitch line :math:`V`, m/s.
    on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        [-]

    Notes
    -----
    From memory, and a third above the table for gearset 3; `permissible_torques` does not use it.
    """
    return evaluate(
        lambda v: 0.521 * v**-0.2,
        positive("pitch_line_velocity", pitch_line_velocity, "m/s"),
        on_invalid=on_invalid,
    )


def wear_torque(
    wear_speed_factor: npt.ArrayLike,
    surface_stress_factor: npt.ArrayLike,
    zone_factor: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Permissible torque of the wheel for wear, for a life of 26000 h.

    .. math:: M_c = 0.00191\, X_c S_c Z d_2^{1.8} m

    Parameters
    ----------
    wear_speed_factor : array_like
        :math:`X_c` of the member that is rated, [-].
    surface_stress_factor : array_like
        :math:`S_c` of this member, MPa.
    zone_factor : array_like
        :math:`Z`, [-].
    wheel_diameter : array_like
        Pitch diameter of the wheel :math:`d_2`, mm.
    axial_module : array_like
        :math:`m`, mm.
    on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        N m.

    Notes
    -----
    BS 721-2:1983, verified. IS 7443 has 18.64 for kgf/mm2 and N mm, which is 0.00190.
    """
    return evaluate(
        kernels.wear,
        positive("wear_speed_factor", wear_speed_factor),
        positive("surface_stress_factor", surface_stress_factor, "MPa"),
        positive("zone_factor", zone_factor),
        positive("wheel_diameter", wheel_diameter, "mm"),
        positive("axial_module", axial_module, "mm"),
        on_invalid=on_invalid,
    )


def root_arc(
    face_width: npt.ArrayLike,
    worm_tip_diameter: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    diameter_factor: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Length of the root of the wheel's teeth.

    .. math:: l_r = (d_{a1} + 2c)\arcsin\frac{b_e}{d_{a1} + 2c}, \qquad
       c = 0.2\, m\cos\gamma, \quad b_e = \min(b,\; 2 m\sqrt{q + 1})

    Parameters
    ----------
    face_width : array_like
        Face width of the wheel :math:`b`, mm.
    worm_tip_diameter : array_like
        :math:`d_{a1}`, mm.
    axial_module, diameter_factor : array_like
        :math:`m`, mm; :math:`q`, [-].
    lead_angle : array_like
        :math:`\gamma`, rad.
    on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        mm.

    Notes
    -----
    BS 721-2:1983, from memory.
    """
    return evaluate(
        kernels.arc,
        positive("face_width", face_width, "mm"),
        positive("worm_tip_diameter", worm_tip_diameter, "mm"),
        positive("axial_module", axial_module, "mm"),
        positive("diameter_factor", diameter_factor),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
        result="the root arc",
        because=TOO_WIDE,
    )


def strength_torque(
    strength_speed_factor: npt.ArrayLike,
    bending_stress_factor: npt.ArrayLike,
    axial_module: npt.ArrayLike,
    root_arc: npt.ArrayLike,
    wheel_diameter: npt.ArrayLike,
    lead_angle: npt.ArrayLike,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Permissible torque of the wheel for strength, for a life of 26000 h.

    .. math:: M_b = 0.0018\, X_b S_b m\, l_r d_2 \cos\gamma

    Parameters
    ----------
    strength_speed_factor : array_like
        :math:`X_b` of the member that is rated, [-].
    bending_stress_factor : array_like
        :math:`S_b` of this member, MPa.
    axial_module, root_arc, wheel_diameter : array_like
        :math:`m, l_r`; pitch diameter of the wheel :math:`d_2`, mm.
    lead_angle : array_like
        :math:`\gamma`, rad.
    on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        N m.

    Notes
    -----
    BS 721-2:1983, from memory.
    """
    return evaluate(
        kernels.strength,
        positive("strength_speed_factor", strength_speed_factor),
        positive("bending_stress_factor", bending_stress_factor, "MPa"),
        positive("axial_module", axial_module, "mm"),
        positive("root_arc", root_arc, "mm"),
        positive("wheel_diameter", wheel_diameter, "mm"),
        angle("lead_angle", lead_angle),
        on_invalid=on_invalid,
    )


def friction(
    sliding_velocity: npt.ArrayLike, *, tables: Tables | None = None, on_invalid: Invalid = "raise"
) -> Any:
    """Coefficient of friction of phosphor bronze on a case-hardened worm.

    Parameters
    ----------
    sliding_velocity : array_like
        v_s, m/s; the last value of the table holds above 20 m/s.
    tables, on_invalid
        As in `zone_factor`.

    Returns
    -------
    float, ndarray or Masked
        mu, [-].

    Notes
    -----
    BS 721-2:1983, from memory.

    Examples
    --------
    >>> round(friction(1.5), 6)
    0.038
    """
    table = (tables or read_tables()).friction
    return evaluate(
        table,
        table.argument("sliding_velocity", sliding_velocity, "m/s"),
        on_invalid=on_invalid,
    )
