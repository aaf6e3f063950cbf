"""Meshes of hexahedra: what they are, and their files."""

from asperity.mesh.box import box
from asperity.mesh.hexmesh import HexMesh

__all__ = ["HexMesh", "box"]
