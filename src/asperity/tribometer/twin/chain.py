"""From the drive signal to the disc: amplifier, actuator and structure, by harmonics.

Amplifier and actuator are a voltage follower whose current charges the actuator's capacitance, so
that a limit of the current is a limit of the slope. Each harmonic of the voltage then reaches the
disc as a full sine of its frequency does. What is known of that is the table of the sonotrode;
above its last frequency nothing is known, and the harmonics fall off (placeholder).
"""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.tribometer.parameters import Sonotrode

POINTS = 512  #: Of a cycle.
ROLL_OFF = 2.0  #: Power by which the velocity falls above the last frequency; placeholder.
_CYCLES = 4


def unit_wave(waveform: str, points: int = POINTS) -> FloatArray:
    """Return one cycle of a waveform between -1 and 1, zero and rising at its start."""
    phase = np.arange(points) / points
    wave: FloatArray
    if waveform == "sine":
        wave = np.sin(2.0 * np.pi * phase)
    else:
        wave = 1.0 - 4.0 * np.abs(np.mod(phase + 0.25, 1.0) - 0.5)
    return wave


def slope_limited(wave: FloatArray, most: float) -> FloatArray:
    """Return what follows a periodic wave with no more than a slope.

    Parameters
    ----------
    wave : ndarray
        One cycle.
    most : float
        Largest change over a cycle, in the wave's unit.
    """
    step = most / wave.size
    if np.max(np.abs(np.diff(wave, append=wave[0]))) <= step * (1.0 + 1e-9):
        return wave
    followed, at = np.empty_like(wave), 0.0
    # From rest; the first cycles are the way into the periodic state.
    for _ in range(_CYCLES):
        for place, wanted in enumerate(wave):
            at += min(max(wanted - at, -step), step)
            followed[place] = at
    followed -= followed.mean()
    return followed


def transmitted(sonotrode: Sonotrode, mode: str, frequency: float) -> float:
    """Return v_a of the disc under a full sine of any frequency, m/s.

    Raises
    ------
    InputError
        The sonotrode has no table for this mode, or it begins above the frequency.
    """
    known = sonotrode.velocity(mode, frequency)
    if known is not None:
        return known
    table = sonotrode.velocities(mode)
    if not table or frequency < sonotrode.frequencies[0]:
        raise InputError(
            f"sonotrode.{mode}_velocity does not tell how fast the disc moves at {frequency:g} Hz; "
            "give it for sonotrode.frequencies that begin below"
        )
    last = sonotrode.frequencies[-1]
    return float(table[-1] * (last / frequency) ** ROLL_OFF)


def disc_velocity(sonotrode: Sonotrode, mode: str, waveform: str, frequency: float) -> FloatArray:
    """Return one cycle of the disc's velocity, m/s, in `POINTS` points.

    Phases of the structure are not known; each harmonic keeps that of the voltage.
    """
    wave = unit_wave(waveform)
    if sonotrode.current_limit is not None:
        if sonotrode.capacitance is None:
            raise InputError(
                "sonotrode.current_limit is given without sonotrode.capacitance; give both"
            )
        swing = 0.5 * (sonotrode.highest_voltage - sonotrode.lowest_voltage)
        slope = sonotrode.current_limit / (sonotrode.capacitance * swing)
        wave = slope_limited(wave, slope / frequency)
    spectrum = np.fft.rfft(wave)
    spectrum[0] = 0.0
    for harmonic in range(1, spectrum.size - 1):
        if abs(spectrum[harmonic]) < 1e-9 * POINTS:
            spectrum[harmonic] = 0.0
            continue
        reached = transmitted(sonotrode, mode, harmonic * frequency)
        spectrum[harmonic] *= 1j * reached
    spectrum[-1] = 0.0
    velocity: FloatArray = np.fft.irfft(spectrum, POINTS)
    return velocity


def peak_current(sonotrode: Sonotrode, frequency: float) -> float | None:
    """Return the current a full sine takes, A: pi f C Vpp; None where C is not given."""
    if sonotrode.capacitance is None:
        return None
    swing = sonotrode.highest_voltage - sonotrode.lowest_voltage
    return math.pi * frequency * sonotrode.capacitance * swing
