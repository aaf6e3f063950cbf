"""From the sums over a window to a result in SI, power ledger and history."""

from collections.abc import Mapping

import numpy as np

from asperity.arrays import FloatArray
from asperity.friction.loaded import STIFFNESS
from asperity.friction.springs import stored_in_springs
from asperity.normal import elastic_energy
from asperity.results.ledger import NOTED, PowerLedger, PressedLedger, guard
from asperity.results.settled import Standing, smaller_step
from asperity.slider.history import History, PressedHistory
from asperity.slider.model import Model
from asperity.slider.orders import power_of
from asperity.slider.pressed import friction_limit
from asperity.slider.result import SlideResult
from asperity.slider.scaled import (
    DAHL,
    LUGRE,
    NODE,
    PRESSED_NODE,
    SPRINGS,
    NormalLoading,
    Parameters,
)
from asperity.slider.space import IN_FLIGHT, normal_motion, remarks
from asperity.slider.wear import wear_and_heat

_FLIGHT = 1e-9  # of the energy
_SI = dict.fromkeys(("drive_force", "friction", "deflection", "position", "velocity"), 1.0)


def energies(state: np.void, p: Parameters, *, elastic: bool) -> tuple[float, float]:
    r"""Mechanical and elastic energy over :math:`\mu F_N \ell`, matching the trapezoidal sums.

    Mechanical: kinetic and in the drive spring; elastic: in the asperities. The lateral kinetic
    energy counts with the share of the lateral motion the contact sees: where that is not all of
    it (vibration of the body with eta_y < 1), the rest of the force on the body has no
    counterpart in the contact.
    """
    # All at once: a record of NumPy takes as long for one number as for all.
    stretch, wx, wy, sx, sy, fx, fy, drive_force, _ = state.item()[-9:]
    # A spring that is all but none is stretched beyond what a float squares: inf, not an error.
    total = 0.5 * p.stiffness * (stretch * stretch)
    if p.mobility_x > 0.0:
        mobility = p.mobility_x * 2.0 / (1.0 + p.retained)
        before = wx - mobility * (drive_force - fx)
        total += 0.5 * wx * before / mobility
    if p.mobility_y > 0.0:
        before = wy + p.mobility_y * fy
        total += 0.5 * (p.own_1 + p.own_2) * wy * before / p.mobility_y
    return total, 0.5 * (sx**2 + sy**2) if elastic else 0.0


def pressed_energies(
    state: np.void, springs: FloatArray, p: Parameters, q: NormalLoading, unit: float
) -> tuple[float, float]:
    r"""Mechanical and elastic energy of a body that is pressed, as `energies`.

    Mechanical, beside that in the plane: kinetic, of the dead load, and in the contact; ``unit`` is
    the load over its penetration's length in the unit of `energies`.
    """
    bends = p.model in (DAHL, LUGRE)
    held = q.keeps == STIFFNESS
    mechanical, elastic = energies(state, p, elastic=bends and held)
    if p.model == SPRINGS:
        elastic = float(stored_in_springs(*springs, q.weights))
    elif bends and not held:
        share = np.hypot(state["deflection_x"], state["deflection_y"])
        elastic = 0.5 * float(friction_limit(state["load"], q.load_power) * share**2)
    pressed = float(elastic_energy(q.law, state["penetration"]))
    if q.mobility > 0.0:
        before = state["rise"] - q.mobility * (state["load"] - 1.0)
        pressed += 0.5 * float(state["rise"] * before) / q.mobility + float(state["height"])
    return mechanical + unit * pressed, elastic


def summarise(
    model: Model,
    p: Parameters,
    step: float,
    sums: np.void,
    start: tuple[float, float],
    end: tuple[float, float],
    *,
    standing: Standing,
    residual: float,
    steps: int,
    cycles: int,
    seconds: float,
    breakaway_time: float | None = None,
    history: History | None = None,
    notes: tuple[str, ...] = (),
    substeps: int = 1,
    period: int | None = None,
    multiplier: float | None = None,
    step_error: float | None = None,
) -> SlideResult:
    """Turn the sums over a window, and the energies at its ends, into a result in SI.

    Raises
    ------
    ConvergenceError
        The powers do not balance. The two-phase scheme has no balance to keep.
    """
    count = sums["steps"]
    force = model.full_friction
    ratio = float(sums["drive_force"] / count)
    mechanical = end[0] - start[0]
    if model.normal is not None and not sums["load"] and abs(mechanical) <= _FLIGHT * abs(end[0]):
        mechanical = 0.0  # in free flight, where no power is larger than the energy's rounding
    ledger = _ledger(model, p, step, sums, mechanical, end[1] - start[1])
    normal = None
    if model.normal is not None:
        normal = normal_motion(model, step, sums, ledger.friction, period, multiplier)
    if model.solve.scheme != "two-phase":
        given = model.solve.step is not None
        over = max(ledger.residual / NOTED, 1.0)
        advice = smaller_step(step, over, order=power_of(model), given=given, sure=False)
        notes += guard(ledger, advice, reached={"ratio": ratio})
    wear = None
    if normal is not None:
        notes += remarks(model, step, sums, normal)
        if normal.in_flight:
            standing, step_error = Standing(False, IN_FLIGHT), None
        if model.wear is not None:
            slip = normal.wear_integral / normal.normal_mean if normal.normal_mean else 0.0
            mean = ledger.friction, slip
            wear = wear_and_heat(model.wear, normal.wear_integral, mean, model.frequency)
            notes += wear.notes
    return SlideResult(
        model=model,
        ratio=ratio,
        drive_force=float(sums["drive_force"] / count * force),
        friction_mean=_pair(sums["friction_x"] / count, sums["friction_y"] / count, force),
        friction_max=_pair(sums["friction_x_max"], sums["friction_y_max"], force),
        friction_min=_pair(sums["friction_x_min"], sums["friction_y_min"], force),
        breakaway_time=breakaway_time,
        ledger=ledger,
        normal=normal,
        wear=wear,
        settled=standing.settled,
        settled_by=standing.settled_by,
        step_error=step_error,
        residual=residual,
        steps=steps,
        cycles=cycles,
        seconds=seconds,
        substeps=substeps,
        history=history,
        notes=notes,
    )


def _pair(x: float, y: float, force: float) -> tuple[float, float]:
    return float(x * force), float(y * force)


def _ledger(
    model: Model, p: Parameters, step: float, sums: np.void, mechanical: float, elastic: float
) -> PowerLedger:
    length = model.length(step)
    watts = model.full_friction * length / (float(sums["steps"]) * step)
    vibration = -(p.base_x * sums["unit_work_x"] + p.base_y * sums["unit_work_y"])
    whole = model.amplitude * model.unit_direction[1] / length
    whole = -whole if model.on_body else whole
    untransferred = -watts * (1.0 - model.friction.transfer) * whole * sums["unit_work_y"]
    powers = {
        "drive": float(watts * p.drive * sums["drive_force"]),
        "vibration": float(watts * vibration),
        "friction": float(watts * (sums["slip_work"] - elastic)),
        "damping": float(watts * sums["drag_work"]) if p.damping > 0.0 else 0.0,
        "stored": float(watts * (mechanical + elastic)),
        "untransferred": float(untransferred) + 0.0,  # no -0.0
    }
    if model.normal is None:
        return PowerLedger(**powers)
    watts *= model.normal_unit(step)
    return PressedLedger(
        **powers,
        normal=float(watts * sums["rise_work"]),
        contact_damping=float(watts * sums["contact_damping"]),
    )


def history_of(
    model: Model,
    step: float,
    at: FloatArray,
    span: FloatArray,
    mean: FloatArray,
    least: FloatArray | None = None,
    greatest: FloatArray | None = None,
) -> History:
    """Turn recorded stretches into motion and forces in SI.

    Parameters
    ----------
    model : Model
        The body.
    step : float
        Time step, s.
    at, span, mean, least, greatest
        As `of_stretches` takes them, scaled as in `asperity.slider.scaled`.
    """
    length, force = model.length(step), model.full_friction
    units = dict.fromkeys(("drive_force", "friction"), force)
    units |= {"deflection": length, "position": length, "velocity": length / step}
    if model.normal is not None:
        units |= {"normal_force": model.slider.normal_force}
        units |= dict.fromkeys(("penetration", "height"), model.normal_length)
    begin = model.slider.drive_velocity * at
    return of_stretches(step, at, span, mean, least, greatest, units, begin)


def of_stretches(
    step: float,
    at: FloatArray,
    span: FloatArray,
    mean: FloatArray,
    least: FloatArray | None,
    greatest: FloatArray | None,
    units: Mapping[str, float] = _SI,
    begin: FloatArray | float = 0.0,
) -> History:
    """Return motion and forces, stretch by stretch.

    Parameters
    ----------
    step : float
        Time step, s.
    at, span : ndarray, shape (n,)
        Begin and length of each stretch, s.
    mean, least, greatest : ndarray, shape (n, numbers of a node)
        As `asperity.slider.kernels.condense` leaves them; the latter two only where a stretch is
        more than a step.
    units : mapping of str to float
        What the numbers of a node are given in, SI.
    begin : ndarray, shape (n,), or float
        Where on the way along the drive the positions of a stretch are counted from, m.
    """
    pressed = "normal_force" in units
    kind = PRESSED_NODE if pressed else NODE

    def columns(rows: FloatArray | None, ending: str) -> dict[str, FloatArray]:
        if rows is None:
            return {}
        node = np.ascontiguousarray(rows).view(kind)[:, 0]
        found = {}
        for name, unit in units.items():
            parts = [f"{name}_x", f"{name}_y"]
            vector = parts[0] in (kind.names or ())
            found[name] = unit * (
                np.stack([node[part] for part in parts], axis=1) if vector else node[name]
            )
        found["position"][:, 0] += begin
        return {name + ending: values for name, values in found.items()}

    # The mean over the ends of a stretch's steps belongs to the mean of their times.
    time = at + 0.5 * (span + step)
    of_each = columns(mean, "") | columns(least, "_min") | columns(greatest, "_max")
    return (PressedHistory if pressed else History)(time=time, span=span, **of_each)
