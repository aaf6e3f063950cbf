"""Meshes in the input files of Abaqus and CalculiX: nodes, elements, sets and surfaces."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError, StorageError, choices
from asperity.mesh.hexmesh import HexMesh, Unit
from asperity.store import write_text

ELEMENTS = {"C3D8": 8, "C3D8I": 8, "C3D8R": 8, "C3D27": 27, "C3D27R": 27}
"""Element types by the number of their nodes."""

# Place in VTK's order of each node of an element: the solvers put the cell's middle before those
# of its faces, and number the faces S1 (z = -1), S2 (z = +1), S3 (y = -1), S4 (x = +1), S5, S6.
_FACES = np.array([4, 5, 2, 1, 3, 0])
_ORDER = np.array([*range(20), 26, *(20 + _FACES)])
_PER_LINE = 16
_LONGEST_NUMBER = 20


@dataclass(frozen=True, eq=False)
class InpMesh:
    """What an input file says of its mesh.

    Parameters
    ----------
    mesh : HexMesh
        Nodes and elements in the order of the file; surfaces are its face sets.
    element : str
        Element type, such as ``C3D8I``.
    node_numbers, element_numbers : ndarray of int
        The file's numbers of the mesh's nodes and cells.
    element_sets : mapping of str to ndarray of int
        Named cells of the mesh.
    """

    mesh: HexMesh
    element: str
    node_numbers: NDArray[np.int64]
    element_numbers: NDArray[np.int64]
    element_sets: Mapping[str, NDArray[np.int64]] = field(default_factory=dict)


def mesh_lines(
    mesh: HexMesh,
    element: str | None = None,
    *,
    element_set: str = "body",
    element_sets: Mapping[str, ArrayLike] | None = None,
    first_node: int = 1,
    first_element: int = 1,
) -> Iterator[str]:
    """Yield the lines of an input file that define a mesh, for a deck that holds more.

    Parameters
    ----------
    mesh : HexMesh
        Coordinates are written in the mesh's own unit.
    element : str, optional
        One of `ELEMENTS`; default ``C3D8`` or ``C3D27``. CalculiX has no 27-node element.
    element_set : str
        Name of the set of all elements.
    element_sets : mapping of str to array_like of int, optional
        More named cells.
    first_node, first_element : int
        Numbers of the first node and element; the others follow.

    Yields
    ------
    str
        Lines without their ends.

    Raises
    ------
    InputError
        An element type that is not known or has another number of nodes, or a name the solvers
        do not take.
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


def read_inp(path: str | os.PathLike[str], unit: Unit = "m") -> InpMesh:
    """Read nodes, hexahedra, sets and element surfaces of an input file; the rest is passed over.

    Parameters
    ----------
    path : path
        A flat file: one part, no ``*INCLUDE``. Names come back in small letters, as the solvers
        do not tell large from small.
    unit : {'m', 'mm'}
        Unit of the file's coordinates, which it does not say.

    Returns
    -------
    InpMesh

    Raises
    ------
    InputError
        The file's mesh is not one of 8-node or 27-node hexahedra, or a line makes no sense.
    StorageError
        The file cannot be read.
    """
    try:
        text = Path(path).read_text("utf-8", errors="replace")
    except OSError as error:
        reason = (error.strerror or str(error)).lower()
        raise StorageError(f"{path} cannot be read: {reason}") from error
    reader = _Reader(str(path))
    for keyword, options, rows in _blocks(text, str(path)):
        reader.take(keyword, options, rows)
    return reader.result(unit)


Rows = list[tuple[int, list[str]]]


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


def _blocks(text: str, path: str) -> Iterator[tuple[str, dict[str, str], Rows]]:
    keyword, options, rows = "", {}, []  # type: str, dict[str, str], Rows
    header = False
    for number, raw in enumerate(text.splitlines(), 1):
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if header or line.startswith("*"):
            # A keyword line that ends with a comma goes on in the next.
            parts = [part.strip() for part in line.split(",") if part.strip()]
            if not header:
                if keyword:
                    yield keyword, options, rows
                keyword, options, rows = parts.pop(0).upper(), {}, []
            for part in parts:
                name, _, value = part.partition("=")
                options[name.strip().upper()] = value.strip().strip('"').lower()
            header = line.endswith(",")
            continue
        rows.append((number, [part.strip() for part in line.split(",")]))
    if keyword:
        yield keyword, options, rows


@dataclass
class _Reader:
    path: str
    points: dict[int, list[float]] = field(default_factory=dict)
    cells: dict[int, list[int]] = field(default_factory=dict)
    element: str = ""
    node_sets: dict[str, list[int]] = field(default_factory=dict)
    element_sets: dict[str, list[int]] = field(default_factory=dict)
    surfaces: dict[str, list[tuple[int, int]]] = field(default_factory=dict)

    def take(self, keyword: str, options: Mapping[str, str], rows: Rows) -> None:
        """Take what one keyword and its data lines say."""
        line = rows[0][0] if rows else 0
        if keyword == "*INCLUDE":
            raise self._error(line, "*INCLUDE is not followed; put its text in its place")
        try:
            if keyword == "*NODE":
                self._nodes(options, rows)
            elif keyword == "*ELEMENT":
                self._elements(options, rows)
            elif keyword == "*NSET":
                self._members(self.node_sets, options["NSET"], options, rows)
            elif keyword == "*ELSET":
                self._members(self.element_sets, options["ELSET"], options, rows)
            elif keyword == "*SURFACE" and options.get("TYPE", "element") == "element":
                self._surface(options["NAME"], rows)
        except InputError:
            raise
        except (KeyError, ValueError, IndexError) as error:
            raise self._error(line, f"{keyword} cannot be understood ({error})") from error

    def _error(self, line: int, what: str) -> InputError:
        return InputError(f"{self.path}, line {line}: {what}")

    def _nodes(self, options: Mapping[str, str], rows: Rows) -> None:
        numbers = []
        for line, parts in rows:
            number, *point = int(parts[0]), *map(float, parts[1:4])
            if number in self.points:
                raise self._error(line, f"node {number} is given twice; give a file of one part")
            self.points[number] = [*point, *[0.0] * (3 - len(point))]
            numbers.append(number)
        if "NSET" in options:
            self.node_sets.setdefault(options["NSET"], []).extend(numbers)

    def _elements(self, options: Mapping[str, str], rows: Rows) -> None:
        element = options["TYPE"].upper()
        line = rows[0][0] if rows else 0
        if element not in ELEMENTS:
            raise self._error(line, f"element type {element}; allowed: {choices(ELEMENTS)}")
        if self.element and ELEMENTS[element] != ELEMENTS[self.element]:
            raise self._error(
                line, f"{element} beside {self.element}; allowed: one number of nodes"
            )
        self.element = self.element or element
        values = [int(part) for _, parts in rows for part in parts if part]
        width = 1 + ELEMENTS[element]
        if len(values) % width:
            raise self._error(line, f"elements of {ELEMENTS[element]} nodes are not complete")
        for start in range(0, len(values), width):
            number, *nodes = values[start : start + width]
            if number in self.cells:
                raise self._error(line, f"element {number} is given twice; give a file of one part")
            self.cells[number] = nodes
        if "ELSET" in options:
            self.element_sets.setdefault(options["ELSET"], []).extend(values[::width])

    def _members(
        self, sets: dict[str, list[int]], name: str, options: Mapping[str, str], rows: Rows
    ) -> None:
        members = sets.setdefault(name, [])
        for line, parts in rows:
            words = [part for part in parts if part]
            if "GENERATE" in options:
                first, last, *step = map(int, words)
                members.extend(range(first, last + 1, *step))
                continue
            for word in words:
                if word.lstrip("-").isdigit():
                    members.append(int(word))
                elif word.lower() in sets:
                    members.extend(sets[word.lower()])
                else:
                    raise self._error(line, f"set {word!r} is not defined before it is used")

    def _surface(self, name: str, rows: Rows) -> None:
        faces = self.surfaces.setdefault(name, [])
        for line, parts in rows:
            label = parts[1].upper() if len(parts) > 1 else ""
            if label not in {f"S{number}" for number in range(1, 7)}:
                raise self._error(line, f"face {label!r}; allowed: S1 to S6")
            word = parts[0].lower()
            elements = [int(word)] if word.isdigit() else self.element_sets.get(word)
            if elements is None:
                raise self._error(line, f"element set {word!r} is not defined before it is used")
            faces.extend((number, int(_FACES[int(label[1]) - 1])) for number in elements)

    def result(self, unit: Unit) -> InpMesh:
        """Return the mesh with the file's numbers replaced by places."""
        if not self.points or not self.cells:
            raise InputError(f"{self.path} holds no mesh of hexahedra")
        node = {number: place for place, number in enumerate(self.points)}
        cell = {number: place for place, number in enumerate(self.cells)}

        def places(numbers: Iterable[int], known: dict[int, int], what: str) -> list[int]:
            try:
                return [known[number] for number in numbers]
            except KeyError as error:
                raise InputError(f"{self.path}: {what} {error} is used but not defined") from None

        cells = np.array([places(nodes, node, "node") for nodes in self.cells.values()])
        if cells.shape[1] == 27:
            cells = cells[:, np.argsort(_ORDER)]
        node_sets = {
            name: np.unique(np.array(places(members, node, "node"), np.int64))
            for name, members in self.node_sets.items()
        }
        face_sets = {
            name: np.array(
                [(places([number], cell, "element")[0], face) for number, face in faces], np.int64
            ).reshape(-1, 2)
            for name, faces in self.surfaces.items()
        }
        element_sets = {
            name: np.unique(np.array(places(members, cell, "element"), np.int64))
            for name, members in self.element_sets.items()
        }
        mesh = HexMesh(np.array(list(self.points.values())), cells, node_sets, face_sets, unit)
        return InpMesh(mesh, self.element, np.array(list(node)), np.array(list(cell)), element_sets)
