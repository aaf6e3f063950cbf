"""Files written whole or not at all, and labelled results in netCDF."""

import contextlib
import os
import secrets
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from asperity.errors import StorageError

if TYPE_CHECKING:
    import xarray


def _reason(error: OSError) -> str:
    return (error.strerror or str(error).splitlines()[0] or type(error).__name__).lower()


def write_atomically(path: str | os.PathLike[str], write: Callable[[Path], object]) -> Path:
    """Write a file so that it is either the old one or the whole new one, never a part.

    Parameters
    ----------
    path : path
        The file to write; its folder must exist.
    write : callable
        Writes to the path it is given, which has the suffix of `path`.

    Returns
    -------
    pathlib.Path
        `path`.

    Raises
    ------
    StorageError
        The file cannot be written: full disk, no permission, no such folder, ...
    """
    path = Path(path)
    # The suffix stays, because drawing libraries choose the format by it.
    temporary = path.with_name(f".{path.stem[:80]}-{secrets.token_hex(6)}{path.suffix}")
    try:
        write(temporary)
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except StorageError:
        raise
    except OSError as error:
        raise StorageError(f"{path} cannot be written: {_reason(error)}") from error
    finally:
        # After the rename there is nothing left to remove; before it, also for an interrupt.
        with contextlib.suppress(OSError):
            temporary.unlink()
    _flush_folder(path.parent)
    return path


def _flush_folder(folder: Path) -> None:
    # The rename itself outlives a power cut only once the folder is on disk; some file systems
    # cannot flush a folder, and the file is complete either way.
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def write_text(path: str | os.PathLike[str], text: str) -> Path:
    """Write a text file in UTF-8, atomically."""
    return write_atomically(path, lambda target: target.write_text(text, "utf-8", newline="\n"))


def write_dataset(dataset: "xarray.Dataset", path: str | os.PathLike[str]) -> Path:
    """Write a labelled result as netCDF-4, atomically, numbers with a checksum.

    Raises
    ------
    ValueError
        A variable or coordinate lacks ``units`` or ``long_name``.
    StorageError
        The file cannot be written.
    """
    for name, variable in dataset.variables.items():
        missing = [label for label in ("units", "long_name") if label not in variable.attrs]
        if missing:
            raise ValueError(f"{name} has no {' and no '.join(missing)}; every variable needs both")
    checked = {
        name: {"fletcher32": True}
        for name, variable in dataset.variables.items()
        if variable.ndim and variable.size and variable.dtype.kind in "biuf"
    }
    # Encoded in memory: on a full disk the HDF5 library leaves a file open that it can neither
    # flush nor close.
    return write_atomically(
        path,
        lambda target: target.write_bytes(dataset.to_netcdf(engine="h5netcdf", encoding=checked)),
    )


def read_dataset(path: str | os.PathLike[str]) -> "xarray.Dataset":
    """Read a labelled result into memory.

    Raises
    ------
    StorageError
        There is no such file, or it is not netCDF or damaged.
    """
    import h5py
    import xarray

    try:
        # Met by a file it cannot open, the netCDF reader complains once more when it is collected.
        with h5py.File(path) as file:
            dict(file.attrs)
        # Left as floats: a duration in seconds is a number here, not a calendar's time difference.
        return xarray.load_dataset(
            path, engine="h5netcdf", decode_times=False, decode_timedelta=False
        )
    except FileNotFoundError:
        raise StorageError(f"{path} cannot be read: no such file") from None
    except Exception as error:
        # A damaged file surfaces as whatever the layer that trips over it raises.
        raise StorageError(f"{path} cannot be read: not a netCDF file, or damaged") from error


def output_folder(path: str | os.PathLike[str]) -> Path:
    """Return a folder that exists and can be written to, created where needed.

    Raises
    ------
    StorageError
        It cannot be created or written to, or is a file.
    """
    folder = Path(path)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise StorageError(
            f"{path} cannot be used as output folder: {_reason(error)}; choose another"
        ) from error
    return folder
