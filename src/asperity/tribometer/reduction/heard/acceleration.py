"""The accelerometer: its tone at the drive's frequency, and what it hears beside that."""

import dataclasses
import math
from collections.abc import Iterator, Mapping

import numpy as np

from asperity.tribometer.channels import Channels
from asperity.tribometer.reduction import drive_signal
from asperity.tribometer.reduction.blocks import lines_of
from asperity.tribometer.reduction.heard.drive import groups
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.spectrum import spectrum_of

_ORDERS = 2, 3, 4, 5
_BESIDE = 0.3  # of the tone, above which what is beside it is told
_ABOVE_NOISE = 10.0  # of the usual line of the spectrum, for a tone to be heard
_STEADY = 0.3  # of a level, between its least and its largest
_REMEDY = "look at how it is fixed, at its cable and at the mains"


@dataclasses.dataclass(frozen=True)
class Heard:
    """What an accelerometer hears of a vibration, m/s2.

    Attributes
    ----------
    amplitude : float
        Peak of its tone at the drive's frequency.
    overtones : tuple of float
        Peaks of its harmonics from the second on; not a number where samples are too few.
    beside, at : float
        Peak of the strongest tone that is none of these, and its frequency, Hz.
    noise : float
        Peak of what the usual line is worth.
    """

    amplitude: float
    overtones: tuple[float, ...]
    beside: float
    at: float
    noise: float

    @property
    def told(self) -> bool:
        """Whether there is a tone at all."""
        return self.amplitude > _ABOVE_NOISE * self.noise


def heard(of: Material, place: int) -> Heard | None:
    """Return what the accelerometer hears in a segment; None where nothing can be told."""
    one = of.segments[place]
    if not of.has("acceleration") or one.tone is None:
        return None
    samples = of.blocks.samples
    first, last = one.shaken.first * samples, one.shaken.last * samples
    scale, line = lines_of(of.recording, of.case.require(Channels))["acceleration"]
    signal = line.of(scale * of.recording.values("acceleration", first, last))
    found = drive_signal.Spectrum.of(signal, of.recording.sample_interval)
    if found is None:
        return None
    frequency = one.tone.frequency
    amplitude = found.amplitude(frequency)
    overtones = tuple(
        found.amplitude(order * frequency) if found.holds(order * frequency) else math.nan
        for order in _ORDERS
    )
    at, beside = found.strongest(apart=[order * frequency for order in (1, *_ORDERS)])
    return Heard(amplitude, overtones, beside, at, found.usual)


def findings(of: Material, told: Mapping[int, Heard]) -> Iterator[Finding]:
    """Yield what an accelerometer hears beside the vibration of segments, or does not hear."""
    for place, one in told.items():
        yield from _findings(of, place, one)


def _findings(of: Material, place: int, told: Heard) -> Iterator[Finding]:
    one = of.segments[place]
    if one.tone is None:
        return
    frequency = one.tone.frequency
    overtones = ", ".join(
        f"{peak:.3g} at {order * frequency:.0f} Hz"
        for order, peak in zip(_ORDERS, told.overtones, strict=True) if not math.isnan(peak)
    )  # fmt: skip
    at_drive = f"{told.amplitude:.3g} m/s2 at {frequency:.0f} Hz"
    name = ""
    if not told.told:
        name = "accelerometer does not hear the vibration"
        evidence = f"{at_drive}, {told.beside:.3g} at {told.at:.0f} Hz"
    elif (most := max((x for x in told.overtones if not math.isnan(x)), default=0.0)) > (
        _BESIDE * told.amplitude
    ):
        name = "accelerometer hears overtones"
        evidence = f"{at_drive} is taken alone, beside it {overtones}"
        evidence += f", {100.0 * most / told.amplitude:.0f} % of it"
    elif told.beside > _BESIDE * told.amplitude:
        name = "accelerometer hears something else"
        evidence = f"{at_drive} is taken alone, beside it {told.beside:.3g} at {told.at:.0f} Hz"
    if name:
        yield Finding(
            name, evidence, _REMEDY, ("acceleration",), spectrum_of(of, place, "acceleration"),
            place,
        )  # fmt: skip
        return
    level = groups(of, "acceleration", one.shaken)
    middle = float(np.median(level))
    if middle > 0.0 and float(np.ptp(level)) > _STEADY * middle:
        part = of.around(place)
        course = of.course("acceleration", [one.shaken], part=part)
        yield Finding(
            "accelerometer's level is not steady",
            f"its deviation is between {level.min():.3g} and {level.max():.3g} m/s2 within the "
            "window",
            "see whether the vibration came late, or the sensor is loose", ("acceleration",),
            course, place,
        )  # fmt: skip
