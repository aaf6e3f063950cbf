"""A steel for shafts: its strength at a size, and what DIN 743 takes of it."""

from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from asperity.errors import InputError
from asperity.gearset.library import Sourced
from asperity.units import Quantity

_Strength = Annotated[float, Quantity("Pa", what="a strength", example="900 MPa", gt=2e7, le=5e9)]


class ShaftSteel(Sourced):
    r"""A steel of shafts.

    Parameters
    ----------
    name : str
        As it appears in results.
    tensile_strength, yield_strength : float or str
        :math:`\sigma_B` and :math:`\sigma_S`, Pa.
    bending_fatigue, torsion_fatigue : float or str, optional
        :math:`\sigma_{bW}` and :math:`\tau_{tW}` of a smooth bar, Pa. Left out: half and three
        tenths of the tensile strength.
    size : {'16 mm', 'as it is'}
        Whether the strengths are those of a quenched and tempered bar of 16 mm, which DIN 743
        lowers for a thicker one, or those of the shaft as it is.
    youngs_modulus : float or str
        Pa.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "shaft_steel"
    section: ClassVar[str] = "shaft_steel"

    tensile_strength: _Strength
    yield_strength: _Strength
    bending_fatigue: _Strength | None = None
    torsion_fatigue: _Strength | None = None
    size: Literal["16 mm", "as it is"] = "16 mm"
    youngs_modulus: Annotated[
        float, Quantity("Pa", what="a modulus", example="206 GPa", gt=1e9, le=1e12)
    ] = 206e9

    @model_validator(mode="after")
    def _ordered(self) -> "ShaftSteel":
        if self.yield_strength > self.tensile_strength:
            raise InputError(
                f"{self.table}.yield_strength is {1e-6 * self.yield_strength:g} MPa; it must not "
                f"exceed tensile_strength, {1e-6 * self.tensile_strength:g} MPa"
            )
        return self

    @property
    def sigma_bw(self) -> float:
        """Bending fatigue strength of a smooth bar, MPa."""
        return 1e-6 * (self.bending_fatigue or 0.5 * self.tensile_strength)

    @property
    def tau_tw(self) -> float:
        """Torsional fatigue strength of a smooth bar, MPa."""
        return 1e-6 * (self.torsion_fatigue or 0.3 * self.tensile_strength)
