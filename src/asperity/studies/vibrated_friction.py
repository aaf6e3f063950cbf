"""What a vibration of the contact does to its friction, by the package's own sliding body.

The tooth contact is a body that slides at the gearset's sliding velocity on a rigid drive, guided,
under a constant normal force, with the vibration imposed in the plane of contact. Teeth, shaft and
mounting are rigid: what they yield, the contact does not get.
"""

import dataclasses
import math
from pathlib import Path

from asperity.errors import ConvergenceError, InputError
from asperity.friction.parameters import Friction
from asperity.results.settled import unsettled
from asperity.slider.closed_forms import directed_ratio, vibration_power
from asperity.vibration import Vibration

# What an ultrasonic transducer with its horn reaches without load.
FREQUENCY, AMPLITUDE = 20e3, 20e-6

_NOTHING = 1e-9

DEFAULT = Vibration.model_validate(
    {"waveform": "sine", "frequency": FREQUENCY, "displacement_amplitude": AMPLITUDE}
)
"""Vibration where none is given, assumed: 20 kHz, 20 um."""


@dataclasses.dataclass(frozen=True)
class Shaken:
    """A contact under vibration.

    Attributes
    ----------
    direction : float
        Angle between vibration and sliding, rad.
    frequency : float
        Hz.
    velocity : float
        Peak velocity of the vibration, m/s.
    amplitude : float
        Of its displacement, m.
    velocity_ratio : float
        Peak velocity over the sliding velocity.
    share : float
        Mean friction along the sliding over that without vibration.
    power : float
        Power that the vibration puts into the contact, over that of the friction without it.
    computed : bool
        Whether the share is computed, or quoted.
    """

    direction: float
    frequency: float
    velocity: float
    amplitude: float
    velocity_ratio: float
    share: float
    power: float
    computed: bool


def shake(
    vibration: Vibration,
    direction: float,
    sliding_velocity: float,
    *,
    friction: Friction | None = None,
    normal_force: float = 1.0,
    folder: Path | None = None,
) -> Shaken:
    """Return what a vibration in some direction does to a sliding contact.

    Parameters
    ----------
    vibration : Vibration
        Waveform, frequency and amplitude; its own direction is not heeded.
    direction : float
        Angle between vibration and sliding, rad.
    sliding_velocity : float
        m/s.
    friction : Friction, optional
        The law of the contact; rigid Coulomb friction if left out.
    normal_force : float
        N; matters where the law has a tangential stiffness, or a damping.
    folder : path, optional
        Where the file of a sampled waveform is looked for.

    Raises
    ------
    ConvergenceError
        The contact has no periodic state.
    InputError
        The vibration drives the contact on, so that there is no friction left to speak of.
    """
    shape = vibration.shape(folder)
    velocity = vibration.velocity(shape, sliding_velocity)
    ratio = velocity / sliding_velocity
    if friction is None and vibration.waveform == "sine":
        share, power = directed_ratio(ratio, direction), vibration_power(ratio, direction)
    else:
        friction = friction or Friction(model="coulomb", mu=0.1)
        share, power = _solved(
            vibration, direction, sliding_velocity, friction, normal_force, folder
        )
    if share < -_NOTHING:
        raise InputError(
            f"vibration.waveform is '{vibration.waveform}' and drives the contact forward: the "
            f"mean friction is {share:.3g} of that without it; give one of equal halves"
        )
    # Adding zero turns a negative zero into a positive one.
    share, power = max(share, 0.0), power + 0.0
    return Shaken(
        direction=direction,
        frequency=shape.frequency,
        velocity=velocity,
        amplitude=vibration.displacement(shape, sliding_velocity),
        velocity_ratio=ratio,
        share=share,
        power=power,
        computed=True,
    )


def _solved(
    vibration: Vibration,
    direction: float,
    sliding_velocity: float,
    friction: Friction,
    normal_force: float,
    folder: Path | None,
) -> tuple[float, float]:
    # The kernels of the sliding body are loaded only where no closed form answers.
    from asperity.slider import Model, Slider, Solve
    from asperity.slider.periodic import solve_periodic

    pulled = {"drive_velocity": sliding_velocity, "normal_force": normal_force}
    body = Slider.model_validate(pulled | {"lateral": "guided"})
    turned = vibration.model_copy(update={"direction": direction}, units="SI")
    how = Solve(method="periodic")
    still = solve_periodic(Model(body, friction, solve=how), history=False)
    model = Model(body, friction, turned, how, turned.shape(folder))
    shaken = solve_periodic(model, history=False)
    for state in (still, shaken):
        if missing := unsettled(state):
            raise ConvergenceError(f"the sliding under vibration has not settled: {missing}")
    if shaken.ledger is None:
        raise ConvergenceError("a periodic state came without its ledger")
    without = still.drive_force * sliding_velocity
    return shaken.drive_force / still.drive_force, shaken.ledger.vibration / without


def quoted(
    velocity_ratio: float, direction: float, sliding_velocity: float, frequency: float, share: float
) -> Shaken:
    """Return a vibration with a reported share of friction, and what it takes with rigid friction.

    Parameters
    ----------
    velocity_ratio, direction, share : float
        As reported; rad.
    sliding_velocity : float
        m/s.
    frequency : float
        At which it would be imposed as a sine, Hz.
    """
    velocity = velocity_ratio * sliding_velocity
    return Shaken(
        direction=direction,
        frequency=frequency,
        velocity=velocity,
        amplitude=velocity / (2.0 * math.pi * frequency),
        velocity_ratio=velocity_ratio,
        share=share,
        power=vibration_power(velocity_ratio, direction),
        computed=False,
    )
