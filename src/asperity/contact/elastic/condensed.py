r"""An elastic body reduced to the nodes that may touch another.

With contact forces :math:`f` and loads :math:`g` the contact nodes move by

.. math:: u = C f + C_g g + \Phi_r q_r + \sum_j \phi_j (q_j - q_j^{static}) ,

exactly so in statics. Each mode whose inertia counts takes its own share
:math:`\phi_j \phi_j^T/\omega_j^2` of the static flexibility: what is left is the residual
flexibility. The rigid modes belong to a free body, or to the rigid one a tied body moves with.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.errors import InputError, nearest


@dataclass(frozen=True, eq=False)
class CondensedBody:
    r"""An elastic body reduced to its contact nodes; `condense` makes it.

    Freedom 3 i + a is the displacement of contact node i along axis a. Loads are named; a load's
    own displacement is the one it does work with.
    """

    nodes: IntArray  #: (n,): The contact nodes' numbers in the mesh, ascending
    positions: FloatArray  #: (n, 3): Where they are, m
    #: (3n, 3n): :math:`C`, static, symmetric, m/N. A free body's loads are balanced by its inertia.
    flexibility: FloatArray
    #: (3n, 6) or (3n, 0): Rigid modes at the contact nodes: shifts along and turns about x, y, z
    #: through `centre`; none for a tied body that stands still
    rigid: FloatArray
    mass: FloatArray  #: (6, 6): Mass and moments of inertia about `centre`, kg and kg m^2
    centre: FloatArray  #: (3,): Centre of mass, m
    #: (3n, k): Shapes with inertia of their own at the contact nodes, of unit generalised mass and
    #: uncoupled, 1/sqrt(kg): natural modes of the free body, or of the one whose tied nodes stand
    #: still, then static shapes; see `asperity.contact.elastic.modes`
    modes: FloatArray
    mode_frequency: FloatArray  #: (k,): Their frequencies, Hz, ascending
    natural_modes: int  #: How many of them are natural modes: the first
    #: L names, the first three ``gravity_x``, ``gravity_y``, ``gravity_z`` (unit: 1 m/s^2)
    load_names: tuple[str, ...]
    #: (3n, L): Static displacement of the contact nodes under each unit load; its transpose gives
    #: the loads' own displacements under contact forces
    load_flexibility: FloatArray
    load_compliance: FloatArray  #: (L, L): The loads' own static displacements under each other
    #: (6, L): Force and moment about `centre` of each unit load; its transpose gives the loads' own
    #: displacements in the rigid modes
    load_rigid: FloatArray
    #: (k, L): Generalised force of each unit load on each mode; transposed as before
    load_modes: FloatArray
    unknowns: int  #: Freedoms of the whole mesh
    solver: str  #: Direct solver that was used
    residual: float  #: Largest relative residual of its answers
    seconds: float  #: Time condensing took, s
    from_cache: bool = False  #: Whether this was read back from disk

    @property
    def mode_stiffness(self) -> FloatArray:
        """Generalised stiffness of the modes, N/m."""
        return np.asarray((2.0 * np.pi * self.mode_frequency) ** 2)

    @cached_property
    def residual_flexibility(self) -> FloatArray:
        """Static flexibility less the share of the modes, shape (3n, 3n), m/N."""
        return self.flexibility - (self.modes / self.mode_stiffness) @ self.modes.T

    @cached_property
    def residual_load_flexibility(self) -> FloatArray:
        """``load_flexibility`` less the share of the modes, shape (3n, L)."""
        return self.load_flexibility - (self.modes / self.mode_stiffness) @ self.load_modes

    @cached_property
    def residual_load_compliance(self) -> FloatArray:
        """``load_compliance`` less the share of the modes, shape (L, L)."""
        share = (self.load_modes.T / self.mode_stiffness) @ self.load_modes
        return np.asarray(self.load_compliance - share)

    def load_index(self, name: str) -> int:
        """Return the number of a load; InputError where there is none of the name."""
        if name not in self.load_names:
            raise InputError(f"the body has no load {name!r}{nearest(name, self.load_names)}")
        return self.load_names.index(name)

    def loads(self, sizes: Mapping[str, float]) -> FloatArray:
        """Return a vector of loads, shape (L,), from sizes by name; the others are zero."""
        vector = np.zeros(len(self.load_names))
        for name, size in sizes.items():
            vector[self.load_index(name)] = size
        return vector
