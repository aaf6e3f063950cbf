"""What a call of a kernel costs from a library of machine code, against Numba's own call.

Run it with ``make bench``. Both call the same small kernels with the same arguments in the same
run, so that nearly all of the time is the call's. Beside them a function of the C library that does
next to nothing is called by ctypes with as many arguments: a call of machine code cannot cost less.
It ends with 1 where a call costs more times that than is promised, or there is no library.
"""

import ctypes

import numpy as np
from _common import best, finish, on_one_core

from asperity.friction.lugre import stribeck_share
from asperity.friction.springs import stored_in_springs

CALLS = 2000
CALL_S = 5e-6
# Five microseconds where the empty call takes 0.63.
TIMES = 8.0


def seconds(function, given):
    """Shortest time of a call."""
    return best(lambda: [function(*given) for _ in range(CALLS)], repeats=20) / CALLS


def main():
    """Print one line for each."""
    on_one_core()
    three = [np.ones(3) for _ in range(3)]
    arguments = {
        "three floats": (stribeck_share, (0.1, 0.2, 1.0)),
        "three arrays": (stored_in_springs, tuple(three)),
    }
    empty = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.c_int, ctypes.c_int)(
        ("abs", ctypes.CDLL(None))
    )
    nothing = seconds(empty, (1, 2, 3))
    report = {"nothing, by ctypes": {"s for it": nothing}}
    for name, (kernel, given) in arguments.items():
        is_native = kernel._native(given) is not NotImplemented
        own = seconds(kernel, given)
        numbas = kernel._dispatcher
        numbas(*given)
        report[name] = {
            "from a library": float(is_native),
            "s for a call": own,
            "times nothing": own / nothing,
            "Numba's call over it": seconds(numbas, given) / own,
        }
    finish(
        report,
        most={"s for a call": CALL_S},
        held={"times nothing": TIMES},
        least={"from a library": 1.0},
    )


if __name__ == "__main__":
    main()
