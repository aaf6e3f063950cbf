"""Scenes as binary glTF 2.0 (GLB), for web pages, mails and presentations."""

import json
import math
import os
import struct
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from asperity.errors import InputError
from asperity.files.store import write_atomically
from asperity.mesh.surface import Surface

# The numbers the glTF 2.0 specification gives its own and OpenGL's names.
_FLOAT, _UNSIGNED_SHORT, _UNSIGNED_INT = 5126, 5123, 5125
_VERTICES, _INDICES = 34962, 34963
_TRIANGLES = 4
_JSON, _BINARY = 0x4E4F534A, 0x004E4942
_MOST_SHORT = 65_535
# Less than half a turn between two keys, or it would be turned the other way.
_TURN_OF_A_KEY = 0.25
_METAL = {"metallicFactor": 0.2, "roughnessFactor": 0.6}
# Directions that agree so far are one.
_DIGITS = 5
# Cosine of the angle beyond which an edge is seen.
_SMOOTH = math.cos(math.radians(30.0))


@dataclass(frozen=True, eq=False)
class Node:
    """Something in a scene: a surface, further nodes, or both, and where they stand.

    Attributes
    ----------
    name : str
        As it appears in viewers.
    surface : Surface, optional
        Stored once, however many nodes have it. All of a scene are in one unit.
    rotation : ndarray, shape (3, 3)
        The matrix that turns it, before it is shifted.
    place : ndarray, shape (3,)
        Where its origin stands, in the unit of the surfaces.
    children : sequence of Node
        What moves along with it.
    turns : float
        How often it turns about its own z axis in the scene's cycle; it stands still for 0.
    colour : tuple of float
        Red, green and blue, 0 to 1, of a surface without colours of its own.
    """

    name: str
    surface: Surface | None = None
    rotation: NDArray[np.float64] = field(default_factory=lambda: np.eye(3))
    place: NDArray[np.float64] = field(default_factory=lambda: np.zeros(3))
    children: "Sequence[Node]" = ()
    turns: float = 0.0
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)


def write_glb(path: str | os.PathLike[str], nodes: Sequence[Node], *, seconds: float = 4.0) -> Path:
    """Write nodes, at least one, as a scene, atomically, shaded between creases.

    A crease is an edge at which two triangles meet that is seen: beyond 30 degrees. glTF
    counts in metres and has y upwards: the file holds a scale and a turn, the coordinates stay.
    Nodes that turn have an animation that goes through the scene's cycle in so many ``seconds``.
    """
    if not nodes:
        raise InputError("there is no surface to write; give at least one")
    scene = _Scene(seconds)
    children = [scene.node(node) for node in nodes]
    if len(scene.units) != 1:
        raise InputError("a scene needs surfaces, all of one unit")
    scale = 1e-3 if scene.units == {"mm"} else 1.0
    half = math.sqrt(0.5)
    root = {"name": "z up", "rotation": [-half, 0.0, 0.0, half], "scale": [scale] * 3}
    scene.nodes.append(root | {"children": children})
    text = json.dumps(scene.document(), separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON) + text
    chunks += struct.pack("<II", len(scene.binary), _BINARY) + bytes(scene.binary)
    content = struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks
    return write_atomically(path, lambda target: target.write_bytes(content))


class _Scene:
    """What a file holds, as it grows."""

    def __init__(self, seconds: float) -> None:
        self.binary = bytearray()
        self.nodes: list[dict[str, Any]] = []
        self.units: set[str] = set()
        self._seconds = seconds
        self._views: list[dict[str, Any]] = []
        self._accessors: list[dict[str, Any]] = []
        self._meshes: list[dict[str, Any]] = []
        self._materials: list[dict[str, Any]] = []
        self._channels: list[dict[str, Any]] = []
        self._samplers: list[dict[str, Any]] = []
        # A surface is kept as well, since another one could be given its identity.
        self._known: dict[tuple[int, Any], tuple[int, Surface]] = {}

    def document(self) -> dict[str, Any]:
        """Return what the file says of its binary part."""
        found: dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "asperity"},
            "scene": 0,
            "scenes": [{"nodes": [len(self.nodes) - 1]}],
            "nodes": self.nodes,
            "meshes": self._meshes,
            "materials": self._materials,
            "buffers": [{"byteLength": len(self.binary)}],
            "bufferViews": self._views,
            "accessors": self._accessors,
        }
        if self._channels:
            turning = {"name": "turning", "channels": self._channels, "samplers": self._samplers}
            found["animations"] = [turning]
        return found

    def node(self, node: Node) -> int:
        """Add a node and what is below it; returns its number."""
        made: dict[str, Any] = {"name": node.name}
        if not np.array_equal(node.rotation, np.eye(3)):
            made["rotation"] = Rotation.from_matrix(node.rotation).as_quat().tolist()
        if np.any(node.place):
            made["translation"] = np.asarray(node.place, dtype=float).tolist()
        if node.surface is not None:
            made["mesh"] = self._mesh(node.name, node.surface, node.colour)
        if node.children:
            made["children"] = [self.node(child) for child in node.children]
        self.nodes.append(made)
        number = len(self.nodes) - 1
        if node.turns:
            self._turn(number, node)
        return number

    def _turn(self, number: int, node: Node) -> None:
        keys = 1 + math.ceil(abs(node.turns) / _TURN_OF_A_KEY)
        share = np.linspace(0.0, 1.0, keys)
        about = np.zeros((keys, 3))
        about[:, 2] = 2.0 * math.pi * node.turns * share
        turned = Rotation.from_matrix(node.rotation) * Rotation.from_rotvec(about)
        times = (self._seconds * share).astype("<f4")
        bounds = {"min": [0.0], "max": [float(times[-1])]}
        sampler = {
            "input": self._store(times, "SCALAR", None, bounds),
            "output": self._store(turned.as_quat().astype("<f4"), "VEC4", None),
        }
        self._samplers.append(sampler)
        target = {"node": number, "path": "rotation"}
        self._channels.append({"sampler": len(self._samplers) - 1, "target": target})

    def _mesh(self, name: str, surface: Surface, colour: tuple[float, float, float]) -> int:
        known = self._known.get((id(surface), colour))
        if known is not None:
            return known[0]
        self.units.add(surface.unit)
        corner, normals = _shaded(surface)
        # Corners that share point and normal are one vertex.
        keys = np.column_stack([corner, np.round(normals, _DIGITS) + 0.0])
        _, first, order = np.unique(keys, axis=0, return_index=True, return_inverse=True)
        points = surface.points[corner[first]].astype("<f4")
        bounds = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
        attributes = {
            "POSITION": self._store(points, "VEC3", _VERTICES, bounds),
            "NORMAL": self._store(normals[first].astype("<f4"), "VEC3", _VERTICES),
        }
        if surface.colours is not None:
            linear = surface.colours[corner[first]] ** 2.2
            attributes["COLOR_0"] = self._store(linear.astype("<f4"), "VEC3", _VERTICES)
        short = len(first) <= _MOST_SHORT
        indices = np.ravel(order).astype("<u2" if short else "<u4")
        primitive = {
            "attributes": attributes,
            "indices": self._store(indices, "SCALAR", _INDICES),
            "mode": _TRIANGLES,
            "material": self._material(colour),
        }
        self._meshes.append({"name": name, "primitives": [primitive]})
        self._known[id(surface), colour] = len(self._meshes) - 1, surface
        return len(self._meshes) - 1

    def _material(self, colour: tuple[float, float, float]) -> int:
        linear = [*(shade**2.2 for shade in colour), 1.0]
        made = {"name": "metal", "pbrMetallicRoughness": {"baseColorFactor": linear, **_METAL}}
        if made not in self._materials:
            self._materials.append(made)
        return self._materials.index(made)

    def _store(
        self,
        values: NDArray[Any],
        kind: str,
        target: int | None,
        bounds: dict[str, list[float]] | None = None,
    ) -> int:
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        view = {"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes}
        self._views.append(view if target is None else view | {"target": target})
        component = {"f": _FLOAT, "H": _UNSIGNED_SHORT, "I": _UNSIGNED_INT}[values.dtype.char]
        accessor = {
            "bufferView": len(self._views) - 1,
            "componentType": component,
            "count": len(values),
            "type": kind,
        }
        self._accessors.append(accessor | (bounds or {}))
        self.binary.extend(values.tobytes())
        self.binary.extend(b"\0" * (-len(self.binary) % 4))
        return len(self._accessors) - 1


def _shaded(surface: Surface) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the point and the normal of every corner of every triangle.

    A corner's normal is the mean of its point's mean normal and stays that of its own triangle
    where the two differ too much.
    """
    own = surface.normals()
    corners = surface.triangles
    mean = np.zeros_like(surface.points)
    for column in range(3):
        np.add.at(mean, corners[:, column], own)
    length = np.linalg.norm(mean, axis=1, keepdims=True)
    mean = np.divide(mean, length, out=np.zeros_like(mean), where=length > 0)
    normals = mean[corners]
    sharp = np.einsum("mci,mi->mc", normals, own) < _SMOOTH
    normals[sharp] = np.broadcast_to(own[:, None], normals.shape)[sharp]
    # A triangle without area has no normal, and glTF allows none of length 0.
    normals[np.linalg.norm(normals, axis=-1) == 0] = [0.0, 0.0, 1.0]
    return corners.reshape(-1), normals.reshape(-1, 3)
