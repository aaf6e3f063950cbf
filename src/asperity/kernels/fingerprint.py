"""What the last bits of a result follow from beside the sources: versions and the processor."""

import contextlib
import functools
import hashlib
import itertools
from importlib.metadata import version

_NAMES = ("vendor_id", "cpu family", "model", "flags", "CPU implementer", "CPU part", "Features")


@functools.cache
def machine() -> tuple[str, str, str]:
    """Return versions of Numba and NumPy and what the processor is; neither is loaded for it."""
    return version("numba"), version("numpy"), _processor()


def _processor() -> str:
    said = []
    # Of the first one only: asking for all of them can take long.
    with contextlib.suppress(OSError), open("/proc/cpuinfo", encoding="ascii") as lines:
        for line in itertools.takewhile(str.strip, lines):
            name, _, words = line.partition(":")
            if name.strip() in _NAMES:
                said.append(words.strip())
    if said:
        return hashlib.sha256("\0".join(said).encode()).hexdigest()[:16]

    import llvmlite.binding

    name = llvmlite.binding.get_host_cpu_name()
    return str(name)
