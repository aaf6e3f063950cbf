"""What a worm gearset is: macro-geometry, materials, lubricants and bearings."""

from asperity.gearset.geometry import Geometry
from asperity.gearset.parameters import Gearset

__all__ = ["Gearset", "Geometry"]
