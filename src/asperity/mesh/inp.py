"""Meshes in the input files of Abaqus and CalculiX: nodes, elements, sets and surfaces."""

import os
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from asperity.errors import InputError, choices
from asperity.files.store import write_text
from asperity.mesh.hexmesh import HexMesh

ELEMENTS = {"C3D8": 8, "C3D8I": 8, "C3D8R": 8, "C3D27": 27, "C3D27R": 27}
"""Element types by the number of their nodes."""

# Place in VTK's order of each node of an element: the solvers put the cell's middle before those
# of its faces, and number the faces S1 (z = -1), S2 (z = +1), S3 (y = -1), S4 (x = +1), S5, S6.
_FACES = np.array([4, 5, 2, 1, 3, 0])
_ORDER = np.array([*range(20), 26, *(20 + _FACES)])
_PER_LINE = 16
_LONGEST_NUMBER = 20


def mesh_lines(
    mesh: HexMesh,
    element: str | None = None,
    *,
    element_set: str = "body",
    element_sets: Mapping[str, ArrayLike] | None = None,
    first_node: int = 1,
    first_element: int = 1,
) -> Iterator[str]:
    """Yield the lines that define a mesh, in its own unit, in an input file that holds more.

    The element type is one of `ELEMENTS`, by default ``C3D8`` or ``C3D27``; CalculiX has no 27-node
    element. ``element_set`` names all elements, ``element_sets`` more cells; nodes and elements are
    numbered from the first ones given.

    Raises
    ------
    InputError
        An element type that is not known or has another number of nodes, or a name the solvers do
        not
        take.
    """
    nodes = mesh.cells.shape[1]
    element = element or f"C3D{nodes}"
    if ELEMENTS.get(element) != nodes:
        allowed = choices(name for name, count in ELEMENTS.items() if count == nodes)
        raise InputError(f"element is {element!r}; {nodes}-node cells allow {allowed}")
    more = {name: np.asarray(cells) for name, cells in (element_sets or {}).items()}
    for name in (element_set, *more, *mesh.node_sets, *mesh.face_sets):
        if not re.fullmatch(r"[A-Za-z_][A-Za-z0-9_\-]{0,79}", name):
            raise InputError(
                f"{name!r} cannot name a set; allowed: a letter, then letters, digits, - and _"
            )
    yield "*NODE"
    for number, point in enumerate(mesh.points.tolist(), first_node):
        yield f"{number}, {', '.join(map(_number, point))}"
    yield f"*ELEMENT, TYPE={element}, ELSET={element_set}"
    cells = mesh.cells if nodes == 8 else mesh.cells[:, _ORDER]
    for number, cell in enumerate((cells + first_node).tolist(), first_element):
        yield from _wrapped([number, *cell])
    for name, members in mesh.node_sets.items():
        yield f"*NSET, NSET={name}"
        yield from _listed((members + first_node).tolist())
    for name, members in more.items():
        yield f"*ELSET, ELSET={name}"
        yield from _listed((members + first_element).tolist())
    label = np.argsort(_FACES) + 1
    for name, faces in mesh.face_sets.items():
        yield f"*SURFACE, TYPE=ELEMENT, NAME={name}"
        for cell, face in faces.tolist():
            yield f"{cell + first_element}, S{label[face]}"


def write_inp(
    path: str | os.PathLike[str],
    mesh: HexMesh,
    element: str | None = None,
    *,
    element_sets: Mapping[str, ArrayLike] | None = None,
) -> Path:
    """Write a mesh as an input file of Abaqus or CalculiX, atomically; see `mesh_lines`."""
    heading = ["*HEADING", f"mesh of hexahedra, lengths in {mesh.unit}"]
    lines = [*heading, *mesh_lines(mesh, element, element_sets=element_sets), ""]
    return write_text(path, "\n".join(lines))


def numbers(*values: float) -> str:
    """Return numbers with commas between them (one alone: behind it) as both programs read them.

    From a number of more than 20 characters they lose the end, be it the exponent.
    """
    texts = (repr(float(value)) for value in values)
    short = [
        text if len(text) <= _LONGEST_NUMBER else f"{value:.12e}"
        for text, value in zip(texts, values, strict=True)
    ]
    return ", ".join(short) + ("," if len(short) == 1 else "")


def _number(value: float) -> str:
    # The solvers read no more than 20 characters of a number.
    text = repr(value)
    return text if len(text) <= _LONGEST_NUMBER else f"{value:.13e}"


def _wrapped(numbers: list[int]) -> Iterator[str]:
    texts = list(map(str, numbers))
    for start in range(0, len(texts), _PER_LINE):
        line = ", ".join(texts[start : start + _PER_LINE])
        yield line + ("," if start + _PER_LINE < len(texts) else "")


def _listed(numbers: list[int]) -> Iterator[str]:
    for start in range(0, len(numbers), _PER_LINE):
        yield ", ".join(map(str, numbers[start : start + _PER_LINE]))
