"""``asperity rig`` and ``asperity fit`` as a laboratory uses them."""

import csv
import dataclasses
import json
import math

import numpy as np
import pytest
import xarray
from apparatus.rig_signals import NOISY, TORQUE, record, run_of

from asperity.results import read
from asperity.store import write_dataset
from asperity.tribometer.reduction.wear import path_share

FREQUENCIES, RATIOS, RATE = (250.0, 500.0), (0.31, 0.22), 5e3
KEYS = [
    "file", "mode", "lubricant", "waveform", "frequency_Hz", "commanded_Hz", "motor_voltage_V",
    "torque_before_Nm", "torque_with_Nm", "torque_change_percent", "torque_change_ci95_percent",
    "power_change_percent", "efficiency_change_points", "sliding_velocity_before_mm_s",
    "sliding_velocity_with_mm_s", "slide_roll_ratio", "k_v", "model_ratio", "turns_seen", "quality",
    "flags",
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


def test_a_reduction_has_the_keys_of_the_contract(reduced):
    assert reduced.keys() >= {"segments", "runout_percent", "noise_Nm", "gaps", "notes"}
    assert [list(one) for one in reduced["segments"]] == [KEYS, KEYS]


def test_segments_hold_what_was_put_in(reduced):
    for one, frequency, ratio in zip(reduced["segments"], FREQUENCIES, RATIOS, strict=True):
        assert one["frequency_Hz"] == pytest.approx(frequency, rel=1e-4)
        assert one["commanded_Hz"] == frequency
        assert one["waveform"] == "sine"
        assert one["motor_voltage_V"] == 1.0
        assert one["torque_before_Nm"] == pytest.approx(TORQUE, rel=0.03)
        low, high = one["torque_change_ci95_percent"]
        assert low < 100.0 * (ratio - 1.0) < high
        assert high - low < 6.0
        assert one["sliding_velocity_before_mm_s"] == pytest.approx(2.5, abs=0.05)
        assert one["sliding_velocity_with_mm_s"] == pytest.approx(5.5, abs=0.05)
        power = ratio * (5.5 + 2.86) / (2.5 + 2.86) - 1.0
        assert one["power_change_percent"] == pytest.approx(100.0 * power, abs=4.0)
        assert one["k_v"] == pytest.approx({250.0: 20.0, 500.0: 33.0}[frequency] / 4.0, rel=0.02)


def test_files_of_a_reduction_hold_its_numbers(written, reduced):
    with (written / "reduce.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row, one in zip(rows, reduced["segments"], strict=True):
        assert float(row["torque_change_percent"]) == one["torque_change_percent"]
        assert float(row["low_percent"]) == one["torque_change_ci95_percent"][0]
        assert float(row["k_v_before"]) > one["k_v"] > float(row["k_v_with"])
    saved = read(written / "reduce.nc")
    assert saved.dataset["torque_change"].values == pytest.approx(
        [one["torque_change_percent"] for one in reduced["segments"]]
    )
    assert saved.figure() is not None


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


def test_path_along_the_sliding_is_no_longer_below_k_of_one():
    assert path_share(0.97, "longitudinal") == 1.0
    turn = np.linspace(0.0, 2.0 * math.pi, 100_001)
    for k in (1.5, 4.0):
        along = np.trapezoid(np.abs(1.0 - k * np.cos(turn)), turn) / (2.0 * math.pi)
        across = np.trapezoid(np.hypot(1.0, k * np.cos(turn)), turn) / (2.0 * math.pi)
        assert path_share(k, "longitudinal") == pytest.approx(along, rel=1e-6)
        assert path_share(k, "transverse") == pytest.approx(across, rel=1e-6)


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


@pytest.mark.parametrize("missed", [(0,), (1,)])
def test_a_missed_start_of_the_vibration_costs_its_segment_alone(asperity, tmp_path, missed):
    path = record(tmp_path / "run.nc", phases(missed=missed), rate=RATE)
    code, output, errors = asperity("rig", "reduce", path, "--json")
    assert code == 0, errors
    found = [one["commanded_Hz"] for one in json.loads(output)["segments"]]
    assert found == [FREQUENCIES[1 - missed[0]]]


def test_a_run_that_stops_half_way_keeps_what_was_whole(asperity, tmp_path):
    path = record(tmp_path / "run.nc", phases()[:4], rate=RATE)
    code, output, errors = asperity("rig", "reduce", path, "--json")
    assert code == 0, errors
    assert [one["quality"] for one in json.loads(output)["segments"]] == ["good"]


def test_a_triangle_is_told_from_a_sine(asperity, tmp_path):
    path = record(tmp_path / "run.nc", phases(waveform="triangle"), rate=RATE)
    segments = json.loads(asperity("rig", "reduce", path, "--json")[1])["segments"]
    assert {one["waveform"] for one in segments} == {"triangle"}


def refused(answer, *parts):
    code, output, errors = answer
    assert (code, output) == (2, "")
    assert len(errors.splitlines()) == 1
    assert all(part in errors for part in parts), errors


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
    refused(asperity("rig", "reduce", recording, "--set", "reduction.block=2 s"), "reduction.block")
    refused(asperity("rig", "report", tmp_path / "nowhere"), "not a folder")


def test_a_report_is_one_page_that_stands_by_itself(asperity, recording, tmp_path):
    folder = tmp_path / "series"
    folder.mkdir()
    for number in (1, 2):
        (folder / f"run-{number}.nc").write_bytes(recording.read_bytes())
    (folder / "<script>.nc").write_bytes(b"no recording")
    code, output, errors = asperity("rig", "report", folder, "--json")
    assert code == 0, errors
    answer = json.loads(output)
    assert (answer["recordings"], answer["measured"], answer["left_out"]) == (2, 4, 1)
    page = (folder / "report.html").read_text("utf-8")
    assert "<script>" not in page
    assert "&lt;script&gt;.nc" in page
    assert page.count("data:image/svg+xml;base64,") == 4
    assert "http://" not in page.replace("http://www.w3.org", "")
    assert "boundary lubrication" in page
    # Made again from its own folder it says the same: what it wrote is not taken for recordings.
    assert asperity("rig", "report", folder, "--json")[1] == output


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
    refused(asperity("rig", "import", text, "rig-final"), "stand in row 3; delete what is above")
    refused(asperity("rig", "reduce", text), "not a recording", "asperity rig import")
    beside = write_dataset(xarray.Dataset(attrs={"answer_of": "its"}), tmp_path / "plan.nc")
    refused(asperity("rig", "reduce", beside), "give the recordings themselves")
    (tmp_path / "empty").mkdir()
    refused(asperity("rig", "report", tmp_path / "empty"), "recordings come from asperity rig run")
    text.write_text("")
    refused(asperity("fit", text, "table-4.3", "--free", "friction.mu"), "run.csv is empty")


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
    # Under the very name of the answer's file, in a folder of its own and among others.
    mine = tmp_path / "series" / "reduce.nc"
    mine.parent.mkdir()
    mine.write_bytes(recording.read_bytes())
    for words in (("reduce", mine, "--out", mine.parent), ("report", mine.parent)):
        code, _, errors = asperity("rig", *words)
        assert code == 2
        assert "reduce.nc is read here, and would be written over" in errors
        assert mine.read_bytes() == recording.read_bytes()


def test_a_run_begins_in_no_folder_that_holds_recordings(asperity, tmp_path):
    (tmp_path / "file-01.nc").write_bytes(b"measured once")
    refused(asperity("rig", "run", "rig-final", "--out", tmp_path), "file-01.nc is there already")
    assert [path.name for path in tmp_path.iterdir()] == ["file-01.nc"]


def test_a_fit_prints_the_keys_of_the_contract(asperity, tmp_path):
    rows = "\n".join(f"{k},{r},0.01" for k, r in ((1.5, 0.62), (2, 0.46), (3, 0.26), (6, 0.12)))
    (tmp_path / "data.csv").write_text(f"vibration.velocity_ratio,ratio,sd\n{rows}\n", "utf-8")
    free = "friction.max_deflection"
    code, output, errors = asperity(
        "fit", tmp_path / "data.csv", "table-4.3", "--free", free, "--next", "1", "--json"
    )
    assert code == 0, errors
    answer = json.loads(output)
    keys = ["parameters", "correlation", "laws", "residuals", "next", "solves", "failed"]
    assert answer.keys() >= set(keys)
    (found,) = answer["parameters"]
    assert found.keys() == {"key", "value", "units", "ci95", "identifiable", "why"}
    assert answer["laws"][0].keys() == {"law", "chi2", "dof", "delta_chi2"}
    assert len(answer["next"]) == 1
    refused(asperity("fit", tmp_path / "data.csv", "table-4.3", "--free", "x.y"), "--free x.y")
