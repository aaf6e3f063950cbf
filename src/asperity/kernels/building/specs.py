"""What a kernel is called with, as JSON holds it: the types that Numba has for it, and back."""

import importlib
from typing import Any

from numba.core import types as numba_types
from numba.np.numpy_support import as_dtype, from_dtype

from asperity.kernels.native.dtypes import described, read

Spec = list[Any]

# Numba fills its module of types as it is loaded.
types: Any = numba_types

_PLAIN: dict[str, Any] = {
    "d": types.float64,
    "q": types.int64,
    "b": types.boolean,
    "0": types.none,
}


class UnknownTypeError(TypeError):
    """A type that a call without Numba cannot pass."""


def spec(of: Any) -> Spec:
    """Return a type of Numba's as JSON holds it.

    Raises
    ------
    UnknownTypeError
        There is no word for it.
    """
    for word, plain in _PLAIN.items():
        if of == plain:
            return [word]
    match of:
        case types.Array():
            dtype = described(as_dtype(of.dtype))
            return ["A", dtype, of.ndim, of.layout, bool(of.mutable), bool(of.aligned)]
        case types.Record():
            return ["R", described(as_dtype(of))]
        case types.NamedTuple() | types.NamedUniTuple():
            made = of.instance_class
            return ["N", made.__module__, made.__qualname__, [spec(inner) for inner in of.types]]
        case types.BaseTuple():
            return ["T", [spec(inner) for inner in of.types]]
    raise UnknownTypeError(f"{of}")


def numba_type(given: Spec) -> Any:
    """Return the type that `spec` told of."""
    word, *rest = given
    if word in _PLAIN:
        return _PLAIN[word]
    if word == "A":
        dtype, ndim, layout, writable, aligned = rest
        return types.Array(
            from_dtype(read(dtype)), ndim, layout, readonly=not writable, aligned=aligned
        )
    if word == "R":
        return from_dtype(read(rest[0]))
    if word == "N":
        module, name, inner = rest
        made: Any = importlib.import_module(module)
        for part in name.split("."):
            made = getattr(made, part)
        members = [numba_type(one) for one in inner]
        if members and all(member == members[0] for member in members):
            return types.NamedUniTuple(members[0], len(members), made)
        return types.NamedTuple(members, made)
    if word == "T":
        return types.BaseTuple.from_types([numba_type(one) for one in rest[0]])
    raise UnknownTypeError(word)
