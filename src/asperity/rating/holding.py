r"""What holds a load when the motor stops: the torque a brake on the worm must bring.

The wheel is taken to be driven by the output torque :math:`T_2`, as a hoist's load does. What of it
comes to the worm is :math:`T_1 = \eta_{z2-1}\,T_2/u`, with the efficiency of the teeth as the wheel
drives, by ISO/TR 14521 and BS 721 :math:`T_1 = (T_2/u)\tan(\gamma - \rho)/\tan\gamma`; below zero
the worm has to be driven to let the load down. At rest the friction at rest counts, and as the load
runs that at the rated speed, which is less: the brake that stops a running load is the larger one.

The losses of bearings, seals and idling would help the brake and are left out. What stopping takes
beyond holding follows from the inertias, which are no part of a rating.
"""

import itertools
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

from asperity.rating.agma6034 import mesh
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521 import efficiency
from asperity.rating.self_locking import SelfLocking, Verdict, friction_share
from asperity.rating.standing import NAMES
from asperity.results.quantity import text_of
from asperity.results.table import Column, Table


class Holding(NamedTuple):
    """How a load is held by the friction of one standard.

    Attributes
    ----------
    standard : str
        Whose friction it is, as in `asperity.rating.self_locking.Verdict`.
    factored : bool
        Whether the factor on the friction acts, as a vibration's would.
    at_rest, moving : float
        Torque at the worm that balances the load, N m, as it stands still and as it runs at the
        rated speed; positive is a brake's, negative what drives the load down.
    """

    standard: str
    factored: bool
    at_rest: float
    moving: float

    @property
    def state(self) -> str:
        """What the load does without a brake."""
        if self.at_rest > 0.0:
            return "runs back"
        return "held until it is moved" if self.moving > 0.0 else "held"

    def to_json(self) -> dict[str, Any]:
        """Return it by key; the units are part of the keys."""
        return {
            "standard": self.standard,
            "friction_factor_applied": self.factored,
            "brake_at_rest_Nm": max(self.at_rest, 0.0),
            "brake_moving_Nm": max(self.moving, 0.0),
            "lowering_Nm": max(-self.moving, 0.0),
            "state": self.state,
        }


def held_table(held: Sequence[Holding], place: str = "") -> Table:
    """Return how the load is held as a table; ``place`` is where it stands in JSON."""
    rows = []
    for number, one in enumerate(held):
        values = one.to_json()
        torques = (
            text_of(values[key], key=f"{place}.{number}.{key}") if place else f"{values[key]:.4g}"
            for key in ("brake_at_rest_Nm", "brake_moving_Nm", "lowering_Nm")
        )
        factor = "with" if one.factored else "without"
        rows.append((NAMES.get(one.standard, one.standard), factor, *torques, one.state))
    columns = (
        Column("friction of"), Column("friction factor"), Column("brake at rest", right=True),
        Column("brake, moving", right=True), Column("to lower it", right=True),
        Column("without brake"),
    )  # fmt: skip
    remark = "T_1 = eta_z2_1 T_2/u; bearings, seals and idling, left out, would help a brake"
    title = "Torque at the worm that holds the load when the motor stops, N m"
    return Table(columns, tuple(rows), title, (remark,))


def holding(given: Inputs, locking: SelfLocking) -> tuple[Holding, ...]:
    """Return how the load is held by each friction, with the factor on it and without."""
    return tuple(_held(given, locking))


def _held(given: Inputs, locking: SelfLocking) -> Iterator[Holding]:
    on_worm = float(given.output_torque) / float(given.gear_ratio)
    factor = locking.friction_factor
    for standard, pair in itertools.groupby(locking, key=lambda verdict: verdict.standard):
        by_state = {verdict.state: verdict for verdict in pair}
        static, dynamic = by_state["static"], by_state["dynamic"]
        for applied in (True, False) if factor not in (0.0, 1.0) else (factor != 1.0,):
            share = 1.0 if applied or factor == 1.0 else 1.0 / factor
            yield Holding(
                standard,
                applied,
                on_worm * _efficiency(given, static, share),
                on_worm * _efficiency(given, dynamic, share),
            )


def _efficiency(given: Inputs, verdict: Verdict, share: float) -> float:
    if share == 1.0:
        return verdict.efficiency
    mu = share * verdict.friction
    if verdict.standard == "agma6034":
        return float(mesh.wheel_driving_efficiency(mu, given.lead_angle, given.pressure_angle))
    own = mu / friction_share(given, verdict.standard)
    return float(efficiency.wheel_driving_efficiency(given.lead_angle, own))
