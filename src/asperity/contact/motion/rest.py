"""What a motion starts from: a body at rest under its loads."""

import dataclasses

import numpy as np

from asperity.contact.increment.problem import ContactState, IncrementResult
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.motion.hht import Coordinates
from asperity.contact.motion.mechanism import (
    DriveState,
    Imposed,
    Port,
    approached,
    motion_step,
    settled,
)
from asperity.contact.motion.system import System, SystemState
from asperity.contact.motion.works import resultants
from asperity.errors import ConvergenceError, InputError

_MOST_STATIC = 50
_AT_REST = 1e-9
# Steps of loading are so long that the inertia is this share of the stiffness on the contact, or
# more where a contact is so stiff that digits are lost: each step leaves about as much undone.
_INERTIA_AT_REST, _MOST_INERTIA = 1e-5, 0.1


def rest_under_load(system: System, loads: tuple[Port, ...]) -> SystemState:
    """Bring a body to rest under loads, friction and all; its drive and shaking wait.

    The loads are those that stand after each step, as gravity, then gravity and pressure. At the
    end, time zero, the drive is just taut.

    Raises
    ------
    ConvergenceError
        No equilibrium was found: the loads do not press the body on the surface, or it tips over.
    """
    mechanism = system.mechanism
    long, accuracy = loading(system)
    waiting = dataclasses.replace(mechanism, drive=None, load=None, damping=None)
    first = motion_step(waiting, long, alpha=0.0)
    solver = IncrementSolver(system.increments(first.compliance, long))
    contact = ContactState.rest(solver.problem)
    coordinates = Coordinates.at_rest(mechanism.size)
    still = SurfaceMotion(pose=system.pose)
    loaded, result = Imposed(0.0, 0.0, 1.0), None
    for number, load in enumerate(loads, start=1):
        moving = motion_step(dataclasses.replace(waiting, load=load), long, alpha=0.0)
        for _ in range(_MOST_STATIC):
            start = approached(moving, coordinates, DriveState(), loaded)
            try:
                result = solver.solve(start.free, still, contact)
            except ConvergenceError as error:
                raise ConvergenceError(
                    f"no equilibrium at rest under load {number} of {len(loads)}: {error}",
                    reached={"load": float(number), **error.reached},
                ) from error
            contact = result.state
            coordinates, _ = settled(moving, coordinates, DriveState(), loaded, start, result.force)
            # What the inertia still bears; each step starts anew without a velocity.
            left = float(np.abs(coordinates.force).max())
            coordinates = Coordinates.at_rest(mechanism.size, place=coordinates.place)
            if left <= accuracy * float(np.abs(load.generalised).max()):
                break
        else:
            active = result.active if result else 0
            raise ConvergenceError(
                f"the body does not come to rest under load {number} of {len(loads)} in "
                f"{_MOST_STATIC} steps, {active} of {system.weights.size} points in contact; press "
                "it on its base, keep it from tipping over, or take a softer contact",
                reached={"load": float(number), "active": float(active)},
            )
    if result is None:
        raise InputError("no load presses the body on its base; give gravity or a pressure")
    whole = dataclasses.replace(system, mechanism=dataclasses.replace(mechanism, load=loads[-1]))
    return at_start(whole, result, coordinates)


def loading(system: System) -> tuple[float, float]:
    """Length of a step of loading, s, and the share of a load that rest may leave to the inertia.

    In a step without contact the body would fall by its give over the share of the inertia: so far
    it is known to the digits of the arithmetic, and the overclosure is what the contact leaves of
    it.
    """
    surface, mechanism = system.surface, system.mechanism
    # What contact and body give under a pressure spread evenly over the contact, m/N.
    spread = (-surface.nodal_normals * surface.nodal_area[:, None] / surface.area).ravel()
    modal = mechanism.shapes.T @ spread
    give = float(spread @ (mechanism.flexibility @ spread))
    give += float(modal @ np.linalg.pinv(mechanism.stiffness) @ modal)
    normal = system.normal
    overclosure = 1.0 / (normal.stiffness * surface.area)
    soft = normal.initial if normal.name == "two-stage" else normal.stiffness
    give += 1.0 / (soft * surface.area)
    digits = 4.0 * float(np.finfo(float).eps) * give / overclosure
    inertia = min(max(_INERTIA_AT_REST, digits / _AT_REST), _MOST_INERTIA)
    long = float(np.sqrt(mechanism.mass[0, 0] * give / inertia))
    return long, max(_AT_REST, digits / inertia)


def at_start(system: System, result: IncrementResult, coordinates: Coordinates) -> SystemState:
    """Return the state of a body at time zero, the drive just taut."""
    mechanism = system.mechanism
    way, strain = float(coordinates.place[0]), 0.0
    if mechanism.drive is not None:
        port = mechanism.drive.port
        way, strain = port.moved(coordinates, result.force), float(port.response @ result.force)
    else:
        velocity = coordinates.velocity.copy()
        velocity[0] = system.drive_velocity if mechanism.held[0] else 0.0
        coordinates = coordinates._replace(velocity=velocity)
    forces = resultants(result.points, system.weights)
    drive = DriveState(reach=way, way=way, strain=strain)
    return SystemState(0.0, coordinates, drive, result, forces, 1.0)
