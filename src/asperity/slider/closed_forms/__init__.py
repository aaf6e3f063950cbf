r"""Closed forms of a guided body on a rigid drive, and of Dahl's law in one dimension.

Rigid Coulomb friction over a base that vibrates in the plane of contact. In units of the drive
velocity the slip velocity is :math:`(1 - k\cos\theta\cos p,\; -k\sin\theta\cos p)`, with the
velocity ratio :math:`k = v_a/v_d`, the direction :math:`\theta` and the phase :math:`p`. A *ratio*
is the mean drive force over :math:`\mu F_N`, a *power* a mean power over :math:`\mu F_N v_d`. The
ratio is also the power of the drive; the power of the vibration is what is missing from the power
of friction, :math:`\langle|v_r|\rangle/v_d`. With a transfer coefficient :math:`\eta_y` below 1,
transverse vibration counts with :math:`\eta_y k`.

Every function takes numbers or arrays. A number outside the range raises; an array with such
elements raises, or with ``on_invalid="mask"`` comes back as a masked array whose ``data`` hold the
reason where it is masked: `NOT_FINITE`, `TOO_SMALL` or `TOO_LARGE`.
"""

from asperity.slider.closed_forms.dahl import dahl_from_rest, dahl_loop_area, dahl_peak_force
from asperity.slider.closed_forms.evaluate import NOT_FINITE, TOO_LARGE, TOO_SMALL
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
    "NOT_FINITE",
    "TOO_LARGE",
    "TOO_SMALL",
    "dahl_from_rest",
    "dahl_loop_area",
    "dahl_peak_force",
    "directed_power",
    "directed_ratio",
    "longitudinal_power",
    "longitudinal_ratio",
    "transverse_power",
    "transverse_ratio",
    "triangle_directed_ratio",
    "triangle_longitudinal_ratio",
    "triangle_transverse_ratio",
    "vibration_power",
]
