"""Pressures of a balance: resolved ones, those at the nodes of the mesh, those of Hertzian lines.

Contact lines are narrower than the elements of any mesh of a whole tooth, so that pressures at its
nodes grow as it is refined; resolved ones do not.
"""

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.resolved.pressures import Resolved
from asperity.drive.static.equilibrium import Balance
from asperity.drive.teeth.contact import TeethContact
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.meshing.analysis import hertz_pressure_max
from asperity.flanks.meshing.lubrication import NormalLoading
from asperity.flanks.wheel.enveloped import Wheel
from asperity.gearset.materials import Material
from asperity.rating.iso14521.hertz import contact_modulus


def modulus_of(wheel: Material, worm: Material) -> float:
    """Return the contact modulus E* of two bodies, Pa."""
    found = contact_modulus(
        1e-6 * worm.youngs_modulus, worm.poisson_ratio,
        1e-6 * wheel.youngs_modulus, wheel.poisson_ratio,
    )  # fmt: skip
    return 1e6 * float(found)


def resolved(owner: ResolvedContact, balance: Balance, *, finer: bool = True) -> Resolved:
    """Return the resolved pressures of a balance; its contact must still hold its fields."""
    beta = balance.worm_angle + float(balance.yielded[0])
    return owner.resolve(balance.contact, beta, balance.wheel_angle, balance.shift, finer=finer)


def nodal_pressure(contact: TeethContact, k: int) -> FloatArray:
    """Return the pressure at the nodes of a tooth, the k-th of those in mesh, (n,), Pa."""
    surface = contact.sector.surface
    found = np.zeros(contact.sector.body.weights.shape)
    count = int(contact.candidates.counts[k, 0])
    points = (4 * contact.candidates.face[k, :count, None] + np.arange(4)).ravel()
    found[points] = contact.answer.pressure[k, : 4 * count]
    return surface.to_nodes(found.reshape(surface.weights.shape))


def hertz_pressure(problem: DriveProblem, wheel: Wheel) -> float | None:
    """Return the greatest Hertzian pressure of rigid flanks' contact lines, MPa.

    It is the number of ``asperity flank``, found as there; None where no line bears the load.
    """
    try:
        return hertz_pressure_max(
            wheel.pair, wheel, NormalLoading.by(problem.gearset, problem.operation)
        )
    except (InputError, ConvergenceError):
        return None
