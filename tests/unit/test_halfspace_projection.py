"""Patches at their caps: projected gradients against conjugate ones, and where these go astray."""

import numpy as np
import pytest

from asperity.contact.halfspace import conjugate_gradients
from asperity.contact.halfspace.conjugate_gradients import _by_projection, bear
from asperity.contact.halfspace.influence import HalfSpace

N, EDGE, MODULUS = 24, 1e-5, 1e11


def contact(cap):
    """A sphere of 10 mm on a half-space: gap, deflection, levers and caps."""
    space = HalfSpace((N, N), (EDGE, EDGE), MODULUS)
    x = EDGE * (np.arange(N) - 0.5 * (N - 1))
    gap = (np.add.outer(x**2, x**2) / (2.0 * 0.01)).ravel()
    arm = np.linspace(0.9, 1.1, N * N)
    return gap, space.deflection, arm, np.full(N * N, cap * EDGE**2)


@pytest.mark.parametrize("share", [1.5, 0.8, 0.6])
def test_both_ways_find_the_same_forces(share):
    gap, deflection, arm, free = contact(np.inf)
    alone = bear(gap, deflection, arm, 20.0)
    most = np.full_like(free, share * alone.force.max())
    one = bear(gap, deflection, arm, 20.0, most=most)
    begun = np.minimum(alone.force, most)
    other = _by_projection(gap, deflection, arm, 20.0, most, begun, 1e-6)
    assert other.force == pytest.approx(one.force, abs=1e-3 * one.force.max())
    assert other.approach == pytest.approx(one.approach, rel=1e-4)
    assert arm @ other.force == pytest.approx(20.0, rel=1e-9)


def test_what_nearly_all_is_at_its_cap_bears_the_load():
    gap, deflection, arm, _ = contact(1.0)
    alone = bear(gap, deflection, arm, 20.0)
    most = np.full_like(gap, 1.4 * 20.0 / arm.sum())
    found = _by_projection(gap, deflection, arm, 20.0, most, np.minimum(alone.force, most), 1e-5)
    free = (found.force > 0.0) & (found.force < most)
    assert (found.force >= most).sum() > 3 * free.sum() > 0
    size = np.abs(gap[free] - arm[free] * found.approach).max()
    assert np.abs(found.gap[free]).max() < 1e-4 * size
    assert (found.gap[found.force <= 0.0] > -1e-4 * size).all()
    assert (found.gap[found.force >= most] < 1e-4 * size).all()


def test_iterations_of_both_ways_are_counted_as_often_as_patches_sink_in_them():
    gap, deflection, arm, most = contact(np.inf)
    sunk = []

    def counted(force):
        sunk.append(force)
        return deflection(force)

    found = _by_projection(gap, counted, arm, 20.0, most, np.full_like(gap, 20.0 / arm.sum()), 1e-5)
    # Once and in every power before, once an iteration and at every look.
    before, looks = 1 + conjugate_gradients._POWERS, conjugate_gradients._LOOKS
    iterations = (len(sunk) - before) * looks / (looks + 1)
    assert found.iterations == conjugate_gradients._MOST + iterations
