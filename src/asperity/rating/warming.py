"""How a housing warms and cools in its duty, one mass from cold."""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521 import balance
from asperity.rating.result import Rating

_CYCLES = 400
_TIMES = 5.0
_POINTS = 24


class Warming(NamedTuple):
    """The temperature of a housing over time.

    Attributes
    ----------
    time : ndarray
        s.
    temperature : ndarray
        degC.
    """

    time: FloatArray
    temperature: FloatArray


def warming(inputs: Inputs, iso: Rating) -> Warming | None:
    """Return how the housing warms from cold; None where its heat capacity is not known.

    Parameters
    ----------
    inputs : Inputs
        What was rated.
    iso : Rating
        By ISO/TR 14521, with the heat balance of a housing.
    """
    housing, spectrum = inputs.operation.housing, inputs.operation.spectrum
    if housing is None or "tau_s" not in iso:
        return None
    tau, steady = float(iso["tau_s"]), float(iso["rise_h_K"])
    phases = [(_TIMES * tau, steady, tau)]
    if spectrum is not None and spectrum.how.kind != "S1":
        how, cycle = spectrum.how, spectrum.cycle
        rest = tau
        if housing.at_rest is not None:
            rest = tau * housing.heat_transfer / housing.at_rest
        phases = [(how.time, steady, tau), (_TIMES * rest, 0.0, rest)]
        if how.kind == "S3":
            count = min(max(int(_TIMES * tau / cycle), 3), _CYCLES)
            one = [(how.share * cycle, steady, tau), ((1.0 - how.share) * cycle, 0.0, rest)]
            phases = one * count
    times, rises = [np.zeros(1)], [np.zeros(1)]
    for length, target, constant in phases:
        at = np.linspace(0.0, length, _POINTS)[1:]
        # What is left of the way to the target falls off as the formula of a rise from cold has it.
        gone = balance.rise_after(1.0, at, constant)
        start = rises[-1][-1]
        rises.append(start + (target - start) * gone)
        times.append(times[-1][-1] + at)
    return Warming(np.concatenate(times), inputs.ambient_temperature + np.concatenate(rises))
