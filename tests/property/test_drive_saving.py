"""What a drive is told to save against a march with four times the window and one in finer steps.

Random drives, weakly shaken and ordinary ones: where a saving is told, that of the other march is
no further from it than both errors; where that tells none, it is no more than they leave.
"""

import contextlib

import numpy as np
import pytest
from apparatus.drives import problem
from apparatus.random_drives import drawn, settings

from asperity.drive.protocols.many import solve_many
from asperity.drive.protocols.march import block_of
from asperity.drive.reduced.reduction import reduction
from asperity.drive.result import DriveResult
from asperity.errors import InputError
from asperity.runs import Run

LARGEST_WINDOW = 1000


def marched(asked):
    """Return the answers that have settled, None where there is none."""
    made = {}
    for n, each in enumerate(asked):
        # A step that is too coarse for flanks that hammer is refused.
        with contextlib.suppress(InputError):
            made[n] = problem(*each)
    found = solve_many([(each, reduction(each, Run())) for each in made.values()], Run())
    settled = {
        n: each
        for n, each in zip(made, found, strict=True)
        if isinstance(each, DriveResult) and each.settled
    }
    return [settled.get(n) for n in range(len(asked))]


def apart(one, other):
    """Return by how much two savings differ beyond their errors, W; NaN where neither is told."""
    errors = one.saved_power_error + other.saved_power_error
    if one.saved_power is not None and other.saved_power is not None:
        return abs(one.saved_power - other.saved_power) - errors
    if one.saved_power is not None:
        return abs(one.saved_power) - errors - other.saved_power_error
    return np.nan


def against_longer_and_finer(seed, count):
    """Return how many savings were told, none, and those that are off by more than was told."""
    rng, drives = np.random.default_rng(seed), []
    for _ in range(count):
        drive = drawn(rng)
        drive["amplitude"] = min(drive["amplitude"], 10 ** rng.uniform(-7.0, -4.0))
        drives.append((drive, settings(drive)))
    first = marched([given for _, given in drives])
    windows = [min(LARGEST_WINDOW, 4 * block_of(3, drive["frequency"])) for drive, _ in drives]
    longer = marched(
        [(*given, f"drive.window={n}") for (_, given), n in zip(drives, windows, strict=True)]
    )
    finer = marched([(*given, "solve.step=0.1 us") for _, given in drives])
    told, none, off = 0, 0, []
    for (drive, _), one, *others in zip(drives, first, longer, finer, strict=True):
        if one is None:
            continue
        if one.saved_power is None:
            none += 1
            assert one.saved_per_actuator is None
            assert any(note.startswith("drive power saved: none") for note in one.notes)
        else:
            told += 1
            assert abs(one.saved_power) > one.saved_power_error
        off += [
            (drive, one.saved_power, one.saved_power_error, other.saved_power)
            for other in others
            if other is not None and other.saved_power_error is not None and apart(one, other) > 0.0
        ]
    return told, none, off


def test_a_few_drives_tell_a_saving_only_as_far_as_it_is_known():
    told, none, off = against_longer_and_finer(1, 12)
    assert told
    assert none
    assert not off


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_drives_tell_a_saving_only_as_far_as_it_is_known")
@pytest.mark.parametrize("part", range(5))
def test_drives_tell_a_saving_only_as_far_as_it_is_known(part):
    _, _, off = against_longer_and_finer((2, part), 60)
    assert not off
