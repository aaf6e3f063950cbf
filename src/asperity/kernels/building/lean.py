"""A kernel as one object file: what it calls is linked in, optimised with it and made no code of.

Numba makes machine code of every function that it compiles, with a wrapper for Python, as any of
them might be called next. Here one entry is called from outside, so everything else is internal:
what it calls is inlined or stands once, and what is not called is dropped. This replaces parts of
Numba in the process, which can run no kernels any more: it is for processes that only compile.
"""

import ctypes
import ctypes.util
import dataclasses
import functools
from typing import Any

import llvmlite.binding as ll
import numba
from llvmlite import ir
from numba.core import codegen, types
from numba.core.registry import cpu_target
from numba.core.runtime import nrtdynmod, rtsys

from asperity.kernels import compiled
from asperity.kernels.building import borrowing, plainer, quicker, runtime
from asperity.kernels.building.specs import Spec, UnknownTypeError, numba_type, spec
from asperity.kernels.native.target import PLAIN, Target

# Their loops over steps are faster for it and sooner made; a block's take LLVM a third longer.
_OF_STEPS = ("asperity.slider.pressed", "asperity.slider.batch")

# Loops over lanes are functions that a factory makes, one for each law and stage: "<locals>" is in
# their names. It is in those of Numba's own max and min too, which are to go into the loops.
_LANES = "asperity.slider.batch"
_OURS, _FROM_A_FACTORY = "_ZN8asperity", "_3clocals_3e"


class UnfitError(Exception):
    """A kernel that cannot do without Numba, or without Python."""


@dataclasses.dataclass(frozen=True)
class Made:
    """An entry's object file and what is known of it.

    Attributes
    ----------
    code : bytes
        The object file, which exports the symbol alone.
    returns : list
        What it returns, as `asperity.kernels.building.specs.spec` says it.
    words : tuple of int
        So many 64-bit words come back, and so many go in.
    """

    code: bytes
    returns: Spec
    words: tuple[int, int]


class _Library(codegen.JITCodeLibrary):
    """Code that waits to be linked into an entry."""

    def _optimize_functions(self, ll_module: Any) -> None:
        ll_module.data_layout = self._codegen._data_layout

    def finalize(self) -> None:
        self._raise_if_finalized()
        self._finalized = True

    def get_pointer_to_function(self, name: str) -> int:
        return 0


class _Codegen(codegen.JITCPUCodegen):
    _library_class = _Library

    def _customize_tm_options(self, options: dict[str, Any]) -> None:
        options.update(_options(PLAIN))

    def _customize_tm_features(self) -> str:
        return ""


def _options(target: Target) -> dict[str, str]:
    made_for = {"cpu": target.processor, "features": target.tuning}
    return {**made_for, "reloc": "pic", "codemodel": "default"}


def begin() -> None:
    """Make this process one that compiles entries and runs none."""
    numba.config.DISABLE_JIT = False
    quicker.begin()
    borrowing.begin()
    plainer.begin()
    context = cpu_target.target_context
    rtsys.initialize(context)
    context._internal_codegen = _Codegen("asperity")
    rtsys._library = nrtdynmod.compile_nrt_functions(context)
    context.create_cpython_wrapper = _nothing
    context.create_cfunc_wrapper = _nothing
    context.get_executable = _stand_in
    compiled.made = _compiled


def _nothing(*_arguments: object, **_options: object) -> None:
    """What no entry needs."""


def _stand_in(*_arguments: object) -> Any:
    """What Numba knows a function by where it cannot be run: a function of C's, each another."""
    return [].append


def _compiled(function: Any, options: dict[str, Any], key: object) -> Any:
    """What `asperity.kernels.compiled.made` is here: nothing is looked for on the disk."""
    return numba.njit(nogil=True, error_model="numpy", **options)(function)


def make(kernel: Any, arguments: list[Spec], symbol: str, target: Target = PLAIN) -> Made:
    """Compile a kernel for types of arguments.

    Parameters
    ----------
    kernel : callable
        From `asperity.kernels.compiled.kernel`.
    arguments : list
        What it is called with, as `asperity.kernels.building.specs.spec` says it.
    symbol : str
        The name that it is called by.
    target : Target
        The processors that it is for.

    Raises
    ------
    UnfitError
        It needs Numba or Python at run time, or returns what a call cannot take back.
    """
    dispatcher = kernel._dispatcher
    signature = tuple(numba_type(one) for one in arguments)
    dispatcher.compile(signature)
    result = dispatcher.overloads[signature]
    returned = result.signature.return_type
    try:
        returns = spec(returned)
    except UnknownTypeError as error:
        raise UnfitError(f"it returns {error}") from None
    if isinstance(returned, types.Record):
        raise UnfitError("it returns a record")
    native = result.fndesc.llvm_func_name
    module, words = _linked(result, native, symbol)
    lanes = kernel.__module__.startswith(_LANES)
    _internal(module, native, symbol, apart=lanes)
    values_first = kernel.__module__.startswith(_OF_STEPS)
    _optimise(module, target, values_first=values_first, twice=lanes)
    if foreign := _foreign(module):
        raise UnfitError(f"it needs {', '.join(foreign)}")
    return Made(_machine(target).emit_object(module), returns, words)


def support(*texts: str) -> bytes:
    """Return an object file of code that is given as text, optimised."""
    module, *others = map(_parsed, texts)
    for other in others:
        module.link_in(other)
    for function in module.functions:
        if function.linkage == ll.Linkage.linkonce_odr:
            function.linkage = "internal"
    _optimise(module, PLAIN)
    return bytes(_machine(PLAIN).emit_object(module))


@functools.cache
def _machine(target: Target) -> Any:
    """What LLVM makes code for."""
    made_by = ll.Target.from_triple(ll.get_process_triple())
    return made_by.create_target_machine(opt=numba.config.OPT, **_options(target))


def _parsed(text: str) -> Any:
    module = ll.parse_assembly(text)
    module.triple = ll.get_process_triple()
    module.data_layout = cpu_target.target_context.codegen()._data_layout
    module.verify()
    return module


def _linked(result: Any, native: str, symbol: str) -> tuple[Any, tuple[int, int]]:
    """A module of the entry, all that it calls, and what spreads words into its arguments."""
    module = result.library._final_module.clone()
    found: dict[Any, None] = {}
    waiting = list(result.library._linking_libraries)
    while waiting:
        library = waiting.pop()
        if library not in found:
            found[library] = None
            waiting.extend(library._linking_libraries)
    for library in [*found, rtsys.library]:
        module.link_in(library._get_module_for_linking(), preserve=True)
    text, words = _trampoline(result, native, symbol)
    module.link_in(_parsed(text))
    module.link_in(_parsed(runtime.allocation()))
    return module, words


def _internal(module: Any, native: str, symbol: str, *, apart: bool) -> None:
    """Leave one symbol outside; with ``apart`` what a factory makes stays a function of its own."""
    for function in module.functions:
        if not function.is_declaration and function.name != symbol:
            function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration or variable.linkage == ll.Linkage.common:
            variable.linkage = "internal"
    # As a function of its own it keeps what is known of its arguments.
    module.get_function(native).add_function_attribute("noinline")
    for function in module.functions if apart else ():
        # As one function of all of them, their loops would find the registers taken.
        if function.is_declaration or not function.name.startswith(_OURS):
            continue
        if _FROM_A_FACTORY in function.name:
            function.add_function_attribute("noinline")


def _optimise(
    module: Any, target: Target, *, values_first: bool = False, twice: bool = False
) -> None:
    """Do what Numba does for a function that is called from Python, in its order.

    With ``values_first`` variables are made values before, as Numba does for each function alone;
    with ``twice`` the end is done once more, as it is for what such a function calls.
    """
    made_by = cpu_target.target_context.codegen()
    made_by._tm = _machine(target)
    cheap, options = made_by._module_pass_manager(
        loop_vectorize=made_by._loopvect, slp_vectorize=False, opt=made_by._opt_level, cost="cheap"
    )
    if values_first:
        # Else references are counted where a loop has a condition: no vector instructions then.
        first = ll.create_new_module_pass_manager()
        first.add_sroa_pass()
        first.add_simplify_cfg_pass()
        first.run(module, options)
    cheap.run(module, options)
    # By the second time vector loops ask whether arrays overlap: that goes before all steps then.
    for _ in range(2 if twice else 1):
        full, options = made_by._module_pass_manager()
        full.run(module, options)
    module.verify()


@functools.cache
def _system() -> Any:
    return ctypes.CDLL(ctypes.util.find_library("m") or "libm.so.6")


def _foreign(module: Any) -> list[str]:
    """Names that neither C nor its mathematics have."""
    system = _system()
    undefined = [
        value.name
        for values in (module.functions, module.global_variables)
        for value in values
        if value.is_declaration and not value.name.startswith("llvm.")
    ]
    return [name for name in undefined if not hasattr(system, name)]


_WORD = ir.IntType(64)


def _trampoline(result: Any, native: str, symbol: str) -> tuple[str, tuple[int, int]]:
    """A function of one address: there stand words for what goes in and what comes back."""
    context = cpu_target.target_context
    signature = result.signature
    kind = context.call_conv.get_function_type(signature.return_type, signature.args)
    back, trouble, *inward = kind.args
    outward = _leaves(back.pointee)
    module = ir.Module(symbol)
    called = ir.Function(module, kind, native)
    function = ir.Function(module, ir.FunctionType(ir.IntType(32), [_WORD.as_pointer()]), symbol)
    builder = ir.IRBuilder(function.append_basic_block())
    (room,) = function.args

    def word(n: int) -> Any:
        return builder.gep(room, [_WORD(n)])

    returned = builder.alloca(back.pointee)
    raised = builder.alloca(trouble.pointee)
    builder.store(back.pointee(None), returned)
    builder.store(trouble.pointee(None), raised)
    given = [
        _from_word(builder, builder.load(word(1 + len(outward) + n)), one)
        for n, one in enumerate(inward)
    ]
    status = builder.call(called, [returned, raised, *given])
    builder.store(builder.ptrtoint(builder.load(raised), _WORD), word(0))
    good = builder.or_(
        builder.icmp_signed("==", status, status.type(0)),
        builder.icmp_signed("==", status, status.type(-2)),
    )
    with builder.if_then(good):
        value = builder.load(returned)
        for n, path in enumerate(outward):
            leaf = builder.extract_value(value, path) if path else value
            builder.store(_to_word(builder, leaf), word(1 + n))
    builder.ret(status)
    return str(module), (len(outward), len(inward))


def _leaves(kind: Any, path: tuple[int, ...] = ()) -> list[tuple[int, ...]]:
    if isinstance(kind, ir.ArrayType):
        inner = [kind.element] * kind.count
    elif isinstance(kind, ir.BaseStructType):
        inner = list(kind.elements)
    else:
        return [path]
    return [leaf for n, one in enumerate(inner) for leaf in _leaves(one, (*path, n))]


def _from_word(builder: Any, word: Any, kind: Any) -> Any:
    if isinstance(kind, ir.PointerType):
        return builder.inttoptr(word, kind)
    if isinstance(kind, ir.DoubleType):
        return builder.bitcast(word, kind)
    if isinstance(kind, ir.FloatType):
        return builder.bitcast(builder.trunc(word, ir.IntType(32)), kind)
    if isinstance(kind, ir.IntType):
        return word if kind.width == 64 else builder.trunc(word, kind)
    raise UnfitError(f"an argument is {kind}")


def _to_word(builder: Any, leaf: Any) -> Any:
    kind = leaf.type
    if isinstance(kind, ir.PointerType):
        return builder.ptrtoint(leaf, _WORD)
    if isinstance(kind, ir.DoubleType):
        return builder.bitcast(leaf, _WORD)
    if isinstance(kind, ir.FloatType):
        return builder.zext(builder.bitcast(leaf, ir.IntType(32)), _WORD)
    if isinstance(kind, ir.IntType):
        if kind.width == 64:
            return leaf
        return (builder.zext if kind.width <= 8 else builder.sext)(leaf, _WORD)
    raise UnfitError(f"it returns {kind}")
