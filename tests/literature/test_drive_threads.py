"""The worm's thread as a half-space, against Love's loaded square and Hertz's line.

Johnson, Contact Mechanics, 3.2.3: a square of side a under an even pressure p sinks by
1.122 p a (1 - nu^2)/E in its middle.
"""

import numpy as np
import pytest
from apparatus.drives import problem

from asperity.contact.interface.surface import ContactSurface
from asperity.drive.static.solve import condensed
from asperity.drive.teeth.threads import thread_flexibility
from asperity.runs import Run

E, NU = 206e9, 0.3


def square(count, side):
    """A flat flank of so many elements along either side."""
    line = np.linspace(0.0, side, count + 1)
    x, y = (each.ravel() for each in np.meshgrid(line, line, indexing="ij"))
    positions = np.column_stack([x, y, np.zeros_like(x)])
    row = np.arange(count)
    first = (row[:, None] * (count + 1) + row).ravel()
    faces = np.column_stack([first, first + count + 1, first + count + 2, first + 1])
    at = 0.5 - 0.5 / np.sqrt(3.0)
    points = np.array([[at, at], [at, 1 - at], [1 - at, at], [1 - at, 1 - at]])
    shapes = np.array([[(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v] for u, v in points])
    weights = np.full((count * count, 4), 0.25 * (side / count) ** 2)
    normals = np.tile([0.0, 0.0, 1.0], (count * count, 4, 1))
    return ContactSurface(np.arange(len(x)), positions, faces, shapes, weights, normals)


def test_an_evenly_pressed_square_sinks_as_love_s():
    count, side, pressure = 12, 1e-3, 1e8
    flank = square(count, side)
    flexibility = thread_flexibility(flank, E, NU)
    force = np.zeros((len(flank.positions), 3))
    force[:, 2] = pressure * flank.nodal_area
    moved = (flexibility @ force.ravel()).reshape(-1, 3)
    middle = (count // 2) * (count + 2)
    assert moved[middle, 2] == pytest.approx(1.122 * pressure * side * (1 - NU**2) / E, rel=0.02)
    # Along the surface the mean of (1 - nu) + nu x^2/r^2 takes the place of 1 - nu.
    force = np.roll(force, -2, axis=1)
    along = (flexibility @ force.ravel()).reshape(-1, 3)[middle, 0]
    assert along == pytest.approx(moved[middle, 2] * (1 - 0.5 * NU) / (1 - NU), rel=1e-6)


def test_it_is_passive_and_a_stiffer_steel_gives_less():
    flank = square(4, 1e-3)
    flexibility = thread_flexibility(flank, E, NU)
    assert np.abs(flexibility - flexibility.T).max() == 0.0
    assert np.linalg.eigvalsh(flexibility).min() > 0.0
    assert thread_flexibility(flank, 2.0 * E, NU) == pytest.approx(0.5 * flexibility, rel=1e-12)


@pytest.mark.slow
def test_the_steel_of_the_threads_stands_beside_the_teeth_s_own_flexibility():
    rigid, elastic = (
        condensed(problem("drive.teeth=1", f"drive.threads={threads}"), Run())
        for threads in ("rigid", "elastic")
    )
    more = elastic.body.flexibility - rigid.body.flexibility
    steel = problem().gearset.worm_material
    flank = thread_flexibility(rigid.surface, steel.youngs_modulus, steel.poisson_ratio)
    assert np.abs(more - flank).max() <= 1e-12 * np.abs(flank).max()
    assert 0.0 < elastic.mean_compliance / rigid.mean_compliance - 1.0 < 1.0
