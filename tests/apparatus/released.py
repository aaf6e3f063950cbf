"""A body let go anywhere: above its base, tilted, thrown at it."""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.increment.problem import ContactState
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.rest import at_start, loading
from asperity.contact.motion.system import System, SystemState
from asperity.errors import InputError


def released(system: System, place: FloatArray, velocity: FloatArray) -> SystemState:
    """Let a body go from a place with a velocity: above its base, tilted, thrown at it.

    It is deformed by its loads, and by the contact where there is one, as if it had been held
    there; the asperities stand as this little deformation bends them. The drive is just taut.

    Parameters
    ----------
    system : System
        The body, its loads on.
    place, velocity : ndarray, shape (m,)
        Generalised coordinates, rigid motion first: shift, m, and turn, rad; and their velocities.
        Of held coordinates they are nil.

    Returns
    -------
    SystemState
        At time zero.

    Raises
    ------
    InputError
        Not a finite place and velocity for each coordinate.
    ConvergenceError
        No equilibrium of the contact at this place.
    """
    mechanism = system.mechanism
    start = np.array([place, velocity], dtype=float)
    if start.shape != (2, mechanism.size) or not np.isfinite(start).all():
        raise InputError(
            f"place and velocity have the shape {start.shape[1:]}; give ({mechanism.size},), finite"
        )
    start[:, mechanism.held] = 0.0
    load = mechanism.load
    free = mechanism.shapes @ start[0]
    forces = mechanism.stiffness @ start[0]
    if mechanism.damping is not None:
        forces += mechanism.damping * start[1]
    if load is not None:
        free, forces = free + load.response, forces - load.generalised
    problem = system.increments(mechanism.flexibility, loading(system)[0])
    untouched = dataclasses.replace(ContactState.rest(problem), displacement=free)
    result = IncrementSolver(problem).solve(free, SurfaceMotion(pose=system.pose), untouched)
    forces -= mechanism.shapes.T @ result.force
    moving = ~mechanism.held
    acceleration = np.zeros(mechanism.size)
    acceleration[moving] = np.linalg.solve(mechanism.mass[np.ix_(moving, moving)], -forces[moving])
    coordinates = Coordinates.at_rest(
        mechanism.size,
        place=start[0],
        velocity=start[1],
        acceleration=acceleration,
        force=forces,
        reaction=np.where(mechanism.held, forces, 0.0),
    )
    return at_start(system, result, coordinates)
