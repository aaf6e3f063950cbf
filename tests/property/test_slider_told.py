"""Durations that short marches of bodies by lot are told to take: what takes them has settled.

Every law, waveform, direction and contact of `apparatus.bodies`, on drives with and without
damping; a sixth of them nothing shakes. A march takes 4 to 400 cycles.
"""

import math

import numpy as np
import pytest
from apparatus.bodies import draw
from apparatus.grid import slow

from asperity.errors import AsperityError
from asperity.slider import solve
from asperity.slider.longer import lasting
from asperity.slider.timetable import Timetable

LOT = 7
MOST_STEPS = 3e6


def body(member, folder):
    """Return a body by lot, with the duration of a short march."""
    rng = np.random.default_rng((LOT, member))
    lot = draw(rng)
    vibration = lot.tables["vibration"]
    if rng.random() < 0.15:
        vibration["velocity_ratio"] = 0.0
    frequency = float(vibration["frequency"].split()[0])
    cycles = math.exp(rng.uniform(math.log(4), math.log(400)))
    duration = float(vibration.get("start", "0").split()[0]) + cycles / frequency
    return lot.model(folder, method="march", duration=f"{duration!r} s")


def told(answer):
    """Return the duration that is said to do, s; None where none is."""
    said = [note for note in answer.notes if "would do, by the means" in note]
    return float(said[0].split()[3]) if said else None


def unsettled(members, folder):
    """Return how many are told a duration, and those that have not settled in it."""
    tried, failed = 0, []
    for member in members:
        try:
            model = body(member, folder)
            longer = told(solve(model, history=False))
            if longer is None or Timetable(lasting(model, longer)).steps > MOST_STEPS:
                continue
            then = solve(lasting(model, longer), history=False)
        except AsperityError:
            continue
        tried += 1
        if not then.settled:
            failed.append((member, longer, then.settled_by))
    return tried, failed


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("member", [22, 66, 72, 77, 94, slow(166), slow(208), 383])
def test_durations_told_by_the_law_of_asperities_do(tmp_path, member):
    """Still ones, of laws that fall, under contacts: each was told a duration that did not do."""
    assert unsettled([member], tmp_path) == (1, [])


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("member", [75, 418, 437])
def test_far_from_their_state_bodies_are_not_told_by_its_modes_alone(tmp_path, member):
    """By these it would be 39 s for asperities with an exponent of 1.5, by whose law 0.81 s does.

    And 0.32 and 1.1 s, which do not do, for those whose drive or whose asperities are taken up yet.
    """
    assert unsettled([member], tmp_path) == (1, [])


@pytest.mark.slow
def test_asperities_far_from_their_state_that_bend_ever_more_are_told_nothing_by_its_modes(
    tmp_path,
):
    """By these it would be 1.1 s, in which the halves of the window are still 8e-3 apart."""
    model = body(415, tmp_path)
    assert told(solve(model, history=False)) is None
    then = solve(lasting(model, 1.1), history=False)
    assert not then.settled


def test_asperities_far_from_a_state_below_their_limit_are_told_no_longer_than_they_take(tmp_path):
    """Its asperities bend ever more until they are there; by their limit it would be 4.8 s."""
    assert told(solve(body(282, tmp_path), history=False)) < 1.0
    assert unsettled([282], tmp_path) == (1, [])


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_durations_told_by_the_law_of_asperities_do")
@pytest.mark.parametrize("part", range(3))
def test_nearly_all_durations_told_do(tmp_path, part):
    """What does not is bent back and forth across, or does not repeat itself."""
    tried, failed = unsettled(range(150 * part, 150 * part + 150), tmp_path)
    assert tried > 50
    assert len(failed) <= 0.05 * tried, failed
