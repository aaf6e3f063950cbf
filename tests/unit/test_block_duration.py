"""A block that has not settled says for how long to march it; left to itself it goes on so long."""

import itertools

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.block.problem import BlockProblem
from asperity.block.solution import march as block_march
from asperity.block.solution.march import BlockMarch, solve_block
from asperity.block.solution.schedule import _frame_steps
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.runs.tree import read_tree, write_tree
from asperity.slider import longer, timetable
from asperity.slider.march import march as slide

SMALL = "block.elements=[2, 2, 2]", "block.element=hex8"
# On a drive that is stretched within milliseconds.
QUICK = (
    *SMALL, "vibration.start=0 s", "solve.step=5 us", "vibration.velocity_ratio=2",
    "slider.drive_stiffness=1e7 N/m", "slider.drive_damping=2000 N s/m",
)  # fmt: skip
# And on one that is stretched for seconds, shaken slowly enough for long steps.
SLOW = (
    *SMALL, "vibration.frequency=500 Hz", "solve.step=0.1 ms", "vibration.start=10 ms",
    "friction.max_deflection=4 um", "slider.drive_velocity=0.01 mm/s",
    "slider.drive_stiffness=0.2 MN/m", "vibration.velocity_amplitude=0.5 mm/s",
)  # fmt: skip
STILL = "vibration.velocity_amplitude=0 mm/s"
# These settle in half again as long as they are marched for at first.
SOONER = ("slider.drive_velocity=0.02 mm/s",)
STILL_SOONER = "slider.drive_velocity=0.05 mm/s", "slider.drive_stiffness=0.8 MN/m"
TIMES = {"ms_per_increment", "seconds", "condense_seconds", "condensed_from_cache"}
RECORDED = ("time", "span", "drive_force", "friction", "deflection", "position", "velocity")


def problem(*settings):
    """A block marched for as long as is given, or as it takes."""
    case = read_case("block-longitudinal", case_tables(), settings)
    if not any(setting.startswith("solve.duration") for setting in settings):
        case = case.replace_values({"solve.duration": None})
    return BlockProblem.from_case(case)


def advised(answer):
    """The duration that an answer says would do."""
    (said,) = [note for note in answer.notes if note.endswith("would do, by the means")]
    return f"solve.duration={said.removeprefix('a solve.duration of ').partition(' s ')[0]} s"


class Heard(Run):
    """Calls a function between increments, and keeps the lines that are told."""

    def __init__(self, between=lambda: None):
        self.lines = []
        super().__init__(notify=self.lines.append)
        self.between = between

    def checkpoint(self, *_):
        self.between()


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("duration", "ratio"), [("1.5 ms", 2), ("1.5 ms", 6), ("2 ms", 2), slow("2 ms", 6)]
)
def test_a_block_marched_too_short_says_what_duration_would_do_and_that_does(duration, ratio):
    given = *QUICK, f"vibration.velocity_ratio={ratio}"
    short = solve_block(problem(*given, f"solve.duration={duration}"), history=False)
    assert not short.settled
    assert solve_block(problem(*given, advised(short)), history=False).settled


def test_a_block_that_has_settled_says_nothing_of_a_duration_that_would_do():
    block = solve_block(problem(*QUICK, "solve.duration=20 ms"), history=False)
    assert block.settled
    assert "would do" not in " ".join(block.notes)


def test_what_still_fades_is_judged_by_the_quarters_of_the_window(monkeypatch):
    found = []

    def still_to_come(means):
        found.append(means)
        return 0.25

    monkeypatch.setattr(timetable, "still_to_come", still_to_come)
    block = problem(*QUICK, "solve.duration=20 ms")
    answer = solve_block(block)
    assert not answer.settled
    assert "the mean still goes 0.25 of mu F_N on, as it fades" in answer.settled_by
    assert answer.steps == answer.history.time.size == 4000
    table = block.timetable
    edges = table.window_start, *table.whole_quarters, table.steps
    # A row is a step's end, and a mean that of its two ends.
    force = answer.history.drive_force / block.model.full_friction
    means = [
        0.5 * (force[one - 1 : other - 1].mean() + force[one:other].mean())
        for one, other in itertools.pairwise(edges)
    ]
    assert found[0] == pytest.approx(means, rel=1e-12)
    assert np.mean(found[0]) == pytest.approx(answer.ratio, rel=1e-2)


@pytest.mark.slow
def test_without_a_duration_a_block_goes_on_until_it_has_settled():
    run = Heard()
    block = problem(*SLOW)
    answer = BlockMarch(block, run=run).run()
    body = slide(block.model, history=False)
    assert answer.settled
    end = answer.steps * block.model.step
    assert end > 1.4 * block.model.duration == pytest.approx(1.134)
    assert (body.settled, body.steps) == (True, answer.steps)
    assert answer.notes[0] == body.notes[0]
    assert answer.notes[0] == (
        f"solve.duration is left out: the march went on to {end:.3g} s, when it had settled"
    )
    assert run.lines == [f"not settled after 0.81 s: goes on to {end:.3g} s"]
    # What was asked stands beside the answer, not what was done.
    assert "solve.duration" not in answer.inputs
    history = answer.history
    assert history.time[-1] == pytest.approx(end)
    assert (np.diff(history.time) > 0.0).all()
    assert history.span.sum() == pytest.approx(end)
    times = [frame.time for frame in answer.frames]
    assert times[0] == pytest.approx(end - 2.0 / 500.0)
    assert times[-1] == pytest.approx(end)


@pytest.mark.slow
def test_it_is_the_block_that_was_given_the_duration_at_once():
    went_on = solve_block(problem(*SLOW))
    end = went_on.steps * went_on.model.step
    at_once = solve_block(problem(*SLOW, f"solve.duration={end} s"))
    assert at_once.ratio == pytest.approx(went_on.ratio, rel=1e-9)
    assert at_once.residual == pytest.approx(went_on.residual, abs=1e-9)
    assert at_once.point_pressure == pytest.approx(went_on.point_pressure, rel=1e-9)
    assert [frame.time for frame in at_once.frames] == pytest.approx(
        [frame.time for frame in went_on.frames]
    )


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize("shaken", [(), (STILL,)])
def test_it_goes_on_to_sixteen_times_the_usual_duration_and_says_that_it_has_not_settled(
    shaken, monkeypatch
):
    monkeypatch.setattr(longer, "FARTHEST", 2.0)
    block = problem(*SLOW, *shaken)
    answer = solve_block(block)
    assert not answer.settled
    assert answer.steps * block.model.step == pytest.approx(2.0 * block.model.duration)
    assert answer.notes[0] == (
        f"solve.duration is left out: the march went on to {2.0 * block.model.duration:.3g} s, "
        "and has not settled"
    )
    longest = float(advised(answer).split("=")[1].split()[0])
    assert longest > 2.0 * block.model.duration
    times = [frame.time for frame in answer.frames]
    assert times == sorted(times)
    assert (times[0] == 0.0) == (not answer.model.vibrates)


# At the end of what it was marched for at first, 8100 increments, and after it.
@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(
    ("stop", "shaken"),
    [(8100, SOONER), (9000, SOONER), (8101, (STILL, *STILL_SOONER))],
)
def test_one_that_is_interrupted_while_it_goes_on_comes_to_the_very_same_end(
    stop, shaken, tmp_path, monkeypatch
):
    whole = solve_block(problem(*SLOW, *shaken))
    assert whole.steps > 9000
    monkeypatch.setattr(block_march, "_REPORTS", 0.0)

    def interrupt():
        if march.done == stop and not (tmp_path / "kept.npz").exists():
            write_tree(tmp_path / "kept.npz", march.state())
            raise KeyboardInterrupt

    march = BlockMarch(problem(*SLOW, *shaken), run=Heard(interrupt))
    with pytest.raises(KeyboardInterrupt):
        march.run()
    assert march.done == stop
    monkeypatch.undo()
    second = BlockMarch(problem(*SLOW, *shaken))
    second.restore(read_tree(tmp_path / "kept.npz"))
    assert (second.done, second.duration) == (stop, march.duration)
    for taken_up in (second, march):
        result = taken_up.run()
        answers = [
            {key: value for key, value in one.to_json().items() if key not in TIMES}
            for one in (whole, result)
        ]
        assert answers[0] == answers[1]
        for name in RECORDED:
            ours, theirs = getattr(result.history, name), getattr(whole.history, name)
            assert np.array_equal(ours, theirs), name
        assert [frame.time for frame in result.frames] == [frame.time for frame in whole.frames]


@pytest.mark.parametrize("cycles", [1, 2, 3, 4, 5, 9, 10, 150])
def test_quarters_of_a_window_are_of_whole_cycles_where_there_are_four(cycles):
    table = problem(*SLOW, f"solve.duration={0.01 + cycles * 2e-3 / 0.75 + 2e-4} s").timetable
    assert table.cycles == cycles
    edges = table.window_start, *table.whole_quarters, table.steps
    spans = np.diff(edges) * table.step * 500.0
    assert (spans > 0.0).all()
    if cycles > 3:
        assert spans == pytest.approx(np.round(spans), abs=1e-9)
        assert max(spans) - min(spans) <= 2.0
    assert spans.sum() == pytest.approx(cycles)
    assert all(one < other for one, other in itertools.pairwise(edges))


def test_frames_are_of_the_last_two_cycles_to_the_last_step():
    made = problem(*QUICK, "solve.duration=20 ms")
    steps = _frame_steps(made)
    assert steps[-1] == made.timetable.steps
    cycles = made.model.frequency * made.timetable.step * (steps[-1] - steps[0])
    assert cycles == pytest.approx(2.0, abs=0.01)
    assert np.ptp(np.diff(steps)) <= 1
