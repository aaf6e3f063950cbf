"""Loaded teeth for ParaView: what is known on the exact flank, at the nodes of the mesh."""

from types import SimpleNamespace

import numpy as np

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import grid_of
from asperity.drive.static.solve import wheel_of
from asperity.drive.static.view import at_nodes
from asperity.drive.teeth.sector import _own_surface
from asperity.flanks.mesh.tooth import contact_counts


def test_what_is_even_over_the_flank_is_the_same_at_its_nodes():
    case = read_case("drive-screw", case_tables())
    wheel = wheel_of(DriveProblem.from_case(case, shaken=False))
    surface = _own_surface(wheel, contact_counts("coarse"))
    sector = SimpleNamespace(wheel=wheel, surface=surface)
    points, _, _, z = grid_of(wheel)
    # Place across the face, and the radius, which is nearly straight between points.
    across = at_nodes(sector, 1e9 * z)
    np.testing.assert_allclose(across, 1e9 * surface.positions[:, 2], atol=1.0)
    radius = at_nodes(sector, np.hypot(points[:, 0], points[:, 1]))
    own = np.hypot(surface.positions[:, 0], surface.positions[:, 1])
    np.testing.assert_allclose(radius, own, atol=5e-6)
