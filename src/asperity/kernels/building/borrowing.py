"""Functions that only borrow arrays are compiled without counts of who holds them.

Numba counts for every function that an array goes through. One that gets its arrays as arguments,
makes none and returns none has nothing to count for: who called it holds them. Without the counts
there is less to compile, and the same is calculated. In kernels that Numba compiles where they are
called all is counted, but for those marked by `asperity.kernels.uncounted`.
"""

from collections.abc import Callable, Iterator
from typing import Any

from numba.core import ir, typed_passes
from numba.core import types as numba_types

types: Any = numba_types

_TAKEN_APART = frozenset(
    ["getattr", "getitem", "static_getitem", "build_tuple", "exhaust_iter", "cast", "phi"]
)
"""What makes arrays of arrays that somebody holds: members, views, tuples."""


def begin() -> None:
    """Let this process compile so."""
    lowering: Any = typed_passes.BaseNativeLowering
    lowering.run_pass = _uncounted(lowering.run_pass)


def _uncounted(run: Callable[..., bool]) -> Callable[..., bool]:
    def run_pass(self: Any, state: Any) -> bool:
        if state.targetctx.enable_nrt and only_borrows(state):
            context = state.targetctx.subtarget(enable_nrt=False)
            context.__dict__.pop("nrt", None)
            state.targetctx = context
        return run(self, state)

    return run_pass


def only_borrows(state: Any) -> bool:
    """Return whether a function whose types are known makes no arrays and returns none."""
    models = state.targetctx.data_model_manager

    def holds(name: str) -> bool:
        return bool(models[state.typemap[name]].contains_nrt_meminfo())

    if models[state.return_type].contains_nrt_meminfo():
        return False
    return all(
        _borrows(one, holds, state.typemap)
        for block in state.func_ir.blocks.values()
        for one in _instructions(block)
    )


def _instructions(block: Any) -> Iterator[Any]:
    return (one for one in block.body if not isinstance(one, (ir.Del, ir.Jump, ir.Branch)))


def _borrows(one: Any, holds: Callable[[str], bool], typed: Any) -> bool:
    if isinstance(one, (ir.SetItem, ir.StaticSetItem, ir.SetAttr)):
        return not holds(one.value.name)
    if not isinstance(one, ir.Assign):
        return isinstance(one, ir.Return)
    value = one.value
    makes = holds(one.target.name)
    if not isinstance(value, ir.Expr):
        return not makes or isinstance(value, (ir.Arg, ir.Var))
    if value.op in _TAKEN_APART:
        return True
    if makes:
        return False
    if value.op == "call" and isinstance(typed[value.func.name], types.Dispatcher):
        return True
    # What Numba does with an array beside that may make another.
    return not any(holds(each.name) for each in value.list_vars())
