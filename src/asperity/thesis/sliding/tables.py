"""Tables 4.1, 4.3 and 4.4: what the sliding bodies are given, and what comes out."""

import math
from typing import NamedTuple

from asperity.slider import Model
from asperity.thesis.exhibits import Cell, Grid
from asperity.thesis.sliding.bodies import PERIODIC, TWO_PHASE, Body

_BASIC = tuple(f"L{n}" for n in range(1, 7))


def table_4_1() -> Grid:
    """Inputs of six bodies on a rigid drive, and their drive force."""
    bodies = [Body(f"table-4.1-{name}", (PERIODIC,)) for name in _BASIC]
    rows = []
    for name, body in zip(_BASIC, bodies, strict=True):
        result = body.solve()
        model = result.model
        elastic = model.friction.model != "coulomb"
        rows.append(
            (
                f"{name}-Sim",
                "Dahl" if elastic else "Coulomb",
                1e3 * model.slider.drive_velocity,
                model.slider.normal_force,
                model.friction.mu,
                model.frequency,
                1e3 * model.peak_velocity,
                1e6 * _deflection(model) if elastic else "",
                result.drive_force,
                result.ratio,
                result.friction_min[0],
                result.friction_max[0],
            )
        )
    columns = (
        "simulation", "friction", "v_d, mm/s", "F_N, N", "mu", "f, Hz", "v_a, mm/s", "s_max, um",
        "mean F_d, N", "ratio", "least F_x, N", "greatest F_x, N",
    )  # fmt: skip
    return Grid(columns, tuple(rows), tuple(body.command for body in bodies))


class _Printed(NamedTuple):
    """What the thesis prints of the inputs, in the units of `_inputs`."""

    mass: float
    frequency: float
    normal_force: float
    deflection: float
    stiffness: float
    direction: float


def table_4_3() -> Grid:
    """Inputs of the body under longitudinal vibration."""
    return _compared("table-4.3", _Printed(0.5, 4000.0, 55.0, 68.75, 80.0, 0.0))


def table_4_4() -> Grid:
    """Inputs of the body under transverse vibration."""
    return _compared("table-4.4", _Printed(2.0, 3000.0, 50.8, 75.49, 67.29, 270.0))


def _compared(case: str, thesis: _Printed) -> Grid:
    body, printed, settled = Body(case), Body(case, (TWO_PHASE,)), Body(case, (PERIODIC,))
    results = [one.solve() for one in (body, printed, settled)]
    model = results[0].model
    rows: list[tuple[Cell, ...]] = [
        ("v_d", "drive velocity", "mm/s", 0.5, 1e3 * model.slider.drive_velocity),
        ("k_d", "drive stiffness", "N/m", 96068.0, model.slider.drive_stiffness or 0.0),
        ("m", "mass", "kg", thesis.mass, model.slider.mass or 0.0),
        ("t_v", "start of the vibration", "s", 0.14, model.start),
        ("f", "frequency", "Hz", thesis.frequency, model.frequency),
        ("mu", "coefficient of friction", "", 0.1, model.friction.mu),
        ("F_N", "normal force", "N", thesis.normal_force, model.slider.normal_force),
        ("s_max", "greatest deflection", "nm", thesis.deflection, 1e9 * _deflection(model)),
        ("eta_y", "transfer across the drive", "", 0.71, model.friction.transfer),
        ("theta", "direction of vibration", "deg", thesis.direction, math.degrees(model.direction)),
        ("Delta t", "step", "us", 1.0, 1e6 * model.step),
        (
            "k_t",
            "tangential stiffness",
            "N/um",
            thesis.stiffness,
            1e-6 * model.full_friction / _deflection(model),
        ),
    ]
    words = ("marched", "marched, two-phase scheme", "periodic state")
    k = model.peak_velocity / model.slider.drive_velocity
    rows += [
        ("F_d/(mu F_N)", f"ratio at k = {k:g}, {word}", "", "", result.ratio)
        for word, result in zip(words, results, strict=True)
    ]
    how = tuple(one.command for one in (body, printed, settled))
    return Grid(("symbol", "quantity", "unit", "thesis", "here"), tuple(rows), how)


def _deflection(model: Model) -> float:
    return model.friction.max_deflection or 0.0
