"""Base oils and lubricants, in SI units, each value with its source."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from pydantic import model_validator

from asperity.errors import InputError
from asperity.gearset import oil
from asperity.gearset.library import Sourced, find
from asperity.gearset.materials import BaseOilName
from asperity.gearset.symbols import THINNEST
from asperity.sources import Source
from asperity.units import Quantity

_MM2 = 1e-6
_ZERO_CELSIUS = 273.15

Density = Annotated[
    float, Quantity("kg/m^3", what="a density", example="890 kg/m^3", gt=300, lt=3000)
]
Viscosity = Annotated[
    float,
    Quantity(
        "m^2/s", what="a kinematic viscosity", example="68 mm^2/s", ge=THINNEST * _MM2, le=0.1
    ),
]


class BaseOil(Sourced):
    r"""A class of base oils.

    Parameters
    ----------
    name : str
        ``mineral``, ``polyalphaolefin`` or ``polyglycol``.
    pressure_viscosity : float or str
        :math:`c_\alpha`, m²/N.
    density_coefficient : float or str
        :math:`k_\rho`, 1/K.
    pitting_factor : float
        :math:`Z_{oil}`.
    sump_limit : float or str
        :math:`\vartheta_{S,lim}`, K.
    density_15 : float or str
        Density at 15 degC of an oil that does not state its own, kg/m³.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "base_oil"
    section: ClassVar[str] = "base_oil"

    pressure_viscosity: Annotated[
        float, Quantity("m^2/N", what="a coefficient", example="1.7e-8 m^2/N", gt=0)
    ]
    density_coefficient: Annotated[
        float, Quantity("1/K", what="a coefficient", example="7e-4 1/K", ge=0, lt=0.01)
    ]
    pitting_factor: Annotated[float, Quantity("", what="a factor", example="0.89", gt=0)]
    sump_limit: Annotated[
        float, Quantity("K", what="a temperature", example="90 degC", gt=_ZERO_CELSIUS)
    ]
    density_15: Density


class Lubricant(Sourced):
    r"""A lubricating oil.

    Parameters
    ----------
    name : str
        As it appears in results.
    base_oil : {'mineral', 'polyalphaolefin', 'polyglycol'}
        Class of its base oil.
    viscosity_40, viscosity_100 : float or str
        :math:`\nu_{40}`, :math:`\nu_{100}`, kinematic viscosity at 40 and 100 degC, m²/s.
    density_15 : float or str, optional
        :math:`\rho_{15}` at 15 degC, kg/m³. Left out: typical of the base oil.
    assumption : str, optional
        What is assumed about an oil whose data are not at hand.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "operation.lubricant"
    section: ClassVar[str] = "lubricant"

    base_oil: BaseOilName
    viscosity_40: Viscosity
    viscosity_100: Viscosity
    density_15: Density | None = None
    assumption: str | None = None

    @model_validator(mode="after")
    def _thinner_when_hot(self) -> Self:
        if self.viscosity_100 >= self.viscosity_40:
            raise InputError(
                f"{self.table}.viscosity_100 is {self.viscosity_100 / _MM2:g} mm^2/s; it must be "
                f"below viscosity_40, {self.viscosity_40 / _MM2:g} mm^2/s"
            )
        return self

    def source(self, key: str) -> Source:
        """Return where a value comes from."""
        if key == "density_15" and self.density_15 is None:
            return self.base.source(key)
        return super().source(key)

    @property
    def base(self) -> BaseOil:
        """The class of its base oil."""
        return find(BaseOil, self.base_oil)

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys of ``[operation]`` hold assumed values, and what was assumed."""
        assumed = {}
        if self.assumption is not None:
            assumed["lubricant"] = self.assumption
        if self.density_15 is None:
            assumed["lubricant.density_15"] = (
                f"{self.base.density_15:g} kg/m^3, typical of {self.base_oil} oil"
            )
        return assumed

    def kinematic_viscosity(self, temperature: Any) -> Any:
        """Kinematic viscosity: lg lg(nu + 0.7) linear in lg T through those at 40 and 100 degC.

        `asperity.gearset.oil` has the formulas, for arrays that may hold nonsense too.

        Parameters
        ----------
        temperature : array_like
            K.

        Returns
        -------
        float or ndarray, shape of ``temperature``
            m2/s.
        """
        nu = oil.kinematic_viscosity(
            temperature - _ZERO_CELSIUS, self.viscosity_40 / _MM2, self.viscosity_100 / _MM2
        )
        return nu * _MM2

    def density(self, temperature: Any) -> Any:
        r"""Density :math:`\rho_{15}/(1 + k_\rho(\theta - 15))`, :math:`\theta` in degC.

        Parameters
        ----------
        temperature : array_like
            K.

        Returns
        -------
        float or ndarray, shape of ``temperature``
            kg/m3.
        """
        own = self.base.density_15 if self.density_15 is None else self.density_15
        return oil.density(temperature - _ZERO_CELSIUS, own, self.base.density_coefficient)

    def dynamic_viscosity(self, temperature: Any) -> Any:
        """Dynamic viscosity: kinematic viscosity times density.

        Parameters
        ----------
        temperature : array_like
            K.

        Returns
        -------
        float or ndarray, shape of ``temperature``
            Pa s.
        """
        return self.kinematic_viscosity(temperature) * self.density(temperature)

    def violations(self, temperature: float) -> list[str]:
        """Return how a temperature in K lies outside what the formulas are valid for.

        Parameters
        ----------
        temperature : float
            K.

        Returns
        -------
        list of str
            A sentence each; empty within.
        """
        nu = self.kinematic_viscosity(temperature) / _MM2
        found = (
            oil.TEMPERATURE.violation(temperature - _ZERO_CELSIUS),
            oil.VISCOSITY.violation(nu),
        )
        return [sentence for sentence in found if sentence is not None]
