"""The augmented contact of an increment: what its laws say to tractions that are assumed."""

import numpy as np
import pytest

from asperity.contact.candidates.newton import look
from asperity.contact.candidates.records import Answer, Candidates, Laws, Work
from asperity.contact.increment import ContactState, IncrementProblem
from asperity.contact.interface.counter_motion import SurfaceMotion
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import RigidSurface
from asperity.contact.interface.surface import contact_surface
from asperity.friction import VECTOR
from asperity.mesh import box

FACE = contact_surface(box([4e-3, 3e-3, 1e-3], [4, 3, 1], 1), "bottom")


@pytest.mark.usefixtures("plain_kernels")
def test_how_far_assumed_tractions_are_off_is_their_squared_integral():
    nodes = len(FACE.positions)
    law = PointFriction(DAHL, 0.3, 7e-8, VECTOR)
    problem = IncrementProblem(
        1e-9 * np.eye(3 * nodes), FACE, RigidSurface.plane(), NormalLaw("linear", 4e14), law,
        step=1e-5,
    )  # fmt: skip
    state = ContactState.rest(problem)
    # A millimetre above the surface the laws give no traction to any that is assumed.
    free = np.tile([0.0, 0.0, 1e-3], nodes)
    numbers = SurfaceMotion().numbers()
    assumed = 1e6 * np.random.default_rng(3).normal(size=(problem.points, 3))
    answer = Answer.workspace(problem.body, 1).of(0)._replace(free=free)
    answer.force[:] = assumed * problem.body.weights[:, None]
    laws = Laws(problem.interface, problem.tolerance, 0.0, problem.most_iterations)
    off = look(
        problem.body, Candidates.whole(problem.body), laws, numbers,
        state.committed(state.multiplier), answer, Work.workspace(problem.body, problem.points),
        True, 1e14,
    )  # fmt: skip
    assert np.all(answer.traction == 0.0)
    squares = (FACE.weights.ravel() * (assumed**2).sum(axis=1)).sum()
    assert off == pytest.approx(squares, rel=1e-9)
