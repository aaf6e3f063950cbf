"""The cycles that follow the march of a batch, of all its bodies at once."""

from collections.abc import Iterator, Sequence
from typing import Protocol

import numpy as np

from asperity.arrays import FloatArray
from asperity.slider import batch_rows as row
from asperity.slider.batch_bodies import Body

_WHOLE = 1e-9  # of a cycle, that its steps may be off it


class _MarchOn(Protocol):
    def __call__(self, steps: int, *, window: bool) -> None: ...


class Onward:
    """Ratios of the cycles that follow a batch's march, marched when the first body asks for them.

    Parameters
    ----------
    bodies : sequence of Body
        Those of the batch.
    buffer : ndarray, shape (ROWS, WIDTH)
        At the end of the march; it goes on.
    march_on : callable
        Marches all by so many steps, with the sums of a window or without.
    """

    def __init__(self, bodies: Sequence[Body], buffer: FloatArray, march_on: _MarchOn) -> None:
        self._counts = [_steps_of_a_cycle(body) for body in bodies]
        # All take the steps of the first that has whole ones.
        self._steps = next(filter(None, self._counts), 0)
        self._buffer = buffer
        self._march_on = march_on
        self._ratios: list[FloatArray] = []

    def ratios(self, place: int) -> Iterator[float] | None:
        """Return the ratios of a body's next cycles; None where it has no whole steps in common."""
        if not self._steps or self._counts[place] != self._steps:
            return None
        return self._of(place)

    def _of(self, place: int) -> Iterator[float]:
        done = 0
        while True:
            if done == len(self._ratios):
                self._ratios.append(self._cycle())
            yield float(self._ratios[done][place])
            done += 1

    def _cycle(self) -> FloatArray:
        """March all by a cycle; returns the mean drive forces over mu F_N."""
        buffer = self._buffer
        buffer[[*row.SUMS]] = 0.0
        before = self._drive_forces()
        self._march_on(self._steps, window=True)
        after = self._drive_forces()
        # One that has left the finite numbers marches along.
        with np.errstate(invalid="ignore", over="ignore"):
            means: FloatArray = (buffer[row.SUM_FREE] + 0.5 * (before - after)) / self._steps
        return means

    def _drive_forces(self) -> FloatArray:
        with np.errstate(invalid="ignore", over="ignore"):
            forces: FloatArray = self._buffer[row.STIFFNESS] * self._buffer[row.STRETCH]
        return forces


def _steps_of_a_cycle(body: Body) -> int:
    """Return the steps of a cycle of a body on its drive, as many as alone; 0 where not whole.

    It is asked of none whose vibration still grows, see `asperity.slider.judged_march.foretold`.
    """
    model, table = body.model, body.table
    if not model.vibrates or model.slider.rigid:
        return 0
    cycle = 1.0 / (model.frequency * table.step)
    count = round(cycle)
    even = model.meets_corners or count % 2 == 0
    return count if even and np.isclose(count, cycle, rtol=_WHOLE, atol=0.0) else 0
