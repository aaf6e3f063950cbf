"""A block's march kept on disk as it stands, to go on from there.

Numbers that decide the result are kept to the last bit, and what the solution has learnt on its
way as well: a march that goes on ends exactly as one that was never interrupted.
"""

import dataclasses
from collections.abc import Mapping
from typing import Any

import numpy as np

from asperity.block.march import BlockMarch
from asperity.block.problem import BlockProblem
from asperity.block.result import inputs
from asperity.block.series import Frame
from asperity.contact.increment.memory import (
    inverses_as_arrays,
    restore_inverses,
    trend_as_arrays,
    trend_from,
)
from asperity.contact.increment.problem import Trend
from asperity.contact.increment.solver import ContactState, IncrementResult
from asperity.contact.motion import ledger
from asperity.contact.motion.system import SystemState
from asperity.runs.key import code_key, key
from asperity.runs.tree import Tree

_CONTACT = ("distance", "normal", "slip_1", "slip_2")
_HISTORY = (
    "displacement", "force", "deflection", "size", "multiplier", "pressure", "traction",
)  # fmt: skip
_STATE = ("coordinates", "drive", "forces")
_FRAME = ("time", "coordinates", "drive_force", "force", "pressure", "traction")


def key_of(problem: BlockProblem) -> str:
    """Return a text that is the same for what calculates the same, by these sources."""
    shape = problem.model.shape
    wave = ("", np.empty(0))
    if shape is not None:
        wave = repr((shape.code, shape.frequency, shape.rise)), shape.table
    return key(code_key("asperity.block.march"), repr(sorted(inputs(problem).items())), *wave)


def state(march: BlockMarch) -> Tree:
    """Return where a march stands as a tree of arrays; it must have begun."""
    walker = march.walker
    state, contact = walker.state, walker.state.contact
    arrays: dict[str, Any] = {
        "done": march.done,
        "seconds": [march.seconds, march.march_seconds, march.timed],
        "rows": np.array(march.rows),
        "sums": walker.sums,
        "mean_pressure": walker.mean_pressure,
        "cuts": [walker.cuts, walker.unconverged],
        "residual_max": walker.residual_max,
        "scalars": [state.time, state.load, contact.iterations, contact.residual],
        **{f"state_{name}": getattr(state, name) for name in _STATE},
        **{f"contact_{name}": getattr(contact, name) for name in _CONTACT},
        **{f"history_{name}": getattr(contact.state, name) for name in _HISTORY},
    }
    for name in _FRAME:
        arrays[f"frame_{name}"] = np.array([getattr(frame, name) for frame in march.frames])
    if march.window_energies is not None:
        arrays["window_energies"] = dataclasses.astuple(march.window_energies)
    if march.first_half is not None and march.first_pressure is not None:
        arrays["first_half"] = march.first_half
        arrays["first_pressure"] = march.first_pressure
    system, trend = walker.system, contact.state.trend
    arrays["lengths"] = system.lengths
    arrays["trend_length"] = -1
    for number, length in enumerate(system.lengths):
        increments = system.stepping(length)[1]
        arrays |= _named(f"inverses_{number}_", inverses_as_arrays(increments.inverses))
        if increments.flexibility is trend.flexibility:
            arrays["trend_length"] = number
    arrays |= _named("trend_", trend_as_arrays(trend))
    return arrays


def restore(march: BlockMarch, arrays: Mapping[str, Any]) -> None:
    """Put a march that has not begun to where another of the same problem stood."""
    time, load, iterations, residual = arrays["scalars"]
    system = march.problem.system
    trend = Trend()
    for number, length in enumerate(arrays["lengths"]):
        increments = system.stepping(float(length))[1]
        restore_inverses(increments, _under(f"inverses_{number}_", arrays))
        if number == arrays["trend_length"]:
            trend = trend_from(_under("trend_", arrays), increments.flexibility)
    history = ContactState(**{name: arrays[f"history_{name}"] for name in _HISTORY}, trend=trend)
    contact = IncrementResult(
        state=history,
        iterations=int(iterations),
        residual=float(residual),
        **{name: arrays[f"contact_{name}"] for name in _CONTACT},
    )
    state = SystemState(
        time=float(time),
        load=float(load),
        contact=contact,
        **{name: arrays[f"state_{name}"] for name in _STATE},
    )
    march.begin_from(state)
    cuts, unconverged = map(int, arrays["cuts"])
    worst = float(arrays["residual_max"])
    march.walker.restore((state, arrays["sums"], arrays["mean_pressure"], cuts, unconverged, worst))
    march.done = int(arrays["done"])
    march.seconds, march.march_seconds, timed = map(float, arrays["seconds"])
    march.timed = int(timed)
    march.rows = list(arrays["rows"])
    march.frames = [
        Frame(float(t), q, float(pull), *rest_of)
        for t, q, pull, *rest_of in zip(*(arrays[f"frame_{name}"] for name in _FRAME), strict=True)
    ]
    if "window_energies" in arrays:
        march.window_energies = ledger.Energies(*map(float, arrays["window_energies"]))
    if "first_half" in arrays:
        march.first_half, march.first_pressure = arrays["first_half"], arrays["first_pressure"]


def _named(prefix: str, arrays: Mapping[str, Any]) -> dict[str, Any]:
    return {prefix + name: array for name, array in arrays.items()}


def _under(prefix: str, arrays: Mapping[str, Any]) -> dict[str, Any]:
    return {name.removeprefix(prefix): a for name, a in arrays.items() if name.startswith(prefix)}
