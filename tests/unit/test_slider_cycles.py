"""Marches whose motion repeats itself after cycles that the halves of their window have in part.

What those cycles make the halves differ by is not held against them; anything else is.
"""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, chance
from asperity.slider.longer import lasting
from asperity.slider.timetable import Timetable, WindowMeans

BODY = "friction.exponent=1", "vibration.start=0 s", "slider.drive_stiffness=100 MN/m"
SWING = 0.02  # that a cycle's ratio goes up and down by, in turns
RATIO = 0.6


def window_of(*settings, cycles=9, **told):
    """A window of an odd number of cycles, and what two in turns make its halves differ by."""
    body = Model.from_case(read_case("table-4.3", TABLES, [*BODY, *settings]))
    frequency = body.frequency or 10e3
    model = lasting(body, (cycles + 0.5) / frequency / 0.75)
    table = Timetable(model)
    # The first of the next cycles is above: of the nine before it five are below.
    differ = (-SWING if cycles % 2 else 0.0) / (cycles - cycles // 2)
    told = {"change": differ, "quarters": [RATIO] * 4, "broke": True} | told
    return WindowMeans(model, table, **told)


@pytest.fixture
def cycles(monkeypatch):
    """Give the next cycles of any body."""
    means = [RATIO + SWING, RATIO - SWING] * 18

    def marched(_, count):
        assert count == len(means)
        return means

    monkeypatch.setattr(chance, "at_the_end", lambda body, table: body)
    monkeypatch.setattr(chance, "ratios_of", marched)
    return means


def again(window, ratio=RATIO):
    return chance.comes_again(lambda: None, window, ratio)


def test_halves_that_differ_by_what_cycles_in_turns_make_have_settled(cycles):
    window = window_of()
    assert window.table.cycles == 9
    assert window.residual == pytest.approx(4e-3)
    standing, means = again(window)
    assert standing.settled
    assert standing.settled_by.startswith(
        "the motion repeats itself after 2 cycles, whose mean ratio is 0.6;"
    )
    assert means == cycles


@pytest.mark.parametrize("lasting_change", [-9e-3, -1.1e-3, 1.1e-3, 8e-3])
def test_a_change_that_lasts_beside_theirs_is_held_against_it(cycles, lasting_change):
    """Of 8e-3 the halves differ as much as by the cycles alone, the other way."""
    window = window_of()
    assert again(window._replace(change=window.change + lasting_change)) is None
    assert again(window._replace(change=window.change + 0.1 * lasting_change)) is not None


def test_a_mean_that_is_far_from_that_of_the_cycles_is_held_against_it(cycles):
    window = window_of()
    for off in (-2.1e-3, 2.1e-3):
        assert again(window, RATIO + off) is None
        assert again(window, RATIO + 0.9 * off) is not None


def test_cycles_that_do_not_come_again_are_no_reason(cycles):
    window = window_of()
    cycles[:] = RATIO + SWING * np.random.default_rng(1).normal(size=36)
    assert again(window) is None
    cycles[:] = [RATIO] * 36
    assert again(window) is None
    assert again(window._replace(change=0.0)) is None


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (("vibration.velocity_ratio=0",), {}),
        (("solve.scheme=two-phase",), {}),
        (("friction.exponent=2", "vibration.velocity_ratio=0.5"), {}),
        # The drive gains more in the window than what is left tells.
        (("slider.drive_stiffness=96 kN/m", "slider.drive_damping=10 kN s/m"), {}),
        ((), {"quarters": [0.5, 0.55, 0.58, 0.59]}),
        (("slider.lateral=free",), {"across": 0.1}),
        (("vibration.ramp=1 s",), {}),
    ],
)
def test_what_lacks_anything_else_is_not_settled_by_its_cycles(cycles, settings, told):
    assert again(window_of(*settings, **told)) is None


def test_cycles_that_are_known_are_not_marched_again(monkeypatch):
    window = window_of()
    monkeypatch.setattr(chance, "ratios_of", lambda *_: pytest.fail("marched"))
    off, why = chance.scatter(None, window.table, RATIO, [RATIO, RATIO + 1e-3] * 18)
    assert off == pytest.approx(5e-4)
    assert why.startswith("the motion repeats itself after 2 cycles")
