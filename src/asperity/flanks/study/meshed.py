"""The mesh of a tooth, and how good it is."""

import numpy as np

from asperity.mesh import HexMesh
from asperity.results import Quantities, quantity


class ToothMesh(Quantities):
    """One tooth with its share of the rim in mm, and how good its hexahedra are.

    Attributes
    ----------
    hexahedra : HexMesh
        Nodes and cells, mm.
    """

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
        """Return a mesh with its quality; the density as it was asked for, the size in mm.

        Parameters
        ----------
        hexahedra : HexMesh
            Nodes and cells, mm.
        density : str
            As it was asked for.
        element_size : float
            On the flank, mm.

        Returns
        -------
        ToothMesh
            With the least and the median scaled Jacobian, and the volume in mm3.
        """
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
