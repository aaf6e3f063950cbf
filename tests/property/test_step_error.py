"""The error of the step that an answer tells against what finer steps show, on bodies by lot.

A state that has settled is no further than 1e-3 of its ratio (of 1e-6 of mu F_N at least) from that
in steps two and four times finer, unless a note says that the step is too long.
"""

import numpy as np
import pytest
from apparatus.bodies import draw

from asperity.errors import AsperityError
from asperity.slider import solve
from asperity.slider.step_error import WANTED, allowed


def solved(lot, folder, **settings):
    try:
        return solve(lot.model(folder, method="periodic", **settings), history=False)
    except AsperityError:
        return None


def off_untold(seed, count, folder, **options):
    """Return the states whose step makes a greater error unannounced, of so many that settled."""
    rng, off, tried = np.random.default_rng(seed), [], 0
    while tried < count:
        lot = draw(rng, **options)
        answer = solved(lot, folder)
        if answer is None or not answer.settled or answer.notes or answer.step_error is None:
            continue
        tried += 1
        step = answer.model.step / answer.model.substeps
        for times in (2, 4):
            finer = solved(lot, folder, step=f"{step / times!r} s")
            if finer is None or not finer.settled:
                continue
            if abs(finer.ratio - answer.ratio) > allowed(answer):
                off.append((times, answer.ratio, finer.ratio, answer.step_error, lot.toml()))
    return off


def test_a_few_bodies_on_soft_drives_tell_what_corners_cost(tmp_path):
    assert WANTED == 1e-3
    assert not off_untold(1, 4, tmp_path, models=("coulomb",), pressed=False, corners=True)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_bodies_on_soft_drives_tell_what_corners_cost")
@pytest.mark.parametrize("part", range(10))
@pytest.mark.parametrize("models", [("coulomb",), ("dahl", "lugre", "coulomb")])
def test_bodies_on_soft_drives_tell_what_corners_cost(tmp_path, models, part):
    assert not off_untold((2, part), 30, tmp_path, models=models, corners=True)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_bodies_on_soft_drives_tell_what_corners_cost")
@pytest.mark.parametrize("part", range(10))
def test_bodies_tell_what_their_steps_cost(tmp_path, part):
    assert not off_untold((3, part), 30, tmp_path)
