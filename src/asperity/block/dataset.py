"""A block's result as a labelled dataset; also of a run that did not come to its end."""

from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.slider import dataset as slider_dataset

if TYPE_CHECKING:
    import xarray as xr

    from asperity.block.problem import BlockProblem
    from asperity.block.result import BlockResult
    from asperity.slider.result import History


def to_dataset(result: "BlockResult") -> "xr.Dataset":
    """Return a result as a dataset in SI, each variable with ``units`` and ``long_name``.

    Everything `asperity.slider.dataset.to_dataset` gives, and the mean pressure over the face with
    the dimension ``node``, whose positions are the coordinates ``node_x`` and ``node_y``.
    """
    dataset = slider_dataset.to_dataset(result)
    problem = result.problem

    def add(name: str, value: Any, units: str, long_name: str, *dims: str) -> None:
        dataset[name] = (dims, value, {"units": units, "long_name": long_name})

    add("normal_force", result.normal_force, "N", "mean normal force")
    add("pressure", result.nodal_pressure, "Pa", "mean contact pressure in the window", "node")
    positions = problem.body.positions
    add("node_x", positions[:, 0], "m", "position of the contact nodes along the drive", "node")
    add("node_y", positions[:, 1], "m", "position of the contact nodes across it", "node")
    add("peak_pressure", result.peak_pressure, "Pa", "greatest pressure in the window")
    add("iterations_mean", result.iterations_mean, "1", "mean iterations of an increment")
    ledger = result.to_json()
    for name, long_name in (
        ("loads", "power of gravity and pressure"),
        ("numerical", "power dissipated by the time integration"),
        ("transfer", "power friction takes from lateral motion the contact does not see"),
    ):
        if f"power_{name}_W" in ledger:
            add(f"power_{name}", ledger[f"power_{name}_W"], "W", long_name)
    attributes = {
        "title": "Elastic block",
        "iterations_max": result.iterations_max,
        "increments_cut": result.cuts,
        "unconverged": result.unconverged,
        "residual_increment_max": result.residual_increment_max,
        "newmark_beta": problem.system.newmark_beta(problem.timetable.step),
        "solver": problem.body.solver,
    }
    return dataset.set_coords(["node_x", "node_y"]).assign_attrs(attributes | inputs(problem))


def unfinished_dataset(problem: "BlockProblem", history: "History", why: str) -> "xr.Dataset":
    """Return the history of a run up to where it ended, with the reason as attribute ``ended``."""
    import xarray as xr

    axis = {"units": "1", "long_name": "direction: x along the drive, y across"}
    variables: dict[str, Any] = {
        "drive_force": ("time", history.drive_force, {"units": "N", "long_name": "drive force"})
    }
    for name, units, long_name in (
        ("friction", "N", "friction force on the body"),
        ("deflection", "m", "deflection of the asperities"),
        ("position", "m", "position of the body"),
        ("velocity", "m/s", "velocity of the body"),
    ):
        labels = {"units": units, "long_name": long_name}
        variables[name] = (("time", "axis"), getattr(history, name), labels)
    coordinates = {
        "axis": ("axis", np.array(["x", "y"], dtype=object), axis),
        "time": ("time", history.time, {"units": "s", "long_name": "time"}),
    }
    attributes: dict[str, Any] = {"title": "Elastic block, unfinished", "ended": why}
    return xr.Dataset(variables, coordinates, attributes | inputs(problem))


def inputs(problem: "BlockProblem") -> dict[str, Any]:
    """Return the values of a problem's tables as plain numbers in SI and texts."""
    plain: dict[str, Any] = dict(slider_dataset.inputs(problem.model))
    for table in (problem.block, problem.contact):
        for key, value in table:
            if value is not None:
                plain[f"{table.table}.{key}"] = list(value) if isinstance(value, tuple) else value
    normal = problem.normal
    plain["contact.stiffness"] = normal.stiffness
    if normal.name == "two-stage":
        plain["contact.initial_stiffness"] = normal.initial
        plain["contact.transition"] = [normal.start, normal.end]
    return plain
