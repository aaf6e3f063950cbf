"""A recording holds what was recorded, says what is missing, and survives being killed."""

import contextlib
import errno
import importlib.util
import json
import os
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray as xr
from apparatus.grid import slow

from asperity.errors import StorageError
from asperity.files.store import read_dataset
from asperity.tribometer.recording import Recorder, Recording, Source, blocks, layout
from asperity.tribometer.recording.blocks import blocks_beside
from asperity.tribometer.recording.hdf5 import joined
from asperity.tribometer.signals import SIGNALS

SOURCES = [Source("torque_steel", "V", 1e-3, 0.5), Source("drive_voltage", "mV", 2.0)]
BLOCK, INTERVAL = 100, 1e-3
DOCS = Path(__file__).parents[2] / "docs"


def counts(rows, seed=0):
    return np.random.default_rng(seed).integers(-3000, 3000, (rows, 2), dtype=np.int16)


def recorder(path, **options):
    return Recorder(path, SOURCES, INTERVAL, block=BLOCK, **options)


def stored(path):
    return np.concatenate([part for _, part in Recording.open(path).stretches()])


@pytest.mark.slow
@pytest.mark.parametrize("compress", [True, False])
@pytest.mark.parametrize("pieces", [[450], [30] * 15, [100, 100, 250]])
def test_what_was_recorded_is_read_back(tmp_path, compress, pieces):
    path, given = tmp_path / "run.nc", counts(450)
    with recorder(path, configuration=json.dumps({"rig": {"name": "one"}})) as made:
        done = 0
        for piece in pieces:
            done += piece
            made.append(given[done - piece : done], done * INTERVAL)
        made.event(0.2, "vibration", "750 Hz sine")
        made.close(compress=compress)
    found = Recording.open(path)
    assert np.array_equal(stored(path), given)
    assert found.gaps == ()
    assert found.configuration == {"rig": {"name": "one"}}
    assert found.sources == tuple(SOURCES)
    assert [event.text for event in found.events] == ["750 Hz sine"]
    assert found.values("torque_steel", 5, 9) == pytest.approx(0.5 + 1e-3 * given[5:9, 0])
    with xr.open_dataset(path, engine="h5netcdf") as data:
        assert dict(data.sizes) == {"sample": 450, "channel": 2, "event": 1, "block": 5}
        assert data["raw"].dims == ("sample", "channel")
        assert data["signal"].values.tolist() == ["torque_steel", "drive_voltage"]
    assert all(one.attrs["units"] for one in read_dataset(path).data_vars.values())


@pytest.mark.slow
def test_lost_and_late_samples_are_gaps(tmp_path):
    path = tmp_path / "run.nc"
    with recorder(path) as made:
        made.append(counts(200), 0.2, first=0)
        made.append(counts(100), 0.35, first=250)
        made.append(counts(100), 5.0, first=350)
    lost, late = Recording.open(path).gaps
    assert lost.reason == "50 samples lost"
    assert (lost.time, lost.duration) == pytest.approx((0.2, 0.05))
    assert "late" in late.reason


@pytest.mark.slow
def test_lost_samples_are_one_gap_though_a_block_was_not_full(tmp_path):
    path = tmp_path / "run.nc"
    with recorder(path) as made:
        made.append(counts(100), 0.1, first=0)
        made.append(counts(50), 0.15, first=100)
        made.append(counts(100), 5.25, first=5150)
    (lost,) = Recording.open(path).gaps
    assert lost.reason == "5000 samples lost"


@pytest.mark.slow
def test_samples_that_are_no_values_are_not_numbers(tmp_path):
    path, given = tmp_path / "run.nc", counts(100)
    given[3, 0], given[4, 0], given[5, 0] = layout.MISSING, layout.BEYOND, -layout.BEYOND
    with recorder(path) as made:
        made.append(given, 0.1)
    assert np.flatnonzero(np.isnan(Recording.open(path).values("torque_steel"))).tolist() == [
        3,
        4,
        5,
    ]


def test_a_block_that_was_changed_is_told(tmp_path):
    path = tmp_path / "run.nc"
    with recorder(path) as made:
        made.append(counts(300), 0.3)
        made.close(compress=False)
    with h5py.File(path, "r+") as file:
        file["raw"][150, 0] += 1
    (gap,) = Recording.open(path).gaps
    assert "check sum" in gap.reason
    assert (gap.time, gap.duration) == pytest.approx((0.1, 0.1))


@pytest.mark.parametrize(
    ("place", "kept", "wrong"),
    # The last block may have been on its way; one before it is kept, and told when it is opened.
    [(-2 * BLOCK, 2, 0), (-6 * BLOCK, 3, 1)],
)
def test_a_block_whose_bytes_are_not_those_that_were_written_is_told(tmp_path, place, kept, wrong):
    path, given = tmp_path / "run.nc", counts(3 * BLOCK)
    made = recorder(path)
    made.append(given, 0.3)
    made.leave()
    beside = blocks_beside(path)
    content = bytearray(beside.read_bytes())
    content[place] ^= 1
    beside.write_bytes(content)
    found = Recording.open(path)
    assert found.samples == kept * BLOCK
    assert ["check sum" in gap.reason for gap in found.gaps] == [True] * wrong
    assert not beside.exists()


@pytest.mark.parametrize("row", [0, 1, 3])
def test_blocks_that_a_disk_has_damaged_are_kept_and_told(tmp_path, row):
    path = tmp_path / "one.nc"
    made = recorder(path)
    for number in range(5):
        made.append(counts(BLOCK), 0.1 * number)
    made.leave()
    beside = blocks_beside(path)
    held = bytearray(beside.read_bytes())
    place = len(blocks._MAGIC)
    for _ in range(row):
        _, length, *_ = blocks._HEAD.unpack_from(held, place)
        place += blocks._HEAD.size + blocks._SUM.size + length
    held[place + 5] ^= 1
    beside.write_bytes(held)
    # What was not even begun is no recording; of another all that stands before is one.
    assert joined(path) == bool(row)
    assert not beside.exists()
    (kept,) = tmp_path.glob(".*.damaged")
    assert kept.read_bytes() == held
    if row:
        found = Recording.open(path)
        assert found.samples == BLOCK * (row - 1)
        (event,) = [one for one in found.events if one.kind == "damage"]
        assert f"from byte {place} on" in event.text


def test_an_event_whose_bytes_are_damaged_ends_what_is_read(tmp_path):
    path = tmp_path / "run.nc"
    made = recorder(path)
    made.append(counts(BLOCK), 0.1)
    made.event(0.05, "vibration", "750 Hz sine")
    made.append(counts(BLOCK), 0.2)
    made.leave()
    beside = blocks_beside(path)
    beside.write_bytes(beside.read_bytes().replace(b"750 Hz", b"150 Hz"))
    found = Recording.open(path)
    assert (found.samples, [one.kind for one in found.events]) == (BLOCK, ["damage"])


@pytest.mark.parametrize("content", [b"", b"x" * 100, b"\x89HDF\r\n\x1a\n" + b"\0" * 200])
def test_what_is_no_recording_is_refused(tmp_path, content):
    (tmp_path / "run.nc").write_bytes(content)
    with pytest.raises(StorageError, match="cannot be read"):
        Recording.open(tmp_path / "run.nc")


def _external_link(file, other):
    del file[layout.RAW]
    file[layout.RAW] = h5py.ExternalLink(other, layout.RAW)


def _soft_link(file, other):
    file["aside"] = h5py.SoftLink("/nowhere")


def _external_numbers(file, other):
    del file[layout.RAW]
    file.create_dataset(layout.RAW, (8, 2), "i2", external=[(other, 0, 32)])


def _virtual_numbers(file, other):
    del file[layout.RAW]
    virtual = h5py.VirtualLayout((8, 2), "i2")
    virtual[:] = h5py.VirtualSource(other, layout.RAW, (8, 2))
    file.create_virtual_dataset(layout.RAW, virtual)


@pytest.mark.slow
@pytest.mark.parametrize(
    "lead_out", [_external_link, slow(_soft_link), slow(_external_numbers), _virtual_numbers]
)
def test_a_recording_that_leads_into_another_file_is_refused(tmp_path, lead_out):
    path, other = tmp_path / "run.nc", tmp_path / "other.nc"
    for each in (path, other):
        with recorder(each, configuration="{}") as made:
            made.append(counts(200), 200 * INTERVAL)
            made.close()
    with h5py.File(path, "r+") as file:
        lead_out(file, str(other))
    with pytest.raises(StorageError, match="lies in another file"):
        Recording.open(path)


def test_another_netcdf_is_refused_with_what_to_do(tmp_path):
    xr.Dataset({"a": 1}).to_netcdf(tmp_path / "run.nc", engine="h5netcdf")
    with pytest.raises(StorageError, match="asperity rig import"):
        Recording.open(tmp_path / "run.nc")


@pytest.mark.skipif(not hasattr(os, "posix_fallocate"), reason="asks the system for space")
def test_space_is_asked_for_before_a_file_is_begun(tmp_path, monkeypatch):
    path = tmp_path / "one.nc"
    made = recorder(path)
    made.append(counts(BLOCK), 0.1)
    made.leave()
    asked = []

    def full(descriptor, place, size):
        asked.append(size)
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    with monkeypatch.context() as disk:
        disk.setattr(os, "posix_fallocate", full)
        with pytest.raises(StorageError, match="no space left"):
            joined(path)
    # All of the counts, at least; what was recorded stands where it stood.
    assert asked[0] >= 2 * 2 * BLOCK
    assert list(tmp_path.iterdir()) == [blocks_beside(path)]
    assert joined(path)
    assert stored(path).shape == (BLOCK, 2)


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="needs limits of a process")
def test_a_full_disk_is_a_line(tmp_path):
    limit = "import resource, signal; signal.signal(signal.SIGXFSZ, signal.SIG_IGN); "
    limit += "resource.setrlimit(resource.RLIMIT_FSIZE, (300_000, 300_000)); "
    code = limit + WRITER.replace("while True:", "for n in range(1000):")
    ended = subprocess.run(
        [sys.executable, "-c", code, str(tmp_path / "run.nc"), "2000", "0"],
        capture_output=True,
        text=True,
    )
    told = [line for line in ended.stderr.splitlines() if "StorageError" in line]
    assert "cannot be written" in told[0]


WRITER = """
import sys
import time
import numpy as np
from pathlib import Path
from asperity.tribometer.recording import Recorder, Source
names = ["torque_steel", "torque_bronze", "speed_steel", "speed_bronze", "drive_voltage",
         "load_cell", "current_steel", "current_bronze"]
block, pause = int(sys.argv[2]), float(sys.argv[3])
rate = 10.0 * block
made = Recorder(Path(sys.argv[1]), [Source(name, "V", 1e-3) for name in names], 1 / rate)
print("begun", flush=True)
n = 0
begun = time.monotonic()
while True:
    time.sleep(max(0.0, begun + n * pause - time.monotonic()))
    values = np.full((block, 8), n % 30000 + 1, np.int16)
    made.append(values, (n + 1) * 0.1)
    n += 1
    print(n, flush=True)
"""


def killed(folder, number, block, wait):
    """Kill a recording after a time; returns its file and how many blocks it had reported."""
    path = folder / f"run-{number}.nc"
    told, tells = os.pipe()
    child = os.fork()
    if not child:
        try:
            # Blocks of a tenth of a second come ten times as fast as from a device.
            sys.argv = ["", str(path), str(block), "0.01"]
            with open(tells, "w", encoding="utf-8") as out, contextlib.redirect_stdout(out):
                exec(WRITER, {})
        finally:
            os._exit(1)
    os.close(tells)
    with open(told, encoding="utf-8") as said:
        assert said.readline() == "begun\n"
        time.sleep(wait)
        os.kill(child, signal.SIGKILL)
        reported = [int(line) for line in said]
    os.waitpid(child, 0)
    return path, max(reported, default=0)


def check_killed(path, block, reported):
    """What must hold of a file whose recording was killed."""
    found = Recording.open(path)
    assert found.gaps == ()
    assert found.samples >= block * reported
    assert found.samples <= block * (reported + 1)
    with xr.open_dataset(path, engine="h5netcdf", mask_and_scale=False) as data:
        raw = data["raw"].values
    for n in range(found.samples // block):
        assert np.all(raw[n * block : (n + 1) * block] == n % 30000 + 1)
    # What no block tells of is not invented: it is marked as missing, or was written whole.
    rest = raw[found.samples :]
    last = found.samples // block % 30000 + 1
    assert np.all((rest == layout.MISSING) | (rest == last))
    path.unlink()


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_a_recording_that_is_killed_lacks_its_last_block_at_most(tmp_path):
    for number, wait in enumerate((0.0, 0.02, 0.055)):
        path, reported = killed(tmp_path, number, 2000, wait)
        check_killed(path, 2000, reported)


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="needs signals")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
@pytest.mark.campaign(tried_by="test_a_recording_that_is_killed_lacks_its_last_block_at_most")
@pytest.mark.parametrize("part", range(10))
def test_of_300_recordings_killed_at_random_each_lacks_its_last_block_at_most(tmp_path, part):
    rng = random.Random(part)
    for number in range(30):
        path, reported = killed(tmp_path, number, 50_000, rng.uniform(0.0, 1.0))
        check_killed(path, 50_000, reported)


@pytest.mark.slow
def test_the_reader_of_the_docs_reads_a_recording_without_this_package(tmp_path):
    path = tmp_path / "run.nc"
    given = counts(600)
    given[3, 0], given[5, 1], given[6, 1] = layout.MISSING, layout.BEYOND, -layout.BEYOND
    with recorder(path) as made:
        made.append(given[:120], 0.12)
        made.event(0.05, "vibration", "750 Hz sine")
        made.append(given[120:], 0.6)
    script = DOCS / "read_recording.py"
    # A page of the docs says that it is short.
    body = script.read_text("utf-8").split("def read(path):\n")[1].split("\n\n\nif ")[0]
    assert len(body.splitlines()) <= 20
    assert "asperity" not in script.read_text("utf-8")
    spec = importlib.util.spec_from_file_location("read_recording", script)
    reader = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(reader)
    times, signals, units, events = reader.read(path)
    opened = Recording.open(path)
    assert times == pytest.approx(1e-3 * np.arange(600))
    assert list(signals) == [one.signal for one in opened.sources]
    for one in opened.sources:
        assert units[one.signal] == one.units
        np.testing.assert_array_equal(signals[one.signal], opened.values(one.signal))
        assert np.isnan(signals[one.signal]).any()
    assert [tuple(one) for one in events] == [(0.05, "vibration", "750 Hz sine")]
    with h5py.File(path, "r+") as file:
        file["raw"][100, 0] += 1
    with pytest.raises(ValueError, match="damaged"):
        reader.read(path)


@pytest.mark.slow
def test_the_layout_s_page_names_all_that_is_in_a_recording(tmp_path):
    with recorder(tmp_path / "run.nc") as made:
        made.append(counts(10), 0.01)
    page = (DOCS / "recording-format.rst").read_text("utf-8")
    assert f"``{layout.FORMAT}``" in page
    for name in (*layout.CHANNELS, *layout.EVENTS, *layout.BLOCKS):
        assert re.search(rf"``{name}\((channel|event|block)\)``", page), name
    with h5py.File(tmp_path / "run.nc") as file:
        for name in file.attrs:
            assert name.startswith("_") or f"``{name}``" in page, name
    for signal_ in SIGNALS.values():
        row = rf"``{signal_.name}``\s+{re.escape(signal_.unit)}\s+{re.escape(signal_.meaning)}"
        assert re.search(row, page), signal_.name
