"""Drive, sensor, controller and failure as one machine that goes on tick by tick.

The amplitude changes where the waveform passes zero, from cycle to cycle, so that no displacement
jumps; what is imposed then has another speed, as where a vibration begins.
"""

import math
from collections import deque
from typing import Any

import numpy as np

from asperity.drive.control.parameters import Control
from asperity.drive.control.sensor import Filter
from asperity.drive.control.switching import Switch
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import SHAKES, begin, switched_off, system
from asperity.drive.protocols.march import March, Records, refined
from asperity.drive.reduced.mesh_model import MeshModel
from asperity.runs import Run

_ROWS_A_CYCLE = 16
_TICK = 1e-4  # s, at most: of what controller and load know
_GONE = 1e-4  # of an amplitude that is taken for none, or for whole


def load_at(problem: DriveProblem, control: Control, turn: float) -> float:
    """Return the load of the wheel at its turn in a stroke, N m: two seats and what is between."""
    drive = problem.drive
    seat, between = seat_and_between(problem)
    edge = min(turn, drive.stroke - turn) - drive.stroke_seat
    if edge <= 0.0:
        return seat
    if edge >= control.seat_edge:
        return between
    return seat + (between - seat) * edge / control.seat_edge


def seat_and_between(problem: DriveProblem) -> tuple[float, float]:
    """Return the load at the seats and between them, N m."""
    operation = problem.operation
    between = operation.through_travel_torque
    if between is None:
        between = operation.travel_share * operation.output_torque
    return operation.output_torque, between


def rise_of(problem: DriveProblem, control: Control, frequency: float) -> float:
    """Return the time constant of the amplitude, s."""
    if control.rise is not None:
        return control.rise
    if control.kind == "clutch" or problem.actuator is None:
        return 0.0
    return problem.actuator.quality_factor / (math.pi * frequency)


class Machine:
    """A stroke on its way."""

    def __init__(
        self, problem: DriveProblem, model: MeshModel, control: Control, failure: str, run: Run,
        coarser: float,
    ) -> None:  # fmt: skip
        self.problem, self.model, self.control, self.failure = problem, model, control, failure
        self.run, self.coarser, self.clutch = run, coarser, control.kind == "clutch"
        self.full = refined(system(problem, model), coarser)
        self.march = March(model, self.full, *begin(problem, model, self.full), Run())
        self.cycle = 1.0 / self.full.frequency
        rate = 0.0 if self.clutch else control.sample_rate
        self.parts = max(1, math.ceil(self.cycle / _TICK), math.ceil(self.cycle * rate))
        self.count = max(1, math.ceil(_ROWS_A_CYCLE / self.parts))
        self.tick = self.cycle / self.parts
        self.interval = self.tick / self.count
        self.seat, _ = seat_and_between(problem)
        still = self.seat if control.sensor == "thrust" or self.clutch else model.worm_torque
        self.still = still
        self.full_scale = control.full_scale or 2.0 * still
        self.filter = Filter(control, self.interval, self.cycle, still)
        self.noise = np.random.default_rng(control.seed)
        # Nobody watches a clutch.
        unwatched = {"frozen_after": None, "longest_on": None}
        asked = control.model_copy(update=unwatched) if self.clutch else control
        self.switch = Switch(asked, latched=failure == "latched")
        self.rise = rise_of(problem, control, self.full.frequency)
        self.amplitude = self.target = 0.0
        self.waiting: deque[tuple[float, bool]] = deque()
        self.ticks, self.now, self.sampled = 0, 0.0, 0.0
        self.reading, self.cut = still, False
        self.frozen: float | None = None
        self.per_turn = problem.vibrated[0].per_turn or 1.0
        self.off = self.full

    def advance(
        self, load: float, *, motor: bool, turn: float = 0.0
    ) -> tuple[Records, list[float]]:
        """March a tick under a load; return its stretches and what is behind the filter."""
        if self.ticks % self.parts == 0:
            self._swing()
        base = self.full if motor else self.off
        shaken: dict[str, Any] = {name: self.amplitude * getattr(base, name) for name in SHAKES}
        self.march.system = base._replace(load=load, **shaken)
        rows = self.march.stretches(self.count, self.interval)
        self.ticks += 1
        began, self.now = self.now, self.now + self.tick
        name = "wheel_torque" if self.clutch or self.control.sensor == "thrust" else "torque"
        behind = self.filter.feed(rows[name] / rows["time"])
        self._read(began, behind, turn)
        return rows, behind

    def stop_motor(self) -> None:
        """Let the worm go; a vibration goes on until it is cut."""
        states = self.march.states
        none: dict[str, Any] = dict.fromkeys(SHAKES, 0.0)
        plain = self.full._replace(**none)
        still, left = switched_off(self.problem, self.model, plain, states)
        left[0]["wave_rate"] = states[0]["wave_rate"]
        left[0]["corner"] = states[0]["corner"]
        self.off = refined(still, self.coarser)._replace(
            wave=self.full.wave, corners=self.full.corners,
            **{name: getattr(self.full, name) for name in SHAKES},
        )  # fmt: skip
        self.march.states = left
        if self.clutch:
            self.amplitude = 0.0  # a cam stands with the worm, and stood at its middle
        if self.clutch or self.control.interlock:
            self.cut_off()

    def cut_off(self) -> None:
        """Cut the vibration, whatever the controller says; what swings dies away."""
        self.cut, self.target = True, 0.0

    def _swing(self) -> None:
        """Let the amplitude follow for a cycle, where the waveform passes zero."""
        while self.waiting and self.waiting[0][0] <= self.now + 1e-12:
            wanted = self.waiting[0][1]
            if self.clutch and not self._at_a_dog():
                break
            self.waiting.popleft()
            if not self.cut:
                self.target = float(wanted and self.failure != "dead")
        share = 1.0 if self.rise <= 0.0 else -math.expm1(-self.cycle / self.rise)
        self.amplitude += share * (self.target - self.amplitude)
        if abs(self.target - self.amplitude) < _GONE:
            self.amplitude = self.target

    def _at_a_dog(self) -> bool:
        cycles = self.ticks // self.parts
        apart = self.per_turn / self.control.dogs
        return cycles % max(1, round(apart)) == 0

    def _read(self, began: float, behind: list[float], turn: float) -> None:
        """Take the readings that fall into a tick, and what follows from them."""
        while self.sampled <= self.now + 1e-12:
            place = min(max(int((self.sampled - began) / self.interval), 0), len(behind) - 1)
            reading = behind[place]
            if not self.clutch:
                reading += self.control.noise * self.noise.standard_normal()
                reading = self._failed(min(reading, self.full_scale), turn)
            self.reading = reading
            before = self.switch.on
            asked = self.switch.read(self.sampled, reading)
            if asked != before:
                delay = 0.0 if self.clutch else self.control.delay
                self.waiting.append((self.sampled + delay, asked))
            self.sampled += self.tick if self.clutch else 1.0 / self.control.sample_rate

    def _failed(self, reading: float, turn: float) -> float:
        """Return what a sensor that fails reads instead."""
        drive, failure = self.problem.drive, self.failure
        since = 0.5 * (drive.stroke_seat if failure == "frozen-seat" else drive.stroke)
        if turn < since or failure not in ("broken", "full", "frozen", "frozen-seat"):
            return reading
        if failure == "broken":
            return 0.0
        if failure == "full":
            return self.full_scale
        if self.frozen is None:
            self.frozen = reading
        return self.frozen
