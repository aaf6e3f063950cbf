r"""How a pressed body gives under friction on its base: what comes between it and its asperities.

Friction of 1 N spread evenly over the base along x or y has the nodal forces :math:`e`. While all
of the base touches, the contact is a bed of springs :math:`k`, and its pressure answers to what the
base does normal to it, with :math:`Z = (k^{-1} + C_{nn})^{-1}`. Generalised coordinates :math:`q`
and the mean displacement :math:`w` of the base under friction :math:`t` along x and y are then

.. math:: M \ddot q + K q = B^T t, \qquad w = B q + G t ,

.. math:: K = K_0 + \Phi_n^T Z \Phi_n, \quad B = e^T (\Phi - C_{\cdot n} Z \Phi_n), \quad
    G = e^T (C - C_{\cdot n} Z C_{n \cdot})\, e .

:math:`G` is shear, and bending by the pressure, which follow at once. The coordinates are the
body's turns on its bed of springs, which have inertia: friction acts below the centre of mass, and
the body rocks. Slowly, all of it gives :math:`G + B K^{-1} B^T`.
"""

import dataclasses
import functools

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.surface import ContactSurface
from asperity.contact.motion.mechanism import Mechanism
from asperity.errors import InputError

# Shift along z and turns about x and y; the other rigid motions are the sliding itself. Modes
# come after all six.
_ON_THE_BED = (2, 3, 4)
_RIGID = 6


@dataclasses.dataclass(frozen=True, eq=False)
class BaseCompliance:
    """What a base gives under friction spread evenly over it, along x and y."""

    at_once: FloatArray  #: (2, 2): :math:`G`, m/N
    levers: FloatArray  #: (2, m): :math:`B`: mean displacement of the base per coordinate
    #: mass, stiffness (m, m): Of the coordinates that the contact's springs or the body's own
    #: stiffness hold: shift along z and turns about x and y where no guide holds them, and modes
    mass: FloatArray
    stiffness: FloatArray

    @functools.cached_property
    def static(self) -> FloatArray:
        """All the base gives where the friction changes slowly, shape (2, 2), m/N."""
        if not self.levers.size:
            return self.at_once
        answer = np.linalg.solve(self.stiffness, self.levers.T)
        return np.asarray(self.at_once + self.levers @ answer)

    @functools.cached_property
    def frequencies(self) -> FloatArray:
        """Natural frequencies on the contact's springs, shape (m,), Hz, ascending."""
        if not self.levers.size:
            return np.empty(0)
        root = np.linalg.inv(np.linalg.cholesky(self.mass))
        squares = np.linalg.eigvalsh(root @ self.stiffness @ root.T)
        return np.asarray(np.sqrt(squares) / (2.0 * np.pi))

    def at(self, frequency: float) -> FloatArray:
        """What the base gives under friction of one frequency in Hz, shape (2, 2), m/N.

        Nothing damps it: at one of `frequencies` it has a pole.
        """
        if not self.levers.size:
            return self.at_once
        omega = 2.0 * np.pi * frequency
        answer = np.linalg.solve(self.stiffness - omega**2 * self.mass, self.levers.T)
        return np.asarray(self.at_once + self.levers @ answer)


def base_compliance(
    mechanism: Mechanism, surface: ContactSurface, normal: NormalLaw, mean_pressure: float
) -> BaseCompliance:
    """Return what the base of a free body gives under friction, all of it touching a level plane.

    Its six rigid motions stand first among the body's coordinates. The law's slope is taken at a
    mean pressure in Pa; hard contact does not give at all.

    Raises
    ------
    InputError
        The body has no rigid motions, or nothing presses it.
    """
    if mechanism.size < _RIGID:
        raise InputError(
            f"the body has {mechanism.size} coordinates; the base of a free body is asked for, "
            "which has six rigid motions and perhaps modes"
        )
    if not mean_pressure > 0.0:
        raise InputError(f"mean_pressure is {mean_pressure:g} Pa; it must be positive")
    count = len(surface.nodes)
    kept = [i for i in (*_ON_THE_BED, *range(_RIGID, mechanism.size)) if not mechanism.held[i]]
    shapes = mechanism.shapes[:, kept]
    spread = np.zeros((3 * count, 2))
    for axis in range(2):
        spread[axis::3, axis] = surface.nodal_area / surface.area
    flexibility = mechanism.flexibility
    bed = flexibility[2::3, 2::3].copy()
    if normal.name != "hard":
        # The nodal springs of the integrated contact, neighbours coupled as its pressures are.
        springs = normal.slope_at(mean_pressure) * surface.to_forces(
            surface.to_points(np.eye(count))
        )
        bed += np.linalg.inv(springs)
    bent, upright = flexibility[2::3] @ spread, shapes[2::3]
    answer = np.linalg.solve(bed, np.hstack([upright, bent]))
    by_motion, by_friction = answer[:, : len(kept)], answer[:, len(kept) :]
    chosen = np.ix_(kept, kept)
    return BaseCompliance(
        at_once=spread.T @ flexibility @ spread - bent.T @ by_friction,
        levers=spread.T @ shapes - bent.T @ by_motion,
        mass=mechanism.mass[chosen],
        stiffness=mechanism.stiffness[chosen] + upright.T @ by_motion,
    )
