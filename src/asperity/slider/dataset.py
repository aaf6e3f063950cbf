"""A result as a labelled dataset: histories over time, scalars, and what was solved."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

    from asperity.slider.model import Model
    from asperity.slider.result import SlideResult

_HISTORY = {
    "friction": ("N", "friction force on the body"),
    "deflection": ("m", "deflection of the asperities"),
    "position": ("m", "position of the body"),
    "velocity": ("m/s", "velocity of the body, half a step later"),
}
_POWERS = {
    "drive": "power of the drive",
    "vibration": "power of the vibration",
    "friction": "power lost to friction",
    "damping": "power lost in the drive's damper",
    "stored": "rate of change of stored energy",
    "untransferred": "power friction would take from the untransferred vibration",
}


def to_dataset(result: "SlideResult") -> "xr.Dataset":
    """Return a result as a dataset in SI, each variable with ``units`` and ``long_name``.

    Scalars are variables without dimension, vectors have the dimension ``axis`` (x along the
    drive, y across), histories also ``time``. What does not exist is left out: the breakaway of a
    body that never broke away, the powers without a ledger. The values of the case's tables are
    attributes named ``table.key``, in SI.
    """
    import xarray as xr

    variables: dict[str, Any] = {}

    def add(name: str, values: Any, units: str, long_name: str, *dims: str) -> None:
        variables[name] = (dims, values, {"units": units, "long_name": long_name})

    add("ratio", result.ratio, "1", "mean drive force over mu F_N")
    add("mean_drive_force", result.drive_force, "N", "mean drive force")
    add("static_drive_force", result.static_drive_force, "N", "drive force without vibration")
    for kind in ("mean", "max", "min"):
        values = np.array(getattr(result, f"friction_{kind}"))
        add(f"{kind}_friction", values, "N", f"{kind} friction force on the body", "axis")
    if result.breakaway_time is not None:
        add("breakaway_time", result.breakaway_time, "s", "time of breakaway")
    if result.ledger is not None:
        for name, long_name in _POWERS.items():
            add(f"power_{name}", getattr(result.ledger, name), "W", long_name)
        add("power_residual", result.ledger.residual, "1", "missing power over that of the drive")
    add("residual", result.residual, "1", "residual of the method")
    coordinates = {
        "axis": (
            "axis",
            np.array(["x", "y"], dtype=object),
            {"units": "1", "long_name": "direction: x along the drive, y across"},
        )
    }
    history = result.history
    if history is not None:
        coordinates["time"] = ("time", history.time, {"units": "s", "long_name": "time"})
        add("drive_force", history.drive_force, "N", "drive force", "time")
        for name, (units, long_name) in _HISTORY.items():
            add(name, getattr(history, name), units, long_name, "time", "axis")
    attributes = {
        "title": "Sliding body",
        "steps": result.steps,
        "cycles": result.cycles,
        "notes": "; ".join(result.notes),
    }
    return xr.Dataset(variables, coordinates, attributes | inputs(result.model))


def inputs(model: "Model") -> dict[str, str | float]:
    """Return the values of a model's tables as plain numbers in SI and texts, by ``table.key``."""
    plain: dict[str, str | float] = {}
    for table in (model.slider, model.friction, model.vibration, model.solve):
        if table is None:
            continue
        for key, value in table:
            if isinstance(value, Path):
                plain[f"{table.table}.{key}"] = str(value)
            elif value is not None:
                plain[f"{table.table}.{key}"] = value
    return plain
