"""What a call of a kernel costs from a library of machine code, against Numba's own call.

Run it with ``make bench``. Both call the same small kernels with the same arguments in the same
run, so that nearly all of the time is the call's.
"""

import numpy as np
from _common import best, finish, on_one_core

from asperity.friction.lugre import stribeck_share
from asperity.friction.springs import stored_in_springs

CALLS = 2000
CALL_S = 5e-6


def main():
    on_one_core()
    three = [np.ones(3) for _ in range(3)]
    arguments = {
        "three floats": (stribeck_share, (0.1, 0.2, 1.0)),
        "three arrays": (stored_in_springs, tuple(three)),
    }
    report = {}
    for name, (kernel, given) in arguments.items():
        native = kernel._native(given) is not NotImplemented
        own = (
            best(
                lambda kernel=kernel, given=given: [kernel(*given) for _ in range(CALLS)],
                repeats=20,
            )
            / CALLS
        )
        numbas = kernel._dispatcher
        numbas(*given)
        other = (
            best(
                lambda numbas=numbas, given=given: [numbas(*given) for _ in range(CALLS)],
                repeats=20,
            )
            / CALLS
        )
        report[name] = {
            "from a library": str(native),
            "s for a call": own,
            "Numba's call over it": other / own,
        }
    finish(report, most={"s for a call": CALL_S})


if __name__ == "__main__":
    main()
