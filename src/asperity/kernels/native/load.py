"""Where libraries of kernels stand, and which of their entries may be called here and now.

What does not fit is nobody's fault and costs a compilation: another platform or processor, a kernel
whose sources have changed since, no library at all. Only what a user can mend is told.
"""

import contextlib
import ctypes
import functools
import hashlib
import importlib
import logging
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from asperity.files.store import reason
from asperity.kernels.native import layout, table, target
from asperity.kernels.native.call import Addresses, Caller, Native

_ROOT = Path(__file__).parents[3]
_SHIPPED = Path(__file__).parent / "made"

_log = logging.getLogger(__name__)


def entry(name: str) -> Native | None:
    """Return a kernel's machine code as a function of a tuple; None where Numba has to make it.

    Parameters
    ----------
    name : str
        Full name of the kernel: its module's and its own.
    """
    if not _is_wanted() or "<locals>" in name:
        return None
    for library in (_shipped(), _kept(name)):
        native = library.entry(name) if library is not None else None
        if native is not None:
            return native
    return None


def is_made(name: str, arguments: tuple[Any, ...]) -> bool:
    """Return whether a kernel's machine code for such arguments is there, or is Numba's to make.

    Parameters
    ----------
    name : str
        Full name of the kernel.
    arguments : tuple
        What it is to be called with.
    """
    if not _is_wanted() or "<locals>" in name:
        return True
    shipped, kept = _shipped(), _kept(name)
    is_shipped = shipped is not None and shipped.entry(name) is not None
    return is_shipped or kept is None or kept.is_made(arguments)


class Library:
    """Machine code that is loaded, with the table of what stands in it.

    Parameters
    ----------
    rows : dict
        The table.
    address : callable
        Returns the address of a symbol; it keeps the machine code loaded.
    """

    def __init__(self, rows: dict[str, Any], address: Addresses) -> None:
        self._rows = rows
        self._caller = Caller(address)

    def entry(self, name: str) -> Native | None:
        """Return a kernel; None where it is not here or its sources are others now."""
        row = self._rows["entries"].get(name)
        if row is None:
            return None
        digests = self._rows["sources"]
        if any(_digest(source) != digests[source] for source in row["sources"]):
            return None
        has = target.features()
        fitting = [each for each in row["signatures"] if has.issuperset(each["features"])]
        return self._caller.entry(name, fitting)


def from_folder(folder: Path) -> Library | None:
    """Return the library of a folder; None where it has none for this machine.

    Whether somebody else may have written it is not asked. Where it is damaged it is told.

    Parameters
    ----------
    folder : path
        Where the library and its table stand.
    """
    file = folder / table.LIBRARY
    try:
        rows = checked(folder, [file])
    except table.DamagedError as trouble:
        tell(trouble, "install asperity anew")
        return None
    return None if rows is None else opened(rows, file)


def tell(trouble: table.DamagedError, remedy: str) -> None:
    """Log that something is damaged, and what is to be done, or is."""
    _log.warning("%s: kernels are compiled instead; %s", trouble, remedy)


def checked(folder: Path, files: Sequence[Path]) -> dict[str, Any] | None:
    """Return the table of a folder; None where it has none for this machine.

    Parameters
    ----------
    folder : path
        Where the table stands.
    files : sequence of path
        What the table tells the digest of.

    Raises
    ------
    DamagedError
        One of them, or the table, is not what was written, or cannot be read.
    """
    try:
        rows = table.read(folder)
        if rows is None and files[0].exists() and not (folder / table.TABLE).exists():
            raise table.DamagedError(f"{folder / table.TABLE} is missing")
        if rows is None or not is_for_here(rows["target"], rows["features"]):
            return None
        held = b"".join(file.read_bytes() for file in files)
        if hashlib.sha256(held).hexdigest() != rows["library"]:
            raise table.DamagedError(f"{files[0]} is damaged")
    except OSError as trouble:
        where = trouble.filename or files[0]
        raise table.DamagedError(f"{where} cannot be read ({reason(trouble)})") from trouble
    return rows


def opened(rows: dict[str, Any], file: Path) -> Library | None:
    """Return the library of a table; None where it cannot be loaded here."""
    # What it is linked with may be missing or too old; nothing is run from this disk; or the linker
    # made another thing of what it was given.
    with contextlib.suppress(OSError, AttributeError):
        return Library(rows, _addresses(file))
    return None


def _addresses(file: Path) -> Addresses:
    loaded = ctypes.CDLL(str(file))

    def address(symbol: str) -> int:
        return ctypes.cast(loaded[symbol], ctypes.c_void_p).value or 0

    return address


def _is_wanted() -> bool:
    if os.environ.get("ASPERITY_NATIVE", "") == "0":
        return False
    # Another thread may be loading it.
    config = getattr(sys.modules.get("numba"), "config", None)
    switched_off = getattr(config, "DISABLE_JIT", None)
    if switched_off is not None:
        return not switched_off
    return os.environ.get("NUMBA_DISABLE_JIT", "0") in ("", "0")


@functools.cache
def _shipped() -> Library | None:
    return from_folder(_SHIPPED)


def _kept(name: str) -> Any:
    # By its name, since what is kept is loaded from here.
    return importlib.import_module("asperity.kernels.native.kept").library(name)


def is_for_here(made_for: str, features: Iterable[str]) -> bool:
    """Return whether machine code for a platform and a processor's features runs here."""
    fits = made_for == target.platform_name() and set(features) <= target.features()
    return fits and bool(layout.types())


@functools.cache
def _digest(source: str) -> str | None:
    try:
        return hashlib.sha256((_ROOT / source).read_bytes()).hexdigest()
    except OSError:
        return None
