"""What each part of a duty cycle has in the wear and the heat, by ISO/TR 14521."""

import math
from typing import Any, NamedTuple

import numpy as np

from asperity.formulas import masking
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import parts_of
from asperity.rating.result import Rating
from asperity.results.quantity import text_of
from asperity.results.table import Column, Table


class DutyPart(NamedTuple):
    """A part of a duty cycle.

    Attributes
    ----------
    hours, torque, speed : float
        Its running time, h, torque of the wheel, N m, and speed of the worm, rpm.
    wear : float or None
        Depth that it wears off the wheel's flanks, um; None where the standard has no answer.
    share : float or None
        Of all wear.
    sump : float or None
        Temperature of the oil, degC.
    loss : float
        All losses, W.
    """

    hours: float
    torque: float
    speed: float
    wear: float | None
    share: float | None
    sump: float | None
    loss: float

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        return {
            "hours_h": self.hours,
            "output_torque_Nm": self.torque,
            "worm_speed_rpm": self.speed,
            "wear_um": self.wear,
            "wear_share": self.share,
            "theta_S_degC": self.sump,
            "loss_W": self.loss,
        }


def duty_parts(given: Inputs, iso: Rating) -> tuple[DutyPart, ...]:
    """Return the parts of a duty cycle; none without one."""
    if not given.duty or "p_m_star" not in iso or "E_red_MPa" not in iso:
        return ()
    with masking():
        found = parts_of(given, {key: iso[key] for key in ("p_m_star", "E_red_MPa")})
    if given.together:
        found = _each(found[0], len(given.duty))
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
        )
        for part, own, depth in zip(given.duty, found, depths, strict=True)
    )


def _each(together: Values, count: int) -> tuple[Values, ...]:
    """Return the parts of arrays one by one, as far as they are shown."""
    keys = "delta_Wn_mm", "theta_S_degC", "loss_total_W"
    columns = (np.broadcast_to(together[key], (count,)).tolist() for key in keys)
    return tuple(dict(zip(keys, row, strict=True)) for row in zip(*columns, strict=True))


def duty_table(parts: tuple[DutyPart, ...]) -> Table:
    """Return a row for each part."""
    heads = "", "h", "T (N m)", "n_1 (rpm)", "wear (um)", "of all wear", "theta_S (degC)", "P_V (W)"
    rows = [
        (
            f"part {place}",
            *(
                "-" if value is None else text_of(value, key=f"duty_cycle.{place - 1}.{key}")
                for key, value in part.to_json().items()
            ),
        )
        for place, part in enumerate(parts, 1)
    ]
    columns = tuple(Column(head, right=bool(head)) for head in heads)
    return Table(columns, tuple(rows), "Duty cycle, by ISO/TR 14521")


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None
