"""Files read with a bound and written whole or not at all, and labelled results in netCDF."""

import contextlib
import contextvars
import os
import re
import stat
import tempfile
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.errors import InputError, StorageError, plain, shown
from asperity.files.leftovers import remove_leftovers, temporary_beside

if TYPE_CHECKING:
    import xarray


_MOST_BYTES = 16_000_000
_MOST_TOML_BYTES = 1_000_000

# The reader of TOML takes memory by the square of the parts of a dotted key.
_KEY_PART = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_LONG_KEY = re.compile(rf"(?:^|[\[{{,])[ \t]*{_KEY_PART}(?:[ \t]*\.[ \t]*{_KEY_PART}){{16}}", re.M)


_PORTABLE = re.compile(r"[A-Za-z0-9][A-Za-z0-9 _.+-]{0,99}")
_RESERVED = re.compile(r"(?i)(con|prn|aux|nul|com[0-9]|lpt[0-9])(\.|$)")

_inputs: contextvars.ContextVar[set[tuple[int, int]] | None] = contextvars.ContextVar(
    "inputs", default=None
)


@contextlib.contextmanager
def inputs_kept() -> Iterator[None]:
    """Let nothing that is read until the end of the block be written over within it."""
    token = _inputs.set(set())
    try:
        yield
    finally:
        _inputs.reset(token)


def keep_input(path: str | os.PathLike[str]) -> None:
    """Note a file that somebody gave, so that :func:`inputs_kept` keeps it."""
    kept = _inputs.get()
    if kept is not None:
        with contextlib.suppress(OSError, ValueError):
            kept.add(_identity(path))


def _identity(path: str | os.PathLike[str]) -> tuple[int, int]:
    # Of one file under two names, or behind a link, it is the same.
    found = os.stat(path)
    return found.st_dev, found.st_ino


def refuse_input(path: Path) -> None:
    """Refuse to write what is read within :func:`inputs_kept`; raises InputError."""
    try:
        read = _identity(path) in (_inputs.get() or ())
    except (OSError, ValueError):  # there is none
        return
    if read:
        raise InputError(
            f"{plain(str(path))} is read here, and would be written over; choose another --out"
        )


def reason(error: OSError) -> str:
    """Return in a few words why a file cannot be read or written."""
    if isinstance(error, StorageError):
        return str(error)
    return plain((error.strerror or str(error) or type(error).__name__).lower())


def require_no_pipe(path: Path) -> None:
    """Refuse what may keep who reads it waiting for ever."""
    kind = path.stat().st_mode
    if not (stat.S_ISREG(kind) or stat.S_ISDIR(kind)):
        raise StorageError("it is a device or a pipe; save what it holds to a file")


def read_bytes(path: str | os.PathLike[str], most: int = _MOST_BYTES) -> bytes:
    """Return the content of a file that somebody gave.

    Parameters
    ----------
    path : path
        The file.
    most : int
        How many bytes it may have.

    Raises
    ------
    OSError
        It cannot be read, is no regular file (a device or a pipe may never end), or is too large.
    """
    path = Path(path)
    require_no_pipe(path)
    keep_input(path)
    with path.open("rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise StorageError(f"it is larger than {most / 1e6:g} MB")
    return content


def read_text(
    path: str | os.PathLike[str], name: str | None = None, most: int = _MOST_BYTES
) -> str:
    """Return the text of a file that somebody gave, in UTF-8 with or without its mark.

    Parameters
    ----------
    path : path
        The file.
    name : str, optional
        What messages call it, if not by its path.
    most : int
        How many bytes it may have.

    Raises
    ------
    InputError
        One line; its cause is the OSError of :func:`read_bytes` or the ValueError of decoding.
    """
    name = plain(str(path)) if name is None else name
    cause: Exception
    try:
        return read_bytes(path, most).decode("utf-8-sig")
    except OSError as error:
        cause, why = error, reason(error)
        if isinstance(error, IsADirectoryError):
            why = "it is a folder; give a file"
    except UnicodeDecodeError as error:
        cause, why = error, f"byte {error.start} is not UTF-8; save it as UTF-8"
    except ValueError as error:  # a zero byte in the name
        cause, why = error, str(error)
    name = name if len(name) < 200 else f"{name[:197]}..."
    raise InputError(f"{name or repr(name)} cannot be read: {why}") from cause


def read_toml(path: str | os.PathLike[str], name: str | None = None) -> dict[str, Any]:
    """Return the content of a TOML file; arguments and errors as :func:`read_text`."""
    return read_toml_text(path, name)[1]


def read_toml_text(
    path: str | os.PathLike[str], name: str | None = None
) -> tuple[str, dict[str, Any]]:
    """Return the text of a TOML file and its content; as :func:`read_toml`."""
    text = read_text(path, name, _MOST_TOML_BYTES)
    try:
        return text, parse_toml(text)
    except ValueError as error:
        last = f"(at line {len(text.splitlines())}, the last one)"
        why = str(error).replace("(at end of document)", last)
        name = plain(str(path)) if name is None else name
        raise InputError(f"{name}: not valid TOML: {plain(why)}") from None


def parse_toml(text: str) -> dict[str, Any]:
    """Return the content of a text in TOML, read in little memory; raises ValueError."""
    if found := _LONG_KEY.search(text):
        line = text.count("\n", 0, found.end()) + 1
        raise ValueError(f"a key of more than 16 parts (at line {line})")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("its values are nested too deeply") from None
    except tomllib.TOMLDecodeError:
        raise
    except ValueError:
        raise ValueError("a whole number of more digits than can be read") from None


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
    InputError
        It is what the command reads.
    """
    path = Path(path)
    refuse_input(path)
    temporary = temporary_beside(path)
    try:
        write(temporary)
        with temporary.open("rb+") as file:
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except StorageError as error:
        error.args = (str(error).replace(str(temporary), str(path)), *error.args[1:])
        raise
    except OSError as error:
        raise StorageError(f"{path} cannot be written: {reason(error)}") from error
    finally:
        # After the rename there is nothing left to remove; before it, also for an interrupt.
        with contextlib.suppress(OSError):
            temporary.unlink()
    flush_folder(path.parent)
    return path


def stamp(path: Path) -> tuple[int, int, int]:
    """Return what tells a file that was read from one that was changed or put in its place since.

    Raises
    ------
    OSError
        There is no such file.
    """
    found = path.stat()
    # A copy may bring its time of change along, never the other one.
    return found.st_mtime_ns, found.st_ctime_ns, found.st_size


def flush_folder(folder: Path) -> None:
    """Bring what was renamed in a folder to the disk."""
    # The rename itself outlives a power cut only once the folder is on disk; some file systems
    # cannot flush a folder, and the file is complete either way.
    with contextlib.suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)


def portable(name: str) -> bool:
    """Whether a file can be called so on every system, and in an address."""
    plainly = _PORTABLE.fullmatch(name) and not name.endswith((".", " "))
    return bool(plainly) and not _RESERVED.match(name)


def require_portable(name: str) -> None:
    """Refuse a name that a file cannot have on every system."""
    if _RESERVED.match(name):
        raise InputError(f"{shown(name)} is a name that Windows keeps to itself; take another")
    if not portable(name):
        raise InputError(
            f"{shown(name)} is not a name of a file here; take letters, digits, '-', '_', '.'"
        )


def write_text(path: str | os.PathLike[str], text: str) -> Path:
    """Write a text file in UTF-8, atomically."""
    return write_atomically(path, lambda target: target.write_text(text, "utf-8", newline="\n"))


def harmless_cell(value: Any) -> Any:
    """Return what to write to a cell of CSV, so that a spreadsheet takes no text for a formula.

    A text of some length that begins as a formula does, and is no number, gets an apostrophe in
    front; everything else is returned as it is.
    """
    if not isinstance(value, str) or len(value) < 2 or value[0] not in "=+-@\t\r":
        return value
    try:
        float(value)
    except ValueError:
        return f"'{value}"
    return value


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
    encoding: dict[Any, dict[str, Any]] = {}
    for name, variable in dataset.variables.items():
        if variable.dtype.kind == "f":
            # NaN is itself in a file; that it stands for nothing, said of each, takes a third.
            encoding[name] = {"_FillValue": None}
        if variable.ndim and variable.size and variable.dtype.kind in "biuf":
            encoding.setdefault(name, {})["fletcher32"] = True
    # Encoded in memory: on a full disk the HDF5 library leaves a file open that it can neither
    # flush nor close.
    return write_atomically(
        path,
        lambda target: target.write_bytes(dataset.to_netcdf(engine="h5netcdf", encoding=encoding)),
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
        require_no_pipe(Path(path))
        # Met by a file it cannot open, the netCDF reader complains once more when it is collected.
        with h5py.File(path) as file:
            dict(file.attrs)
        # Left as floats: a duration in seconds is a number here, not a calendar's time difference.
        return xarray.load_dataset(
            path, engine="h5netcdf", decode_times=False, decode_timedelta=False
        )
    except FileNotFoundError:
        raise StorageError(f"{path} cannot be read: no such file") from None
    except StorageError as error:
        raise StorageError(f"{path} cannot be read: {error}") from None
    except Exception as error:
        # A damaged file surfaces as whatever the layer that trips over it raises.
        raise StorageError(f"{path} cannot be read: not a netCDF file, or damaged") from error


def require_whole(file: Any, name: str) -> None:
    """Refuse an open HDF5 file of which a part lies in another: whoever made it would say which.

    Raises
    ------
    StorageError
        A link leads out of it, or numbers of it are kept elsewhere.
    """
    import h5py

    for key in file:
        link, part = file.get(key, getlink=True), None
        if isinstance(link, h5py.HardLink):
            part = file[key]
            if isinstance(part, h5py.Group):
                require_whole(part, name)
        if part is None or (isinstance(part, h5py.Dataset) and (part.external or part.is_virtual)):
            raise StorageError(f"{name}: {plain(key)} lies in another file; save a whole one")


def output_folder(path: str | os.PathLike[str]) -> Path:
    """Return a folder that exists and can be written to, created where needed.

    What killed runs left half written in it is removed.

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
        remove_leftovers(folder)
    except OSError as error:
        raise StorageError(
            f"{path} cannot be used as output folder: {reason(error)}; choose another"
        ) from error
    return folder
