"""Random numbers for the simulated sensors, drawn ahead beside what else is done.

Drawing them takes as long as everything else about a sample, and needs nothing of it.
"""

import concurrent.futures as cf
from typing import Any

import numpy as np
from numpy.typing import NDArray

Normals = NDArray[np.float32]

_ROWS = 1 << 14


class Noise:
    """Rows of normal numbers that follow from a seed, however many are taken at a time.

    Parameters
    ----------
    seed : int
        Of the numbers.
    columns : int
        Of a row.
    """

    def __init__(self, seed: int, columns: int) -> None:
        self._columns = columns
        self._rng = np.random.Generator(np.random.PCG64(seed))
        self._pool: cf.ThreadPoolExecutor | None = None
        self._ahead: cf.Future[tuple[Any, Normals]] | None = None
        self._begun, self._rows = self._drawn()
        self._used = 0

    def _drawn(self) -> tuple[Any, Normals]:
        """Draw rows; returns where the generator stood before, and them."""
        begun = self._rng.bit_generator.state
        return begun, self._rng.standard_normal((_ROWS, self._columns), dtype=np.float32)

    def take(self, count: int) -> Normals:
        """Return the next rows."""
        parts = []
        while count:
            if self._used == _ROWS:
                self._next()
            some = self._rows[self._used : self._used + count]
            self._used += len(some)
            count -= len(some)
            parts.append(some)
        if len(parts) == 1:
            return parts[0]
        return np.concatenate([np.empty((0, self._columns), np.float32), *parts])

    def _next(self) -> None:
        if self._pool is None:
            self._pool = cf.ThreadPoolExecutor(1)
        ahead = self._ahead or self._pool.submit(self._drawn)
        self._begun, self._rows = ahead.result()
        self._used = 0
        self._ahead = self._pool.submit(self._drawn)

    def state(self) -> dict[str, Any]:
        """Return where it stands, for JSON."""
        return {"generator": self._begun, "used": self._used}

    def restore(self, state: dict[str, Any]) -> None:
        """Stand there again."""
        if self._ahead is not None:
            self._ahead.result()
            self._ahead = None
        self._rng.bit_generator.state = state["generator"]
        self._begun, self._rows = self._drawn()
        self._used = int(state["used"])
