"""Make the machine code that the tests call, once, on all cores and before they start.

``python tests/warm.py`` does it by itself: every entry of the list of kernels, the dearest first.
They are kept on disk under what they follow from, so that nothing is done where it was done before.
"""

import os


def compile_kernels():
    """Make what is not made yet."""
    # Where no kernel's machine code is asked for, none is made.
    if os.environ.get("ASPERITY_NATIVE") == "0":
        return

    from asperity.kernels.native import entries, kept

    kept.make(entries.listed().entries)


if __name__ == "__main__":
    compile_kernels()
