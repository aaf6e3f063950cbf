r"""A loaded contact whose wheel has worn, and what a pitch wears off it.

Archard's law: where the worm presses with :math:`p` and slides past by :math:`v` a radian of its
turn, a passage of the tooth through the mesh takes off

.. math:: h = k\int p\,v\,d\beta .

At a phase of a pitch the teeth in mesh stand where one tooth stands pitch after pitch, so that all
teeth over one pitch are one tooth's passage, which it has once in a turn of the wheel. Patches give
their volumes to the points of the flank about them, so that none is lost between both.
"""

from __future__ import annotations

import copy
import dataclasses
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.resolved.flank import ExactFlank, grid_faces
from asperity.drive.resolved.strip import ZONES
from asperity.drive.static.equilibrium import Balance, Equilibrium
from asperity.drive.static.pressure import resolved
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.sweep import touching_angles
from asperity.drive.teeth.contact import TeethContact
from asperity.drive.teeth.placing import sliding


def worn_model(new: StaticModel, depth: FloatArray, phases: FloatArray) -> StaticModel:
    """Return a model whose wheel has worn, about other phases.

    Parameters
    ----------
    new : StaticModel
        Of the wheel as it was cut.
    depth : ndarray, shape (k,)
        Worn off at the points of `ExactFlank.grid`, m.
    phases : ndarray, shape (p,)
        Angles of the worm, rad.
    """
    flank = dataclasses.replace(new.resolved.flank, worn=depth)
    grid, row, column = new.sector.exact_grid
    share, z = (np.asarray(part) for part in _places(new, flank))
    out = grid.normals[row, column]
    body = new.sector.body
    places = np.ascontiguousarray(body.places - flank.depth_at(share, z)[:, None] * out)
    sector = dataclasses.replace(new.sector, body=body._replace(places=places))
    made = copy.copy(new)
    made.sector = sector
    made.contact = TeethContact(sector, new.friction)
    made.equilibrium = Equilibrium(made.contact, new.equilibrium.compliance)
    made.phases = phases
    made.touching = touching_angles(made.contact, phases)
    flank = dataclasses.replace(flank, sector=sector)
    owner = new.resolved
    made.__dict__["resolved"] = ResolvedContact(
        flank, owner.modulus, owner.cap, rigid_share=owner.rigid_share
    )
    return made


def _places(new: StaticModel, flank: ExactFlank) -> tuple[FloatArray, FloatArray]:
    """Where the contact's points are on the flank: shares of its height, and along the face."""
    places = new.sector.body.places
    return flank.share_at(places), places[:, 2]


class Taken:
    """What a pitch takes off a flank, for a coefficient of 1 1/Pa.

    Parameters
    ----------
    owner : ResolvedContact
        Of the flank as it is now.
    step : float
        Turn of the worm that a phase stands for, rad.
    """

    def __init__(self, owner: ResolvedContact, step: float) -> None:
        self.owner = owner
        self.step = step
        self.moved = np.zeros(owner.flank.nodes)  #: Force times way about the points, N m
        self.work = 0.0  #: Of the normal forces on the way that they slide, N m
        self.peaks = np.zeros(len(ZONES))  #: Largest pressure by zone, Pa
        self.force = 0.0  #: Normal forces of all phases, N
        self.area = 0.0  #: That bears, of all phases, m^2

    def evaluate(self, _number: int, balance: Balance) -> None:
        """Take a phase."""
        found = resolved(self.owner, balance, finer=False)
        contact, flank = balance.contact, self.owner.flank
        beta = balance.worm_angle + float(balance.yielded[0])
        _, rotation, translation = contact.placed(beta, balance.wheel_angle, balance.shift)
        first = balance.action.teeth[0]
        shift, turn = np.zeros(3), np.zeros((3, 3))
        for tooth in found.teeth:
            k = tooth.number - first
            sliding(contact.stand, rotation[k], translation[k], contact.side, 1.0, shift, turn)
            on = tooth.force > 0.0
            points, out, force = (
                tooth.strip.points[on], tooth.strip.normals[on], tooth.force[on]
            )  # fmt: skip
            past = shift + points @ turn.T
            past -= np.einsum("ki,ki->k", past, out)[:, None] * out
            slid = np.linalg.norm(past, axis=1) * self.step * force
            self.work += float(slid.sum())
            for nodes, weights in _about(flank, tooth.strip.share[on], points[:, 2]):
                np.add.at(self.moved, nodes, weights * slid)
            self.peaks = np.maximum(self.peaks, tooth.peaks())
            self.force += tooth.normal
            self.area += tooth.area

    @cached_property
    def depth(self) -> FloatArray:
        """Depth by a turn of the wheel at the points of the flank, over the coefficient, N/m."""
        return self.moved / node_area(self.owner.flank)


def _about(
    flank: ExactFlank, share: FloatArray, z: FloatArray
) -> list[tuple[IntArray, FloatArray]]:
    """Points of the flank's grid about places, and their shares, which sum up to 1."""
    shares, columns = axes_of(flank)
    i = np.clip(np.searchsorted(shares, share, side="right") - 1, 0, len(shares) - 2)
    j = np.clip(np.searchsorted(columns, z, side="right") - 1, 0, len(columns) - 2)
    u = np.clip((share - shares[i]) / (shares[i + 1] - shares[i]), 0.0, 1.0)
    v = np.clip((z - columns[j]) / (columns[j + 1] - columns[j]), 0.0, 1.0)
    return [
        ((i + a) * len(columns) + j + b, (u if a else 1.0 - u) * (v if b else 1.0 - v))
        for a in (0, 1)
        for b in (0, 1)
    ]


def axes_of(flank: ExactFlank) -> tuple[FloatArray, FloatArray]:
    """Return the shares and the places across the face that the points of a flank stand at."""
    _, _, share, z = flank.grid
    shares = np.unique(share)
    return shares, z[: len(z) // len(shares)]


def node_area(flank: ExactFlank) -> FloatArray:
    """Return what of the flank's area belongs to each point of its grid, m^2."""
    points, faces = flank.grid[0], grid_faces()
    a, b, c, d = (points[faces[:, n]] for n in range(4))
    area = 0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1)
    found = np.zeros(len(points))
    for n in range(4):
        np.add.at(found, faces[:, n], 0.25 * area)
    return found
