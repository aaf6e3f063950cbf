"""A pitch of the worm passed through under one torque: what is summed up at each phase."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.static.clearance import cut_root, refuse_cut_core
from asperity.drive.static.equilibrium import Balance, Equilibrium
from asperity.drive.teeth.contact import TeethContact
from asperity.errors import ConvergenceError

FORWARD, FRICTIONLESS, REVERSED = 1, 0, -1


@dataclasses.dataclass(frozen=True, eq=False)
class PitchSweep:
    """Balances over a pitch under one torque; all arrays have a row for each phase."""

    torque: float  #: Of the wheel, N m
    worm_angle: FloatArray  #: (p,): rad
    touching: FloatArray  #: (p,): The wheel's angle without load, ahead of the ratio's, rad
    deflection: FloatArray  #: (p,): By which the load turns the wheel back, rad
    worm_torque: FloatArray  #: (p,): N m
    wrench: FloatArray  #: (p, 6): On the wheel about its centre, N and N m
    residual: float  #: Largest

    @property
    def error(self) -> FloatArray:
        """Transmission error under load: the wheel ahead of the ratio's angle, rad."""
        return self.touching - self.deflection

    @property
    def mean_deflection(self) -> float:
        """Over the pitch, rad."""
        return float(self.deflection.mean())


def phases_of(contact: TeethContact, count: int) -> FloatArray:
    """Return so many angles of the worm over a pitch, rad."""
    pitch = contact.sector.pitch * contact.stand.ratio
    return np.asarray(np.arange(count) * (pitch / count), dtype=np.float64)


def touching_angles(contact: TeethContact, phases: FloatArray) -> FloatArray:
    """Return the wheel's angles without load, rad.

    Raises
    ------
    InputError
        Worm or wheel reaches with its tips into the other's root.
    ConvergenceError
        The worm reaches no tooth.
    """
    still = np.zeros(3)
    refuse_cut_core(contact.sector.wheel)
    try:
        return np.array([contact.touching_angle(float(beta), still) for beta in phases])
    except ConvergenceError as error:
        raise cut_root(contact.sector.wheel) or error from None


class LoadCase(NamedTuple):
    """A torque to be solved for."""

    torque: float  #: Of the wheel, N m
    sense: int = FORWARD  #: `FORWARD`, `FRICTIONLESS` or `REVERSED`
    every: int = 1  #: 1: at all phases; n: at each n-th
    #: Takes the number of a phase and its balance while the fields of the contact are its own
    evaluate: Callable[[int, Balance], None] | None = None


def sweep(
    equilibrium: Equilibrium,
    phases: FloatArray,
    touching: FloatArray,
    cases: Sequence[LoadCase],
    step: Callable[[int], None] = lambda _number: None,
) -> list[PitchSweep]:
    """Solve for the balance at all phases under some torques, one after the other at each phase.

    Like torques beside each other begin with what the one before has found.

    Parameters
    ----------
    equilibrium : Equilibrium
        Of the drive.
    phases, touching : ndarray
        Angles of the worm, and of the wheel without load there, rad.
    cases : sequence of LoadCase
        Torques.
    step : callable, optional
        Called with the number of phases that are done.
    """
    found: list[list[Balance]] = [[] for _ in cases]
    for number, (beta, free) in enumerate(zip(phases, touching, strict=True)):
        for load, balances in zip(cases, found, strict=True):
            if number % load.every:
                continue
            balance = equilibrium.balance(
                float(beta), load.torque, sense=load.sense, touching=float(free)
            )
            if load.evaluate is not None:
                load.evaluate(number, balance)
            balances.append(balance)
        step(number + 1)
    ratio = equilibrium.contact.stand.ratio
    sweeps = []
    for load, balances in zip(cases, found, strict=True):
        some, free_angles = phases[:: load.every], touching[:: load.every]
        sweeps.append(
            PitchSweep(
                torque=load.torque,
                worm_angle=some,
                touching=free_angles - some / ratio,
                deflection=free_angles - np.array([b.wheel_angle for b in balances]),
                worm_torque=np.array([b.worm_torque for b in balances]),
                wrench=np.array([b.action.wrench for b in balances]),
                residual=max(b.residual for b in balances),
            )
        )
    return sweeps
