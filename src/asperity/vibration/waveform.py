r"""Waveforms of a vibration, for tables and for kernels.

The waveform names the displacement :math:`u(t)`. Its phase is counted from the start of the
vibration, where the displacement is zero and rising (sine, triangle, square).

========== ================================= =====================================
waveform   displacement                      peak velocity :math:`v_a`
========== ================================= =====================================
sine       :math:`u_a \sin 2\pi f t`         :math:`2\pi f u_a`; thesis (12)
triangle   straight flanks                   :math:`4 f u_a`
square     dwell at :math:`\pm u_a`, flanks  :math:`2 u_a / t_r`
           of duration ``rise_time``
sampled    periodic cubic spline through     the spline's
           the samples, mean removed,
           half its range taken as 1
========== ================================= =====================================
"""

import dataclasses
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.kernels.compiled import kernel

SINE = 0
TRIANGLE = 1
SQUARE = 2
SAMPLED = 3
STEPS_A_TURN = 16
NO_TABLE = np.zeros(2)
# A cycle is divided into up to so many times the steps asked for, for its corners to end steps.
_MOST_FINER = 4
_DWELLS = 1.0 - 1e-9  # part of the amplitude from which a square wave has come to its dwell


class Wave(NamedTuple):
    """A waveform of unit amplitude as kernels take it, times in cycles.

    Attributes
    ----------
    waveform : int
        `SINE`, `TRIANGLE`, `SQUARE` or `SAMPLED`.
    rise : float
        Rise time of a square wave.
    table : ndarray
        One closed period of a sampled wave.
    ramp : float
        Time in which the amplitude grows from nothing; 0: it is there at once.
    lead : float
        How far the wave is ahead of one that starts at phase 0.
    """

    waveform: int
    rise: float
    table: FloatArray
    ramp: float = 0.0
    lead: float = 0.0


AT_REST = Wave(SINE, 0.0, NO_TABLE)


@kernel
def displacement_at(wave, cycles):
    """Displacement over its amplitude at a time in cycles; before the start as at the start."""
    share = 1.0
    if wave.ramp > 0.0:
        share = min(max(cycles / wave.ramp, 0.0), 1.0)
    return share * _unit_displacement(wave, max(cycles, 0.0) + wave.lead)


@kernel
def _unit_displacement(wave, cycles):
    phase = cycles - math.floor(cycles)
    if wave.waveform == SINE:
        return math.sin(2.0 * math.pi * phase)
    if wave.waveform == SAMPLED:
        table = wave.table
        place = phase * (table.size - 1)
        index = min(int(place), table.size - 2)
        return table[index] + (place - index) * (table[index + 1] - table[index])
    # Distance in phase from the nearest zero crossing, signed as the displacement is.
    if phase < 0.25:
        distance = phase
    elif phase < 0.75:
        distance = 0.5 - phase
    else:
        distance = phase - 1.0
    if wave.waveform == TRIANGLE:
        return 4.0 * distance
    # A step that ends on a corner but for rounding would find it creeping while it dwells.
    flank = 2.0 * distance / wave.rise
    return flank if abs(flank) < _DWELLS else math.copysign(1.0, flank)


@kernel
def fill_increments(wave, first_cycles, cycles_per_step, increments):
    """Write the unit displacement's increments over consecutive steps into ``increments``."""
    last = displacement_at(wave, first_cycles)
    if wave.waveform == SINE and wave.ramp == 0.0:
        # By far the most used: loops of its own have no branch, and the one that does not call sin
        # becomes vector instructions. So does NumPy's floor; Python's, an integer, would not.
        for n in range(increments.size):
            cycles = max(first_cycles + (n + 1) * cycles_per_step, 0.0) + wave.lead
            increments[n] = 2.0 * math.pi * (cycles - np.floor(cycles))
        for n in range(increments.size):
            here = math.sin(increments[n])
            increments[n] = here - last
            last = here
        return
    for n in range(increments.size):
        here = displacement_at(wave, first_cycles + (n + 1) * cycles_per_step)
        increments[n] = here - last
        last = here


@dataclasses.dataclass(frozen=True, eq=False)
class Shape:
    """A waveform made ready.

    Attributes
    ----------
    code : int
        `SINE`, `TRIANGLE`, `SQUARE` or `SAMPLED`.
    frequency : float
        Hz.
    steepness : float
        Peak velocity over (amplitude times frequency).
    least_steps : float
        Time steps a period needs: 16 for a sine and a triangle; 4 to a flank of a square wave; so
        many for a sampled wave that its velocity changes over a step by no more of itself, in the
        root mean square, than that of a sine over 1/16 of its period.
    rise : float
        Rise time of a square wave in cycles.
    table : ndarray
        One closed period of a sampled wave, unit amplitude.
    ramp : float
        Time in which the amplitude grows, in cycles.
    """

    code: int
    frequency: float
    steepness: float
    least_steps: float
    rise: float = 0.0
    table: FloatArray = dataclasses.field(default_factory=lambda: NO_TABLE)
    ramp: float = 0.0

    @property
    def cornered(self) -> bool:
        """Whether the velocity jumps."""
        return self.code in (TRIANGLE, SQUARE)

    def corners(self) -> FloatArray:
        """Phases in a quarter of the period at which the velocity jumps; all repeat after half."""
        if not self.cornered:
            return np.empty(0)
        return np.array([0.25] if self.code == TRIANGLE else [0.5 * self.rise])

    def steps_to_corners(self, least: float, missed: float, leads: Sequence[float] = (0.0,)) -> int:
        """Equal steps of a cycle, an even number, of which some end on its corners.

        Parameters
        ----------
        least : float
            Steps to have at least.
        missed : float
            Part of a cycle by which a corner may be missed. The least number of steps is taken
            that misses none by more, else the one of up to four times as many that misses least.
        leads : sequence of float
            Of the waves that are to end steps, in cycles ahead of one that starts at phase 0.
        """
        first = 2 * math.ceil(0.5 * least * (1.0 - 1e-9))
        counts = np.arange(first, _MOST_FINER * first + 2, 2)
        quarter = self.corners()
        half = np.concatenate([quarter, 0.5 - quarter])
        corners = np.concatenate([half - lead for lead in leads])
        places = np.multiply.outer(counts, corners)
        apart = np.abs(places - np.round(places)).max(axis=1) / counts
        met = np.flatnonzero(apart <= missed)
        return int(counts[met[0] if met.size else np.argmin(apart)])

    def on_corners(self, steps: int) -> "Shape":
        """Return the wave of the same amplitude whose corners end equal steps of a cycle."""
        if self.code != SQUARE:
            return self
        return dataclasses.replace(self, rise=2.0 * max(1, round(0.5 * self.rise * steps)) / steps)

    def missed(self, steps: int) -> float:
        """Part of a cycle that the flanks of `on_corners` take for those of the wave."""
        return abs(self.on_corners(steps).rise - self.rise)

    def wave(self, *, lead: float = 0.0, ramped: bool = True) -> Wave:
        """Return the wave for kernels, ``lead`` cycles ahead; in full from the start if asked."""
        return Wave(self.code, self.rise, self.table, self.ramp if ramped else 0.0, lead)

    def increments(self, first_cycles: float, cycles_per_step: float, steps: int) -> FloatArray:
        """Increments of the unit displacement over ``steps`` steps."""
        out = np.empty(steps)
        fill_increments(self.wave(), first_cycles, cycles_per_step, out)
        return out

    def cycle(self, steps: int, lead: float = 0.0) -> FloatArray:
        """Increments of the unit displacement over a cycle's steps and the first of the next."""
        return cycle_of_wave(self.wave(lead=lead), steps)


def cycle_of_wave(wave: Wave, steps: int) -> FloatArray:
    """Increments of a wave, in full from the start, over a cycle's steps and one of the next."""
    out = np.empty(steps + 1)
    # One cycle late, so that the wave's rest before its start is not met.
    fill_increments(wave._replace(ramp=0.0), 1.0, 1.0 / steps, out)
    return out
