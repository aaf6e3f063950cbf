"""Meshes of hexahedra read from the input files of Abaqus and CalculiX, to prove those written."""

import re
from dataclasses import dataclass, field

import numpy as np

from asperity.mesh import HexMesh

# Reference coordinate that each face S1 to S6 of the solvers bounds, as VTK numbers them.
_FACES = (4, 5, 2, 1, 3, 0)


@dataclass
class Read:
    """What a file holds; names are in small letters, numbers count from zero."""

    mesh: HexMesh | None = None
    element: str = ""
    element_sets: dict = field(default_factory=dict)


def read_inp(path, unit="m"):
    """Read nodes, elements, sets and element surfaces of a file whose numbers count from one."""
    found, points, cells = Read(), [], []
    node_sets, face_sets = {}, {}
    for block in re.split(r"^\*(?=\w)", path.read_text(), flags=re.MULTILINE)[1:]:
        head, *lines = block.splitlines()
        keyword, *options = (word.strip() for word in head.split(","))
        said = dict(option.split("=") for option in options)
        words = [word.strip() for line in lines for word in line.split(",") if word.strip()]
        if keyword == "NODE":
            points = np.array(words, float).reshape(-1, 4)[:, 1:]
        elif keyword == "ELEMENT":
            found.element = said["TYPE"]
            nodes = 27 if "27" in found.element else 8
            cells = np.array(words, int).reshape(-1, 1 + nodes)[:, 1:] - 1
            found.element_sets[said["ELSET"]] = np.arange(len(cells))
        elif keyword == "NSET":
            node_sets[said["NSET"]] = np.array(words, int) - 1
        elif keyword == "ELSET":
            found.element_sets[said["ELSET"]] = np.array(words, int) - 1
        elif keyword == "SURFACE":
            pairs = zip(words[::2], words[1::2], strict=True)
            faces = [(int(cell) - 1, _FACES[int(face[1]) - 1]) for cell, face in pairs]
            face_sets[said["NAME"]] = np.array(faces)
    if cells.shape[1] == 27:
        # The middle of the cell comes before those of its faces.
        middle = [20 + face for face in _FACES]
        cells = cells[:, np.argsort([*range(20), 26, *middle])]
    found.mesh = HexMesh(points, cells, node_sets, face_sets, unit)
    return found
