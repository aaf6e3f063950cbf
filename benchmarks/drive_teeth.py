"""How fast a worm is marched against elastic teeth, and how fast a loaded gearset is solved.

Run it with ``make bench``. The march's steps are solved again, on the same states and of the same
three teeth, by the increments of `asperity.contact.increment`: Newton's method on the whole of
their flanks. Both find the same forces, which is looked at too. One core; only the ratio means
something on a shared machine.
"""

import dataclasses
import time

import numpy as np
from _common import finish, on_one_core

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.increment.problem import ContactState, IncrementProblem
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import ContactSurface
from asperity.drive.elastic.mesh import advance
from asperity.drive.elastic.model import TeethModel
from asperity.drive.interface import AT, OUTS, POSES
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.reduction import reduction
from asperity.drive.static.solve import solve_static
from asperity.drive.teeth.contact import CONTACT_STIFFNESS
from asperity.drive.teeth.placing import place_worm
from asperity.flanks.wheel.frame import turned
from asperity.friction.dahl import VECTOR
from asperity.runs import Run

CASE = "drive-screw"
STEP = 0.5e-6
WARM, COUNTED, SLOW = 20, 400, 12
# The screw's motion beside the worm's turning, at its frequency and speed.
# Of 24 phases of five teeth, pressures resolved: 40 s are asked for 12.
MOST = {"tooth_step_ms": 0.15, "static_s": 40.0}
LEAST = {"increments_over_march": 15.0}


def motion(problem, count):
    """Poses and rates of the drive: the worm turns and is shaken, the wheel follows."""
    speed, ratio = problem.worm_speed, problem.geometry.gear_ratio
    lead, turn = 1e-3 * problem.geometry.reduced_lead, problem.amplitude / problem.reference_radius
    angle = 2.0 * np.pi * problem.vibrated[1].frequency
    t = STEP * np.arange(count + 1)
    wave, rate = np.sin(angle * t), angle * np.cos(angle * t)
    q = np.zeros((count + 1, POSES))
    v = np.zeros((count + 1, POSES))
    q[:, 0], v[:, 0] = speed * t + turn * wave, speed + turn * rate
    q[:, 1], v[:, 1] = -lead * turn * wave, -lead * turn * rate
    q[:, 2], v[:, 2] = speed / ratio * t, speed / ratio
    return q, v


def marched(model, q, v, mesh):
    """Forces on the wheel along the march, and the time of a step in s."""
    here = model.settled_in(q[0], 1.0)
    trial = here.copy()
    out = np.zeros(OUTS)
    forces = np.zeros((len(q) - 1, POSES))
    spent = 0.0
    for k in range(1, len(q)):
        began = time.thread_time()
        advance(mesh, here, trial, q[k], v[k], STEP, out)
        if k > WARM:
            spent += time.thread_time() - began
        forces[k - 1] = out[:POSES]
        here, trial = trial, here
    return forces, spent / (len(q) - 1 - WARM), float(out[AT.residual])


def three_teeth(model, mesh, numbers):
    """The teeth in mesh as one body of `asperity.contact.increment`, in the wheel's frame."""
    sector = model.sector
    surface, size = sector.surface, len(sector.surface.positions)
    flexibility = np.zeros((9 * size, 9 * size))
    positions, normals, faces, points = [], [], [], []
    for k, number in enumerate(numbers):
        turn = turned(-number * sector.pitch)
        block = sector.body.flexibility.reshape(size, 3, size, 3)
        own = np.einsum("ac,mcnd,bd->manb", turn, block, turn, optimize=True)
        part = slice(3 * size * k, 3 * size * (k + 1))
        flexibility[part, part] = own.reshape(3 * size, 3 * size)
        for other, there in enumerate(numbers[:k]):
            beside = sector.neighbours[number - there - 1].reshape(size, 3, size, 3)
            back = turned(-there * sector.pitch)
            block = np.einsum("ac,mcnd,bd->manb", turn, beside, back, optimize=True)
            column = slice(3 * size * other, 3 * size * (other + 1))
            flexibility[part, column] = block.reshape(3 * size, 3 * size)
            flexibility[column, part] = flexibility[part, column].T
        positions.append(surface.positions @ turn.T)
        normals.append(surface.normals @ turn.T)
        faces.append(surface.faces + size * k)
        points.append(sector.body.places @ turn.T)
    whole = ContactSurface(
        nodes=np.arange(3 * size),
        positions=np.concatenate(positions),
        faces=np.concatenate(faces),
        shapes=surface.shapes,
        weights=np.concatenate([surface.weights] * 3),
        normals=np.concatenate(normals),
    )
    # The march looks for contact on the exact flank.
    whole.__dict__["points"] = np.concatenate(points).reshape(*whole.weights.shape, 3)
    friction = mesh.laws.interface.friction
    return IncrementProblem(
        flexibility,
        whole,
        RigidSurface.worm(sector.wheel.pair.worm, side=1),
        NormalLaw("linear", CONTACT_STIFFNESS),
        PointFriction(
            DAHL, friction.mu, friction.limit, VECTOR, friction.exponent,
            reference=friction.reference,
        ),
        tolerance=mesh.laws.tolerance,
    )  # fmt: skip


def pose_of(mesh, q):
    """Where the worm stands to the wheel."""
    rotation, translation = np.empty((3, 3)), np.empty(3)
    place_worm(
        mesh.stand, q[0], np.array([0.0, 0.0, -q[1]]), q[2] + mesh.ahead, q[3], 1, rotation,
        translation,
    )  # fmt: skip
    return Pose(rotation, translation)


def incremented(model, mesh, q, numbers):
    """Forces on the wheel by increments, and the time of one in s."""
    problem = three_teeth(model, mesh, numbers)
    solver = IncrementSolver(problem)
    state = ContactState.rest(problem)
    free = np.zeros(len(problem.flexibility))
    forces, spent, counted = [], 0.0, 0
    slide = 1e-3
    start = q[0] - np.array([slide, 0.0, slide / mesh.stand.ratio, 0.0, 0.0])
    before = pose_of(mesh, start)
    for k in (0, 0, *range(1, len(q))):
        after = pose_of(mesh, q[k])
        if k == 0:
            before = pose_of(mesh, start)
        motion = SurfaceMotion(after, base_1=Drift.between(before, after))
        began = time.thread_time()
        found = solver.solve(free, motion, state)
        if k > WARM // 4:
            spent += time.thread_time() - began
            counted += 1
        state, before = found.state, after
        angle = q[k][2] + mesh.ahead
        if k:
            force = found.force.reshape(-1, 3).sum(axis=0)
            forces.append(turned(-angle) @ force)
    return np.array(forces), spent / counted


def main():
    on_one_core()
    problem = DriveProblem.from_case(read_case(CASE, case_tables(), ()))
    run = Run()
    problem = dataclasses.replace(
        problem, drive=problem.drive.model_copy(update={"flanks": "driving"})
    )
    model = TeethModel.of(problem, reduction(problem, run), run)
    mesh = model.teeth
    still = dataclasses.replace(problem, vibration=None, shape=None)
    solve_static(still, run)
    began = time.process_time()
    solve_static(still, run)
    static = time.process_time() - began

    q, v = motion(problem, WARM + COUNTED)
    q[:, 2] -= model.sweeps[0].deflection[0]
    forces, step, residual = marched(model, q, v, mesh)
    touched = [k for k in range(mesh.teeth) if mesh.candidates.counts[k, 0]]
    numbers = sorted(int(mesh.gathered["tooth"][k]) for k in touched)[:3]
    slow, increment = incremented(model, mesh, q[: WARM // 4 + 1 + SLOW], numbers)
    off = np.abs(slow[:, 2] + forces[: len(slow), 3]).max() / np.abs(forces[:, 3]).max()
    report = {
        "march": {
            "teeth": len(numbers),
            "step_ms": 1e3 * step,
            "tooth_step_ms": 1e3 * step / len(numbers),
            "residual": residual,
        },
        "increments": {"increment_ms": 1e3 * increment, "force_off": off},
        "both": {"increments_over_march": increment / step},
        "static": {"static_s": static},
    }
    finish(report, most=MOST, least=LEAST)


if __name__ == "__main__":
    main()
