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

import dataclasses

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.errors import InputError

ALPHA = -0.05

# Rows of the array that holds a state of the coordinates.
PLACE = 0
VELOCITY = 1
ACCELERATION = 2
FORCE = 3  # D v + K q - Q: what acts on the coordinates, with the sign of a resistance
IMBALANCE = 4  # -(D v + K q - Q) - M a, which the method leaves at the end of a step
REACTION = 5  # what holds a held coordinate
ROWS = 6

# Places in the vector of a method's numbers.
STEP = 0
BETA = 1
GAMMA = 2
WEIGHT = 3  # alpha
SCALARS = 4


def coefficients(alpha: float = ALPHA, *, impact: bool = False) -> tuple[float, float]:
    r"""Newmark's :math:`\beta` and :math:`\gamma` that belong to :math:`\alpha`.

    Parameters
    ----------
    alpha : float
        Parameter of the method, -1/3 to 0.
    impact : bool
        Whether the body meets contacts that a step does not resolve.

    Raises
    ------
    InputError
        ``alpha`` is not between -1/3 and 0.
    """
    if not -1.0 / 3.0 <= alpha <= 0.0:
        raise InputError(f"alpha is {alpha:g}; it must be between -1/3 and 0")
    return 0.5 / (1.0 + alpha) if impact else 0.25 * (1.0 - alpha) ** 2, 0.5 - alpha


@dataclasses.dataclass(frozen=True, eq=False)
class StepOperator:
    r"""What one length of the step makes of masses and stiffnesses.

    Attributes
    ----------
    mass, stiffness : ndarray, shape (m, m)
        :math:`M` and :math:`K` of the coordinates.
    damping : ndarray, shape (m,)
        Diagonal of :math:`D`, N s/m.
    compliance : ndarray, shape (m, m)
        :math:`S`: coordinate at the end of the step per force there. Rows and columns of held
        coordinates are zero.
    carry : ndarray, shape (m, m)
        What becomes of the place the coordinates would reach by Newmark's formulas without an
        acceleration at the end of the step.
    held : ndarray of bool, shape (m,)
        Coordinates that go on at the velocity they have, whatever the forces.
    scalars : ndarray, shape (4,)
        Step in s, :math:`\beta`, :math:`\gamma`, :math:`\alpha`.
    """

    mass: FloatArray
    stiffness: FloatArray
    damping: FloatArray
    compliance: FloatArray
    carry: FloatArray
    held: npt.NDArray[np.bool_]
    scalars: FloatArray


def step_operator(
    mass: FloatArray,
    stiffness: FloatArray,
    step: float,
    *,
    damping: FloatArray | None = None,
    alpha: float = ALPHA,
    impact: bool = False,
    held: npt.NDArray[np.bool_] | None = None,
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
    scalars = np.array([step, beta, gamma, alpha])
    return StepOperator(mass.copy(), stiffness.copy(), damping, compliance, carry, held, scalars)


@kernel
def predict(state, known, carry, compliance, damping, scalars, place, velocity):
    """Place the coordinates would reach under the known forces alone, and its velocity.

    Parameters
    ----------
    state : ndarray, shape (6, m)
        Committed state.
    known : ndarray, shape (m,)
        Generalised forces at the end of the step that are known beforehand.
    carry, compliance, damping, scalars : ndarray
        Of the `StepOperator`.
    place, velocity : ndarray, shape (m,)
        Filled: :math:`q^*`, and the velocity that goes with it.
    """
    step = scalars[STEP]
    beta = scalars[BETA]
    gamma = scalars[GAMMA]
    share = scalars[WEIGHT] / (1.0 + scalars[WEIGHT])
    size = state.shape[1]
    ahead = np.empty(size)
    push = np.empty(size)
    for i in range(size):
        ahead[i] = (
            state[PLACE, i]
            + step * state[VELOCITY, i]
            + step * step * (0.5 - beta) * state[ACCELERATION, i]
        )
        velocity[i] = state[VELOCITY, i] + step * (1.0 - gamma) * state[ACCELERATION, i]
        push[i] = known[i] + share * state[FORCE, i] - damping[i] * velocity[i]
    for i in range(size):
        total = 0.0
        for j in range(size):
            total += carry[i, j] * ahead[j]
            total += compliance[i, j] * push[j]
        place[i] = total
        velocity[i] += gamma / (beta * step) * (total - ahead[i])


@kernel
def complete(state, trial, place, forces, mass, stiffness, damping, held, scalars):
    r"""Write the state at the end of a step; return the energy the method and the damping take.

    Parameters
    ----------
    state : ndarray, shape (6, m)
        Committed state at the start.
    trial : ndarray, shape (6, m)
        Filled: the state at the end.
    place : ndarray, shape (m,)
        Coordinates at the end.
    forces : ndarray, shape (m,)
        All generalised forces :math:`Q_1` at the end.
    mass, stiffness, damping, held, scalars : ndarray
        Of the `StepOperator`.

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
    step = scalars[STEP]
    beta = scalars[BETA]
    gamma = scalars[GAMMA]
    alpha = scalars[WEIGHT]
    size = state.shape[1]
    for i in range(size):
        trial[PLACE, i] = place[i]
        ahead = (
            state[PLACE, i]
            + step * state[VELOCITY, i]
            + step * step * (0.5 - beta) * state[ACCELERATION, i]
        )
        trial[ACCELERATION, i] = (place[i] - ahead) / (beta * step * step)
        trial[VELOCITY, i] = state[VELOCITY, i] + step * (
            (1.0 - gamma) * state[ACCELERATION, i] + gamma * trial[ACCELERATION, i]
        )
    lost = 0.0
    damped = 0.0
    for i in range(size):
        resistance = damping[i] * trial[VELOCITY, i] - forces[i]
        damped += (
            0.5 * damping[i] * (state[VELOCITY, i] + trial[VELOCITY, i])
            * (place[i] - state[PLACE, i])
        )  # fmt: skip
        inertia = 0.0
        turn = 0.0
        mean = 0.0
        for j in range(size):
            resistance += stiffness[i, j] * place[j]
            change = trial[ACCELERATION, j] - state[ACCELERATION, j]
            inertia += mass[i, j] * trial[ACCELERATION, j]
            turn += mass[i, j] * change
            mean += mass[i, j] * (
                (1.0 - gamma) * state[ACCELERATION, j] + gamma * trial[ACCELERATION, j]
            )
        trial[REACTION, i] = 0.0
        if held[i]:
            trial[REACTION, i] = resistance
            resistance = 0.0
        trial[FORCE, i] = resistance
        trial[IMBALANCE, i] = -resistance - inertia
        bracket = (0.5 - gamma) * turn + 0.5 * (
            alpha * (resistance - state[FORCE, i]) + state[IMBALANCE, i]
        )
        lost += (place[i] - state[PLACE, i]) * bracket
        change = trial[ACCELERATION, i] - state[ACCELERATION, i]
        lost += step * step * (beta - 0.5 * gamma) * change * mean
    return lost, damped


def rest(size: int) -> FloatArray:
    """Return a state at rest, without forces, shape (6, size)."""
    return np.zeros((ROWS, size))
