r"""Closed forms: limits of the sliding body that can be written down.

In the plane, rigid Coulomb friction over a base that vibrates, for a guided body on a rigid drive
(``ratios``, ``powers``). In units of the drive velocity the slip velocity is
:math:`(1 - k\cos\theta\cos p,\; -k\sin\theta\cos p)`, with the velocity ratio
:math:`k = v_a/v_d`, the direction :math:`\theta` and the phase :math:`p`. A *ratio* is the mean
drive force over :math:`\mu F_N`, a *power* a mean power over :math:`\mu F_N v_d`. The ratio is also
the power of the drive; the power of the vibration is what is missing from the power of friction,
:math:`\langle|v_r|\rangle/v_d`. With a transfer coefficient :math:`\eta_y` below 1, transverse
vibration counts with :math:`\eta_y k`.

Out of the plane, static friction and loads (``normal``), sliding on springs that lag behind their
load (``lag``), and both at once (``elliptic``). Dahl's law in one dimension (``dahl``).

Every function is a formula, see `asperity.formulas`: it takes numbers or arrays, refuses what is
outside its range or masks it with the reason, and says its source and how far it can be trusted.
"""

from asperity.slider.closed_forms.dahl import dahl_from_rest, dahl_loop_area, dahl_peak_force
from asperity.slider.closed_forms.elliptic import elliptic_ratio
from asperity.slider.closed_forms.lag import (
    critical_velocity,
    master_curve,
    master_curve_approximated,
    normal_ratio,
)
from asperity.slider.closed_forms.normal import (
    cosine_mean_approach,
    dead_load_ratio,
    load_swing,
    mean_load_ratio,
    normal_static_ratio,
    orbit_mean_approach,
    plane_static_ratio,
)
from asperity.slider.closed_forms.powers import (
    directed_power,
    longitudinal_power,
    transverse_power,
    vibration_power,
)
from asperity.slider.closed_forms.ratios import (
    directed_ratio,
    longitudinal_ratio,
    transverse_ratio,
    triangle_directed_ratio,
    triangle_longitudinal_ratio,
    triangle_transverse_ratio,
)

__all__ = [
    "cosine_mean_approach",
    "critical_velocity",
    "dahl_from_rest",
    "dahl_loop_area",
    "dahl_peak_force",
    "dead_load_ratio",
    "directed_power",
    "directed_ratio",
    "elliptic_ratio",
    "load_swing",
    "longitudinal_power",
    "longitudinal_ratio",
    "master_curve",
    "master_curve_approximated",
    "mean_load_ratio",
    "normal_ratio",
    "normal_static_ratio",
    "orbit_mean_approach",
    "plane_static_ratio",
    "transverse_power",
    "transverse_ratio",
    "triangle_directed_ratio",
    "triangle_longitudinal_ratio",
    "triangle_transverse_ratio",
    "vibration_power",
]
