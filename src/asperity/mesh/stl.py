"""Surfaces as binary STL, for printing and CAD."""

import os
import struct
from pathlib import Path

import numpy as np

from asperity.files.store import write_atomically
from asperity.mesh.surface import Surface


def write_stl(path: str | os.PathLike[str], surface: Surface) -> Path:
    """Write a surface as binary STL, atomically, in its own coordinates: STL knows no unit."""
    facet = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    facets = np.zeros(len(surface.triangles), facet)
    facets["normal"] = surface.normals()
    facets["corners"] = surface.points[surface.triangles]
    # The word "solid" at the start would make readers take the file for text.
    header = f"binary STL, lengths in {surface.unit}".encode().ljust(80, b" ")
    content = header + struct.pack("<I", len(facets)) + facets.tobytes()
    return write_atomically(path, lambda target: target.write_bytes(content))
