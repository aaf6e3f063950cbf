"""The words that a shaken drive's ratio is read with."""

import math

from asperity.results.words import Number, Sentence

BALANCED = 5e-3
"""Of the load: what a settled wheel is out of balance by at most."""

_RESOLVED = 1e-5  # of a balance


def state_of(settled: bool, balance: float) -> str:
    """Return what a torque ratio is to be read with."""
    form, sign = (".2g" if abs(balance) > _RESOLVED else ".0f"), math.copysign(100.0, balance)
    off = Number.of(balance, form, "torque_balance", sign)
    word = "settled" if settled else "not settled"
    how = "in balance to" if abs(balance) <= BALANCED else "out of balance by"
    return Sentence(f"{word}, wheel {how} ", off, " %")
