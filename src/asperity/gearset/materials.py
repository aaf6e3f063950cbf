"""What the wheel and the worm are made of, in SI units, each value with its source."""

from collections.abc import Mapping
from typing import Annotated, ClassVar, Literal

from asperity.gearset.library import Sourced
from asperity.units import Quantity

Modulus = Annotated[float, Quantity("Pa", what="a modulus", example="122.6 GPa", gt=0)]
Strength = Annotated[float, Quantity("Pa", what="a stress", example="660 MPa", gt=0)]
Poisson = Annotated[float, Quantity("", what="a ratio", example="0.35", ge=0, lt=0.5)]
Factor = Annotated[float, Quantity("", what="a factor", example="1.1", gt=0)]
Family = Literal["tin bronze", "aluminium bronze", "grey iron", "nodular iron"]
BaseOilName = Literal["mineral", "polyalphaolefin", "polyglycol"]
WheelClass = Literal[
    "phosphor bronze centrifugal",
    "phosphor bronze sand chilled",
    "phosphor bronze sand",
    "grey cast iron",
]
WormClass = Literal["cast iron", "0.4C steel", "0.55C steel", "case-hardened C steel"]
Casting = Literal["sand", "chill", "centrifugal"]


class Material(Sourced):
    r"""What worm and wheel have in common.

    Parameters
    ----------
    name : str
        As it appears in results.
    youngs_modulus : float or str
        :math:`E`, Pa.
    poisson_ratio : float
        :math:`\nu`.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    youngs_modulus: Modulus
    poisson_ratio: Poisson


class WheelMaterial(Material):
    r"""Material of the wheel.

    Parameters
    ----------
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron'}
        Decides on friction and wear in ISO/TR 14521.
    material_factor : float
        :math:`Y_W`.
    pitting_strength : float or str
        :math:`\sigma_{HlimT}`, Pa.
    shear_strength : float or str
        :math:`\tau_{FlimT}`, Pa.
    wear_factor : mapping of str to float
        :math:`W_{ML}` by base oil; 1 for those left out.
    bs721 : str, optional
        Row of BS 721's tables of stress factors; left out where none fits.
    agma6034 : {'sand', 'chill', 'centrifugal'}, optional
        Casting as AGMA 6034 knows it; left out where the alloy is not a bronze.
    """

    table: ClassVar[str] = "gearset.wheel_material"
    section: ClassVar[str] = "wheel"

    family: Family
    material_factor: Factor
    pitting_strength: Strength
    shear_strength: Strength
    wear_factor: Mapping[BaseOilName, Factor] = {}
    bs721: WheelClass | None = None
    agma6034: Casting | None = None

    def avoids(self, base_oil: str) -> bool:
        """Whether practice avoids the pair of it and a base oil, for its wear."""
        return self.family == "aluminium bronze" and base_oil == "polyglycol"


class WormMaterial(Material):
    """Material of the worm.

    Parameters
    ----------
    bs721 : str, optional
        Row and column of BS 721's tables of stress factors; left out where none fits.
    hardened : bool
        Whether the threads are hardened to 58 HRC or more, as AGMA 6034 takes for granted.
    """

    table: ClassVar[str] = "gearset.worm_material"
    section: ClassVar[str] = "worm"

    bs721: WormClass | None = None
    hardened: bool = False
