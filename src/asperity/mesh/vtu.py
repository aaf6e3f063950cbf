"""VTK's XML files: a mesh with data at its nodes and cells (.vtu), a series of them (.pvd)."""

import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import ArrayLike, NDArray

from asperity.errors import InputError
from asperity.files.store import write_atomically, write_text
from asperity.mesh.hexmesh import HexMesh

Data = Mapping[str, ArrayLike]

_CELL_TYPES = {8: 12, 27: 29}
_TYPES = {"f8": "Float64", "f4": "Float32", "i8": "Int64", "i4": "Int32", "u1": "UInt8"}


def write_vtu(
    path: str | os.PathLike[str],
    mesh: HexMesh,
    point_data: Data | None = None,
    cell_data: Data | None = None,
) -> Path:
    """Write a mesh and what is known at its nodes and cells, for ParaView and its kin.

    Data are scalars (n,) or vectors (n, k) a node or a cell; the name should hold the unit.
    Coordinates are written in the mesh's own unit.

    Raises
    ------
    InputError
        An array's length is not the number of nodes or cells, or a value is not finite.
    """
    content = b"".join(_vtu(mesh, point_data or {}, cell_data or {}))
    return write_atomically(path, lambda target: target.write_bytes(content))


def write_series(
    path: str | os.PathLike[str], mesh: HexMesh, frames: Iterable[tuple[float, Data]]
) -> Path:
    """Write a series of meshes with data at their nodes, which ParaView plays as an animation.

    The frames, times in s and data taken one by one as they are written, stand beside `path`,
    usually ``*.pvd``, as ``<stem>_0000.vtu`` and so on. If they end with an exception, `path` names
    those that were written until then. A vector named ``displacement`` is what ParaView warps the
    mesh by.
    """
    path = Path(path)
    entries = []
    try:
        for number, (time, data) in enumerate(frames):
            name = f"{path.stem}_{number:04d}.vtu"
            write_vtu(path.with_name(name), mesh, data)
            entries.append(f'<DataSet timestep="{float(time)!r}" file={quoteattr(name)}/>')
    finally:
        body = "\n".join(
            [
                '<?xml version="1.0"?>',
                '<VTKFile type="Collection" version="0.1">',
                "<Collection>",
                *entries,
                "</Collection>",
                "</VTKFile>",
                "",
            ]
        )
        write_text(path, body)
    return path


def _vtu(mesh: HexMesh, point_data: Data, cell_data: Data) -> Iterator[bytes]:
    count, nodes = mesh.cells.shape
    blocks: list[NDArray[np.generic]] = []
    place = 0

    def declare(name: str, values: NDArray[np.generic]) -> str:
        nonlocal place
        blocks.append(values)
        components = values.shape[1] if values.ndim == 2 else 1
        text = (
            f'<DataArray type="{_TYPES[values.dtype.str[1:]]}" Name={quoteattr(name)} '
            f'NumberOfComponents="{components}" format="appended" offset="{place}"/>\n'
        )
        place += 8 + values.nbytes
        return text

    yield b'<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
    yield b'byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
    yield f'<Piece NumberOfPoints="{len(mesh.points)}" NumberOfCells="{count}">\n'.encode()
    yield f"<Points>\n{declare('Points', mesh.points)}</Points>\n<Cells>\n".encode()
    yield declare("connectivity", mesh.cells.reshape(-1)).encode()
    yield declare("offsets", nodes * np.arange(1, count + 1)).encode()
    yield declare("types", np.full(count, _CELL_TYPES[nodes], np.uint8)).encode()
    yield b"</Cells>\n"
    for section, data, length in [
        ("PointData", point_data, len(mesh.points)),
        ("CellData", cell_data, count),
    ]:
        arrays = [declare(name, _checked(name, data[name], length, section)) for name in data]
        yield f"<{section}>\n{''.join(arrays)}</{section}>\n".encode()
    yield b'</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_'
    for block in blocks:
        yield np.uint64(block.nbytes).astype("<u8").tobytes()
        yield block.astype(block.dtype.newbyteorder("<")).tobytes()
    yield b"\n</AppendedData>\n</VTKFile>\n"


def _checked(name: str, values: ArrayLike, length: int, section: str) -> NDArray[np.generic]:
    array = np.asarray(values)
    if array.dtype.kind not in "biuf":
        raise InputError(f"{section} {name!r} holds {array.dtype}; give numbers")
    if array.ndim not in (1, 2) or len(array) != length:
        raise InputError(f"{section} {name!r} has the shape {array.shape}; give {length} rows")
    if not np.isfinite(array).all():
        raise InputError(f"{section} {name!r} holds a value that is not finite; mask it first")
    if array.dtype.kind == "b":
        array = array.astype(np.uint8)
    elif array.dtype.str[1:] not in _TYPES:
        array = array.astype(np.float64 if array.dtype.kind == "f" else np.int64)
    return np.ascontiguousarray(array)
