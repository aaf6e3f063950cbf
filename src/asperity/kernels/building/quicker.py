"""What Numba does over and over while it compiles, done once, in fewer steps or not.

What comes out calculates the same; a kernel takes a quarter less. Like the rest of
`asperity.kernels.building` it is for processes that only compile.
"""

import functools
import inspect
import operator
from collections.abc import Callable, Iterable
from typing import Any

from numba.core import (
    compiler_machinery,
    cpu,
    datamodel,
    errors,
    event,
    inline_closurecall,
    ir,
    lowering,
    postproc,
    transforms,
    typeinfer,
    utils,
)
from numba.core import types as numba_types
from numba.core.registry import cpu_target
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
    compiler_machinery.PassManager._runPass = _pass
    # What is said of an error beside it, nobody reads.
    module: Any
    for module in (errors, typeinfer, lowering):
        module.new_error_context = _untold
    utils.pysignature = functools.cache(inspect.signature)
    for context in (cpu.CPUContext, type(cpu_target.typing_context)):
        context.refresh = _what_is_new(context.refresh)
    types: Any = numba_types
    for kind in (types.Array, types.BaseTuple, types.Record):
        kind.__hash__ = _told_once(kind.__hash__)
    # What weak references cost, and types live as long as the process.
    models: Any = datamodel.default_manager
    models._cache = dict(models._cache)
    closures: Any = inline_closurecall.InlineClosureCallPass
    closures.run = _where_there_are_any(closures.run)


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


def _pass(self: Any, index: int, one: Any, state: Any) -> None:
    """Run a pass over a function, neither timed nor announced."""
    one.analysis = self._analysis
    is_changed = False
    for step in (one.run_initialization, one.run_pass, one.run_finalizer):
        is_changed |= step(state)
    if compiler_machinery._pass_registry.get(type(one)).mutates_CFG:
        function = state.func_ir
        if is_changed:
            postproc.PostProcessor(function).run()
        elif function.__dict__.get("_canonical") is not function.blocks:
            function.blocks = transforms.canonicalize_cfg(function.blocks)
        function._canonical = function.blocks


class _Nothing:
    def __enter__(self) -> None:
        pass

    def __exit__(self, *_raised: object) -> None:
        pass


_NOTHING = _Nothing()


def _untold(*_words: object, **_more: object) -> _Nothing:
    return _NOTHING


def _what_is_new(refresh: Callable[..., None]) -> Callable[..., None]:
    """Ask tables that are known for what has been added, in place of importing all once more."""

    def refreshed(self: Any) -> None:
        seen: dict[Any, int] | None = self.__dict__.get("_seen")
        if seen is None:
            refresh(self)
            seen = self.__dict__["_seen"] = {}
        for registry, loader in list(self._registries.items()):
            count = sum(len(getattr(registry, name)) for name in loader.registry_items)
            if seen.get(registry) != count:
                seen[registry] = count
                self.install_registry(registry)

    return refreshed


def _told_once(find: Callable[..., int]) -> Callable[..., int]:
    """Let a type keep its hash, which goes through all that it holds."""

    def told(self: Any) -> int:
        held: dict[str, Any] = self.__dict__
        if "_told" not in held:
            held["_told"] = find(self)
        return int(held["_told"])

    return told


def _where_there_are_any(run: Callable[..., None]) -> Callable[..., None]:
    """Look for functions to be copied in only where there are functions or lists in a function."""

    def leaner(self: Any) -> None:
        found = {
            each.value.op
            for block in self.func_ir.blocks.values()
            for each in block.body
            if isinstance(each, ir.Assign) and isinstance(each.value, ir.Expr)
        }
        if found & {"make_function", "build_list"}:
            run(self)
        else:
            self.func_ir.blocks = transforms.canonicalize_cfg(self.func_ir.blocks)

    return leaner
