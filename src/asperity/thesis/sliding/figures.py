"""Figures of chapters 2 and 4, each a few lines over the slider; drawn by `drawings_sliding`."""

import dataclasses
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.slider import Model, SlideResult
from asperity.slider.closed_forms import dahl_from_rest, longitudinal_ratio, transverse_ratio
from asperity.thesis.exhibits import Drawn, labelled
from asperity.thesis.sliding import drawings
from asperity.thesis.sliding.bodies import PERIODIC, TWO_PHASE, Body, Sweep
from asperity.thesis.sliding.claims import ALL_AROUND, DIRECTION, LUGRE, MARKED, PLOTTED, RATIO

if TYPE_CHECKING:
    import xarray as xr

_DENSE = "0.1:20:0.1"
_SCHEMES = ("exponential", "two-phase")
_CLOSED = "asperity.slider.closed_forms"


def side_by_side(
    names: Sequence[str], histories: Sequence["xr.Dataset"], full_force: float
) -> "xr.Dataset":
    """Histories of one variable of several bodies, each over its own times, and mu F_N."""
    import xarray as xr

    renamed = []
    for name, history in zip(names, histories, strict=True):
        (keep,) = history.data_vars
        own = drawings.own_names(str(keep), name)
        renamed.append(history.rename({keep: own[0], "time": own[1]}))
    joined = xr.merge(renamed, combine_attrs="override")
    joined.attrs.clear()
    labels = {"units": "1", "long_name": "what was solved"}
    joined = joined.assign_coords(body=("body", np.array(names, dtype=object), labels))
    labels = {"units": "N", "long_name": "full friction force"}
    joined["full_force"] = ((), full_force, labels)
    return joined


def _solved(names: Sequence[str], results: Sequence[SlideResult], keep: str) -> "xr.Dataset":
    histories = [result.to_dataset()[[keep]] for result in results]
    return side_by_side(names, histories, results[0].static_drive_force)


def two_cycles(history: "xr.Dataset", model: Model) -> "xr.Dataset":
    """The last two whole cycles, with the time counted from the start of the first of them."""
    period = 1.0 / model.frequency
    end = float(history["time"][-1])
    whole = np.floor((end - model.start) / period + 1e-6) - 2
    begin = model.start + whole * period
    part = history.sel(time=slice(begin - 1e-9, begin + 2 * period + 1e-9))
    attributes = {"units": "s", "long_name": "time from the start of a vibration cycle"}
    return part.assign_coords(time=("time", part["time"].values - begin, attributes))


def _schemes(case: str, ratio: str) -> list[Body]:
    settings = (f"{RATIO}={ratio}",)
    return [Body(case, settings), Body(case, (*settings, TWO_PHASE))]


def figure_2_7() -> Drawn:
    """Dahl's force over displacement."""
    force, s_max = 5.5, 68.75e-9
    exponents = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    x = np.linspace(0.0, 4.0 * s_max, 401)
    values = dahl_from_rest(x, force, s_max, exponents[:, None])
    dataset = labelled(
        displacement=(("displacement",), x, "m", "displacement"),
        exponent=(("exponent",), exponents, "1", "Dahl's exponent"),
        force=(("exponent", "displacement"), values, "N", "friction force"),
        full_force=((), force, "N", "full friction force"),
        deflection_limit=((), s_max, "m", "deflection limit"),
    )
    how = [f"{_CLOSED}.dahl_from_rest(x, 5.5, 68.75e-9, exponent)"]
    return Drawn(drawings.force_over_displacement(dataset), dataset, how)


def _cycle(bodies: Sequence[Body], names: Sequence[str]) -> Drawn:
    """Base velocity and friction over one cycle of periodic states."""
    results = [body.solve() for body in bodies]
    dataset = _solved(names, results, "friction")
    model = results[0].model
    _, time = drawings.own_names("friction", names[0])
    base = np.cos(2.0 * np.pi * model.frequency * dataset[time].values)
    labels = {"units": "m/s", "long_name": "velocity of the base"}
    dataset["base_velocity"] = (time, model.peak_velocity * base, labels)
    labels = {"units": "m/s", "long_name": "drive velocity"}
    dataset["drive_velocity"] = ((), model.slider.drive_velocity, labels)
    return Drawn(drawings.cycle(dataset), dataset, [body.command for body in bodies])


def figure_2_14() -> Drawn:
    """Coulomb friction over a cycle."""
    return _cycle([Body("table-4.1-L2", (PERIODIC,))], ["rigid drive"])


def figure_2_15() -> Drawn:
    """Dahl friction over a cycle."""
    rigid = (
        "slider.normal_force=55 N",
        "friction.max_deflection=68.75 nm",
        "vibration.frequency=4 kHz",
        "vibration.velocity_amplitude=0.75 mm/s",
    )
    bodies = [
        Body("table-4.3", ("vibration.velocity_amplitude=0.75 mm/s", PERIODIC)),
        Body("table-4.1-L4", (*rigid, PERIODIC)),
    ]
    return _cycle(bodies, ["compliant drive", "rigid drive"])


def figure_2_16() -> Drawn:
    """Coulomb friction over a cycle of transverse vibration."""
    body = Body("table-4.1-L2", (PERIODIC, f"{DIRECTION}=90 deg"))
    result = body.solve()
    model, history = result.model, result.history
    if history is None:
        raise ValueError("solved without a history")
    time = history.time
    dataset = labelled(
        time=(("time",), time, "s", "time"),
        axis=(("axis",), np.array(["x", "y"], dtype=object), "1", "along and across the drive"),
        base_velocity=(
            ("time",), model.peak_velocity * np.cos(2.0 * np.pi * model.frequency * time), "m/s",
            "velocity of the base across the drive",
        ),
        drive_velocity=((), model.slider.drive_velocity, "m/s", "drive velocity"),
        friction=(("time", "axis"), history.friction, "N", "friction on the body"),
        mean_friction=((), result.friction_mean[0], "N", "mean friction along the drive"),
        full_force=((), result.static_drive_force, "N", "full friction force"),
    )  # fmt: skip
    return Drawn(drawings.transverse_cycle(dataset), dataset, [body.command])


def _basic(names: Sequence[str]) -> Drawn:
    bodies = [Body(f"table-4.1-{name}", ("solve.duration=30 ms",)) for name in names]
    dataset = _solved(names, [body.solve() for body in bodies], "drive_force")
    return Drawn(drawings.stacked(dataset), dataset, [body.command for body in bodies])


def figure_4_3() -> Drawn:
    """Drive force of L1 and L3."""
    return _basic(["L1", "L3"])


def figure_4_4() -> Drawn:
    """Drive force of L2, L4, L5 and L6."""
    return _basic(["L2", "L4", "L5", "L6"])


def _over_ratio(case: str, laws: Sequence[str], closed: Callable[[Any], Any]) -> Drawn:
    """Periodic states of some laws and a closed form as lines, both schemes as markers."""
    marched = Sweep(case, ((RATIO, MARKED),))
    two_phase = Sweep(case, ((RATIO, MARKED),), (TWO_PHASE,))
    settled = [Sweep(case, ((RATIO, _DENSE),), (PERIODIC, f"friction.law={law}")) for law in laws]
    dense = settled[0].values()
    dataset = labelled(
        k=(("k",), dense, "1", "velocity ratio v_a/v_d"),
        k_marched=(("k_marched",), marched.values(), "1", "velocity ratio v_a/v_d, marched"),
        law=(("law",), np.array(laws, dtype=object), "1", "relaxation law"),
        exponential=(("k_marched",), marched.ratios(), "1", "ratio, exponential scheme"),
        two_phase=(("k_marched",), two_phase.ratios(), "1", "ratio, two-phase scheme"),
        periodic=(
            ("law", "k"), np.array([sweep.ratios() for sweep in settled]), "1",
            "ratio, periodic state",
        ),
        rigid=(("k",), closed(dense), "1", "ratio, rigid Coulomb friction and rigid drive"),
    )  # fmt: skip
    how = [sweep.command for sweep in (marched, two_phase, *settled)]
    return Drawn(drawings.over_ratio(dataset), dataset, how)


def figure_4_17() -> Drawn:
    """Ratio over k, longitudinal."""
    drawn = _over_ratio("table-4.3", ["split"], longitudinal_ratio)
    return dataclasses.replace(drawn, how=[*drawn.how, f"{_CLOSED}.longitudinal_ratio(k)"])


def figure_4_20() -> Drawn:
    """Ratio over k, transverse."""
    drawn = _over_ratio(
        "table-4.4", ["split", "unsplit", "vector"], lambda k: transverse_ratio(0.71 * k)
    )
    return dataclasses.replace(drawn, how=[*drawn.how, f"{_CLOSED}.transverse_ratio(0.71 * k)"])


def _drive_over_time(case: str, ratio: str) -> Drawn:
    bodies = _schemes(case, ratio)
    dataset = _solved(_SCHEMES, [body.solve() for body in bodies], "drive_force")
    return Drawn(drawings.drive_over_time(dataset), dataset, [body.command for body in bodies])


def _friction_over_cycles(case: str, ratio: str, axes: Sequence[str]) -> Drawn:
    bodies = _schemes(case, ratio)
    results = [body.solve() for body in bodies]
    cycles = [two_cycles(result.to_dataset()[["friction"]], result.model) for result in results]
    dataset = side_by_side(_SCHEMES, cycles, results[0].static_drive_force).sel(axis=list(axes))
    how = [body.command for body in bodies]
    return Drawn(drawings.friction_over_cycles(dataset), dataset, how)


def figure_4_18() -> Drawn:
    """Drive force over time, longitudinal, k = 6."""
    return _drive_over_time("table-4.3", "6")


def figure_4_19() -> Drawn:
    """Friction over time, longitudinal, k = 6."""
    return _friction_over_cycles("table-4.3", "6", ["x"])


def figure_4_21() -> Drawn:
    """Drive force over time, transverse, k = 20."""
    return _drive_over_time("table-4.4", "20")


def figure_4_22() -> Drawn:
    """Friction over time, transverse, k = 20."""
    return _friction_over_cycles("table-4.4", "20", ["x", "y"])


def figure_4_23() -> Drawn:
    """Ratio over direction."""
    axes = ((RATIO, PLOTTED), (DIRECTION, ALL_AROUND))
    marched = Sweep("table-4.4", axes)
    settled = Sweep("table-4.4", ((RATIO, PLOTTED), (DIRECTION, "0:360:3")), (PERIODIC,))
    lugre = Sweep("table-4.4", ((RATIO, "2,20"), (DIRECTION, ALL_AROUND)), LUGRE)
    dataset = labelled(
        k=(("k",), marched.values(), "1", "velocity ratio v_a/v_d"),
        theta=(("theta",), marched.values(1), "deg", "direction of vibration"),
        theta_dense=(("theta_dense",), settled.values(1), "deg", "direction of vibration, line"),
        k_lugre=(("k_lugre",), lugre.values(), "1", "velocity ratio v_a/v_d, LuGre"),
        dahl=(("k", "theta"), marched.ratios(), "1", "ratio, Dahl, marched"),
        periodic=(("k", "theta_dense"), settled.ratios(), "1", "ratio, Dahl, periodic state"),
        lugre=(("k_lugre", "theta"), lugre.ratios(), "1", "ratio, LuGre, periodic state"),
    )
    how = [sweep.command for sweep in (marched, settled, lugre)]
    return Drawn(drawings.over_direction(dataset), dataset, how)
