"""The elastic block: at rest under its loads, pulled, shaken, stopped and taken up again."""

import dataclasses
import itertools
import types

import numpy as np
import pytest
from apparatus.grid import grid, slow

from asperity.block.problem import BlockProblem
from asperity.block.solution import march as block_march
from asperity.block.solution.check import check
from asperity.block.solution.march import BlockMarch, march_key, solve_block
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.increment import IncrementSolver
from asperity.contact.increment.equations import Increment
from asperity.contact.interface.normal import NormalLaw, pressure
from asperity.contact.motion import hht, steps
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.system import System
from asperity.errors import ConvergenceError, InputError
from asperity.runs import Run
from asperity.runs.checkpoint_file import CheckpointFile
from asperity.runs.tree import read_tree, write_tree
from asperity.slider.march import march as slide

SMALL = ("block.elements=[2, 2, 2]", "block.element=hex8")
SHAKEN = ("vibration.start=0 s", "solve.step=5 us", "solve.duration=1.5 ms")
STIFF = ("slider.drive_stiffness=1e7 N/m", "slider.drive_damping=2000 N s/m")


@pytest.fixture(autouse=True)
def _told_of_every_increment(monkeypatch):
    monkeypatch.setattr(block_march, "_REPORTS", 0.0)


class Told(Run):
    """Calls a function between increments."""

    def __init__(self, between):
        super().__init__()
        self.between = between

    def checkpoint(self, *_):
        self.between()


def problem(*settings, case="block-longitudinal"):
    return BlockProblem.from_case(read_case(case, case_tables(), [*SMALL, *SHAKEN, *settings]))


def at_rest(block):
    return rest_under_load(block.system, block.loads)


def centre_of_pressure(block, pressure):
    weight = pressure * block.system.weights
    return weight @ block.surface.points.reshape(-1, 3)[:, :2] / weight.sum()


@pytest.mark.parametrize("mass", ["0.5 kg", "5.6 kg"])
def test_gravity_and_pressure_together_press_with_the_normal_force(mass):
    block = problem(f"slider.mass={mass}")
    state = at_rest(block)
    assert state.forces.normal == pytest.approx(55.0, rel=1e-9)
    assert state.forces[:2] == pytest.approx([0.0, 0.0], abs=1e-6)


@pytest.mark.parametrize("normal", ["linear", "two-stage", "hard"])
def test_at_rest_the_pressure_is_symmetric_about_both_axes(normal):
    block = problem(f"contact.normal={normal}")
    state = at_rest(block)
    assert centre_of_pressure(block, state.contact.pressure) == pytest.approx([0, 0], abs=1e-8)
    assert state.contact.active == state.contact.pressure.size


@pytest.mark.slow
def test_a_block_pulled_at_half_its_height_leans_on_its_leading_edge():
    block = problem(*STIFF, "vibration.velocity_ratio=0", "solve.duration=8 ms")
    march = BlockMarch(block)
    result = march.run()
    state = march.stepper.state
    body = slide(block.model)
    assert result.ratio == pytest.approx(1.0, rel=1e-3)
    assert result.ratio == pytest.approx(body.ratio, rel=1e-4)
    assert result.breakaway_time == pytest.approx(body.breakaway_time, rel=1e-2)
    # The moments of drive and friction about the base: h/2 F_d = x_p F_N.
    lean = 0.5 * block.block.size[2] * state.drive.force / state.forces.normal
    assert centre_of_pressure(block, state.contact.pressure)[0] == pytest.approx(lean, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("static", [0.1, 0.15])
@pytest.mark.parametrize("shaken", [0.0, 0.2])
def test_a_block_under_lugre_breaks_away_when_the_sliding_body_does(static, shaken):
    block = problem(
        "friction.model=lugre", f"friction.static_mu={static}",
        "friction.stribeck_velocity=1 mm/s", "friction.contact_damping=300 N s/m",
        "friction.viscous_damping=0.4 N s/m", f"vibration.velocity_ratio={shaken}",
        "vibration.start=2 ms", "vibration.direction=45 deg", "solve.step=10 us",
        "slider.drive_stiffness=1e6 N/m", "solve.duration=25 ms",
    )  # fmt: skip
    result, body = solve_block(block, history=False), slide(block.model, history=False)
    # Long after the drive pulls with mu F_N where static friction holds more.
    pulls = block.model.full_friction / (1e6 * 0.5e-3)
    assert body.breakaway_time > (1.3 if static > 0.1 else 1.0) * pulls
    assert result.breakaway_time == pytest.approx(body.breakaway_time, rel=5e-3)


CLOSING = {
    "longitudinal": (),
    "coupled": ("vibration.direction=45 deg",),
    "unsplit": ("vibration.direction=45 deg", "friction.law=unsplit"),
    "vector, exponent 2": (
        "vibration.direction=45 deg", "friction.law=vector", "friction.exponent=2",
    ),
    "two-phase": (
        "vibration.direction=45 deg", "solve.scheme=two-phase", "solve.step=2 us",
    ),
    "coulomb": ("vibration.direction=45 deg", "friction.model=coulomb"),
    "lugre": (
        "friction.model=lugre", "friction.static_mu=0.15", "friction.stribeck_velocity=1 mm/s",
        "friction.contact_damping=300 N s/m", "friction.viscous_damping=0.4 N s/m",
    ),
    "stiffness kept": ("friction.keeps=stiffness", "vibration.direction=45 deg"),
    "two stages": ("contact.normal=two-stage", "vibration.direction=45 deg"),
    "hard": ("contact.normal=hard",),
    "square wave": ("vibration.waveform=square", "vibration.rise_time=30 us"),
    "triangle wave": ("vibration.waveform=triangle", "vibration.direction=30 deg"),
    "modes": ("block.modes=4", "vibration.direction=45 deg"),
    "dashpot": STIFF,
    "guided": ("slider.lateral=guided", "vibration.direction=45 deg"),
    "body": ("vibration.applied_to=body", "vibration.direction=45 deg"),
}  # fmt: skip
LIKE_OTHERS = {"coupled", "square wave", "triangle wave", "dashpot", "guided", "body"}


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("name", [slow(each) if each in LIKE_OTHERS else each for each in CLOSING])
def test_the_power_ledger_closes(name):
    result = solve_block(problem(*CLOSING[name]), history=False)
    assert result.ledger.residual < 1e-4
    assert result.ledger.friction > 0.0
    assert result.ledger.vibration > 0.0
    assert result.to_json()["unconverged"] == 0


def test_increments_solved_poorly_leave_the_ledger_open(monkeypatch):
    exact = solve_block(problem(), history=False).ledger
    march = BlockMarch(problem(), history=False)
    assert march.stepper.state.time == 0.0
    prepare = System.increments

    def poorly(system, compliance, step):
        return dataclasses.replace(prepare(system, compliance, step), tolerance=1e-2)

    monkeypatch.setattr(System, "increments", poorly)
    result = march.run()
    assert result.ledger.residual > 1e-3 > 10.0 * exact.residual
    assert 1e-3 < result.residual_increment_max <= 1e-2


@pytest.mark.slow
def test_increments_that_end_above_their_tolerance_are_counted_also_over_an_interruption(
    monkeypatch, tmp_path
):
    prepare = System.increments

    def beyond_the_digits(system, compliance, step):
        return dataclasses.replace(prepare(system, compliance, step), tolerance=1e-17)

    monkeypatch.setattr(System, "increments", beyond_the_digits)
    # Forces that the last digits of positions make, N, beside the load of 55 N.
    monkeypatch.setattr(Increment, "floor", 5e-7)
    kept = "solve.duration=0.8 ms"
    whole = solve_block(problem(kept), history=False)
    assert whole.unconverged == whole.increments == 160
    assert 1e-17 < whole.residual_increment_max < 1e-8
    answer = whole.to_json()
    assert answer["unconverged"] == 160
    assert answer["residual_increment_max"] == whole.residual_increment_max
    assert "160 increments ended above the tolerance" in " ".join(whole.notes)
    assert whole.to_dataset().attrs["unconverged"] == 160
    stopped(problem(kept), 70, tmp_path / "kept.npz")
    second = BlockMarch(problem(kept), history=False)
    second.restore(read_tree(tmp_path / "kept.npz"))
    assert second.stepper.unconverged == 70
    result = second.run()
    assert (result.unconverged, result.residual_increment_max) == (
        160, whole.residual_increment_max,
    )  # fmt: skip


@pytest.mark.slow
def test_a_step_that_does_not_resolve_the_bounce_is_integrated_for_impacts_and_says_so():
    block = problem()
    longest = block.system.resolving_step
    assert block.system.bounce * longest == pytest.approx(2.0)
    fine = solve_block(block, history=False)
    assert fine.to_json()["newmark_beta"] == hht.coefficients()[0]
    assert not fine.to_json()["impact_integration"]
    assert "bounces" not in " ".join(fine.notes)
    coarse = solve_block(problem("slider.mass=1 g"), history=False)
    assert coarse.to_json()["newmark_beta"] == hht.coefficients(impact=True)[0]
    assert coarse.to_json()["impact_integration"]
    resolving = coarse.problem.system.resolving_step
    (told,) = (note for note in coarse.notes if "bounces on its contact" in note)
    assert f"a solve.step of {resolving:.2g} s resolves it" in told
    hard = solve_block(problem("contact.normal=hard"), history=False)
    assert hard.to_json()["impact_integration"]
    assert hard.to_json()["normal_stiffness_at_mean_pressure_Pa_per_m"] is None
    assert hard.problem.system.resolving_step == 0.0


def test_with_a_fine_step_the_block_is_the_sliding_body():
    block = problem("solve.step=2 us", "vibration.direction=45 deg", "slider.lateral=guided")
    result = solve_block(block, history=False)
    assert result.to_json()["newmark_beta"] == hht.coefficients()[0]
    body = slide(block.model)
    assert result.ratio == pytest.approx(body.ratio, rel=0.01)
    assert result.ledger.friction == pytest.approx(body.ledger.friction, rel=0.01)
    assert result.ledger.residual < 1e-8


@pytest.mark.slow
def test_the_time_of_an_increment_is_its_own_also_after_an_interruption(monkeypatch, tmp_path):
    clock = itertools.count()
    fake = types.SimpleNamespace(perf_counter=lambda: float(next(clock)))
    monkeypatch.setattr(block_march, "time", fake)
    # Reading the clock is all that takes time here, a second each; writing takes ten.
    writing = BlockMarch(problem(), run=Told(lambda: [next(clock) for _ in range(10)]))
    assert writing.run().to_json()["ms_per_increment"] == 1000.0
    stopped(problem(), 20, tmp_path / "kept.npz")
    second = BlockMarch(problem())
    second.restore(read_tree(tmp_path / "kept.npz"))
    result = second.run()
    assert result.timed == result.increments - 2
    assert result.to_json()["ms_per_increment"] == 1000.0


def test_the_powers_are_those_of_the_sliding_body():
    block = problem("vibration.direction=45 deg")
    powers, slid = solve_block(block, history=False).ledger, slide(block.model).ledger
    for term in ("drive", "vibration", "friction", "stored"):
        assert getattr(powers, term) == pytest.approx(getattr(slid, term), rel=0.03)


@pytest.mark.slow
def test_the_time_integration_takes_little_and_less_with_a_finer_step():
    taken = [
        solve_block(problem(f"solve.step={step} us"), history=False).ledger for step in (5, 2.5)
    ]
    assert 0.0 < taken[1].numerical < taken[0].numerical < 1e-3 * taken[0].friction


def test_a_rigid_drive_moves_the_block_at_its_velocity():
    raw = read_case("block-longitudinal", case_tables(), [*SMALL, *SHAKEN])
    block = BlockProblem.from_case(
        raw.replace_values({"slider.drive_stiffness": None, "slider.drive_damping": None})
    )
    result = solve_block(block)
    history = result.history
    assert history.velocity[:, 0] == pytest.approx(np.full(history.time.size, 0.5e-3))
    assert np.abs(history.drive_force - history.friction[:, 0]).max() <= 1e-9
    assert result.ledger.residual < 1e-4
    assert result.breakaway_time is None


def test_a_guided_block_neither_shifts_sideways_nor_turns():
    block = problem("slider.lateral=guided", "vibration.direction=60 deg")
    march = BlockMarch(block)
    result = march.run()
    place = march.stepper.state.coordinates.place
    assert place[[1, 3, 4, 5]] == pytest.approx(np.zeros(4), abs=1e-16)
    assert np.abs(result.history.friction[:, 1]).max() > 1.0


@pytest.mark.slow
def test_vibrating_the_body_or_the_base_gives_the_same_ratio():
    turned = ("friction.law=vector", "friction.transfer=1", "vibration.direction=45 deg", *STIFF)
    base = solve_block(problem(*turned, "solve.duration=4 ms"), history=False)
    # The body's own motion against the base's: half a cycle later.
    body = solve_block(
        problem(*turned, "solve.duration=4 ms", "vibration.applied_to=body"), history=False
    )
    assert body.ratio == pytest.approx(base.ratio, rel=2e-3)
    assert body.ledger.vibration == pytest.approx(base.ledger.vibration, rel=2e-3)


@pytest.mark.slow
def test_a_mirrored_vibration_mirrors_the_lateral_friction():
    left, right = (
        solve_block(problem(f"vibration.direction={angle} deg"), history=False)
        for angle in (40, -40)
    )
    assert left.ratio == pytest.approx(right.ratio, rel=1e-7)
    assert left.friction_max[1] == pytest.approx(-right.friction_min[1], rel=1e-7)


@pytest.mark.slow
def test_an_increment_that_fails_is_taken_in_halves(monkeypatch):
    block = problem()
    whole = solve_block(block, history=False)
    solve, full = IncrementSolver.solve, block.timetable.step
    failed = []

    def stumbles(given, *arguments):
        if given.problem.step == full and len(failed) < 3:
            failed.append(given.problem.step)
            raise ConvergenceError("no equilibrium")
        return solve(given, *arguments)

    monkeypatch.setattr(IncrementSolver, "solve", stumbles)
    cut = solve_block(problem(), history=False)
    assert cut.cuts == len(failed) == 3
    assert "3 increments were not solved at once" in " ".join(cut.notes)
    assert cut.ratio == pytest.approx(whole.ratio, rel=1e-3)
    assert cut.ledger.residual < 1e-4


def test_an_increment_that_fails_however_small_says_where_and_keeps_what_was_done(monkeypatch):
    march = BlockMarch(problem())
    solve, calls = IncrementSolver.solve, []

    def fails(*arguments):
        calls.append(1)
        if len(calls) > 60:
            raise ConvergenceError("no equilibrium", reached={"residual": 0.5, "active": 16.0})
        return solve(*arguments)

    monkeypatch.setattr(IncrementSolver, "saved_tangent", lambda *_: None)
    monkeypatch.setattr(IncrementSolver, "solve", fails)
    with pytest.raises(ConvergenceError, match=r"at 0\.000\d+ s.*cut in half 8 times") as failure:
        march.run()
    reached = failure.value.reached
    assert reached.keys() == {"time_s", "residual", "active", "increments"}
    assert reached["increments"] == march.done > 0
    assert reached["time_s"] == pytest.approx(march.done * 5e-6)
    assert march.history.time[-1] == pytest.approx(march.done * 5e-6)
    assert np.isfinite(march.history.drive_force).all()


RESUMED = {
    "linear": ("vibration.direction=45 deg",),
    "hard": ("contact.normal=hard", "vibration.direction=45 deg"),
    "modes": ("block.modes=3", "friction.law=vector"),
}
TIMES = {"ms_per_increment", "seconds", "condense_seconds", "condensed_from_cache"}


def stopped(block, after, path):
    def stop():
        if march.done == after:
            write_tree(path, march.state())
            raise KeyboardInterrupt

    march = BlockMarch(block, run=Told(stop))
    with pytest.raises(KeyboardInterrupt):
        march.run()
    assert march.done == after
    return march


@pytest.mark.slow
@pytest.mark.parametrize(("name", "stop"), grid([*RESUMED], [1, 20, 200]))
def test_an_interrupted_march_goes_on_to_the_very_same_end(name, stop, tmp_path):
    whole = solve_block(problem(*RESUMED[name]))
    stopped(problem(*RESUMED[name]), stop, tmp_path / "kept.npz")
    second = BlockMarch(problem(*RESUMED[name]))
    second.restore(read_tree(tmp_path / "kept.npz"))
    assert second.done == stop
    result = second.run()
    answers = [
        {key: value for key, value in run.to_json().items() if key not in TIMES}
        for run in (whole, result)
    ]
    assert answers[0] == answers[1]
    for name in ("time", "drive_force", "friction", "deflection", "position", "velocity"):
        assert np.array_equal(getattr(result.history, name), getattr(whole.history, name))
    assert np.array_equal(result.point_pressure, whole.point_pressure)
    for frame, other in zip(result.frames, whole.frames, strict=True):
        assert frame.time == other.time
        assert np.array_equal(frame.traction, other.traction)


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError])
def test_a_march_stopped_in_the_middle_of_an_increment_stands_at_the_last_whole_one(
    monkeypatch, error
):
    whole = solve_block(problem("vibration.direction=45 deg"))
    march = BlockMarch(problem("vibration.direction=45 deg"))
    marched, calls = steps.march, []

    def breaks(*arguments):
        calls.append(1)
        if len(calls) % 100 == 0:
            raise error
        return marched(*arguments)

    def recording(progress, rows):
        recorded, number = record(progress, rows), progress.done + 1
        if number % 70 == 0 and number not in seen:
            seen.append(number)
            raise error
        return recorded

    monkeypatch.setattr(steps, "march", breaks)
    record, seen = march._recorded, []
    monkeypatch.setattr(march, "_recorded", recording)
    result, breaks_off = None, 0
    while result is None:
        try:
            result = march.run()
        except error:
            breaks_off += 1
            assert march.stepper.state.time == pytest.approx(march.done * 5e-6)
            assert len(march.history.time) == march.done
    assert breaks_off > 5
    assert result.ratio == pytest.approx(whole.ratio, rel=1e-7)
    assert np.array_equal(result.history.time, whole.history.time)
    assert result.history.drive_force == pytest.approx(whole.history.drive_force, rel=1e-6)


def test_a_march_goes_on_from_what_is_kept_of_it_and_of_nothing_else(tmp_path):
    told = []

    def march(*settings):
        return BlockMarch(problem(*settings), run=Run(notify=told.append, folder=tmp_path))

    path = tmp_path / "run.interrupted.npz"
    assert not march().resume()
    first = march()
    CheckpointFile(path, march_key(first.problem), told.append).save(first.state())
    again = march()
    assert again.resume()
    assert again.stepper.state.forces == first.stepper.state.forces
    assert told == []
    assert not march("friction.mu=0.2").resume()
    assert told == [f"{path} is of another case or version; begins anew"]


def test_a_flipped_bit_in_what_is_kept_is_found_told_and_gone_on_without(tmp_path):
    path, told = tmp_path / "run.interrupted.npz", []
    march = stopped(problem(), 20, tmp_path / "kept.npz")
    CheckpointFile(path, march_key(march.problem), told.append).save(march.state())
    whole = bytearray(path.read_bytes())
    whole[whole.find(march.stepper.state.coordinates.place.tobytes())] ^= 1
    path.write_bytes(whole)
    again = BlockMarch(problem(), run=Run(notify=told.append, folder=tmp_path))
    assert not again.resume()
    (line,) = told
    assert line.startswith(f"{path} is damaged")
    assert line.endswith("set aside as run.interrupted.npz.damaged; begins anew")
    assert again.run().steps == march.problem.timetable.steps


def test_the_frames_of_an_animation_deform_as_the_contact_does():
    from asperity.block.series import fields

    block = problem("vibration.direction=45 deg", "block.modes=2")
    march = BlockMarch(block)
    result = march.run()
    time, field = list(fields(block, result.frames))[-1]
    assert time == pytest.approx(march.stepper.state.time)
    nodes = block.body.nodes
    at_contact = march.stepper.state.contact.displacement.reshape(-1, 3)
    size = np.abs(at_contact).max()
    # The contact does not ask what the loads do to the drive's own place.
    assert field["displacement"][nodes] == pytest.approx(at_contact, abs=1e-9 * size)
    pressure = field["pressure_Pa"][nodes]
    assert block.surface.nodal_area @ pressure == pytest.approx(55.0, rel=1e-2)
    others = np.setdiff1d(np.arange(len(block.mesh.points)), nodes)
    assert not field["pressure_Pa"][others].any()


def test_a_hard_contact_is_the_limit_of_a_stiff_one():
    stiff = problem("contact.stiffness=2e17 Pa/m")
    pressures = [
        at_rest(block).contact.pressure for block in (problem("contact.normal=hard"), stiff)
    ]
    assert pressures[0] == pytest.approx(pressures[1], rel=2e-2)


BENT = (
    "contact.normal=two-stage", "contact.initial_stiffness=2e13 Pa/m",
    'contact.transition=["2 nm", "2.1 nm"]',
)  # fmt: skip


@pytest.mark.slow
def test_a_shaken_block_goes_to_and_fro_over_the_bend_between_two_stages():
    block = problem(*BENT, "vibration.direction=45 deg")
    law = block.normal
    bends = [float(pressure(over, 0.0, law.numbers)[0]) for over in (law.start, law.end)]
    result = solve_block(block)
    pressures = np.array([frame.pressure for frame in result.frames])
    assert (pressures.min(axis=0) < bends[0]).any()
    assert (pressures.max(axis=0) > bends[1]).any()
    crossing = (pressures.min(axis=0) < bends[0]) & (pressures.max(axis=0) > bends[1])
    assert crossing.any()
    assert result.ledger.residual < 1e-6
    answer = result.to_json()
    assert answer["unconverged"] == 0
    assert answer["normal_stiffness_Pa_per_m"] == law.stiffness
    at_mean = answer["normal_stiffness_at_mean_pressure_Pa_per_m"]
    assert law.initial < at_mean < law.stiffness
    assert result.to_dataset().attrs["contact.transition"] == [2e-9, 2.1e-9]


def test_stages_left_out_are_those_of_the_element():
    law = problem("contact.normal=two-stage").normal
    assert law == NormalLaw.two_stage(law.stiffness, 0.02)
    given = problem("contact.normal=two-stage", "contact.initial_stiffness=2e13 Pa/m").normal
    assert given == dataclasses.replace(law, initial=2e13)


@pytest.mark.slow
@pytest.mark.parametrize("modes", [0, 4])
def test_the_stiffest_contact_comes_to_rest_and_closes_its_ledger(modes):
    kept = f"block.modes={modes}", "block.elements=[4, 3, 3]"
    stiff, stiffest = (problem(*kept, f"contact.stiffness={k} Pa/m") for k in ("1e16", "1e20"))
    states = [at_rest(block) for block in (stiff, stiffest)]
    assert states[1].forces.normal == pytest.approx(55.0, rel=1e-7)
    assert states[1].contact.active == stiff.system.weights.size
    assert states[1].contact.pressure == pytest.approx(states[0].contact.pressure, rel=1e-3)
    results = [solve_block(block, history=False) for block in (stiff, stiffest)]
    assert results[1].ratio == pytest.approx(results[0].ratio, rel=1e-3)
    assert results[1].ledger.residual < 1e-6


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            ("slider.mass=1e-300 kg",),
            r"slider.mass is 1e-300 kg, .* it must be 3.6e-05 to 360 kg",
        ),
        (("slider.mass=6 kg",), r"slider.normal_force is 55 N; it must be at least the weight"),
        (("solve.method=periodic",), r"solve.method is 'periodic'; an elastic block is solved by"),
        (("solve.step=20 us",), r"solve.step is 2e-05 s, too coarse for the vibration of 4000 Hz"),
        (("solve.duration=0.1 ms",), r"solve.duration is 0.0001 s; with the vibration"),
        (
            ("vibration.velocity_ratio=1e6",),
            r"slips of up to 500 m/s a deflection of at most \S+ m takes a step of at most",
        ),
        (("contact.stiffness=0 Pa/m",), r"contact.stiffness is '0 Pa/m'"),
        (
            ("solve.scheme=two-phase", "vibration.velocity_ratio=60"),
            r"two-phase scheme is unstable",
        ),
        (
            ("contact.normal=two-stage", "contact.initial_stiffness=1 Pa/m"),
            r"initial contact stiffness is 1 Pa/m; it must be at least 1.39\d*e\+08 Pa/m",
        ),
        (
            ("contact.normal=two-stage", "contact.initial_stiffness=1e17 Pa/m"),
            r"it must be at least .* at most that, 1.39\d*e\+14 Pa/m",
        ),
        (
            (
                "contact.normal=two-stage", "contact.stiffness=1e12 Pa/m",
                "contact.initial_stiffness=1e6 Pa/m", 'contact.transition=["10 mm", "20 mm"]',
            ),
            r"contact.initial_stiffness 1e\+06 Pa/m lets it sink by 0.01\d+ m; it may be 0.003 m",
        ),
    ],
)  # fmt: skip
def test_what_cannot_be_solved_is_refused(settings, message):
    with pytest.raises(InputError, match=message):
        check(problem(*settings))


def test_a_block_too_high_for_its_length_is_said_to_tip_over_before_it_slides():
    high = 'block.size=["4 mm", "30 mm", "41 mm"]'
    result = solve_block(problem(high, "solve.duration=0.5 ms"), history=False)
    assert "mu times its height, 4.1 mm, is more than its length, 4 mm" in result.notes[0]
    for held in ("slider.lateral=guided", 'block.size=["4 mm", "30 mm", "39 mm"]'):
        assert not problem(high, held).tips


def test_a_block_without_a_mass_is_refused():
    raw = read_case("block-longitudinal", case_tables(), SMALL)
    none = dict.fromkeys(("slider.mass", "slider.drive_stiffness", "slider.drive_damping"))
    with pytest.raises(InputError, match=r"slider.mass is missing; it makes the density"):
        BlockProblem.from_case(raw.replace_values({**none, "slider.lateral": None}))


def test_a_block_that_is_not_pressed_on_its_base_does_not_come_to_rest():
    block = problem()
    up = block.loads[0]._replace(generalised=-block.loads[0].generalised)
    with pytest.raises(ConvergenceError, match=r"press it on its base|no equilibrium at rest"):
        rest_under_load(block.system, (up,))
