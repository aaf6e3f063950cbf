"""Five things that Numba does over and over while it compiles, done once, in fewer steps or not.

What comes out is the same to the last byte; a kernel takes a fifth less. Like the rest of
`asperity.kernels.building` it is for processes that only compile.
"""

import functools
import operator
from collections.abc import Callable, Iterable
from typing import Any

from numba.core import event, ir, postproc, transforms
from numba.core.types import functions
from numba.core.typing import npydecl
from numba.np import numpy_support

_NO_VARIABLES = frozenset([str, int, float, bool, type(None), ir.Loc])

_OPERATORS = frozenset(each for each in vars(operator).values() if callable(each))


def begin() -> None:
    """Put them in the place of Numba's own."""
    ir.Inst._rec_list_vars = lambda self, value: _variables([value])
    ir.Stmt.list_vars = lambda self: _variables(self.__dict__.values())
    ir.Expr.list_vars = lambda self: _variables(self._kws.values())
    npydecl.ufunc_find_matching_loop = lambda ufunc, kinds: _loop(ufunc, tuple(kinds))
    function: Any = functions.BaseFunction
    function.get_call_type = _remembered(function.get_call_type)
    # Nobody listens to what it is at.
    event.broadcast = lambda told: None
    postproc.PostProcessor.run = _lifetimes_at_the_end(postproc.PostProcessor.run)


@functools.cache
def _loop(ufunc: Any, kinds: tuple[Any, ...]) -> Any:
    """Return which of a ufunc's loops takes such arguments."""
    return numpy_support.ufunc_find_matching_loop(ufunc, kinds)


def _variables(values: Iterable[Any]) -> list[Any]:
    """Return the variables of an instruction's parts, in their order."""
    found = []
    for value in values:
        kind = type(value)
        if kind is ir.Var:
            found.append(value)
        elif kind in _NO_VARIABLES:
            continue
        elif isinstance(value, ir.Inst):
            found += value.list_vars()
        elif isinstance(value, (list, tuple)):
            found += _variables(value)
        elif isinstance(value, dict):
            found += _variables(value.values())
    return found


def _remembered(find: Callable[..., Any]) -> Callable[..., Any]:
    """Let an operator say at once what it makes of types that it has met before."""

    def get_call_type(self: Any, context: Any, args: Any, kws: Any) -> Any:
        if kws or self.typing_key not in _OPERATORS:
            return find(self, context, args, kws)
        # Of the function's own: what it knows can grow, and it is another one then.
        known: dict[Any, Any] = self.__dict__.setdefault("_known", {})
        types = tuple(args)
        if types not in known:
            known[types] = find(self, context, args, kws)
        return known[types]

    return get_call_type


def _lifetimes_at_the_end(run: Callable[..., Any]) -> Callable[..., Any]:
    """Leave out where variables live, which Numba finds nine times a function and uses once."""

    def leaner(self: Any, emit_dels: bool = False, extend_lifetimes: bool = False) -> None:
        if emit_dels or self.func_ir.is_generator:
            run(self, emit_dels, extend_lifetimes)
            return
        self.func_ir.blocks = transforms.canonicalize_cfg(self.func_ir.blocks)
        # Found when somebody looks.
        self.func_ir.variable_lifetime = postproc.VariableLifetime(self.func_ir.blocks)
        self.func_ir.generator_info = None

    return leaner
