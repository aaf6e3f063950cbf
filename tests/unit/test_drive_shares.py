"""How teeth share their load: as the patches do, of which pressures and line loads are."""

import functools

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.root_stress.loads import loads_of
from asperity.drive.static.loaded import loaded_of
from asperity.drive.static.pressure import resolved
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.spread import LOADED
from asperity.drive.static.sweep import LoadCase
from asperity.runs import Run


@functools.cache
def model(threads):
    settings = "drive.teeth=1", "drive.phases=3", f"drive.threads={threads}"
    case = read_case("drive-screw", case_tables(), settings)
    return StaticModel(DriveProblem.from_case(case, shaken=False), Run())


@functools.cache
def both(threads):
    """Loaded, and by phase what patches and condensed teeth bear."""
    made, patches, condensed = model(threads), [], []

    def take(_number, balance):
        found = resolved(made.resolved, balance)
        patches.append(np.array([tooth.normal for tooth in found.teeth]))
        condensed.append(balance.action.normal.copy())

    made.sweeps([LoadCase(made.problem.load, evaluate=take)])
    return loaded_of(made), patches, condensed


def largest(forces):
    return max(each.max() / each.sum() for each in forces)


@pytest.mark.slow
def test_shares_are_those_of_the_patches():
    found, patches, condensed = both("rigid")
    assert found.load_share == pytest.approx(largest(patches), rel=1e-6)
    teeth = np.mean([(each > LOADED * each.sum()).sum() for each in patches])
    assert found.loaded_teeth == pytest.approx(teeth)
    assert found.k_h_alpha == pytest.approx(found.load_share * teeth, rel=1e-6)
    assert found.normal_force == pytest.approx(np.mean([each.sum() for each in patches]), rel=1e-6)
    # Moments are equal, and arms nearly: forces as well.
    assert found.normal_force == pytest.approx(np.mean([e.sum() for e in condensed]), rel=5e-3)
    # Threads that are rigid in the balance share otherwise there.
    assert largest(condensed) > 1.01 * found.load_share


@pytest.mark.slow
def test_threads_that_give_in_the_balance_share_there_as_the_patches_do():
    found, _, condensed = both("elastic")
    assert largest(condensed) == pytest.approx(found.load_share, rel=1e-2)


@pytest.mark.slow
def test_roots_bear_as_the_patches_share_the_load():
    _, patches, condensed = both("rigid")
    loads = loads_of(model("rigid"))
    for phase, (own, other) in enumerate(zip(patches, condensed, strict=True)):
        borne = sorted(load.normal for load in loads if load.phase == phase)
        np.testing.assert_allclose(borne, np.sort(own[own > 0.02 * own.sum()]), rtol=2e-3)
        assert max(other) == pytest.approx(max(own), rel=0.2)
    for load in loads:
        # With friction of 0.134 the whole force is somewhat more.
        force = np.linalg.norm(load.forces[1].sum(axis=0))
        assert force == pytest.approx(load.normal, rel=0.03)
    assert max(load.normal for load in loads) < 0.99 * max(max(each) for each in condensed)
