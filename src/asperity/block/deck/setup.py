"""What a deck of the block says, whichever program reads it; SI throughout."""

import dataclasses
from typing import Self

from asperity.block.parameters import Block
from asperity.block.problem import BlockProblem
from asperity.casefile import Case
from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.mesh import HexMesh, box
from asperity.slider.model import Model

DRIVE_FACE = "right"
"""Face of the block the drive pulls at: the one in front."""

# A rigid plane of 0.1 x 0.1 m under the thesis's block of 0.04 x 0.03 m.
_BASE_OVER_BLOCK = 2.5
_POINTS_OF_RISE = 33
_MOST_OVER_MEAN = 100.0


@dataclasses.dataclass(frozen=True)
class BlockSetup:
    """The block on its base, made ready to be written; thesis 5.3.1."""

    name: str  #: Of the case
    problem: BlockProblem  #: The block as the package itself solves it

    @classmethod
    def from_case(cls, case: Case) -> Self:
        """Gather the tables of a case; [vibration], [solve] and [contact] may be missing.

        Raises
        ------
        InputError
            A table is missing, the block has no mass, or weighs more than its normal force.
        """
        return cls(case.source, BlockProblem.from_case(case))

    @property
    def model(self) -> Model:
        """Drive, friction and vibration."""
        return self.problem.model

    @property
    def block(self) -> Block:
        """Size, material and elements."""
        return self.problem.block

    @property
    def normal(self) -> NormalLaw:
        """Pressure against overclosure."""
        return self.problem.normal

    @property
    def density(self) -> float:
        """Of the block, kg/m^3."""
        return self.problem.material.density

    @property
    def held(self) -> tuple[int, ...]:
        """Mean motions that a rigid drive and a guide hold: 0 to 2 shifts, 3 to 5 turns."""
        slider = self.model.slider
        return (*((0,) if slider.rigid else ()), *(() if slider.free else (1, 3, 4, 5)))

    @property
    def base(self) -> float:
        """Edge of the square base, m."""
        return _BASE_OVER_BLOCK * max(self.block.size[:2])

    def pressure_table(self) -> list[tuple[float, float]]:
        """Pressure in Pa and overclosure in m of the two-stage law, point by point.

        Up to where no block should come, as what lies beyond is not the same in all programs.
        """
        law = self.normal
        most = max(2.0 * law.end, law.overclosure(_MOST_OVER_MEAN * self.problem.mean_pressure))
        rise = (law.end - law.start) / (_POINTS_OF_RISE - 1)
        overs = [law.start + rise * i for i in range(_POINTS_OF_RISE)]
        overs = [*([0.0] if law.start > 0.0 else []), *overs, most]
        return [(float(pressure(over, 0.0, law.numbers)[0]), over) for over in overs]

    def eight_node_mesh(self) -> HexMesh:
        """Return the block's mesh, of each 27-node element eight 8-node ones on the same nodes."""
        block = self.block
        return box(block.size, [block.order * count for count in block.elements], 1)
