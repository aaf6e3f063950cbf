r"""Pressures of a loaded flank: what the mesh has, and what a Hertzian line of the same load has.

Contact lines are narrower than the elements of any mesh of a whole tooth. What the mesh gives at
its nodes grows as it is refined; what is honest is the load on a length of the line with the
relative curvature across it,

.. math:: p_H = \sqrt{\frac{w' E^*}{\pi \rho}}, \qquad b = \sqrt{\frac{4 w' \rho}{\pi E^*}} .
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.teeth.contact import TeethContact
from asperity.drive.teeth.sector import Sector
from asperity.flanks.meshing.kinematics import kinematics
from asperity.gearset.materials import Material
from asperity.rating.iso14521.hertz import contact_modulus

_MILLIMETRES = 1e3
# Half-widths of the line over the distance of points across it, from where the mesh resolves it.
_RESOLVED = 3.0
_LEAST_SHARE = 1e-3


@dataclasses.dataclass(frozen=True, eq=False)
class FlankPressure:
    """Makes pressures of one flank from the forces at its points."""

    sector: Sector
    modulus: float  #: E* of both bodies, Pa

    @classmethod
    def of(cls, sector: Sector, wheel: Material, worm: Material) -> FlankPressure:
        """Return what makes pressures of a sector's flank under a worm."""
        modulus = contact_modulus(
            1e-6 * worm.youngs_modulus, worm.poisson_ratio,
            1e-6 * wheel.youngs_modulus, wheel.poisson_ratio,
        )  # fmt: skip
        return cls(sector, 1e6 * float(modulus))

    @cached_property
    def _curvature(self) -> tuple[FloatArray, FloatArray]:
        """Relative curvature across the line, 1/m, and the line's direction, at all points."""
        grid, row, column = self.sector.exact_grid
        met = kinematics(self.sector.wheel.pair, grid, 1)
        along = met.along[row, column]
        return _MILLIMETRES * np.abs(met.line_curvature[row, column]), along

    def field(self, contact: TeethContact, k: int) -> FloatArray:
        """Return the pressure at all points of a tooth, the k-th of those in mesh, (4k,), Pa."""
        found = np.zeros(len(self.sector.body.weights))
        count = int(contact.candidates.counts[k, 0])
        points = (4 * contact.candidates.face[k, :count, None] + np.arange(4)).ravel()
        found[points] = contact.answer.pressure[k, : 4 * count]
        return found

    def nodal(self, pressure: FloatArray) -> FloatArray:
        """Return a pressure at the nodes, (n,), Pa."""
        surface = self.sector.surface
        return surface.to_nodes(pressure.reshape(surface.weights.shape))

    def hertz(self, pressure: FloatArray) -> tuple[float, bool]:
        """Return the greatest Hertzian pressure of a tooth's line, Pa, and if the mesh resolves it.

        The load is counted by columns of points over the face; each has a length of the line that
        leans with its direction there.
        """
        if not pressure.any():
            return 0.0, True
        body = self.sector.body
        force = pressure * body.weights
        curvature, along = self._curvature
        z = np.round(body.places[:, 2], 9)
        columns, column = np.unique(z, return_inverse=True)
        load = np.asarray(np.bincount(column, force), dtype=np.float64)
        edges = np.concatenate([[columns[0]], 0.5 * (columns[1:] + columns[:-1]), [columns[-1]]])
        # The first and last points lie inside the face by as much as they stand for.
        edges[0] -= edges[1] - columns[0]
        edges[-1] += columns[-1] - edges[-2]
        lean = np.bincount(column, force * np.abs(along[:, 2])) / np.maximum(load, 1e-300)
        bent = np.bincount(column, force * curvature) / np.maximum(load, 1e-300)
        counted = load > _LEAST_SHARE * load.sum()
        length = np.diff(edges) / np.maximum(lean, 0.05)
        line = _smoothed(load)[counted] / length[counted]
        values = np.sqrt(line * self.modulus * bent[counted] / np.pi)
        worst = int(np.argmax(values))
        half_width = np.sqrt(4.0 * line[worst] / (np.pi * self.modulus * bent[counted][worst]))
        spacing = 0.5 * float(np.sqrt(self.sector.surface.area / len(self.sector.surface.faces)))
        return float(values[worst]), bool(half_width >= _RESOLVED * spacing)


def _smoothed(load: FloatArray) -> FloatArray:
    """Loads of columns without the swing between the two points of an element."""
    pairs = load.reshape(-1, 2).mean(axis=1)
    return np.repeat(pairs, 2)
