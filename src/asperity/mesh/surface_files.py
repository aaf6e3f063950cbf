"""Surfaces as STL (printing, CAD) and as GLB (web pages, presentations)."""

import json
import os
import struct
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from asperity.errors import InputError
from asperity.mesh.surface import Surface
from asperity.store import write_atomically

# The numbers the glTF 2.0 specification gives its own and OpenGL's names.
_FLOAT, _UNSIGNED_INT = 5126, 5125
_VERTICES, _INDICES = 34962, 34963
_TRIANGLES = 4
_JSON, _BINARY = 0x4E4F534A, 0x004E4942
_MOST_TRIANGLES = 2**32 - 1


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


def write_glb(
    path: str | os.PathLike[str], parts: Mapping[str, Surface], *, crease: float = 30.0
) -> Path:
    """Write named surfaces, at least one, as binary glTF 2.0, atomically, shaded between creases.

    A crease is an edge at which two triangles meet that is seen: beyond this angle in degrees. glTF
    counts in metres and has y upwards: the file holds a scale and a turn, the coordinates stay.
    """
    if not parts:
        raise InputError("there is no surface to write; give at least one")
    binary = bytearray()
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []

    def store(values: NDArray[Any], kind: str, target: int, **bounds: list[float]) -> int:
        views.append(
            {
                "buffer": 0,
                "byteOffset": len(binary),
                "byteLength": values.nbytes,
                "target": target,
            }
        )
        component = _FLOAT if target == _VERTICES else _UNSIGNED_INT
        accessors.append(
            {
                "bufferView": len(views) - 1,
                "componentType": component,
                "count": len(values),
                "type": kind,
                **bounds,
            }
        )
        binary.extend(values.tobytes())
        return len(accessors) - 1

    nodes: list[dict[str, Any]] = []
    meshes: list[dict[str, Any]] = []
    for name, part in parts.items():
        corner, normals = _shaded(part, np.cos(np.radians(crease)))
        points = part.points[corner].astype("<f4")
        attributes = {
            "POSITION": store(
                points,
                "VEC3",
                _VERTICES,
                min=points.min(axis=0).tolist(),
                max=points.max(axis=0).tolist(),
            ),
            "NORMAL": store(normals.astype("<f4"), "VEC3", _VERTICES),
        }
        if part.colours is not None:
            linear = part.colours[corner] ** 2.2
            attributes["COLOR_0"] = store(linear.astype("<f4"), "VEC3", _VERTICES)
        order = np.arange(len(corner), dtype="<u4")
        primitive = {
            "attributes": attributes,
            "indices": store(order, "SCALAR", _INDICES),
            "mode": _TRIANGLES,
            "material": 0,
        }
        scale = 1e-3 if part.unit == "mm" else 1.0
        nodes.append({"name": name, "mesh": len(meshes), "scale": [scale] * 3})
        meshes.append({"name": name, "primitives": [primitive]})
    half = float(np.sqrt(0.5))
    turned = {"name": "z up", "rotation": [-half, 0.0, 0.0, half], "children": []}
    turned["children"] = list(range(len(nodes)))
    document = {
        "asset": {"version": "2.0", "generator": "asperity"},
        "scene": 0,
        "scenes": [{"nodes": [len(nodes)]}],
        "nodes": [*nodes, turned],
        "meshes": meshes,
        "materials": [
            {
                "name": "metal",
                "pbrMetallicRoughness": {"metallicFactor": 0.2, "roughnessFactor": 0.6},
            }
        ],
        "buffers": [{"byteLength": len(binary)}],
        "bufferViews": views,
        "accessors": accessors,
    }
    text = json.dumps(document, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON) + text
    chunks += struct.pack("<II", len(binary), _BINARY) + bytes(binary)
    content = struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks
    return write_atomically(path, lambda target: target.write_bytes(content))


def _shaded(surface: Surface, smooth: float) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return the point and the normal of every corner of every triangle.

    A corner's normal is the mean of its point's mean normal and stays that of its own triangle
    where the two differ by more than the crease.
    """
    own = surface.normals()
    corners = surface.triangles
    mean = np.zeros_like(surface.points)
    for column in range(3):
        np.add.at(mean, corners[:, column], own)
    length = np.linalg.norm(mean, axis=1, keepdims=True)
    mean = np.divide(mean, length, out=np.zeros_like(mean), where=length > 0)
    normals = mean[corners]
    sharp = np.einsum("mci,mi->mc", normals, own) < smooth
    normals[sharp] = np.broadcast_to(own[:, None], normals.shape)[sharp]
    # A triangle without area has no normal, and glTF allows none of length 0.
    normals[np.linalg.norm(normals, axis=-1) == 0] = [0.0, 0.0, 1.0]
    return corners.reshape(-1), normals.reshape(-1, 3)
