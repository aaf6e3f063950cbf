r"""Motion of a condensed body: what its contact nodes do in an implicit step, as :math:`u^* + A f`.

The displacement of the body is a few generalised coordinates :math:`q` (rigid motion, and modes
where there are any) and the deformation that forces cause at once:

.. math:: u = \Phi q + C_r f + c_d F_d + \sum_l c_l \lambda_l ,

with the flexibility :math:`C_r` of the contact nodes less what the modes carry, the drive's force
:math:`F_d` and given loads :math:`\lambda_l`. For a free body :math:`C_r` is that of a body that
accelerates as a whole under its forces (inertia relief): its deformation has no share in the rigid
coordinates, so that energies of motion and of deformation simply add up. One step of
`asperity.contact.motion.hht` gives :math:`q = q^* + S\,Q`; the drive is linear in the place and
velocity of the point it holds. Eliminating both leaves, at the contact nodes alone,

.. math:: u = u^* + A f, \qquad A = C_r + \Phi S \Phi^T - l\, r^T ,

where :math:`l` is what a unit drive force does to the contact nodes within the step, and
:math:`r^T f` what contact forces take off the drive force. `A` is constant for a length of the step
and symmetric without a dashpot.
"""

import dataclasses

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.contact.motion import hht
from asperity.errors import InputError

# Places in the vector of the drive's numbers.
SPRING = 0
DASHPOT = 1
GAIN = 2  # gamma / (beta h): velocity at the end of a step per place there
YIELD = 3  # what the drive's own give divides its force by
ONWARD = 4  # place of the drive's point per its force within a step, through the coordinates
SELF = 5  # the same through deformation
DRIVE_SCALARS = 6

# Places in the vector that says where the drive is.
REACH = 0  # place of the drive's far end, m
SPEED = 1  # and its velocity, m/s
FORCE = 2  # drive force, N
STRAIN = 3  # what deformation adds to the place of the drive's point, m
PULL = 4  # part of the drive force that comes from the dashpot, N
WAY = 5  # place of the drive's point, m
DRIVE_STATE = 6


@dataclasses.dataclass(frozen=True, eq=False)
class Port:
    """A way in for a force that is not contact: what it moves, per newton.

    Attributes
    ----------
    generalised : ndarray, shape (m,)
        Force on each generalised coordinate; also how far the port goes per coordinate.
    response : ndarray, shape (3 n,)
        Deformation at the contact nodes, m/N; also how far contact forces move the port.
    own : float
        Deformation at the port itself, m/N.
    """

    generalised: FloatArray
    response: FloatArray
    own: float = 0.0


@dataclasses.dataclass(frozen=True, eq=False)
class Drive:
    """A spring and a dashpot side by side between the body and a point that moves.

    Attributes
    ----------
    port : Port
        Where it holds the body, and in which direction.
    stiffness : float
        k_d, N/m.
    damping : float
        h_d, N s/m.
    """

    port: Port
    stiffness: float
    damping: float = 0.0


@dataclasses.dataclass(frozen=True, eq=False)
class Mechanism:
    """A condensed body with what holds and loads it.

    Attributes
    ----------
    flexibility : ndarray, shape (3 n, 3 n)
        Deformation of the contact nodes by contact forces less what the modes carry, m/N.
    shapes : ndarray, shape (3 n, m)
        Displacement of the contact nodes per generalised coordinate.
    mass, stiffness : ndarray, shape (m, m)
        Of the coordinates.
    held : ndarray of bool, shape (m,)
        Coordinates that are guided or driven at a constant velocity.
    damping : ndarray, shape (m,), or None
        What resists the velocity of each coordinate by itself, N s/m; None: nothing.
    drive : Drive or None
        None: nothing pulls but a held coordinate.
    load : Port or None
        All given loads together at their full size: forces in N, responses in m.
    """

    flexibility: FloatArray
    shapes: FloatArray
    mass: FloatArray
    stiffness: FloatArray
    held: npt.NDArray[np.bool_]
    drive: Drive | None = None
    load: Port | None = None
    damping: FloatArray | None = None

    @property
    def size(self) -> int:
        """Number of generalised coordinates."""
        return len(self.mass)


@dataclasses.dataclass(frozen=True, eq=False)
class MotionStep:
    """A mechanism's motion over one length of the step, made ready for the kernels.

    Attributes
    ----------
    operator : StepOperator
        Of the generalised coordinates.
    compliance : ndarray, shape (3 n, 3 n)
        `A`, m/N.
    shapes : ndarray, shape (3 n, m)
        Displacement of the contact nodes per generalised coordinate.
    lift : ndarray, shape (3 n,)
        Displacement of the contact nodes by a unit drive force within the step, m/N.
    drop : ndarray, shape (3 n,)
        What contact forces take off the drive force.
    drive : ndarray, shape (6,)
        The drive's numbers.
    drive_shape, drive_response, load_force, load_response : ndarray
        Of the ports; zeros where there is none.
    """

    operator: hht.StepOperator
    compliance: FloatArray
    shapes: FloatArray
    lift: FloatArray
    drop: FloatArray
    drive: FloatArray
    drive_shape: FloatArray
    drive_response: FloatArray
    load_force: FloatArray
    load_response: FloatArray


def motion_step(
    mechanism: Mechanism, step: float, *, alpha: float = hht.ALPHA, impact: bool = False
) -> MotionStep:
    """Return what a mechanism does in steps of one length.

    Parameters
    ----------
    mechanism : Mechanism
        The body.
    step : float
        Length of the step, s.
    alpha : float
        Parameter of the method, -1/3 to 0.
    impact : bool
        Whether the body meets contacts that a step does not resolve.

    Raises
    ------
    InputError
        The step is not positive, or the body is neither free to move nor held anywhere.
    """
    shapes = mechanism.shapes
    count = shapes.shape[0]
    operator = hht.step_operator(
        mechanism.mass,
        mechanism.stiffness,
        step,
        damping=mechanism.damping,
        alpha=alpha,
        impact=impact,
        held=mechanism.held,
    )
    compliance = mechanism.flexibility + shapes @ operator.compliance @ shapes.T
    none = np.zeros(count), np.zeros(mechanism.size)
    lift, drop = np.zeros(count), np.zeros(count)
    drive_response, drive_shape = none
    numbers = np.zeros(DRIVE_SCALARS)
    numbers[YIELD] = 1.0
    beta, gamma = hht.coefficients(alpha, impact=impact)
    numbers[GAIN] = gamma / (beta * step)
    if mechanism.drive is not None:
        drive = mechanism.drive
        if not (drive.stiffness > 0.0 and drive.damping >= 0.0):
            raise InputError(
                f"the drive has a stiffness of {drive.stiffness:g} N/m and a damping of "
                f"{drive.damping:g} N s/m; the first must be positive, the second not negative"
            )
        drive_response, drive_shape = drive.port.response, drive.port.generalised
        # The dashpot knows the coordinates' velocity by the method's own formula, and that of the
        # deformation, which has no velocity of its own, as a difference.
        onward = drive.stiffness + drive.damping * numbers[GAIN]
        inward = drive.stiffness + drive.damping / step
        numbers[SPRING], numbers[DASHPOT] = drive.stiffness, drive.damping
        numbers[ONWARD] = drive_shape @ operator.compliance @ drive_shape
        numbers[SELF] = drive.port.own
        numbers[YIELD] = 1.0 + onward * numbers[ONWARD] + inward * numbers[SELF]
        through = shapes @ (operator.compliance @ drive_shape)
        lift = through + drive_response
        drop = (onward * through + inward * drive_response) / numbers[YIELD]
        compliance -= np.outer(lift, drop)
    load = mechanism.load
    return MotionStep(
        operator,
        np.ascontiguousarray(compliance),
        np.ascontiguousarray(shapes),
        lift,
        drop,
        numbers,
        np.ascontiguousarray(drive_shape),
        np.ascontiguousarray(drive_response),
        none[1] if load is None else np.ascontiguousarray(load.generalised),
        none[0] if load is None else np.ascontiguousarray(load.response),
    )


@kernel
def approach(
    state, drive_state, far, speed, load, carry, compliance, damping, scalars, shapes, lift, drive,
    drive_shape, load_force, load_response, place, velocity, known, free,
):  # fmt: skip
    """Place the contact nodes would go in a step without contact forces.

    Parameters
    ----------
    state : ndarray, shape (6, m)
        Committed coordinates.
    drive_state : ndarray, shape (6,)
        Committed state of the drive.
    far, speed : float
        Place, m, and velocity, m/s, of the drive's far end at the end of the step.
    load : float
        Share of the loads at the end of the step.
    carry, compliance, damping, scalars, shapes, lift, drive, drive_shape, load_force, \
    load_response : ndarray
        Of the `MotionStep` and its operator.
    place, velocity, known : ndarray, shape (m,)
        Filled: coordinates and velocities without contact and drive forces; room.
    free : ndarray, shape (3 n,)
        Filled: :math:`u^*`, m.

    Returns
    -------
    float
        The drive force without contact forces, N.
    """
    size = state.shape[1]
    for i in range(size):
        known[i] = load * load_force[i]
    hht.predict(state, known, carry, compliance, damping, scalars, place, velocity)
    force = 0.0
    if drive[SPRING] > 0.0:
        way = 0.0
        pace = 0.0
        for i in range(size):
            way += drive_shape[i] * place[i]
            pace += drive_shape[i] * velocity[i]
        force = drive[SPRING] * (far - way) + drive[DASHPOT] * (
            speed - pace + drive_state[STRAIN] / scalars[hht.STEP]
        )
        force /= drive[YIELD]
    count = free.size
    for i in range(count):
        total = load * load_response[i] + force * lift[i]
        for j in range(size):
            total += shapes[i, j] * place[j]
        free[i] = total
    return force


@kernel
def settle(
    state, trial, drive_state, drive_trial, far, speed, load, free_force, forces, place, velocity,
    resultant, mass, stiffness, damping, held, compliance, scalars, shapes, drop, drive,
    drive_shape, drive_response, load_force,
):  # fmt: skip
    """Write the state at the end of a step, the contact forces being known.

    Parameters
    ----------
    state, drive_state : ndarray
        Committed states.
    trial, drive_trial : ndarray
        Filled: states at the end of the step.
    far, speed, load : float
        As in `approach`.
    free_force : float
        What `approach` returned.
    forces : ndarray, shape (3 n,)
        Contact forces on the body, N.
    place, velocity : ndarray, shape (m,)
        As filled by `approach`; changed.
    resultant : ndarray, shape (m,)
        Filled: contact forces on each coordinate.
    mass, stiffness, damping, held, compliance, scalars, shapes, drop, drive, drive_shape, \
    drive_response, load_force : ndarray
        Of the `MotionStep` and its operator.

    Returns
    -------
    tuple of 2 floats
        Energy dissipated by the method, and by the coordinates' damping, J.
    """
    size = state.shape[1]
    count = forces.size
    drive_force = free_force
    strain = 0.0
    for j in range(size):
        resultant[j] = 0.0
    for i in range(count):
        force = forces[i]
        drive_force -= drop[i] * force
        strain += drive_response[i] * force
        for j in range(size):
            resultant[j] += shapes[i, j] * force
    for i in range(size):
        change = 0.0
        for j in range(size):
            change += compliance[i, j] * (resultant[j] + drive_force * drive_shape[j])
        place[i] += change
        velocity[i] += drive[GAIN] * change
    # What the velocity is needed for comes first: its room takes all forces on the coordinates.
    way = 0.0
    pace = 0.0
    for i in range(size):
        way += drive_shape[i] * place[i]
        pace += drive_shape[i] * velocity[i]
        velocity[i] = resultant[i] + drive_force * drive_shape[i] + load * load_force[i]
    taken = hht.complete(state, trial, place, velocity, mass, stiffness, damping, held, scalars)
    strain += drive[SELF] * drive_force
    drive_trial[REACH] = far
    drive_trial[SPEED] = speed
    drive_trial[FORCE] = drive_force
    drive_trial[STRAIN] = strain
    drive_trial[WAY] = way + strain
    drive_trial[PULL] = drive[DASHPOT] * (
        speed - pace - (strain - drive_state[STRAIN]) / scalars[hht.STEP]
    )
    return taken
