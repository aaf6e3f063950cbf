"""Files as instruments and their programs write them, by their makers' documentation and files.

Each is written with the same samples by `apparatus.laboratory_files`, and read to the value or
refused by name.
"""

import datetime
import importlib.util
import re
import wave

import h5py
import numpy as np
import pytest
import scipy.io
from apparatus.laboratory_files import (
    BOTH,
    ONE,
    STEP,
    TEXTS,
    TIMES,
    A,
    B,
    joined,
    labview,
    lecroy,
    rigol_ds1054z,
    sigrok,
    tektronix_mso64,
    time_of_day,
    triples,
)
from hypothesis import given
from hypothesis import strategies as st

from asperity.cli.main import main
from asperity.cli.rig_look import looking
from asperity.errors import InputError
from asperity.results import read
from asperity.tribometer.importing.cells import is_number, marks_of
from asperity.tribometer.importing.files import declaration_of, read_export, read_joined
from asperity.tribometer.importing.text import read_text
from asperity.tribometer.recording import Recording


def spacing(found):
    if found.times is None:
        return found.interval
    return float(found.times[-1] - found.times[0]) / (len(found.times) - 1)


def holds(found, columns, tolerance=1e-4):
    assert spacing(found) == pytest.approx(STEP, rel=1e-5)
    for values, wanted in zip(found.values, columns, strict=True):
        assert values == pytest.approx(wanted, abs=tolerance)


@pytest.mark.ordinary(28)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "utf-16-le", "latin-1"])
@pytest.mark.parametrize("program", TEXTS)
def test_text_is_read_to_the_value(tmp_path, program, encoding):
    rows, name, headings, units, columns = TEXTS[program]
    path = tmp_path / name
    path.write_bytes("\r\n".join([*rows, ""]).encode(encoding))
    found = read_export(path, name)
    assert [*found.headings] == headings
    assert [*found.units] == units
    holds(found, columns)
    # By a column of times, or by what stands beside a count of samples.
    if program.startswith("Rigol"):
        assert found.start == pytest.approx(TIMES[0])


@pytest.mark.parametrize("time", ["Zeit / s", "Zeit [s]"])
def test_a_quantity_over_its_unit_is_a_channel_and_its_unit(tmp_path, time):
    path = tmp_path / "run.csv"
    heads = [f"{time};A / V;B / mV"]
    path.write_text("\n".join([*heads, *triples(separator=";", decimal=",")]), "utf-8")
    found = read_export(path, path.name)
    assert ([*found.headings], [*found.units]) == (["A", "B"], ["V", "mV"])
    holds(found, BOTH)


@pytest.mark.parametrize(
    ("below", "told"),
    [
        (["End of data"], ["'End of data'"]),
        (["", "End of data", ""], ["'End of data'"]),
        (["# end", "Samples,2000", "", "by,somebody,here"], ["'# end'", "'by,somebody,here'"]),
        (["[END]", *20 * ["word"]], None),
    ],
)
def test_words_below_the_numbers_are_left_out_and_named(tmp_path, below, told):
    path = tmp_path / "run.csv"
    rows = ["Time (s),A (V),B (V)", *triples()]
    path.write_text("\n".join([*rows, *below, ""]), "utf-8")
    if told is None:
        # So many are no footer.
        with pytest.raises(InputError, match=rf"row {len(rows) + 1}.*END"):
            read_export(path, path.name)
        return
    found = read_export(path, path.name)
    holds(found, BOTH)
    (note,) = found.notes
    assert all(one in note for one in told)
    place = next(n for n, one in enumerate(below, 1) if one)
    assert f"from row {len(rows) + place} on" in note


@pytest.mark.parametrize("last", ["0.1x,1,2", "1,two,3", "-,1,2"])
def test_a_damaged_last_row_is_no_footer(tmp_path, last):
    path = tmp_path / "run.csv"
    path.write_text("\n".join(["Time (s),A (V),B (V)", *triples(), last, ""]), "utf-8")
    with pytest.raises(InputError, match="is not a number"):
        read_export(path, path.name)


@pytest.mark.parametrize("version", ["4", "5", "7.3"])
@pytest.mark.parametrize("said", ["t", "fs", "dt", "Tinterval"])
def test_matlab_says_the_time_in_several_ways(tmp_path, version, said):
    held = {"A": A[:, None], "B": B[:, None]}
    held |= {
        "t": {"t": TIMES[:, None]}, "fs": {"fs": np.array([[1.0 / STEP]])},
        "dt": {"dt": np.array([[STEP]])}, "Tinterval": {"Tinterval": np.array([[STEP]])},
    }[said]  # fmt: skip
    path = tmp_path / "run.mat"
    if version == "7.3":
        with h5py.File(path, "w", userblock_size=512) as file:
            for key, value in held.items():
                file[key] = value
    else:
        scipy.io.savemat(path, held, format=version)
    found = read_export(path, "run.mat")
    assert [*found.headings] == ["A", "B"]
    holds(found, BOTH)
    # A matrix holds a channel a column.
    scipy.io.savemat(path, {"data": np.column_stack(BOTH), "t": TIMES})
    assert [*read_export(path, "run.mat").headings] == ["data1", "data2"]


@pytest.mark.parametrize("width", [1, 2, 3, 4])
def test_wav_of_all_widths_is_read(tmp_path, width):
    path, full = tmp_path / "run.wav", 2 ** (8 * width - 1)
    scaled = np.column_stack((0.1 * A, 0.1 * B)).clip(-0.99, 0.99)
    counts = np.rint(scaled * full).astype(np.int64)
    if width == 1:
        counts += 128
    raw = b"".join(
        int(one).to_bytes(width, "little", signed=width > 1) for one in counts.reshape(-1)
    )
    with wave.open(str(path), "wb") as file:
        file.setnchannels(2)
        file.setsampwidth(width)
        file.setframerate(round(1.0 / STEP))
        file.writeframes(raw)
    found = read_export(path, "run.wav")
    assert [*found.headings] == ["1", "2"]
    holds(found, scaled.T, tolerance=1.0 / full)


def test_a_session_of_sigrok_is_read(tmp_path):
    sigrok(tmp_path / "run.sr")
    found = read_export(tmp_path / "run.sr", "run.sr")
    assert [*found.headings] == ["A0", "A1"]
    holds(found, BOTH)


@pytest.mark.skipif(importlib.util.find_spec("asammdf") is None, reason="asammdf is not installed")
def test_mdf_is_read(tmp_path):
    from asammdf import MDF, Signal

    with MDF() as file:
        file.append(
            [
                Signal(one, TIMES - TIMES[0], name=name, unit="V")
                for name, one in zip("AB", BOTH, strict=True)
            ]
        )
        file.header.start_time = datetime.datetime(2026, 5, 1, 12, tzinfo=datetime.UTC)
        file.save(tmp_path / "run.mf4")
    found = read_export(tmp_path / "run.mf4", "run.mf4")
    holds(found, BOTH)
    assert found.began == (datetime.datetime(2026, 5, 1, 12, tzinfo=datetime.UTC), "its header")


def test_a_file_a_channel_is_joined_by_time(tmp_path):
    late = 7
    for name, values, first in (("C1run.txt", A, 0), ("C2run.txt", B, late)):
        rows = lecroy()[:5] + joined(zip(TIMES[first:], values[first:], strict=True))
        (tmp_path / name).write_text("\n".join(rows), "utf-8")
    found = read_joined(
        [str(tmp_path / "C1run.txt"), str(tmp_path / "C2run.txt")], declaration_of()
    )
    assert [*found.headings] == ["C1", "C2"]
    assert found.values[0] == pytest.approx(A, abs=1e-4)
    assert np.all(np.isnan(found.values[1][:late]))
    assert found.values[1][late:] == pytest.approx(B[late:], abs=1e-4)
    assert any("begins 0.007 s after" in note for note in found.notes)


def test_files_of_other_rates_or_times_are_no_one_recording(tmp_path):
    for name, times in (("a.csv", TIMES), ("b.csv", 2.0 * TIMES), ("c.csv", TIMES + 1e4)):
        (tmp_path / name).write_text(
            "\n".join(["t (s),A (V)", *joined(zip(times, A, strict=True))])
        )
    for other, told in (("b.csv", "one rate"), ("c.csv", "apart in time")):
        with pytest.raises(InputError, match=told):
            read_joined([str(tmp_path / "a.csv"), str(tmp_path / other)], declaration_of())


def test_what_a_file_does_not_say_can_be_said(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("\n".join(triples()), "utf-8")
    found = read_text(path, "run.csv", declaration_of(columns="time,-,B", units="s,V,mV"))
    assert ([*found.headings], [*found.units]) == (["B"], ["mV"])
    holds(found, (B,))
    path.write_text("\n".join(joined(zip(A, B, strict=True))), "utf-8")
    holds(read_text(path, "run.csv", declaration_of("1 kHz", "A,B", "V,V")), BOTH)
    path.write_text("\n".join(joined(A[:, None])), "utf-8")
    holds(read_text(path, "run.csv", declaration_of("1 kHz", "A", "V")), ONE)


NOT_READ = {
    "LeCroy's binary trace": ("run.trc", b"#9000000000WAVEDESC" + bytes(200), "ASCII"),
    "Tektronix's binary waveform": ("run.wfm", b"\x0f\x0f:WFM#003" + bytes(200), "CSV"),
    "Tektronix's ISF": ("run.isf", b":WFMPRE:NR_PT 2500;" + bytes(200), "CSV"),
    "Keysight's binary waveform": ("run.bin", b"AG10" + bytes(200), "CSV"),
    "Excel workbook": ("run.xlsx", b"PK\x03\x04" + bytes(200), "CSV"),
    "PicoScope's own file": ("run.psdata", bytes(200), "CSV or .mat"),
    "Saleae's capture": ("run.sal", b"PK\x03\x04" + bytes(200), "analog channels"),
    "gzip archive": ("run.csv.gz", b"\x1f\x8b" + bytes(200), "unpack"),
    "Dewesoft's own file": ("run.d7d", bytes(200), "TDMS"),
}


@pytest.mark.parametrize("what", NOT_READ)
def test_what_is_not_read_is_named_with_what_to_export(tmp_path, what):
    name, content, instead = NOT_READ[what]
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=f"{name} is .*{re.escape(what)}.*not read; .*{instead}"):
        read_export(tmp_path / name, name)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("run.psdata", "PicoScope's own file.*export it as CSV"),
        ("run.isf", "ISF.*save it as CSV"),
        ("run.sr", "no session of sigrok.*CSV"), ("run.tdms", "no TDMS file.*CSV"),
        ("run.mf4", "no MDF file.*CSV"), ("run.wav", "no WAV file.*CSV"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("content", [b"", b"words\nof a text\n", bytes(range(1, 256))])
def test_a_file_that_is_not_what_it_is_called_is_told_what_to_export(tmp_path, name, told, content):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputError, match=f"{name} is .*{told}"):
        read_export(tmp_path / name, name)


def test_a_structure_of_matlab_is_told_how_to_be_saved(tmp_path):
    scipy.io.savemat(tmp_path / "run.mat", {"data": {"A": np.arange(100.0), "fs": 1.0}})
    for told in (declaration_of(), declaration_of("1 kHz")):
        with pytest.raises(InputError, match="a variable of numbers of its own, not in a struct"):
            read_export(tmp_path / "run.mat", "run.mat", told)


def test_a_file_is_named_once_and_a_rate_by_its_option(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "run.trc").write_bytes(NOT_READ["LeCroy's binary trace"][1])
    (tmp_path / "run.csv").write_text("\n".join(["Time (s),A (V),B (V)", *triples()]), "utf-8")
    for line, said in (
        (["rig", "look", "run.trc"], "run.trc is LeCroy's"),
        (["rig", "look", "run.csv", "--rate", "4000"], "--rate: '4000' has no unit"),
        (["rig", "import", "run.csv", "rig-final", "--rate", "4 m"], "--rate: 'm' does not"),
    ):
        with pytest.raises(SystemExit) as ended:
            main(line)
        assert ended.value.code == 2
        assert capsys.readouterr().err.startswith(said)


def test_an_import_that_only_looks_is_a_look(tmp_path, capsys):
    (tmp_path / "run.csv").write_text("\n".join(["Time (s),A (V),B (V)", *triples()]), "utf-8")
    told = []
    for line in (
        ["rig", "look", str(tmp_path / "run.csv"), "--json"],
        ["rig", "import", "--look", str(tmp_path / "run.csv"), "--json"],
        ["rig", "import", str(tmp_path / "run.csv"), "none.toml", "--json", "--look", "--start=x",
         "--set", "rig.mode=longitudinal"],
    ):  # fmt: skip
        with pytest.raises(SystemExit) as ended:
            main(line)
        assert ended.value.code == 0
        told.append(capsys.readouterr().out)
    assert told[0] == told[1] == told[2]
    given = ["rig", "import", "--look", "a", "--join=b", "--units", "s,V", "--join", "c"]
    assert looking(given) == ["rig", "look", "a", "b", "c", "--units", "s,V"]
    assert looking(given[:2]) == given[:2]


def dated(clock, separator=","):
    """Rows of a clock that holds a place for milliseconds, and two channels."""
    return [
        separator.join((clock.format(n), f"{one:g}", f"{other:g}"))
        for n, (one, other) in enumerate(zip(A, B, strict=True))
    ]


REFUSED = {
    "segments": (lambda: [lecroy()[0], "Segments,3,SegmentSize,20", *lecroy()[2:]], "3 segments"),
    "no analog channels": (lambda: None, "no analog channels"),
    "a time without a unit": (
        lambda: ["Time,A (V),B (V)", *triples()], "'Time' has no unit of time"
    ),
    "no time": (lambda: ["A (V),B (V)", *joined(zip(A, B, strict=True))], "give --rate"),
    "rates that differ": (
        lambda: [row.replace("0.001000\t0.001000", "0.001000\t0.002000") for row in labview()],
        "2 different Delta_X",
    ),
    "LabVIEW's segments": (lambda: [*labview(), "", *labview()[12:]], "2 segments.*header only"),
    "a date beside the time": (
        lambda: ["Date,Time,A [V],B [V]", *dated("2026/03/02,12:04:05.{:03d}")],
        "row 2: '2026/03/02' is a date in a column of its own; export one column of time",
    ),
    "a date beside the time, LabVIEW": (
        lambda: [*labview()[:22], "Date\tTime\tTorque\tForce\tComment",
                 *dated("02.03.2026\t12:04:05.{:03d}", "\t")],
        "row 24: '02.03.2026' is a date in a column of its own",
    ),
    "a first row with more cells": (
        lambda: [*labview()[:23], labview()[23] + "\t\t1", *labview()[24:]],
        "row 24 has 5 cells for 4 columns",
    ),
    "no increment": (
        lambda: ["X,CH1,Start,", "Sequence,VOLT,0", *rigol_ds1054z()[2:]], "no increment"
    ),
    "a day that is none": (
        lambda: [*time_of_day()[:30], "noon,1,2", *time_of_day()[30:]], "row 31.*'noon'"
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_what_makes_no_recording_is_refused_with_the_reason(tmp_path, what):
    rows, told = REFUSED[what]
    path = tmp_path / ("run.sr" if rows() is None else "C1.csv")
    if rows() is None:
        sigrok(path, analog=0)
    else:
        path.write_text("\n".join(rows()), "utf-8")
    with pytest.raises(InputError, match=told) as refused:
        read_export(path, path.name)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ({"rate": "0 Hz"}, "--rate"), ({"rate": "20"}, "unit"), ({"columns": "a,,b"}, "--columns"),
        ({"columns": "a,b,a"}, "--columns"), ({"columns": "time,A"}, "names 2 columns; .* has 3"),
        ({"units": "s,V"}, "names 2 columns"), ({"rate": "1 kHz"}, "'Time' is the time"),
    ],
)  # fmt: skip
def test_what_is_said_of_a_file_must_fit_it(tmp_path, asked, told):
    path = tmp_path / "run.csv"
    path.write_text("\n".join(["Time (s),A (V),B (V)", *triples()]), "utf-8")
    with pytest.raises(InputError, match=told):
        read_text(path, "run.csv", declaration_of(**asked))


@given(st.floats(-1e9, 1e9, allow_nan=False), st.sampled_from([(".", ""), (",", "."), (".", ",")]))
def test_a_number_is_read_as_it_was_written(value, marks):
    decimal, thousands = marks
    text = f"{value:,.3f}" if thousands else f"{value:.3f}"
    text = text.replace(",", "T").replace(".", decimal).replace("T", thousands)
    assert is_number(text, ";")
    found = marks_of([[text]], ";")
    plain = text.replace(found[1], "") if found[1] else text
    assert float(plain.replace(found[0], ".")) == float(f"{value:.3f}")


@pytest.mark.slow
def test_a_look_tells_columns_values_and_gaps_and_draws_them(tmp_path, capsys):
    rows = tektronix_mso64()
    del rows[30]
    (tmp_path / "run.csv").write_text("\n".join(rows), "utf-8")
    with pytest.raises(SystemExit, match="0"):
        main(["rig", "look", str(tmp_path / "run.csv"), "--out", str(tmp_path / "out")])
    told = capsys.readouterr().out
    assert "Tektronix" in told
    found = read(tmp_path / "out" / "look.nc").dataset
    assert [*found["name"].values] == ["CH1 (V)", "CH2 (V)"]
    assert float(found.attrs["gaps"]) == 1
    assert float(found["start"]) == pytest.approx(TIMES[0])
    left = np.delete(A, 30 - 17)
    assert float(found["least"][0]) == pytest.approx(left.min(), abs=1e-4)
    assert float(found["mean"][0]) == pytest.approx(left.mean(), abs=1e-4)
    assert found["high"].values[0].max() == pytest.approx(left.max(), abs=1e-4)
    assert (tmp_path / "out" / "look.png").stat().st_size > 1000


def test_a_file_a_channel_becomes_a_recording(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {"torque_steel": 1, "speed_steel": 2, "speed_bronze": 3, "drive_voltage": 4}
    sets = []
    for signal, number in names.items():
        rows = lecroy()[:5] + joined(zip(TIMES, number * A, strict=True))
        (tmp_path / f"C{number}run.txt").write_text("\n".join(rows), "utf-8")
        points = '[["0 V","0 N m"],["5 V","2 N m"]]' if "torque" in signal else None
        points = '[["0 V","0 rpm"],["5 V","500 rpm"]]' if "speed" in signal else points
        more = f", points={points}" if points else ""
        sets += ["--set", f'channels.{signal}={{channel="C{number}"{more}}}']
    joins = [word for n in (2, 3, 4) for word in ("--join", f"C{n}run.txt")]
    with pytest.raises(SystemExit, match="0"):
        main(["rig", "import", "C1run.txt", "rig-final", *joins, *sets, "--out", "run.nc"])
    recording = Recording.open(tmp_path / "run.nc")
    # Counts of 16 bits.
    assert recording.values("drive_voltage") == pytest.approx(4.0 * A, abs=1e-3)
    assert "C1run.txt and C2run.txt" in capsys.readouterr().out
