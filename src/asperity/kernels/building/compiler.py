"""What a library of kernels needs of a machine to be made there; known without Numba."""

import os
import shlex
import shutil
import sys

from asperity.kernels.native.target import platform_name

TARGET = "x86_64-linux"
"""What machine code is made for so far."""


def compiler() -> list[str] | None:
    """Return the command of the system's C compiler, which links; None where there is none.

    It is what ``CC`` in the environment says, else the first of cc, gcc and clang. A ``CC`` that is
    not quoted as a shell would have it names none.
    """
    try:
        said = shlex.split(os.environ.get("CC", ""))
    except ValueError:
        return None
    for words in [said] if said else [["cc"], ["gcc"], ["clang"]]:
        if shutil.which(words[0]) is not None:
            return words
    return None


def without_settings() -> None:
    """Let Numba, which is not loaded yet, read no settings from the folder that one works in.

    What is made is for everybody; and reading such a file takes a tenth of loading Numba.
    """
    sys.modules["yaml"] = None  # type: ignore[assignment]


def hindrance() -> str | None:
    """Return why no library can be made on this machine; None where it can."""
    if platform_name() != TARGET:
        return f"it is made for {TARGET} only, not for {platform_name()}"
    if compiler() is None:
        return "no C compiler is found (cc, gcc, clang, or what CC names)"
    return None
