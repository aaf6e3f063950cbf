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

from asperity.arrays import FloatArray
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.mechanism import DriveState, Mechanism
from asperity.contact.motion.sums import Sums
from asperity.contact.motion.system import System, SystemState
from asperity.contact.motion.works import surface_energies
from asperity.results.ledger import PowerLedger
from asperity.results.quantity import quantity


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
