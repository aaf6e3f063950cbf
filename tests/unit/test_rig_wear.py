"""A wear test: planned by distance, run on a rig whose discs wear, reduced to wear rates."""

import csv
import dataclasses
import functools
import json
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus import rigs

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.runs import Run
from asperity.tribometer.journal_lines import NAME
from asperity.tribometer.pair import Pair
from asperity.tribometer.plan.matrix import planned_files
from asperity.tribometer.plan.study import answer as plan_of
from asperity.tribometer.plan.study import prepare as plan
from asperity.tribometer.procedure.steps import sequence
from asperity.tribometer.reduction import study, wear
from asperity.tribometer.reduction.result import FileResult
from asperity.tribometer.reduction.wear_rate import Stretch, wear_rates
from asperity.tribometer.twin.plant import Plant
from asperity.tribometer.twin.wearing import Wearing

STEEL, BRONZE = 2e-4, 3e-3  # mm3/(N m)
WORN = (
    'plan.steel_supplies=["3 V"]', 'plan.frequencies=["750 Hz"]', 'plan.distance="1.2 m"',
    "plan.stretches=3", 'plan.before="5 s"', 'plan.sample_rate="2 kHz"', 'plan.idle="3 s"',
    f'twin.wear_steel="{STEEL} mm3/(N m)"', f'twin.wear_bronze="{BRONZE} mm3/(N m)"',
    'twin.weighing_noise="0.05 mg"', 'reduction.weighing_uncertainty="0.05 mg"',
)  # fmt: skip


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("wear")
    answer = rigs.run(rigs.small_case(*WORN), folder)
    assert answer.failure is None
    return folder


def reduced(folder, *settings):
    names = sorted(str(path) for path in folder.glob("file-*.nc"))
    case = study.read("", case_tables(), settings, recordings=names)
    return study.answer(study.prepare(case), Run())


@pytest.fixture(scope="module")
def answer(run):
    return reduced(run)


@pytest.mark.slow
def test_a_wear_rate_holds_what_the_discs_were_made_to_lose(answer):
    assert [(one.disc, one.frequency, one.weighings) for one in answer.rates] == [
        ("steel", 0.0, 4), ("bronze", 0.0, 4), ("steel", 750.0, 4), ("bronze", 750.0, 4),
    ]  # fmt: skip
    for one in answer.rates:
        true = STEEL if one.disc == "steel" else BRONZE
        assert one.wear_rate.low < true < one.wear_rate.high
        assert one.wear_rate.value == pytest.approx(true, rel=0.5 if one.disc == "steel" else 0.05)
        hardness = 6.5e9 if one.disc == "steel" else 1.5e9
        assert one.archard == pytest.approx(1e-9 * one.wear_rate.value * hardness, rel=1e-12)
    still, shaken = answer.rates[1], answer.rates[3]
    assert still.path == still.distance
    assert shaken.path > 1.15 * shaken.distance
    # Over the same distance more is lost, by the path; that of vibration has the doubt of v_a.
    assert shaken.wear_rate_by_distance.low > 1.1 * BRONZE
    names = [part.name for part in shaken.budgets["wear_rate"].contributions]
    assert names == ["weighings", "velocity of the vibration"]


@pytest.mark.slow
def test_the_path_of_a_reduction_is_that_which_wore_the_discs_away(run, answer):
    done = [line for line in rigs.journal(run) if line["kind"] == "done"]
    paths = [line["memory"]["path"] for line in done if "steel_kg" in line]
    assert len(paths) == 8
    for place, one in ((0, answer.rates[0]), (4, answer.rates[2])):
        assert one.path == pytest.approx(paths[place + 3] - paths[place], rel=0.02)
    # Stretches are as long as was asked for, but for what a second and the stop add.
    asked = [line["distance_m"] for line in done if "distance_m" in line]
    assert len(asked) == 6
    assert all(0.4 <= far < 0.45 for far in asked)
    # What encoders tell of the stop comes when the stretch is over: half a second of 43 mm/s.
    late = [one.distance - far for one, far in zip(answer.files, asked, strict=True)]
    assert all(0.0 < far < 0.043 for far in late)


@pytest.mark.slow
def test_wear_over_distance_is_written_as_all_else_is(run, answer, tmp_path):
    names = answer.write(tmp_path)
    assert "wear.csv" in names
    with (tmp_path / "wear.csv").open() as file:
        rows = list(csv.DictReader(file))
    told = json.loads((tmp_path / "reduce.json").read_text())["wear_by_distance"]
    assert len(rows) == len(told) == 4
    for row, one, rate in zip(rows, told, answer.rates, strict=True):
        assert float(row["wear_rate_mm3_per_Nm"]) == rate.wear_rate.value
        assert one["wear_rate_ci95_mm3_per_Nm"] == [rate.wear_rate.low, rate.wear_rate.high]
    dataset = answer.to_dataset()
    assert dataset["worn_wear_rate"].values.tolist() == [
        one.wear_rate.value for one in answer.rates
    ]
    text = (tmp_path / "budget.csv").read_text()
    assert "setting-2, bronze" in text
    assert "wear_rate_by_distance,mm3/(N m)" in text
    said = " ".join(line for one in answer.tables() for line in one.remarks)
    assert "bronze disc, 750 Hz transverse: over the same distance" in said


@pytest.mark.slow
def test_one_stretch_that_is_not_there_leaves_the_others_to_themselves(run):
    names = sorted(str(path) for path in run.glob("file-*.nc"))
    case = study.read("", case_tables(), (), recordings=names[:1] + names[2:])
    found = study.answer(study.prepare(case), Run())
    assert [(one.setting, one.weighings) for one in found.rates if one.disc == "steel"] == [
        ("setting-1", 2), ("setting-1", 2), ("setting-2", 4),
    ]  # fmt: skip
    assert any("file-02.nc lies between them" in note for note in found.notes)


def weighed(masses, ways, doubt=0.0, unknown=()):
    """Stretches of a run of the steel disc, by its masses in mg and the ways between."""
    for place, way in enumerate(ways):
        pair = 1e-6 * masses[place], 1e-6 * masses[place + 1]
        path = None if place in unknown else 2.0 * way
        file = FileResult(file=f"{place}", distance=way, path=path, path_deviation=doubt * way)
        weighing = wear.Weighing("setting-1", {"steel": pair}, (f"{place}",))
        yield Stretch(weighing, [file], [], "transverse", "oil")


@functools.cache
def pair_of_the_rig():
    return Pair.from_case(read_case("rig-final", case_tables()))


def rates_of(masses, ways, uncertainty, doubt=0.0, confidence=0.95):
    pair, notes = pair_of_the_rig(), []
    stretches = list(weighed(masses, ways, doubt))
    found = list(wear_rates(pair, stretches, uncertainty, confidence, notes))
    return pair, found, notes


def test_a_wear_rate_is_the_slope_of_the_masses_over_force_and_density():
    pair, (one,), notes = rates_of([100.0, 98.0, 96.0, 94.0], [10.0, 10.0, 10.0], 0.1e-6)
    # 6 mg of 7850 kg/m3 under 141.6 N over 30 m, and over a path of 60 m.
    by_distance = 6e-6 / 7850.0 / pair.load / 30.0 * 1e9
    assert one.wear_rate_by_distance.value == pytest.approx(by_distance, rel=1e-9)
    assert one.wear_rate.value == pytest.approx(0.5 * by_distance, rel=1e-9)
    assert one.mass_loss == pytest.approx(6.0, rel=1e-9)
    # Of a line through points at 0, 10, 20, 30 m: u / sqrt(500) m.
    half = 1.959964 * 0.1e-6 / np.sqrt(500.0) / 7850.0 / pair.load * 1e9
    ends = one.wear_rate_by_distance
    assert ends.high - ends.value == pytest.approx(half, rel=1e-5)
    assert not notes


def test_what_is_not_known_of_the_vibration_widens_the_rate_by_path_alone():
    _, (sure,), _ = rates_of([100.0, 98.0, 96.0], [10.0, 10.0], 1e-9)
    _, (unsure,), _ = rates_of([100.0, 98.0, 96.0], [10.0, 10.0], 1e-9, doubt=0.1)
    # A doubt of 0.1 m in a path of 2 m: a twentieth.
    spread = unsure.wear_rate.deviation / unsure.wear_rate.value
    assert spread == pytest.approx(0.05, rel=1e-3)
    assert unsure.wear_rate_by_distance.deviation == sure.wear_rate_by_distance.deviation


@pytest.mark.slow
def test_intervals_of_random_weighings_hold_the_truth_as_often_as_they_say():
    rng = np.random.default_rng(3)
    ways, loss, sd = np.array([5.0, 8.0, 4.0, 9.0]), 0.3, 0.4
    places = np.concatenate(([0.0], np.cumsum(ways)))
    for uncertainty in (sd * 1e-6, None):
        held = 0
        for _ in range(400):
            masses = 100.0 - loss * places + rng.normal(0.0, sd, places.size)
            pair, (one,), _ = rates_of(list(masses), list(ways), uncertainty)
            true = loss * 1e-6 / 7850.0 / pair.load * 1e9
            held += one.wear_rate_by_distance.low < true < one.wear_rate_by_distance.high
        assert 0.92 <= held / 400 <= 0.98


def test_weighings_that_tell_no_interval_say_what_to_give():
    _, (one,), notes = rates_of([100.0, 98.0], [10.0], None)
    assert one.wear_rate is None
    assert "reduction.weighing_uncertainty" in notes[0]
    _, (one,), notes = rates_of([100.0, 100.0, 100.0], [10.0, 10.0], None)
    assert one.wear_rate is None
    assert "showed the same each time" in notes[0]
    # A balance that is known to 0.1 mg says of nothing lost that it is no more than so much.
    _, (one,), _ = rates_of([100.0, 100.0], [10.0], 0.1e-6)
    assert one.wear_rate.value == 0.0 < one.wear_rate.high


@pytest.mark.parametrize("mode", ["longitudinal", "transverse"])
@pytest.mark.parametrize("k", [0.0, 0.6, 1.0, 1.7, 4.0])
def test_simulated_discs_wear_on_the_path_of_the_closed_form(mode, k):
    case = rigs.small_case(*WORN)
    worn = Wearing(Plant.from_case(case))
    shaken = case["sonotrode"].velocity(mode, 750.0)
    velocity = shaken / k if k else 0.04
    worn.slide((velocity, velocity), 10.0, (mode, "sine", 750.0) if k else None)
    share = wear.path_share(k, mode) if k else 1.0
    assert worn.path == pytest.approx(10.0 * velocity * share, rel=1e-4)


def planned(*settings):
    return plan_of(plan(rigs.small_case(*WORN, *settings)), Run())


def test_a_wear_test_has_a_file_a_stretch_and_new_discs_a_run():
    told = planned("plan.repeats=2")
    assert (told.file_count, told.settings, told.distinct_cells) == (12, 4, 6)
    assert told.frequency.tolist() == 2 * [0.0, 0.0, 0.0, 750.0, 750.0, 750.0]
    assert planned("plan.unshaken=false").file_count == 3
    # As long as the distance takes at the velocity of the simulated rig, about 42 mm/s at 3 V.
    assert planned().recording_time == pytest.approx(2.4 / 0.042 + 6 * 3.0, rel=0.1)
    case = rigs.small_case(*WORN)
    files = planned_files(case["plan"], case["limits"])
    weighed = [one.steps for one in sequence(files) if one.act == "weigh"]
    assert weighed == 2 * [(2,), (26,), (26,), (26,)]
    # Nothing that slides uncounted lies between two weighings.
    acts = [one.act for one in sequence(files) if one.act in ("weigh", "trial", "cell")]
    assert acts == 2 * ["trial", "weigh", "cell", "weigh", "cell", "weigh", "cell", "weigh"]


@pytest.mark.parametrize(
    ("settings", "told"),
    [
        (('plan.distance="0 m"',), "plan.distance"),
        (("plan.stretches=0",), "plan.stretches"),
        (('plan.distance="9 N"',), "plan.distance"),
        (('twin.wear_steel="-1 mm3/(N m)"',), "twin.wear_steel"),
    ],
)  # fmt: skip
def test_bad_wear_tests_are_refused(settings, told):
    with pytest.raises(InputError, match=told):
        planned(*settings)


def test_a_worm_and_its_wheel_are_not_weighed():
    case = read_case("rig-gear", case_tables(), ('plan.distance="3 m"',))
    with pytest.raises(InputError, match=r"plan\.distance is of discs"):
        plan(case)


def test_a_plan_says_what_its_weighings_will_not_tell():
    blind = rigs.small_case(*WORN[:-1], "plan.stretches=1", "plan.unshaken=false")
    told = " ".join(plan_of(plan(blind), Run()).notes)
    assert "a wear rate has no interval" in told
    assert "what vibration adds cannot be told" in told
    assert "wear rate" not in " ".join(planned().notes)


def test_where_one_vibration_is_not_known_there_is_no_rate_by_path():
    pair, notes = pair_of_the_rig(), []
    masses, ways = [10.0, 9.0, 8.0, 7.0], [1.0, 1.0, 1.0]
    (known,) = wear_rates(pair, list(weighed(masses, ways)), 1e-10, 0.95, notes)
    assert not notes
    run = list(weighed(masses, ways, unknown=(1,)))
    (found,) = wear_rates(pair, run, 1e-10, 0.95, notes)
    assert (found.path, found.wear_rate, found.archard) == (None, None, None)
    assert found.wear_rate_by_distance.value == known.wear_rate_by_distance.value
    assert "nor so the path; its wear rate is by distance alone" in notes[0]
    assert wear.path_of([FileResult(file="0", distance=1.0, path=2.0)]) == 2.0
    # A zero is a path that is known: nobody slid.
    assert wear.path_of([FileResult(file="0", distance=0.0, path=0.0)]) == 0.0


def test_a_run_has_the_frequency_of_its_vibration_and_none_has_zero():
    (still,) = rates_of([10.0, 9.0], [1.0], 1e-10)[1]
    assert still.frequency == 0.0
    # One stretch that begins with a segment before the vibration, and no other.
    (stretch,) = weighed([10.0, 9.0], [1.0])
    segments = [SimpleNamespace(commanded=told) for told in (None, 750.0)]
    shaken = dataclasses.replace(stretch, segments=segments)
    (found,) = wear_rates(pair_of_the_rig(), [shaken], 1e-10, 0.95, [])
    assert found.frequency == 750.0


@pytest.mark.parametrize("begun", ["", "{", '{"line": 4, "kind": "do'])
def test_a_line_of_the_journal_that_is_half_written_takes_no_weighing_away(tmp_path, begun):
    lines = [
        {"steps": [2], "steel_kg": 0.1, "bronze_kg": 0.2},
        {"recording": "file-01.nc"},
        {"steps": [26], "steel_kg": 0.0999, "bronze_kg": 0.1998, "action": "setting-1/weigh"},
    ]
    whole = [
        json.dumps({"line": number, "kind": "done", **line}) + "\n"
        for number, line in enumerate(lines, start=1)
    ]
    (tmp_path / NAME).write_text("".join(whole) + begun)
    masses = {"steel": (0.1, 0.0999), "bronze": (0.2, 0.1998)}
    found, why = wear.weighings_in([tmp_path])
    assert not why
    assert found == [(tmp_path, wear.Weighing("setting-1", masses, ("file-01.nc",)))]
