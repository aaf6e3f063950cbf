"""Kernels that do not count references to the arrays they are given.

Numba counts, atomically, for every function that an array or a named tuple with arrays goes through
on its way, which a loop over short steps pays for more than for what it calculates. A kernel that
makes no arrays has nothing to count for: who called it holds them.
"""

from asperity.kernels.compiled import Kernel


def uncounted(kernel: Kernel) -> Kernel:
    """Return a kernel that is compiled without counts; it may call no NumPy that makes arrays.

    Parameters
    ----------
    kernel : Kernel
        From `asperity.kernels.compiled.kernel`, not called yet.
    """
    kernel._options["_nrt"] = False  # type: ignore[attr-defined]
    return kernel
