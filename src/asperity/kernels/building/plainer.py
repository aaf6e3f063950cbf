"""Large tuples cost what is taken of them: less is written down for LLVM to take away again.

A named tuple of arrays is hundreds of numbers. Numba writes one that a function is given to memory,
reads all of it wherever a member is wanted, and takes it apart number by number where it is given
on. Here what the first block of a function says, which stands before all others, stays a value, and
of a value that was put together the part is taken that was put in.
"""

from collections.abc import Callable
from typing import Any

from llvmlite import ir as llvm
from llvmlite.ir.instructions import InsertValue
from numba.core import ir, lowering


def begin() -> None:
    """Let this process compile so."""
    lower: Any = lowering.Lower
    lower._find_singly_assigned_variable = _values_of_the_first_block(
        lower._find_singly_assigned_variable
    )
    builder: Any = llvm.IRBuilder
    builder.extract_value = _part_put_in(builder.extract_value)


def _values_of_the_first_block(find: Callable[..., None]) -> Callable[..., None]:
    def find_more(self: Any) -> None:
        find(self)
        times: dict[str, int] = {}
        for block in self.blocks.values():
            for one in block.find_insts(ir.Assign):
                times[one.target.name] = times.get(one.target.name, 0) + 1
        first = self.blocks[min(self.blocks)]
        lent = self.func_ir.__dict__.get("lent", ())
        models = self.context.data_model_manager
        self._singly_assigned_vars |= {
            name
            for name in {one.target.name for one in first.find_insts(ir.Assign)}
            if times[name] == 1
            # Else memory tells whether it has been given up.
            and (
                not self.context.enable_nrt
                or name in lent
                or not models[self.typeof(name)].contains_nrt_meminfo()
            )
        }

    return find_more


def _part_put_in(extract: Callable[..., Any]) -> Callable[..., Any]:
    def extract_value(self: Any, agg: Any, idx: Any, name: str = "") -> Any:
        path = tuple(idx) if isinstance(idx, (tuple, list)) else (idx,)
        while path and isinstance(agg, InsertValue):
            put = tuple(agg.indices)
            if path[: len(put)] == put:
                agg, path = agg.value, path[len(put) :]
            elif put[: len(path)] == path:
                break
            else:
                agg = agg.aggregate
        return extract(self, agg, path, name) if path else agg

    return extract_value
