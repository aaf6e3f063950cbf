"""The processors that kernels are compiled for, and the words for them."""

import contextlib
import functools
import platform
import sys
from typing import NamedTuple


class Target(NamedTuple):
    """Processors that machine code is made for.

    Attributes
    ----------
    processor : str
        What LLVM calls them.
    tuning : str
        What LLVM is told beside.
    features : tuple of str
        What they can do, in the words of Linux.
    """

    processor: str
    tuning: str
    features: tuple[str, ...]


FEATURES = (
    "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "popcnt", "sse4_1", "sse4_2",
    "ssse3", "cx16", "lahf_lm", "pni", "xsave",
)  # fmt: skip
"""64 bit with AVX2 and FMA, as processors since 2013 have."""

PLAIN = Target("x86-64-v3", "", FEATURES)

_AVX512 = (*FEATURES, "avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl")

# LLVM would use half of a register; all of it is faster, and the bits are the same.
WIDE = Target("x86-64-v4", "-prefer-256-bit", _AVX512)

# A step alone has nothing to fill a register with. But there are twice as many of them, so that its
# numbers stay in registers, and what is chosen needs no branch.
HALF_WIDE = Target("x86-64-v4", "", _AVX512)

# Those that step by step take most of a command's time; all of them would make a library twice as
# large.
_FASTEST = {
    "asperity.slider.batch_kernels": WIDE,
    "asperity.slider.batch_pressed_kernels": WIDE,
    "asperity.slider.kernels": HALF_WIDE,
    "asperity.slider.pressed": HALF_WIDE,
    "asperity.slider.shooting": HALF_WIDE,
    "asperity.slider.two_phase": HALF_WIDE,
}


def targets(module: str) -> tuple[Target, ...]:
    """Return what a module's kernels are made for, the fastest first: bodies for AVX-512 too."""
    return (_FASTEST[module], PLAIN) if module in _FASTEST else (PLAIN,)


def here(module: str) -> Target:
    """Return the first of them that this processor is one of, or the last."""
    fitting = (one for one in targets(module) if set(one.features) <= features())
    return next(fitting, PLAIN)


@functools.cache
def features() -> frozenset[str]:
    """Return what the processor can do, in the words of Linux."""
    # The first processor's lines only: asking for all of them can take long.
    with contextlib.suppress(OSError), open("/proc/cpuinfo", encoding="ascii") as lines:
        for line in lines:
            name, _, words = line.partition(":")
            if name.strip() in ("flags", "Features"):
                return frozenset(words.split())
    return frozenset()


def platform_name() -> str:
    """Return the machine and its system, as ``x86_64-linux``."""
    return f"{platform.machine().lower()}-{sys.platform}"
