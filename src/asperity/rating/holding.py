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

from asperity.rating.agma6034 import mesh
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521 import efficiency
from asperity.rating.self_locking import SelfLocking, Verdict, friction_share
from asperity.rating.standing import NAMES
from asperity.results.quantity import Quantities, labelled, quantity
from asperity.results.table import Table, table_of_rows


class Holding(Quantities):
    """How a load is held by the friction of one standard.

    Attributes
    ----------
    at_rest, moving : float
        Torque at the worm that balances the load, N m, as it stands still and as it runs at the
        rated speed; positive is a brake's, negative what drives the load down.
    """

    standard: str = quantity("", "", "whose friction it is, as in the self-locking's verdicts")
    factored: bool = quantity(
        "", "", "whether the factor on the friction acts, as a vibration's would",
        key="friction_factor_applied",
    )  # fmt: skip
    at_rest: float
    moving: float

    @property
    @labelled("T_1", "N m", "torque of a brake that holds the load at rest")
    def brake_at_rest(self) -> float:
        """Torque of a brake at rest, N m."""
        return max(self.at_rest, 0.0)

    @property
    @labelled("T_1", "N m", "torque of a brake that holds the load as it runs")
    def brake_moving(self) -> float:
        """Torque of a brake as the load runs, N m."""
        return max(self.moving, 0.0)

    @property
    @labelled("T_1", "N m", "torque that drives the load down")
    def lowering(self) -> float:
        """Torque that drives the load down, N m."""
        return max(-self.moving, 0.0)

    @property
    @labelled("", "", "what the load does without a brake")
    def state(self) -> str:
        """What the load does without a brake."""
        if self.at_rest > 0.0:
            return "runs back"
        return "held until it is moved" if self.moving > 0.0 else "held"


def held_table(held: Sequence[Holding]) -> Table:
    """Return how the load is held as a table."""
    return table_of_rows(
        held,
        {
            "friction of": lambda one: NAMES.get(one.standard, one.standard),
            "friction factor": lambda one: "with" if one.factored else "without",
            "brake at rest": "brake_at_rest",
            "brake, moving": "brake_moving",
            "to lower it": "lowering",
            "without brake": "state",
        },
        title="Torque at the worm that holds the load when the motor stops, N m",
        remarks=("T_1 = eta_z2_1 T_2/u; bearings, seals and idling, left out, would help a brake",),
        within="holding",
    )


def holding(inputs: Inputs, locking: SelfLocking) -> tuple[Holding, ...]:
    """Return how the load is held by each friction, with the factor on it and without."""
    return tuple(_held(inputs, locking))


def _held(inputs: Inputs, locking: SelfLocking) -> Iterator[Holding]:
    on_worm = float(inputs.output_torque) / float(inputs.gear_ratio)
    factor = locking.friction_factor
    for standard, pair in itertools.groupby(locking, key=lambda verdict: verdict.standard):
        by_state = {verdict.state: verdict for verdict in pair}
        static, dynamic = by_state["static"], by_state["dynamic"]
        for applied in (True, False) if factor not in (0.0, 1.0) else (factor != 1.0,):
            share = 1.0 if applied or factor == 1.0 else 1.0 / factor
            yield Holding(
                standard=standard,
                factored=applied,
                at_rest=on_worm * _efficiency(inputs, static, share),
                moving=on_worm * _efficiency(inputs, dynamic, share),
            )


def _efficiency(inputs: Inputs, verdict: Verdict, share: float) -> float:
    if share == 1.0:
        return verdict.efficiency
    mu = share * verdict.friction
    if verdict.standard == "agma6034":
        return float(mesh.wheel_driving_efficiency(mu, inputs.lead_angle, inputs.pressure_angle))
    own = mu / friction_share(inputs, verdict.standard)
    return float(efficiency.wheel_driving_efficiency(inputs.lead_angle, own))
