r"""What a gearset takes to start: its efficiency from rest and the torque of the motor.

At rest the friction at rest counts, and the teeth take
:math:`\eta = \tan\gamma/\tan(\gamma + \arctan(\mu/\cos\alpha_n))` of the torque: the friction acts
on the force across the flank, so that it stands over the cosine of the pressure angle whosever it
is. Bearings, seals and idling take their torque at the rated speed, as none of them is known at
rest.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, not_negative
from asperity.rating.holding import Holding
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521.symbols import alpha_n, gamma_m1
from asperity.rating.result import Rating
from asperity.rating.self_locking import SelfLocking
from asperity.rating.standing import NAMES
from asperity.results.quantity import Quantities, quantity
from asperity.results.table import Table, table_of_rows
from asperity.results.words import Number, Sentence
from asperity.sources import Source

mu_0 = Annotated[Real, Symbol("mu_0", "", not_negative)]


@formula(
    symbol="eta_0",
    equation="tan(gamma_m1)/tan(gamma_m1 + atan(mu_0/cos(alpha_n)))",
    source=Source("definition", "verified", "statics of the thread"),
    because="lead angle and friction angle reach 90 deg, so the worm cannot drive",
)
def starting_efficiency(lead_angle: gamma_m1, friction: mu_0, pressure_angle: alpha_n) -> Real:
    """Efficiency of the teeth from rest, the worm driving.

    Examples
    --------
    >>> import math
    >>> angle = math.atan(1.0 / 12.5)
    >>> round(starting_efficiency(angle, 0.15, math.radians(20.0)), 4)
    0.3296
    """
    angle = lead_angle + np.arctan(friction / np.cos(pressure_angle))
    return np.where(angle < 0.5 * np.pi, np.tan(lead_angle) / np.tan(angle), np.nan)


class Starting(Quantities):
    """What starting takes by the friction of one standard.

    The standards are those of `asperity.rating.self_locking.Verdict`.
    """

    standard: str = quantity("", "", "whose friction at rest it is")
    friction: float = quantity(
        "mu_0", "", "coefficient of friction at rest", key="friction_at_rest"
    )
    efficiency: float = quantity(
        "eta_0", "", "efficiency of the teeth with it", key="starting_efficiency"
    )
    motor: float = quantity(
        "T_1", "N m", "torque of the motor that starts the rated torque", key="motor_torque_Nm"
    )
    brake: float = quantity(
        "T_1", "N m", "torque of a brake that holds it at rest", key="brake_at_rest_Nm"
    )


def has_starts(inputs: Inputs) -> bool:
    """Whether the loads of a gearset tell of starts."""
    if inputs.operation.steps is None:
        return False
    return inputs.operation.most_starts > 0.0 or inputs.how.kind != "S1"


def starting(
    inputs: Inputs, iso: Rating | None, locking: SelfLocking, held: Sequence[Holding]
) -> tuple[Starting, ...]:
    """Return what starting takes by each friction, where the spectrum has starts."""
    if iso is None or not has_starts(inputs):
        return ()
    return tuple(_found(inputs, iso, locking, held))


def _found(
    inputs: Inputs, iso: Rating, locking: SelfLocking, held: Sequence[Holding]
) -> Iterator[Starting]:
    speed = math.pi / 30.0 * float(inputs.worm_speed)
    lost = float(iso["loss_idle_W"]) + float(iso["loss_seal_W"]) + float(iso["loss_bearing_W"])
    on_worm = float(inputs.output_torque) / float(inputs.gear_ratio)
    # With a factor on the friction each stands twice, first as it acts.
    brakes: dict[str, float] = {}
    for hold in held:
        brakes.setdefault(hold.standard, max(hold.at_rest, 0.0))
    for one in locking:
        if one.state != "static":
            continue
        efficiency = float(
            starting_efficiency(inputs.lead_angle, one.friction, inputs.pressure_angle)
        )
        brake = brakes.get(one.standard, 0.0)
        motor = on_worm / efficiency + lost / speed
        yield Starting(
            standard=one.standard, friction=one.friction, efficiency=efficiency, motor=motor,
            brake=brake,
        )  # fmt: skip


def starting_line(starting: Sequence[Starting]) -> Sentence:
    """Return what starting takes by the standard that asks for most."""
    place, worst = min(enumerate(starting), key=lambda pair: pair[1].efficiency)
    key = f"starting.{place}"
    name = NAMES.get(worst.standard, "the given friction")
    return Sentence(
        "starts at ", Number.of(worst.efficiency, ".0f", f"{key}.starting_efficiency", 100.0),
        " % of the teeth, motor ", Number.of(worst.motor, ".3g", f"{key}.motor_torque_Nm"),
        f" N m (friction at rest of {name})",
    )  # fmt: skip


def starting_table(starting: Sequence[Starting]) -> Table:
    """Return what starting takes as a table."""
    return table_of_rows(
        starting,
        {
            "friction of": lambda one: NAMES.get(one.standard, one.standard),
            "friction at rest": "friction",
            "efficiency": "efficiency",
            "motor (N m)": "motor",
            "brake at rest (N m)": "brake",
        },
        title="Starting",
        remarks=("the rated torque from rest; bearings, seals and idling as at the rated speed",),
        within="starting",
    )
