"""Compiled kernels: functions of floats and arrays that Numba compiles where they are called.

Declaring one costs nothing. A call goes to a library of machine code (`native`) where there is one
that has the kernel for such arguments, made from the sources as they are; else to Numba, which is
loaded at the first such call of any. With ``ASPERITY_NATIVE=0`` in the environment all go to Numba.

What Numba compiles is kept on disk under a name made from the sources it follows from. Numba
recompiles a function when the file it stands in changes, but not when a function it calls from
another file does: it would answer with yesterday's code. Here a change to a kernel's module or to
any that it imports, to Numba or to NumPy leads to another cache folder, and nothing else does: not
a change elsewhere, nor another place on the disk.
"""

import contextlib
import functools
import hashlib
import math
import os
import threading
import time
import types
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeAlias, overload

from asperity.kernels.closure import closure, digest_of

# Numba finds the types of a kernel at its first call; there is nothing to check before.
Kernel = Callable[..., Any]

_LOCK = threading.Lock()


def kernel_key(module: str, file: Path, since: float = math.inf) -> str:
    """Return what machine code follows from: a module and its imports, Numba, NumPy, processor.

    Parameters
    ----------
    module : str
        Full name.
    file : path
        Where it stands.
    since : float
        When it was imported, s since 1970: what a source has come to hold later is not compiled.
        Left out, it is not asked whether any has been changed.

    Raises
    ------
    OSError
        One of the sources is gone, or was changed after it was imported.
    """
    sources = closure(module, file=file)
    if since < math.inf and any(_is_changed(source, since) for source in sources):
        raise OSError(f"{module}: a source was changed after it was imported")
    root = file.parents[module.count(".")] if "." in module else file.parent
    parts = (digest_of(sources, root), *machine())
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


_Stamp: TypeAlias = tuple[int, int, int]

# What stood on the disk when the first kernel of a file was declared, and that kernel's name.
_DECLARED: dict[str, tuple[str, _Stamp]] = {}


def _stamp(file: str | Path) -> _Stamp:
    found = os.stat(file)
    return found.st_mtime_ns, found.st_size, found.st_ino


def _note(function: Kernel) -> None:
    """Note what a file holds that is imported, or once more."""
    file, name = os.path.abspath(function.__code__.co_filename), function.__qualname__
    if file not in _DECLARED or _DECLARED[file][0] == name:
        # OSError: none, as of one typed at a prompt.
        with contextlib.suppress(OSError):
            _DECLARED[file] = name, _stamp(file)


def _is_changed(source: Path, since: float) -> bool:
    """Return whether a source is another than what was imported, as far as can be told.

    One without kernels is imported before those that import it, and is taken for changed where it
    was written since; not where it is of the future, as on a disk with another clock.
    """
    if declared := _DECLARED.get(str(source)):
        return declared[1] != _stamp(source)
    return since < source.stat().st_mtime <= time.time()


@functools.cache
def machine() -> tuple[str, ...]:
    """Return versions of Numba and NumPy and the processor's name, on which last bits depend."""
    import llvmlite.binding
    import numba
    import numpy as np

    return numba.__version__, np.__version__, llvmlite.binding.get_host_cpu_name()


class _Lazy:
    """A function that Numba compiles once it is called, from Python or by another kernel."""

    def __init__(self, function: Kernel, options: dict[str, Any]) -> None:
        functools.update_wrapper(self, function)
        self._function = function
        self._options = options
        self._since = time.time()
        _note(function)
        self._compiled: Any = None
        # Answers from a library of machine code, NotImplemented where that has no such call.
        self._native: Callable[[tuple[Any, ...]], Any] = self._first

    def __call__(self, *arguments: Any) -> Any:
        answer = self._native(arguments)
        if answer is NotImplemented:
            return (self._compiled or self._dispatcher)(*arguments)
        return answer

    def _first(self, arguments: tuple[Any, ...]) -> Any:
        from asperity.kernels.native import load

        name = f"{self.__module__}.{self.__qualname__}"
        self._native = load.entry(name) or _not_here
        return self._native(arguments)

    def is_made(self, *arguments: Any) -> bool:
        """Return whether a call with such arguments waits for nothing of a library.

        Also where it is no library's but Numba's.
        """
        from asperity.kernels.native import load

        return load.is_made(f"{self.__module__}.{self.__qualname__}", arguments)

    def __getattr__(self, name: str) -> Any:
        # To Numba, which asks for its type and options, it is what it stands for.
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self._dispatcher, name)

    def __reduce__(self) -> str:
        name: str = self.__qualname__
        return name

    def _key(self) -> str:
        file = Path(self._function.__code__.co_filename).absolute()
        return kernel_key(self._function.__module__ or "", file, self._since)

    @property
    def _dispatcher(self) -> Any:
        with _LOCK:
            if self._compiled is None:
                _compile_anywhere()
                self._compiled = made(self._function, self._options, self._key)
        return self._compiled


@functools.cache
def _compile_anywhere() -> None:
    """Let Numba, which names sources as seen from the current folder, do without one."""
    from numba.core import ir

    location: Any = ir.Loc
    relative = location._get_path

    def path(self: Any) -> Any:
        try:
            return relative(self)
        except FileNotFoundError:
            return self.filename

    location._get_path = path


def _not_here(arguments: tuple[Any, ...]) -> Any:
    return NotImplemented


def made(function: Kernel, options: dict[str, Any], key: Callable[[], str]) -> Any:
    """Return a function that Numba compiles where it is called, kept on disk under a key."""
    import numba

    from asperity.kernels import machine_code

    compiled = numba.njit(nogil=True, error_model="numpy", **options)(function)
    if not numba.config.DISABLE_JIT:
        # OSError: a function without a source file, as one typed at a prompt, or of another by now.
        with contextlib.suppress(OSError):
            machine_code.keep(compiled, key())
    return compiled


def as_python(kernel: Kernel, instead: Mapping[Kernel, Kernel]) -> Kernel:
    """Return a kernel as a function of Python, with those that it calls by their own names.

    It gives the same to the last bit as long as nothing is divided by zero, which raises here, and
    no number but a float is raised to a power.

    Parameters
    ----------
    kernel : callable
        The kernel. Its records are to be of a type whose fields are attributes, ``numpy.record``.
    instead : mapping
        Kernels with what is called in their place.

    Raises
    ------
    TypeError
        A kernel that is called may break rules of floating point, or has defaults or a closure.
    """
    known = dict(instead)

    def of(one: Any) -> Kernel:
        if one not in known:
            plain = one._function
            if one._options["fastmath"] or plain.__defaults__ or plain.__closure__:
                raise TypeError(f"{plain.__module__}.{plain.__qualname__} is another as Python")
            names = dict(plain.__globals__)
            known[one] = types.FunctionType(plain.__code__, names, plain.__name__)
            for name in plain.__code__.co_names:
                if isinstance(names.get(name), _Lazy):
                    names[name] = of(names[name])
        return known[one]

    return of(kernel)


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
    options: dict[str, Any] = {"fastmath": fastmath, "inline": inline}

    def decorate(plain: Kernel) -> Kernel:
        return _Lazy(plain, options)

    return decorate if function is None else decorate(function)
