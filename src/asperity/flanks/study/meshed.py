"""The mesh of a tooth, and how good it is."""

import numpy as np

from asperity.mesh import HexMesh
from asperity.results import Quantities, quantity


class ToothMesh(Quantities):
    """One tooth with its share of the rim in mm, and how good its hexahedra are."""

    density: str = quantity("", "", "density", shown=False)
    element_size: float = quantity("", "mm", "element size on the flank")
    nodes: int = quantity("", "", "nodes")
    elements: int = quantity("", "", "elements")
    scaled_jacobian_min: float = quantity("", "", "scaled Jacobian, least")
    scaled_jacobian_median: float = quantity("", "", "scaled Jacobian, median")
    volume: float = quantity("", "mm3", "volume", shown=False)
    hexahedra: HexMesh

    @classmethod
    def of(cls, hexahedra: HexMesh, density: str, element_size: float) -> "ToothMesh":
        """Return a mesh with its quality; the density as it was asked for, the size in mm."""
        quality = hexahedra.scaled_jacobian()
        return cls(
            density=density,
            element_size=element_size,
            nodes=len(hexahedra.points),
            elements=len(hexahedra.cells),
            scaled_jacobian_min=float(quality.min()),
            scaled_jacobian_median=float(np.median(quality)),
            volume=hexahedra.volume(),
            hexahedra=hexahedra,
        )
