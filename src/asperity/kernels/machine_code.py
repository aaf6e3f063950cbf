"""Machine code kept on disk: Numba's cache, in folders of ours, digested and for nobody else."""

import contextlib
import hashlib
import pickle
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba
from numba.core import caching
from numba.core.runtime import rtsys

from asperity.kernels.folder import is_kept, kernels, tell_unkept

_DIGEST_BYTES = 32


def keep(dispatcher: Any, key: str) -> None:
    """Let a compiled function find its machine code on disk, and leave it there.

    Parameters
    ----------
    dispatcher : numba.core.dispatcher.Dispatcher
        The function, not compiled yet.
    key : str
        Name of the folder, made from what the machine code follows from.
    """
    folder = _kernel_folder(key)
    if folder is not None:
        # RuntimeError: a function that has no file, which Numba finds nothing to name by.
        with _numba_cache_in(folder), contextlib.suppress(RuntimeError):
            dispatcher._cache = _ForgivingCache(dispatcher.py_func)


def _kernel_folder(key: str) -> Path | None:
    folder = kernels()
    if folder is None:
        return None
    made = folder / key
    try:
        made.mkdir(mode=0o700, exist_ok=True)
    except OSError as trouble:
        tell_unkept(trouble)
        return None
    return made if is_kept(made) else None


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
            # Numba's own way first loads all that compiling may need: half a second of modules.
            rtsys.initialize(target_context)
            with self._guard_against_spurious_io_errors():
                return self._load_overload(sig, target_context)
        except Exception:
            # What a damaged file raises depends on the byte: unpickling can raise anything.
            with contextlib.suppress(OSError):
                self.flush()
            return None

    def save_overload(self, sig: object, data: object) -> None:
        try:
            # Where it has been removed since, Numba would make one that others may write to.
            Path(self._cache_path).mkdir(mode=0o700, exist_ok=True)
            super().save_overload(sig, data)
        except (EOFError, pickle.PickleError):
            pass
        except OSError as trouble:
            tell_unkept(trouble)


@contextlib.contextmanager
def _numba_cache_in(folder: Path) -> Iterator[None]:
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(folder)
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before
