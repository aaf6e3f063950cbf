"""Arrays that a function only borrows are compiled without counts of who holds them.

Numba counts for every function that an array goes through. One that gets its arrays as arguments,
makes none and returns none has nothing to count for: who called it holds them. One that makes some
counts for these alone, and gives up at its end what it makes once; what it takes of both until then
needs no counts either. What raises would not give up what it has made; no kernel does. Most of what
is compiled of a function with large tuples of arrays are counts. Without them there is less to
compile, and the same is calculated. In kernels that Numba compiles where they are called all is
counted, but for those marked by `asperity.kernels.uncounted`.
"""

from collections.abc import Callable, Iterator
from typing import Any

from numba.core import ir, lowering, typed_passes
from numba.core import types as numba_types
from numba.core.analysis import compute_cfg_from_blocks

types: Any = numba_types

_TAKEN_APART = frozenset(
    ["getattr", "getitem", "static_getitem", "build_tuple", "exhaust_iter", "cast", "phi"]
)
"""What makes arrays of arrays that somebody holds: members, views, tuples."""
_ITEMS = frozenset(["getitem", "static_getitem"])
_KEEPS = (types.Array, types.BaseTuple, types.Record)


def begin() -> None:
    """Let this process compile so."""
    step: Any = typed_passes.BaseNativeLowering
    step.run_pass = _uncounted(step.run_pass)
    lower: Any = lowering.Lower
    lower.lower_inst = _but_for_lent(lower.lower_inst)
    lower.storevar = _made_once(lower.storevar)
    lower._find_singly_assigned_variable = _but_owned(lower._find_singly_assigned_variable)


def _uncounted(run: Callable[..., bool]) -> Callable[..., bool]:
    def run_pass(self: Any, state: Any) -> bool:
        if state.targetctx.enable_nrt:
            if only_borrows(state):
                state.targetctx = _not_counting(state.targetctx)
            else:
                state.func_ir.lent, state.func_ir.owned = lent(state)
        return run(self, state)

    return run_pass


def _not_counting(context: Any) -> Any:
    # A copy of a context has what it knows too, of another one.
    of, other = context.__dict__.get("not_counting", (None, None))
    if of is not context:
        other = context.subtarget(enable_nrt=False)
        other.__dict__.pop("nrt", None)
        context.not_counting = context, other
    return other


def _but_for_lent(lower: Callable[..., None]) -> Callable[..., None]:
    """Count in a function, but not for variables that are `lent` to it."""

    def lower_inst(self: Any, one: Any) -> None:
        held = self.func_ir.__dict__
        known, owned = held.get("lent", ()), held.get("owned", ())
        counting = self.context
        if isinstance(one, ir.Del) and (one.value in known or one.value in owned):
            return
        if isinstance(one, ir.Assign):
            if one.target.name in known:
                self.context = _not_counting(counting)
        elif isinstance(one, ir.Return):
            for name in sorted(owned):
                kind = self.typeof(name)
                self._alloca_var(name, kind)
                self.decref(kind, self.builder.load(self.getvar(name)))
        try:
            lower(self, one)
        finally:
            self.context = counting

    return lower_inst


def _made_once(store: Callable[..., None]) -> Callable[..., None]:
    """Give up nothing in the place of what a function makes once."""

    def storevar(self: Any, value: Any, name: str, argidx: int | None = None) -> None:
        counting = self.context
        if name in self.func_ir.__dict__.get("owned", ()):
            self.context = _not_counting(counting)
        try:
            store(self, value, name, argidx)
        finally:
            self.context = counting

    return storevar


def _but_owned(find: Callable[..., None]) -> Callable[..., None]:
    """Keep what a function gives up as it returns where that finds it."""

    def find_others(self: Any) -> None:
        find(self)
        self._singly_assigned_vars -= self.func_ir.__dict__.get("owned", frozenset())

    return find_others


def lent(state: Any) -> tuple[set[str], set[str]]:
    """Return variables of a function that hold arrays which live until it returns.

    The first ones hold what others do, arguments or the second ones, and need no counts; these
    are made once at most, and given up as it returns.
    """
    blocks, typed, holds = state.func_ir.blocks, state.typemap, _holding(state)
    graph = compute_cfg_from_blocks(blocks)
    returned = {
        one.value.name
        for block in blocks.values()
        for one in block.body
        if isinstance(one, ir.Return)
    }
    made: dict[str, list[Any]] = {}
    repeated: set[str] = set()
    for label, block in blocks.items():
        for one in block.find_insts(ir.Assign):
            # What is returned goes to who called, counted.
            if (name := one.target.name) not in returned and holds(name):
                made.setdefault(name, []).append(one.value)
                if len(made[name]) > 1 or graph.in_loops(label):
                    repeated.add(name)
    taken = {
        name: all(_is_taken(each, holds, typed) for each in values) for name, values in made.items()
    }
    owned = {name for name in made if not taken[name] and name not in repeated}
    known = {name for name in made if taken[name]}
    while strange := {
        name
        for name in known
        for value in made[name]
        for each in _arrays_in(value, holds)
        if each not in known and each not in owned
    }:
        known -= strange
    return known, owned


def _is_taken(value: Any, holds: Callable[[str], bool], typed: Any) -> bool:
    """Return whether a value is of arrays that somebody holds, by all it says itself."""
    if isinstance(value, (ir.Arg, ir.Var)):
        return True
    if not isinstance(value, ir.Expr):
        return False
    if value.op == "call":
        return isinstance(typed[value.func.name], types.NamedTupleClass)
    if value.op in _ITEMS and not isinstance(typed[value.value.name], _KEEPS):
        return False  # of a list, say, which may let it go
    # By an array it gathers into one of its own.
    gathers = value.op == "getitem" and holds(value.index.name)
    return value.op in _TAKEN_APART and not gathers


def _arrays_in(value: Any, holds: Callable[[str], bool]) -> list[str]:
    """Return the variables with arrays that a value is taken from."""
    if isinstance(value, ir.Var):
        return [value.name]
    if not isinstance(value, ir.Expr):
        return []
    return [each.name for each in value.list_vars() if holds(each.name)]


def _holding(state: Any) -> Callable[[str], bool]:
    models = state.targetctx.data_model_manager

    def holds(name: str) -> bool:
        return bool(models[state.typemap[name]].contains_nrt_meminfo())

    return holds


def only_borrows(state: Any) -> bool:
    """Return whether a function whose types are known makes no arrays and returns none."""
    models, holds = state.targetctx.data_model_manager, _holding(state)
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
