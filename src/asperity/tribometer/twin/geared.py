"""The simulated gear rig: a motor, a worm on its wheel under a brake, and the drive's own model.

How the worm's torque depends on its speed, with vibration and without, is what ``asperity drive``
says of the same case; what a rig adds are motor, brake, sensors and noise. The wheel's inertia is
in the drive's model, which tells means over a cycle, and not in the motion between them.
"""

import dataclasses
import functools
import itertools
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.results.settled import unsettled
from asperity.runs import Run
from asperity.tribometer.geared import GearPair
from asperity.tribometer.options import Plan, Twin
from asperity.tribometer.parameters import Sonotrode
from asperity.tribometer.twin.chain import disc_velocity
from asperity.tribometer.twin.contact import MeanFriction
from asperity.tribometer.twin.plant import Plant, SteadyState
from asperity.tribometer.twin.plant_kernels import ACCELERATION, SPEED_BRONZE, Motor, Sensing

_SPEEDS, _MOST_SPEEDS = 7, 32
_STEEP = 0.04  # of the torque without vibration, between neighbours
_NARROW = 1.03  # of one speed over the next, below which nothing is put between
_SLOWEST = 0.1  # of the fastest that the plan's supplies can give
_STARTS = 1e-3  # of that speed, within which the torque rises from rest
_ACCELERATION_NOISE = 1.0  # m/s2
_INERTIA = 1.0  # kg m2, of what teeth turn and no motor does


@dataclasses.dataclass(frozen=True)
class GearPlant(Plant):
    """A gear rig's motor, gearset, brake and vibration.

    Attributes
    ----------
    case : Case
        The configuration, with the tables of a drive.
    """

    pair: GearPair
    case: Case = dataclasses.field(kw_only=True)

    @classmethod
    def of(cls, case: Case) -> "GearPlant":
        """Gather the tables; raises InputError where one is missing, those of a drive too."""
        return cls(GearPair.of(case), case.require(Twin), case.require(Sonotrode), case=case)

    @functools.cached_property
    def steel(self) -> Motor:
        """What drives the worm."""
        return self._motor(
            self.twin.motor_drag, self.pair.drives.gear_ratio, self.twin.gear_efficiency,
            self.pair.sliding_radius, self.pair.rig.bearing_torque_steel,
        )  # fmt: skip

    @functools.cached_property
    def bronze(self) -> Motor:
        """The wheel under its brake, whose coil takes a current and drives nothing."""
        held = self.pair.rig.bearing_torque_bronze - self.pair.brake_torque
        return Motor(
            0.0, self.twin.brake_resistance, 0.0, _INERTIA, self.pair.drives.bronze_gear_ratio,
            1.0, 0.0, held, self.twin.supply_current, self.pair.tied,
        )  # fmt: skip

    def sensing(self, interval: float) -> Sensing:
        """What the sensors make of it at an interval of samples, s."""
        found = super().sensing(interval)
        found.noise[SPEED_BRONZE] *= self.pair.tied
        found.noise[ACCELERATION] = _ACCELERATION_NOISE
        return found

    @property
    def starting_torque(self) -> float:
        """Largest torque of worm or wheel, N m."""
        return max(self.pair.brake_torque, self._static)

    @functools.cached_property
    def _fastest(self) -> float:
        """Speed of the worm without load at the plan's greatest supply, rad/s."""
        supplies = self.case.get(Plan, Plan()).steel_supplies or (self.pair.drives.steel_supply,)
        fastest = max(supplies) / self.twin.motor_constant / self.pair.drives.gear_ratio
        if fastest <= 0.0:
            raise InputError("drives.steel_supply is 0 V; the simulated motor does not turn")
        return fastest

    @functools.cached_property
    def _static(self) -> float:
        """Torque of the worm without vibration, N m."""
        return float(self.friction().force[-1] * self.pair.sliding_radius)

    @functools.cached_property
    def _speeds(self) -> FloatArray:
        """Speeds of the worm at which a drive is solved, rad/s."""
        return np.asarray(self._fastest * np.geomspace(_SLOWEST, 1.0, _SPEEDS))

    def _solved(
        self, mode: str, waveform: str, frequency: float, speed: float
    ) -> tuple[float, float]:
        """Return the worm's torque without vibration and with it at a speed, N m and rad/s."""
        from asperity.drive.solve import answer, prepare

        shaken = disc_velocity(self.sonotrode, mode, waveform, frequency)
        # Of a triangle the chain passes its first harmonic.
        first = 2.0 * abs(np.fft.rfft(shaken)[1]) / shaken.size
        case = self.case.replace_values(
            {
                "operation.worm_speed": float(speed),
                "operation.output_torque": self.pair.brake_torque,
                "vibration.frequency": float(frequency),
                "vibration.velocity_amplitude": float(first),
            }
        )
        found = answer(prepare(case), Run())
        static, ratio = (getattr(found, name) for name in ("torque_static", "torque_ratio"))
        if ratio is None:
            raise ConvergenceError(
                f"the simulated gearset does not settle under {frequency:g} Hz at "
                f"{30.0 / np.pi * speed:.3g} rpm: {unsettled(found)}"
            )
        return float(static), float(static * ratio)

    def _torques(
        self, mode: str, waveform: str, frequency: float
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return speeds of the worm, rad/s, and its torques without vibration and with it, N m.

        Where the torque with vibration changes by much from one speed to the next, as where the
        flanks begin to part, speeds between are solved as well.
        """
        found = {float(w): self._solved(mode, waveform, frequency, w) for w in self._speeds}
        while len(found) < _MOST_SPEEDS:
            speeds = sorted(found)
            steep = [
                (slow * fast) ** 0.5
                for slow, fast in itertools.pairwise(speeds)
                if abs(found[fast][1] - found[slow][1]) > _STEEP * found[fast][0]
                and fast > _NARROW * slow
            ]
            if not steep:
                break
            found |= {w: self._solved(mode, waveform, frequency, w) for w in steep}
        without, shaken = np.array([found[w] for w in sorted(found)]).T
        return np.array(sorted(found)), without, shaken

    def friction(
        self, waveform: str = "sine", frequency: float = 0.0, *, mode: str = ""
    ) -> MeanFriction:
        """Return the worm's torque over the radius of sliding, over sliding velocity.

        Raises
        ------
        InputError
            How fast the worm is shaken at this frequency is not known, or the case makes no drive.
        """
        key = (mode or self.pair.rig.mode, waveform, frequency)
        if key not in self._tables:
            if not self.sonotrode.frequencies:
                raise InputError(
                    "sonotrode.frequencies is empty; give it with sonotrode.axial_velocity, how "
                    "fast the simulated worm is shaken"
                )
            at = frequency or self.sonotrode.frequencies[0]
            speeds, without, shaken = self._torques(key[0], waveform, at)
            self._tables[key] = self._table(speeds, shaken if frequency else without)
        return self._tables[key]

    def _table(self, speeds: FloatArray, torques: FloatArray) -> MeanFriction:
        radius = self.pair.sliding_radius
        # Down to rest the torque is that of the slowest, and rises to it within a hair.
        velocity = radius * np.array([0.0, _STARTS * speeds[-1], *speeds])
        return MeanFriction(velocity, np.array([0.0, torques[0], *torques]) / radius)

    def loaded(
        self, waveform: str, frequency: float, mode: str, *, powered: bool
    ) -> tuple[Motor, MeanFriction]:
        """Return wheel and worm as they are loaded; without its supply the brake holds nothing."""
        if powered:
            return self.bronze, self.friction(waveform, frequency, mode=mode)
        free = self._table(self._speeds, np.zeros(_SPEEDS))
        return self.bronze._replace(bearing=self.pair.rig.bearing_torque_bronze), free

    def steady(
        self, steel: float, bronze: float, friction: Callable[[float], float]
    ) -> SteadyState:
        """Return where the rig settles at a voltage of its motor, V, and a friction, N.

        Raises
        ------
        InputError
            The motor does not turn.
        """
        least = 2.0 * _STARTS * self._fastest * self.steel.ratio
        torque, speed, sliding = self._balanced(steel, friction, "worm", least=least)
        return SteadyState(torque, speed, self.pair.tied * speed, sliding)
