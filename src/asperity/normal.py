r"""The normal force of a contact against its penetration, and the `[normal]` table.

With the penetration :math:`d` (positive where the surfaces overlap), the dead load or preload
:math:`W` and the contact's slope :math:`k_z` there:

======== =====================================
law      elastic force
======== =====================================
linear   :math:`k_z d`: a flat punch
hertz    :math:`W(d/d_0)^{3/2}`, :math:`d_0 = 3W/2k_z`: a ball
rough    :math:`W e^{k_z d/W}`, d from where the load is W: asperities with exponential heights
======== =====================================

The force is the elastic one times :math:`1 + c\dot d`, the damping of which vanishes with the
force, and never a tension: :math:`N = f(d)\max(1 + c\dot d, 0)`.

Kernels take penetrations in units of :math:`W/k_z` and give forces in units of :math:`W`.
"""

import math
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.kernels.compiled import kernel
from asperity.units import Quantity

LINEAR = 0
HERTZ = 1
ROUGH = 2
LAWS = {"linear": LINEAR, "hertz": HERTZ, "rough": ROUGH}
# Slope of the force at the load W, over W and the penetration that is given.
_SLOPE_AT_LOAD = {"linear": 1.0, "hertz": 1.5, "rough": 1.0}
_NEAR = 0.2  # of a load to the elastic one
_FAR_OUT = -1e3  # where no asperity of a rough contact touches


@kernel(inline="always")
def elastic_force(law, d):
    """Elastic force at a penetration; nothing where the surfaces are apart."""
    if law == ROUGH:
        return math.exp(d)
    over = max(d, 0.0)
    if law == HERTZ:
        over /= 1.5
        return over * math.sqrt(over)
    return over


@kernel
def indentation(law, d, elastic, load):
    """Penetration under which the elastic force alone is the load that the damping makes of it.

    Asperities bear the load whatever it comes from; out of contact it is the penetration itself,
    as far as that is below 0.
    """
    if load == elastic:
        return d
    if load <= 0.0:
        return _FAR_OUT if law == ROUGH else min(d, 0.0)
    if law == ROUGH:
        return math.log(load)
    if law == HERTZ:
        more = load / elastic - 1.0
        if abs(more) > _NEAR:
            return 1.5 * np.cbrt(load * load)
        # A power series and a step after Halley: the root of a library takes three times as long.
        root = 1.0 + more * (2 / 3 + more * (-1 / 9 + more * (4 / 81 - 7 / 243 * more)))
        wanted = (1.0 + more) ** 2
        cubed = root * root * root
        return d * root * (cubed + 2.0 * wanted) / (2.0 * cubed + wanted)
    return load


@kernel
def elastic_slope(law, d):
    """Derivative of the elastic force by the penetration."""
    if law == ROUGH:
        return math.exp(d)
    if d <= 0.0:
        return 0.0
    return math.sqrt(d / 1.5) if law == HERTZ else 1.0


@kernel
def elastic_energy(law, d):
    """Energy stored in the contact at a penetration: the integral of the elastic force."""
    if law == ROUGH:
        return math.exp(d)
    over = max(d, 0.0)
    if law == HERTZ:
        over /= 1.5
        return 0.6 * over * over * math.sqrt(over)
    return 0.5 * over * over


class Normal(Table):
    r"""How the contact answers in the direction normal to it.

    Without this table the normal force is a constant.

    Parameters
    ----------
    law : {'constant', 'linear', 'hertz', 'rough'}
        Normal force against penetration, see `asperity.normal`; ``constant``: as without the table,
        and without the keys below.
    control : {'force', 'displacement'}
        The body carries a dead load, ``slider.normal_force``, and rises and falls (needs
        ``slider.mass``); or a rigid machine holds it at the height where the normal force is that.
    stiffness : float or str, optional
        Slope of the force at ``slider.normal_force``, k_z, N/m. Give this or ``penetration``.
    penetration : float or str, optional
        Penetration at ``slider.normal_force``, m; of ``rough``, the penetration over which the
        force grows e-fold.
    damping_ratio : float, optional
        Of the slope at ``slider.normal_force`` and the mass,
        :math:`\zeta = c W/2\sqrt{k_z m}`. Give this, ``damping``, or neither (none).
    damping : float or str, optional
        :math:`c` in :math:`N = f(d)(1 + c\dot d)`, s/m.
    """

    table: ClassVar[str] = "normal"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("stiffness", "penetration"),
        ("damping_ratio", "damping"),
    )

    law: Literal["constant", "linear", "hertz", "rough"] = "linear"
    control: Literal["force", "displacement"] = "force"
    stiffness: (
        Annotated[float, Quantity("N/m", what="a stiffness", example="97 MN/m", gt=0)] | None
    ) = None
    penetration: (
        Annotated[float, Quantity("m", what="a penetration", example="0.85 um", gt=0)] | None
    ) = None
    damping_ratio: (
        Annotated[float, Quantity("", what="a damping ratio", example="0.05", ge=0, le=1)] | None
    ) = None
    damping: (
        Annotated[float, Quantity("s/m", what="a damping", example="12.7 s/m", ge=0)] | None
    ) = None

    @model_validator(mode="after")
    def _consistent(self) -> "Normal":
        if self.law == "constant":
            if others := sorted(self.model_fields_set - {"law"}):
                raise InputError(
                    "normal.law is 'constant', which is as without the table; leave out "
                    + ", ".join(f"normal.{key}" for key in others)
                )
        elif self.stiffness is None and self.penetration is None:
            raise InputError(
                f"normal.stiffness is missing; law '{self.law}' needs it, or normal.penetration"
            )
        return self

    @property
    def code(self) -> int:
        """Number of the law in kernels."""
        return LAWS[self.law]

    def slope(self, load: float) -> float:
        """Slope of the force at a load in N, k_z, N/m.

        Parameters
        ----------
        load : float
            Dead load or preload :math:`W`, N.

        Returns
        -------
        float
            :math:`k_z`, N/m.

        Raises
        ------
        InputError
            The law is ``constant``.
        """
        if self.stiffness is not None:
            return self.stiffness
        if self.penetration is None:
            raise InputError("a constant normal force has no slope")
        return _SLOPE_AT_LOAD[self.law] * load / self.penetration

    def loss(self, load: float, mass: float | None) -> float:
        r"""Damping :math:`c`, s/m, at a load in N and with the body's mass in kg.

        Parameters
        ----------
        load : float
            Dead load or preload :math:`W`, N.
        mass : float or None
            Of the body, kg, to which a damping ratio refers.

        Returns
        -------
        float
            :math:`c = 2\zeta\sqrt{k_z m}/W` or as it is given, s/m.

        Raises
        ------
        InputError
            A damping ratio without a mass.
        """
        if self.damping is not None:
            return self.damping
        if not self.damping_ratio:
            return 0.0
        if mass is None:
            raise InputError(
                f"normal.damping_ratio is {self.damping_ratio:g}, which needs slider.mass; give "
                "that, or normal.damping"
            )
        return 2.0 * self.damping_ratio * math.sqrt(self.slope(load) * mass) / load
