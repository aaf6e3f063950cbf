r"""Implicit time steps of a few generalised coordinates: the method of Hilber, Hughes and Taylor.

The equations of motion, with the forces :math:`Q` that are not of the body's own,

.. math:: M a_1 + (1+\alpha)\,(D v_1 + K q_1 - Q_1) - \alpha\,(D v_0 + K q_0 - Q_0) = 0 ,

and Newmark's formulas with :math:`\beta = (1-\alpha)^2/4`, :math:`\gamma = 1/2 - \alpha` give, for
a given length of the step, the coordinates at its end as a constant linear function of the forces:

.. math:: q_1 = q^* + S\,Q_1 , \qquad
    S = (1+\alpha)\,[M/(\beta h^2) + (1+\alpha) (\gamma D/(\beta h) + K)]^{-1} .

That is all a contact problem needs to know of the motion. :math:`-1/3 \le \alpha \le 0`; the method
is of second order and damps what a step cannot resolve (Hilber, Hughes & Taylor 1977).

A mass thrown on a contact that a step cannot resolve would leave it too fast, by a factor up to
:math:`1/[(1+\alpha)\beta] - 1`, 2.8 for :math:`\alpha = -0.05`: in the one step in contact the
acceleration makes the place right, and works on in the next. With
:math:`\beta = 1/[2\,(1+\alpha)]` it leaves no faster than it came, and the method remains of second
order; that is for impacts.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import InputError
from asperity.kernels.compiled import kernel

ALPHA = -0.05


class Coordinates(NamedTuple):
    """A state of m generalised coordinates; each an array of shape (m,), SI."""

    #: place, velocity, acceleration: Of each coordinate
    place: FloatArray
    velocity: FloatArray
    acceleration: FloatArray
    force: FloatArray  #: D v + K q - Q: what acts on them, with the sign of a resistance
    imbalance: FloatArray  #: -(D v + K q - Q) - M a, which the method leaves at the end of a step
    reaction: FloatArray  #: What holds a held coordinate

    @classmethod
    def at_rest(cls, size: int, **given: FloatArray) -> Coordinates:
        """Return a state at rest, without forces, but for what is given."""
        return cls(**dict.fromkeys(cls._fields, np.zeros(size)) | given)

    @classmethod
    def workspace(cls, size: int) -> Coordinates:
        """Return room for a state, to be written by a kernel."""
        return cls(*np.empty((len(cls._fields), size)))


def coefficients(alpha: float = ALPHA, *, impact: bool = False) -> tuple[float, float]:
    r"""Newmark's :math:`\beta` and :math:`\gamma` that belong to :math:`\alpha`, -1/3 to 0.

    ``impact``: the body meets contacts that a step does not resolve.
    """
    if not -1.0 / 3.0 <= alpha <= 0.0:
        raise InputError(f"alpha is {alpha:g}; it must be between -1/3 and 0")
    return 0.5 / (1.0 + alpha) if impact else 0.25 * (1.0 - alpha) ** 2, 0.5 - alpha


class StepOperator(NamedTuple):
    r"""What one length of the step makes of masses and stiffnesses."""

    #: mass, stiffness (m, m): :math:`M` and :math:`K` of the coordinates
    mass: FloatArray
    stiffness: FloatArray
    damping: FloatArray  #: (m,): Diagonal of :math:`D`, N s/m
    #: (m, m): :math:`S`: coordinate at the end of the step per force there. Rows and columns of
    #: held coordinates are zero.
    compliance: FloatArray
    #: (m, m): What becomes of the place the coordinates would reach by Newmark's formulas without
    #: an acceleration at the end of the step
    carry: FloatArray
    held: BoolArray  #: (m,): Coordinates that go on at the velocity they have, whatever the forces
    step: float  #: s
    #: beta, gamma, alpha: Of the method
    beta: float
    gamma: float
    alpha: float
    pace: float  #: Velocity at the end of a step per place there, 1/s


ROOM = 2
"""Rows of m numbers that steps work with."""


@kernel
def _ahead(operator, state, i):
    """Place by Newmark's formula without an acceleration at the end of the step."""
    step = operator.step
    acceleration = step * step * (0.5 - operator.beta) * state.acceleration[i]
    return state.place[i] + step * state.velocity[i] + acceleration


@kernel
def predict(operator, state, load, known, work, place, velocity):
    """Write where generalised forces known beforehand lead, :math:`q^*`, and its velocity.

    These are ``load`` times ``known``, (m,); ``work`` are two rows of room.
    """
    share = operator.alpha / (1.0 + operator.alpha)
    size = place.shape[0]
    for i in range(size):
        work[0, i] = _ahead(operator, state, i)
        pace = operator.step * (1.0 - operator.gamma) * state.acceleration[i]
        velocity[i] = state.velocity[i] + pace
        work[1, i] = load * known[i] + share * state.force[i] - operator.damping[i] * velocity[i]
    for i in range(size):
        carried = 0.0
        pushed = 0.0
        for j in range(size):
            carried += operator.carry[i, j] * work[0, j]
            pushed += operator.compliance[i, j] * work[1, j]
        place[i] = carried + pushed
        velocity[i] += operator.pace * (place[i] - work[0, i])


@kernel
def complete(operator, state, forces, end):
    r"""Write the state at the end of a step; return the energy the method and the damping take.

    Parameters
    ----------
    operator : StepOperator
        Of the length of the step.
    state : Coordinates
        Committed, at the start.
    forces : ndarray, shape (m,)
        All generalised forces :math:`Q_1` at the end.
    end : Coordinates
        Has the place at the end; all else of it is written.

    Returns
    -------
    lost : float
        Energy dissipated numerically in the step, J. With :math:`N = Dv + Kq - Q`, the imbalance
        :math:`e_0 = -N_0 - M a_0` the step began with and
        :math:`\bar a = (1-\gamma) a_0 + \gamma a_1`,

        .. math:: \Delta q^T [M (\tfrac12 - \gamma) \Delta a + \tfrac12 (\alpha \Delta N + e_0)]
            + h^2 (\beta - \tfrac{\gamma}{2})\, \Delta a^T M \bar a ,

        which is what trapezoidal works of all forces exceed the change of energy by. It vanishes
        with :math:`\alpha`.
    damped : float
        Trapezoidal work of the damping, J.
    """
    step, beta, gamma = operator.step, operator.beta, operator.gamma
    place, velocity, acceleration = end.place, end.velocity, end.acceleration
    size = place.shape[0]
    for i in range(size):
        acceleration[i] = (place[i] - _ahead(operator, state, i)) / (beta * step * step)
        mean = (1.0 - gamma) * state.acceleration[i] + gamma * acceleration[i]
        velocity[i] = state.velocity[i] + step * mean
    by_change = 0.0
    by_mean = 0.0
    damped = 0.0
    for i in range(size):
        resistance = 0.0
        inertia = 0.0
        changed = 0.0
        pushed = 0.0
        for j in range(size):
            mass, change = operator.mass[i, j], acceleration[j] - state.acceleration[j]
            resistance += operator.stiffness[i, j] * place[j]
            inertia += mass * acceleration[j]
            changed += mass * change
            pushed += mass * ((1.0 - gamma) * state.acceleration[j] + gamma * acceleration[j])
        resistance = operator.damping[i] * velocity[i] + resistance - forces[i]
        end.reaction[i] = resistance if operator.held[i] else 0.0
        end.force[i] = resistance - end.reaction[i]
        end.imbalance[i] = -end.force[i] - inertia
        moved = place[i] - state.place[i]
        uneven = operator.alpha * (end.force[i] - state.force[i]) + state.imbalance[i]
        by_change += moved * ((0.5 - gamma) * changed + 0.5 * uneven)
        by_mean += (acceleration[i] - state.acceleration[i]) * pushed
        damped += operator.damping[i] * (state.velocity[i] + velocity[i]) * moved
    return by_change + step * step * (beta - 0.5 * gamma) * by_mean, 0.5 * damped


def step_operator(
    mass: FloatArray,
    stiffness: FloatArray,
    step: float,
    *,
    damping: FloatArray | None = None,
    alpha: float = ALPHA,
    impact: bool = False,
    held: BoolArray | None = None,
) -> StepOperator:
    """Return the operator of steps of one length.

    Parameters
    ----------
    mass, stiffness : ndarray, shape (m, m)
        Symmetric; the mass positive definite.
    step : float
        Length of the step, s.
    damping : ndarray, shape (m,), optional
        What resists the velocity of each coordinate by itself, N s/m; left out, nothing.
    alpha : float
        The method's parameter, -1/3 to 0; 0: Newmark's average acceleration, without damping.
    impact : bool
        Whether the body meets contacts that a step does not resolve, see `coefficients`.
    held : ndarray of bool, shape (m,), optional
        Coordinates that go on at the velocity they have, whatever the forces: guides, rigid
        drives. No stiffness may couple them with others.

    Raises
    ------
    InputError
        The step is not positive, or alpha out of its range.
    """
    if not step > 0.0:
        raise InputError(f"the time step is {step:g} s; it must be positive")
    beta, gamma = coefficients(alpha, impact=impact)
    size = len(mass)
    held = np.zeros(size, bool) if held is None else np.array(held, bool)
    free = ~held
    inner = np.ix_(free, free)
    damping = np.zeros(size) if damping is None else np.array(damping, float)
    inertia = mass[inner] / (beta * step**2)
    inertia += np.diag((1.0 + alpha) * gamma / (beta * step) * damping[free])
    left = inertia + (1.0 + alpha) * stiffness[inner]
    compliance = np.zeros((size, size))
    compliance[inner] = (1.0 + alpha) * np.linalg.inv(left)
    carry = np.eye(size)
    carry[inner] = np.linalg.solve(left, inertia)
    step, pace = float(step), gamma / (beta * step)
    return StepOperator(
        mass.copy(), stiffness.copy(), damping, compliance, carry, held, step, beta, gamma, alpha,
        pace,
    )  # fmt: skip
