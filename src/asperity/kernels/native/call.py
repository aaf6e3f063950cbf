"""Kernels in a library of machine code, as Python calls them."""

import ctypes
import pickle
from collections.abc import Callable, Sequence
from typing import Any

from asperity.kernels.native import gather
from asperity.kernels.native.back import reader, words_of
from asperity.kernels.native.plan import Plan, Spec, UnknownTypeError

# Answers NotImplemented where no signature fits: the call is Numba's then.
Native = Callable[[tuple[Any, ...]], Any]
Addresses = Callable[[str], int]

# What a kernel's machine code returns where it came to its end.
_GOOD = (0, -2)


class Caller:
    """Makes Python functions of the machine code of one library.

    Parameters
    ----------
    address : callable
        Returns the address of a symbol of the library, which must stay loaded.
    """

    def __init__(self, address: Addresses) -> None:
        self._address = address
        word = ctypes.c_int64
        # Under the interpreter's lock: it looks into Python's objects.
        look = ctypes.PYFUNCTYPE(word, word, ctypes.py_object, ctypes.c_void_p)
        self._gather = look(address(gather.NAME))
        self._release = ctypes.CFUNCTYPE(None, ctypes.c_void_p)(address("asperity_release"))

    def entry(self, name: str, signatures: Sequence[dict[str, Any]]) -> Native | None:
        """Return a kernel, which takes its arguments as one tuple.

        It returns NotImplemented, and has done nothing then, where the arguments are of none of
        its signatures.

        Parameters
        ----------
        name : str
            The kernel's full name, for messages.
        signatures : sequence of dict
            Its rows of the table.
        """
        natives = [native for row in signatures if (native := self._native(name, row)) is not None]
        if len(natives) < 2:
            return natives[0] if natives else None

        def first_that_fits(arguments: tuple[Any, ...]) -> Any:
            for native in natives:
                answer = native(arguments)
                if answer is not NotImplemented:
                    return answer
            return NotImplemented

        return first_that_fits

    def _native(self, name: str, row: dict[str, Any]) -> Native | None:
        returns: Spec = row["returns"]
        try:
            back = words_of(returns)
            plan = Plan(row["arguments"], back)
            read = reader(returns, self._release)
        except UnknownTypeError:
            return None
        if [back, plan.words] != row["words"]:
            return None
        gathered, rows = self._gather, plan.address
        # Machine code runs without the lock, as under Numba.
        run = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p)(self._address(row["symbol"]))
        # The machine code stays loaded as long as somebody may call it.
        run.loaded = self._address  # type: ignore[attr-defined]
        new_room = ctypes.c_int64 * plan.room

        def native(arguments: tuple[Any, ...]) -> Any:
            # Each call has its own: kernels call in turn, and threads at once.
            room = new_room()
            if strange := gathered(rows, arguments, room):
                while strange > 0 and plan.learn(strange, arguments):
                    strange = gathered(rows, arguments, room)
                if strange:
                    return NotImplemented
            if (status := run(room)) and status not in _GOOD:
                raise trouble(name, status, room[0])
            return read(room, arguments)

        return native


def trouble(name: str, status: int, raised: int) -> Exception:
    """Return the exception that a kernel's machine code stopped with.

    Parameters
    ----------
    name : str
        The kernel's full name.
    status : int
        What the machine code returned.
    raised : int
        Address of what it says of the exception: address and length of a pickled class with its
        arguments, which stand in the library; nought where it says nothing.
    """
    if raised:
        try:
            data, size, _, made = (ctypes.c_int64 * 4).from_address(raised)
            # Of the library itself, and as safe as it; put together at run time it is not read.
            kind, arguments, _ = pickle.loads(ctypes.string_at(data, size & 0xFFFFFFFF))
            if not made and isinstance(kind, type) and issubclass(kind, Exception):
                return kind(*arguments)
        except Exception:
            # Whatever stands there, the kernel stopped.
            pass
    return RuntimeError(f"{name} stopped with status {status}")
