"""Meshes of hexahedra: what they are, and their files.

:Entry: `HexMesh` and `box`.
:Data: none of a case; files of others in `inp`.
:Where: `shape` (functions of hex8 and hex27), `surface`, `polygon`; a file format a module: `vtu`,
    `inp`, `stl`, `glb`, `packed`.
:Tests: `unit/test_mesh_*`.
"""

from asperity.mesh.box import box
from asperity.mesh.hexmesh import HexMesh

__all__ = ["HexMesh", "box"]
