"""The simulated rig made ready from a configuration, and its steady states."""

import dataclasses
import functools
import math
from collections.abc import Callable
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.roots import root_between
from asperity.tribometer.options import Twin
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import LONGITUDINAL, Sonotrode
from asperity.tribometer.twin import plant_kernels as kernels
from asperity.tribometer.twin.chain import disc_velocity
from asperity.tribometer.twin.contact import MeanFriction, Rotor, Surface, mean_friction
from asperity.tribometer.twin.plant_kernels import Motor, Sensing

STEP = 1e-3  #: Of the motion, s.

# Noise of what is no torque and no current: a speed's voltage, a drive signal, a load cell.
_SPEED_NOISE, _DRIVE_NOISE, _LOAD_NOISE = 0.3, 0.02, 2e-4
_BRONZE_GEAR_EFFICIENCY = 0.5  # A self-locking worm; it counts where friction brakes the disc.


@dataclasses.dataclass(frozen=True)
class SteadyState:
    """Where a rig settles.

    Attributes
    ----------
    torque : float
        Of the steel disc, N m.
    steel, bronze : float
        Speeds of the motors, rad/s.
    sliding : float
        v_sl, m/s.
    """

    torque: float
    steel: float
    bronze: float
    sliding: float


@dataclasses.dataclass(frozen=True)
class Plant:
    """A rig's motors, discs, contact and vibration.

    Attributes
    ----------
    pair, twin, sonotrode
        Tables of the configuration.
    """

    pair: Pair
    twin: Twin
    sonotrode: Sonotrode

    @classmethod
    def from_case(cls, case: Case) -> "Plant":
        """Gather the tables of discs; raises InputError where one is missing."""
        return Plant(Pair.from_case(case), case.require(Twin), case.require(Sonotrode))

    @functools.cached_property
    def steel(self) -> Motor:
        """What drives the steel disc."""
        return self._motor(
            self.twin.motor_drag, self.pair.drives.gear_ratio, self.twin.gear_efficiency,
            self.pair.steel.radius, self.pair.rig.bearing_torque_steel,
        )  # fmt: skip

    @functools.cached_property
    def bronze(self) -> Motor:
        """What drives the bronze disc."""
        return self._motor(
            self.twin.bronze_drag, self.pair.drives.bronze_gear_ratio, _BRONZE_GEAR_EFFICIENCY,
            self.pair.bronze.radius, self.pair.rig.bearing_torque_bronze,
        )  # fmt: skip

    def _motor(
        self, drag: float, ratio: float, efficiency: float, radius: float, bearing: float
    ) -> Motor:
        twin = self.twin
        return Motor(
            twin.motor_constant, twin.motor_resistance, drag, twin.motor_inertia, ratio,
            efficiency, radius, bearing, twin.supply_current,
        )  # fmt: skip

    def sensing(self, interval: float) -> Sensing:
        """What the sensors make of it at an interval of samples, s."""
        twin, noise = self.twin, np.zeros(kernels.SIGNALS)
        noise[[kernels.TORQUE_STEEL, kernels.TORQUE_BRONZE]] = twin.torque_noise
        noise[[kernels.SPEED_STEEL, kernels.SPEED_BRONZE]] = _SPEED_NOISE
        noise[[kernels.CURRENT_STEEL, kernels.CURRENT_BRONZE]] = twin.current_noise
        noise[kernels.DRIVE_VOLTAGE], noise[kernels.LOAD_CELL] = _DRIVE_NOISE, _LOAD_NOISE
        low, high = (
            volts / self.sonotrode.amplifier_gain
            for volts in (self.sonotrode.lowest_voltage, self.sonotrode.highest_voltage)
        )
        return Sensing(
            noise, twin.coloured_noise, math.exp(-interval / twin.noise_time), twin.runout_steel,
            twin.runout_bronze, twin.drift / 3600.0, float(self.pair.drives.encoder_pulses),
            twin.encoder_gate, twin.encoder_lag, 0.5 * (low + high), 0.5 * (high - low),
            self.sonotrode.preload_voltage,
        )  # fmt: skip

    @functools.cached_property
    def surface(self) -> Surface:
        """The contact."""
        twin = self.twin
        return Surface(
            twin.mu * self.pair.load, twin.mu_drop, twin.stribeck_velocity, twin.max_deflection
        )

    @property
    def starting_torque(self) -> float:
        """Largest torque of a disc, N m: as it starts, friction is that at rest."""
        discs = self.steel, self.bronze
        return float(max(one.bearing + one.radius * self.surface.full for one in discs))

    @functools.cached_property
    def rotor(self) -> Rotor:
        """The steel disc on its shaft."""
        twin = self.twin
        if twin.rotor_inertia is None or twin.rotor_frequency is None:
            return Rotor()
        mass = twin.rotor_inertia / self.pair.steel.radius**2
        turn = 2.0 * math.pi * twin.rotor_frequency
        return Rotor(mass, mass * turn**2, 2.0 * twin.rotor_damping * mass * turn)

    def friction(
        self, waveform: str = "sine", frequency: float = 0.0, *, mode: str = ""
    ) -> MeanFriction:
        """Return mean friction over sliding velocity; without a frequency that of steady sliding.

        Raises
        ------
        InputError
            How fast the disc is shaken at this frequency is not known.
        """
        found: dict[Any, MeanFriction] = self._tables
        key = (mode or self.pair.rig.mode, waveform, frequency) if frequency else ()
        if key not in found:
            found[key] = self._friction(*key) if key else mean_friction(self.surface)
        return found[key]

    def loaded(
        self, waveform: str, frequency: float, mode: str, *, powered: bool
    ) -> tuple[Motor, MeanFriction]:
        """Return what drives or brakes the bronze side, and the friction, as it is told.

        Parameters
        ----------
        waveform : str
            Of the vibration.
        frequency : float
            Hz; 0: none.
        mode : str
            Its direction.
        powered : bool
            Whether the supply of the bronze side is on.
        """
        return self.bronze, self.friction(waveform, frequency, mode=mode)

    def acceleration(self, waveform: str, frequency: float, mode: str) -> float:
        """Return the amplitude at its frequency of what is shaken, m/s2."""
        if not frequency:
            return 0.0
        shaken = disc_velocity(self.sonotrode, mode, waveform, frequency)
        first = 2.0 * abs(np.fft.rfft(shaken)[1]) / shaken.size
        return float(2.0 * math.pi * frequency * first)

    @functools.cached_property
    def _tables(self) -> dict[Any, MeanFriction]:
        return {}

    def _friction(self, mode: str, waveform: str, frequency: float) -> MeanFriction:
        shaken = disc_velocity(self.sonotrode, mode, waveform, frequency)
        along = mode == LONGITUDINAL
        return mean_friction(
            self.surface, self.rotor, shaken=shaken, along=along, frequency=frequency
        )

    def steady(
        self, steel: float, bronze: float, friction: Callable[[float], float]
    ) -> SteadyState:
        """Return where the rig settles at voltages of its motors, V, and a mean friction, N.

        Raises
        ------
        InputError
            A motor does not turn.
        """
        idle = self._speed(self.bronze, bronze, 0.0)
        if idle <= 0.0:
            raise InputError(
                f"the simulated motor of the bronze disc does not turn at {bronze:g} V"
            )
        rim = self.bronze.radius * idle / self.bronze.ratio
        torque, speed, sliding = self._balanced(steel, friction, "steel disc", rim)
        return SteadyState(torque, speed, idle, sliding)

    def _balanced(
        self, volts: float, friction: Callable[[float], float], driven: str, rim: float = 0.0,
        least: float = 0.0,
    ) -> tuple[float, float, float]:  # fmt: skip
        """Return torque, speed of the motor and sliding velocity at which the driven side runs.

        What it slides on moves with ``rim``; slower than ``least`` the motor does not turn.
        """
        drive = self.steel

        def sliding(speed: float) -> float:
            return drive.radius * speed / drive.ratio - rim

        def torque(speed: float) -> float:
            return drive.bearing + drive.radius * friction(sliding(speed))

        def missing(speed: float) -> float:
            return self._speed(drive, volts, torque(speed)) - speed

        most = volts / drive.constant
        if most <= least or missing(least) <= 0.0:
            raise InputError(f"the simulated motor of the {driven} does not turn at {volts:g} V")
        speed = root_between(missing, least, most * (1.0 + 1e-9) + 1e-9)
        return torque(speed), speed, sliding(speed)

    @staticmethod
    def _speed(motor: Motor, volts: float, torque: float) -> float:
        """Speed of a motor at a voltage, V, and a torque of its disc, N m."""
        load = motor.drag + torque / (motor.ratio * motor.efficiency)
        # The supply takes nothing back: driven on, a motor runs without current.
        current = max(load, 0.0) / motor.constant
        return (volts - motor.resistance * current) / motor.constant
