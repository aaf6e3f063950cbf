"""Small libraries of machine code written by hand, so that calls of them are tested without Numba.

What a function does is told by the words that come back: which of the arguments' words each is.
"""

import functools

from asperity.kernels.native import gather
from asperity.kernels.native.back import words_of
from asperity.kernels.native.load import Library
from asperity.kernels.native.plan import Plan

# Counts what is released and remembers the last.
RELEASE = """
@released = global [2 x i64] zeroinitializer
define void @asperity_release(ptr %meminfo) {
  %count = load i64, ptr @released
  %more = add i64 %count, 1
  store i64 %more, ptr @released
  %last = getelementptr i64, ptr @released, i64 1
  %address = ptrtoint ptr %meminfo to i64
  store i64 %address, ptr %last
  ret void
}
"""


def signature(symbol, arguments, returns):
    """Return a row of the table."""
    back = words_of(returns)
    words = [back, Plan(arguments, back).words]
    told = {"symbol": symbol, "arguments": arguments, "returns": returns, "words": words}
    return told | {"features": []}


def function(row, words=None, status=0):
    """Return a function's text: what comes back are the arguments' words, or those of a list.

    A word of the list is the number of an argument's word, or (number, what is added to it), or
    (None, constant).
    """
    back, given = row["words"]
    words = range(given) if words is None else words
    lines = [f"define i32 @{row['symbol']}(ptr %room) {{"]
    for at, word in enumerate(words):
        number, added = word if isinstance(word, tuple) else (word, 0)
        value = str(added)
        if number is not None:
            lines += [
                f"  %from{at} = getelementptr i64, ptr %room, i64 {1 + back + number}",
                f"  %word{at} = load i64, ptr %from{at}",
                f"  %sum{at} = add i64 %word{at}, {added}",
            ]
            value = f"%sum{at}"
        lines += [
            f"  %to{at} = getelementptr i64, ptr %room, i64 {1 + at}",
            f"  store i64 {value}, ptr %to{at}",
        ]
    return "\n".join([*lines, f"  ret i32 {status}", "}"])


@functools.cache
def _target():
    import llvmlite.binding as llvm

    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm.Target.from_default_triple()


def _engine(text):
    import llvmlite.binding as llvm

    module = llvm.parse_assembly(text)
    module.verify()
    engine = llvm.create_mcjit_compiler(module, _target().create_target_machine(opt=1))
    engine.finalize_object()
    return engine


@functools.cache
def _gather():
    return _engine(gather.ir())


def addresses(*functions):
    """Return the function of a symbol's address, for a library of some functions."""
    engines = _gather(), _engine(RELEASE + "\n".join(functions))

    def address(symbol):
        return next(
            found
            for engine in engines
            for find in (engine.get_function_address, engine.get_global_value_address)
            if (found := find(symbol))
        )

    return address


def object_files(folder, *functions):
    """Write a library's objects; return their paths."""
    import llvmlite.binding as llvm

    # As they are made: LLVM loads none of code that may stand anywhere.
    machine = _target().create_target_machine(opt=1, reloc="pic", codemodel="default")
    files = []
    for number, text in enumerate([gather.ir(), RELEASE + "\n".join(functions)]):
        files.append(folder / f"{number}.o")
        files[-1].write_bytes(machine.emit_object(llvm.parse_assembly(text)))
    return files


def echo(arguments, returns):
    """Return a kernel that gives back the words it is called with."""
    row = signature("echo", arguments, returns)
    return one(row, function(row))


def one(row, text):
    """Return the kernel of one row."""
    return library([row], text).entry("kernel")


def library(rows, *functions):
    """Return a library of one kernel with some signatures."""
    table = {"sources": {}, "entries": {"kernel": {"sources": [], "signatures": rows}}}
    return Library(table, addresses(*functions))
