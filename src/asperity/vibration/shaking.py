"""Vibration imposed on a contact: waveform, amplitude, direction, start."""

import csv
import dataclasses
import functools
import io
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import model_validator

from asperity.arrays import FloatArray
from asperity.casefile import Table
from asperity.errors import InputError, choices, shown
from asperity.files import store
from asperity.units import Quantity
from asperity.vibration.waveform import SAMPLED, SINE, SQUARE, STEPS_A_TURN, TRIANGLE, Shape

_TABLE_POINTS = 8192
_STEPS_A_FLANK = 4


MODES = ("axial", "torsional", "wheel-axial", "screw")
"""Which way a gearset is shaken."""

_OF_BODIES = ("direction", "elevation", "normal_phase")
_TURNS = 10.0  # of an angle: more are meant by nobody, and cost digits
_FARTHEST = 2.0 * math.pi * _TURNS
Angle = Annotated[
    float, Quantity("rad", what="an angle", example="90 deg", ge=-_FARTHEST, le=_FARTHEST)
]
"""An angle of some turns at most, rad."""
_PER_TURN = re.compile(r"\s*(\S+)\s+per\s+turn\s*")


class Vibration(Table):
    """Vibration of the base or of the body, or of a gearset.

    Parameters
    ----------
    waveform : {'sine', 'triangle', 'square', 'sampled'}
        Shape of the displacement.
    frequency : float or str, optional
        Cycles per second, Hz. Left out, a sampled waveform takes the period of its samples; given,
        it must agree with them to 1e-6. At a gearset also "12 per turn", as of a cam on the worm.
    per_turn : float, optional
        The same as a number: cycles in a turn of the worm.
    velocity_ratio : float, optional
        Peak velocity over drive velocity, k = v_a/v_d. Exactly one of the three amplitudes.
    velocity_amplitude : float or str, optional
        Peak velocity v_a, m/s.
    displacement_amplitude : float or str, optional
        Displacement amplitude u_a, m.
    direction : float or str
        Angle theta between vibration and drive, seen from above (azimuth), rad; 0 longitudinal,
        90 deg transverse; ten turns at most either way.
    elevation : float or str
        Angle between vibration and plane of contact, rad, 0 to 180 deg; 90 deg is normal to the
        plane. Out of the plane it needs the ``[normal]`` table. Beyond 90 deg the base falls as it
        moves along: not the mirror image of the angle below.
    normal_phase : float or str
        How far the normal part leads the part in the plane, rad: an ellipse.
    mode : {'axial', 'torsional', 'wheel-axial', 'screw'}, optional
        Which way a gearset is shaken: the worm along its axis, about it, the wheel along its axis,
        or the worm along and about its axis in phase, as the screw that it is. An amplitude of
        ``torsional`` and ``screw`` is that of the arc on the worm's reference circle.
    applied_to : {'base', 'body', 'worm', 'seat', 'wheel', 'motor'}
        What is shaken. A body's prescribed motion is added to its own; its inertia is not
        charged to the drive. Of a gearset (the worm if left out): the worm itself, the seat of its
        bearings, the wheel, or the end of the shaft where the motor turns it.
    start : float or str
        Time at which it begins, s; the phase is counted from here.
    ramp : float or str
        Time in which the amplitude grows from nothing, s; 0: it is there at once.
    rise_time : float or str, optional
        Duration of a flank of the square wave, s.
    samples : path, optional
        CSV file of a sampled waveform: time in s, displacement in m (any scale), one period with
        the last row repeating the first displacement.
    """

    table: ClassVar[str] = "vibration"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("velocity_ratio", "velocity_amplitude", "displacement_amplitude"),
        ("frequency", "per_turn"),
    )
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("velocity_ratio", "velocity_amplitude", "displacement_amplitude"),
    )

    waveform: Literal["sine", "triangle", "square", "sampled"] = "sine"
    frequency: (
        Annotated[float, Quantity("Hz", what="a frequency", example="4 kHz", gt=0)] | None
    ) = None
    per_turn: (
        Annotated[float, Quantity("", what="a number of cycles", example="12", gt=0, le=1e6)] | None
    ) = None
    velocity_ratio: Annotated[float, Quantity("", what="a ratio", example="6.0", ge=0)] | None = (
        None
    )
    velocity_amplitude: (
        Annotated[float, Quantity("m/s", what="a velocity", example="3 mm/s", ge=0)] | None
    ) = None
    displacement_amplitude: (
        Annotated[float, Quantity("m", what="a displacement", example="0.2 um", ge=0)] | None
    ) = None
    direction: Angle = 0.0
    elevation: Annotated[
        float, Quantity("rad", what="an angle", example="30 deg", ge=0, le=math.pi)
    ] = 0.0
    normal_phase: Angle = 0.0
    mode: Literal["axial", "torsional", "wheel-axial", "screw"] | None = None
    applied_to: Literal["base", "body", "worm", "seat", "wheel", "motor"] = "base"
    start: Annotated[float, Quantity("s", what="a time", example="0.14 s", ge=0)] = 0.0
    ramp: Annotated[float, Quantity("s", what="a time", example="0.1 s", ge=0)] = 0.0
    rise_time: Annotated[float, Quantity("s", what="a time", example="10 us", gt=0)] | None = None
    samples: Path | None = None

    @model_validator(mode="before")
    @classmethod
    def _by_turns(cls, data: Any) -> Any:
        """Take a frequency that is counted by the turns of a worm for what it is."""
        written = data.get("frequency") if isinstance(data, Mapping) else None
        found = _PER_TURN.fullmatch(written) if isinstance(written, str) else None
        if found is None:
            return data
        if data.get("per_turn") is not None:
            raise InputError("vibration.frequency and vibration.per_turn are given; keep one")
        return {key: value for key, value in data.items() if key != "frequency"} | {
            "per_turn": found[1]
        }

    @model_validator(mode="after")
    def _consistent(self) -> "Vibration":
        if self.waveform == "sampled" and self.samples is None:
            raise InputError(
                "vibration.samples is missing; a sampled waveform needs a CSV file with time and "
                "displacement of one period"
            )
        if self.waveform != "sampled" and self.samples is not None:
            raise InputError(
                f"vibration.samples is given, but vibration.waveform is '{self.waveform}'; set it "
                "to 'sampled' or leave the samples out"
            )
        if self.frequency is None and self.per_turn is None and self.waveform != "sampled":
            raise InputError("vibration.frequency is missing; give one such as '4 kHz'")
        if self.waveform == "square":
            if self.rise_time is None:
                raise InputError(
                    "vibration.rise_time is missing; a square wave needs the duration of its "
                    "flanks, such as '10 us'"
                )
            if self.frequency is not None and self.rise_time * self.frequency > 0.5:
                raise InputError(
                    f"vibration.rise_time is {self.rise_time:g} s; it must not exceed half a "
                    f"period, {0.5 / self.frequency:g} s"
                )
        elif self.rise_time is not None:
            raise InputError(
                f"vibration.rise_time is for a square wave; the waveform is '{self.waveform}'"
            )
        return self

    def of_body(self) -> Self:
        """Return it as a sliding body takes it; raises InputError for that of a gearset."""
        for key in ("mode", "per_turn"):
            if getattr(self, key) is not None:
                raise InputError(
                    f"vibration.{key} is of a gearset (`asperity drive`); a sliding body takes "
                    "vibration.direction and vibration.frequency: leave it out"
                )
        if self.applied_to not in ("base", "body"):
            raise InputError(
                f"vibration.applied_to is '{self.applied_to}', a part of a gearset; of a sliding "
                "body it must be 'base' or 'body'"
            )
        return self

    def of_gearset(self, places: Mapping[str, Sequence[str]] | None = None) -> Self:
        """Return it as a gearset takes it; raises InputError for that of a sliding body.

        Parameters
        ----------
        places : mapping of str to sequence of str, optional
            Where each mode is applied to, the first if nothing is said; the worm if left out.
        """
        for key in _OF_BODIES:
            if key in self.model_fields_set:
                raise InputError(
                    f"vibration.{key} is of a sliding body; a gearset is shaken by vibration.mode, "
                    f"one of {choices(MODES)}: leave it out"
                )
        if self.start:
            raise InputError(
                f"vibration.start is {self.start:g} s, of a sliding body; a gearset is followed "
                "from where its vibration begins: leave it out (vibration.ramp has the amplitude "
                "grow)"
            )
        if self.mode is None:
            raise InputError(
                f"vibration.mode is missing; a gearset is shaken one way of {choices(MODES)}"
            )
        if "applied_to" not in self.model_fields_set:
            first = "worm" if places is None else places[self.mode][0]
            return self.model_copy(update={"applied_to": first})
        if self.applied_to in ("base", "body"):
            raise InputError(
                f"vibration.applied_to is '{self.applied_to}', of a sliding body; of a gearset it "
                "must be 'worm', 'seat', 'wheel' or 'motor'"
            )
        return self

    def shape(self, folder: Path | None = None, *, turns: float | None = None) -> "Shape":
        """Waveform made ready for the kernels.

        Parameters
        ----------
        folder : path, optional
            Where a samples file is looked for.
        turns : float, optional
            Of the worm in a second, which `per_turn` counts.

        Returns
        -------
        Shape
            Frequency in Hz, steepness and what a waveform has besides.

        Raises
        ------
        InputError
            The frequency is per turn of a worm and there is none, or the samples are missing or of
            another frequency.
        """
        if self.per_turn is not None:
            if turns is None:
                raise InputError(
                    f"vibration.frequency is {self.per_turn:g} per turn, but there is no worm "
                    "here: give it in Hz"
                )
            counted = {"frequency": self.per_turn * turns, "per_turn": None}
            return self.model_copy(update=counted, units="SI").shape(folder)
        if self.waveform == "sampled":
            if self.samples is None:
                raise InputError("vibration.samples is missing")
            path = ((folder or Path()) / self.samples).absolute()
            try:
                stamp = store.stamp(path)
            except OSError:
                stamp = 0, 0, 0
            shape = _sampled(path, stamp)
            if self.frequency is None:
                return self._started(shape)
            if abs(shape.frequency / self.frequency - 1.0) > 1e-6:
                raise InputError(
                    f"vibration.frequency is {self.frequency:.10g} Hz, but the samples in {path} "
                    f"span a period of {1 / shape.frequency:.10g} s ({shape.frequency:.10g} Hz); "
                    "leave the frequency out or make them agree"
                )
            return self._started(shape)
        frequency = self.frequency or 0.0
        if self.waveform == "sine":
            return self._started(Shape(SINE, frequency, 2.0 * math.pi, STEPS_A_TURN))
        if self.waveform == "triangle":
            return self._started(Shape(TRIANGLE, frequency, 4.0, STEPS_A_TURN))
        rise = (self.rise_time or 0.0) * frequency
        least_steps = max(STEPS_A_TURN, _STEPS_A_FLANK / rise)
        return self._started(Shape(SQUARE, frequency, 2.0 / rise, least_steps, rise=rise))

    def _started(self, shape: "Shape") -> "Shape":
        if not self.ramp:
            return shape
        return dataclasses.replace(shape, ramp=self.ramp * shape.frequency)

    def displacement(self, shape: "Shape", drive_velocity: float) -> float:
        """Displacement amplitude u_a, m.

        Parameters
        ----------
        shape : Shape
            The waveform, as of `shape`.
        drive_velocity : float
            That a velocity ratio refers to, m/s.

        Returns
        -------
        float
            :math:`u_a`, m.
        """
        if self.displacement_amplitude is not None:
            return self.displacement_amplitude
        return self.velocity(shape, drive_velocity) / (shape.steepness * shape.frequency)

    def velocity(self, shape: "Shape", drive_velocity: float) -> float:
        """Peak velocity v_a, m/s.

        Parameters
        ----------
        shape, drive_velocity : Shape, float
            As of `displacement`.

        Returns
        -------
        float
            :math:`v_a`, m/s: of the displacement times steepness and frequency, or :math:`k v_d`.
        """
        if self.displacement_amplitude is not None:
            return self.displacement_amplitude * shape.steepness * shape.frequency
        if self.velocity_amplitude is not None:
            return self.velocity_amplitude
        return (self.velocity_ratio or 0.0) * abs(drive_velocity)


@functools.lru_cache(maxsize=32)
def _sampled(path: Path, stamp: tuple[int, ...]) -> Shape:
    """Read and check a samples file; cached by its time of change."""
    time, value = _read_samples(path)
    name = f"vibration.samples: {path}"
    steps = np.diff(time)
    if np.any(steps <= 0.0):
        row = int(np.argmax(steps <= 0.0)) + 2
        raise InputError(f"{name}: time does not increase at sample {row}; sort the samples")
    if steps.max() > 5.0 * np.median(steps):
        row = int(np.argmax(steps)) + 1
        raise InputError(
            f"{name}: a gap of {steps.max():g} s after sample {row}, where the samples are "
            f"{np.median(steps):g} s apart; fill it"
        )
    span = value.max() - value.min()
    if span <= 0.0:
        raise InputError(f"{name}: the displacement does not change")
    # A gap small beside the span can still be a jump beside the steps between the samples.
    if abs(value[-1] - value[0]) > 0.05 * np.abs(np.diff(value)).max():
        raise InputError(
            f"{name}: the last displacement, {value[-1]:g}, must repeat the first, {value[0]:g}, "
            "to close the period; if the samples stop one short of it, add that row"
        )
    from scipy.interpolate import CubicSpline

    value[-1] = value[0]
    period = float(time[-1] - time[0])
    spline = CubicSpline((time - time[0]) / period, value, bc_type="periodic")
    phase = np.linspace(0.0, 1.0, _TABLE_POINTS + 1)
    table = spline(phase)
    table -= table[:-1].mean()
    half_range = 0.5 * (table.max() - table.min())
    velocity = spline(phase, 1)
    steepness = float(np.abs(velocity).max() / half_range)
    table = np.ascontiguousarray(table / half_range)
    return Shape(SAMPLED, 1.0 / period, steepness, _steps_to_follow(velocity[:-1]), table=table)


def _steps_to_follow(velocity: FloatArray) -> float:
    """Steps a period needs for a velocity given at equal intervals of it."""
    # A velocity changes as a sine's does where it is correlated with itself as a sine's is.
    correlation = np.fft.irfft(np.abs(np.fft.rfft(velocity)) ** 2)
    correlation /= correlation[0]
    least = math.cos(2.0 * math.pi / STEPS_A_TURN)
    past = int(np.argmax(correlation < least))
    before, after = correlation[past - 1], correlation[past]
    intervals = past - (least - after) / (before - after)
    return max(float(STEPS_A_TURN), float(velocity.size / intervals))


def _read_samples(path: Path) -> tuple[FloatArray, FloatArray]:
    name = f"vibration.samples: {path}"
    lines = csv.reader(io.StringIO(store.read_text(path, name), newline=""))
    try:
        rows = [(lines.line_num, row) for row in lines if row and not row[0].startswith("#")]
    except csv.Error as error:
        raise InputError(f"{name} cannot be read: {error}") from None
    pairs: list[tuple[float, float]] = []
    for number, row in rows:
        try:
            pair = float(row[0]), float(row[1])
        except (ValueError, IndexError):
            if number == rows[0][0] and len(row) >= 2 and not any(map(_is_number, row[:2])):
                continue
            raise InputError(
                f"{name}: line {number} is {shown(','.join(row))}; it must hold two numbers: time "
                "in s, displacement in m"
            ) from None
        if not (math.isfinite(pair[0]) and math.isfinite(pair[1])):
            raise InputError(f"{name}: line {number} is {shown(','.join(row))}; fill the gap")
        pairs.append(pair)
    if len(pairs) < 8:
        raise InputError(f"{name} holds {len(pairs)} samples; a period needs at least 8")
    data = np.array(pairs)
    return data[:, 0], data[:, 1]


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
