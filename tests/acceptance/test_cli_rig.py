"""``asperity rig`` and ``asperity fit`` as a laboratory uses them."""

import csv
import dataclasses
import json
import math

import numpy as np
import pytest
import xarray
from apparatus.heard_rig import SMALL, faulty
from apparatus.rig_signals import NOISY, TORQUE, record, run_of

from asperity.files.store import write_dataset
from asperity.results import read
from asperity.results.interval import Interval
from asperity.tribometer.recording import Recorder, Source
from asperity.tribometer.reduction.result import SegmentResult
from asperity.tribometer.reduction.study import repeats
from asperity.tribometer.reduction.wear import path_share

FREQUENCIES, RATIOS, RATE = (250.0, 500.0), (0.31, 0.22), 5e3
KEYS = [
    "file", "mode", "lubricant", "waveform", "frequency_Hz", "commanded_Hz", "motor_voltage_V",
    "torque_before_Nm", "torque_before_ci95_Nm", "torque_with_Nm", "torque_with_ci95_Nm",
    "torque_change_percent", "torque_change_ci95_percent", "power_change_percent",
    "power_change_ci95_percent", "efficiency_change_points", "efficiency_change_ci95_points",
    "sliding_velocity_before_mm_s",
    "sliding_velocity_before_ci95_mm_s", "sliding_velocity_with_mm_s",
    "sliding_velocity_with_ci95_mm_s", "slide_roll_ratio", "k_v", "k_v_ci95", "model_ratio",
    "turns_seen", "quality", "flags",
]  # fmt: skip


def phases(**options):
    return run_of(frequencies=FREQUENCIES, ratios=RATIOS, duration=6.0, **options)


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    return record(tmp_path_factory.mktemp("rig") / "run-1.nc", phases(), rate=RATE, compress=True)


@pytest.fixture(scope="module")
def reduced(asperity, recording):
    code, output, errors = asperity("rig", "reduce", recording, "--json")
    assert code == 0, errors
    return json.loads(output)


@pytest.fixture(scope="module")
def written(asperity, recording, tmp_path_factory):
    """The files of a reduction."""
    folder = tmp_path_factory.mktemp("written") / "out"
    code, _, errors = asperity("rig", "reduce", recording, "--out", folder)
    assert code == 0, errors
    return folder


@pytest.mark.slow
def test_a_reduction_has_the_keys_of_the_contract(reduced):
    assert reduced.keys() >= {"segments", "runout_percent", "noise_Nm", "gaps", "notes"}
    assert [list(one) for one in reduced["segments"]] == [KEYS, KEYS]


@pytest.mark.slow
def test_segments_hold_what_was_put_in(reduced):
    for one, frequency, ratio in zip(reduced["segments"], FREQUENCIES, RATIOS, strict=True):
        assert one["frequency_Hz"] == pytest.approx(frequency, rel=1e-4)
        assert one["commanded_Hz"] == frequency
        assert one["waveform"] == "sine"
        assert one["motor_voltage_V"] == 1.0
        assert one["torque_before_Nm"] == pytest.approx(TORQUE, rel=0.03)
        for name, torque in (("before", TORQUE), ("with", TORQUE * ratio)):
            low, high = one[f"torque_{name}_ci95_Nm"]
            assert low < torque < high
            # A part of a turn is seen: run-out of a few percent may lie on it.
            assert 0.02 * torque < high - low < 0.14 * TORQUE
        low, high = one["torque_change_ci95_percent"]
        assert low < 100.0 * (ratio - 1.0) < high
        assert high - low < 6.0
        assert one["sliding_velocity_before_mm_s"] == pytest.approx(2.5, abs=0.05)
        assert one["sliding_velocity_with_mm_s"] == pytest.approx(5.5, abs=0.05)
        power = ratio * (5.5 + 2.86) / (2.5 + 2.86) - 1.0
        low, high = one["power_change_ci95_percent"]
        assert low < 100.0 * power < high
        assert high - low < 6.0
        low, high = one["sliding_velocity_with_ci95_mm_s"]
        assert low < 5.5 < high < 5.7
        assert one["k_v"] == pytest.approx({250.0: 20.0, 500.0: 33.0}[frequency] / 4.0, rel=0.02)


@pytest.mark.slow
def test_files_of_a_reduction_hold_its_numbers(written, reduced):
    with (written / "reduce.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, one in zip(rows, reduced["segments"], strict=True):
        assert float(row["torque_change_percent"]) == one["torque_change_percent"]
        assert float(row["low_percent"]) == one["torque_change_ci95_percent"][0]
        ends = [float(row[f"power_change_{end}_percent"]) for end in ("low", "high")]
        assert ends == one["power_change_ci95_percent"]
        assert float(row["k_v_before"]) > one["k_v"] > float(row["k_v_with"])
    saved = read(written / "reduce.nc")
    assert saved.dataset["torque_change"].values == pytest.approx(
        [one["torque_change_percent"] for one in reduced["segments"]]
    )
    assert saved.dataset["k_v_ci95"].values.tolist() == [
        one["k_v_ci95"] for one in reduced["segments"]
    ]
    assert saved.figure() is not None


@pytest.mark.slow
def test_an_accelerometer_tells_the_velocity_of_the_vibration(asperity, tmp_path):
    # (76): a peak of 200 m/s2 at 500 Hz is 63.7 mm/s, at 250 Hz twice that.
    channel = (
        'channels.acceleration={channel="I", points=[["0 V","0 m/s**2"],["5 V","500 m/s**2"]]}'
    )
    path = record(
        tmp_path / "run.nc", phases(), dataclasses.replace(NOISY, acceleration=200.0), rate=RATE,
        settings=(channel,),
    )  # fmt: skip
    code, _, errors = asperity("rig", "reduce", path, "--out", tmp_path / "out")
    assert code == 0, errors
    with (tmp_path / "out" / "reduce.csv").open(newline="", encoding="utf-8") as file:
        for row, frequency in zip(csv.DictReader(file), FREQUENCIES, strict=True):
            peak = 1e3 * 200.0 / (2.0 * math.pi * frequency)
            assert float(row["velocity_amplitude_mm_per_s"]) == pytest.approx(peak, rel=2e-3)
            assert float(row["k_v_with"]) == pytest.approx(peak / 5.5, rel=0.02)


@pytest.mark.slow
def test_weighings_give_archards_coefficient_on_the_path_of_the_discs(asperity, recording):
    lost = ("--set", "steel_disc.mass_loss=2 mg", "--set", "bronze_disc.mass_loss=9 mg")
    code, output, errors = asperity("rig", "reduce", recording, *lost, "--json")
    assert code == 0, errors
    answer = json.loads(output)
    steel, bronze = answer["wear_together"]
    # Two segments: six seconds at 2.5 mm/s, six at 5.5 mm/s.
    assert steel["distance_m"] == pytest.approx(0.096, rel=0.02)
    # Across the sliding at k 3.6 and 6 the path is some 2.5 and 3.9 times the distance.
    shares = [path_share(one["k_v"] * 4.0 / 5.5, "transverse") for one in answer["segments"]]
    path = 0.006 * 2.5 * 2.0 + 0.006 * 5.5 * sum(shares)
    assert bronze["path_m"] == pytest.approx(path, rel=0.02)
    volume = 9e-6 / 7600.0
    assert bronze["archard"] == pytest.approx(
        volume * 1.5e9 / (141.64 * bronze["path_m"]), rel=1e-3
    )


SERIES = "file-01.nc", "file-02.nc"


@pytest.fixture(scope="module")
def series(asperity, recording, tmp_path_factory):
    """A folder as a run leaves it, and what its report prints."""
    folder = tmp_path_factory.mktemp("series")
    for name in SERIES:
        (folder / name).write_bytes(recording.read_bytes())
    (folder / "<script>.nc").write_bytes(b"no recording")
    told = [
        {"kind": "started", "backend": "hardware"},
        {"kind": "done", "action": "setting-1/step-2", "steps": [2], "steel_kg": 0.177002,
         "bronze_kg": 0.096709},
        *({"kind": "done", "action": "cell", "steps": [17], "recording": name} for name in SERIES),
        {"kind": "done", "action": "setting-1/step-26", "steps": [26], "steel_kg": 0.177,
         "bronze_kg": 0.0967},
    ]  # fmt: skip
    rows = [json.dumps({"line": place, **line}) for place, line in enumerate(told, start=1)]
    (folder / "journal.jsonl").write_text("\n".join(rows) + "\n", "utf-8")
    code, output, errors = asperity("rig", "report", folder, "--json")
    assert code == 0, errors
    return folder, output


@pytest.mark.slow
def test_weighings_of_a_run_become_its_wear(asperity, series):
    folder, output = series
    steel, bronze = json.loads(output)["wear_together"]
    assert steel["mass_loss_mg"] == pytest.approx(2.0)
    assert (bronze["setting"], bronze["files"]) == ("setting-1", list(SERIES))
    assert bronze["distance_m"] == pytest.approx(2 * 0.096, rel=0.02)
    volume = 9e-6 / 7600.0
    assert bronze["archard"] == pytest.approx(
        volume * 1.5e9 / (141.64 * bronze["path_m"]), rel=1e-3
    )
    assert "9 mg lost over" in (folder / "report.html").read_text("utf-8")
    # What lies between two weighings is needed whole.
    answer = json.loads(asperity("rig", "reduce", folder / SERIES[0], "--json")[1])
    assert "wear_together" not in answer
    assert any("file-02.nc lies between them as well" in note for note in answer["notes"])


def test_path_along_the_sliding_is_no_longer_below_k_of_one():
    assert path_share(0.97, "longitudinal") == 1.0
    turn = np.linspace(0.0, 2.0 * math.pi, 100_001)
    for k in (1.5, 4.0):
        along = np.trapezoid(np.abs(1.0 - k * np.cos(turn)), turn) / (2.0 * math.pi)
        across = np.trapezoid(np.hypot(1.0, k * np.cos(turn)), turn) / (2.0 * math.pi)
        assert path_share(k, "longitudinal") == pytest.approx(along, rel=1e-6)
        assert path_share(k, "transverse") == pytest.approx(across, rel=1e-6)


def test_repeats_of_a_cell_are_pooled():
    def measured(frequency, change):
        return SegmentResult(
            file="", mode="transverse", lubricant="oil", waveform="sine", commanded=frequency,
            motor_voltage=1.0, torque_change=Interval(change, None, None), quality="good",
        )  # fmt: skip

    # Of 2 and 4 about 3, and of 10, 10 and 13 about 11: squares of 2 and 6, freedoms of 1 and 2.
    changes = (250.0, 2.0), (250.0, 4.0), (750.0, 10.0), (750.0, 10.0), (750.0, 13.0), (1e3, 7.0)
    deviation, freedom = repeats([measured(*one) for one in changes])
    assert (deviation, freedom) == (pytest.approx(math.sqrt(8.0 / 3.0)), 3)
    assert repeats([measured(250.0, 2.0)]) == (None, 0)


@pytest.mark.slow
def test_a_calibration_past_its_last_day_leaves_nothing_good(asperity, recording):
    dated = 'channels.torque_steel={channel="A", points=[["-5 V","-2 N m"],["5 V","2 N m"]], '
    dated += "date=2023-03-01, valid_days=365}"
    other = 'channels.speed_bronze={channel="D", points=[["0 V","0 rpm"],["5 V","500 rpm"]], '
    other += "date=2026-01-30, valid_days=1}"
    given = "--set", dated, "--set", other
    segments = json.loads(asperity("rig", "reduce", recording, *given, "--json")[1])
    flags = [one for one in segments["segments"][0]["flags"] if "calibration" in one]
    # From 1 March 2023 to 1 March 2026, and from 30 January.
    assert flags == [
        "the calibration of torque_steel was due by 2024-02-29, 731 days before",
        "the calibration of speed_bronze was due by 2026-01-31, 29 days before",
    ]
    assert {one["quality"] for one in segments["segments"]} == {"doubtful"}
    until = dated.replace("valid_days=365}", "due=2026-03-01}")
    answer = json.loads(asperity("rig", "reduce", recording, "--set", until, "--json")[1])
    assert {one["quality"] for one in answer["segments"]} == {"good"}


BUDGETED = {
    "torque_before": "torque_before_Nm", "torque_with": "torque_with_Nm",
    "torque_change": "torque_change_percent", "power_change": "power_change_percent",
    "efficiency_change": "efficiency_change_points",
    "sliding_velocity_before": "sliding_velocity_before_mm_s",
    "sliding_velocity_with": "sliding_velocity_with_mm_s", "k_v": "k_v",
}  # fmt: skip


def _ends(key):
    unit = next((one for one in ("_Nm", "_percent", "_points", "_mm_s") if key.endswith(one)), "")
    return f"{key.removesuffix(unit)}_ci95{unit}"


@pytest.fixture(scope="module")
def budgeted(asperity, recording):
    code, output, errors = asperity("rig", "reduce", recording, "--budget", "--json")
    assert code == 0, errors
    return json.loads(output)


def test_a_budget_adds_up_to_the_interval_that_is_told(budgeted):
    for segment, told in zip(budgeted["segments"], budgeted["budgets"], strict=True):
        numbers = {one["number"]: one for one in told["numbers"]}
        assert set(numbers) >= set(BUDGETED)
        for name, key in BUDGETED.items():
            one = numbers[name]
            low, high = segment[_ends(key)]
            assert one["value"] == segment[key]
            assert one["expanded_uncertainty"] == pytest.approx(0.5 * (high - low), rel=1e-9)
            parts = one["contributions"]
            variance = sum(part["size"] * abs(part["size"]) for part in parts)
            assert one["standard_uncertainty"] == pytest.approx(math.sqrt(variance), rel=1e-9)
            assert sum(part["share_percent"] for part in parts) == pytest.approx(100.0)
            # An auditor's own sum, by (13) and G.2b of the Guide.
            for part in parts:
                if part["inputs"]:
                    moved = np.multiply(part["sensitivities"], part["uncertainties"])
                    mixed = 2.0 * part["correlation"] * np.prod(moved) if len(moved) > 1 else 0.0
                    assert part["size"] ** 2 == pytest.approx(moved @ moved + mixed, rel=1e-9)
            lost = sum(part["size"] ** 4 / part["freedom"] for part in parts if part["freedom"])
            if lost:
                assert one["effective_freedom"] == pytest.approx(variance**2 / lost, rel=1e-9)
            half = one["coverage_factor"] * one["standard_uncertainty"]
            assert half == pytest.approx(one["expanded_uncertainty"], rel=1e-9)


@pytest.mark.slow
def test_a_budget_names_what_it_does_not_count(budgeted, asperity, environment, recording):
    told = "\n".join(budgeted["not_counted"])
    assert "the calibration of speed_steel is taken as exact: 2 points" in told
    assert "with its motor, as an offset that is not there at rest" in told
    assert "torque_steel" not in told
    wide = {**environment, "COLUMNS": "160"}
    code, printed, errors = asperity("rig", "reduce", recording, "--budget", env=wide)
    assert code == 0, errors
    assert "Uncertainty (GUM)" in printed
    assert "torque_steel: noise, run-out and drift" in printed
    plainly = asperity("rig", "reduce", recording)[1]
    assert "Uncertainty (GUM)" not in plainly


@pytest.mark.slow
def test_a_calibration_of_three_points_widens_a_torque_by_students_factor(asperity, recording):
    points = '[["-5 V","-2.05 N m"],["0 V","0.1 N m"],["5 V","1.95 N m"]]'
    few = f'channels.torque_steel={{channel="A", points={points}}}'
    sure = few.replace("}", ', uncertainty="122.5 mN m"}')
    found = []
    for setting in (few, sure):
        given = "--set", setting, "--budget", "--json"
        found.append(json.loads(asperity("rig", "reduce", recording, *given)[1])["budgets"][0])
    # The same standard deviation, but of one degree of freedom.
    lone, known = ({one["number"]: one for one in of["numbers"]} for of in found)
    few_points, stated = lone["torque_before"], known["torque_before"]
    assert few_points["standard_uncertainty"] == pytest.approx(
        stated["standard_uncertainty"], rel=0.05
    )
    assert few_points["coverage_factor"] > 1.3 * stated["coverage_factor"]
    # A zero that was seen at rest leaves the gain alone, on which no change in percent hangs.
    assert lone["torque_change"]["coverage_factor"] == pytest.approx(
        known["torque_change"]["coverage_factor"], rel=0.02
    )
    part = next(one for one in lone["torque_before"]["contributions"]
                if one["contribution"] == "torque_steel: calibration")  # fmt: skip
    assert (part["type"], part["freedom"]) == ("A", 1.0)


@pytest.mark.slow
def test_a_sheet_s_hysteresis_and_creep_are_in_the_budget(asperity, recording):
    sheet = 'channels.torque_steel={channel="A", points=[["-5 V","-2 N m"],["5 V","2 N m"]], '
    sheet += 'uncertainty="2 mN m", capacity="2 N m", hysteresis="0.2 %", creep="1 mN m"}'
    given = "--set", sheet, "--budget", "--json"
    told = json.loads(asperity("rig", "reduce", recording, *given)[1])["budgets"][0]["numbers"]
    torque = next(one for one in told if one["number"] == "torque_before")
    sizes = {one["contribution"]: one["size"] for one in torque["contributions"]}
    # Rectangles: half the loop of 4 mN m, and all of the creep.
    assert sizes["torque_steel: hysteresis"] == pytest.approx(2e-3 / math.sqrt(3.0))
    assert sizes["torque_steel: creep"] == pytest.approx(1e-3 / math.sqrt(3.0))


@pytest.mark.slow
def test_files_hold_the_budgets(written, budgeted):
    with (written / "budget.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    numbers = budgeted["budgets"][0]["numbers"]
    torque = next(one for one in numbers if one["number"] == "torque_change")
    mine = [row for row in rows if row["number"] == "torque_change"][: len(torque["contributions"])]
    assert [row["contribution"] for row in mine] == [
        one["contribution"] for one in torque["contributions"]
    ]
    assert [float(row["size"]) for row in mine] == [one["size"] for one in torque["contributions"]]
    dataset = read(written / "reduce.nc").dataset
    place = {"segment": 0, "number": list(dataset["number"].values).index("torque_change")}
    assert float(dataset["standard_uncertainty"][place]) == torque["standard_uncertainty"]
    sizes = dataset["contribution_size"][place].values
    squares = np.nansum(sizes * np.abs(sizes))
    assert math.sqrt(squares) == pytest.approx(torque["standard_uncertainty"])


@pytest.mark.slow
def test_a_sliding_velocity_not_told_apart_from_zero_is_a_flag(asperity, recording):
    # The zero is seen at rest, so that the gain is left: it is not known by some 85 % of 5.4 and
    # 8.4 mm/s of the rim, which slides at 2.5 and 5.5 mm/s.
    unsure = 'channels.speed_steel={channel="C", points=[["0 V","0 rpm"],["5 V","5000 rpm"]], '
    unsure += 'uncertainty="3000 rpm"}'
    answer = asperity("rig", "reduce", recording, "--set", unsure, "--json")[1]
    for one in json.loads(answer)["segments"]:
        assert one["quality"] == "doubtful"
        for name in ("before", "with"):
            said = f"the sliding velocity {name} vibration is not told apart from zero"
            assert said in one["flags"]


@pytest.mark.slow
def test_a_torque_past_its_range_costs_its_segment_alone(asperity, tmp_path):
    run = phases()
    run[1] = dataclasses.replace(run[1], torque_steel=1e4)
    path = record(tmp_path / "run.nc", run, rate=RATE)
    first, second = json.loads(asperity("rig", "reduce", path, "--json")[1])["segments"]
    assert first["flags"][0] == "torque_steel has samples missing or past its range"
    assert (first["quality"], second["quality"]) == ("refused", "good")
    assert first["torque_change_percent"] is None


@pytest.mark.slow
@pytest.mark.parametrize("places", [(1,), (1, 4)])
def test_a_current_past_its_range_costs_the_efficiency_of_its_segment_alone(
    asperity, reduced, tmp_path, places
):
    run = phases()
    for place in places:
        run[place] = dataclasses.replace(run[place], current_steel=1e3)
    path = record(tmp_path / "run.nc", run, rate=RATE)
    found = json.loads(asperity("rig", "reduce", path, "--json")[1])["segments"]
    said = "current_steel has samples missing or past its range: no efficiency"
    for one, whole, lost in zip(found, reduced["segments"], (True, len(places) > 1), strict=True):
        assert one["quality"] == "good"
        assert one["torque_change_percent"] == pytest.approx(whole["torque_change_percent"])
        assert (said in one["flags"]) == lost
        ends = one["efficiency_change_ci95_points"]
        assert (one["efficiency_change_points"] is None, ends is None) == (lost, lost)
        if not lost:
            low, high = whole["efficiency_change_ci95_points"]
            assert ends == pytest.approx([low, high], abs=0.1 * (high - low))


@pytest.mark.slow
def test_windows_of_a_few_blocks_are_reduced_and_another_confidence_is_told(asperity, tmp_path):
    short = run_of(3.0, frequencies=FREQUENCIES, ratios=RATIOS, duration=1.1)
    path = record(tmp_path / "run.nc", short, rate=RATE)
    settings = "block=2 ms", "least_window=20 ms", "confidence=0.8"
    given = [part for one in settings for part in ("--set", f"reduction.{one}")]
    answer = json.loads(asperity("rig", "reduce", path, *given, "--json")[1])
    assert any("intervals are of 80 %" in note for note in answer["notes"])
    for one, ratio in zip(answer["segments"], RATIOS, strict=True):
        assert one["torque_change_percent"] == pytest.approx(100.0 * (ratio - 1.0), abs=3.0)
    # Blocks so long that hardly any is left when speeds have settled: they are taken all the same.
    long = run_of(frequencies=FREQUENCIES[:1], ratios=RATIOS[:1], duration=12.0)
    settings = "block=1 s", "least_window=10 s", "speed_settling=10 s"
    path = record(tmp_path / "long.nc", long, rate=RATE)
    given = [part for one in settings for part in ("--set", f"reduction.{one}")]
    code, output, errors = asperity("rig", "reduce", path, *given, "--json")
    assert code == 0, errors
    assert any("speed_settling" in flag for flag in json.loads(output)["segments"][0]["flags"])


@pytest.mark.slow
def test_a_disc_at_rest_and_no_current_leave_what_there_is(asperity, tmp_path):
    run = [dataclasses.replace(one, speed_bronze=0.0, current_steel=0.0) for one in phases()]
    rig = dataclasses.replace(NOISY, speed_noise=0.0, current_noise=0.0)
    path = record(tmp_path / "run.nc", run, rig, rate=RATE)
    code, output, errors = asperity("rig", "reduce", path, "--json")
    assert code == 0, errors
    one = json.loads(output)["segments"][0]
    assert (one["efficiency_change_points"], one["efficiency_change_ci95_points"]) == (None, None)
    assert one["slide_roll_ratio"] == pytest.approx(1.0)
    assert one["sliding_velocity_before_mm_s"] == pytest.approx(2.5 + 2.86, abs=0.05)
    assert one["power_change_ci95_percent"] is not None


@pytest.mark.slow
def test_a_signal_that_is_mapped_to_no_channel_is_refused(asperity, tmp_path):
    with Recorder(tmp_path / "run.nc", [Source("torque_steel", "V", 1e-3)], 1e-3) as made:
        made.append(np.zeros((500, 1), np.int16), 0.5)
    told = asperity("rig", "reduce", tmp_path / "run.nc", "--config", "rig-final")
    refused(told, "run.nc: speed_steel is not recorded; map a channel to it in [channels]")


@pytest.mark.slow
def test_a_reduction_is_fitted_as_it_is(asperity, written):
    law = ("mu=0.1", "max_deflection=70 nm", "law=split", "transfer=0.7")
    settings = [part for one in law for part in ("--set", f"friction.{one}")]
    code, output, errors = asperity(
        "fit", written / "measurements.csv", "rig-final", *settings,
        "--free", "friction.transfer", "--json",
    )  # fmt: skip
    assert code == 0, errors
    (found,) = json.loads(output)["parameters"]
    assert 0.5 < found["value"] <= 1.0


def test_a_recording_is_no_repeat_of_itself(asperity, recording):
    refused(asperity("rig", "reduce", recording, recording), "run-1.nc is given twice")


@pytest.mark.slow
@pytest.mark.parametrize("missed", [(0,), (1,)])
def test_a_missed_start_of_the_vibration_costs_its_segment_alone(asperity, tmp_path, missed):
    path = record(tmp_path / "run.nc", phases(missed=missed), rate=RATE)
    code, output, errors = asperity("rig", "reduce", path, "--json")
    assert code == 0, errors
    found = [one["commanded_Hz"] for one in json.loads(output)["segments"]]
    assert found == [FREQUENCIES[1 - missed[0]]]


@pytest.mark.slow
def test_a_run_that_stops_half_way_keeps_what_was_whole(asperity, tmp_path):
    path = record(tmp_path / "run.nc", phases()[:4], rate=RATE)
    code, output, errors = asperity("rig", "reduce", path, "--json")
    assert code == 0, errors
    assert [one["quality"] for one in json.loads(output)["segments"]] == ["good"]


@pytest.mark.slow
def test_a_triangle_is_told_from_a_sine(asperity, tmp_path):
    path = record(tmp_path / "run.nc", phases(waveform="triangle"), rate=RATE)
    segments = json.loads(asperity("rig", "reduce", path, "--json")[1])["segments"]
    assert {one["waveform"] for one in segments} == {"triangle"}


def refused(answer, *parts):
    code, output, errors = answer
    assert (code, output) == (2, "")
    assert len(errors.splitlines()) == 1
    assert all(part in errors for part in parts), errors


@pytest.mark.slow
def test_what_cannot_be_reduced_is_refused_in_a_line(asperity, recording, tmp_path):
    still = record(tmp_path / "still.nc", phases(missed=(0, 1)), rate=RATE)
    refused(asperity("rig", "reduce", still), "still.nc", "no vibration found")
    other = record(
        tmp_path / "other.nc", run_of(frequencies=(333.0,), ratios=(0.3,), duration=6.0), rate=RATE
    )
    refused(asperity("rig", "reduce", other), "other.nc", "333 Hz", "plan.frequencies")
    begun = record(tmp_path / "begun.nc", phases()[1:3], rate=RATE)
    refused(asperity("rig", "reduce", begun), "begun.nc", "no sliding before it")
    refused(asperity("rig", "reduce", tmp_path / "none.nc"), "none.nc", "no such file")
    refused(asperity("rig", "reduce", recording, "--config", "rig-finl"), "rig-final")
    other = asperity("rig", "reduce", recording, "--config", "gearset-2")
    refused(other, "gearset-2: it is a case of another kind, without [rig]")
    refused(asperity("rig", "reduce", recording, "--set", "reduction.block=2 s"), "reduction.block")
    refused(asperity("rig", "report", tmp_path / "nowhere"), "not a folder")


@pytest.mark.slow
def test_a_report_is_one_page_that_stands_by_itself(asperity, series, reduced):
    folder, output = series
    answer = json.loads(output)
    assert (answer["recordings"], answer["measured"], answer["left_out"]) == (2, 4, 1)
    assert [one["torque_change_percent"] for one in answer["segments"]] == 2 * [
        one["torque_change_percent"] for one in reduced["segments"]
    ]
    assert list(answer["segments"][0]) == KEYS
    page = (folder / "report.html").read_text("utf-8")
    assert "<script>" not in page
    assert "&lt;script&gt;.nc" in page
    assert page.count("data:image/svg+xml;base64,") == 5
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "boundary lubrication" in page
    # Made again from its own folder it says the same: what it wrote is not taken for recordings.
    (folder / "report.html").unlink()
    assert asperity("rig", "report", folder, "--json")[:2] == (0, output)
    assert (folder / "report.html").is_file()


def test_columns_and_units_of_a_file_without_headings_are_given_by_hand(asperity, tmp_path):
    rows = (f"{n * 1e-3:.4f},{n % 5},{n % 7}" for n in range(2000))
    (tmp_path / "bare.csv").write_text("\n".join(rows))
    code, output, errors = asperity(
        "rig", "look", tmp_path / "bare.csv", "--columns", "time,torque_steel,speed_steel",
        "--units", "s,mV,V", "--json",
    )  # fmt: skip
    assert code == 0, errors
    found = json.loads(output)
    assert (found["columns"], found["units"]) == (["torque_steel", "speed_steel"], ["mV", "V"])
    (tmp_path / "loop").symlink_to("loop")
    refused(asperity("rig", "import", tmp_path / "loop", "rig-final"), "cannot be read")


def test_an_export_of_an_oscilloscope_becomes_a_recording(asperity, tmp_path):
    time = np.arange(2000) * 1e-3
    columns = [time] + [np.sin(time * n) for n in range(1, 9)]
    head = "Zeit;" + ";".join(f"Kanal {letter}" for letter in "ABCDEFGH")
    lines = [head, "(s);" + ";".join(["(V)"] * 8), ""]
    lines += [
        ";".join(f"{v:.6f}".replace(".", ",") for v in row) for row in zip(*columns, strict=True)
    ]
    (tmp_path / "run.csv").write_text("\n".join(lines), "utf-8")
    out = tmp_path / "run.nc"
    code, output, errors = asperity(
        "rig", "import", tmp_path / "run.csv", "rig-final", "--out", out, "--json"
    )
    assert code == 0, errors
    answer = json.loads(output)
    assert answer["samples"] == 2000
    assert answer["channels"][0]["signal"] == "torque_steel"
    refused(asperity("rig", "reduce", out), "run.nc")


def test_what_is_refused_is_told_what_to_do(asperity, tmp_path):
    plan = "rig", "plan", "rig-final", "--set"
    refused(asperity(*plan, "plan.modes=transverse"), 'it must be a list, as ["transverse"]')
    inner = asperity(*plan, "channels.torque_bronze.channel=A")
    refused(inner, "channels.torque_bronze is set as a whole, as channels.torque_bronze={ channel")
    text = tmp_path / "run.csv"
    text.write_text("PicoScope export\n\nZeit;Kanal A\n(s);(V)\n0;1\n1;2\n")
    refused(asperity("rig", "import", text, "rig-final"), "the file has 'Kanal A'")
    refused(asperity("rig", "reduce", text), "not a recording", "asperity rig import")
    beside = write_dataset(xarray.Dataset(attrs={"answer_of": "its"}), tmp_path / "plan.nc")
    refused(asperity("rig", "reduce", beside), "give the recordings themselves")
    for content, why in ((b"", "it is empty"), (b"\x89HDF\r\n\x1a\n" + bytes(99), "it is damaged")):
        (tmp_path / "cut.nc").write_bytes(content)
        refused(asperity("rig", "reduce", tmp_path / "cut.nc"), f"{why}; copy it again")
    (tmp_path / "empty").mkdir()
    refused(asperity("rig", "report", tmp_path / "empty"), "recordings come from asperity rig run")
    text.write_text("")
    refused(asperity("fit", text, "table-4.3", "--free", "friction.mu"), "run.csv is empty")
    text.write_text("file,mode,torque_change_percent\nrun-1.nc,transverse,-70\n")
    told = asperity("fit", text, "table-4.3", "--free", "friction.mu")
    refused(told, "the column 'file' must be 'ratio'", "writes such a table, measurements.csv")


def test_a_line_begins_with_the_file_at_fault(asperity, tmp_path):
    wrong = tmp_path / "wrong.csv"
    wrong.write_text("Zeit;Kanal A\n(s);(V)\n\n0,0;1,0\n0,1;zwei\n")
    for answer in (
        asperity("rig", "import", wrong, "rig-final"),
        asperity("rig", "import", tmp_path / "none.csv", "rig-final"),
        asperity("rig", "import", "none.csv", "rig-final"),
        asperity("fit", wrong, "table-4.3", "--free", "friction.mu"),
    ):
        refused(answer)
        assert answer[2].startswith((str(tmp_path), "none.csv cannot be read: no such file")), (
            answer
        )


def test_what_was_measured_is_not_written_over(asperity, recording, tmp_path):
    raw, case = tmp_path / "run.csv", "rig-final"
    raw.write_text("measured once")
    old = tmp_path / "old.nc"
    old.write_bytes(b"measured once")
    there = "is there already; name another file"
    refused(asperity("rig", "import", raw, case, "--out", raw), "run.csv", there)
    refused(asperity("rig", "import", raw, case, "--out", old), "old.nc", there)
    refused(asperity("rig", "import", raw, case, "--out", tmp_path), "is a folder; name a file")
    named = asperity("rig", "import", raw, case, "--out", tmp_path / "new.csv")
    refused(named, "it must end in .nc, as new.nc does")
    below = asperity("rig", "import", raw, case, "--out", raw / "new.nc")
    refused(below, "run.csv cannot be used as output folder")
    assert raw.read_text() == old.read_text() == "measured once"


@pytest.mark.slow
def test_a_recording_of_the_name_of_its_answer_is_not_written_over(asperity, recording, tmp_path):
    # In a folder of its own and among others.
    mine = tmp_path / "series" / "reduce.nc"
    mine.parent.mkdir()
    mine.write_bytes(recording.read_bytes())
    for words in (("reduce", mine, "--out", mine.parent), ("report", mine.parent)):
        code, _, errors = asperity("rig", *words)
        assert code == 2
        assert "reduce.nc is read here, and would be written over" in errors
        assert mine.read_bytes() == recording.read_bytes()


@pytest.mark.slow
def test_a_run_begins_in_no_folder_that_holds_recordings(asperity, tmp_path):
    (tmp_path / "file-01.nc").write_bytes(b"measured once")
    refused(asperity("rig", "run", "rig-final", "--out", tmp_path), "file-01.nc is there already")
    assert [path.name for path in tmp_path.iterdir()] == ["file-01.nc"]


FREE = "friction.max_deflection"


def fitted(asperity, folder, *options):
    """Return what a fit of four ratios to table-4.3 prints."""
    rows = "\n".join(f"{k},{r},0.01" for k, r in ((1.5, 0.62), (2, 0.46), (3, 0.26), (6, 0.12)))
    (folder / "data.csv").write_text(f"vibration.velocity_ratio,ratio,sd\n{rows}\n", "utf-8")
    code, output, errors = asperity(
        "fit", folder / "data.csv", "table-4.3", "--free", FREE, *options
    )
    assert code == 0, errors
    return output


def test_a_fit_of_what_is_no_key_is_refused(asperity, tmp_path):
    (tmp_path / "data.csv").write_text("vibration.velocity_ratio,ratio,sd\n2,0.46,0.01\n", "utf-8")
    refused(asperity("fit", tmp_path / "data.csv", "table-4.3", "--free", "x.y"), "--free x.y")


@pytest.mark.slow
def test_a_fit_prints_the_keys_of_the_contract(asperity, tmp_path):
    answer = json.loads(fitted(asperity, tmp_path, "--next", "1", "--json"))
    keys = ["parameters", "correlation", "laws", "residuals", "next", "solves", "failed"]
    assert answer.keys() >= set(keys)
    (found,) = answer["parameters"]
    assert found.keys() == {"key", "value", "units", "ci95", "identifiable", "why"}
    assert answer["laws"][0].keys() == {"law", "chi2", "dof", "delta_chi2"}
    assert len(answer["next"]) == 1
    assert found["units"] == "m"


@pytest.mark.slow
def test_of_one_parameter_the_same_measurement_tells_most_however_often_it_is_asked_for(
    asperity, tmp_path
):
    assert "one measurement, repeated" in fitted(asperity, tmp_path, "--next", "2")


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize(("setting", "size"), [("0.07 um", 1e6), ("70 nm", 1e9), ("7e-8 m", 1e9)])
def test_a_fit_s_table_has_the_case_s_unit_or_the_one_it_is_given_in(
    asperity, tmp_path, setting, size
):
    (found,) = json.loads(fitted(asperity, tmp_path, "--json"))["parameters"]
    shown = fitted(asperity, tmp_path, "--set", f"{FREE}={setting}")
    row = next(line.split() for line in shown.splitlines() if line.startswith(FREE))
    told = [float(one) for one in row[1:4]]
    assert told == pytest.approx([size * one for one in (found["value"], *found["ci95"])], 1e-2)
    assert row[4] == ("nm" if size == 1e9 else "um")


@pytest.mark.slow
def test_a_check_lists_what_is_wrong_and_draws_each(asperity, tmp_path):
    path = faulty("zero that jumps", 1, tmp_path / "run.nc", **SMALL)
    code, output, errors = asperity("rig", "check", path, "--out", tmp_path / "out", "--json")
    assert code == 0, errors
    answer = json.loads(output)
    (found,) = answer["findings"]
    assert found["name"] == "zero of torque_steel"
    assert (found["spoils"], found["start_s"], found["file"]) == (True, None, "run.nc")
    assert "N m at rest" in found["evidence"]
    assert found["remedy"]
    assert (answer["count"], answer["spoiling"], answer["segments"]) == (1, 1, 3)
    assert (tmp_path / "out" / "check.png").stat().st_size > 5000
    saved = read(tmp_path / "out" / "check.nc")
    # Its picture is the zeros over the stretches at rest: nothing, then 30 mN m.
    zeros = saved.dataset["y"].values[0]
    assert abs(zeros[0]) < 5e-3
    assert zeros[-1] == pytest.approx(0.03, abs=3e-3)
    told = asperity("rig", "check", path)[1]
    assert "zero of torque_steel" in told
    assert "not good" in told
    # Reduced, it is told once for the file and spoils every segment.
    reduced = asperity("rig", "reduce", path)[1]
    assert reduced.count("zero of torque_steel") == 1
    assert "good " not in reduced


@pytest.mark.slow
def test_a_check_of_a_sound_recording_finds_nothing(asperity, recording, tmp_path):
    code, output, errors = asperity("rig", "check", recording, "--out", tmp_path, "--json")
    assert code == 0, errors
    assert json.loads(output)["findings"] == []
    assert (tmp_path / "check.png").is_file()


@pytest.mark.slow
def test_an_import_tells_what_is_wrong_with_what_was_heard(asperity, tmp_path):
    path = faulty("torque inverted", 1, tmp_path / "run.nc", **SMALL)
    code, output, errors = asperity("rig", "import", path, "rig-final", "--json")
    assert code == 0, errors
    (found,) = json.loads(output)["findings"]
    assert found["name"] == "torque_steel has the wrong sign"
    assert "wrong sign" in asperity("rig", "import", path, "rig-final")[1]
