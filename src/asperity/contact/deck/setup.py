"""What a deck of the block says, whichever program reads it; SI throughout."""

import dataclasses
import functools
from typing import Self

from asperity.casefile import Case
from asperity.contact.normal import NormalLaw, pressure
from asperity.contact.parameters import Block, Contact
from asperity.errors import InputError
from asperity.mesh import HexMesh, box
from asperity.slider.model import Model

GRAVITY = 9.80665
DRIVE_FACE = "right"
"""Face of the block the drive pulls at: the one in front."""

# A rigid plane of 0.1 x 0.1 m under the thesis's block of 0.04 x 0.03 m.
_BASE_OVER_BLOCK = 2.5
_POINTS_OF_RISE = 33
_LONGEST_NUMBER = 20


def numbers(*values: float) -> str:
    """Return numbers with commas between them (one alone: behind it) as both programs read them.

    From a number of more than 20 characters they lose the end, be it the exponent.
    """
    texts = (repr(float(value)) for value in values)
    short = [
        text if len(text) <= _LONGEST_NUMBER else f"{value:.12e}"
        for text, value in zip(texts, values, strict=True)
    ]
    return ", ".join(short) + ("," if len(short) == 1 else "")


@dataclasses.dataclass(frozen=True)
class BlockSetup:
    """The block on its base, made ready to be written; thesis 5.3.1.

    Attributes
    ----------
    name : str
        Of the case.
    model : Model
        Drive, friction and vibration.
    block, contact : Block, Contact
        The tables of the case.
    mass : float
        Of the block, kg.
    """

    name: str
    model: Model
    block: Block
    contact: Contact
    mass: float

    @classmethod
    def from_case(cls, case: Case) -> Self:
        """Gather the tables of a case; [vibration], [solve] and [contact] may be missing.

        Raises
        ------
        InputError
            A table is missing, the block has no mass, or weighs more than its normal force.
        """
        block = case.require(Block)
        contact = case.require(Contact) if Contact.table in case else Contact()
        model = Model.from_case(case)
        mass, force = model.slider.mass, model.slider.normal_force
        if mass is None:
            raise InputError(
                f"{case.source}: slider.mass is missing; it makes the density of the block"
            )
        if mass * GRAVITY >= force:
            raise InputError(
                f"{case.source}: slider.normal_force is {force:g} N, but the block of {mass:g} kg "
                f"weighs {mass * GRAVITY:.4g} N; raise the force or lower slider.mass"
            )
        return cls(case.source, model, block, contact, mass)

    @property
    def density(self) -> float:
        """Of the block, kg/m^3."""
        return self.block.density(self.mass)

    @property
    def load(self) -> float:
        """Pressure on the block's top that brings its weight to the normal force, Pa."""
        return (self.model.slider.normal_force - self.mass * GRAVITY) / self.block.area

    @property
    def mean_pressure(self) -> float:
        """Mean contact pressure, Pa."""
        return self.model.slider.normal_force / self.block.area

    @property
    def base(self) -> float:
        """Edge of the square base, m."""
        return _BASE_OVER_BLOCK * max(self.block.size[:2])

    @functools.cached_property
    def normal(self) -> NormalLaw:
        """Pressure against overclosure."""
        height = self.block.size[2] / self.block.elements[2]
        stiffness = self.contact.normal_stiffness(self.block.youngs_modulus, height)
        if self.contact.normal == "two-stage":
            return NormalLaw.two_stage(stiffness, height)
        return NormalLaw(self.contact.normal, stiffness)

    def pressure_table(self) -> list[tuple[float, float]]:
        """Pressure in Pa and overclosure in m of the two-stage law, point by point."""
        law = self.normal
        rise = law.end - law.start
        overs = [
            0.0,
            *(law.start + rise * i / (_POINTS_OF_RISE - 1) for i in range(_POINTS_OF_RISE)),
        ]
        overs.append(2.0 * law.end)
        return [(float(pressure(over, 0.0, law.parameters)[0]), over) for over in overs]

    def mesh(self, *, halved: bool = False) -> HexMesh:
        """Return the block's mesh; with ``halved`` each 27-node element as eight 8-node ones.

        The nodes are the same either way.
        """
        if self.block.order == 1:
            return box(self.block.size, self.block.elements, 1)
        if halved:
            return box(self.block.size, [2 * count for count in self.block.elements], 1)
        return box(self.block.size, self.block.elements, 2)
