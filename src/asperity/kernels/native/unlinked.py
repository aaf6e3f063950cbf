"""Machine code that nothing has linked, for want of a C compiler: object files, loaded by LLVM."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from asperity.kernels.native import load
from asperity.kernels.native.call import Addresses


def opened(rows: dict[str, Any], files: Sequence[Path]) -> load.Library | None:
    """Return the library of a table and its object files; None where they cannot be loaded here."""
    try:
        return load.Library(rows, _addresses(files))
    except (OSError, RuntimeError):
        return None


def _addresses(files: Sequence[Path]) -> Addresses:
    import llvmlite.binding as ll

    ll.initialize_native_target()
    ll.initialize_native_asmprinter()
    # Mathematics that the machine code calls.
    ll.load_library_permanently("libm.so.6")
    machine = ll.Target.from_default_triple().create_target_machine(reloc="pic")
    engine = ll.create_mcjit_compiler(ll.parse_assembly(""), machine)
    for file in files:
        engine.add_object_file(str(file))
    engine.finalize_object()

    def address(symbol: str) -> int:
        return int(engine.get_function_address(symbol))

    return address
