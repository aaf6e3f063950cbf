r"""Whether a body that slides steadily flutters: eigenvalues of its motion on its contact.

Friction follows the pressure and leaves the slip alone, so that the contact of a sliding body is a
bed of springs that push in another direction than they are pressed in. With all of the surface in
contact, sliding along the unit vector :math:`d`, springs of the stiffness :math:`k` feel the
displacement :math:`n` normal to the surface and push along :math:`n - \mu d`; across the slip the
asperities stand as springs :math:`\mu p/s_{max}` that push as they are bent; the drive is one more
spring. With what they feel, :math:`W`, and how they push, :math:`E`, the generalised coordinates of
a condensed body move as

.. math:: M \ddot q + D \dot q + K q = 0, \qquad
    K = K_0 + \Phi^T E\,(k^{-1} + W^T C E)^{-1}\, W^T \Phi .

:math:`K` is not symmetric. Two of its modes may meet in one frequency and feed each other by
friction: mode-coupling flutter (Hoffmann, Fischer, Allgaier & Gaul, Mechanics Research
Communications 29 (2002) 197-205). What nothing damps then grows, on elastic bodies of any mesh
(Adams, Journal of Applied Mechanics 62 (1995) 867-872). Steps of the time integration damp what
they do not resolve, and so they may hide it; :meth:`SlidingMotion.in_steps` says whether they do.

Left out is what friction owes to the speed of the slip: relaxation of the asperities across it
(far slower than flutter as a rule), LuGre's damping, and Stribeck's falling friction.
"""

import dataclasses
import functools

import numpy as np
import numpy.typing as npt
from scipy import sparse
from scipy.linalg import block_diag

from asperity.arrays import FloatArray
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.surface import ContactSurface
from asperity.contact.motion.hht import ALPHA, coefficients
from asperity.contact.motion.mechanism import Mechanism
from asperity.errors import InputError

ComplexArray = npt.NDArray[np.complex128]

# Squares of eigenvalues are known to a few thousand times the rounding of the greatest.
_ROUNDING = 1e4 * float(np.finfo(float).eps)

# Hard contact gives this much less than its penalty would, so that the equations have a solution.
_HARD = 1e-3


@dataclasses.dataclass(frozen=True)
class Growth:
    """A disturbance of steady sliding that grows."""

    rate: float  #: Its amplitude grows by the factor e in 1/rate, 1/s
    frequency: float  #: Hz; 0 where it does not oscillate


@dataclasses.dataclass(frozen=True, eq=False)
class SlidingMotion:
    """Small motions about steady sliding in one direction: M q'' + D q' + K q = 0."""

    direction: tuple[float, float]  #: Unit vector of the body's slip, along x and y
    #: mass, damping, stiffness (m, m): Of the coordinates that are not held; the stiffness is not
    #: symmetric
    mass: FloatArray
    damping: FloatArray
    stiffness: FloatArray

    @functools.cached_property
    def eigenvalues(self) -> ComplexArray:
        """Of motion in time, shape (2 m,), 1/s: real part growth, imaginary part frequency."""
        size = len(self.mass)
        by_place, by_velocity = (
            -np.linalg.solve(self.mass, matrix) for matrix in (self.stiffness, self.damping)
        )
        upper = np.hstack([np.zeros((size, size)), np.eye(size)])
        found = np.linalg.eigvals(np.vstack([upper, np.hstack([by_place, by_velocity])]))
        return np.asarray(found, dtype=complex)

    def in_steps(self, step: float, *, alpha: float = ALPHA, impact: bool = False) -> ComplexArray:
        """Eigenvalues, 1/s, of the motion in steps of `asperity.contact.motion.hht`, in s.

        They are ln(z)/h of the factors z by which motions change in a step, those that vanish at
        once left out.
        """
        beta, gamma = coefficients(alpha, impact=impact)
        size = len(self.mass)
        one, none = np.eye(size), np.zeros((size, size))
        # Place and velocity at the end of a step, but for the acceleration there.
        place = np.hstack([one, step * one, step**2 * (0.5 - beta) * one])
        velocity = np.hstack([none, one, step * (1.0 - gamma) * one])
        before = np.hstack([self.stiffness, self.damping, none])
        ahead = self.stiffness @ place + self.damping @ velocity
        left = self.mass + (1.0 + alpha) * (
            beta * step**2 * self.stiffness + gamma * step * self.damping
        )
        acceleration = np.linalg.solve(left, alpha * before - (1.0 + alpha) * ahead)
        rows = (
            place + beta * step**2 * acceleration,
            velocity + gamma * step * acceleration,
            acceleration,
        )
        factors = np.linalg.eigvals(np.vstack(rows)).astype(complex)
        return np.asarray(np.log(factors[np.abs(factors) > _ROUNDING]) / step)

    def damped(self, more: FloatArray) -> "SlidingMotion":
        """Return the same motion with more damping of each coordinate, N s/m, shape (m,)."""
        return dataclasses.replace(self, damping=self.damping + np.diag(more))

    def growth(self, eigenvalues: ComplexArray | None = None) -> Growth | None:
        """Return what grows fastest; None where nothing does, as far as rounding can tell.

        In time, or in steps where the eigenvalues of `in_steps` are given.
        """
        found = self.eigenvalues if eigenvalues is None else eigenvalues
        sure = found.real * np.abs(found) > _ROUNDING * (np.abs(self.eigenvalues) ** 2).max()
        if not sure.any():
            return None
        worst = found[sure][np.argmax(found[sure].real)]
        return Growth(float(worst.real), abs(float(worst.imag)) / (2.0 * np.pi))


def sliding_motion(
    mechanism: Mechanism,
    surface: ContactSurface,
    normal: NormalLaw,
    friction: PointFriction,
    pressure: float,
    direction: tuple[float, float],
) -> SlidingMotion:
    """Return how a body moves about steady sliding on a level plane, all of its surface touching.

    The direction is that of the body's slip along x and y, of any length but 0; the pressure, in
    Pa, the mean. The drive's dashpot counts as far as the body's own give does not yield to it.

    Raises
    ------
    InputError
        Nothing presses the body, or it does not slide.
    """
    if not pressure > 0.0:
        raise InputError(f"pressure is {pressure:g} Pa; it must be positive")
    way = np.array(direction, dtype=float)
    length = float(np.linalg.norm(way))
    if not length > 0.0:
        raise InputError("the direction of slip has no length; give where the body slides to")
    way /= length
    count = len(surface.nodes)
    # The nodal springs of the integrated contact, neighbours coupled as its pressures are.
    give_of_area = np.linalg.inv(surface.to_forces(surface.to_points(np.eye(count))))
    up, along = np.array([0.0, 0.0, 1.0]), np.array([*way, 0.0])
    across = np.cross(up, along)
    felt, pushed = _at_nodes(count, up), _at_nodes(count, up - friction.mu * along)
    hard = _HARD if normal.name == "hard" else 1.0
    gives = [hard / normal.slope_at(pressure) * give_of_area]
    if friction.mu > 0.0:
        felt, pushed = (
            sparse.hstack([part, _at_nodes(count, across)], format="csr") for part in (felt, pushed)
        )
        gives.append(friction.limit / (friction.mu * pressure) * give_of_area)
    give = block_diag(*gives) + felt.T @ (mechanism.flexibility @ pushed)
    moved, turned = felt.T @ mechanism.shapes, pushed.T @ mechanism.shapes
    drive = mechanism.drive
    if drive is not None:
        port = drive.port
        own = np.array([[1.0 / drive.stiffness + port.own]])
        aside = (felt.T @ port.response)[:, None]
        give = np.block([[give, aside], [(port.response @ pushed)[None], own]])
        moved, turned = (np.vstack([part, port.generalised]) for part in (moved, turned))
    answer = np.linalg.solve(give, moved)
    stiffness = mechanism.stiffness + turned.T @ answer
    damping = np.diag(np.zeros(mechanism.size) if mechanism.damping is None else mechanism.damping)
    if drive is not None and drive.damping > 0.0:
        # The derivative of the stiffness by that of the drive, which its dashpot stands beside.
        back = np.linalg.solve(give.T, turned)[-1]
        damping = damping + drive.damping / drive.stiffness**2 * np.outer(back, answer[-1])
    free = np.ix_(~mechanism.held, ~mechanism.held)
    return SlidingMotion(
        (float(way[0]), float(way[1])), mechanism.mass[free], damping[free], stiffness[free]
    )


def _at_nodes(count: int, vector: FloatArray) -> sparse.csr_array:
    """Return a displacement or force along a vector at each node by itself, shape (3 n, n)."""
    return sparse.kron(sparse.eye_array(count), vector[:, None], format="csr")
