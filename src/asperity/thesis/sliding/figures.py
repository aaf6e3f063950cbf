"""Figures of chapters 2 and 4, each a few lines over the slider; drawn by `drawings`."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.dataset import described
from asperity.slider import Model
from asperity.slider.closed_forms import dahl_from_rest, longitudinal_ratio, transverse_ratio
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.sliding import drawings
from asperity.thesis.sliding.bodies import DIRECTION, PERIODIC, RATIO, TWO_PHASE, Body, Sweep
from asperity.thesis.sliding.claims import ALL_AROUND, LUGRE, MARKED, PLOTTED

if TYPE_CHECKING:
    import xarray as xr

_DENSE = "0.1:20:0.1"
_SCHEMES = ("exponential", "two-phase")
_CLOSED = "asperity.slider.closed_forms"
CLOSED_FORMS: dict[str, tuple[Callable[[Any], Any], str]] = {
    "table-4.3": (longitudinal_ratio, f"{_CLOSED}.longitudinal_ratio(k)"),
    "table-4.4": (lambda k: transverse_ratio(0.71 * k), f"{_CLOSED}.transverse_ratio(0.71 * k)"),
}
"""The ratio of rigid Coulomb friction and a rigid drive over k, by case."""


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


def beginning(dataset: "xr.Dataset", model: Model) -> "xr.Dataset":
    """Histories with the moment from which the base vibrates."""
    labels = {"units": "s", "long_name": "time from which the base vibrates, t_v"}
    start = model.vibration.start if model.vibration else 0.0
    dataset["vibration_start"] = ((), start, labels)
    return dataset


def _solved(names: Sequence[str], bodies: Sequence[Body], keep: str) -> "xr.Dataset":
    histories = [body.result.to_dataset()[[keep]] for body in bodies]
    return side_by_side(names, histories, bodies[0].result.static_drive_force)


def two_cycles(history: "xr.Dataset", model: Model) -> "xr.Dataset":
    """The last two whole cycles, with the time counted from the start of the first of them."""
    period = 1.0 / model.frequency
    end = float(history["time"][-1])
    whole = np.floor((end - model.start) / period + 1e-6) - 2
    begin = model.start + whole * period
    part = history.sel(time=slice(begin - 1e-9, begin + 2 * period + 1e-9))
    attributes = {"units": "s", "long_name": "time from the start of a vibration cycle"}
    return part.assign_coords(time=("time", part["time"].values - begin, attributes))


@figure("2.7", drawings.force_over_displacement)
def _dahl_from_rest() -> Computed:
    force, s_max = 5.5, 68.75e-9
    exponents = np.array([0.0, 0.5, 1.0, 1.5, 2.0])
    x = np.linspace(0.0, 4.0 * s_max, 401)
    values = dahl_from_rest(x, force, s_max, exponents[:, None])
    dataset = described(
        displacement=(("displacement",), x, "m", "displacement"),
        exponent=(("exponent",), exponents, "1", "Dahl's exponent"),
        force=(("exponent", "displacement"), values, "N", "friction force"),
        full_force=((), force, "N", "full friction force"),
        deflection_limit=((), s_max, "m", "deflection limit"),
    )
    return dataset, [f"{_CLOSED}.dahl_from_rest(x, 5.5, 68.75e-9, exponent)"]


_SLOW = "vibration.velocity_amplitude=0.75 mm/s"
_RIGID = (
    "slider.normal_force=55 N", "friction.max_deflection=68.75 nm", "vibration.frequency=4 kHz",
)  # fmt: skip


@figure("2.14", drawings.cycle, {"rigid drive": Body("table-4.1-L2", (PERIODIC,))})
@figure(
    "2.15",
    drawings.cycle,
    {
        "compliant drive": Body("table-4.3", (_SLOW, PERIODIC)),
        "rigid drive": Body("table-4.1-L4", (*_RIGID, _SLOW, PERIODIC)),
    },
)
def _cycle(bodies: dict[str, Body]) -> Computed:
    """Base velocity and friction over one cycle of periodic states."""
    dataset = _solved([*bodies], [*bodies.values()], "friction")
    first, body = next(iter(bodies.items()))
    model = body.model
    _, time = drawings.own_names("friction", first)
    base = np.cos(2.0 * np.pi * model.frequency * dataset[time].values)
    labels = {"units": "m/s", "long_name": "velocity of the base"}
    dataset["base_velocity"] = (time, model.peak_velocity * base, labels)
    labels = {"units": "m/s", "long_name": "drive velocity"}
    dataset["drive_velocity"] = ((), model.slider.drive_velocity, labels)
    return dataset, [*bodies.values()]


@figure("2.16", drawings.transverse_cycle)
def _transverse_cycle() -> Computed:
    body = Body("table-4.1-L2", (PERIODIC, f"{DIRECTION}=90 deg"))
    result, model, history = body.result, body.model, body.history
    time = history.time
    dataset = described(
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
    return dataset, [body]


@figure("4.3", drawings.stacked, "L1", "L3")
@figure("4.4", drawings.stacked, "L2", "L4", "L5", "L6")
def _basic(*names: str) -> Computed:
    bodies = [Body(f"table-4.1-{name}", ("solve.duration=30 ms",)) for name in names]
    return _solved(names, bodies, "drive_force"), bodies


@figure("4.17", drawings.over_ratio, "table-4.3", "split")
@figure("4.20", drawings.over_ratio, "table-4.4", "split", "unsplit", "vector")
def _over_ratio(case: str, *laws: str) -> Computed:
    """Periodic states of some laws and a closed form as lines, both schemes as markers."""
    marched = Sweep(case, ((RATIO, MARKED),))
    two_phase = Sweep(case, ((RATIO, MARKED),), (TWO_PHASE,))
    settled = [Sweep(case, ((RATIO, _DENSE),), (PERIODIC, f"friction.law={law}")) for law in laws]
    dense = settled[0].values()
    closed, name = CLOSED_FORMS[case]
    dataset = described(
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
    return dataset, [marched, two_phase, *settled, name]


def _schemes(case: str, ratio: str) -> list[Body]:
    settings = (f"{RATIO}={ratio}",)
    return [Body(case, settings), Body(case, (*settings, TWO_PHASE))]


@figure("4.18", drawings.drive_over_time, "table-4.3", "6")
@figure("4.21", drawings.drive_over_time, "table-4.4", "20")
def _drive_over_time(case: str, ratio: str) -> Computed:
    bodies = _schemes(case, ratio)
    return beginning(_solved(_SCHEMES, bodies, "drive_force"), bodies[0].model), bodies


@figure("4.19", drawings.friction_over_cycles, "table-4.3", "6", ["x"])
@figure("4.22", drawings.friction_over_cycles, "table-4.4", "20", ["x", "y"])
def _friction_over_cycles(case: str, ratio: str, axes: list[str]) -> Computed:
    bodies = _schemes(case, ratio)
    cycles = [two_cycles(body.result.to_dataset()[["friction"]], body.model) for body in bodies]
    full = bodies[0].result.static_drive_force
    return side_by_side(_SCHEMES, cycles, full).sel(axis=axes), bodies


@figure("4.23", drawings.over_direction)
def _over_direction() -> Computed:
    marched = Sweep("table-4.4", ((RATIO, PLOTTED), (DIRECTION, ALL_AROUND)))
    settled = Sweep("table-4.4", ((RATIO, PLOTTED), (DIRECTION, "0:360:3")), (PERIODIC,))
    lugre = Sweep("table-4.4", ((RATIO, "2,20"), (DIRECTION, ALL_AROUND)), LUGRE)
    dataset = described(
        k=(("k",), marched.values(), "1", "velocity ratio v_a/v_d"),
        theta=(("theta",), marched.values(1), "deg", "direction of vibration"),
        theta_dense=(("theta_dense",), settled.values(1), "deg", "direction of vibration, line"),
        k_lugre=(("k_lugre",), lugre.values(), "1", "velocity ratio v_a/v_d, LuGre"),
        dahl=(("k", "theta"), marched.ratios(), "1", "ratio, Dahl, marched"),
        periodic=(("k", "theta_dense"), settled.ratios(), "1", "ratio, Dahl, periodic state"),
        lugre=(("k_lugre", "theta"), lugre.ratios(), "1", "ratio, LuGre, periodic state"),
    )
    return dataset, [marched, settled, lugre]
