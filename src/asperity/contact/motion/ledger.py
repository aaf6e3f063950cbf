r"""Where the power goes: works of all forces on a body in contact, step by step.

Works are trapezoidal: the mean of a force at both ends of a step times the way between. In them

.. math:: W_{drive} + W_{vibration} + W_{loads}
    = W_{friction} + W_{damping} + W_{numerical} + W_{transfer} + \Delta E

holds to the accuracy of the increments: kinetic, elastic and spring energy are quadratic forms
whose changes trapezoidal works hit exactly, and what the time integration takes is known by itself
(`asperity.contact.motion.hht.StepOperator.complete`), not as what is missing. So is what the
trapezoidal work of the pressure differs from its work along the way where it is not linear over a
step; both are counted as numerical. Friction is the work of the tractions on the slip of the points
of the surface, deformation included, less the work that goes into the asperities. What goes into
asperities and overclosure is summed over the steps; the energies in :math:`\Delta E` are those of
the states at both ends, so that one that is wrong leaves the balance open.
"""

from __future__ import annotations

import dataclasses
import operator
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.mechanism import DriveState, Mechanism
from asperity.contact.motion.system import BaseMotion, System, SystemState
from asperity.contact.motion.works import surface_energies, works
from asperity.results.ledger import PowerLedger
from asperity.results.quantity import quantity


class Sums(NamedTuple):
    """Sums over steps, and what was least and greatest at their ends.

    Forces are trapezoidal means times the step, N s; works in J, friction in N, pressure in Pa.
    """

    time: float = 0.0
    drive_force: float = 0.0
    friction_x: float = 0.0
    friction_y: float = 0.0
    normal_force: float = 0.0
    drive_work: float = 0.0
    vibration_work: float = 0.0
    load_work: float = 0.0
    slip_work: float = 0.0
    damping_work: float = 0.0
    method_loss: float = 0.0
    pressure_work: float = 0.0
    overclosure_work: float = 0.0
    asperity_work: float = 0.0
    friction_gain: float = 0.0
    transfer_work: float = 0.0
    untransferred: float = 0.0
    iterations: float = 0.0
    increments: float = 0.0
    iterations_max: float = 0.0
    friction_x_max: float = -np.inf
    friction_y_max: float = -np.inf
    friction_x_min: float = np.inf
    friction_y_min: float = np.inf
    pressure_max: float = 0.0

    def with_(self, other: Sums) -> Sums:
        """Return the sums over the steps of both."""
        pairs = zip(_TOGETHER, self, other, strict=True)
        return Sums(*[together(one, another) for together, one, another in pairs])


_ENDINGS = {"max": max, "min": min}
_TOGETHER = tuple(_ENDINGS.get(name[-3:], operator.add) for name in Sums._fields)


def over_step(
    system: System,
    before: SystemState,
    after: SystemState,
    base: BaseMotion,
    taken: tuple[float, float],
) -> Sums:
    """Return what one step adds to the sums.

    ``base`` moved in between; ``taken`` is what the method and the damping of the coordinates took,
    J.
    """
    one, other = before.contact, after.contact
    slip = other.slip_1 + other.slip_2
    of_points = works(
        one.pressure, one.traction, one.normal, one.distance, one.state.deflection,
        other.pressure, other.traction, other.normal, other.distance, other.state.deflection,
        slip, system.weights, system.normal.numbers, system.asperities,
    )  # fmt: skip
    first, last, start, end = before.forces, after.forces, before.drive, after.drive
    step = after.time - before.time
    fx = 0.5 * (first.friction_x + last.friction_x)
    fy = 0.5 * (first.friction_y + last.friction_y)
    normal, pull = 0.5 * (first.normal + last.normal), 0.5 * (start.force + end.force)
    lost, damped = taken
    load, transfer = system.mechanism.load, 0.0
    fallen = 0.0
    if load is not None:
        moved = after.coordinates.place - before.coordinates.place
        fallen = float(load.generalised @ moved + load.response @ (other.force - one.force))
    if system.unseen > 0.0:
        across = (one.force + other.force)[1::3] @ (other.displacement - one.displacement)[1::3]
        transfer = -0.5 * system.unseen * float(across)
    dashpot = 0.5 * (start.pull + end.pull) * (end.stretch - start.stretch)
    return Sums(
        time=step,
        drive_force=step * pull,
        friction_x=step * fx,
        friction_y=step * fy,
        normal_force=step * normal,
        drive_work=pull * (end.reach - start.reach),
        vibration_work=normal * base.z - fx * base.x - fy * base.y,
        load_work=0.5 * (before.load + after.load) * fallen,
        slip_work=of_points.slip,
        damping_work=dashpot + damped,
        method_loss=lost,
        pressure_work=of_points.pressure,
        overclosure_work=of_points.overclosure,
        asperity_work=of_points.asperities,
        friction_gain=of_points.gained,
        transfer_work=transfer,
        untransferred=-fy * (base.whole_y - base.y),
        iterations=other.iterations,
        increments=1,
        iterations_max=other.iterations,
        friction_x_max=last.friction_x,
        friction_y_max=last.friction_y,
        friction_x_min=last.friction_x,
        friction_y_min=last.friction_y,
        pressure_max=of_points.greatest,
    )


@dataclasses.dataclass(frozen=True)
class Energies:
    """Energies of a body on its contact at one time, J."""

    kinetic: float  #: Of the generalised coordinates
    elastic: float  #: Of the deformation, modes included
    spring: float  #: In the drive's spring
    overclosure: float = 0.0  #: In the contact's pressure
    asperities: float = 0.0  #: In the asperities

    @property
    def total(self) -> float:
        """All together."""
        return self.kinetic + self.elastic + self.spring + self.overclosure + self.asperities


def body_energies(
    mechanism: Mechanism, state: Coordinates, drive: DriveState, force: FloatArray, load: float
) -> Energies:
    """Return the energies of a body without its contact, by contact forces and share of loads."""
    place, velocity = state.place, state.velocity
    kinetic = 0.5 * velocity @ mechanism.mass @ velocity
    elastic = 0.5 * place @ mechanism.stiffness @ place
    elastic += 0.5 * force @ (mechanism.flexibility @ force)
    if mechanism.load is not None:
        # The loads' energy under each other is left out, as is their work on it: both stay.
        elastic += load * (mechanism.load.response @ force)
    spring = 0.0
    if mechanism.drive is not None:
        port = mechanism.drive.port
        elastic += drive.force * (port.response @ force) + 0.5 * port.own * drive.force**2
        spring = 0.5 * mechanism.drive.stiffness * drive.stretch**2
    return Energies(float(kinetic), float(elastic), float(spring))


def energies(system: System, state: SystemState) -> Energies:
    """Return the energies of body and contact."""
    contact = state.contact
    over, asperities = surface_energies(
        contact.pressure, contact.distance, contact.state.deflection, system.weights,
        system.normal.numbers, system.asperities,
    )  # fmt: skip
    body = body_energies(
        system.mechanism, state.coordinates, state.drive, contact.force, state.load
    )
    return dataclasses.replace(body, overclosure=float(over), asperities=float(asperities))


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


def power_ledger(sums: Sums, start: Energies, end: Energies) -> ContactLedger:
    """Return the powers of a stretch of time from its sums and the energies at its ends."""
    time = sums.time
    return ContactLedger(
        drive=sums.drive_work / time,
        vibration=sums.vibration_work / time,
        friction=(sums.slip_work - sums.asperity_work) / time,
        damping=sums.damping_work / time,
        stored=(end.total - start.total) / time,
        untransferred=sums.untransferred / time,
        loads=sums.load_work / time,
        numerical=(sums.method_loss + sums.pressure_work - sums.overclosure_work) / time,
        transfer=sums.transfer_work / time,
    )
