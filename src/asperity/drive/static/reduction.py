"""What the elastic teeth are in a reduced model: d(T), effective radius, compliance along them."""

from __future__ import annotations

import contextlib
import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.problem import DriveProblem
from asperity.drive.static.equilibrium import Balance
from asperity.drive.static.recorder import contact_means
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.sweep import LoadCase
from asperity.drive.teeth.contact import TeethContact
from asperity.drive.teeth.mode import lowest_mode
from asperity.errors import InputError
from asperity.runs import Run

SHARES = (1.0 / 16.0, 1.0 / 4.0, 1.0, 2.5)
"""Torques that the table has, over the load, which is the last but one."""

_PHASES = 8
_TELLING = 0.05  # coefficient of friction from which on torques tell their radius, to 10 um


@dataclasses.dataclass(frozen=True, eq=False)
class TeethReduced:
    """Elastic teeth in numbers, means over a pitch."""

    torque: FloatArray  #: (n,): Of the wheel, N m
    #: (n,): Angles that it is turned by, the worm and its shaft rigid, rad
    deflection: FloatArray
    radius: float  #: Effective radius on the worm: the closed form's with the same torque, m
    compliance: float  #: Of the teeth along the flank, m/N
    normal_force: float  #: Under the load, N
    mode: float  #: Lowest natural frequency of a tooth cut out with its rim, Hz


def teeth_reduced(problem: DriveProblem, run: Run, *, phases: int = _PHASES) -> TeethReduced:
    """Return a drive's teeth in numbers, from their static contact at some torques.

    Raises
    ------
    InputError
        The teeth cannot carry the load.
    """
    rigid = dataclasses.replace(problem, shaft=type(problem.shaft)())
    model = StaticModel(rigid, run, phases)
    load = problem.load
    give: list[tuple[float, float, float, float]] = []

    def evaluate(_number: int, balance: Balance) -> None:
        force, radius, _ = contact_means(balance.contact, balance)
        give.append((force, force * radius, *_along(balance.contact)))

    upto = [LoadCase(share * load) for share in SHARES[:-1]]
    upto[-1] = upto[-1]._replace(evaluate=evaluate)
    # Of little friction the torque says next to nothing of the radius that it acts at.
    much = max(model.friction, _TELLING)
    sweeps = model.sweeps(upto)
    # Beyond the load as far as the teeth carry.
    with contextlib.suppress(InputError):
        sweeps += model.sweeps([LoadCase(SHARES[-1] * load)])
    torque = float(sweeps[len(upto) - 1].worm_torque.mean())
    if much > model.friction:
        torque = float(model.rubbing(much).sweeps([LoadCase(load)])[0].worm_torque.mean())
    whole, moment, work, friction = np.array(give).sum(axis=0)
    compliance = work / friction if friction > 0.0 else 0.0
    return TeethReduced(
        torque=np.array([pitch_sweep.torque for pitch_sweep in sweeps]),
        deflection=np.array([pitch_sweep.mean_deflection for pitch_sweep in sweeps]),
        radius=_closed_form_radius(problem, much, torque, moment / whole),
        compliance=float(compliance),
        normal_force=float(whole / phases),
        mode=lowest_mode(model.sector.wheel, problem.gearset.wheel_material),
    )


def _closed_form_radius(
    problem: DriveProblem, friction: float, torque: float, guess: float
) -> float:
    """Radius at which an involute worm has a torque, m."""
    radius = guess
    step = 1e-6
    for _ in range(20):
        here, there = (
            problem.point(r).worm_torque(problem.load, friction) for r in (radius, radius + step)
        )
        move = (torque - here) * step / (there - here) if there != here else 0.0
        radius += float(np.clip(move, -0.1 * guess, 0.1 * guess))
        if abs(move) < 1e-9:
            break
    return float(radius)


def _along(contact: TeethContact) -> tuple[float, float]:
    """Work of friction on the way that it bends the teeth by, N m, and its square's sum, N^2.

    Teeth lie side by side: each takes its share of the friction.
    """
    body = contact.sector.body
    work = total = 0.0
    for k in range(contact.slots):
        count = 4 * int(contact.candidates.counts[k, 0])
        if not count:
            continue
        force = contact.answer.force[k, :count]
        normal = contact.answer.normal[k, :count]
        along = force - np.einsum("qi,qi->q", force, normal)[:, None] * normal
        nodal = np.zeros(3 * body.nodes)
        contact.spread(k, along, nodal)
        size = float(np.linalg.norm(along.sum(axis=0)))
        if size > 0.0:
            work += float(nodal @ body.flexibility @ nodal)
            total += size
    return work, total**2
