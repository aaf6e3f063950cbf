"""What the points of a mesh make of the loaded error: told by the patches, shown by another mesh.

Two meshes of one gearset have transmission errors that differ. By order they differ by no more than
what each is told to make itself; with that taken off, the orders from the second on differ by half
and less. The first one keeps what the meshes give as bodies.
"""

import functools

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.static.pattern import Pattern
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.sweep import LoadCase
from asperity.runs import Run

PHASES, ORDERS = 12, 5
LOADS = (366.0 / 9.0, 366.0 / 3.0, 366.0)

pytestmark = pytest.mark.slow


def orders(error):
    return np.fft.rfft(error)[1 : ORDERS + 1] * 2.0 / PHASES


@functools.cache
def errors(density, threads="elastic"):
    """Orders of the error and of what the mesh makes of it, a row a load, complex, rad."""
    settings = f"drive.density={density}", f"drive.threads={threads}"
    problem = DriveProblem.from_case(read_case("drive-screw", case_tables(), settings))
    model = StaticModel(problem, Run(), PHASES)
    patterns = [Pattern(model.resolved) for _ in LOADS]
    found = model.sweeps(
        [LoadCase(load, evaluate=each.evaluate) for load, each in zip(LOADS, patterns, strict=True)]
    )
    rows = [
        (orders(pitch.error), orders(np.array(pattern.mesh_errors)))
        for pitch, pattern in zip(found, patterns, strict=True)
    ]
    return np.array(rows).swapaxes(0, 1)


@pytest.mark.parametrize("threads", ["elastic", "rigid"])
def test_two_meshes_differ_by_no_more_than_both_are_told_to_make(threads):
    (one, own), (other, its) = errors("coarse", threads), errors("intermediate", threads)
    told = np.abs(own) + np.abs(its)
    assert (np.abs(one - other) < 1.15 * told + 1e-7).all()
    # And it is no more than a part of an error that is there.
    assert (told[:, 0] < 0.8 * np.abs(one[:, 0])).all()


def test_without_what_they_make_two_meshes_have_the_same_orders():
    (one, own), (other, its) = errors("coarse"), errors("intermediate")
    with_it = np.linalg.norm((one - other)[:, 1:], axis=1)
    without = np.linalg.norm((one - own - other + its)[:, 1:], axis=1)
    assert (without < 0.5 * with_it).all()
