"""A block's march kept on disk where it was interrupted, to go on from there."""

import dataclasses
import hashlib
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from asperity.compiled import package_hash
from asperity.contact import ledger
from asperity.contact.block import BlockProblem
from asperity.contact.block_march import BlockMarch
from asperity.contact.dataset import inputs
from asperity.contact.increment import ContactState, IncrementResult
from asperity.contact.result import Frame
from asperity.contact.steps import SystemState
from asperity.store import write_atomically

_CONTACT = ("pressure", "distance", "normal", "traction", "slip_1", "slip_2")
_HISTORY = ("displacement", "force", "deflection", "size", "multiplier", "touching")
_STATE = ("coordinates", "drive", "forces")
_FRAME = ("time", "coordinates", "drive_force", "force", "pressure", "traction")


def fingerprint(problem: BlockProblem) -> str:
    """Return a text that is the same for what calculates the same, by these sources."""
    digest = hashlib.sha256(repr(sorted(inputs(problem).items())).encode())
    if problem.model.shape is not None:
        digest.update(np.ascontiguousarray(problem.model.shape.table).tobytes())
    digest.update(package_hash().encode())
    return digest.hexdigest()


def keep(march: BlockMarch, path: Path) -> Path:
    """Write where a march stands; it must have begun.

    Raises
    ------
    StorageError
        The file cannot be written.
    """
    walker = march.walker
    state, contact = walker.state, walker.state.contact
    arrays: dict[str, Any] = {
        "fingerprint": fingerprint(march.problem),
        "done": march.done,
        "seconds": [march.seconds, march.march_seconds],
        "rows": np.array(march.rows),
        "sums": walker.sums,
        "mean_pressure": walker.mean_pressure,
        "cuts": walker.cuts,
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
    return write_atomically(path, lambda target: np.savez(target, **arrays))


def go_on(march: BlockMarch, path: Path) -> bool:
    """Put a march that has not begun to where another was interrupted.

    Returns
    -------
    bool
        Whether there was one, of the same problem and made by the same sources.
    """
    try:
        with np.load(path, allow_pickle=False) as kept:
            if str(kept["fingerprint"]) != fingerprint(march.problem):
                return False
            arrays = {name: kept[name] for name in kept.files}
    except (OSError, ValueError, KeyError, zipfile.BadZipFile):
        return False
    time, load, iterations, residual = arrays["scalars"]
    rest = ContactState.rest(march.problem.system.stepping(march.problem.timetable.step)[1])
    history = dataclasses.replace(rest, **{name: arrays[f"history_{name}"] for name in _HISTORY})
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
    march.walker.restore((state, arrays["sums"], arrays["mean_pressure"], int(arrays["cuts"])))
    march.done = int(arrays["done"])
    march.seconds, march.march_seconds = map(float, arrays["seconds"])
    march.rows = list(arrays["rows"])
    march.frames = [
        Frame(float(t), q, float(pull), *rest_of)
        for t, q, pull, *rest_of in zip(*(arrays[f"frame_{name}"] for name in _FRAME), strict=True)
    ]
    if "window_energies" in arrays:
        march.window_energies = ledger.Energies(*map(float, arrays["window_energies"]))
    if "first_half" in arrays:
        march.first_half, march.first_pressure = arrays["first_half"], arrays["first_pressure"]
    return True
