r"""LuGre: Dahl's asperity with a limit that falls with speed, and with damping.

:math:`F = k_t s + h_t \dot s + h_v v`, :math:`\dot s = v - (a\,k_t/g(|v|))\,s`,
:math:`g(|v|) = \mu F_N + (F_S - \mu F_N)\exp[-(|v|/v_s)^2]`.

The thesis prints the exponent as :math:`-(v_r/v_s)` (A.5, 43), which grows without bound for a
negative slip and is 0/0 for :math:`F_S = v_s = 0`; here the square is taken, as in Canudas de Wit
et al. 1995, and without a Stribeck velocity :math:`g = \mu F_N`.
"""

import math

from asperity.compiled import kernel


@kernel
def stribeck_share(speed, static_ratio, stribeck_speed):
    r""":math:`g(|v|)/\mu F_N` for the ratio ``static_ratio`` = :math:`F_S/\mu F_N`.

    ``speed`` and ``stribeck_speed`` in the same unit; a Stribeck speed of zero means none.
    """
    if stribeck_speed <= 0.0:
        return 1.0
    x = speed / stribeck_speed
    return 1.0 + (static_ratio - 1.0) * math.exp(-x * x)
