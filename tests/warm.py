"""Make the machine code that the tests call, once, on all cores and before they start.

``python tests/warm.py`` does it by itself: every entry of the list of kernels that ordinary tests
call, or every one with ``--slow``, the dearest first. They are kept on disk under what they follow
from, so that nothing is done where it was done before.
"""

import os
import sys


def compile_kernels(*, slow=True):
    """Make what is not made yet."""
    # Where no kernel's machine code is asked for, none is made.
    if os.environ.get("ASPERITY_NATIVE") == "0":
        return

    from harvest import SLOW_ROOMS

    from asperity.kernels.native import entries, kept

    held = entries.listed()
    ordinary = {n for line in held.lines.keys() - set(SLOW_ROOMS) for n in held.lines[line]}
    kept.make(each for each in held.entries if slow or each.number in ordinary)


if __name__ == "__main__":
    compile_kernels(slow="--slow" in sys.argv[1:])
