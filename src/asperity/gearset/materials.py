"""What the wheel and the worm are made of, in SI units, each value with its source."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.errors import InputError
from asperity.gearset.library import Sourced, every, find, resolve
from asperity.sources import Source, weakest
from asperity.units import Quantity

Modulus = Annotated[float, Quantity("Pa", what="a modulus", example="122.6 GPa", gt=0)]
Strength = Annotated[float, Quantity("Pa", what="a stress", example="660 MPa", gt=0)]
Poisson = Annotated[float, Quantity("", what="a ratio", example="0.35", ge=0, lt=0.5)]
Hardness = Annotated[float, Quantity("", what="a Brinell hardness", example="150", gt=0, le=1000)]
Factor = Annotated[float, Quantity("", what="a factor", example="1.1", gt=0)]
Family = Literal["tin bronze", "aluminium bronze", "grey iron", "nodular iron", "plastic"]
BaseOilName = Literal["mineral", "polyalphaolefin", "polyglycol"]
WheelClass = Literal[
    "phosphor bronze centrifugal",
    "phosphor bronze sand chilled",
    "phosphor bronze sand",
    "grey cast iron",
]
WormClass = Literal["cast iron", "0.4C steel", "0.55C steel", "case-hardened C steel"]
Casting = Literal["sand", "chill", "centrifugal"]


# Of a hardness of 1: a kilogram-force on a square millimetre, Pa.
_BRINELL = 9.80665e6


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
    family : {'tin bronze', 'aluminium bronze', 'grey iron', 'nodular iron', 'plastic'}
        Decides on friction and wear in ISO/TR 14521, which knows no plastics: those are in tables
        of their own, `asperity.gearset.plastics.Plastic`.
    material_factor : float
        :math:`Y_W`.
    pitting_strength : float or str
        :math:`\sigma_{HlimT}`, Pa.
    shear_strength : float or str
        :math:`\tau_{FlimT}`, Pa.
    wear_factor : mapping of str to float
        :math:`W_{ML}` by base oil; 1 for those left out.
    brinell_hardness : float, optional
        HBW; decides at which pressure an edge flows. Left out: it stays elastic.
    bs721 : str, optional
        Row of BS 721's tables of stress factors; left out where none fits.
    agma6034 : {'sand', 'chill', 'centrifugal'}, optional
        Casting as AGMA 6034 knows it; left out where the alloy is not a bronze.
    own : Plastic, optional
        The table of a plastic, which comes from a data file alone.
    """

    table: ClassVar[str] = "gearset.wheel_material"
    section: ClassVar[str] = "wheel"
    also: ClassVar[str] = "plastic"

    family: Family
    material_factor: Factor
    pitting_strength: Strength
    shear_strength: Strength
    wear_factor: Mapping[BaseOilName, Factor] = {}
    brinell_hardness: Hardness | None = None
    bs721: WheelClass | None = None
    agma6034: Casting | None = None
    own: Annotated[Any, Field(exclude=True)] = None

    @model_validator(mode="after")
    def _of_plastic(self) -> "WheelMaterial":
        if (self.family == "plastic") != hasattr(self.own, "bears"):
            raise InputError(
                f"{self.table}.family is {self.family!r}; a plastic is named by its own table of "
                "a data file: asperity new plastic begins one"
            )
        return self

    def require_covered(self, standard: str) -> None:
        """Refuse a standard that does not know of its kind.

        Parameters
        ----------
        standard : str
            Its name.

        Raises
        ------
        InputError
            It is a plastic, which none covers.
        """
        if self.family == "plastic":
            raise InputError(
                f"{self.table} is {self.name!r}, a plastic, which {standard} does not cover: "
                "asperity rate judges it by its own table"
            )

    @property
    def flow_pressure(self) -> float | None:
        """Pressure at which a contact flows: the Brinell hardness as a pressure, Pa."""
        return None if self.brinell_hardness is None else _BRINELL * self.brinell_hardness

    def avoids(self, base_oil: str) -> bool:
        """Whether practice avoids the pair of it and a base oil, for its wear.

        Parameters
        ----------
        base_oil : str
            As of the lubricant.

        Returns
        -------
        bool
            True of aluminium bronze in polyglycol.
        """
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
    also: ClassVar[str] = "steel"

    bs721: WormClass | None = None
    hardened: bool = False

    @property
    def taken_for(self) -> Source | None:
        """What it was taken for and by whom, where it was named by its steel; else None."""
        return self.sources.get("name")


class Steel(Sourced):
    """Steels of worms and the class each is taken for.

    Parameters
    ----------
    name : str
        Its name by the standard of the steel.
    number : str
        Its material number.
    worm : str
        The worm material that stands for it.
    treatment : str
        What it is taken to have undergone.
    """

    table: ClassVar[str] = "gearset.worm_material"
    section: ClassVar[str] = "steel"

    number: str
    worm: str
    treatment: str

    def as_worm(self) -> WormMaterial:
        """Return the material of its class; raises InputError if there is no such class."""
        try:
            worm = find(WormMaterial, self.worm)
        except InputError as error:
            raise InputError(f"steel.{self.name}.worm is {self.worm!r}; {error}") from None
        said = f"{self.name} ({self.number}) is taken for {self.worm}, {self.treatment}"
        mine = self.source("worm")
        # What the class decides is trusted no more than the choice of the class.
        chosen = {
            key: Source(own.name, weakest(own, mine).confidence, said)
            for key, own in ((key, worm.source(key)) for key in ("bs721", "hardened"))
        }
        named = {"name": Source(mine.name, mine.confidence, said)}
        return worm.model_copy(
            update={"name": self.name, "sources": {**worm.sources, **chosen, **named}}
        )


def worm_material(value: object, context: Any = None) -> WormMaterial:
    """Return what a name, a steel's name or number, or an inline table of a case stands for."""
    if isinstance(value, float):
        raise InputError(
            f"{WormMaterial.table} is {value:g}; a steel's number is text, in quotes as '1.7131', "
            "and otherwise it must be a name or a table of values"
        )
    steel = _steel(value) if isinstance(value, str) else None
    return resolve(WormMaterial, value, context) if steel is None else steel.as_worm()


def _steel(name: str) -> Steel | None:
    try:
        find(WormMaterial, name)
    except InputError:
        return next((steel for steel in every(Steel) if name in (steel.name, steel.number)), None)
    return None
