"""How the teeth of a wheel are loaded over a pitch.

Where on a flank forces are, and which way, is the condensed tooth's, at the nodes of its mesh; how
much a tooth bears is the patches', as it is in every other answer.
"""

from typing import NamedTuple

import numpy as np

from asperity.arrays import BoolArray, FloatArray
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.static.equilibrium import Balance
from asperity.drive.static.pressure import resolved
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.sweep import LoadCase
from asperity.drive.teeth.sector import Sector, lattice

_LOADED = 0.02  # of all normal force, below which nobody asks for a tooth's root
_FOOT = 0.2  # of the flank's height, the part that bears beside the fillet


class Load(NamedTuple):
    """A tooth as it is loaded at a phase, with those beside it."""

    phase: int
    tooth: int
    normal: float  #: On it, N
    foot: float  #: Share of it on the lowest part of its flank
    #: (3, n, 3): On the flanks of the teeth before, of it and after in the mesh, each in its own
    #: frame, N
    forces: FloatArray


def loads_of(static: StaticModel) -> list[Load]:
    """Return every tooth that bears at every phase of a pitch."""
    sector = static.sector
    low = _low_rows(sector)
    found: list[Load] = []

    def take_loads(number: int, balance: Balance) -> None:
        contact, action = balance.contact, balance.action
        borne = _borne(static.resolved, balance)
        own = contact.nodal_forces().reshape(contact.slots, -1, 3)
        own = own * (borne / np.where(action.normal > 0.0, action.normal, 1.0))[:, None, None]
        none = np.zeros_like(own[0])
        # In the mesh teeth follow one another against their numbers.
        rows = [none, *own, none]
        for k, normal in enumerate(borne):
            if normal < _LOADED * borne.sum():
                continue
            force = np.linalg.norm(own[k], axis=1)
            forces = np.array([rows[k + 2], rows[k + 1], rows[k]])
            found.append(
                Load(
                    number,
                    action.teeth[k],
                    float(normal),
                    float(force[low].sum() / force.sum()),
                    forces,
                )
            )

    static.sweeps([LoadCase(static.problem.load, evaluate=take_loads)])
    return found


def _borne(owner: ResolvedContact, balance: Balance) -> FloatArray:
    """Return the normal force on each tooth as patches share it, where both bear, N."""
    patches = {tooth.number: tooth.normal for tooth in resolved(owner, balance, finer=False).teeth}
    action = balance.action
    own = [patches.get(number, 0.0) for number in action.teeth]
    return np.where(action.normal > 0.0, own, 0.0)


def _low_rows(sector: Sector) -> BoolArray:
    """Return which nodes of a flank lie on its lowest part."""
    nodes = lattice(sector.surface)
    count = max(1, round(_FOOT * len(nodes)))
    low = np.zeros(nodes.size, dtype=bool)
    low[nodes[:count]] = True
    return low
