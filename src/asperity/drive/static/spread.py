r"""How the load lies on the flanks over a pitch: across the face, along the contacts, by teeth.

:math:`K_{H\beta}` is the largest force by width over the mean one, of the normal forces of all
teeth and phases by their place across the face, in strips of a twentieth of it.
:math:`K_{H\alpha}` is the largest force on a tooth over what it would be if the mean number of
teeth that bear shared evenly. All forces are those of the patches. Both are factors as of
ISO 6336-1, of the contact as it is and not of an estimate.
"""

from __future__ import annotations

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.resolved.flank import ExactFlank
from asperity.drive.resolved.pressures import Resolved

STRIPS = 20
"""Of the face, in which the force is summed up."""

LOADED = 1e-3
"""Share of the normal force from which on a tooth counts as loaded."""

# Of the force in one strip, from which on it counts as all of it.
_ALL = 0.999


class Spread:
    """What is summed up of the resolved pressures of a pitch.

    Parameters
    ----------
    flank : ExactFlank
        Of the teeth.
    """

    def __init__(self, flank: ExactFlank) -> None:
        self._flank = flank
        self.face = np.zeros(STRIPS)  #: Force by strip of the face, summed over the phases, N
        self.line_load = 0.0  #: Largest force by length along a contact, N/m
        self._moments = np.zeros(2)

    def take(self, resolved_pressure: Resolved) -> None:
        """Take the pressures of a phase."""
        half = self._flank.half_face
        for tooth in resolved_pressure.teeth:
            on = tooth.force > 0.0
            points, force = tooth.strip.points[on], tooth.force[on]
            strip = (points[:, 2] + half) * (0.5 * STRIPS / half)
            strip = np.clip(strip.astype(np.int64), 0, STRIPS - 1)
            self.face += np.bincount(strip, force, STRIPS)
            radius = np.hypot(points[:, 0], points[:, 1])
            self._moments += force @ points[:, 2], force @ radius
            shape, (_, along) = tooth.strip.frame.shape, tooth.strip.frame.spacing
            by_length = tooth.force.reshape(shape).sum(axis=0) / along
            self.line_load = max(self.line_load, float(by_length.max()))

    @property
    def k_h_beta(self) -> float:
        """Largest force by width over the mean one; `STRIPS` at most."""
        return float(self.face.max() / self.face.mean())

    @property
    def centre(self) -> tuple[float, float]:
        """Middle of the forces, from mid-face and from the mean circle outwards, m."""
        pair = self._flank.sector.wheel.pair
        z, radius = self._moments / self.face.sum()
        mean = 0.5e-3 * pair.geometry.wheel_mean_diameter
        return pair.mirror * float(z), float(radius) - mean


def told_k_h_beta(factor: float) -> str:
    """Return K_Hbeta in words: no strip tells more than that all of the force lies in it."""
    most = factor > _ALL * STRIPS
    return f"{factor:.3g} or more" if most else f"{factor:.3g}"


def k_h_alpha(tooth_force: FloatArray) -> float:
    """Return the largest share of a tooth times the mean number of teeth that bear.

    Parameters
    ----------
    tooth_force : ndarray, shape (p, K)
        Normal forces by phase and tooth, N.
    """
    share = shares(tooth_force)
    return float(share.max() * (share > LOADED).sum(axis=1).mean())


def shares(tooth_force: FloatArray) -> FloatArray:
    """Return the share of each tooth in the normal force of its phase; forces as above."""
    return np.asarray(tooth_force / tooth_force.sum(axis=1, keepdims=True))
