import contextlib
import dataclasses
import functools
import math
import signal

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.casefile import read_case
from asperity.errors import ConvergenceError, InputError
from asperity.results.ledger import guard
from asperity.runs import Interrupted, Run
from asperity.runs.tree import read_tree, write_tree
from asperity.slider import TABLES, Model, Solve, Stopped, solve, solve_many
from asperity.slider.kernels import condense
from asperity.slider.longer import until_settled
from asperity.slider.march import March, march, march_key

LAWS = ["split", "unsplit", "vector"]
EXPONENTS = [0, 0.5, 1, 1.5, 2]
RIGID = {"slider.drive_stiffness": None, "slider.drive_damping": None}
STILL = "vibration.velocity_ratio=0"


def body(name, *settings, **values):
    return Model.from_case(read_case(name, TABLES, settings).replace_values(values))


def solved(name, *settings, history=False, **values):
    return solve(body(name, *settings, **values), history=history)


def refusal(*settings, error=InputError):
    with pytest.raises(error) as raised:
        solved(*settings)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


@pytest.fixture(scope="module")
def every_step():
    """A march short enough for every step to be kept."""
    settings = "vibration.start=1 ms", "vibration.direction=40 deg", "solve.duration=3.5 ms"
    return solved("table-4.4", *settings, "friction.law=vector", history=True)


def test_the_motion_obeys_newtons_law(every_step):
    history, model = every_step.history, every_step.model
    acceleration = np.diff(history.velocity, axis=0) / 1e-6
    force = -history.friction[1:]
    force[:, 0] += history.drive_force[1:]
    assert model.slider.mass * acceleration == pytest.approx(force, abs=1e-7)


def test_positions_velocities_and_drive_force_belong_together(every_step):
    history = every_step.history
    ways = np.diff(history.position, axis=0)
    assert np.abs(ways - history.velocity[:-1] * 1e-6).max() <= 1e-18
    stretch = 0.5e-3 * history.time - history.position[:, 0]
    assert history.drive_force == pytest.approx(96068.0 * stretch, rel=1e-9)


def test_friction_is_the_deflections(every_step):
    history, friction = every_step.history, every_step.model.friction
    stiffness = friction.stiffness(50.8)
    assert np.abs(history.friction - stiffness * history.deflection).max() <= 1e-12


def test_the_ratio_is_the_mean_drive_force_of_whole_cycles_at_the_end(every_step):
    # Three quarters of what follows the start, cut to whole cycles: 5 of 3 kHz.
    assert every_step.cycles == 5
    force = every_step.history.drive_force[-round(5e6 / 3000) - 1 :]
    mean = np.trapezoid(force) / (len(force) - 1)
    assert every_step.drive_force == pytest.approx(mean, rel=1e-12)
    assert every_step.ratio == pytest.approx(mean / 5.08, rel=1e-12)
    assert every_step.friction_max[0] == every_step.history.friction[-1667:, 0].max()
    assert every_step.friction_min[0] == every_step.history.friction[-1667:, 0].min()


def test_the_window_is_the_last_four_tenths_of_a_second_in_whole_cycles():
    assert solved("table-4.3").cycles == 1600
    # 20 periods of the ringing of 2 kg on 96068 N/m last 0.5733 s.
    assert solved("table-4.4").cycles == math.floor(40 * math.pi * math.sqrt(2 / 96068) * 3000)


def test_the_residual_is_the_change_from_half_to_half_of_the_window():
    settling = solved("table-4.3", "solve.duration=0.2 s")
    settled = solved("table-4.3")
    assert settling.residual > 1e-2
    assert settled.residual < 1e-6


@pytest.mark.slow
def test_the_breakaway_is_the_first_time_at_full_force():
    answer = solved("table-4.3", "solve.duration=0.2 s", history=True)
    history = answer.history
    first = np.flatnonzero(history.drive_force >= 5.5)[0]
    assert history.time[first - 1] < answer.breakaway_time <= history.time[first] + 1e-12
    fine = solved("table-4.3", "solve.duration=0.2 s", "solve.step=0.25 us")
    assert fine.breakaway_time == pytest.approx(answer.breakaway_time, abs=1e-6)


@pytest.mark.slow
def test_a_body_that_never_needs_full_force_does_not_break_away():
    assert solved("table-4.3", "vibration.start=0 s").breakaway_time is None
    assert solved("table-4.1-L4").breakaway_time is None


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", LAWS)
def test_vibration_from_the_first_moment_ends_in_the_same_state(law):
    early = solved("table-4.3", "vibration.start=0 s", f"friction.law={law}")
    late = solved("table-4.3", f"friction.law={law}")
    assert early.ratio == pytest.approx(late.ratio, rel=1e-3)


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("model", "case"), grid(["dahl", "coulomb", "lugre"], ["table-4.3", "table-4.4"])
)
def test_without_vibration_the_drive_force_is_full_friction(case, model):
    answer = solved(case, STILL, f"friction.model={model}")
    assert answer.cycles == 0
    assert answer.ratio == pytest.approx(1.0, abs=1e-3)
    ledger = answer.ledger
    assert (ledger.vibration, ledger.untransferred, ledger.damping) == (0.0, 0.0, 0.0)
    assert ledger.residual < 1e-9
    # The drive rings on, and the window is no whole number of its periods.
    assert ledger.friction == pytest.approx(answer.static_drive_force * 0.5e-3, rel=2e-3)


def test_a_body_without_a_vibration_table_is_one_at_rest():
    bare = body("table-4.3", "solve.duration=0.3 s")
    bare = Model(bare.slider, bare.friction, None, bare.solve)
    still = solved("table-4.3", "solve.duration=0.3 s", STILL)
    assert solve(bare, history=False).ratio == still.ratio


def test_a_longitudinal_vibration_moves_nothing_sideways():
    history = solved("table-4.3", "solve.duration=0.2 s", history=True).history
    assert np.all(history.position[:, 1] == 0.0)
    assert np.all(history.friction[:, 1] == 0.0)


@pytest.mark.ordinary(4)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("theta", [0, 50, 90, 230])
def test_to_a_guided_body_on_a_rigid_drive_it_is_the_same_whoever_is_shaken(theta, law):
    settings = "slider.lateral=guided", f"friction.law={law}", "solve.duration=0.2 s"
    base = solved("table-4.4", *settings, f"vibration.direction={theta} deg", **RIGID)
    # The body's motion is the base's turned round.
    moved = solved(
        "table-4.4", *settings, f"vibration.direction={theta + 180} deg",
        "vibration.applied_to=body", **RIGID,
    )  # fmt: skip
    assert moved.ratio == pytest.approx(base.ratio, rel=1e-11)
    assert moved.ledger.vibration == pytest.approx(base.ledger.vibration, rel=1e-10)


@pytest.mark.ordinary(5)
@pytest.mark.parametrize(("theta", "exponent", "law"), grid([0, 60], EXPONENTS, LAWS, ordinary=4))
def test_every_exponent_marches_inside_the_limit(exponent, law, theta):
    answer = solved(
        "table-4.4", f"friction.law={law}", f"friction.exponent={exponent}",
        f"vibration.direction={theta} deg", "vibration.start=0 s", "solve.duration=0.1 s",
        history=True,
    )  # fmt: skip
    size = np.hypot(*answer.history.deflection.T) / 75.49e-9
    assert size.max() <= 1.0 + 1e-12
    assert 0.0 < answer.ratio < 1.0
    assert answer.ledger.residual < 1e-9


@pytest.mark.ordinary(6)
@pytest.mark.parametrize(
    ("waveform", "applied_to", "lateral", "law"),
    grid(["sine", "triangle", "square"], ["base", "body"], ["free", "guided"], LAWS, ordinary=5),
)
def test_the_power_ledger_closes(waveform, applied_to, lateral, law):
    settings = [
        f"friction.law={law}", f"slider.lateral={lateral}", f"vibration.applied_to={applied_to}",
        f"vibration.waveform={waveform}", "vibration.direction=35 deg", "solve.duration=0.2 s",
        "slider.drive_damping=20 N s/m",
    ]  # fmt: skip
    if waveform == "square":
        settings.append("vibration.rise_time=40 us")
    ledger = solved("table-4.4", *settings).ledger
    assert ledger.residual < 1e-9
    assert ledger.damping > 0.0
    assert ledger.friction > ledger.vibration > 0.0


def test_more_of_the_lateral_vibration_means_more_power_and_less_drive_force():
    answers = [
        solved("table-4.4", f"friction.transfer={share}", "solve.duration=0.4 s")
        for share in (0.0, 0.4, 0.71, 1.0)
    ]
    assert np.all(np.diff([answer.ratio for answer in answers]) < 0.0)
    assert np.all(np.diff([answer.ledger.vibration for answer in answers]) > 0.0)
    assert answers[0].ratio == pytest.approx(1.0, abs=2e-2)


@pytest.mark.slow
def test_the_untransferred_share_is_named_and_does_no_work():
    # Transverse, friction works on eta of the base's motion; on the rest it would do (1-eta)/eta.
    part = solved("table-4.4").ledger
    assert part.untransferred == pytest.approx(part.vibration * 0.29 / 0.71, rel=1e-9)
    assert part.residual < 1e-9
    assert solved("table-4.4", "friction.transfer=1").ledger.untransferred == 0.0
    assert solved("table-4.4", "vibration.direction=0 deg").ledger.untransferred == 0.0


def test_a_step_that_is_divided_is_named_and_answers_as_the_smaller_step():
    settings = "vibration.velocity_ratio=20", "solve.duration=0.3 s"
    divided = solved("table-4.3", *settings, "solve.step=4 us")
    parts = divided.substeps
    assert parts > 1
    assert divided.steps == 75_000 * parts
    assert any(f"divided by {parts}" in note for note in divided.notes)
    smaller = solved("table-4.3", *settings, f"solve.step={4 / parts!r} us")
    assert smaller.substeps == 1
    assert not any("divided" in note for note in smaller.notes)
    assert divided.ratio == pytest.approx(smaller.ratio, rel=1e-9)
    assert divided.ledger.friction == pytest.approx(smaller.ledger.friction, rel=1e-9)


def test_a_stiff_contact_is_divided_until_the_march_is_stable():
    answer = solved(
        "table-4.3", "friction.max_deflection=1 nm", "solve.step=5 us", "solve.duration=0.2 s",
        "vibration.velocity_ratio=2",
    )  # fmt: skip
    assert answer.substeps > 10
    assert 0.0 < answer.ratio < 1.0
    assert answer.ledger.residual < 1e-6


def test_two_phase_numbers_that_leave_the_finite_are_reported():
    # An overshoot of the limit that grows, below the bound of the linear stability.
    shaken = (
        "table-4.4", "solve.scheme=two-phase", "friction.exponent=2",
        "vibration.velocity_ratio=30", "vibration.direction=0 deg",
    )  # fmt: skip
    text = refusal(*shaken, "solve.step=9.7 us", error=ConvergenceError)
    assert "in steps of 9.7e-06 s; give no solve.step, to have it chosen" in text
    case = read_case(shaken[0], TABLES, shaken[1:]).replace_values({"solve.step": None})
    assert solve(Model.from_case(case), history=False).settled


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["solve.duration=0.1401 s"], "it must be at least 0.14"),
        (["solve.duration=0.1 s"], "it must be at least 0.14"),
        (["solve.duration=5 us", STILL], "at least 8 steps"),
        (["solve.step=20 us"], "too coarse for the vibration of 4000 Hz"),
        (["slider.drive_velocity=-0.5 mm/s"], "it must be positive"),
    ],
)
def test_what_cannot_be_marched_is_refused_in_one_line(settings, message):
    assert message in refusal("table-4.3", *settings)


def test_a_rigid_drive_feels_the_friction_itself():
    answer = solved(
        "table-4.4", "slider.lateral=guided", "solve.duration=0.2 s", history=True, **RIGID
    )
    history = answer.history
    assert np.array_equal(history.drive_force, history.friction[:, 0])
    assert answer.drive_force == pytest.approx(answer.friction_mean[0], rel=1e-14)
    assert history.velocity[:, 0] == pytest.approx(0.5e-3, rel=1e-12)


def test_the_history_ends_with_the_march_and_shows_its_last_cycles_step_by_step():
    history = solved("table-4.3", history=True).history
    assert np.all(np.diff(history.time) > 0.0)
    assert history.time[-1] == pytest.approx(1.0, rel=1e-12)
    assert np.diff(history.time[-1000:]) == pytest.approx(1e-6, rel=1e-6)
    assert len(history.time) < 10_000


@pytest.mark.slow
def test_the_history_changes_nothing():
    with_history = solved("table-4.4", history=True)
    without = solved("table-4.4")
    assert without.history is None
    assert without.ratio == pytest.approx(with_history.ratio, rel=1e-12)
    assert without.breakaway_time == with_history.breakaway_time


def test_rigid_friction_holds_a_body_until_the_drive_pulls_hard_enough():
    history = solved(
        "table-4.3", "friction.model=coulomb", STILL, "solve.duration=0.2 s", history=True
    ).history
    sticking = history.time < 5.5 / (96068.0 * 0.5e-3) - 1e-5
    assert np.all(np.abs(history.velocity[sticking]) < 1e-12)
    assert np.abs(history.friction[sticking, 0] - history.drive_force[sticking]).max() <= 1e-9
    slipping = history.velocity[:, 0] > 1e-7
    assert history.friction[slipping, 0] == pytest.approx(5.5, rel=1e-9)


def test_friction_across_has_its_own_greatest_and_least():
    guided = "vibration.direction=45 deg", "slider.lateral=guided"
    result = solved("table-4.4", *guided, history=True)
    across = result.history.friction[result.history.time > 0.99, 1]
    assert result.friction_max[1] == pytest.approx(across.max(), rel=1e-3)
    assert result.friction_min[1] == pytest.approx(across.min(), rel=1e-3)
    assert result.friction_max[1] < 0.8 * -result.friction_min[1]


def test_a_breakaway_after_the_window_has_begun_is_found():
    late = solved("table-4.3", "solve.duration=160 ms", "vibration.velocity_ratio=0")
    assert late.breakaway_time == pytest.approx(0.11526, abs=1e-5)


def test_a_short_window_and_an_unsteady_mean_are_named():
    result = solved("table-4.3", "solve.duration=0.16 s")
    assert any("no room for the usual 0.4 s" in note for note in result.notes)
    assert any("not steady" in note for note in result.notes)


def test_an_endless_march_is_refused():
    with pytest.raises(InputError, match=r"a march takes at most 1e\+10"):
        solved("table-4.3", "solve.duration=1e9 s")


def test_a_march_without_history_is_stopped_from_outside():
    case = read_case("table-4.3", TABLES, ["solve.duration=100 s"])
    with pytest.raises(Stopped):
        march(Model.from_case(case), history=False, stop=np.ones(1, dtype=np.int64))


def aliased(*settings):
    """A march whose stretches hold whole cycles: 20 kHz seen every 0.2 ms."""
    return solved(
        "table-4.3", "vibration.frequency=20 kHz", "vibration.velocity_ratio=20",
        "vibration.start=0 s", "solve.step=0.5 us", "solve.duration=0.8 s", *settings, history=True,
    )  # fmt: skip


@pytest.mark.slow
def test_the_means_of_the_history_are_the_means_of_the_result():
    answer = aliased()
    history = answer.history
    assert history.span.sum() == pytest.approx(0.8, rel=1e-12)
    window = history.time > 0.4
    for stored, mean in (
        (history.friction[:, 0], answer.friction_mean[0]),
        (history.drive_force, answer.drive_force),
    ):
        found = np.average(stored[window], weights=history.span[window])
        assert found == pytest.approx(mean, abs=1e-5 * answer.static_drive_force)


@pytest.mark.slow
def test_the_history_shows_what_a_stretch_swings_through():
    answer = aliased()
    history = answer.history
    window = history.time > 0.4
    assert history.friction_max[window, 0].max() == answer.friction_max[0]
    assert history.friction_min[window, 0].min() == answer.friction_min[0]
    for name in ("drive_force", "friction", "deflection", "position", "velocity"):
        least, mean, greatest = (getattr(history, name + end) for end in ("_min", "", "_max"))
        assert np.all(least <= mean)
        assert np.all(mean <= greatest)
    long = history.span > 1e-4
    assert np.all(history.friction_max[long, 0] - history.friction_min[long, 0] > 5.0)


def test_a_stretch_of_any_length_is_condensed_to_mean_least_and_greatest():
    drawn = np.random.default_rng(5).normal(size=(13, 9))
    for length in range(1, 14):
        nodes, rows = drawn[:length], np.empty((3, 9))
        condense(nodes, *rows)
        assert rows[0] == pytest.approx(nodes.mean(axis=0), rel=1e-13, abs=1e-15)
        assert rows[1].tolist() == nodes.min(axis=0).tolist()
        assert rows[2].tolist() == nodes.max(axis=0).tolist()


def test_a_mean_over_a_stretch_stands_at_its_mean_time():
    history = solved("table-4.3", "vibration.velocity_ratio=0", history=True).history
    stretch = 0.5e-3 * history.time - history.position[:, 0]
    assert history.drive_force == pytest.approx(96068.0 * stretch, rel=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(
    "settings",
    [
        [],
        ["friction.model=coulomb"],
        ["friction.model=lugre", "friction.contact_damping=20 N s/m"],
        ["solve.scheme=two-phase", "friction.law=split"],
    ],
)
def test_a_march_that_is_kept_goes_on_bit_for_bit(settings, tmp_path, monkeypatch):
    monkeypatch.setattr("asperity.slider.march._STRETCH", 7000)
    model = body("table-4.4", "solve.duration=0.2 s", *settings)
    whole = until_settled(model, March(model, record=True))
    kept = {}

    class Halting(Run):
        def checkpoint(self, done, total, state=None, what="steps"):
            if state is not None and done not in kept and len(kept) < 40:
                write_tree(tmp_path / "kept.npz", state())
                kept[done] = total
                raise Interrupted("kept")

    answer = None
    while answer is None:
        march = March(model, record=True, run=Halting())
        if kept:
            march.restore(read_tree(tmp_path / "kept.npz"))
        with contextlib.suppress(Interrupted):
            answer = until_settled(model, march)
    assert len(kept) > 20
    numbers = [one.to_json() | {"seconds": 0.0} for one in (answer, whole)]
    assert numbers[0] == numbers[1]
    for field in dataclasses.fields(whole.history):
        here, there = (getattr(one.history, field.name) for one in (answer, whole))
        assert np.array_equal(here, there), field.name


def test_the_window_of_a_slow_vibration_holds_two_of_its_cycles():
    answer = solved(
        "table-4.3", "vibration.frequency=1 Hz", "solve.duration=6 s", "solve.step=20 us",
        "friction.max_deflection=100 um",
    )  # fmt: skip
    assert answer.cycles == 2
    assert answer.ledger.residual < 1e-9


def test_a_damper_that_drowns_the_friction_in_its_rounding_is_refused():
    text = refusal("table-4.3", "slider.drive_damping=1e20 N s/m")
    assert "must be at most 1.1e+11 N s/m" in text
    assert "leave slider.drive_stiffness out" in text
    assert "must be at most" in refusal("table-4.3", "slider.drive_damping=1e29 N s/m")


def test_up_to_that_bound_a_stronger_damper_comes_nearer_to_a_rigid_drive():
    settings = "slider.lateral=guided", "vibration.start=0.1 s", "solve.duration=0.2 s"
    rigid = solved("table-4.3", *settings, **RIGID)
    for damping in ("1e9", "1.1e11"):
        damped = solved("table-4.3", *settings, f"slider.drive_damping={damping} N s/m")
        assert damped.ratio == pytest.approx(rigid.ratio, rel=1e-5)
        assert damped.ledger.residual < 1e-3


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (["solve.duration=1e29 s"], "a march takes at most"),
        (["solve.step=1e-320 s"], "a march takes at most"),
        (
            ["friction.tangential_stiffness=3.3e23 MN/m", "friction.mu=3.3e-299"],
            "friction.tangential_stiffness is 3.3e+29 N/m",
        ),
    ],
)
def test_numbers_out_of_all_proportion_are_refused_in_one_line(settings, message):
    assert message in refusal("table-4.3", *settings)


def test_ctrl_c_keeps_a_march_and_the_same_call_goes_on_from_there(tmp_path, monkeypatch):
    monkeypatch.setattr("asperity.slider.march._STRETCH", 20_000)
    model = body("table-4.3", "solve.duration=0.2 s")
    whole = march(model)

    def press(done, total):
        if 0.4 * total < done < 0.6 * total:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(Interrupted, match="the same command goes on from"):
        march(model, run=Run(progress=press, folder=tmp_path, stem="slide"))
    seen = []
    again = march(
        model, run=Run(progress=lambda done, _: seen.append(done), folder=tmp_path, stem="slide")
    )
    assert min(seen) > 0.4 * whole.steps
    assert again.to_json() | {"seconds": 0.0} == whole.to_json() | {"seconds": 0.0}
    assert np.array_equal(again.history.friction, whole.history.friction)


@pytest.mark.slow
def test_a_march_left_in_its_finer_step_goes_on_from_there(tmp_path, monkeypatch):
    monkeypatch.setattr("asperity.slider.march._STRETCH", 20_000)
    monkeypatch.setattr("asperity.slider.step_error.WANTED", 1e-4)
    settings = "friction.exponent=0", "vibration.direction=70 deg", "vibration.velocity_ratio=3"
    model = body("table-4.3", "friction.law=unsplit", *settings)
    model = dataclasses.replace(model, solve=Solve(duration="0.2 s"))
    totals = []
    whole = march(model, run=Run(progress=lambda _, total: totals.append(total)))
    assert whole.model.finer > 1
    first, *_, last = totals
    assert last > first

    def press(done, total):
        if total == last and done > 0.5 * total:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(Interrupted, match="the same command goes on from"):
        march(model, run=Run(progress=press, folder=tmp_path, stem="slide"))
    seen = []
    again = march(
        model, run=Run(progress=lambda *at: seen.append(at), folder=tmp_path, stem="slide")
    )
    assert {total for _, total in seen} == {last}
    assert min(done for done, _ in seen) > 0.5 * last
    assert again.to_json() | {"seconds": 0.0} == whole.to_json() | {"seconds": 0.0}


def test_a_batch_whose_powers_do_not_balance_leaves_the_error_in_its_place(monkeypatch):
    monkeypatch.setattr("asperity.slider.summary.guard", functools.partial(guard, most=-1.0))
    monkeypatch.setattr("asperity.results.ledger._ROUNDING", -1.0)
    model = body("table-4.3", "solve.duration=0.15 s")
    for answer in solve_many([model, model]):
        assert isinstance(answer, ConvergenceError)
        assert answer.reached["ratio"] > 0.0


def test_a_march_of_another_period_from_the_same_file_is_another_march(tmp_path):
    keys = set()
    for frequency in (4000.0, 2000.0):
        cycles = np.linspace(0.0, 1.0, 65)
        rows = zip(cycles / frequency, 1e-6 * np.sin(2.0 * math.pi * cycles), strict=True)
        (tmp_path / "wave.csv").write_text("".join(f"{t:.17g},{u:.17g}\n" for t, u in rows))
        case = read_case("table-4.3", TABLES)
        vibration = case["vibration"].model_copy(
            update={"waveform": "sampled", "samples": tmp_path / "wave.csv", "frequency": None}
        )
        slider, friction, solve_by = (case[name] for name in ("slider", "friction", "solve"))
        keys.add(march_key(Model(slider, friction, vibration, solve_by), history=False))
    assert len(keys) == 2
