"""What a weak vibration saves of a drive is told only as far as a march knows it."""

import dataclasses
import functools
import math
from pathlib import Path

import numpy as np
import pytest
from apparatus.drives import all_solved, problem, solved

from asperity import web
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive import directions
from asperity.drive.protocols.saving import Saving, left
from asperity.drive.result import EQUAL
from asperity.drive.solve import answer, prepare
from asperity.runs import Run

LINEAR = 'drive.deflection=[["23 N m", "22.9375 urad"], ["366 N m", "365 urad"]]'
WEAK = (
    LINEAR, "drive.tangential_compliance=0 m/N", "friction.model=dahl",
    "friction.max_deflection=70 nm", "vibration.frequency=1.5 kHz",
)  # fmt: skip
WAYS = (("axial", "worm"), ("torsional", "worm"), ("wheel-axial", "wheel"))


def weak(mode, place, *settings, amplitude="3 um"):
    way = (f"vibration.mode={mode}", f"vibration.applied_to={place}")
    return (*WEAK, *way, f"vibration.displacement_amplitude={amplitude}", *settings)


@functools.cache
def found():
    """Return drives in three lengths and with a step that is a tenth, each of three ways."""
    changes = ((), ("drive.window=100",), ("drive.window=500",), ("solve.step=0.05 us",))
    asked = [weak(*way, *change) for way in WAYS for change in changes]
    answers = all_solved(asked)
    return {way: answers[4 * n : 4 * n + 4] for n, way in enumerate(WAYS)}


class TestWeak:
    @pytest.mark.parametrize("way", WAYS)
    def test_saving_is_within_its_error_of_a_longer_and_finer_march(self, way):
        first, longer, longest, finer = found()[way]
        for one in (first, longer, longest):
            told, error = one.saved_power, one.saved_power_error
            assert told is None or abs(told - finer.saved_power) <= error + finer.saved_power_error
            for other in (longer, longest):
                if told is not None and other.saved_power is not None:
                    assert abs(told - other.saved_power) <= error
        assert finer.saved_power_error < 0.5 * finer.saved_power

    @pytest.mark.slow
    @pytest.mark.parametrize("way", WAYS)
    def test_saving_does_not_change_with_what_still_rings(self, way):
        asked = weak(*way, "solve.step=0.1 us")
        first, longer = all_solved([asked, (*asked, "drive.window=100")])
        power = first.torque_static * first.problem.worm_speed
        rings = abs(first.torque_ratio - longer.torque_ratio) * power
        assert first.settled
        assert longer.settled
        assert abs(first.saved_power - longer.saved_power) < 0.1 * rings

    def test_energy_ratio_is_within_its_error(self):
        for first, _, longest, _ in found().values():
            assert abs(first.energy_ratio - longest.energy_ratio) <= first.energy_ratio_error

    def test_greatest_force_does_not_hang_on_the_window(self):
        for answers in found().values():
            for one in answers:
                assert one.force_max == pytest.approx(answers[2].force_max, rel=3e-3)
                assert one.force_run_in > 1.02 * one.force_max
                assert " N since it was switched on, " in str(one.headline()[-1])


def test_nothing_is_saved_by_nothing_and_said_so():
    one = solved(*weak("screw", "worm"))
    assert one.settled
    assert one.saved_power is None
    assert one.saved_per_actuator is None
    power = one.torque_static * one.problem.worm_speed
    assert 1e-6 * power <= one.saved_power_error < 2e-6 * power
    (note,) = (note for note in one.notes if "saved" in note)
    assert note.startswith("drive power saved: none that can be told, it is known to ")
    assert "would tell" not in note
    assert "of the motor's power no saving can be told" in str(one.headline()[1])


@pytest.mark.slow
def test_what_is_advised_tells_it():
    asked = weak("torsional", "worm", amplitude="1 um")
    one = solved(*asked)
    assert one.saved_power is None
    (note,) = (note for note in one.notes if "would tell" in note)
    step = note.split("solve.step = '")[1].split("'")[0]
    window = [f"drive.window={note.split('drive.window = ')[1].split()[0]}"] * ("window" in note)
    assert solved(*asked, f"solve.step={step}", *window).saved_power is not None


def test_ways_that_are_no_further_apart_than_their_errors_stand_at_one_place():
    one = directions.answer(
        directions.prepare(problem(*weak("axial", "worm")).case), Run()
    )  # fmt: skip
    assert one.rankings["per_micrometre"] == ["axial or torsional"]
    assert one.to_json()["directions"][2]["saved_W"] is None
    assert "screw" not in "".join(one.rankings["per_micrometre"] + one.rankings["per_watt"])
    assert one.rankings["by_force"][0] == "screw"
    table, *_ = one.tables()
    assert "best per micrometre: axial or torsional; of wheel-axial, screw it is not known" in (
        table.remarks
    )
    headings = [column.heading for column in table.columns]
    assert "± (W)" in headings
    energy = [row[headings.index("energy")] for row in table.rows]
    known = np.abs(one.energy_ratio - 1.0) > one.energy_ratio_error
    assert [text != "-" for text in energy] == list(known)
    assert not known.all()
    assert one.to_json()["directions"][-1]["saved_W"] is None


def test_what_is_known_to_less_than_itself_is_told_as_no_saving():
    one = dataclasses.replace(
        solved(*weak("screw", "worm")), efficiency_static=0.3, system_efficiency=0.4
    )
    # Of one of which nothing is known, of one that is, and of those of which next to nothing is.
    for error, saves in ((None, False), (0.2, True), (0.3, False), (1.0, False), (1.5, False)):
        told = str(dataclasses.replace(one, energy_ratio_error=error).headline()[1])
        assert ("it saves energy" in told) == saves, error
        assert ("it saves no energy" in told) == (not saves), error


def test_the_page_s_verdict_has_the_same_bound():
    script = Path(web.__file__).parent / "static/js/screens/drive.js"
    text = script.read_text("utf-8")
    assert f"const least = 1 - Math.max({EQUAL}, answer.energy_ratio_error ?? 1);" in text
    assert "after ? after * least > before : ratio && ratio < least" in text


def test_an_energy_ratio_of_which_no_error_is_known_is_not_shown_of_a_way_that_settled():
    one = directions.answer(
        directions.prepare(problem(*weak("axial", "worm", "solve.duration=6 ms")).case), Run()
    )  # fmt: skip
    nan = np.full(4, np.nan)
    unknown = dataclasses.replace(
        one, energy_ratio_error=nan, settled=np.array([1, 1, 0, 1], np.int8)
    )
    table, *_ = unknown.tables()
    at = [column.heading for column in table.columns].index("energy")
    assert [row[at] != "-" for row in table.rows] == [False, False, True, False]


class TestErrorOfBlocks:
    @pytest.mark.parametrize("fades", [0.02, 0.3, 0.7, 0.85])
    def test_holds_what_fades(self, fades):
        means = 1.0 + 0.1 * fades ** np.arange(3.0)
        assert left(means) >= abs(means.mean() - 1.0) * (1.0 - 1e-9)

    def test_of_blocks_that_go_to_and_fro_is_what_they_differ_by(self):
        assert left(np.array([1.0, 3.0, 2.0])) == 2.0

    def test_of_blocks_that_go_ever_faster_is_bounded(self):
        assert 3.0 < left(np.array([0.0, 1.0, 3.0])) < 30.0


class TestPerActuator:
    SAVED = Saving(10.0, 1.0, 2.0, 0.5, 0.5)

    def test_error_holds_both_powers(self):
        ratio, error = self.SAVED.per_actuator(20.0, 0.0)
        assert ratio == 0.5
        assert ratio + error == pytest.approx(11.0 / 18.0)

    def test_is_left_out_where_its_error_is_more(self):
        assert self.SAVED.per_actuator(1.5, 0.0) is None
        assert dataclasses.replace(self.SAVED, error=11.0).per_actuator(20.0, 0.0) is None
        assert self.SAVED.per_actuator(3.0, 0.0) is None

    def test_advice_is_none_where_it_is_not_foreseen(self):
        assert dataclasses.replace(self.SAVED, power=1e-9).would_tell(12, 1e-6) == ""
        assert (
            dataclasses.replace(self.SAVED, of_step=math.inf, error=math.inf).would_tell(12, 1e-6)
            == ""
        )


@pytest.mark.slow
@pytest.mark.parametrize("mu", ["1e-6", "0.19"])
def test_a_vibration_of_nothing_saves_nothing_of_elastic_teeth(mu):
    """Their torque without vibration is a mean over places, which it does not know exactly."""
    asked = ("drive.model=teeth", f"friction.mu={mu}", "vibration.velocity_ratio=1e-6")
    found = answer(prepare(read_case("drive-screw", case_tables(), asked)), Run())
    assert found.settled
    assert found.saved_power is None
    power = found.torque_static * found.problem.worm_speed
    assert 0.0 < found.saved_power_error < 2e-4 * power
    assert found.energy_ratio == pytest.approx(1.0, abs=found.saved_power_error / power)
    if mu == "1e-6":
        assert found.efficiency_static == pytest.approx(1.0, abs=2e-5)
