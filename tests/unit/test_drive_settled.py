"""What of a drive has not settled is marked wherever it is told, and saves nothing."""

import dataclasses
import functools
import math
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import case, problem, solved

from asperity.drive import directions, locking
from asperity.drive.motion.system import SUMS
from asperity.drive.problem import PLACES
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.march import March, longest_march
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.studies.on_demand import OnDemand, in_a_stroke
from asperity.errors import AsperityError
from asperity.runs import Run

WHY = "the wheel is out of balance by 3 %"
SHAKEN = ("vibration.velocity_ratio=1.5",)


@functools.cache
def settled():
    one = solved(*SHAKEN)
    assert one.settled
    return one


def loose(one=None, **changes):
    one = settled() if one is None else one
    return dataclasses.replace(one, settled=False, settled_by=WHY, **changes)


class TestAHeadline:
    def test_says_whether_the_ratio_lasts(self):
        torque, *_ = settled().headline()
        assert "(settled, wheel in balance to" in torque
        torque, *_ = loose(torque_balance=0.03).headline()
        assert "(not settled, wheel out of balance by 3 %)" in torque
        assert torque.endswith(": a ratio that need not last")
        assert loose().heading().endswith(": not settled")
        assert settled().heading().endswith(": settled")

    def test_of_a_motor_that_is_off_says_whether_the_creep_lasts(self):
        assert "(not settled, " in loose(creep=-0.1).headline()[0]
        assert "(settled, " in dataclasses.replace(settled(), creep=-0.1).headline()[0]

    @pytest.mark.parametrize("efficiency", [None, 0.9, 0.3])
    @pytest.mark.parametrize("ratio", [0.8, 1.2])
    def test_says_that_energy_is_saved_only_where_it_has_settled(self, efficiency, ratio):
        changes = {"energy_ratio": ratio, "system_efficiency": efficiency}
        assert "it saves" in dataclasses.replace(settled(), **changes).headline()[1]
        assert "save" not in loose(**changes).headline()[1]


class TestWays:
    @pytest.fixture
    def found(self, monkeypatch):
        # Each saves more than the one before; the last has not settled, and one is not solved.
        each = [
            dataclasses.replace(
                settled(), saved_per_actuator=1.0 + n, saved_per_actuator_error=0.1,
                saved_power=1.0 + n, saved_power_error=0.1, force_max=1e3 - 100.0 * n,
            )
            for n in range(3)
        ]  # fmt: skip
        untold = loose(each[2], saved_per_actuator=None, saved_power=None)
        each = [*each[:2], untold, AsperityError("no worm turns")]
        monkeypatch.setattr(directions, "solve_many", lambda *_, **__: each)
        return directions.answer(problem(*SHAKEN), Run())

    def test_that_have_not_settled_are_ranked_nowhere(self, found):
        first, second, *_ = PLACES
        best = [second, first]
        assert found.rankings == {
            "per_micrometre": best, "per_watt": best, "by_force": best,
        }  # fmt: skip
        assert found.settled.tolist() == [1, 1, 0, 0]
        assert found.settled_by[2] == WHY

    def test_are_marked_and_save_nothing(self, found):
        way = found.to_json()["directions"][2]
        assert way["settled"] is False
        assert way["torque_ratio"] == settled().torque_ratio
        assert way["saved_W"] is None
        assert way["saved_per_micrometre_W"] is None
        assert way["saved_per_actuator_W_W"] is None
        (table,) = found.tables()
        names = [column.heading for column in table.columns]
        marks = [row[0].endswith(" (not settled)") for row in table.rows]
        assert marks == [False, False, True, True]
        for heading in ("saved (W)", "per µm (W)", "per W"):
            told = [row[names.index(heading)] for row in table.rows]
            assert all(told[:2])
            assert set(told[2:]) == {"-"}

    def test_are_grey_in_the_picture_without_a_saving(self, found):
        panels = found.figure().axes
        saved = panels[1]
        assert [text.get_text() for text in saved.texts][2] == "none"
        colours = [bar.get_facecolor() for bar in panels[0].patches]
        assert colours[0] == colours[1]
        assert colours[2] != colours[0]
        labels = [label.get_text() for label in panels[0].get_yticklabels()]
        assert "\nsettled" in labels[1]
        assert "\nnot settled" in labels[2]
        assert "\nnot solved" in labels[3]


CREEPS_FROM = 0.21e-6
"""Amplitude from which on a made-up drive creeps, m."""


class TestLocking:
    @pytest.fixture
    def told(self, monkeypatch):
        """Return what `locking` says of marches that creep from there on, some not settled."""

        def of(is_loose, given="20 um", spread=2.0):
            def marched(shaken, *_, **__):
                each = []
                for one, _ in shaken:
                    speed = -1e6 * max(one.amplitude - CREEPS_FROM, 0.0)
                    answer = dataclasses.replace(settled(), problem=one, creep=speed)
                    each.append(loose(answer, spread=spread) if is_loose(one.amplitude) else answer)
                return each

            monkeypatch.setattr(locking, "solve_many", marched)
            amplitude = f"vibration.displacement_amplitude={given}"
            asked = case("friction.exponent=0", amplitude, name="drive-actuator")
            return locking.answer(locking.prepare(asked), Run())

        return of

    def test_finds_the_threshold_between_marches_that_have_settled(self, told):
        one = told(lambda _: False)
        assert one.locked
        assert one.threshold == pytest.approx(CREEPS_FROM, rel=0.02)
        assert one.settled_over.all()
        assert not one.headline()
        # What has not settled far from it hides nothing.
        other = told(lambda u: u > 3.0 * CREEPS_FROM or u < 0.5 * CREEPS_FROM)
        assert other.threshold == one.threshold
        chart = other.amplitude
        expected = (chart <= 3.0 * CREEPS_FROM) & (chart >= 0.5 * CREEPS_FROM)
        assert other.settled_over.tolist() == expected.tolist()

    def test_tells_none_where_what_has_not_settled_hides_it(self, told):
        one = told(lambda u: 0.9 * CREEPS_FROM < u < 1.1 * CREEPS_FROM)
        assert one.threshold is None
        (note,) = [note for note in one.notes if "begins to creep between" in note]
        words = note.split()
        low, high = (float(words[words.index(word) + 1]) for word in ("between", "and"))
        assert 0.8 * CREEPS_FROM < 1e-6 * low <= 0.9 * CREEPS_FROM
        assert 1.1 * CREEPS_FROM <= 1e-6 * high < 1.25 * CREEPS_FROM
        assert "longer solve.duration" in note
        nothing = told(lambda u: u > CREEPS_FROM)
        assert nothing.threshold is None
        assert any("no march that has settled creeps" in note for note in nothing.notes)
        below = told(lambda u: u < CREEPS_FROM)
        assert below.threshold is None
        assert any("between 0 and 0.3" in note for note in below.notes)

    def test_takes_what_creeps_in_all_blocks_for_creeping_though_its_speed_has_not_settled(
        self, told
    ):
        every = told(lambda _: False)
        one = told(lambda u: u > CREEPS_FROM, spread=0.02)
        assert one.threshold == every.threshold
        assert not one.settled_over[one.amplitude > CREEPS_FROM].any()
        assert any("not settled, but creeps in all its blocks" in note for note in one.notes)
        assert not any("in all its blocks" in note for note in every.notes)
        # What has not settled never shows that it holds.
        assert told(lambda u: u < CREEPS_FROM, spread=0.0).threshold is None

    def test_says_that_the_creep_it_was_asked_for_has_not_settled(self, told):
        one = told(lambda u: u > 15e-6)
        assert one.settled is False
        assert one.threshold is not None
        assert one.headline() == (f"Not settled, no prediction: {WHY}.",)
        assert one.to_json()["settled"] is False
        (note,) = [note for note in one.notes if "has not settled" in note]
        assert WHY in note

    def test_crosses_out_what_has_not_settled_in_its_picture(self, told):
        (panel,) = told(lambda u: u > 3.0 * CREEPS_FROM).figure().axes
        (crosses,) = [line for line in panel.lines if line.get_marker() == "x"]
        assert crosses.get_label() == "not settled"
        assert (crosses.get_xdata() > 3e6 * CREEPS_FROM).all()
        (panel,) = told(lambda _: False).figure().axes
        assert not [line for line in panel.lines if line.get_marker() == "x"]


def test_the_stroke_of_a_drive_that_has_not_settled_is_not_told():
    given = problem(
        *SHAKEN, "actuator.coupling=0.3", "drive.worm_mass=0.3 kg", "drive.protocol=on-demand",
        "operation.through_travel_torque=122 N m",
    )  # fmt: skip
    model = ReducedModel(given, reduction(given, Run()))
    shaken = dataclasses.replace(settled(), problem=given, held_after=False)
    assert isinstance(in_a_stroke(given, model, shaken), OnDemand)
    found = in_a_stroke(given, model, loose(shaken))
    assert not isinstance(found, OnDemand)
    assert found.notes[-1] == (
        "the stroke is not told: the state at the seat is no periodic one to choose a motor by"
    )


class TestAMarch:
    """Of a wheel that comes into balance as slowly as is said, by nothing but its sums."""

    @staticmethod
    def march(slow, *, off=0.3, thrown=None):
        given = problem(*SHAKEN)
        model = ReducedModel(given, reduction(given, Run()))
        moving = system(given, model)
        march = March(model, moving, *begin(given, model, moving), Run())

        def stretches(count, length):
            rows = np.zeros(count, SUMS)
            at = length * (march.rows.size + np.arange(count) + 0.5)
            rows["time"] = length
            rows["wheel_torque"] = moving.load * length * (1.0 + off * np.exp(-at / slow))
            rows["torque"] = model.worm_torque * length
            if thrown is not None:
                rows["torque"] *= 1.0 + thrown(at)
            rows["turned"] = moving.speed * length
            rows["rolled"] = rows["turned"] / model.point.ratio
            return rows

        march.stretches = stretches
        march.mesh = SimpleNamespace(step_seconds=1e-12)
        power = model.worm_torque * given.worm_speed

        def settle(duration):
            return march.settle(
                window=given.drive.window, scale=model.worm_torque, power=power,
                duration=duration, ratio=model.point.ratio,
            )  # fmt: skip

        return march, settle

    @pytest.mark.parametrize("slow", [10e-3, 15e-3, 23e-3])
    def test_that_is_too_short_says_what_duration_would_do_and_that_does(self, slow):
        given = 40e-3
        _, settle = self.march(slow)
        short = settle(given)
        assert not short.settled
        said = short.said("torque ratio").rpartition("solve.duration of ")[2]
        more = 1e-3 * float(said.removesuffix(" ms would do")) - given
        _, settle = self.march(slow)
        assert settle(given + more).settled
        _, settle = self.march(slow)
        assert not settle(given + 0.6 * more).settled

    def test_of_three_blocks_alone_says_what_duration_would_do_too(self):
        march, settle = self.march(10e-3)
        short = settle(2e-3)
        assert march.rows.size == short.cycles
        said = short.said("torque ratio").rpartition("solve.duration of ")[2]
        would = 1e-3 * float(said.removesuffix(" ms would do"))
        _, settle = self.march(10e-3)
        assert settle(would).settled
        _, settle = self.march(math.inf)
        assert "leave solve.duration out" in settle(2e-3).said("torque ratio")

    def test_goes_on_without_a_duration_as_long_as_it_comes_nearer(self):
        slow = 40e-3
        march, settle = self.march(slow)
        usual = longest_march(24, march.system.frequency, None) * march.cycle
        found = settle(None)
        assert found.settled
        assert march.rows.size * march.cycle > 1.5 * usual
        short, settle = self.march(slow)
        assert not settle(usual).settled
        assert short.rows.size * short.cycle < 1.1 * usual

    def test_gives_up_where_it_comes_no_nearer(self):
        march, settle = self.march(math.inf)
        found = settle(None)
        assert not found.settled
        assert "a longer solve.duration may not do" in found.said("torque ratio")
        assert march.rows.size * march.cycle < 0.1

    def test_whose_blocks_agree_by_chance_has_not_settled(self):
        """They go up and down by 2 %, but the last three, which are within 0.4 % of one another."""
        march, _ = self.march(1e-9)
        end = longest_march(24, march.system.frequency, 40e-3) * march.cycle
        block = 24 * march.cycle

        def thrown(at):
            places = np.floor(at / block)
            last = places >= round(end / block) - 3
            return np.where(last, 0.2, 1.0) * 0.01 * (-1.0) ** places

        _, settle = self.march(1e-9, thrown=thrown)
        found = settle(40e-3)
        assert not found.settled
        assert found.spread == pytest.approx(4e-3)
        assert found.scatter == pytest.approx(1.2e-2, rel=1e-6)
        said = found.said("torque ratio")
        assert "agrees by chance: of twice as many it goes up and down by 1.2 %" in said
        assert said.endswith("ms would do")

    def test_that_comes_nearer_step_by_step_settles_by_three_blocks_as_it_did(self):
        _, settle = self.march(1e-9, thrown=lambda at: 0.05 * np.exp(-at / 12e-3))
        found = settle(40e-3)
        assert found.settled
        assert 1e-3 < found.spread < 5e-3
        assert found.scatter == 0.0
