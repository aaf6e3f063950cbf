"""Duty cycles: the parts of a load count as the standards' own formulas have them."""

import itertools
import sys

import numpy as np
import pytest
from apparatus.duties import A100, BINS, RUN, rated, safeties, steps

from asperity.errors import InputError
from asperity.rating import Operation, rate, variants


def test_one_part_with_the_same_load_is_a_life_in_every_safety():
    life, cycle = rated(life="5000 h"), rated(duty_cycle=steps((250, 1400, 5000)))
    assert len(safeties(life)) == 8
    assert safeties(cycle) == safeties(life)


def test_equal_parts_are_one_part():
    one = rated(duty_cycle=steps((250, 1400, 5000)))
    three = rated(duty_cycle=steps(*((250, 1400, hours) for hours in (1000, 1500, 2500))))
    assert safeties(three) == pytest.approx(safeties(one), rel=1e-13)


def test_order_of_the_parts_does_not_count():
    first = safeties(rated(duty_cycle=steps(*BINS)))
    for order in itertools.permutations(BINS):
        assert safeties(rated(duty_cycle=steps(*order))) == pytest.approx(first, rel=1e-13)


def test_three_parts_count_as_they_were_calculated_by_another_way():
    # Found by a script of its own from the printed formulas: depths, damage, equivalent hours.
    found = rated(duty_cycle=steps(*BINS))
    assert found.iso14521["delta_Wn_mm"] == pytest.approx(30.2081e-3, rel=2e-6)
    assert found.iso14521["S_W"] == pytest.approx(31.183, rel=2e-5)
    assert found.iso14521["S_H"] == pytest.approx(2.7997, rel=1e-5)
    assert found.iso14521["tau_F_MPa"] == pytest.approx(24.040, rel=3e-5)
    assert found.iso14521["loss_mean_W"] == pytest.approx(205.82, rel=3e-5)
    assert found.bs721["U_w_h"] == pytest.approx(844.736, rel=1e-6)
    assert found.bs721["U_s_h"] == pytest.approx(542.059, rel=1e-6)
    assert found.bs721["M_w_Nm"] == pytest.approx(831.57, rel=1e-5)
    assert found.bs721["M_s_Nm"] == pytest.approx(1246.86, rel=1e-5)
    assert found.bs721["S_w"] == pytest.approx(3.3263, rel=1e-5)
    assert found.bs721["S_s"] == pytest.approx(4.9875, rel=1e-5)
    wear = [part.wear for part in found.duty_cycle]
    assert wear == pytest.approx([6.8613, 12.5712, 10.7756], rel=1e-5)
    assert [part.sump for part in found.duty_cycle] == pytest.approx(
        [62.944, 58.493, 42.009], rel=1e-5
    )
    assert [part.loss for part in found.duty_cycle] == pytest.approx(
        [419.10, 327.67, 109.35], rel=2e-5
    )
    # With ten times the hours damage governs, not what a part bears at once.
    longer = rated(duty_cycle=steps(*((torque, n, 10 * hours) for torque, n, hours in BINS)))
    assert longer.iso14521["S_H"] == pytest.approx(2.0968, rel=2e-5)


def test_temperature_is_that_of_the_hottest_part_and_agma_that_of_the_nearest_to_its_limit():
    parts = ((60, 2800, 100), (250, 700, 100))
    cycle = rated(duty_cycle=steps(*parts))
    alone = [rated(output_torque=f"{t} N m", worm_speed=f"{n} rpm") for t, n, _ in parts]
    least = {path: min(safeties(one)[path] for one in alone) for path in safeties(cycle)}
    for path in ("iso14521.safety_temperature", "agma6034.safety_torque"):
        assert safeties(cycle)[path] == least[path]


def test_arrays_of_variants_have_what_each_has_alone():
    operation = Operation(**RUN, duty_cycle=steps(*BINS))
    factors = np.array([12.0, 12.5, 13.5])
    found = variants(A100, operation, diameter_factor=factors)
    for place, factor in enumerate(factors):
        alone = rate(A100.model_copy(update={"diameter_factor": factor}), operation)
        for path, value in safeties(alone).items():
            assert found[path][place] == pytest.approx(value, rel=1e-12), path


def test_a_rated_torque_below_a_part_is_no_variant():
    operation = Operation(**RUN, duty_cycle=steps(*BINS))
    found = variants(A100, operation, output_torque=[200.0, 250.0])
    assert np.isnan(found["iso14521.safety_wear"]).tolist() == [True, False]
    assert "a part with 250 N m" in found.legend("iso14521")[1]


def test_a_part_above_the_rated_torque_is_refused():
    with pytest.raises(
        InputError, match=r"duty_cycle has a part with 260 N m, number . of .*; none may exceed"
    ):
        Operation(**RUN, duty_cycle=steps((260, 1400, 10)))


def test_a_torque_through_the_travel_beside_a_duty_cycle_is_said_not_to_count():
    both = rated(duty_cycle=steps(*BINS), through_travel_torque="50 N m")
    assert safeties(both) == safeties(rated(duty_cycle=steps(*BINS)))
    assert any("does not count beside operation.duty_cycle" in n for n in both.iso14521.notes)


def test_the_rated_torque_of_a_valve_counts_for_a_third_and_a_tenth():
    plain, valve = rated(life="5000 h"), rated(life="5000 h", service="valve")
    given = rated(life="5000 h", service="valve", through_travel_torque=f"{250 / 3} N m")
    assert plain.iso14521["T_2"] == 250.0
    assert valve.iso14521["T_2"] == pytest.approx(250.0 / 3.0, rel=1e-15)
    assert safeties(valve) == pytest.approx(safeties(given), rel=1e-13)
    assert (plain.bs721["U_s_h"], valve.bs721["U_s_h"]) == (5000.0, 500.0)
    assert (
        "of a valve assumed a third"
        in plain.rating_inputs.operation.model_copy(update={"service": "valve"}).wear_assumed
    )
    assert plain.rating_inputs.operation.wear_assumed == ""


@pytest.mark.parametrize("key", ["input_power", "input_torque"])
def test_power_or_torque_of_the_worm_stands_for_that_of_the_wheel(key):
    run = {name: value for name, value in RUN.items() if name != "output_torque"}
    given = {"input_power": "0.9 kW", "input_torque": "6.2 N m"}[key]
    found = rated(run=run, **{key: given})
    of_result = {"input_power": ("input_power_W", 900.0), "input_torque": ("input_torque_Nm", 6.2)}
    name, value = of_result[key]
    assert found.iso14521[name] == pytest.approx(value, rel=1e-12)
    assert any("follows from operation." + key in note for note in found.notes)
    torque = found.iso14521["T_R"]
    same = rated(run=run, output_torque=f"{torque!r} N m")
    assert safeties(found) == pytest.approx(safeties(same), rel=1e-12)
    many = variants(A100, Operation(**run, **{key: given}), diameter_factor=[12.5])
    assert many["iso14521.safety_wear"][0] == pytest.approx(found.iso14521["S_W"], rel=1e-12)


def test_two_forms_of_the_load_are_refused_and_so_is_less_than_idling():
    with pytest.raises(InputError, match=r"output_torque and operation\.input_power are given"):
        Operation(**RUN, input_power="1 kW")
    run = {name: value for name, value in RUN.items() if name != "output_torque"}
    with pytest.raises(InputError, match=r"output_torque is missing; give one of"):
        Operation(**run)
    with pytest.raises(InputError, match=r"input_power is 20 W; without load the gearbox takes"):
        rated(run=run, input_power="20 W")


SLOW = {**RUN, "output_torque": "300 N m", "worm_speed": "590 rpm"}
PAIR = A100.model_copy(
    update={"starts": 2, "wheel_teeth": 40, "axial_module": "4 mm", "diameter_factor": 10.0}
)


@pytest.mark.parametrize("speed", [30, 250, 590, 1400])
def test_one_part_with_a_speed_of_its_own_is_that_load_alone_in_every_safety(speed):
    alone = rated(PAIR, SLOW, worm_speed=f"{speed} rpm", life="5000 h")
    cycle = rated(PAIR, SLOW, duty_cycle=steps((300, speed, 5000)))
    assert len(safeties(alone)) == 8
    assert safeties(cycle) == pytest.approx(safeties(alone), rel=1e-13)


def test_hours_and_speed_factors_of_bs_721_are_at_the_speed_of_the_greatest_torque():
    bins = (300, 30, 5000), (300, 60, 10), (80, 900, 100)
    cycle = rated(PAIR, SLOW, duty_cycle=steps(*bins)).bs721
    alone = rated(PAIR, SLOW, worm_speed="60 rpm").bs721
    assert (cycle["X_c"], cycle["X_b"]) == (alone["X_c"], alone["X_b"])
    hours = 5000 * 30 / 60 + 10 + 100 * 900 / 60 * (80 / 300) ** 3
    assert cycle["U_w_h"] == pytest.approx(hours, rel=1e-13)


def test_order_does_not_count_where_parts_have_the_greatest_torque_at_several_speeds():
    bins = (300, 30, 5000), (300, 900, 10), (80, 590, 100)
    first = safeties(rated(PAIR, SLOW, duty_cycle=steps(*bins)))
    for order in itertools.permutations(bins):
        found = safeties(rated(PAIR, SLOW, duty_cycle=steps(*order)))
        assert found == pytest.approx(first, rel=1e-13)


def test_speed_of_the_operation_says_nothing_where_every_part_has_its_own():
    one, other = (
        rated(PAIR, SLOW, worm_speed=f"{n} rpm", duty_cycle=steps((300, 30, 500), (99, 900, 9)))
        for n in (20, 1400)
    )
    assert safeties(one) == pytest.approx(safeties(other), rel=1e-13)


def test_a_part_whose_wheel_is_beyond_the_speeds_of_bs_721_leaves_it_without_an_answer():
    # 5 rpm at the worm are 0.25 rpm at the wheel, whose tables start at 0.5 rpm.
    found = rated(PAIR, SLOW, duty_cycle=steps((300, 590, 5000), (80, 5, 100)))
    alone = rated(PAIR, SLOW, worm_speed="5 rpm", output_torque="80 N m", life="100 h")
    assert alone.bs721 is None
    assert found.bs721 is None
    many = variants(
        PAIR,
        Operation(**SLOW, duty_cycle=steps((300, 590, 5000), (80, 5, 100))),
        diameter_factor=[10.0],
    )
    assert np.isnan(many["bs721.safety_wear"]).all()
    assert np.isnan(many["bs721.safety_strength"]).all()


def test_a_part_that_carries_next_to_nothing_is_refused():
    with pytest.raises(InputError, match=r"1e-300 N m, number 1 of the list; it must be at least"):
        Operation(**RUN, duty_cycle=steps((1e-300, 1400, 10)))
    lightest = rated(duty_cycle=steps((250, 1400, 500), (2.6e-7, 1400, 500)))
    assert all(np.isfinite(value) for value in safeties(lightest).values())


def test_sump_of_a_duty_cycle_is_told_of_the_part_that_wears_most():
    meaning = rated(duty_cycle=steps(*BINS)).iso14521.entry("theta_S_degC").meaning
    assert meaning.endswith("in the part of the duty cycle that wears most")
    assert "part" not in rated(life="2 h").iso14521.entry("theta_S_degC").meaning


def test_variants_that_are_rated_block_by_block_are_those_of_one_block(monkeypatch):
    factors = np.linspace(11.0, 14.0, 5)
    whole = variants(A100, Operation(**RUN), diameter_factor=factors)
    for module in ("variants", "variation"):
        monkeypatch.setattr(sys.modules[f"asperity.rating.{module}"], "BLOCK", 2)
    parts = variants(A100, Operation(**RUN), diameter_factor=factors)
    for key in ("iso14521.safety_wear", "bs721.safety_strength", "agma6034.eta"):
        assert parts[key].tolist() == whole[key].tolist(), key


@pytest.mark.slow
@pytest.mark.parametrize("varied", [
    {"diameter_factor": np.linspace(12.0, 13.5, 17)},
    {"diameter_factor": [12.0, 12.5, 13.5]},
    {"worm_speed": [120.0, 150.0]},
])  # fmt: skip
def test_variants_of_a_duty_of_many_parts_have_what_each_has_alone(varied):
    parts = steps(*((250 - 9 * n, 1500 - 40 * n, 50 + 10 * n) for n in range(17)))
    ((name, values),) = varied.items()
    if name == "worm_speed":
        parts = [{key: part[key] for key in part if key != "worm_speed"} for part in parts]
    operation = Operation(**RUN, duty_cycle=parts)
    found = variants(A100, operation, **varied)
    for place, value in enumerate(values):
        gears, run = A100, operation
        if name == "worm_speed":
            run = Operation(**RUN | {name: f"{value} rad/s"}, duty_cycle=parts)
        else:
            gears = A100.model_copy(update={name: float(value)})
        for path, wanted in safeties(rate(gears, run)).items():
            assert found[path][place] == pytest.approx(wanted, rel=1e-9), path
