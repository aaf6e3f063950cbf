"""Heat balances of published examples, and of a gearset that another script calculated.

Jindal, Machine Design, example 28-5; student projects on worm gearboxes; Chirkov and Stavishenko,
Calculation of toothed and screw gears, for the area.
"""

import math

import pytest
from apparatus.duties import A100, BINS, RUN, steps

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.rating import Housing, Operation, RatingOptions, Spectrum, rate, rate_case
from asperity.rating.agma6034.thermal import minimum_housing_area
from asperity.rating.iso14521 import balance
from asperity.rating.starting import starting_efficiency

KELVIN = {"heat_transfer": "15 W/(m**2 K)", "heat_capacity": "9500 J/K"}


def housed(housing=KELVIN, **spectrum):
    # The known numbers are those of the loss of the greatest load.
    spectrum = {"oil_temperature": "each", **spectrum}
    loads = Spectrum(step=steps(*BINS), **spectrum)
    return rate(A100, Operation(**RUN, spectrum=loads, housing=Housing(**housing))).iso14521


def test_jindal_28_5_rises_by_19_kelvin():
    # 4 kW at 1000 rpm, 2/54, q 10, m 8, mu 0.028; the book has 0.865 and 18.7 K.
    lead, normal = math.atan(0.2), math.radians(20.0)
    eta = float(starting_efficiency(lead, 0.028, normal))
    assert eta == pytest.approx(0.865147, abs=6e-7)
    loss = 4000.0 * (1.0 - eta)
    assert loss == pytest.approx(539.4, abs=0.05)
    rise = balance.steady_rise(loss, balance.conductance(16.0, 1.8))
    assert rise == pytest.approx(18.73, abs=5e-3)


def test_other_published_balances():
    rise = balance.steady_rise(2634.0 * (1.0 - 0.877), balance.conductance(15.0, 0.73))
    assert rise == pytest.approx(29.587, abs=6e-4)
    eta = float(starting_efficiency(math.radians(6.0), 0.05, math.radians(22.0)))
    assert eta == pytest.approx(0.65716, abs=6e-6)
    # 50 K by 0.30 m2 and 23 W/(m2 K) carry this power.
    assert 50.0 * 0.30 * 23.0 / (1.0 - eta) == pytest.approx(1006.3, abs=0.06)


def test_areas_of_housings():
    areas = [float(balance.housing_area(a)) for a in (100.0, 63.0)]
    assert areas == pytest.approx([0.39905, 0.18193], abs=5e-6)


@pytest.mark.parametrize(
    ("rule", "known"),
    [
        ("half ribbed", (0.39905, 0.18193)),
        ("well ribbed", (0.45107, 0.19188)),
        ("AGMA minimum", (0.28637, 0.13056)),
    ],
)
def test_the_area_goes_by_the_rule_that_is_named(rule, known):
    for a, area in zip((100.0, 63.0), known, strict=True):
        assert float(balance.AREAS[rule](a)) == pytest.approx(area, abs=5e-6)
    rated = rate_case(read_case("actuator-duty", case_tables(), [f"housing.area_rule={rule}"]))
    entry = rated.iso14521.entry("A_h_m2")
    assert entry.value == pytest.approx(known[0], abs=5e-6)
    assert entry.equation == balance.AREAS[rule].equation
    assert entry.source == balance.AREAS[rule].source
    assert "housing.area" not in rated.assumed


def test_the_least_area_is_that_of_the_rating_by_agma():
    for a in (40.0, 63.0, 100.0, 250.0):
        assert float(balance.least_area(a)) == pytest.approx(float(minimum_housing_area(a)))


def test_area_and_rule_are_not_both_given():
    with pytest.raises(InputError, match=r"housing\.area and housing\.area_rule are both given"):
        Housing(area="0.4 m**2", area_rule="well ribbed")


@pytest.mark.parametrize(
    ("duty", "cycle", "at_rest", "top", "low"),
    [
        ("S3 15 %", "10 min", 1.0, 12.261, 8.892),
        ("S3 15 %", "60 min", 1.0, 22.524, 3.276),
        ("S3 40 %", "10 min", 1.0, 31.213, 24.879),
        ("S3 40 %", "10 min", 0.6, 39.347, None),
        ("S2 15 min", "10 min", 1.0, 30.304, None),
        ("S1", "10 min", 1.0, 70.016, None),
    ],
)
def test_a_gearset_of_100_mm_warms_by_its_duty(duty, cycle, at_rest, top, low):
    own = {**KELVIN, "at_rest": f"{15 * at_rest} W/(m**2 K)"}
    found = housed(own, duty=duty, cycle=cycle)
    assert found["K_h_W_K"] == pytest.approx(5.98579, abs=6e-6)
    assert found["loss_heating_W"] == pytest.approx(419.1, abs=5e-3)
    assert found["rise_h_K"] == pytest.approx(70.016, abs=6e-4)
    assert found["tau_s"] == pytest.approx(1587.1, abs=0.05)
    assert found["theta_h_degC"] == pytest.approx(20.0 + top, abs=6e-4)
    if low is not None:
        assert found["rise_low_K"] == pytest.approx(low, abs=6e-4)
    assert found["safety_temperature"] == found["theta_S_lim_degC"] / found["theta_h_degC"]


def test_many_short_cycles_come_to_the_share_of_load():
    assert housed(duty="S3 40 %", cycle="1 s")["rise_top_K"] == pytest.approx(
        0.4 * 70.016, rel=2e-4
    )


def test_cycles_follow_the_equation_of_one_mass_step_by_step():
    # March one mass through loads and rests until it repeats.
    loss, conducts, rests, capacity, share, cycle = 419.1, 6.0, 3.5, 9500.0, 0.3, 1800.0
    rise, steps_a_phase = 0.0, 20000
    top = 0.0
    for _ in range(40):
        for time, heat, away in ((share * cycle, loss, conducts), ((1 - share) * cycle, 0, rests)):
            step = time / steps_a_phase
            rise = (rise - heat / away) * math.exp(-away * step / capacity) ** steps_a_phase + (
                heat / away
            )
            top = max(top, rise)
    found = balance.rise_in_cycles(
        loss / conducts, share, cycle, capacity / conducts, capacity / rests
    )
    assert found == pytest.approx(top, rel=1e-9)


def test_a_speed_of_measurement_without_a_loss_that_was_measured_is_refused():
    with pytest.raises(InputError, match=r"housing\.measured_at is given without a loss"):
        Housing(measured_at="1400 rpm")


def test_measured_losses_take_the_place_of_the_formulas_at_every_speed():
    own = {**KELVIN, "idle_loss": "30 W", "seal_loss": "8 W", "measured_at": "1400 rpm"}
    run = Operation(**RUN | {"worm_speed": "700 rpm"}, housing=Housing(**own))
    found = rate(A100, run).iso14521
    assert found["loss_idle_W"] == pytest.approx(30.0 * 0.5 ** (4 / 3), rel=1e-12)
    assert found["loss_seal_W"] == pytest.approx(4.0, rel=1e-12)
    parts = found["loss_meshing_W"] + found["loss_bearing_W"]
    assert found["loss_total_W"] == pytest.approx(parts + 30.0 * 0.5 ** (4 / 3) + 4.0, rel=1e-12)
    assert found.entry("loss_idle_W").source.name == "the case"


def test_the_sump_formula_and_the_balance_of_gearset_3_contradict_and_it_is_said():
    case = read_case("gearset-3", case_tables())
    run = case["operation"].with_tables(housing=Housing())
    rated = rate(case["gearset"], run, case.get(RatingOptions), folder=case.folder)
    found = rated.iso14521
    assert found["loss_total_W"] / (found["theta_S_degC"] - 20.0) == pytest.approx(21.8, abs=0.05)
    assert found["K_h_W_K"] == pytest.approx(3.7, abs=0.05)
    assert found["rise_h_K"] == pytest.approx(392.5, abs=0.05)
    assert found["k_S_W_m2K"] == pytest.approx(89.0, abs=0.5)
    assert any("which knows no losses" in note for note in found.notes)
    assert not rated.verdict.holds["iso14521"]
    as_before = rate(case["gearset"], case["operation"], case.get(RatingOptions))
    assert "theta_h_degC" not in as_before.iso14521
    assert not any("which knows no losses" in note for note in housed().notes)


def test_a_duty_without_a_heat_capacity_is_judged_as_warm_as_it_gets():
    found = housed({"heat_transfer": "15 W/(m**2 K)"}, duty="S3 15 %")
    assert found["theta_h_degC"] == pytest.approx(90.016, abs=6e-4)
    assert any("give [housing] with heat_capacity" in note for note in found.notes)


def test_masses_make_the_heat_capacity():
    assert Housing(iron="10 kg", oil="2 kg").capacity == 10 * 460.0 + 2 * 1900.0
    assert Housing().capacity is None


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"area": "0.4 m"}, r"housing\.area is '0\.4 m'; it must be an area such as"),
        ({"heat_transfer": "-3 W/(m**2 K)"}, r"housing\.heat_transfer is .* it must be above 0"),
        ({"idle_los": "30 W"}, r"housing\.idle_los is not a key of \[housing\].*idle_loss"),
    ],
)
def test_what_a_housing_cannot_be_is_one_line(given, said):
    with pytest.raises(InputError, match=said):
        Housing(**given)
