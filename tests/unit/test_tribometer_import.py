"""Files of oscilloscope programs become recordings, or are refused with row and reason."""

import datetime
import errno
import importlib.util
import struct
import tracemalloc
import zlib

import h5py
import numpy as np
import pytest
import scipy.io

from asperity.casefile import read_case
from asperity.errors import InputError, StorageError
from asperity.runs import Run
from asperity.tribometer.importing import look
from asperity.tribometer.importing.columns import matching
from asperity.tribometer.importing.study import answer, prepare
from asperity.tribometer.recording import Recording, layout
from asperity.tribometer.recording.blocks import Blocks
from asperity.tribometer.tables import TABLES

MAPPED = [
    'channels.torque_steel={channel="A", points=[["0 V","0 N m"],["5 V","2 N m"]]}',
    'channels.torque_bronze={channel="H"}',
    'channels.speed_steel={channel="B", points=[["0 V","0 rpm"],["5 V","5000 rpm"]]}',
    'channels.speed_bronze={channel="C", points=[["0 V","0 rpm"],["5 V","500 rpm"]]}',
    'channels.drive_voltage={channel="D"}',
]
OTHERS = [
    f'channels.{name}={{channel="{letter}"}}'
    for name, letter in (("load_cell", "F"), ("current_steel", "G"), ("current_bronze", "Z"))
]
HEADS = {
    "en": "Time,Channel A,Channel B,Channel C,Channel D",
    "de": "Zeit;Kanal A;Kanal B;Kanal C;Kanal D",
    "fr": "Temps\tCanal A\tCanal B\tCanal C\tCanal D",
    "zh": "时间,通道 A,通道 B,通道 C,通道 D",
}


def case(*settings):
    return read_case("rig-final", TABLES, [*MAPPED, *OTHERS, *settings])


def imported(path, *settings):
    return answer(prepare(case(*settings), file=str(path)), Run())


def rows(count=50, seed=0):
    values = np.random.default_rng(seed).normal(size=(count, 4))
    return np.column_stack((0.05 * np.arange(count), np.round(values, 4)))


def text(head, units, values, separator, decimal="."):
    lines = [head, units, ""]
    lines += [separator.join(f"{one:.8g}" for one in row) for row in values]
    return "\n".join(lines).replace(".", decimal) + "\n"


def seen(found, place):
    source = found.sampled.sources[place]
    return source.offset + source.scale * found.sampled.counts[:, place].astype(float)


@pytest.mark.parametrize(
    ("language", "separator", "decimal"),
    [("en", ",", "."), ("de", ";", ","), ("fr", "\t", ","), ("zh", ",", ".")],
)
def test_text_is_read_in_any_language(tmp_path, language, separator, decimal):
    units = separator.join(("(ms)", "(V)", "(mV)", "(V)", "(V)"))
    path, given = tmp_path / "run.csv", rows()
    path.write_text(text(HEADS[language], units, given, separator, decimal), "utf-8")
    found = imported(path)
    assert found.sample_interval == pytest.approx(50e-6)
    names = [source.signal for source in found.sampled.sources]
    assert names == ["torque_steel", "speed_steel", "speed_bronze", "drive_voltage"]
    assert [source.units for source in found.sampled.sources] == ["V", "mV", "V", "V"]
    for place in range(4):
        assert seen(found, place) == pytest.approx(given[:, place + 1], abs=1e-4)
    assert any("current_bronze is left out" in note for note in found.notes)


def test_an_imported_recording_is_one(tmp_path):
    path, given = tmp_path / "run.csv", rows()
    path.write_text(text(HEADS["en"], "(ms),(V),(V),(V),(V)", given, ","))
    imported(path).save(tmp_path / "run.nc")
    found = Recording.open(tmp_path / "run.nc")
    assert found.values("torque_steel") == pytest.approx(given[:, 1], abs=1e-4)
    assert found.case(TABLES)["rig"].mode == "transverse"
    assert [event.text for event in found.events] == ["1 V", "0.9 V"]
    again = imported(tmp_path / "run.nc")
    assert again.form == "recording"
    assert np.array_equal(again.sampled.counts, np.concatenate([c for _, c in found.stretches()]))


def test_an_import_onto_a_full_disk_leaves_nothing(tmp_path, monkeypatch):
    path = tmp_path / "run.csv"
    path.write_text(text(HEADS["en"], "(ms),(V),(V),(V),(V)", rows(), ","))
    found = imported(path)

    def full(*_):
        raise OSError(errno.ENOSPC, "no space left on device")

    monkeypatch.setattr(Blocks, "block", full)
    with pytest.raises(StorageError, match="no space left"):
        found.save(tmp_path / "run.nc")
    assert [one.name for one in tmp_path.iterdir()] == ["run.csv"]


def test_marks_past_the_range_gaps_and_a_cut_end_are_told(tmp_path):
    path = tmp_path / "run.csv"
    lines = text(HEADS["en"], "(ms),(V),(V),(V),(V)", rows(20), ",").splitlines()
    lines[5] = lines[5].replace(lines[5].split(",")[1], "∞", 1)
    lines[6] = ",".join(("0.15", "-Infinity", *lines[6].split(",")[2:]))
    del lines[10]
    lines[-1] = lines[-1].rsplit(",", 2)[0]
    path.write_text("\n".join(lines), "utf-8")
    found = imported(path)
    torque = found.sampled.counts[:, 0]
    assert (torque[2], torque[3]) == (layout.BEYOND, -layout.BEYOND)
    assert np.flatnonzero(torque == layout.MISSING).tolist() == [7]
    assert found.beyond == 2
    assert any("cut off" in note for note in found.notes)
    assert found.samples == 19


def test_times_that_are_rounded_or_seconds_since_1970_miss_no_rows(tmp_path):
    times = 1.55239e9 + 1e-4 * np.arange(2000)
    path = tmp_path / "run.csv"
    body = (f"{one:.4f},1,{n},2,3" for n, one in enumerate(times))
    path.write_text("\n".join([HEADS["en"], "(s),(V),(V),(V),(V)", *body, ""]))
    sampled = imported(path).sampled
    assert len(sampled.counts) == 2000
    assert sampled.interval == pytest.approx(1e-4, rel=1e-5)
    lines = path.read_text().splitlines()
    del lines[1000]
    path.write_text("\n".join([*lines, ""]))
    lacking = imported(path).sampled.counts
    assert np.flatnonzero(lacking[:, 0] == layout.MISSING).tolist() == [998]


REFUSED = {
    "empty": (lambda lines: [], ["is empty"]),
    "no headings": (lambda lines: lines[3:], ["row 1", "headings"]),
    "no units": (lambda lines: [lines[0], *lines[3:]], ["row 2", "units"]),
    "no samples": (lambda lines: lines[:3], ["no samples"]),
    "a word": (lambda lines: [*lines[:7], "0.2,x,1,1,1", *lines[8:]], ["row 8", "'x'"]),
    "a long row": (
        lambda lines: [*lines[:7], lines[7] + ",1,2,3", *lines[8:]], ["row 8", "8 cells"]
    ),
    "backwards": (lambda lines: [*lines[:7], lines[4], *lines[8:]], ["row 8", "backwards"]),
    "a jump": (lambda lines: [*lines[:-1], "9e9,1,1,1,1"], ["row 53", "jumps"]),
    "two times": (
        lambda lines: [lines[0], lines[1].replace("(V)", "(s)", 1), *lines[2:]], ["unit of time"]
    ),
    "a wrong unit": (
        lambda lines: [lines[0], lines[1].replace("(V)", "(kg)", 1), *lines[2:]],
        ["torque_steel", "'kg'"],
    ),
    "no channel": (lambda lines: [lines[0].replace("A", "X"), *lines[1:]], ["torque_steel", "'A'"]),
    "a row cut in its middle": (
        lambda lines: [*lines[:7], lines[7][: lines[7].rindex(",") - 1], *lines[8:]],
        ["row 8 has 4 cells for 5 columns"],
    ),
    "a heading twice": (
        lambda lines: [lines[0].replace("B", "A"), *lines[1:]], ["'Channel A'", "2 columns"]
    ),
    "a channel twice": (
        lambda lines: [lines[0].replace("Channel B", "Input A"), *lines[1:]],
        ["torque_steel", "both"],
    ),
}  # fmt: skip


@pytest.mark.ordinary(13)
@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_imported_is_refused_with_row_and_reason(tmp_path, name):
    change, parts = REFUSED[name]
    lines = text(HEADS["en"], "(ms),(V),(V),(V),(V)", rows(), ",").splitlines()
    path = tmp_path / "run.csv"
    path.write_text("\n".join(change(lines)), "utf-8")
    with pytest.raises(InputError) as refused:
        imported(path)
    told = str(refused.value)
    assert "\n" not in told
    assert all(part in told for part in ("run.csv", *parts)), told


def test_a_single_row_is_looked_at_and_refused(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("Time [s],A [V]\n0.0,0.5\n")
    with pytest.raises(InputError, match="a single sample"):
        look.answer(look.prepare(None, files=[str(path)]), Run())


@pytest.mark.parametrize("version", ["4", "5", "5 compressed", "7.3"])
def test_matlab_files_of_all_versions_are_read(tmp_path, version):
    path, given = tmp_path / "run.mat", rows(100)
    variables = {name: given[:, n + 1 : n + 2] for n, name in enumerate("ABCD")}
    variables |= {"Tinterval": np.array([[5e-5]]), "Tstart": np.zeros((1, 1))}
    if version == "7.3":
        with h5py.File(path, "w", userblock_size=512) as file:
            for name, value in variables.items():
                file[name] = value
    else:
        scipy.io.savemat(path, variables, format=version[0], do_compression=" " in version)
    found = imported(path)
    assert found.sample_interval == pytest.approx(5e-5)
    assert seen(found, 0) == pytest.approx(given[:, 1], abs=1e-4)


def test_a_channel_that_ends_before_the_others_is_missing_from_there(tmp_path):
    given = rows(100)
    variables = {name: given[:, n + 1 : n + 2] for n, name in enumerate("ABCD")}
    variables |= {"B": variables["B"][:60], "Tinterval": np.array([[5e-5]])}
    scipy.io.savemat(tmp_path / "run.mat", variables, format="4")
    found = imported(tmp_path / "run.mat")
    assert (found.samples, found.missing) == (100, 40)
    assert "speed_steel ends after 60 of 100 samples; the rest is missing" in found.notes
    assert np.all(found.sampled.counts[60:, 1] == layout.MISSING)


def element(kind, content):
    return struct.pack("<II", kind, len(content)) + content + bytes(-len(content) % 8)


@pytest.mark.parametrize("wrong", ["size", "values", "tag"])
def test_a_compressed_variable_that_claims_too_much_is_refused_before_it_is_read(tmp_path, wrong):
    shape = (1 << 29, 1) if wrong == "values" else (4, 1)
    tag = 77 if wrong == "tag" else 9
    inner = element(6, struct.pack("<II", 6, 0)) + element(5, struct.pack("<ii", *shape))
    inner += element(1, b"A") + element(tag, bytes(8 * 4))
    told = 1 << 30 if wrong == "size" else len(inner)
    packed = zlib.compress(struct.pack("<II", 14, told) + inner)
    head = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H", 0x0100) + b"IM"
    path = tmp_path / "run.mat"
    path.write_bytes(head + struct.pack("<II", 15, len(packed)) + packed)
    tracemalloc.start()
    with pytest.raises(InputError, match=r"run\.mat cannot be read: not a MATLAB file, or damaged"):
        imported(path)
    assert tracemalloc.get_traced_memory()[1] < 50e6
    tracemalloc.stop()


@pytest.mark.parametrize("content", [b"", b"MATLAB 5.0 MAT-file" + b"\1" * 200, b"\0" * 300])
def test_a_damaged_matlab_file_is_refused(tmp_path, content):
    (tmp_path / "run.mat").write_bytes(content)
    with pytest.raises(InputError, match=r"run\.mat"):
        imported(tmp_path / "run.mat")


@pytest.mark.skipif(importlib.util.find_spec("nptdms") is None, reason="npTDMS is not installed")
def test_tdms_is_read(tmp_path):
    from nptdms import ChannelObject, TdmsWriter

    given = rows(100)
    with TdmsWriter(tmp_path / "run.tdms") as writer:
        writer.write_segment(
            [
                ChannelObject(
                    "scope",
                    name,
                    given[:, n + 1],
                    {
                        "wf_increment": 5e-5,
                        "unit_string": "V",
                        "wf_start_time": np.datetime64("2026-05-01T23:59:50"),
                    },
                )
                for n, name in enumerate("ABCD")
            ]
        )
    found = imported(tmp_path / "run.tdms")
    assert found.sample_interval == pytest.approx(5e-5)
    assert found.began == DATED["ISO"][1]
    assert seen(found, 0) == pytest.approx(given[:, 1], abs=1e-4)


UTC = datetime.UTC
TABLE = "(ms),(V),(V),(V),(V)"


def dated(head, first="0.05"):
    body = [f"{first},1,2,3,4", *(f"{0.05 * n},1,2,3,4" for n in range(2, 9))]
    return "\n".join([*head, HEADS["en"], TABLE, *body, ""])


def clocks(first, step=datetime.timedelta(seconds=1), shape="%Y-%m-%dT%H:%M:%S+00:00"):
    moment = datetime.datetime.fromisoformat(first)
    rows = [f"{(moment + n * step).strftime(shape)};1;2;3;4" for n in range(8)]
    return "\n".join([HEADS["de"], " ;(V);(V);(V);(V)", *rows, ""])


LVM = """LabVIEW Measurement\t
Writer_Version\t2
Date\t2026/05/01
Time\t12:34:56.5
***End_of_Header***\t
\t
Channels\t4
Samples\t3\t3\t3\t3
Date\t2026/05/01\t2026/05/01\t2026/05/01\t2026/05/01
Time\t12:34:56.5\t12:34:56.5\t12:34:56.5\t12:34:56.5
Y_Unit_Label\tVolts\tVolts\tVolts\tVolts
X0\t0\t0\t0\t0
Delta_X\t0.001\t0.001\t0.001\t0.001
***End_of_Header***\t
X_Value\tA\tB\tC\tD
0\t1\t2\t3\t4
0.001\t1\t2\t3\t4
0.002\t1\t2\t3\t4
"""
# Times of day without a zone are this computer's.
LOCAL = datetime.datetime(2026, 5, 1, 12, 34, 56).astimezone(UTC)
DATED = {
    "ISO": (clocks("2026-05-01T23:59:50"), datetime.datetime(2026, 5, 1, 23, 59, 50, tzinfo=UTC)),
    "German": (clocks("2026-05-01T12:34:56", shape="%d.%m.%Y %H:%M:%S,0"), LOCAL),
    "LabVIEW": (LVM, LOCAL + datetime.timedelta(seconds=0.5)),
    "a row of its own": (dated(["Datum: 01.05.26", "Zeit: 12:34:56"]), LOCAL),
    "a month's name": (dated(["Segment,TrigTime", "#1,01-May-2026 12:34:56"]), LOCAL),
    "half days": (
        dated(["Start,5/31/2026 12:34:56 PM"]),
        datetime.datetime(2026, 5, 31, 12, 34, 56).astimezone(UTC),
    ),
    "evening": (
        dated(["Start,5/31/2026 10:34:56 pm"]),
        datetime.datetime(2026, 5, 31, 22, 34, 56).astimezone(UTC),
    ),
    "after midnight": (
        dated(["Start,5/31/2026 12:34:56 AM"]),
        datetime.datetime(2026, 5, 31, 0, 34, 56).astimezone(UTC),
    ),
    "a zone in the west": (
        dated(["Start,2026-05-31 22:34:56-03:30"]),
        datetime.datetime(2026, 6, 1, 2, 4, 56, tzinfo=UTC),
    ),
    "a zone in the east": (
        dated(["Start,2026-05-31 01:34:56 +0200"]),
        datetime.datetime(2026, 5, 30, 23, 34, 56, tzinfo=UTC),
    ),
    "since 1970": (dated([], "1777638896000.0").replace("\n0.", "\n1777638896000."), None),
    "none": (dated([]), ""),
    "exported": (dated(["Exported on 2026-05-01 12:34:56", "calibration due 2027-01-01"]), ""),
    "exchangeable": (dated(["Date,05/06/2026"]), ""),
    "exchangeable with half days": (dated(["Date,05/06/2026 10:15:09 PM"]), ""),
    "no day": (dated(["Date,32.13.2026"]), ""),
}


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("how", DATED)
def test_a_recording_is_dated_by_its_file_or_by_its_import_and_says_so(tmp_path, how):
    content, began = DATED[how]
    path = tmp_path / "run.csv"
    path.write_text(content)
    if began is None:
        began = datetime.datetime.fromtimestamp(1777638896, UTC)
    before = datetime.datetime.now(UTC)
    found = imported(path)
    found.save(tmp_path / "run.nc")
    start = Recording.open(tmp_path / "run.nc").start
    assert start.isoformat(timespec="seconds") == found.to_json()["start"]
    undated = [note for note in found.notes if "tells no date" in note]
    if began == "":
        assert before <= start <= datetime.datetime.now(UTC)
        assert len(undated) == 1
        told = any("2026-06-05 or 2026-05-06" in one for one in found.notes)
        assert told == how.startswith("exchangeable")
        # Then it can be said.
        told = answer(prepare(case(), file=str(path), start="2026-05-01 12:34:56"), Run())
        assert told.began == LOCAL
        assert not any("no date" in note for note in told.notes)
        return
    assert abs(start - began) <= datetime.timedelta(seconds=0.1)
    assert not undated
    assert any(note.startswith("begun 2026-0") for note in found.notes)


def test_a_recording_that_is_imported_again_keeps_its_date_and_a_calibration_its_due(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(clocks("2026-05-01T23:59:50"))
    imported(path).save(tmp_path / "run.nc")
    assert imported(tmp_path / "run.nc").began == DATED["ISO"][1]
    with pytest.raises(InputError, match="without --join, --rate, --columns, --units or --start"):
        prepare(case(), file=str(tmp_path / "run.nc"), start="2026-05-01")
    for wrong in ("soon", "05/06/2026", "2026-13-01"):
        with pytest.raises(InputError, match=r"--start is .*as in"):
            prepare(case(), file=str(path), start=wrong)


def test_a_date_in_the_future_is_told(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(clocks("2099-05-01T23:59:50"))
    then = "is in the future; say when it began: --start"
    assert f"2099-05-01 {then}" in imported(path).notes
    path.write_text(clocks("2020-05-01T23:59:50"))
    assert not any("future" in note for note in imported(path).notes)


def test_a_channel_is_its_heading_or_what_a_heading_ends_in():
    assert matching("Drehmoment", ["Zeit", "Drehmoment", "Kanal B"]) == [1]
    assert matching("b", ["Zeit", "Drehmoment", "Kanal B"]) == [2]
    assert matching("C", ["Zeit", "Drehmoment"]) == []
