r"""Half-spaces in normal contact on a grid of patches, against closed forms.

Sources:
- K. L. Johnson, Contact Mechanics, Cambridge 1985: sphere (4.22)-(4.24), line (4.43)-(4.45),
  ellipse (4.26)-(4.32), a square under an even pressure (3.29): 1.122 p a (1 - nu^2)/E in the
  middle.
- M. Ciavarella, D. A. Hills and G. Monno, Proc. Instn Mech. Engrs C 212 (1998), 319: a flat punch
  with rounded edges in plane strain. With half-widths a of the flat and b of the contact,
  :math:`P = E^* (b^2/2R)\,\{\phi - \sin\phi\cos\phi\}`, :math:`\phi = \arccos(a/b)`; its pressure
  is found here by the quadrature of the punch's slope,
  :math:`p(x) = -\frac{E^*}{2\pi}\sqrt{b^2 - x^2}\int \frac{h'(t)\,dt}{\sqrt{b^2 - t^2}\,(t - x)}`.
"""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipe, ellipk

from asperity.contact.halfspace.conjugate_gradients import bear
from asperity.contact.halfspace.influence import HalfSpace, rectangle_deflection
from asperity.errors import ConvergenceError, InputError

E = 115e9


def middles(count, step):
    return (np.arange(count) - (count - 1) / 2) * step


def pressed(gap, steps, force, **more):
    space = HalfSpace(gap.shape, steps, E)
    found = bear(gap.ravel(), space.deflection, np.ones(gap.size), force, **more)
    return found, found.force.reshape(gap.shape) / np.prod(steps)


def test_a_square_sinks_as_in_the_book():
    # Twice: in its middle the pressure of all four quarters.
    middle = rectangle_deflection(np.zeros(1), np.zeros(1), 1.0, 1.0)[0] / np.pi
    assert middle == pytest.approx(1.122, rel=1e-3)


def test_the_transform_sums_what_the_patches_do():
    rng = np.random.default_rng(1)
    force = rng.random((7, 5))
    space = HalfSpace((7, 5), (2e-5, 5e-5), E)
    x, y = np.meshgrid(middles(7, 2e-5), middles(5, 5e-5), indexing="ij")
    apart = [np.subtract.outer(a.ravel(), a.ravel()) for a in (x, y)]
    whole = rectangle_deflection(*apart, 2e-5, 5e-5) / (np.pi * E * 1e-9)
    np.testing.assert_allclose(space.deflection(force).ravel(), whole @ force.ravel(), rtol=1e-12)


def test_a_sphere_bears_as_hertz_says():
    radius, a, count = 0.01, 1e-4, 128
    force = 4.0 * E * a**3 / (3.0 * radius)
    at = middles(count, 2.6 * a / count)
    x, y = np.meshgrid(at, at, indexing="ij")
    found, pressure = pressed((x**2 + y**2) / (2.0 * radius), (at[1] - at[0],) * 2, force)
    assert pressure.max() == pytest.approx(1.5 * force / (np.pi * a**2), rel=1e-3)
    assert found.approach == pytest.approx(a**2 / radius, rel=1e-3)
    assert (pressure > 0.0).sum() * (at[1] - at[0]) ** 2 == pytest.approx(np.pi * a**2, rel=0.01)


def test_a_long_line_bears_as_hertz_says():
    radius, b, count = 0.01, 1e-4, 96
    length = 40.0 * b
    step = 2.4 * b / count
    x, y = np.meshgrid(middles(count, step), middles(200, length / 200), indexing="ij")
    # A line of that length in its middle: a cylinder whose ends are rounded off far away.
    line = np.pi * E * b**2 / (4.0 * radius)
    _, pressure = pressed(x**2 / (2.0 * radius) + 0.0 * y, (step, length / 200), line * length)
    here = pressure[:, 100].sum() * step
    half = np.sqrt(4.0 * here * radius / (np.pi * E))
    assert pressure[:, 100].max() == pytest.approx(2.0 * here / (np.pi * half), rel=2e-3)


def test_an_ellipse_bears_as_hertz_says():
    a, square = 5e-4, 0.95
    b = a * np.sqrt(1.0 - square)
    k, e = ellipk(square), ellipe(square)
    peak = 1e9
    along = 2.0 * peak * b * (k - e) / (E * square * a**2)
    across = 2.0 * peak * b * ((a / b) ** 2 * e - k) / (E * square * a**2)
    nx, ny = 96, 96
    steps = 2.5 * b / nx, 2.5 * a / ny
    x, y = np.meshgrid(middles(nx, steps[0]), middles(ny, steps[1]), indexing="ij")
    gap = 0.5 * (across * x**2 + along * y**2)
    _, pressure = pressed(gap, steps, 2.0 / 3.0 * peak * np.pi * a * b)
    assert pressure.max() == pytest.approx(peak, rel=2e-3)


@pytest.mark.slow
def test_a_flat_punch_with_rounded_edges_bears_as_in_closed_form():
    flat, edge, radius = 2e-4, 2.5e-4, 5e-3
    count = 400
    step = 2.2 * edge / count
    at = middles(count, step)
    beyond = np.maximum(np.abs(at) - flat, 0.0)

    def line_of(half):
        phi = np.arccos(flat / half)
        return E * half**2 / (2.0 * radius) * (phi - np.sin(phi) * np.cos(phi))

    # Long, so that its middle is in plane strain.
    length, pieces = 60.0 * edge, 60
    gap = np.repeat((beyond**2 / (2.0 * radius))[:, None], pieces, axis=1)
    _, pressure = pressed(gap, (step, length / pieces), line_of(edge) * length)
    middle = pressure[:, pieces // 2]
    # Its ends bear more, and its middle less.
    half = brentq(lambda b: line_of(b) - middle.sum() * step, 1.001 * flat, 1.5 * edge)
    exact = np.zeros(count)
    theta = (np.arange(4000) + 0.5) * np.pi / 4000
    t = half * np.cos(theta)
    slope = np.sign(t) * np.maximum(np.abs(t) - flat, 0.0) / radius
    for k in np.flatnonzero(np.abs(at) < 0.995 * half):
        x = at[k]
        own = np.sign(x) * max(abs(x) - flat, 0.0) / radius
        integral = ((slope - own) / (t - x)).sum() * np.pi / 4000
        exact[k] = E / (2.0 * np.pi) * np.sqrt(half**2 - x**2) * integral
    assert exact.sum() * step == pytest.approx(middle.sum() * step, rel=0.01)
    assert middle.max() == pytest.approx(exact.max(), rel=0.02)
    assert middle[count // 2] == pytest.approx(exact[count // 2], rel=0.02)


def test_patches_that_flow_bear_their_limit_and_the_load_all_the_same():
    radius, a, count = 0.01, 1e-4, 64
    force = 4.0 * E * a**3 / (3.0 * radius)
    peak = 1.5 * force / (np.pi * a**2)
    at = middles(count, 3.0 * a / count)
    x, y = np.meshgrid(at, at, indexing="ij")
    area = (at[1] - at[0]) ** 2
    limit = np.full(x.size, 0.7 * peak * area)
    found, pressure = pressed(
        (x**2 + y**2) / (2.0 * radius), (at[1] - at[0],) * 2, force, most=limit
    )
    assert pressure.max() == pytest.approx(0.7 * peak, rel=1e-12)
    assert found.force.sum() == pytest.approx(force, rel=1e-9)
    flows = found.force >= limit
    assert (found.gap[flows] < 1e-10).all()
    assert (found.gap[found.force == 0.0] > -1e-10).all()


def test_a_load_that_no_patch_bears_is_refused():
    space = HalfSpace((4, 4), (1e-5, 1e-5), E)
    with pytest.raises(ConvergenceError, match="plastic flow"):
        bear(np.zeros(16), space.deflection, np.ones(16), 1.0, most=np.full(16, 0.01))
    with pytest.raises(InputError, match="must be positive"):
        HalfSpace((4, 0), (1e-5, 1e-5), E)
