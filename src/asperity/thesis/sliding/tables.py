"""Tables 4.1 to 4.4: what the sliding bodies are given, and what comes out."""

import math

from asperity.slider import Model
from asperity.thesis.exhibits import table
from asperity.thesis.products import Cell, Grid
from asperity.thesis.sliding.bodies import PERIODIC, TWO_PHASE, Body


@table("4.1")
def _basic() -> Grid:
    bodies = {f"L{n}-Sim": Body(f"table-4.1-L{n}", (PERIODIC,)) for n in range(1, 7)}
    found = {name: body.result for name, body in bodies.items()}
    model = {name: body.model for name, body in bodies.items()}
    return Grid.of(
        bodies,
        {
            "simulation": str,
            "friction": lambda name: "Dahl" if _deflection(model[name]) else "Coulomb",
            "v_d, mm/s": lambda name: 1e3 * model[name].slider.drive_velocity,
            "F_N, N": lambda name: model[name].slider.normal_force,
            "mu": lambda name: model[name].friction.mu,
            "f, Hz": lambda name: model[name].frequency,
            "v_a, mm/s": lambda name: 1e3 * model[name].peak_velocity,
            "s_max, um": lambda name: 1e6 * _deflection(model[name]) or None,
            "mean F_d, N": lambda name: found[name].drive_force,
            "ratio": lambda name: found[name].ratio,
            "least F_x, N": lambda name: found[name].friction_min[0],
            "greatest F_x, N": lambda name: found[name].friction_max[0],
        },
        *bodies.values(),
    )


@table("4.2")
def _carried() -> Grid:
    return Grid.listed("4.2", "asperity.friction.two_phase")


@table("4.3", "table-4.3", (0.5, 4000.0, 55.0, 68.75, 80.0, 0.0))
@table("4.4", "table-4.4", (2.0, 3000.0, 50.8, 75.49, 67.29, 270.0))
def _compared(case: str, thesis: tuple[float, ...]) -> Grid:
    """What the thesis prints: mass, frequency, normal force, deflection, stiffness, direction."""
    mass, frequency, force, deflection, stiffness, direction = thesis
    bodies = [Body(case), Body(case, (TWO_PHASE,)), Body(case, (PERIODIC,))]
    model = bodies[0].model
    tangential = 1e-6 * model.full_friction / _deflection(model)
    rows: list[tuple[Cell, ...]] = [
        ("v_d", "drive velocity", "mm/s", 0.5, 1e3 * model.slider.drive_velocity),
        ("k_d", "drive stiffness", "N/m", 96068.0, model.slider.drive_stiffness or 0.0),
        ("m", "mass", "kg", mass, model.slider.mass or 0.0),
        ("t_v", "start of the vibration", "s", 0.14, model.start),
        ("f", "frequency", "Hz", frequency, model.frequency),
        ("mu", "coefficient of friction", "", 0.1, model.friction.mu),
        ("F_N", "normal force", "N", force, model.slider.normal_force),
        ("s_max", "greatest deflection", "nm", deflection, 1e9 * _deflection(model)),
        ("eta_y", "transfer across the drive", "", 0.71, model.friction.transfer),
        ("theta", "direction of vibration", "deg", direction, math.degrees(model.direction)),
        ("Delta t", "step", "us", 1.0, 1e6 * model.step),
        ("k_t", "tangential stiffness", "N/um", stiffness, tangential),
    ]
    words = ("marched", "marched, two-phase scheme", "periodic state")
    k = model.peak_velocity / model.slider.drive_velocity
    rows += [
        ("F_d/(mu F_N)", f"ratio at k = {k:g}, {word}", "", "", body.result.ratio)
        for word, body in zip(words, bodies, strict=True)
    ]
    how = tuple(body.command() for body in bodies)
    return Grid(("symbol", "quantity", "unit", "thesis", "here"), tuple(rows), how)


def _deflection(model: Model) -> float:
    return model.friction.max_deflection or 0.0
