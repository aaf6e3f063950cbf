"""Figures of chapters 2 and 4, each a few lines over the slider; drawn by `drawings`."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.slider import Model
from asperity.slider.closed_forms import dahl_from_rest, longitudinal_ratio, transverse_ratio
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.products import labelled
from asperity.thesis.sliding import drawings
from asperity.thesis.sliding.bodies import DIRECTION, PERIODIC, RATIO, TWO_PHASE, Body, Sweep
from asperity.thesis.sliding.claims import ALL_AROUND, LUGRE, MARKED, PLOTTED

if TYPE_CHECKING:
    import xarray as xr

_DENSE = "0.1:20:0.1"
_SCHEMES = ("exponential", "two-phase")
_LINES = (
    "The pre-existing model as the exponential scheme (full line), the coupled one as the "
    "two-phase "
    "scheme (dashed)"
)
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


@figure(
    "2.7", "Dahl's friction force from rest",
    "The exponent sets how the contact yields: 0 is elastic up to the full force, 2 creeps towards "
    "it. Full force and deflection limit of Table 4.3.",
    drawings.force_over_displacement,
)  # fmt: skip
def _dahl_from_rest() -> Computed:
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
    return dataset, [f"{_CLOSED}.dahl_from_rest(x, 5.5, 68.75e-9, exponent)"]


_SLOW = "vibration.velocity_amplitude=0.75 mm/s"
_RIGID = (
    "slider.normal_force=55 N", "friction.max_deflection=68.75 nm", "vibration.frequency=4 kHz",
)  # fmt: skip


@figure(
    "2.14", "Rigid friction in a cycle of longitudinal vibration",
    "While the base outruns the body, friction pushes the body forward. The thesis gives no "
    "numbers; those of simulation L2 are used, with v_a = 2 v_d.",
    drawings.cycle, {"rigid drive": Body("table-4.1-L2", (PERIODIC,))},
)  # fmt: skip
@figure(
    "2.15", "Dahl friction in a cycle of longitudinal vibration",
    "At 4 kHz and v_a = 0.75 mm/s against v_d = 0.5 mm/s the asperities give way before the force "
    "can turn: it falls, but keeps its sign. The thesis gives no other numbers; those of Table 4.3 "
    "are used, with its compliant drive and with a rigid one.",
    drawings.cycle,
    {
        "compliant drive": Body("table-4.3", (_SLOW, PERIODIC)),
        "rigid drive": Body("table-4.1-L4", (*_RIGID, _SLOW, PERIODIC)),
    },
)  # fmt: skip
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


@figure(
    "2.16", "Rigid friction in a cycle of transverse vibration",
    "Right: the slip, drive and vibration together, at even times of half a cycle, and the "
    "friction "
    "against it: it keeps its size and swings, so that what is left along the drive is smaller. "
    "Left: the same over time. The thesis gives no numbers; those of simulation L2 are used, "
    "with the base moving across the drive.",
    drawings.transverse_cycle,
)  # fmt: skip
def _transverse_cycle() -> Computed:
    body = Body("table-4.1-L2", (PERIODIC, f"{DIRECTION}=90 deg"))
    result, model, history = body.result, body.model, body.history
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
    return dataset, [body]


@figure(
    "4.3", "Rigid drive, vibration slower than the drive",
    "Simulations L1 (rigid friction) and L3 (asperities): the drive force stays at mu F_N once the "
    "asperities are stretched.",
    drawings.stacked, "L1", "L3",
)  # fmt: skip
@figure(
    "4.4", "Rigid drive, vibration faster than the drive",
    "Simulations L2 (rigid friction) and L4, L5, L6 with softer and softer asperities, from rest; "
    "L6 has not settled yet at the end.",
    drawings.stacked, "L2", "L4", "L5", "L6",
)  # fmt: skip
def _basic(*names: str) -> Computed:
    bodies = [Body(f"table-4.1-{name}", ("solve.duration=30 ms",)) for name in names]
    return _solved(names, bodies, "drive_force"), bodies


@figure(
    "4.17", "Longitudinal vibration: what is left of the drive force",
    "Table 4.3. Line: periodic states; markers: 1 s marched with either scheme; dashed: rigid "
    "friction and rigid drive.",
    drawings.over_ratio, "table-4.3", "split",
)  # fmt: skip
@figure(
    "4.20", "Transverse vibration: what is left of the drive force",
    "Table 4.4. Lines: periodic states of the three relaxation laws; markers: 1 s marched with law "
    "split and either scheme; dotted: rigid friction and rigid drive with the transferred part of "
    "the vibration, eta_y k.",
    drawings.over_ratio, "table-4.4", "split", "unsplit", "vector",
)  # fmt: skip
def _over_ratio(case: str, *laws: str) -> Computed:
    """Periodic states of some laws and a closed form as lines, both schemes as markers."""
    marched = Sweep(case, ((RATIO, MARKED),))
    two_phase = Sweep(case, ((RATIO, MARKED),), (TWO_PHASE,))
    settled = [Sweep(case, ((RATIO, _DENSE),), (PERIODIC, f"friction.law={law}")) for law in laws]
    dense = settled[0].values()
    closed, name = CLOSED_FORMS[case]
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
    return dataset, [marched, two_phase, *settled, name]


def _schemes(case: str, ratio: str) -> list[Body]:
    settings = (f"{RATIO}={ratio}",)
    return [Body(case, settings), Body(case, (*settings, TWO_PHASE))]


@figure(
    "4.18", "Drive force when longitudinal vibration sets in, k = 6",
    f"Table 4.3. {_LINES}. The last millisecond, enlarged, shows the undulation that the two-phase "
    "scheme puts into the drive force by stretching the drive with the base's motion; it is not "
    "physical.",
    drawings.drive_over_time, "table-4.3", "6",
)  # fmt: skip
@figure(
    "4.21", "Drive force when transverse vibration sets in, k = 20",
    f"Table 4.4. {_LINES}. Enlarged: the last millisecond.",
    drawings.drive_over_time, "table-4.4", "20",
)  # fmt: skip
def _drive_over_time(case: str, ratio: str) -> Computed:
    bodies = _schemes(case, ratio)
    return _solved(_SCHEMES, bodies, "drive_force"), bodies


@figure(
    "4.19", "Friction under longitudinal vibration, k = 6",
    f"Table 4.3, two cycles at the end of the march. {_LINES}.",
    drawings.friction_over_cycles, "table-4.3", "6", ["x"],
)  # fmt: skip
@figure(
    "4.22", "Friction under transverse vibration, k = 20",
    f"Table 4.4, two cycles at the end of the march. {_LINES}. Along the drive the force changes "
    "in size, across it in size and sign.",
    drawings.friction_over_cycles, "table-4.4", "20", ["x", "y"],
)  # fmt: skip
def _friction_over_cycles(case: str, ratio: str, axes: list[str]) -> Computed:
    bodies = _schemes(case, ratio)
    cycles = [two_cycles(body.result.to_dataset()[["friction"]], body.model) for body in bodies]
    full = bodies[0].result.static_drive_force
    return side_by_side(_SCHEMES, cycles, full).sel(axis=axes), bodies


@figure(
    "4.23", "What is left of the drive force in every direction of vibration",
    "Table 4.4. Lines: periodic states; filled markers: 25 directions marched for 1 s; open "
    "diamonds: LuGre friction without damping and Stribeck terms, at k = 2 and 20.",
    drawings.over_direction,
)  # fmt: skip
def _over_direction() -> Computed:
    marched = Sweep("table-4.4", ((RATIO, PLOTTED), (DIRECTION, ALL_AROUND)))
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
    return dataset, [marched, settled, lugre]
