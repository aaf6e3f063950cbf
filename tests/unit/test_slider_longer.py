"""Durations that are foreseen for a march that has not settled."""

import dataclasses
import math
import random

import pytest

from asperity.casefile import read_case
from asperity.slider.fading import apart, mean_left, quarters_in_time
from asperity.slider.longer import needed
from asperity.slider.model import WINDOW_SHARE, Model
from asperity.slider.tables import TABLES
from asperity.slider.timetable import Timetable, WindowMeans


def first_that_does(model, table, means, residual):
    """The least of durations, each 2 % longer, whose window would be steady; all are looked at."""
    tau = 0.25 * table.window * table.step * quarters_in_time(means)
    begin = model.duration - table.window * table.step
    change = residual / apart(table.window * table.step / tau)
    for tried in range(1, 401):
        duration = model.duration * 1.02**tried
        span = min(model.window, WINDOW_SHARE * (duration - model.start))
        later = duration - span - begin
        left = change * math.exp(-later / tau)
        steady = left * apart(span / tau) <= 5e-4 and left * mean_left(span / tau) <= 1e-3
        if later > 0.0 and steady:
            return model.duration + 1.2 * (duration - model.duration)
    return None


@pytest.mark.parametrize("start", [0.0, 0.3])
def test_the_duration_foreseen_is_the_least_of_all_whose_window_would_be_steady(start):
    body = Model.from_case(read_case("table-4.3", TABLES, ["friction.exponent=1"]))
    vibration = body.vibration.model_copy(update={"start": start}, units="SI")
    drawn, found = random.Random(1), 0
    for _ in range(300):
        duration = start + 10.0 ** drawn.uniform(-1.0, 1.0)
        solve = body.solve.model_copy(update={"duration": duration}, units="SI")
        model = dataclasses.replace(body, vibration=vibration, solve=solve)
        fades = drawn.random() ** drawn.choice([0.1, 1.0, 5.0])
        means = [0.5 - 0.4 * fades**quarter for quarter in range(4)]
        residual = 10.0 ** drawn.uniform(-2.9, 0.0)
        if quarters_in_time(means) is None:
            continue
        table = Timetable(model)
        wanted = first_that_does(model, table, means, residual)
        if wanted is not None:
            found += 1
            come_to = WindowMeans(model, table, residual, means, broke=True)
            assert needed(come_to) == pytest.approx(wanted)
    assert found > 150


def test_quarters_that_come_and_go_with_a_ring_foresee_no_fading():
    body = Model.from_case(read_case("table-4.3", TABLES, ["vibration.start=0 s"]))
    solve = body.solve.model_copy(update={"duration": 7e-3}, units="SI")
    model = dataclasses.replace(body, solve=solve)
    means = [-0.22, -0.15, 0.35, -0.10]
    assert quarters_in_time(means) is not None
    come_to = WindowMeans(model, Timetable(model), 0.27, means, broke=True)
    assert needed(come_to) >= model.usual_duration
    # What fades steadily says by itself when it has.
    means = [0.5 - 0.4 * 0.1**quarter for quarter in range(4)]
    come_to = WindowMeans(model, Timetable(model), 0.27, means, broke=True)
    assert needed(come_to) < 0.1 * model.usual_duration
