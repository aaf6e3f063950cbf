"""The instruments of the simulated rig: they know one another through the rig alone."""

import math
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.calibration import Line
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.inputs import volts_a_count
from asperity.tribometer.instruments.protocols import (
    FULL_SCALE,
    Counts,
    Input,
    Instrument,
    InstrumentError,
    Poll,
    Reading,
    Scope,
    Supply,
    Switched,
    VibrationDrive,
    Waveform,
)
from asperity.tribometer.signals import SIMULATED
from asperity.tribometer.twin import plant_kernels as kernels
from asperity.tribometer.twin.chain import POINTS, disc_velocity
from asperity.tribometer.twin.noise import Noise
from asperity.tribometer.twin.plant import STEP, Plant
from asperity.tribometer.twin.wearing import Wearing

_OFF = -1.0


class SimulatedRig:
    """A rig in a time of its own, which passes when somebody waits.

    Parameters
    ----------
    plant : Plant
        What it is made of.
    inputs : tuple of Input
        What the oscilloscope sees.
    lines : tuple of Line
        What the volts of each mean.

    Attributes
    ----------
    now : float
        s.
    volts : dict of str to float
        Of the motors' supplies, as they are set.
    on : set of str
        Which outputs are on: ``steel``, ``bronze``, ``amplifier``, ``vibration``.
    """

    def __init__(self, plant: Plant, inputs: tuple[Input, ...], lines: tuple[Line, ...]) -> None:
        self.plant = plant
        self.inputs = inputs
        self.now = 0.0
        self.volts = {"steel": 0.0, "bronze": 0.0}
        self.on = {"amplifier"}
        self.mode: str = plant.pair.rig.mode
        self.waveform: Waveform = "sine"
        self.frequency = 0.0
        self.wearing = Wearing(plant)
        self._state = np.zeros(1, kernels.STATE)
        self._noise = Noise(plant.twin.seed, kernels.NORMALS)
        angles = np.random.default_rng(plant.twin.seed).uniform(0.0, 2.0 * math.pi, 2)
        self._state["angle_steel"], self._state["angle_bronze"] = angles
        self._interval = 0.0
        self._reached = 0.0
        self._sampled = 0
        self._begun = 0.0
        self._waiting: list[Counts] = []
        self._sensing: dict[float, kernels.Sensing] = {}
        order = list(SIMULATED)
        self._columns = np.array([order.index(given.signal) for given in inputs])
        a_count = [volts_a_count(given) for given in inputs]
        pairs = list(zip(lines, a_count, strict=True))
        self._gains = np.array([1.0 / (line.gain * one) for line, one in pairs])
        self._offsets = np.array([-line.offset / (line.gain * one) for line, one in pairs])

    @property
    def vibrates(self) -> bool:
        """Whether the disc is shaken."""
        return {"vibration", "amplifier"} <= self.on and self.frequency > 0.0

    def change(self) -> None:
        """Bring the rig to the present, before something is changed or read."""
        before, seconds = self.wearing.sliding(self._state[0]), self.now - self._reached
        self._advance()
        self._reached = self.now
        drive = (self.mode, self.waveform, self.frequency) if self.vibrates else None
        self.wearing.slide((before, self.wearing.sliding(self._state[0])), seconds, drive)

    def _advance(self) -> None:
        if self._interval:
            due = round((self.now - self._begun) / self._interval) - self._sampled
            if due > 0:
                self._waiting.append(self._samples(due))
        else:
            steps = round((self.now - self._reached) / STEP)
            if steps > 0:
                kernels.coast(*self._parts(STEP), self._state[0], STEP, steps)

    def _parts(self, interval: float) -> tuple[Any, ...]:
        plant = self.plant
        told = {name: self.volts[name] if name in self.on else _OFF for name in ("steel", "bronze")}
        shaken = self.vibrates
        frequency = self.frequency if shaken else 0.0
        drive = kernels.Drive(
            told["steel"], told["bronze"], frequency, self.waveform == "triangle",
            plant.acceleration(self.waveform, frequency, self.mode),
        )  # fmt: skip
        bronze, table = plant.loaded(
            self.waveform, frequency, self.mode, powered="bronze" in self.on
        )
        if interval not in self._sensing:
            self._sensing[interval] = plant.sensing(interval)
        return plant.steel, bronze, self._sensing[interval], drive, table.velocity, table.force

    def _samples(self, count: int) -> Counts:
        counts = np.empty((count, len(self.inputs)), np.int16)
        normals = self._noise.take(count)
        stride = max(1, round(STEP / self._interval))
        kernels.sample(
            *self._parts(self._interval), self._state[0], stride * self._interval, stride,
            self._interval, self._columns, self._gains, self._offsets, normals, counts,
        )  # fmt: skip
        self._sampled += count
        return counts

    def begin(self, interval: float) -> None:
        """Let the oscilloscope stream."""
        self.change()
        self._interval, self._begun, self._sampled = interval, self.now, 0
        self._waiting = []

    def taken(self) -> Counts:
        """Return the samples up to now."""
        self.change()
        waiting, self._waiting = self._waiting, []
        if len(waiting) == 1:
            return waiting[0]
        return np.concatenate(waiting) if waiting else np.empty((0, len(self.inputs)), np.int16)

    def end(self) -> None:
        """Let the oscilloscope stream no more."""
        self.change()
        self._interval = 0.0

    @property
    def streams(self) -> bool:
        """Whether the oscilloscope streams."""
        return self._interval > 0.0

    def motor(self, name: str) -> tuple[float, float]:
        """Return speed, rad/s, and current, A, of a motor."""
        self.change()
        state = self._state[0]
        return float(state[f"motor_{name}"]), float(state[f"current_{name}"])

    def state(self) -> dict[str, Any]:
        """Return where it stands, for JSON; it must be at rest."""
        self.change()
        held = {name: float(self._state[name][0]) for name in kernels.STATE.names or ()}
        return {
            "now": self.now,
            "mode": self.mode,
            "waveform": self.waveform,
            "frequency": self.frequency,
            "held": held,
            "noise": self._noise.state(),
            **self.wearing.state(),
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Stand where it stood."""
        self.now = self._reached = float(state["now"])
        self.mode, self.waveform = state["mode"], state["waveform"]
        self.frequency = float(state["frequency"])
        for name, value in state["held"].items():
            self._state[name] = value
        self._noise.restore(state["noise"])
        self.wearing.restore(state)


class SimulatedClock:
    """The rig's own time, which passes only in sleep."""

    def __init__(self, rig: SimulatedRig) -> None:
        self._rig = rig

    def now(self) -> float:
        """Return the rig's time, s."""
        return self._rig.now

    def sleep(self, seconds: float) -> None:
        """Let time pass."""
        self._rig.now += max(0.0, seconds)


class _Simulated(Instrument):
    """What the simulated instruments share."""

    def __init__(self, rig: SimulatedRig, name: str) -> None:
        self.name = f"simulated {name}"
        self._rig = rig


class SimulatedScope(_Simulated, Scope):
    """The oscilloscope."""

    def __init__(self, rig: SimulatedRig) -> None:
        super().__init__(rig, "oscilloscope")
        self.inputs = rig.inputs

    def start(self, interval: float) -> float:
        """Begin to stream."""
        self._rig.begin(interval)
        return interval

    def poll(self) -> Poll:
        """Return what has come since the last poll."""
        if not self._rig.streams:
            raise InstrumentError(
                f"{self.name} does not stream; start it first", kind="not started"
            )
        counts = self._rig.taken()
        over = tuple(bool(one) for one in np.any(np.abs(counts) >= FULL_SCALE, axis=0))
        return Poll(tuple(counts.T), self._rig.now, over)

    def stop(self) -> None:
        """End the stream."""
        self._rig.end()


class _SimulatedSwitch(_Simulated, Switched):
    """An output of the rig that is switched."""

    def __init__(self, rig: SimulatedRig, name: str, output: str) -> None:
        super().__init__(rig, name)
        self._output = output

    def on(self) -> None:
        """Switch it on."""
        self._rig.change()
        self._rig.on |= {self._output}

    def off(self) -> None:
        """Switch it off."""
        self._rig.change()
        self._rig.on -= {self._output}

    def _is_on(self) -> bool:
        return self._output in self._rig.on


class SimulatedVibration(_SimulatedSwitch, VibrationDrive):
    """The vibration controller."""

    def __init__(self, rig: SimulatedRig) -> None:
        super().__init__(rig, "vibration controller", "vibration")

    def configure(self, waveform: Waveform, frequency: float) -> None:
        """Set waveform and frequency, Hz."""
        self._rig.change()
        self._rig.waveform, self._rig.frequency = waveform, frequency

    def keep_alive(self) -> None:
        """Nothing watches a simulated line."""

    def vibrates(self) -> bool:
        """Return whether it is on."""
        return self._is_on()


class SimulatedSupply(_SimulatedSwitch, Supply):
    """An output of a supply."""

    def __init__(self, rig: SimulatedRig, output: str) -> None:
        super().__init__(rig, f"supply of {output}", output)

    def set(self, voltage: float) -> None:
        """Set the voltage, V."""
        self._rig.change()
        self._rig.volts[self._output] = voltage

    def reading(self) -> Reading:
        """Return what it gives."""
        if self._output not in self._rig.on or self._output not in self._rig.volts:
            return Reading(0.0, 0.0)
        return Reading(self._rig.volts[self._output], self._rig.motor(self._output)[1])

    def output(self) -> bool:
        """Return whether it is on."""
        return self._is_on()


class SimulatedListener(_Simulated):
    """What hears the drive signal, which is there whether the amplifier has power or not."""

    def __init__(self, rig: SimulatedRig) -> None:
        super().__init__(rig, "ear at the drive signal")

    def moves(self) -> bool:
        """Return whether the drive signal moves."""
        return "vibration" in self._rig.on and self._rig.frequency > 0.0


class SimulatedTachometer(_Simulated):
    """A tachometer."""

    def __init__(self, rig: SimulatedRig) -> None:
        super().__init__(rig, "tachometer")

    def speed(self, motor: str) -> float:
        """Return the speed of a motor, rad/s."""
        return self._rig.motor(motor)[0]


class SimulatedAccelerometer(_Simulated):
    """An accelerometer on the shaken disc."""

    def __init__(self, rig: SimulatedRig) -> None:
        super().__init__(rig, "accelerometer")

    def record(self, duration: float) -> tuple[float, FloatArray]:
        """Return an interval in s and the acceleration in m/s2."""
        rig = self._rig
        rig.now += duration
        rig.change()
        if not rig.vibrates:
            return 1e-4, np.zeros(max(1, round(duration / 1e-4)))
        velocity = disc_velocity(rig.plant.sonotrode, rig.mode, rig.waveform, rig.frequency)
        interval = 1.0 / (rig.frequency * POINTS)
        cycle = (np.roll(velocity, -1) - np.roll(velocity, 1)) / (2.0 * interval)
        return interval, np.tile(cycle, max(1, round(duration * rig.frequency)))


class SimulatedPerson:
    """A person who does at once what is asked, and reads nothing wrong."""

    def __init__(self, rig: SimulatedRig) -> None:
        self._rig = rig

    def do(self, text: str) -> None:
        """Do what is asked."""

    def arrange(self, text: str, mode: str) -> None:
        """Build the rig for a direction of vibration."""
        self._rig.change()
        self._rig.mode = mode

    def read(self, text: str, unit: str) -> float:
        """Weigh discs of steel: nothing else is read at a simulated rig."""
        self._rig.change()
        return self._rig.wearing.weigh("steel" if "steel" in text else "bronze")


def simulated_bench(
    plant: Plant, inputs: tuple[Input, ...], lines: tuple[Line, ...]
) -> tuple[Bench, SimulatedRig]:
    """Return the instruments of a simulated rig, and the rig."""
    rig = SimulatedRig(plant, inputs, lines)
    bench = Bench(
        scope=SimulatedScope(rig),
        vibration=SimulatedVibration(rig),
        motors={name: SimulatedSupply(rig, name) for name in ("steel", "bronze")},
        tachometer=SimulatedTachometer(rig),
        person=SimulatedPerson(rig),
        clock=SimulatedClock(rig),
        amplifier=SimulatedSupply(rig, "amplifier"),
        accelerometer=SimulatedAccelerometer(rig),
        listener=SimulatedListener(rig),
        memory=rig,
        simulated=True,
    )
    return bench, rig
