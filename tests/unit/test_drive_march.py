"""The march of a reduced drive: its ledger, its symmetries, its periodic state, its refusals."""

import dataclasses
import os
import signal

import numpy as np
import pytest
from apparatus.drives import ASPERITIES, all_solved, case, deflection, problem, solved
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.directions import answer as ways
from asperity.drive.driven import inputs
from asperity.drive.locking import prepare as prepare_locking
from asperity.drive.plots import plot_directions
from asperity.drive.protocols.equations_of_motion import begin, switched_off, system
from asperity.drive.protocols.march import March
from asperity.drive.reduced.law import NormalLaw, force_and_energy
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.solve import answer, prepare
from asperity.errors import InputError
from asperity.runs import Interrupted, Run


def drawn_text(figure):
    return "\n".join(label.get_text() for label in figure.axes[0].get_yticklabels())


RATTLING = (
    "vibration.mode=axial",
    "vibration.frequency=6 kHz",
    "vibration.displacement_amplitude=40 um",
)


def test_the_powers_balance_and_halving_the_step_halves_what_is_missing():
    wanted = ("drive.flanks=driving", "solve.duration=20 ms", "vibration.velocity_ratio=1.5")
    coarse, fine = all_solved([(*wanted, f"solve.step={step} us") for step in (1.0, 0.5)])
    assert coarse.closure < 1e-3
    assert fine.closure <= 0.5 * coarse.closure + 1e-9
    assert fine.torque_ratio == pytest.approx(coarse.torque_ratio, abs=1e-3)


def test_the_powers_balance_while_both_flanks_hammer():
    (one,) = all_solved([(*RATTLING, "vibration.displacement_amplitude=160 um")])
    assert one.second_flank_share > 0.01
    assert one.open_share > 0.2
    assert one.closure < 3e-3


@pytest.mark.parametrize(
    "way",
    [
        ("vibration.mode=axial",),
        ("vibration.mode=axial", "vibration.applied_to=seat", "shaft.bearing_axial=50 kN/mm"),
        ("vibration.mode=torsional",),
        ("vibration.mode=torsional", "vibration.applied_to=motor"),
        ("vibration.mode=wheel-axial",),
        ("vibration.mode=screw",),
    ],
)
def test_a_wave_that_begins_at_its_crest_does_not_hit_the_flanks(way, tmp_path):
    samples = tmp_path / "cosine.csv"
    time = np.linspace(0.0, 0.5e-3, 65)
    np.savetxt(samples, np.column_stack([time, np.cos(2e3 * 2.0 * np.pi * time)]), delimiter=",")
    given = problem(
        f"vibration.samples={samples}", "vibration.waveform=sampled", "drive.worm_mass=0.3 kg",
        "vibration.displacement_amplitude=20 um", *way,
    )  # fmt: skip
    model = ReducedModel(given, reduction(given, Run()))
    moving = system(given, model)
    march = March(model, moving, *begin(given, model, moving), Run())
    (first,) = march.stretches(1, 2e-6)
    assert first["driving_max"] == pytest.approx(model.normal_force, rel=0.05)
    assert abs(first["actuator"]) < 1e-2


def test_the_powers_balance_while_damping_alone_unloads_flanks_that_touch():
    for one in all_solved([(*RATTLING, f"drive.contact_damping={c} s/m") for c in (1, 10)]):
        assert one.ledger.damping > one.ledger.friction
        assert one.closure < 1e-3


@pytest.mark.parametrize("mode", ["axial", "screw"])
def test_a_rigid_seat_shakes_as_the_worm_itself(mode):
    settings = ("vibration.frequency=20 kHz", "vibration.displacement_amplitude=5 um")
    one, other = all_solved(
        [(f"vibration.mode={mode}", f"vibration.applied_to={place}", *settings)
         for place in ("worm", "seat")]
    )  # fmt: skip
    assert one.torque == pytest.approx(other.torque, rel=1e-9)
    assert one.ledger.actuator == pytest.approx(other.ledger.actuator, rel=1e-9)


def test_a_stiff_seat_shakes_nearly_as_a_rigid_one_and_a_soft_one_hardly():
    settings = (
        "vibration.mode=axial", "vibration.applied_to=seat", "vibration.frequency=20 kHz",
        "vibration.displacement_amplitude=2 um", "drive.worm_mass=0.3 kg",
    )  # fmt: skip
    rigid, stiff, soft = all_solved(
        [settings, (*settings, "shaft.bearing_axial=1e5 kN/mm"),
         (*settings, "shaft.bearing_axial=50 kN/mm")]
    )  # fmt: skip
    assert stiff.force_max == pytest.approx(rigid.force_max, rel=0.05)
    assert soft.force_max - soft.force_static < 0.3 * (rigid.force_max - rigid.force_static)


def test_seat_and_bearing_yield_one_behind_the_other():
    settings = (
        "vibration.mode=axial", "vibration.applied_to=seat", "vibration.frequency=20 kHz",
        "vibration.displacement_amplitude=2 um", "drive.worm_mass=0.3 kg",
    )  # fmt: skip
    both, one, seat = all_solved(
        [(*settings, "shaft.bearing_axial=75 kN/mm", "shaft.seat=150 kN/mm"),
         (*settings, "shaft.bearing_axial=50 kN/mm"), (*settings, "shaft.seat=50 kN/mm")]
    )  # fmt: skip
    assert both.torque == pytest.approx(one.torque, rel=1e-9)
    assert seat.torque == one.torque
    assert not any("axial bearing" in note for note in seat.notes)


def test_an_actuator_off_its_resonance_takes_more_apparent_power_and_as_much_real():
    settings = ("vibration.frequency=20 kHz", "actuator.coupling=0.3", "drive.worm_mass=0.3 kg")
    tuned, said, off = all_solved(
        [settings, (*settings, "actuator.resonance=20 kHz"),
         (*settings, "actuator.resonance=25 kHz")]
    )  # fmt: skip
    assert said.actuator_apparent == tuned.actuator_apparent
    assert off.ledger.actuator == tuned.ledger.actuator
    assert off.actuator_electrical == pytest.approx(tuned.actuator_electrical, rel=0.05)
    assert off.actuator_apparent > 2.0 * tuned.actuator_apparent
    # The amplifier's losses are before it: what it gives is at most what it is made for.
    for each in (tuned, off):
        assert 0.9 * each.actuator_electrical <= each.actuator_apparent


def test_without_vibration_to_speak_of_the_drive_runs_as_its_closed_form():
    one = solved("vibration.displacement_amplitude=1e-6 um")
    assert one.torque_ratio == pytest.approx(1.0, abs=1e-6)
    assert one.energy_ratio == pytest.approx(1.0, abs=1e-6)
    assert one.torque_balance == pytest.approx(0.0, abs=1e-7)


BENDING = (
    "shaft.diameter=17 mm", "shaft.span=150 mm", "shaft.bearing_radial=100 kN/mm",
    "drive.worm_mass=0.3 kg",
)  # fmt: skip


def test_a_worm_whose_shaft_bends_stays_where_it_bent_to_until_it_is_shaken():
    one = problem("vibration.displacement_amplitude=1e-6 um", *BENDING)
    model = ReducedModel(one, reduction(one, Run()))
    moving = system(one, model)
    march = March(model, moving, *begin(one, model, moving), Run())
    before = march.states[0]["bent"].copy()
    march.go(2)
    # As thesis 7.2.2 has it: across and away from the wheel by a quarter of a millimetre and more.
    assert before == pytest.approx([-8.5e-6, -0.28e-3, -0.23e-3], rel=0.1)
    assert march.states[0]["bent"] == pytest.approx(before, rel=1e-5)


@pytest.mark.parametrize("way", [(), RATTLING])
def test_the_powers_balance_of_a_worm_whose_shaft_bends(way):
    (one,) = all_solved([("vibration.frequency=2 kHz", *way, *BENDING, "solve.duration=15 ms")])
    assert one.closure < 1e-5
    assert not any("bending" in note for note in one.notes)


def test_force_and_energy_of_the_mesh_belong_together():
    law = NormalLaw(np.array([2e-6, 8e-6, 20e-6]), np.array([300.0, 2000.0, 7000.0]))
    cell, rows = law.table(7000.0)
    for at in (1e-7, 3e-6, 1.2e-5, 6e-5, 5e-4):
        step = 1e-3 * at
        (_, below), (force, _), (_, above) = (
            force_and_energy(cell, rows, at + shift) for shift in (-step, 0.0, step)
        )
        assert force == pytest.approx((above - below) / (2.0 * step), rel=1e-4)
        assert force == pytest.approx(float(law.exact(np.array([at]))[0][0]), rel=1e-3, abs=2.0)
    assert force_and_energy(cell, rows, -1e-6) == (0.0, 0.0)
    assert law.approach_at(2000.0) == pytest.approx(8e-6)


def test_a_window_tells_that_it_is_no_state_that_lasts():
    one = solved("drive.protocol=window", "drive.window=2", *RATTLING)
    assert not one.settled
    assert one.torque_ratio == pytest.approx(one.torque_ratio_window)
    assert any("no state that lasts" in note for note in one.notes)


def test_the_part_along_the_flank_of_a_screw_is_the_screw():
    one, other = all_solved([(), ("drive.protocol=tangential",)])
    assert one.torque == pytest.approx(other.torque, rel=1e-9)


def test_a_stalled_motor_presses_harder_on_a_held_wheel_while_it_is_shaken():
    one = solved("drive.protocol=held-wheel", "vibration.frequency=20 kHz")
    assert one.settled
    assert one.torque_ratio < 0.95
    assert one.closure < 1e-3


def test_a_gearset_that_locks_holds_after_vibration_and_motor_are_off():
    steep = solved("drive.protocol=on-demand")
    assert steep.held_after is False
    locking = solved("drive.protocol=on-demand", "friction.mu=0.5", "friction.exponent=0")
    assert locking.held_after is True


OF_MOTOR = ("vibration.mode=torsional", "vibration.applied_to=motor")


@pytest.mark.parametrize("shaft", [(), ("shaft.bearing_axial=50 kN/mm", "drive.worm_mass=0.3 kg")])
@pytest.mark.parametrize("share", [0.0, 0.1])
def test_switched_off_a_vibration_leaves_the_worm_its_place_and_its_speed(shaft, share):
    given = problem("vibration.frequency=2 kHz", "vibration.velocity_ratio=1.5", *shaft)
    model = ReducedModel(given, reduction(given, Run()))
    moving = system(given, model)
    on = March(model, moving, *begin(given, model, moving), Run())
    on.go(3)
    if share:
        on.stretches(1, share * on.cycle)
    last = on.states[0]
    imposed = {axis: getattr(moving, f"shake_worm_{axis}") for axis in ("turn", "shift")}
    still, states = switched_off(given, model, moving, on.states)
    off = March(model, still, states, on.committed.copy(), Run())
    span = 1e-9
    off.stretches(1, span)
    assert off.states[0]["driving"] == pytest.approx(last["driving"], rel=1e-2)
    for axis, free in (("turn", True), ("shift", still.shifts)):
        before = last[axis] + imposed[axis] * last["wave"]
        after = off.states[0][axis] + getattr(still, f"shake_worm_{axis}") * off.states[0]["wave"]
        speed = last[f"{axis}_rate"] + imposed[axis] * last["wave_rate"] if free else 0.0
        assert (after - before) / span == pytest.approx(speed, rel=1e-2), axis


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        (["vibration.displacement_amplitude=3 mm", "vibration.mode=axial"], "lifts the worm out"),
        (["vibration.mode=wheel-axial", "vibration.displacement_amplitude=9 mm"], "face width"),
        (["solve.step=10 us"], "too coarse for a vibration of 2000 Hz"),
        (["solve.step=4.9 us", ASPERITIES], "too coarse for the mesh's own vibration"),
        (["solve.step=1 us", *RATTLING], "flanks that approach at"),
        (["vibration.applied_to=wheel"], "is applied to 'worm' or 'seat'"),
        (["vibration.applied_to=base"], "of a sliding body"),
        (["vibration.direction=3 deg"], "of a sliding body"),
        (["friction.mu=5"], "cannot turn the wheel"),
        (["friction.model=springs"], "between teeth it must be"),
        (["friction.law=split"], "leave it out"),
        (["friction.keeps=deflection"], "makes energy"),
        (["drive.effective_radius=3 mm"], "threads reach from"),
        (["solve.method=periodic"], "a gearset is marched"),
        (["vibration.start=1 s"], "vibration.start is 1 s, of a sliding body"),
        ([*OF_MOTOR, "drive.protocol=held-wheel"], "pushes with a torque alone"),
        ([*OF_MOTOR, "drive.protocol=back-drive"], "the motor is off"),
        ([*OF_MOTOR, "drive.protocol=tangential"], "moves the worm itself along its flank"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(settings, words):
    with pytest.raises(InputError, match=words) as refused:
        problem(*settings)
    assert "\n" not in str(refused.value)


def test_what_does_not_shake_a_free_worm_is_no_answer_to_whether_it_holds():
    with pytest.raises(InputError, match="the motor is off"):
        prepare_locking(case(*OF_MOTOR))


@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("actuator.coupling=0.3", "drive.worm_mass is missing"),
        ("shaft.bearing_axial=50 kN/mm", "drive.worm_mass is missing"),
        ("shaft.bearing_radial=50 kN/mm", "shaft.span is missing"),
    ],
)
def test_what_is_missing_is_told_before_any_teeth_are_solved(setting, words):
    with pytest.raises(InputError, match=words):
        prepare(read_case("drive-screw", case_tables(), [setting]))


def test_a_backlash_that_nobody_gave_is_asked_for_before_any_teeth_are_solved():
    with pytest.raises(InputError, match="backlash is missing"):
        dataclasses.replace(problem(), mount=None)


@pytest.mark.parametrize("key", ["load_inertia", "contact_damping"])
def test_vibration_needs_the_numbers_that_every_answer_depends_on(key):
    given = problem()
    drive = given.drive.model_copy(update={key: None})
    with pytest.raises(InputError, match=f"drive.{key} is missing"):
        dataclasses.replace(given, drive=drive)


def test_a_way_that_cannot_be_solved_is_named_and_leaves_the_others():
    stiff = problem(*RATTLING, "drive.contact_damping=1000 s/m", "solve.duration=6 ms")
    found = ways(stiff, Run())
    rows = {row["mode"]: row for row in found.to_json()["directions"]}
    assert rows["axial"]["torque_ratio"] is None
    assert not rows["axial"]["settled"]
    assert any(note.startswith("axial: not solved, the powers") for note in found.notes)
    assert rows["screw"]["torque_ratio"] > 0.0
    assert "not solved" in drawn_text(plot_directions(found.to_dataset()))
    assert rows["axial"]["settled_by"].startswith("the powers")
    assert rows["axial"]["step_error"] is None


def test_of_each_way_it_is_told_by_what_it_has_settled_and_the_error_of_its_step():
    shaken = ("vibration.frequency=20 kHz", "vibration.displacement_amplitude=2 um",
              "solve.step=0.5 us", "solve.duration=30 ms")  # fmt: skip
    found = ways(problem(*shaken), Run())
    for place, row in enumerate(found.to_json()["directions"]):
        one = solved(*shaken, f"vibration.mode={row['mode']}")
        assert (row["settled"], row["settled_by"]) == (one.settled, one.settled_by)
        assert row["step_error"] == one.step_error
        assert found.to_dataset()["settled_by"].values[place] == one.settled_by
        for note in one.notes:
            assert note in found.notes or f"{row['mode']}: {note}" in found.notes
    assert any(row["step_error"] for row in found.rows)


def test_what_a_held_wheel_s_ratio_is_and_why_an_actuator_s_take_is_missing_are_told():
    held = solved("drive.protocol=held-wheel", "vibration.frequency=20 kHz")
    (what,) = (entry.label.meaning for entry in held.entries() if entry.name == "torque_ratio")
    assert what.startswith("load over the mean torque on the held wheel")
    assert "load over torque of the held wheel" in held.figure().axes[0].get_title(loc="left")
    wheel = solved(
        "vibration.mode=wheel-axial", "vibration.frequency=20 kHz", "drive.worm_mass=0.3 kg",
        "vibration.displacement_amplitude=2 um", "actuator.coupling=0.3", "solve.duration=6 ms",
    )  # fmt: skip
    assert wheel.actuator_electrical is None
    assert any("the mass of the wheel is not known" in note for note in wheel.notes)


@pytest.fixture(autouse=True)
def _ctrl_c_is_heard():
    """Where tests run in the background Ctrl-C may be ignored, and is by all they start."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


class Pressed(Run):
    """A run in which Ctrl-C is pressed at its n-th checkpoint."""

    def __init__(self, folder, at):
        super().__init__(folder=folder)
        self.left = at

    def checkpoint(self, *args, **kwargs):
        self.left -= 1
        if self.left == 0:
            os.kill(os.getpid(), signal.SIGINT)
        super().checkpoint(*args, **kwargs)


GIVEN_STEP = (
    "vibration.frequency=4 kHz", "solve.duration=15 ms", "vibration.velocity_ratio=1.2",
    "drive.flanks=driving", "solve.step=0.25 us",
)  # fmt: skip
# Its step is given up for a shorter one.
CHOSEN_STEP = (
    "vibration.mode=torsional", "vibration.frequency=26 kHz", "vibration.waveform=triangle",
    "vibration.displacement_amplitude=20 um", "friction.model=coulomb", "friction.mu=0.2",
    "drive.tangential_compliance=0 m/N", "operation.output_torque=300 N m",
)  # fmt: skip


# Checkpoints of it: within the first block, one in a later one, and at the very last.
@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("protocol", "settings"),
    [("steady", GIVEN_STEP), ("on-demand", GIVEN_STEP), slow("steady", CHOSEN_STEP)],
)
def test_a_drive_interrupted_anywhere_answers_as_if_it_had_not_been(tmp_path, protocol, settings):
    given = problem(f"drive.protocol={protocol}", *settings)
    counting = Pressed(tmp_path / "whole", 0)
    wanted = answer(given, counting)
    checkpoints = -counting.left
    assert checkpoints >= 4
    for at in sorted({1, 2, checkpoints // 2, checkpoints - 1, checkpoints}):
        (folder := tmp_path / str(at)).mkdir()
        with pytest.raises(Interrupted, match="goes on from"):
            answer(given, Pressed(folder, at))
        again = answer(given, Run(folder=folder))
        for name in (
            "torque", "torque_balance", "spread", "settled", "settled_by", "step_error",
            "force_max", "held_after",
        ):  # fmt: skip
            assert getattr(again, name) == getattr(wanted, name), (at, name)
        assert again.course.cycle_torque.tobytes() == wanted.course.cycle_torque.tobytes()


def test_a_drive_that_a_study_marches_otherwise_is_not_gone_on_from(tmp_path):
    given = problem("vibration.frequency=20 kHz")
    plain = given.drive.model_copy(update={"protocol": "on-demand"})
    told = []
    with pytest.raises(Interrupted):
        answer(given, Pressed(tmp_path, 1))
    answer(dataclasses.replace(given, drive=plain), Run(folder=tmp_path, notify=told.append))
    assert any("begins anew" in line for line in told)


def test_a_march_goes_on_from_where_it_was_interrupted(tmp_path):
    given = problem(deflection())
    model = ReducedModel(given, reduction(given, Run()))
    moving = system(given, model)
    whole = March(model, moving, *begin(given, model, moving), Run())
    whole.go(6)
    first = March(model, moving, *begin(given, model, moving), Run())
    first.go(2)
    other = March(model, moving, *begin(given, model, moving), Run())
    other.restore(first.tree())
    other.go(4)
    assert other.rows.tobytes() == whole.rows.tobytes()


def test_a_cycle_marched_in_parts_is_the_same_cycle(monkeypatch):
    whole = solved("drive.protocol=window", "drive.window=2", "solve.step=0.5 us")
    monkeypatch.setattr("asperity.drive.protocols.march._CALL_SECONDS", 75e-6)
    parts = solved("drive.protocol=window", "drive.window=2", "solve.step=0.5 us")
    assert parts.torque == pytest.approx(whole.torque, rel=1e-9)
    assert parts.force_max == pytest.approx(whole.force_max, rel=1e-9)
    assert parts.ledger.friction == pytest.approx(whole.ledger.friction, rel=1e-9)
    assert parts.steps == whole.steps


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    "settings",
    [
        ("drive.worm_inertia=100 kg m**2",),
        (
            "drive.worm_inertia=1e-3 kg m**2",
            "shaft.torsional_stiffness=1 N m/rad",
            "vibration.frequency=20 kHz",
        ),
    ],
)
def test_a_drive_whose_power_goes_into_store_is_not_settled_though_its_torque_stays(settings):
    found = solved("vibration.velocity_ratio=1.5", *settings)
    assert abs(found.spread) < 5e-3
    assert abs(found.torque_balance) < 5e-3
    assert abs(found.ledger.stored) > 0.05 * found.ledger.drive
    assert not found.settled
    assert any("of the power goes into store" in note for note in found.notes)
    torque, energy, _ = found.headline()
    assert torque.endswith("a ratio that need not last")
    assert "saves" not in energy


def test_a_load_beyond_the_table_of_deflections_is_told():
    most = problem().drive.deflection[-1][0]
    for load, beyond in ((most, False), (2.0 * most, True)):
        given = solved(f"operation.output_torque={load} N m", "drive.protocol=window")
        said = [note for note in given.notes if "it is carried on beyond its end" in note]
        assert len(said) == beyond


def test_what_was_asked_holds_every_table_of_the_case():
    asked = inputs(problem(name="drive-thesis"))
    assert asked["hob.oversize"] == pytest.approx(1.12)
    assert {key.partition(".")[0] for key in asked} >= {"gearset", "hob", "solve", "vibration"}
    assert all(isinstance(value, str | float) for value in asked.values())
