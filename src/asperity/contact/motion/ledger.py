r"""Where the power goes: works of all forces on a body in contact, step by step.

Works are trapezoidal: the mean of a force at both ends of a step times the way between. In them

.. math:: W_{drive} + W_{vibration} + W_{loads}
    = W_{friction} + W_{damping} + W_{numerical} + W_{transfer} + \Delta E

holds to the accuracy of the increments: kinetic, elastic and spring energy are quadratic forms
whose changes trapezoidal works hit exactly, and what the time integration takes is known by itself
(`asperity.contact.motion.hht.complete`), not as what is missing. So is what the trapezoidal work of
the pressure differs from its work along the way where it is not linear over a step; both are
counted as numerical. Friction is the work of the tractions on the slip of the points of the
surface, deformation included, less the work that goes into the asperities. What goes into
asperities and overclosure is summed over the steps; the energies in :math:`\Delta E` are those of
the states at both ends, so that one that is wrong leaves the balance open.
"""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.compiled import kernel
from asperity.contact.interface.normal import HARD, TWO_STAGE, pressure
from asperity.contact.motion import hht
from asperity.contact.motion import mechanism as mo
from asperity.results.ledger import PowerLedger
from asperity.results.quantity import quantity

# Places in the vector of sums over steps; forces are trapezoidal means times the step in s.
TIME = 0
DRIVE_FORCE = 1
FRICTION_X = 2
FRICTION_Y = 3
NORMAL_FORCE = 4
DRIVE_WORK = 5
VIBRATION_WORK = 6
LOAD_WORK = 7
SLIP_WORK = 8  # of friction on the slip
DAMPING_WORK = 9
METHOD_LOSS = 10
PRESSURE_WORK = 11  # put into the overclosure, trapezoidal
TRANSFER_WORK = 12
UNTRANSFERRED = 13
ITERATIONS = 14
INCREMENTS = 15
MOST_ITERATIONS = 16
MAX_FX = 17
MIN_FX = 18
MAX_FY = 19
MIN_FY = 20
MAX_PRESSURE = 21
BREAKAWAY = 22  # s; negative while it has not come
ASPERITY_WORK = 23  # put into the asperities
OVERCLOSURE_WORK = 24  # put into the overclosure, by the law along the way
SUMS = 25

# Places in the vector that says what a step imposed.
LENGTH = 0  # s
END = 1  # time at its end, s
BASE_X = 2  # displacement of the base, m, as far as it reaches the contact
BASE_Y = 3
WHOLE_Y = 4  # and all of it across
LOAD_BEFORE = 5
LOAD_AFTER = 6
LOST = 7  # by the method, J
TRIES = 8  # iterations
TRANSFER = 9  # share of the body's lateral motion the contact sees
FULL_FRICTION = 10  # N
BASE_Z = 11  # rise of the base, m
BRISTLE = 12  # mu over the deflection at full friction, 1/m
DAMPED = 13  # by the damping of the coordinates, J
IMPOSED = 14

# Places in the vector of forces at the end of a step.
FX = 0  # friction against the slip, N
FY = 1
FN = 2
SX = 3  # deflection of the asperities, mean by pressure, m
SY = 4
LOAD_WAY = 5  # the loads' own displacement times their size, J
FORCES = 6


@kernel
def clear(sums):
    """Empty the sums but for the breakaway, which is a fact of the whole run."""
    sums[:BREAKAWAY] = 0.0
    sums[BREAKAWAY + 1 :] = 0.0
    sums[MAX_FX] = -1e300
    sums[MIN_FX] = 1e300
    sums[MAX_FY] = -1e300
    sums[MIN_FY] = 1e300


@kernel
def resultants(pressure, traction, normal, deflection, weights, out):
    """Friction, normal force and mean deflection of a contact, into places FX to SY."""
    for i in range(SY + 1):
        out[i] = 0.0
    for q in range(weights.size):
        p = pressure[q]
        if p <= 0.0:
            continue
        w = weights[q]
        out[FX] -= w * (traction[q, 0] - p * normal[q, 0])
        out[FY] -= w * (traction[q, 1] - p * normal[q, 1])
        out[FN] += w * p
        out[SX] += w * p * deflection[q, 0]
        out[SY] += w * p * deflection[q, 1]
    if out[FN] > 0.0:
        out[SX] /= out[FN]
        out[SY] /= out[FN]


@kernel
def overclosure_work(begin, end, law):
    """Work per area of a pressure law without memory from one overclosure to another, J/m^2.

    By Simpson's rule between the kinks of the law's pressure, which is exact: it is at most
    quadratic there. The hard law stores nothing, see `potential`.
    """
    if law.code == HARD:
        return 0.0
    work = 0.0
    least = 0.0
    for part in range(3):
        most = np.inf
        if law.code == TWO_STAGE and part < 2:
            most = law.start if part == 0 else law.end
        low = min(max(begin, least), most)
        high = min(max(end, least), most)
        if low != high:
            p0, _ = pressure(low, 0.0, law)
            middle, _ = pressure(0.5 * (low + high), 0.0, law)
            p1, _ = pressure(high, 0.0, law)
            work += (p0 + 4.0 * middle + p1) * (high - low) / 6.0
        if most == np.inf:
            break
        least = most
    return work


@kernel
def account(
    sums, imposed, before, after, drive_before, drive_after, u_before, u_after,
    force_before, force_after,
    pressure_0, traction_0, normal_0, distance_0, deflection_0,
    pressure_1, traction_1, normal_1, distance_1, deflection_1,
    slip_1, slip_2, weights, law, mean_pressure,
):  # fmt: skip
    """Add one step to the sums.

    Parameters
    ----------
    sums : ndarray, shape (25,)
        Changed.
    imposed : ndarray, shape (14,)
        What the step imposed.
    before, after : ndarray, shape (6,)
        Forces at both ends, see `resultants`.
    drive_before, drive_after : ndarray, shape (6,)
        States of the drive.
    u_before, u_after, force_before, force_after : ndarray, shape (3 n,)
        Displacement of the contact nodes and contact forces.
    pressure_0, traction_0, normal_0, distance_0, deflection_0, \
    pressure_1, traction_1, normal_1, distance_1, deflection_1, slip_1, slip_2 : ndarray
        Of the points of the surface at both ends, and the slip between.
    weights : ndarray, shape (q,)
        Area of each.
    law : PressureLaw
        Of `asperity.contact.interface.normal`.
    mean_pressure : ndarray, shape (q,)
        Changed: pressure times time.
    """
    step = imposed[LENGTH]
    sums[TIME] += step
    sums[DRIVE_FORCE] += 0.5 * step * (drive_before[mo.FORCE] + drive_after[mo.FORCE])
    sums[DRIVE_WORK] += (
        0.5
        * (drive_before[mo.FORCE] + drive_after[mo.FORCE])
        * (drive_after[mo.REACH] - drive_before[mo.REACH])
    )
    stretch = (drive_after[mo.REACH] - drive_after[mo.WAY]) - (
        drive_before[mo.REACH] - drive_before[mo.WAY]
    )
    sums[DAMPING_WORK] += 0.5 * (drive_before[mo.PULL] + drive_after[mo.PULL]) * stretch
    sums[LOAD_WORK] += (
        0.5 * (imposed[LOAD_BEFORE] + imposed[LOAD_AFTER]) * (after[LOAD_WAY] - before[LOAD_WAY])
    )
    fx = 0.5 * (before[FX] + after[FX])
    fy = 0.5 * (before[FY] + after[FY])
    sums[FRICTION_X] += step * fx
    sums[FRICTION_Y] += step * fy
    fn = 0.5 * (before[FN] + after[FN])
    sums[NORMAL_FORCE] += step * fn
    sums[VIBRATION_WORK] += fn * imposed[BASE_Z] - fx * imposed[BASE_X] - fy * imposed[BASE_Y]
    sums[UNTRANSFERRED] -= fy * (imposed[WHOLE_Y] - imposed[BASE_Y])
    sums[METHOD_LOSS] += imposed[LOST]
    sums[DAMPING_WORK] += imposed[DAMPED]
    unseen = 1.0 - imposed[TRANSFER]
    if unseen > 0.0:
        for i in range(1, u_after.size, 3):
            sums[TRANSFER_WORK] -= (
                0.5 * unseen * (force_before[i] + force_after[i]) * (u_after[i] - u_before[i])
            )
    most = sums[MAX_PRESSURE]
    for q in range(weights.size):
        p0 = pressure_0[q]
        p1 = pressure_1[q]
        mean_pressure[q] += 0.5 * step * (p0 + p1)
        if p0 <= 0.0 and p1 <= 0.0:
            continue
        w = weights[q]
        most = max(most, p1)
        work = 0.0
        # k s^2 / 2 grows by this, k = mu p / s_max, however far p and s go in the step.
        k0 = imposed[BRISTLE] * max(p0, 0.0)
        k1 = imposed[BRISTLE] * max(p1, 0.0)
        into = 0.0
        for c in range(3):
            s0 = deflection_0[q, c]
            s1 = deflection_1[q, c]
            into += (k0 * s0 + k1 * s1) * (s1 - s0) + (k1 - k0) * s0 * s1
            slip = slip_1[q, c] + slip_2[q, c]
            work -= slip * (
                traction_0[q, c] - p0 * normal_0[q, c] + traction_1[q, c] - p1 * normal_1[q, c]
            )
        sums[SLIP_WORK] += 0.5 * w * work
        sums[ASPERITY_WORK] += 0.5 * w * into
        sums[PRESSURE_WORK] += 0.5 * w * (p0 + p1) * (distance_0[q] - distance_1[q])
        sums[OVERCLOSURE_WORK] += w * overclosure_work(-distance_0[q], -distance_1[q], law)
    sums[MAX_PRESSURE] = most
    sums[MAX_FX] = max(sums[MAX_FX], after[FX])
    sums[MIN_FX] = min(sums[MIN_FX], after[FX])
    sums[MAX_FY] = max(sums[MAX_FY], after[FY])
    sums[MIN_FY] = min(sums[MIN_FY], after[FY])
    sums[ITERATIONS] += imposed[TRIES]
    sums[INCREMENTS] += 1.0
    sums[MOST_ITERATIONS] = max(sums[MOST_ITERATIONS], imposed[TRIES])
    if sums[BREAKAWAY] < 0.0 and drive_after[mo.FORCE] >= imposed[FULL_FRICTION]:
        sums[BREAKAWAY] = imposed[END]


@kernel
def potential(over, law):
    """Energy of the overclosure per area for a pressure law without memory, J/m^2.

    The multipliers of the hard law make it depend on its history: it stores nothing.
    """
    if over <= 0.0 or law.code == HARD:
        return 0.0
    stiffness = law.stiffness
    if law.code != TWO_STAGE:
        return 0.5 * stiffness * over * over
    soft = law.initial
    first = law.start
    last = law.end
    if over <= first:
        return 0.5 * soft * over * over
    rise = (stiffness - soft) / (last - first)
    way = min(over, last) - first
    upto = first + way
    energy = 0.5 * soft * upto * upto + rise * way * way * way / 6.0
    if over > last:
        further = over - last
        pressure = soft * last + 0.5 * rise * way * way
        energy += pressure * further + 0.5 * stiffness * further * further
    return energy


@kernel
def surface_energies(pressure, distance, deflection, weights, law, mu, limit):
    """Energy in the overclosure and in the asperities of a contact, J."""
    over = 0.0
    bristles = 0.0
    for q in range(weights.size):
        over += weights[q] * potential(-distance[q], law)
        if limit > 0.0 and pressure[q] > 0.0:
            size = 0.0
            for c in range(3):
                size += deflection[q, c] * deflection[q, c]
            bristles += 0.5 * weights[q] * mu * pressure[q] / limit * size
    return over, bristles


@dataclasses.dataclass(frozen=True)
class Energies:
    """Energies of a body on its contact at one time, J.

    Attributes
    ----------
    kinetic : float
        Of the generalised coordinates.
    elastic : float
        Of the deformation, modes included.
    spring : float
        In the drive's spring.
    overclosure : float
        In the contact's pressure.
    asperities : float
        In the asperities.
    """

    kinetic: float
    elastic: float
    spring: float
    overclosure: float
    asperities: float

    @property
    def total(self) -> float:
        """All together."""
        return self.kinetic + self.elastic + self.spring + self.overclosure + self.asperities


def body_energies(
    mechanism: mo.Mechanism,
    state: FloatArray,
    drive_state: FloatArray,
    force: FloatArray,
    load: float,
) -> tuple[float, float, float]:
    """Kinetic, elastic and spring energy of a mechanism, J.

    Parameters
    ----------
    mechanism : Mechanism
        The body.
    state, drive_state : ndarray
        Its coordinates and its drive.
    force : ndarray, shape (3 n,)
        Contact forces, N.
    load : float
        Share of the loads.
    """
    place, velocity = state[hht.PLACE], state[hht.VELOCITY]
    kinetic = 0.5 * velocity @ mechanism.mass @ velocity
    elastic = 0.5 * place @ mechanism.stiffness @ place
    elastic += 0.5 * force @ (mechanism.flexibility @ force)
    if mechanism.load is not None:
        # The loads' energy under each other is left out, as is their work on it: both stay.
        elastic += load * (mechanism.load.response @ force)
    spring = 0.0
    if mechanism.drive is not None:
        drive, pull = mechanism.drive, drive_state[mo.FORCE]
        elastic += pull * (drive.port.response @ force) + 0.5 * drive.port.own * pull**2
        spring = 0.5 * drive.stiffness * (drive_state[mo.REACH] - drive_state[mo.WAY]) ** 2
    return float(kinetic), float(elastic), float(spring)


class ContactLedger(PowerLedger):
    """Mean powers over the window, W, with what an implicit motion under loads adds.

    drive + vibration + loads = friction + damping + numerical + transfer + stored.

    Attributes
    ----------
    loads : float
        Of gravity and pressure.
    numerical : float
        Dissipated by the time integration.
    transfer : float
        Friction's work on the share 1 - eta_y of the body's own lateral motion that the contact
        does not see; only where the body is vibrated with eta_y below 1.
    """

    loads: float = quantity("P_g", "W", "power of gravity and pressure", default=0.0)
    numerical: float = quantity("P_n", "W", "power dissipated by the time integration", default=0.0)
    transfer: float = quantity(
        "P_t", "W", "friction on lateral motion the contact does not see",
        default=0.0,
    )  # fmt: skip

    @property
    def residual(self) -> float:
        """What is missing from the balance, over the drive power.

        Where the drive does less than a thousandth of friction's work, over that much.
        """
        missing = self.drive + self.vibration + self.loads
        missing -= self.friction + self.damping + self.numerical + self.transfer + self.stored
        scale = max(abs(self.drive), 1e-3 * abs(self.friction)) or 1.0
        return abs(missing) / scale


def power_ledger(sums: FloatArray, start: Energies, end: Energies) -> ContactLedger:
    """Return the powers of a stretch of time from its sums and the energies at its ends."""
    time = float(sums[TIME])
    numerical = float(sums[METHOD_LOSS] + sums[PRESSURE_WORK] - sums[OVERCLOSURE_WORK])
    return ContactLedger(
        drive=float(sums[DRIVE_WORK]) / time,
        vibration=float(sums[VIBRATION_WORK]) / time,
        friction=float(sums[SLIP_WORK] - sums[ASPERITY_WORK]) / time,
        damping=float(sums[DAMPING_WORK]) / time,
        stored=(end.total - start.total) / time,
        untransferred=float(sums[UNTRANSFERRED]) / time,
        loads=float(sums[LOAD_WORK]) / time,
        numerical=numerical / time,
        transfer=float(sums[TRANSFER_WORK]) / time,
    )
