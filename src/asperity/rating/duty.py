"""What each part of a duty cycle has in the wear and the heat, by ISO/TR 14521."""

import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from asperity.formulas import masking
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import parts_of
from asperity.rating.result import Rating
from asperity.results.quantity import Quantities, quantity
from asperity.results.settled import MARK
from asperity.results.table import Cell, Table, table_of_rows
from asperity.results.words import Number, Sentence

_BACK = (
    f"{MARK} the load drives the worm: the part has its share of wear and losses, and none of the "
    "efficiency over the duty"
)


class DutyPart(Quantities):
    """A part of a duty cycle; None where the standard has no answer."""

    hours: float = quantity("t", "h", "running time")
    torque: float = quantity("T_2", "N m", "torque of the wheel", key="output_torque_Nm")
    speed: float = quantity("n_1", "rpm", "speed of the worm", key="worm_speed_rpm")
    wear: float | None = quantity("delta_Wn", "um", "depth that it wears off the wheel's flanks")
    share: float | None = quantity("", "", "share of all wear", key="wear_share")
    sump: float | None = quantity("theta_S", "degC", "temperature of the oil", key="theta_S_degC")
    loss: float = quantity("P_V", "W", "all losses")
    load_drives: bool | None = quantity(
        "", "", "whether the load drives", default=None, optional=True
    )


class DutyMean(Quantities):
    """What a duty cycle comes to while it runs; None where the worm drives under no load of it."""

    hours: float = quantity("t", "h", "running time")
    output_power: float = quantity("P_2m", "W", "mean power of the wheel")
    loss: float = quantity("P_Vm", "W", "mean loss")
    efficiency: float | None = quantity("eta_m", "", "output over input of what the worm drives")
    energy: float = quantity("W_V", "kWh", "energy lost over its life", key="lost_energy_kWh")

    def sentence(self, torque: float, speed: float, *, occurs: bool, key: str = "") -> Sentence:
        """Return it in words, beside what stands before: at a rated torque, N m, and speed, rpm."""
        rated = f"{torque:.4g} N m, {speed:.4g} rpm"
        point = rated if occurs else f"the rated {rated}, no load of the duty"
        said: list[Any] = [f"this at {point}; over the duty "]
        if self.efficiency is not None:
            said += [Number.of(self.efficiency, ".1f", key and f"{key}.efficiency", 100.0), " %, "]
        return Sentence(
            *said, "mean loss ", Number.of(self.loss, ".4g", key and f"{key}.loss_W"), " W, ",
            Number.of(self.energy, ".4g", key and f"{key}.lost_energy_kWh"),
            " kWh",
        )  # fmt: skip


def duty_mean(inputs: Inputs, parts: Sequence[DutyPart]) -> DutyMean | None:
    """Return what the parts of a duty cycle come to together; None without any."""
    if not parts:
        return None
    hours = math.fsum(part.hours for part in parts)
    turns = math.pi / 30.0 / float(inputs.gear_ratio)
    powers = [part.torque * part.speed * turns for part in parts]
    carried = math.fsum(p.hours * power for p, power in zip(parts, powers, strict=True))
    driven = [
        (part.hours * power, part.hours * part.loss)
        for part, power, load in zip(parts, powers, inputs.duty, strict=True)
        if not load.back
    ]
    out, lost = (math.fsum(each) for each in zip(*driven, strict=True)) if driven else (0.0, 0.0)
    loss = math.fsum(part.hours * part.loss for part in parts) / hours
    return DutyMean(
        hours=hours,
        output_power=carried / hours,
        loss=loss,
        efficiency=out / (out + lost) if driven else None,
        energy=1e-3 * hours * loss,
    )


def duty_parts(inputs: Inputs, iso: Rating) -> tuple[DutyPart, ...]:
    """Return the parts of a duty cycle; none without one."""
    if not inputs.duty or "p_m_star" not in iso or "E_red_MPa" not in iso:
        return ()
    with masking():
        found = parts_of(inputs, {key: iso[key] for key in ("p_m_star", "E_red_MPa")})
    if inputs.together:
        found = _each(found[0], len(inputs.duty))
    depths = [float(own["delta_Wn_mm"]) for own in found]
    whole = math.fsum(depths)
    return tuple(
        DutyPart(
            hours=float(part.hours),
            torque=float(part.torque),
            speed=float(part.speed),
            wear=_known(1e3 * depth),
            share=_known(depth / whole if whole else math.nan),
            sump=_known(float(own["theta_S_degC"])),
            loss=float(own["loss_total_W"]),
            load_drives=part.back or None,
        )
        for part, own, depth in zip(inputs.duty, found, depths, strict=True)
    )


def _each(together: Values, count: int) -> tuple[Values, ...]:
    """Return the parts of arrays one by one, as far as they are shown."""
    keys = "delta_Wn_mm", "theta_S_degC", "loss_total_W"
    columns = (np.broadcast_to(together[key], (count,)).tolist() for key in keys)
    return tuple(dict(zip(keys, row, strict=True)) for row in zip(*columns, strict=True))


def duty_table(parts: tuple[DutyPart, ...]) -> Table:
    """Return a row for each part, marked where the load drives the worm."""
    back = any(part.load_drives for part in parts)
    number = itertools.count(1)
    return table_of_rows(
        parts,
        {
            "": lambda part: f"part {next(number)}{f' {MARK}' if part.load_drives else ''}",
            "h": "hours",
            "T (N m)": "torque",
            "n_1 (rpm)": "speed",
            "wear (um)": Cell("wear", right=True),
            "of all wear": Cell("share", right=True),
            "theta_S (degC)": Cell("sump", right=True),
            "P_V (W)": "loss",
        },
        title="Duty cycle, by ISO/TR 14521",
        remarks=(_BACK,) if back else (),
        within="duty_cycle",
    )


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
