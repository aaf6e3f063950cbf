"""What is taken from the balances of a pitch: means of the contact, and resolved pressures."""

from __future__ import annotations

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.candidates.wrench import place_of
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.resolved.pressures import Change, ToothPressure
from asperity.drive.resolved.strip import FLANK, ZONES
from asperity.drive.static.equilibrium import Balance
from asperity.drive.static.flash import Flash
from asperity.drive.static.pattern import Pattern
from asperity.drive.static.pressure import nodal_pressure, resolved
from asperity.drive.static.spread import Spread
from asperity.drive.teeth.contact import TeethContact


def contact_means(contact: TeethContact, balance: Balance) -> tuple[float, float, float]:
    """Return normal force, N, its mean radius on the worm, m, and sliding way, m/rad."""
    _, rotation, translation = contact.placed(
        balance.worm_angle + float(balance.yielded[0]), balance.wheel_angle, balance.shift
    )
    forces, radii, ways = [], [], []
    shapes = contact.sector.body.shapes
    for k in range(contact.slots):
        own, answer = contact.candidates.of(k), contact.answer.of(k)
        for q in np.flatnonzero(answer.pressure[: 4 * int(own.counts[0])] > 0.0):
            place = np.array(place_of(own, shapes, answer.u, q))
            x, y, _ = rotation[k].T @ (place - translation[k])
            forces.append(answer.pressure[q] * own.weights[q])
            radii.append(math.hypot(x, y))
            ways.append(np.linalg.norm(answer.slip_1[q]))
    weights = np.array(forces)
    whole = float(weights.sum())
    return whole, float(weights @ radii) / whole, float(weights @ ways) / whole


class PhaseRecord:
    """What is taken from each phase under the load."""

    def __init__(self, owner: ResolvedContact, flash: Flash | None = None) -> None:
        self.owner = owner
        self.flash = flash
        self.pattern = Pattern(owner)
        self.spread = Spread(owner.flank)
        self.weight = self.radius = self.speed = 0.0
        self.nodal = 0.0  #: Largest pressure at a node of the mesh, Pa
        self.turns: list[FloatArray] = []
        self.peaks: list[FloatArray] = []  #: By phase and zone, Pa
        self.forces: list[FloatArray] = []  #: By phase and zone, N
        self.areas: list[float] = []  #: That bear, m^2
        self.depths: list[float] = []  #: Pressed in plastically, m
        self.changes: list[tuple[int, Change]] = []  #: That finer patches would make, by phase
        self._normals: list[dict[int, float]] = []  # By phase and number of the tooth, N
        self.worst: ToothPressure | None = None  #: Of the largest pressure on a flank
        self.nodal_forces = np.zeros((0, 3 * owner.flank.sector.body.nodes))

    def evaluate(self, number: int, balance: Balance) -> None:
        """Take what a balance has."""
        contact = balance.contact
        for k in range(contact.slots):
            if balance.action.normal[k] > 0.0:
                self.nodal = max(self.nodal, float(nodal_pressure(contact, k).max()))
        self.turns.append(balance.turns)
        force, radius, speed = contact_means(contact, balance)
        self.weight += force
        self.radius += force * radius
        self.speed += force * speed
        found = resolved(self.owner, balance)
        self.pattern.add(found)
        self.spread.take(found)
        if self.flash is not None:
            self.flash.take(found)
        own = dict.fromkeys(balance.action.teeth, 0.0)
        self._normals.append(own | {tooth.number: tooth.normal for tooth in found.teeth})
        peaks = np.array([tooth.peaks() for tooth in found.teeth])
        self.peaks.append(peaks.max(axis=0))
        self.forces.append(np.sum([tooth.forces() for tooth in found.teeth], axis=0))
        self.areas.append(sum(tooth.area for tooth in found.teeth))
        self.depths.append(found.depth)
        self.changes += [(number, change) for change in found.changes]
        worst = found.teeth[int(np.argmax(peaks[:, FLANK]))]
        if self.worst is None or worst.peaks()[FLANK] > self.worst.peaks()[FLANK]:
            self.worst = worst
        if peaks.max() >= max(float(each.max()) for each in self.peaks):
            self.nodal_forces = contact.nodal_forces()

    def largest(self) -> dict[str, tuple[float, float]]:
        """Return the largest pressure, Pa, and force, N, of a pitch by zone."""
        peaks, forces = np.max(self.peaks, axis=0), np.max(self.forces, axis=0)
        return {
            name: (float(peak), float(force))
            for name, peak, force in zip(ZONES, peaks, forces, strict=True)
        }

    @property
    def tooth_force(self) -> FloatArray:
        """Normal forces by phase and tooth, from the one that enters, N, shape (p, K).

        As the patches share them, of which pressures and line loads are.
        """
        numbers = sorted({number for own in self._normals for number in own})
        rows = [[own.get(number, 0.0) for number in numbers] for own in self._normals]
        return np.array(rows, dtype=np.float64)

    @property
    def mean(self) -> float:
        """Normal force over the area that bears, mean over the pitch, Pa."""
        return float(np.sum(self.forces) / np.sum(self.areas))
