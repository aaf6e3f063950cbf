"""Compiled kernels, cached on disk under a name made from the sources they follow from.

Numba recompiles a function when the file it stands in changes, but not when a function it calls
from another file does: it would answer with yesterday's code. Here a change to a kernel's module or
to any that it imports, to Numba or to NumPy leads to another cache folder, and nothing else does:
not a change elsewhere, nor another place on the disk.
"""

import contextlib
import functools
import hashlib
import os
import pickle
import re
import shutil
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, overload

import llvmlite.binding
import numba
import numpy as np
from numba.core import caching

from asperity.closure import closure, digest_of
from asperity.folders import cache_folder

_KEPT_DAYS = 30
_DIGEST_BYTES = 32

# Numba finds the types of a kernel at its first call; there is nothing to check before.
Kernel = Callable[..., Any]


def kernel_key(module: str, file: Path) -> str:
    """Return what machine code follows from: a module and its imports, Numba, NumPy, processor."""
    sources = closure(module, file=file)
    root = file.parents[module.count(".")] if "." in module else file.parent
    parts = (digest_of(sources, root), *machine())
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


@functools.cache
def machine() -> tuple[str, ...]:
    """Return versions of Numba and NumPy and the processor's name, on which last bits depend."""
    return numba.__version__, np.__version__, llvmlite.binding.get_host_cpu_name()


def _kernel_folder(key: str) -> Path | None:
    environment = os.environ.get("ASPERITY_CACHE"), os.environ.get("XDG_CACHE_HOME")
    kernels = _kernels(*environment)
    if kernels is None:
        return None
    folder = kernels / key
    try:
        folder.mkdir(exist_ok=True)
        os.utime(folder)
    except OSError:
        return None
    return folder


@functools.cache
def _kernels(base: str | None, xdg: str | None) -> Path | None:
    # The arguments are what the answer depends on; they make it once per process and setting.
    folder = cache_folder("kernels")
    if folder is not None:
        with contextlib.suppress(OSError):
            _remove_old(folder)
    return folder


def _remove_old(kernels: Path) -> None:
    oldest = time.time() - _KEPT_DAYS * 86400
    for folder in kernels.iterdir():
        is_ours = re.fullmatch(r"[0-9a-f]{16}", folder.name)
        if is_ours and folder.stat().st_mtime < oldest:
            shutil.rmtree(folder, ignore_errors=True)


class _DigestedFile(caching.IndexDataCacheFile):
    """Machine code with a digest behind it, since a damaged file may load and answer wrongly."""

    def _dump(self, obj: object) -> bytes:
        data: bytes = super()._dump(obj)
        return data + hashlib.sha256(data).digest()

    def _load_data(self, name: str) -> Any:
        stored = Path(self._data_path(name)).read_bytes()
        data, digest = stored[:-_DIGEST_BYTES], stored[-_DIGEST_BYTES:]
        if hashlib.sha256(data).digest() != digest:
            raise pickle.UnpicklingError(f"{name} is damaged")
        return pickle.loads(data)


class _ContentLocator(caching.UserProvidedCacheLocator):
    """Names a kernel's files by what it follows from, wherever its source stands on the disk."""

    def __init__(self, py_func: Callable[..., Any], py_file: str) -> None:
        super().__init__(py_func, py_file)
        self._cache_path = numba.config.CACHE_DIR

    def get_source_stamp(self) -> tuple[int, int]:
        return (0, 0)  # the folder's name tells of every change


class _FolderImpl(caching.CompileResultCacheImpl):
    # Otherwise Numba may fall back to writing next to the sources.
    _locator_classes = (_ContentLocator,)


class _ForgivingCache(caching.FunctionCache):
    """A cache whose trouble costs a compilation and never an exception."""

    _impl_class = _FolderImpl

    def __init__(self, py_func: Callable[..., Any]) -> None:
        super().__init__(py_func)
        self._cache_file = _DigestedFile(
            cache_path=self._cache_path,
            filename_base=self._impl.filename_base,
            source_stamp=self._impl.locator.get_source_stamp(),
        )

    def load_overload(self, sig: object, target_context: object) -> Any:
        try:
            return super().load_overload(sig, target_context)
        except Exception:
            # What a damaged file raises depends on the byte: unpickling can raise anything.
            with contextlib.suppress(OSError):
                self.flush()
            return None

    def save_overload(self, sig: object, data: object) -> None:
        with contextlib.suppress(OSError, EOFError, pickle.PickleError):
            super().save_overload(sig, data)


@contextlib.contextmanager
def _numba_cache_in(folder: Path) -> Iterator[None]:
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def _enable_cache(dispatcher: Any) -> None:
    function = dispatcher.py_func
    # OSError, RuntimeError: a function without a source file, such as one typed at a prompt.
    with contextlib.suppress(OSError, RuntimeError):
        file = Path(function.__code__.co_filename).absolute()
        folder = _kernel_folder(kernel_key(function.__module__ or "", file))
        if folder is not None:
            with _numba_cache_in(folder):
                dispatcher._cache = _ForgivingCache(function)


@overload
def kernel(function: Kernel, /) -> Kernel: ...
@overload
def kernel(*, fastmath: bool | set[str] = ..., inline: str = ...) -> Callable[[Kernel], Kernel]: ...
def kernel(
    function: Kernel | None = None, /, *, fastmath: bool | set[str] = False, inline: str = "never"
) -> Kernel | Callable[[Kernel], Kernel]:
    """Compile a function of floats and arrays, without the interpreter's lock.

    A division by zero follows the floating-point rules instead of raising.

    Parameters
    ----------
    function : callable
        The function; left out when the decorator is given options.
    fastmath : bool or set of str
        Floating-point rules that may be broken for speed, as in :func:`numba.njit`.
    inline : {'never', 'always'}
        Whether the function is copied into its callers, as in :func:`numba.njit`.

    Returns
    -------
    callable
        The compiled function, cached on disk where there is a writable folder.
    """

    def decorate(plain: Kernel) -> Kernel:
        options: dict[str, Any] = {"fastmath": fastmath, "inline": inline}
        dispatcher: Any = numba.njit(nogil=True, error_model="numpy", **options)(plain)
        if not numba.config.DISABLE_JIT:
            _enable_cache(dispatcher)
        compiled: Kernel = dispatcher
        return compiled

    return decorate if function is None else decorate(function)
