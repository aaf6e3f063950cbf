"""Load spectra: steps in other words are the same steps, and each counts as the rules have it."""

import itertools
import math

import numpy as np
import pytest
from apparatus.duties import A100, BINS, RUN, rated, safeties, steps

from asperity.casefile import read_case as read
from asperity.commands import case_tables
from asperity.drive.life import life
from asperity.errors import InputError
from asperity.rating import (
    Housing,
    Operation,
    RatingOptions,
    Spectrum,
    rate,
    rate_case,
    variants,
)
from asperity.rating.bs721 import rating as bs721_rating
from asperity.rating.inputs import inputs


def read_case(name):
    return read(name, case_tables())


TURNS = 500 * 60 * 1400 / 50


def spectral(*bins, run=RUN, **more):
    return rate(A100, Operation(**run, spectrum=Spectrum(step=steps(*bins), **more)))


def test_a_spectrum_and_its_short_form_give_the_same_bit_for_bit():
    assert safeties(spectral(*BINS)) == safeties(rated(duty_cycle=steps(*BINS)))


def test_one_step_with_the_constant_load_is_that_load_bit_for_bit():
    life, one = rated(life="5000 h"), spectral((250, 1400, 5000))
    for name in ("iso14521", "bs721", "agma6034"):
        found = {entry.key: entry.value for entry in getattr(one, name)}
        for entry in getattr(life, name):
            if isinstance(entry.value, float):
                assert found[entry.key] == entry.value, (name, entry.key)


def test_steps_split_and_reordered_change_nothing():
    first = safeties(spectral(*BINS))
    split = [(torque, n, hours / 7) for torque, n, hours in BINS for _ in range(7)]
    for bins in (split, split[::-1], split[::3] + split[1::3] + split[2::3]):
        assert safeties(spectral(*bins)) == pytest.approx(first, rel=1e-12)
    for order in itertools.permutations(BINS):
        assert safeties(spectral(*order)) == pytest.approx(first, rel=1e-12)


@pytest.mark.parametrize("pieces", [(7, 7, 7), (1, 1, 9), (40, 1, 25)])
def test_no_number_of_a_rating_moves_where_steps_are_split(pieces):
    # Turns and sliding path too, and what is told of the load that wears most.
    whole, split = (
        {f"{rating.standard}.{entry.key}": entry.value for rating in found.ratings
         for entry in rating}
        for found in (spectral(*BINS), spectral(*((torque, n, hours / count)
                      for (torque, n, hours), count in zip(BINS, pieces, strict=True)
                      for _ in range(count))))
    )  # fmt: skip
    assert whole.keys() == split.keys()
    for key, value in whole.items():
        assert split[key] == (
            pytest.approx(value, rel=1e-12) if isinstance(value, float) else value
        )


def test_turns_and_sliding_path_of_a_duty_are_those_of_all_its_steps():
    found = spectral(*BINS).iso14521
    turns = sum(60.0 * hours * n / found["gear_ratio"] for _, n, hours in BINS)
    assert found["N_L"] == pytest.approx(turns, rel=1e-12)
    alone = sum(spectral(one).iso14521["s_Wm_mm"] for one in BINS)
    assert found["s_Wm_mm"] == pytest.approx(alone, rel=1e-12)


def test_many_steps_go_together_as_arrays_and_give_what_each_gives_alone(monkeypatch):
    draw = np.random.default_rng(24)
    speeds = draw.choice([300.0, 700.0, 1400.0], 60)
    bins = [
        (torque, n, hours)
        for torque, n, hours in zip(
            draw.uniform(20, 250, 60).tolist(),
            speeds.tolist(),
            draw.uniform(1, 99, 60).tolist(),
            strict=True,
        )
    ]
    given = steps(*bins)
    for place, step in enumerate(given):
        step["starts_per_hour"] = place
        step["drives"] = "load" if place % 5 == 0 else "worm"
    run = Operation(**RUN, spectrum=Spectrum(step=given))
    together = rate(A100, run)
    parts = together.duty_cycle
    monkeypatch.setattr("asperity.rating.inputs.MANY", 100)
    alone = rate(A100, run)
    for name in ("iso14521", "bs721", "agma6034"):
        for one, other in zip(getattr(together, name), getattr(alone, name), strict=True):
            assert one.key == other.key
            if isinstance(one.value, float):
                assert one.value == pytest.approx(other.value, rel=1e-12), one.key
    for one, other in zip(parts, alone.duty_cycle, strict=True):
        assert one.to_json() == pytest.approx(other.to_json(), rel=1e-12)


def test_a_step_without_an_answer_among_many_leaves_the_wear_without_one():
    # At 0.2 rpm the tables of BS 721 and the film have no answer; the others have.
    bins = [(250, 1400, 10)] * 30 + [(250, 0.2, 10)]
    found = spectral(*bins)
    few = spectral((250, 1400, 10), (250, 0.2, 10))
    assert (found.bs721 is None) == (few.bs721 is None)
    assert set(safeties(found)) == set(safeties(few))


def test_shares_of_a_life_and_turns_of_the_wheel_are_hours():
    hours = safeties(spectral(*BINS))
    shares = [
        {key: value for key, value in step.items() if key != "duration"} | {"share": share}
        for step, share in zip(steps(*BINS), (0.05, 0.15, 0.3), strict=True)
    ]
    found = rate(A100, Operation(**RUN, spectrum=Spectrum(step=shares, life="10000 h")))
    assert safeties(found) == pytest.approx(hours, rel=1e-13)
    turned = [
        {key: value for key, value in step.items() if key != "duration"}
        | {"turns": 60 * time * n / 50}
        for step, (_, n, time) in zip(steps(*BINS), BINS, strict=True)
    ]
    found = rate(A100, Operation(**RUN, spectrum=Spectrum(step=turned)))
    assert safeties(found) == pytest.approx(hours, rel=1e-12)


def test_turns_stay_turns_where_the_ratio_is_another():
    run = Operation(**RUN, spectrum=Spectrum(step=[{"turns": TURNS, "output_torque": "250 N m"}]))
    wheel = A100.model_copy(update={"wheel_teeth": 49})
    hours = [inputs(one, run, RatingOptions()).duty[0].hours for one in (A100, wheel)]
    assert hours == pytest.approx([500.0, 500.0 * 49 / 50], rel=1e-12)


@pytest.mark.parametrize("key", ["input_power", "input_torque"])
def test_power_or_torque_of_the_worm_in_a_step_becomes_the_torque_of_the_wheel(key):
    found = spectral(*BINS)
    driven = []
    for torque, n, hours in BINS:
        alone = rated(output_torque=f"{torque} N m", worm_speed=f"{n} rpm").iso14521
        value = (
            f"{alone['input_power_W']!r} W"
            if key == "input_power"
            else f"{alone['input_torque_Nm']!r} N m"
        )
        driven.append({"duration": f"{hours} h", "worm_speed": f"{n} rpm", key: value})
    # What rounds in the last digit must not exceed the rated torque.
    run = RUN | {"output_torque": "250.0001 N m"}
    same = rate(A100, Operation(**run, spectrum=Spectrum(step=driven)))
    assert safeties(same) == pytest.approx(safeties(found), rel=2e-6)
    wear = [part.torque for part in same.duty_cycle]
    assert wear == pytest.approx([250, 150, 60], rel=1e-9)


def test_a_step_that_does_not_turn_the_gearbox_is_refused():
    little = [{"duration": "1 h", "input_power": "20 W"}]
    with pytest.raises(InputError, match=r"spectrum\.step\.input_power is 20 W; without load"):
        rate(A100, Operation(**RUN, spectrum=Spectrum(step=little)))
    much = [{"duration": "1 h", "input_power": "20 kW"}]
    with pytest.raises(InputError, match=r"spectrum\.step has a part with .*; none may exceed"):
        rate(A100, Operation(**RUN, spectrum=Spectrum(step=much)))


def test_starts_of_a_step_count_for_its_own_wear():
    plain = spectral((250, 1400, 500), (150, 1400, 1500))
    started = [dict(step) for step in steps((250, 1400, 500), (150, 1400, 1500))]
    started[0]["starts_per_hour"] = 100
    found = rate(A100, Operation(**RUN, spectrum=Spectrum(step=started)))
    was, now = ([part.wear for part in one.duty_cycle] for one in (plain, found))
    assert now == pytest.approx([2.5 * was[0], was[1]], rel=1e-12)


def test_a_load_that_drives_heats_by_the_loss_of_the_teeth_with_the_wheel_driving():
    pair = A100.model_copy(
        update={"starts": 4, "wheel_teeth": 40, "axial_module": "4 mm", "diameter_factor": 10.0}
    )
    step = {"duration": "100 h", "output_torque": "250 N m"}
    up, down = (
        rate(pair, Operation(**RUN, spectrum=Spectrum(step=[{**step, "drives": drives}])))
        for drives in ("worm", "load")
    )
    iso = up.iso14521
    change = iso["loss_meshing_back_W"] - iso["loss_meshing_W"]
    assert change < 0.0
    assert down.duty_cycle[0].loss == pytest.approx(up.duty_cycle[0].loss + change, rel=1e-12)


def test_oil_of_the_mean_is_between_and_by_hours():
    each, mean = spectral(*BINS), spectral(*BINS, oil_temperature="mean")
    hours = [part.hours for part in each.duty_cycle]
    sumps = [part.sump for part in each.duty_cycle]
    expected = math.sumprod(hours, sumps) / sum(hours) if hasattr(math, "sumprod") else (
        sum(h * s for h, s in zip(hours, sumps, strict=True)) / sum(hours)
    )  # fmt: skip
    assert [part.sump for part in mean.duty_cycle] == pytest.approx([expected] * 3, rel=1e-12)
    one, other = spectral(BINS[0]), spectral(BINS[0], oil_temperature="mean")
    assert safeties(one) == safeties(other)


def test_a_class_of_valves_makes_its_steps_of_strokes_and_the_rated_torque():
    made = Spectrum(duty_class="EN 15714-2 A").steps(66.0)
    assert [step.turns for step in made] == pytest.approx([500.0, 4500.0], rel=1e-12)
    assert [step.output_torque for step in made] == pytest.approx([66.0, 44.0 / 3.0], rel=1e-12)
    assert {step.starts_per_hour for step in made} == {30.0}
    # Their mean is 30 % of the rated torque, and at 24 rpm they take 3.472 h.
    assert sum(step.turns * step.output_torque for step in made) == pytest.approx(5000 * 0.3 * 66.0)
    assert sum(step.turns for step in made) / (60 * 24) == pytest.approx(3.472, abs=5e-4)
    (starts,) = Spectrum(duty_class="EN 15714-2 C").steps(500.0)
    assert starts.turns == pytest.approx(1.2e6 / 360.0, rel=1e-12)
    assert (starts.output_torque, starts.starts_per_hour) == (pytest.approx(150.0), 600.0)


def test_gearset_2_as_a_valve_of_class_a_wears_as_another_script_found():
    case = read_case("gearset-2").replace(["spectrum.duty_class=EN 15714-2 A"])
    found = rate_case(case)
    # The other script's 2.83672 is of 14.6667 N m for 44/3.
    assert [part.wear for part in found.duty_cycle] == pytest.approx([2.26304, 2.836712], rel=2e-6)
    assert found.iso14521["delta_Wlim_mm"] == pytest.approx(507.828e-3, rel=1e-5)
    assert found.iso14521["S_W"] == pytest.approx(99.6, abs=0.05)
    assert any("do not count beside [spectrum]" in note for note in found.iso14521.notes)


def test_gearset_3_under_three_loads_is_as_another_script_found():
    case = read_case("gearset-3")
    bins = (366, 1440, 10), (122, 1440, 50), (60, 720, 40)
    run = case["operation"].model_copy(
        update={"wheel_revolutions": None, "spectrum": Spectrum(step=steps(*bins))}
    )
    found = rate(case["gearset"], run, case.get(RatingOptions), folder=case.folder)
    wear = [part.wear for part in found.duty_cycle]
    assert wear == pytest.approx([81.8057, 236.1528, 66.2444], rel=1e-5)
    assert [part.sump for part in found.duty_cycle] == pytest.approx(
        [85.999, 60.085, 41.710], abs=6e-4
    )
    assert [part.loss for part in found.duty_cycle] == pytest.approx(
        [1438.46, 559.12, 213.07], abs=6e-3
    )
    iso, bs = found.iso14521, found.bs721
    assert iso["delta_Wn_mm"] == pytest.approx(384.203e-3, rel=2e-6)
    assert iso["S_W"] == pytest.approx(1.5413, abs=5e-5)
    assert iso["S_H"] == pytest.approx(1.5945, abs=5e-5)
    assert iso["s_ft2_mm"] == pytest.approx(5.42807, abs=5e-6)
    assert iso["tau_F_MPa"] == pytest.approx(123.853, abs=6e-4)
    assert iso["S_F"] == pytest.approx(1.0335, abs=6e-5)
    assert bs["U_w_h"] == pytest.approx(11.940, abs=6e-4)
    assert bs["U_s_h"] == pytest.approx(10.0229, abs=6e-5)
    assert [bs["S_w"], bs["S_s"]] == pytest.approx([1.2350, 1.0559], abs=6e-5)


def test_the_service_factor_takes_the_place_of_the_application_factor_for_agma_alone():
    plain = spectral(*BINS, run=RUN | {"application_factor": 1.1})
    found = spectral(
        *BINS, run=RUN | {"application_factor": 1.1}, hours_per_day=12, shock="moderate"
    )
    assert found.agma6034["S_T"] == pytest.approx(plain.agma6034["S_T"] * 1.1 / 1.5, rel=1e-12)
    assert found.iso14521["S_F"] == plain.iso14521["S_F"]
    factors = [
        Spectrum(step=steps(*BINS), hours_per_day=hours, shock=shock).service_factor(starts)
        for hours, shock, starts in ((0.5, "uniform", 0), (10, "heavy", 10), (24, "heavy", 11))
    ]
    assert factors == [0.8, 1.5, 2.0]


def test_a_peak_of_a_few_seconds_is_none_for_agma():
    run = RUN | {"output_torque": "250 N m"}
    long = spectral((150, 1400, 100), run=run).agma6034["S_T"]
    peak = {"duration": "20 s", "output_torque": "250 N m"}
    step = {"duration": "100 h", "output_torque": "150 N m"}
    found = rate(A100, Operation(**run, spectrum=Spectrum(step=[peak, step])))
    assert found.agma6034["S_T"] == long
    alone = rate(A100, Operation(**run, spectrum=Spectrum(step=[peak])))
    assert alone.agma6034["S_T"] == pytest.approx(long * 150 / 250, rel=1e-12)


@pytest.mark.parametrize("until", ["lasting", "hours"])
def test_life_until_a_limit_is_where_its_safety_comes_to_what_is_asked_and_to_one(until):
    found = spectral(*BINS)
    demands = {"wear": "safety_wear", "pitting": "safety_pitting", "strength": "safety_strength"}
    rows = found.endurance
    assert list(rows) == sorted(rows, key=lambda row: row.lasting)
    assert {row.name for row in rows} >= {"wear", "pitting", "strength"}
    for row in rows:
        times = getattr(row, until) / 5000.0
        then = spectral(*((torque, n, times * hours) for torque, n, hours in BINS))
        if row.name in demands:
            value = safeties(then)[f"{row.standard}.{demands[row.name]}"]
            least = row.asked if until == "lasting" else 1.0
            assert value == pytest.approx(least, rel=1e-9), row


def test_hours_beyond_all_counting_are_not_written_out():
    found = spectral((60, 700, 1e26))
    assert "of 1e+26 asked" in found.brief()
    every = (*found.brief().split(), *(cell for t in found.tables() for r in t.rows for cell in r))
    assert max(len(word) for text in every for word in str(text).split()) < 60
    # What a person counts is written with its thousands.
    assert "h of 5,000 asked" in spectral(*BINS).brief()


def test_life_ends_at_the_root_where_wear_leaves_it_too_thin():
    # Of the gearset whose root holds by three hundredths.
    case = read_case("gearset-3")
    bins = (366, 1440, 10), (122, 1440, 50), (60, 720, 40)

    def found(times):
        scaled = [(torque, n, times * hours) for torque, n, hours in bins]
        run = case["operation"].model_copy(
            update={"wheel_revolutions": None, "spectrum": Spectrum(step=steps(*scaled))}
        )
        return rate(case["gearset"], run, case.get(RatingOptions), folder=case.folder)

    root = next(row for row in found(1.0).endurance if row.name == "root")
    assert 100.0 < root.hours < 154.0
    assert found(root.hours / 100.0).iso14521["S_F"] == pytest.approx(1.0, rel=1e-9)
    # Of the 1.1 that are asked there is too little from the start.
    assert root.lasting < 100.0


def test_what_does_not_hold_at_once_lasts_no_hours():
    weak = A100.model_copy(update={"wheel_material": "EN-GJL-250"})
    run = RUN | {"output_torque": "900 N m"}
    found = rate(weak, Operation(**run, spectrum=Spectrum(step=steps((900, 1400, 10)))))
    assert found.endurance[0].lasting == found.endurance[0].hours == 0.0


def test_starting_takes_what_the_friction_at_rest_asks_for():
    found = spectral(*BINS, duty="S3 15 %")
    agma = next(one for one in found.starting if one.standard == "agma6034")
    assert agma.friction == pytest.approx(0.15)
    assert agma.efficiency == pytest.approx(0.3296, abs=5e-5)
    iso = found.iso14521
    idle = iso["loss_idle_W"] + iso["loss_bearing_W"] + iso["loss_seal_W"]
    assert agma.motor == pytest.approx(
        250.0 / 50.0 / agma.efficiency + idle / (1400 * math.pi / 30), rel=1e-12
    )
    assert agma.brake == 0.0
    assert spectral(*BINS).starting == ()


def test_arrays_of_variants_follow_a_spectrum_with_turns_starts_and_loads_that_drive():
    given = steps(*BINS)
    given[0] = {"turns": 1e5, "output_torque": "250 N m", "starts_per_hour": 40}
    given[2]["drives"] = "load"
    run = Operation(**RUN, spectrum=Spectrum(step=given), housing=Housing(idle_loss="30 W"))
    factors = np.array([12.0, 12.5, 13.5])
    found = variants(A100, run, diameter_factor=factors)
    for place, factor in enumerate(factors):
        alone = rate(A100.model_copy(update={"diameter_factor": factor}), run)
        for path, value in safeties(alone).items():
            assert found[path][place] == pytest.approx(value, rel=1e-12), path


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, r"spectrum\.step is missing; give one of"),
        ({"step": []}, r"spectrum\.step is \[\]; it must be a list of tables"),
        ({"step": steps(*BINS), "duty": "S9"}, r"spectrum\.duty is 'S9'; it must be 'S1'"),
        ({"step": steps(*BINS), "duty": "S3 0 %"}, r"more than 0 and at most 100 %"),
        ({"step": steps(*BINS), "duty": "S2 15 mm"}, r"spectrum\.duty is 'S2 15 mm'"),
        ({"step": steps(*BINS), "life": "9 h"}, r"spectrum\.life is given, but no step"),
        ({"step": [{"share": 0.5, "output_torque": "1 N m"}]}, r"spectrum\.life is missing"),
        (
            {"step": [{"share": 0.6, "output_torque": "1 N m"}] * 2, "life": "9 h"},
            r"spectrum\.step\.share is 1\.2 in all",
        ),
        ({"step": [{"output_torque": "1 N m"}]}, "number 1 of the list: duration is missing; give"),
        ({"step": [{"duration": "1 h"}]}, r"number 1 of the list: output_torque is missing; give"),
        (
            {"step": [{"duration": "1 h", "turns": 3, "output_torque": "1 N m"}]},
            r"spectrum\.step, number 1 of the list: duration and turns are given",
        ),
        ({"duty_class": "EN 15714-2 E"}, r"duty_class is 'EN 15714-2 E'; it must be one of"),
        ({"step": steps(*BINS), "cycles": 9}, r"spectrum\.cycles is given without"),
        ({"step": steps(*BINS), "shock": "hard"}, r"spectrum\.shock is 'hard'; it must be one of"),
    ],
)  # fmt: skip
def test_what_a_spectrum_cannot_be_is_one_line(given, said):
    with pytest.raises(InputError, match=said) as raised:
        Spectrum(**given)
    assert "\n" not in str(raised.value)


def test_two_forms_of_the_same_loads_are_refused():
    with pytest.raises(InputError, match=r"duty_cycle and \[spectrum\] are given; keep one"):
        Operation(**RUN, duty_cycle=steps(*BINS), spectrum=Spectrum(step=steps(*BINS)))
    with pytest.raises(InputError, match=r"spectrum\.step has a part with 260 N m"):
        Operation(**RUN, spectrum=Spectrum(step=steps((260, 1400, 1))))
    with pytest.raises(InputError, match=r"written|write it as \[spectrum\]"):
        Operation(**RUN, spectrum={"step": steps(*BINS)})


def test_a_class_beyond_its_tables_is_refused():
    with pytest.raises(InputError, match=r"the classes of EN 15714-2 end at 32000 N m"):
        Spectrum(duty_class="EN 15714-2 A").steps(33000.0)
    with pytest.raises(InputError, match=r"spectrum\.cycles is missing; the endurance of class D"):
        Spectrum(duty_class="EN 15714-2 D").steps(5000.0)
    run = {key: value for key, value in RUN.items() if key != "output_torque"}
    by_power = Operation(**run, input_power="1 kW", spectrum=Spectrum(duty_class="EN 15714-2 A"))
    found = rate(A100, by_power)
    assert len(found.duty_cycle) == 2


def test_a_life_that_is_shaken_goes_by_each_of_many_steps():
    bins = [(250.0, 1400.0, 10.0)] * 20
    many, one = (
        life(inputs(A100, Operation(**RUN, duty_cycle=steps(*loads)), RatingOptions()), 0.5, 1.2)
        for loads in (bins, [(250.0, 1400.0, 200.0)])
    )
    assert many.wear == pytest.approx(one.wear, rel=1e-12)
    assert many.hours == pytest.approx(one.hours, rel=1e-12)


def test_a_capacity_and_the_masses_it_follows_from_are_refused_together():
    with pytest.raises(
        InputError, match=r"housing\.heat_capacity and housing\.iron are both given"
    ):
        Housing(heat_capacity="9500 J/K", iron="12 kg")


def test_many_steps_of_many_speeds_are_rated_as_few_are(monkeypatch):
    steps = [(1.0 + n % 5, 20.0 + n, f"{70 + 90 * n} rpm") for n in range(30)]
    text = "; ".join(f"{torque:g} N m, {speed}, {hours:g} h" for hours, torque, speed in steps)
    case = read_case("gearset-2").replace([f"spectrum.step={text}"])
    many = rate_case(case, ("bs721",))
    monkeypatch.setattr(bs721_rating, "_FEW", 100)
    one_by_one = rate_case(case, ("bs721",))
    assert many.to_json() == one_by_one.to_json()
    said = (*many.notes, *many.bs721.notes, *many.bs721.violations, *many.bs721.gaps)
    assert sum("the worm is not rated: part" in each for each in said) == 16
    assert any("the worm is not rated: 8 more parts of the duty cycle" in each for each in said)


def test_loads_that_come_and_go_in_cycles_have_the_mean_temperature_unless_told_otherwise():
    in_cycles = spectral(*BINS, duty="S3 40 %")
    told = spectral(*BINS, duty="S3 40 %", oil_temperature="mean")
    assert in_cycles.iso14521.entries == told.iso14521.entries
    each = spectral(*BINS, duty="S3 40 %", oil_temperature="each")
    assert in_cycles.iso14521["delta_Wn_mm"] != each.iso14521["delta_Wn_mm"]
    said = "mean of all steps, which come and go in cycles"
    assert in_cycles.assumed["spectrum.oil_temperature"] == said
    assert any("as the cycles of S3 are alike" in note for note in in_cycles.iso14521.notes)
    for duty in ("S1", "S2 15 min"):
        own = spectral(*BINS, duty=duty)
        assert own.iso14521["delta_Wn_mm"] == each.iso14521["delta_Wn_mm"]
        assert own.assumed["spectrum.oil_temperature"] == "each: the sump settles in each step"
    assert "spectrum.oil_temperature" not in each.assumed
