"""The normal force of the reduced mesh against the approach of its flanks, from measured points."""

import dataclasses
import functools
from collections.abc import Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.point import MeshPoint
from asperity.kernels.compiled import kernel
from asperity.kernels.uncounted import uncounted

_CELLS = 2048
_REACH = 100.0  # of the force at the reference load, up to which the law is tabulated


@dataclasses.dataclass(frozen=True, eq=False)
class NormalLaw:
    """A force that rises with the approach: powers between the points and beyond them.

    Attributes
    ----------
    approach, force : ndarray
        Points, m and N, both rising.
    """

    approach: FloatArray
    force: FloatArray

    @classmethod
    def of(
        cls, point: MeshPoint, deflection: Sequence[tuple[float, float]], friction: float
    ) -> "NormalLaw":
        """Return the law behind the angles that torques turn the wheel by, forward.

        Parameters
        ----------
        point : MeshPoint
            Where it acts.
        deflection : sequence of pairs of float
            Wheel torques, N m, and angles, rad.
        friction : float
            Under which they were found.
        """
        torque, angle = np.array(deflection).T
        unit = point.normal_force(1.0, friction)
        return cls(point.normal_z * point.arm * angle, unit * torque)

    def approach_at(self, force: float) -> float:
        """Approach under a force, m."""
        logs = np.log(self.force)
        cell = int(np.clip(np.searchsorted(logs, np.log(force)) - 1, 0, logs.size - 2))
        power = self._powers[cell]
        return float(self.approach[cell] * (force / self.force[cell]) ** (1.0 / power))

    @functools.cached_property
    def _powers(self) -> FloatArray:
        return np.diff(np.log(self.force)) / np.diff(np.log(self.approach))

    def exact(self, approach: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Force and its slope at approaches in m, 0 where there is none."""
        over = np.maximum(approach, np.finfo(np.float64).tiny)
        cell = np.clip(np.searchsorted(self.approach, over) - 1, 0, self._powers.size - 1)
        power = self._powers[cell]
        force = self.force[cell] * (over / self.approach[cell]) ** power
        return np.where(approach > 0.0, force, 0.0), np.where(
            approach > 0.0, power * force / over, 0.0
        )

    def table(self, reference: float) -> tuple[float, FloatArray]:
        """Return the law as kernels take it: a cell's width, m, and cubics with their energies.

        Cubics of equal cells keep values and slopes of the law; the energy is their integral, so
        that force and energy belong together to the last digit.

        Parameters
        ----------
        reference : float
            Force the mesh is loaded by, N.

        Returns
        -------
        cell : float
            Width, m.
        rows : ndarray, shape (n, 5)
            Coefficients by the place in the cell (0..1), constant first, N; energy at its start, J.
        """
        end = self.approach_at(_REACH * reference)
        cell = end / _CELLS
        place = np.asarray(cell * np.arange(_CELLS + 1), float)
        force, slope = self.exact(place)
        slope = slope * cell
        rise = np.diff(force)
        rows = np.empty((_CELLS, 5))
        rows[:, 0] = force[:-1]
        rows[:, 1] = slope[:-1]
        rows[:, 2] = 3.0 * rise - 2.0 * slope[:-1] - slope[1:]
        rows[:, 3] = slope[:-1] + slope[1:] - 2.0 * rise
        work = cell * rows[:, :4] @ np.array([1.0, 1 / 2, 1 / 3, 1 / 4])
        rows[:, 4] = np.concatenate([[0.0], np.cumsum(work)[:-1]])
        return cell, rows


@uncounted
@kernel(inline="always")
def force_and_energy(cell, rows, d):
    """Force and stored energy at an approach; beyond the table the force goes on straight."""
    if d <= 0.0:
        return 0.0, 0.0
    place = d / cell
    index = min(int(place), rows.shape[0] - 1)
    a, b, c, e, energy = (
        rows[index, 0], rows[index, 1], rows[index, 2], rows[index, 3], rows[index, 4],
    )  # fmt: skip
    x = min(place - index, 1.0)
    force = a + x * (b + x * (c + x * e))
    energy += cell * x * (a + x * (b / 2.0 + x * (c / 3.0 + x * e / 4.0)))
    over = place - index - x
    if over > 0.0:
        slope = b + 2.0 * c + 3.0 * e
        energy += cell * over * (force + 0.5 * over * slope)
        force += over * slope
    return force, energy
