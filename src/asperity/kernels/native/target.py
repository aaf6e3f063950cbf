"""The processor that kernels are compiled for, and the words for it."""

import platform
import sys

PROCESSOR = "x86-64-v3"
"""What LLVM calls it: 64 bit with AVX2 and FMA, as processors since 2013 have."""

FEATURES = (
    "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "abm", "movbe", "popcnt", "sse4_1", "sse4_2",
    "ssse3", "cx16", "lahf_lm", "pni", "xsave",
)  # fmt: skip
"""The same in the words of Linux."""


def platform_name() -> str:
    """Return the machine and its system, as ``x86_64-linux``."""
    return f"{platform.machine().lower()}-{sys.platform}"
