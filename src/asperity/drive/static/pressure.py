r"""Pressures of a loaded flank: what the mesh has, and what a Hertzian line of the same load has.

Contact lines are narrower than the elements of any mesh of a whole tooth. What the mesh gives at
its nodes grows as it is refined; what is honest is the load on a length of the line with the
relative curvature across it, where the worm bears with its flank and not with its tip,

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
# Of the line, over which its load is counted, in elements.
_STRETCH = 1.5


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
    def _lines(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Relative curvature across the line, 1/m, where there is one, the line's direction.

        Where the worm bears with the rounding of its tip there is no line: 0 in the third.
        """
        grid, row, column = self.sector.exact_grid
        met = kinematics(self.sector.wheel.pair, grid, 1)
        along = met.along[row, column]
        curvature = _MILLIMETRES * np.abs(met.line_curvature[row, column])
        return curvature, along, met.on_flank[row, column].astype(np.float64)

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

        The load is counted by stretches along the line, each longer than an element, so that it
        does not matter where the points lie.
        """
        if not pressure.any():
            return 0.0, True
        body, surface = self.sector.body, self.sector.surface
        force = pressure * body.weights
        curvature, along, on_flank = self._lines
        element = float(np.sqrt(surface.area / len(surface.faces)))
        loaded = force > 0.0
        direction = along[int(np.argmax(force))]
        aligned = along * np.sign(along @ direction)[:, None]
        mean = force @ aligned
        place = body.places @ (mean / np.linalg.norm(mean))
        ends = float(place[loaded].min()) - 0.25 * element, float(place[loaded].max())
        count = max(1, int((ends[1] + 0.25 * element - ends[0]) / (_STRETCH * element)))
        length = (ends[1] + 0.25 * element - ends[0]) / count
        stretch = ((place[loaded] - ends[0]) / length).astype(np.int64)
        load = np.bincount(stretch, force[loaded], count)
        weight = force * on_flank
        if not weight.any():
            return 0.0, True
        rolling = np.bincount(stretch, weight[loaded], count)
        bent = np.bincount(stretch, (weight * curvature)[loaded], count)
        bent = np.where(rolling > 0.0, bent / np.maximum(rolling, 1e-300), 0.0)
        line = load / length
        values = np.sqrt(line * self.modulus * bent / np.pi)
        worst = int(np.argmax(values))
        half_width = 2.0 * line[worst] / (np.pi * values[worst])
        return float(values[worst]), bool(half_width >= _RESOLVED * 0.5 * element)
