r"""What sliding leaves behind: wear by Archard's law, and the flash temperature of the foot.

Both follow from means over whole cycles: :math:`\langle F_N|v - s'|\rangle`, the normal force times
the slip speed of the foot, which has slipped no further than its asperities let it; the power of
friction; and the mean slip speed. All of the heat is taken to go into one body: a bound.
"""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import model_validator

from asperity.arrays import Real
from asperity.casefile import Table
from asperity.errors import InputError
from asperity.formulas import Symbol, formula, not_negative, positive
from asperity.results import Quantities, quantity
from asperity.sources import Source
from asperity.units import Quantity

ARCHARD = Source("J. F. Archard, Journal of Applied Physics 24 (1953), 981-988", "from memory")
TIAN_KENNEDY = Source(
    "X. Tian, F. E. Kennedy, Journal of Tribology 116 (1994), 167-174", "from memory",
    "both limits derived; within 3 % of the moving disc, integrated",
)  # fmt: skip
WARMING = Source("conduction over the contact radius", "verified", "an order of magnitude")

_NEEDS = {
    "coefficient": ("hardness",),
    "hardness": ("coefficient",),
    "conductivity": ("diffusivity", "contact_radius"),
    "diffusivity": ("conductivity", "contact_radius"),
}

A = Annotated[Real, Symbol("A", "m", positive)]
k_h = Annotated[Real, Symbol("k_h", "W/(m K)", positive)]
kappa = Annotated[Real, Symbol("kappa", "m2/s", positive)]
v = Annotated[Real, Symbol("v", "m/s", not_negative)]


class Wear(Table):
    """What a contact wears and heats by.

    Parameters
    ----------
    coefficient : float, optional
        Archard's K, with the hardness.
    hardness : float or str, optional
        H of the body that wears, Pa.
    contact_radius : float or str, optional
        A of the contact, m; with the former the depth follows, with the latter the temperature.
    conductivity : float or str, optional
        k_h of the body that is heated, W/(m K), with the diffusivity and the radius.
    diffusivity : float or str, optional
        kappa of the same, m2/s.
    """

    table: ClassVar[str] = "wear"

    coefficient: (
        Annotated[float, Quantity("", what="a wear coefficient", example="1e-5", gt=0)] | None
    ) = None
    hardness: Annotated[float, Quantity("Pa", what="a hardness", example="2 GPa", gt=0)] | None = (
        None
    )
    contact_radius: (
        Annotated[float, Quantity("m", what="a radius", example="0.1 mm", gt=0)] | None
    ) = None
    conductivity: (
        Annotated[float, Quantity("W/m/K", what="a heat conductivity", example="46 W/m/K", gt=0)]
        | None
    ) = None
    diffusivity: (
        Annotated[float, Quantity("m**2/s", what="a diffusivity", example="1.25e-5 m**2/s", gt=0)]
        | None
    ) = None

    @model_validator(mode="after")
    def _complete(self) -> "Wear":
        for key, others in _NEEDS.items():
            for other in others:
                if getattr(self, key) is not None and getattr(self, other) is None:
                    raise InputError(
                        f"wear.{key} is given without wear.{other}; give both or neither"
                    )
        return self


@formula(symbol="V'", unit="m3/s", equation="K/H <F_N v_s>", source=ARCHARD)
def wear_rate(
    coefficient: Annotated[Real, Symbol("K", "", positive)],
    hardness: Annotated[Real, Symbol("H", "Pa", positive)],
    integral: Annotated[Real, Symbol("<F_N v_s>", "W", not_negative)],
) -> Real:
    """Volume worn off the foot in time.

    Examples
    --------
    >>> f"{wear_rate(1e-5, 2e9, 27.5e-3):.3e}"
    '1.375e-16'
    """
    return coefficient / hardness * integral


@formula(symbol="h_c", unit="m", equation="V'/(pi A^2 f)", source=ARCHARD)
def wear_depth_per_cycle(
    rate: Annotated[Real, Symbol("V'", "m3/s", not_negative)],
    contact_radius: A,
    frequency: Annotated[Real, Symbol("f", "Hz", positive)],
) -> Real:
    """Depth worn off a round foot in a cycle of the vibration.

    Examples
    --------
    >>> f"{wear_depth_per_cycle(1.375e-16, 1e-4, 4e3):.3e}"
    '1.094e-12'
    """
    return rate / (np.pi * np.square(contact_radius) * frequency)


@formula(symbol="Pe", equation="v A/(2 kappa)", source=TIAN_KENNEDY)
def peclet_number(speed: v, contact_radius: A, diffusivity: kappa) -> Real:
    """How fast a contact moves over a body against its heat.

    Examples
    --------
    >>> round(peclet_number(0.1, 1e-4, 1.25e-5), 9)
    0.4
    """
    return speed * contact_radius / (2.0 * diffusivity)


@formula(symbol="T_f", unit="K", equation="2 q A/(k_h sqrt(pi (1.273 + Pe)))", source=TIAN_KENNEDY)
def flash_temperature(
    heat_flux: Annotated[Real, Symbol("q", "W/m2", not_negative)],
    contact_radius: A,
    conductivity: k_h,
    peclet: Annotated[Real, Symbol("Pe", "", not_negative)],
) -> Real:
    """Greatest rise over a round contact that is heated evenly and moves steadily over a body.

    At rest q A/k_h; moving fast, Jaeger's (2 q/k_h) sqrt(2 kappa A/(pi v)).

    Examples
    --------
    >>> round(flash_temperature(87535.2, 1e-4, 46.0, 0.002), 2)
    0.19
    """
    return 2.0 * heat_flux * contact_radius / (conductivity * np.sqrt(np.pi * (1.273 + peclet)))


@formula(symbol="t_h", unit="s", equation="A^2/kappa", source=WARMING)
def warming_time(contact_radius: A, diffusivity: kappa) -> Real:
    """Time in which a contact warms through: what is quicker heats it by its mean.

    Examples
    --------
    >>> round(warming_time(1e-4, 1.25e-5), 9)
    0.0008
    """
    return np.square(contact_radius) / diffusivity


class WearAndHeat(Quantities):
    """Wear and heat of a contact, as far as the table [wear] says what is needed."""

    wear_rate: float | None = quantity("V'", "m3/s", "volume worn off in time", default=None)
    wear_depth_per_cycle: float | None = quantity(
        "h_c", "m", "depth worn off in a cycle", default=None
    )
    flash_temperature: float | None = quantity(
        "T_f", "K", "flash temperature, all heat in one body", default=None
    )
    peclet: float | None = quantity("Pe", "", "Peclet number of the slip", default=None)
    warming_time: float | None = quantity("t_h", "s", "time to warm through", default=None)
    heated_by: str | None = quantity(
        "",
        "",
        "'mean' of the cycle; 'unresolved' where a contact warms through within one",
        default=None,
        only="json",
        shown=False,
    )

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the temperature should know."""
        if self.warming_time is None:
            return ()
        warms = f"the contact warms through in {self.warming_time:.2g} s,"
        if self.heated_by == "mean":
            return (
                f"{warms} longer than a cycle: its flash temperature is that of the cycle's mean "
                "heat",
            )
        return (
            f"{warms} shorter than a cycle: its flash temperature rises above the one given, which "
            "is that of the cycle's mean heat",
        )


def wear_and_heat(
    wear: Wear,
    integral: float,
    mean: tuple[float, float],
    frequency: float,
) -> WearAndHeat:
    r"""Wear and heat from what a solution counts over whole cycles.

    A contact that warms through within a cycle flashes above the temperature of its mean heat: how
    far, is not resolved, for that takes the history of the heat and not one number of it.

    Parameters
    ----------
    wear : Wear
        The table of the case.
    integral : float
        :math:`\langle F_N|v - s'|\rangle`, W.
    mean : tuple of 2 floats
        Power of friction, W, and slip speed, m/s, in the mean of a cycle.
    frequency : float
        Of the vibration, Hz; 0 without one: then there is no depth of a cycle, and the mean heats.
    """
    found: dict[str, Any] = {}
    if wear.coefficient is not None and wear.hardness is not None:
        found["wear_rate"] = wear_rate(wear.coefficient, wear.hardness, integral)
        if wear.contact_radius is not None and frequency > 0.0:
            found["wear_depth_per_cycle"] = wear_depth_per_cycle(
                found["wear_rate"], wear.contact_radius, frequency
            )
    return WearAndHeat(**found, **_heat(wear, *mean, frequency))


def _heat(wear: Wear, power: float, speed: float, frequency: float) -> Mapping[str, Any]:
    radius = wear.contact_radius
    if wear.conductivity is None or wear.diffusivity is None or radius is None:
        return {}
    warming = warming_time(radius, wear.diffusivity)
    peclet = peclet_number(speed, radius, wear.diffusivity)
    flux = power / (np.pi * radius**2)
    return {
        "flash_temperature": flash_temperature(flux, radius, wear.conductivity, peclet),
        "peclet": peclet,
        "warming_time": warming,
        "heated_by": "unresolved" if 0.0 < frequency * warming < 1.0 else "mean",
    }
