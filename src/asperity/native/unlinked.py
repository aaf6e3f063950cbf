"""Machine code that nothing has linked, for want of a C compiler: object files, loaded by LLVM."""

import hashlib
import logging
from pathlib import Path

from asperity.native import load, table
from asperity.native.call import Addresses

OBJECTS = ("kernels.o", "support.o")
"""Files of a folder without a library."""

_log = logging.getLogger(__name__)


def from_folder(folder: Path, remedy: str) -> load.Library | None:
    """Return the library of a folder that has its object files; None where they are damaged."""
    try:
        rows = table.read(folder)
        files = [folder / name for name in OBJECTS]
        held = b"".join(file.read_bytes() for file in files)
        if rows is None or not load.is_for_here(rows["target"], rows["features"]):
            return None
        if hashlib.sha256(held).hexdigest() != rows["library"]:
            raise table.DamagedError(f"{folder} is damaged")
    except (table.DamagedError, OSError) as trouble:
        _log.warning("%s: kernels are compiled instead; %s", trouble, remedy)
        return None
    return load.Library(rows, _addresses(files))


def _addresses(files: list[Path]) -> Addresses:
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
