r"""From a torque to a motor: which one does, what it weighs, and what the actuator beside it does.

A motor does where it carries the root mean square of the torque over a cycle of duty continuously
(its current, and so its heat, goes with the torque) and the greatest torque without stalling. That
it may not stall at the lowest voltage of the supply lowers its breakdown torque by the voltage
squared. Induction motors and duties long against their thermal time constant (some 10 to 60 min)
are not told apart from short ones: the mean is over the whole cycle.
"""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from typing import Annotated, ClassVar

from asperity.errors import InputError
from asperity.gearset.library import Sourced, every
from asperity.sources import Source
from asperity.units import Quantity

PRICE_PER_MASS = 23.0 / 6.0
"""GBP/kg of a motor without a price: what the thesis saves by what it weighs less: GBP 23 for 6 kg
(7.5), a maker's cost and not a price."""

LOWEST_VOLTAGE = 0.9
"""Of the supply over its rated one; IEC 60038: 230/400 V within 10 %."""

SUPPLY = Source("IEC 60038", "verified", "230/400 V within 10 %")

# Of the speed, by which motors at the same mains differ by their slip.
_SPEEDS = 0.1

TRANSDUCER_MASS, GENERATOR_MASS = 1e-3, 3e-3
"""kg/W of a bolted ultrasonic transducer with its horn; kg/VA of its generator, those of
welding equipment of 1 to 3 kW, from memory, to a factor of 2."""

ULTRASOUND = Source("welding equipment of 1 to 3 kW", "from memory", "to a factor of 2")


class Motor(Sourced):
    """A motor, by name as in ``gearset/data/motors.toml`` or in a file of your own.

    Parameters
    ----------
    name : str
        As a data file has it.
    power : float or str
        Rated power, W, continuous.
    speed : float or str
        Rated speed, rad/s.
    breakdown : float
        Greatest torque over the rated one.
    mass : float or str
        kg.
    diameter, length : float or str
        Of the body, m.
    price : float, optional
        GBP. Left out: by its mass, `PRICE_PER_MASS`.
    """

    table: ClassVar[str] = "motor"
    section: ClassVar[str] = "motor"

    power: Annotated[float, Quantity("W", what="a power", example="0.75 kW", gt=0)]
    speed: Annotated[float, Quantity("rad/s", what="a speed", example="1395 rpm", gt=0)]
    breakdown: Annotated[float, Quantity("", what="a factor", example="2.2", ge=1)]
    mass: Annotated[float, Quantity("kg", what="a mass", example="9.5 kg", gt=0)]
    diameter: Annotated[float, Quantity("m", what="a length", example="157 mm", gt=0)]
    length: Annotated[float, Quantity("m", what="a length", example="273 mm", gt=0)]
    price: Annotated[float, Quantity("", what="a price", example="120", gt=0)] | None = None

    @property
    def torque(self) -> float:
        """Rated torque, N m."""
        return self.power / self.speed

    @property
    def cost(self) -> float:
        """Its price, or one by its mass, GBP."""
        return PRICE_PER_MASS * self.mass if self.price is None else self.price

    def greatest_torque(self, voltage: float = LOWEST_VOLTAGE) -> float:
        """Return the torque beyond which it stalls at a voltage over the rated one, N m.

        Parameters
        ----------
        voltage : float
            Over the rated one; the torque goes by its square.

        Returns
        -------
        float
            N m.
        """
        return self.breakdown * self.torque * voltage**2


@dataclasses.dataclass(frozen=True)
class Service:
    """What is asked of a motor, again and again.

    Attributes
    ----------
    parts : tuple of (float, float)
        Torque of the motor, N m, and the time for which it lasts, s; 0 N m for a rest.
    """

    parts: tuple[tuple[float, float], ...]

    def __post_init__(self) -> None:
        if not self.parts or not all(time > 0.0 and torque >= 0.0 for torque, time in self.parts):
            raise InputError(
                "a service needs parts, each of a torque of 0 or more and a time above 0"
            )

    @property
    def time(self) -> float:
        """Of a cycle, s."""
        return sum(time for _, time in self.parts)

    @property
    def effective_torque(self) -> float:
        """Root mean square of the torque over a cycle, N m."""
        return math.sqrt(sum(torque**2 * time for torque, time in self.parts) / self.time)

    @property
    def greatest_torque(self) -> float:
        """In a cycle, N m."""
        return max(torque for torque, _ in self.parts)


def all_motors() -> tuple[Motor, ...]:
    """Return every motor that is known, the lightest first."""
    return tuple(sorted(every(Motor), key=lambda motor: motor.mass))


def does(motor: Motor, service: Service, voltage: float = LOWEST_VOLTAGE) -> bool:
    """Whether a motor neither overheats nor stalls in a service."""
    return (
        motor.torque >= service.effective_torque
        and motor.greatest_torque(voltage) >= service.greatest_torque
    )


def lightest(
    service: Service, motors: Iterable[Motor] | None = None, voltage: float = LOWEST_VOLTAGE
) -> Motor:
    """Return the lightest motor that does.

    Parameters
    ----------
    service : Service
        What is asked of it.
    motors : iterable of Motor, optional
        To choose from; all that are known if left out.
    voltage : float
        The lowest of the supply over the rated one.

    Returns
    -------
    Motor
        Of those that do.

    Raises
    ------
    InputError
        None does.
    """
    known: Sequence[Motor] = all_motors() if motors is None else tuple(motors)
    doing = [motor for motor in known if does(motor, service, voltage)]
    if not doing:
        raise InputError(
            f"no motor known does {service.effective_torque:.4g} N m all the time and "
            f"{service.greatest_torque:.4g} N m at most; add a larger one in a file named in "
            "ASPERITY_MATERIALS"
        )
    return min(doing, key=lambda motor: motor.mass)


def of_another_speed(motors: Iterable[Motor], speed: float) -> tuple[str, ...]:
    """Return the line that says where motors do not turn at a speed, rad/s; none where all do."""
    speeds = [motor.speed for motor in motors]
    if all(abs(speed / own - 1.0) <= _SPEEDS for own in speeds):
        return ()
    to_rpm = 30.0 / math.pi
    low, high = (f"{to_rpm * own:.4g}" for own in (min(speeds), max(speeds)))
    told = low if low == high else f"{low} to {high}"
    return (
        f"the worm turns at {to_rpm * speed:.4g} rpm and the motors at {told}: one of that speed "
        "with the same torque has about the same mass, but other poles, name and power, or it "
        "needs a gear between",
    )


@dataclasses.dataclass(frozen=True)
class Scaled:
    """A motor of the same make for another torque: what it weighs and measures less."""

    mass: float
    diameter: float
    length: float


def scaled(motor: Motor, ratio: float) -> Scaled:
    """Return how much smaller a motor of the same shape is at a share of the torque.

    Torque goes as the rotor's diameter squared times its length, with the shear stress that air gap
    and cooling allow (the output coefficient of machine design); so does the mass. Of the same
    shape both shrink by the cube root.
    """
    if not 0.0 < ratio <= 1.0:
        raise InputError(f"the share of the torque is {ratio:g}; it must be above 0 and at most 1")
    shrunk = 1.0 - ratio ** (1.0 / 3.0)
    return Scaled((1.0 - ratio) * motor.mass, shrunk * motor.diameter, shrunk * motor.length)


@dataclasses.dataclass(frozen=True)
class Exchange:
    """A motor without vibration and the one with it, and what the actuator weighs.

    Attributes
    ----------
    before, after : Motor
        Without and with vibration.
    actuator_mass : float
        Of transducer and generator, kg.
    """

    before: Motor
    after: Motor
    actuator_mass: float

    @property
    def saved_mass(self) -> float:
        """Of motor less what is added by the actuator, kg; negative where it costs."""
        return self.before.mass - self.after.mass - self.actuator_mass

    @property
    def saved_cost(self) -> float:
        """Of the motors alone, GBP."""
        return self.before.cost - self.after.cost


def exchange(
    before: Service,
    after: Service,
    actuator_power: float,
    actuator_apparent_power: float,
) -> Exchange:
    """Return which motor does without and which with vibration, and what the actuator weighs.

    Parameters
    ----------
    before, after : Service
        Asked of the motor without and with vibration.
    actuator_power, actuator_apparent_power : float
        Electrical, while it shakes, W and VA.
    """
    return Exchange(
        lightest(before),
        lightest(after),
        TRANSDUCER_MASS * actuator_power + GENERATOR_MASS * actuator_apparent_power,
    )
