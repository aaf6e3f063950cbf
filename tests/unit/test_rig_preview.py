"""A preview is small, whole, of numbers only, and tells the journal's last word on what is off."""

import errno
import json
import os

import pytest

from asperity.tribometer.guardian import stop
from asperity.tribometer.guardian.journal import Journal
from asperity.tribometer.preview import PREVIEW, Preview, look, runs


class Clock:
    now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def shown(tmp_path):
    clock = Clock()
    units = {"torque_steel": "N m", "speed_steel": "rad/s"}
    return Preview(tmp_path, units, simulated=True, now=clock), clock, tmp_path


def test_points_are_means_of_half_a_second_by_the_rigs_clock(shown):
    preview, clock, folder = shown
    preview.step("Cell 1", "Cell 2", 0, 2, asks=False)
    for poll in range(40):
        clock.now += 1.0
        levels = {"torque_steel": float(poll), "speed_steel": -1.0, "load_cell": 7.0}
        preview.levels(100.0 + 0.05 * (poll + 1), 0.05, levels)
        preview.beat()
    found = look(folder)
    assert found["time"] == pytest.approx([0.5, 1.0, 1.5, 2.0])
    assert [one["name"] for one in found["signals"]] == ["torque_steel", "speed_steel"]
    assert found["signals"][0]["values"] == pytest.approx([4.5, 14.5, 24.5, 34.5])
    assert found["signals"][1]["values"] == [-1.0] * 4
    assert (found["state"], found["step"], found["next"]) == ("runs", "Cell 1", "Cell 2")


@pytest.mark.slow
def test_it_stays_small_however_long_a_run_is_and_is_written_four_times_a_second(shown):
    preview, clock, folder = shown
    writes = []
    wrote = preview.write
    preview.write = lambda: (writes.append(clock.now), wrote())
    for poll in range(20_000):
        clock.now += 0.05
        preview.levels(0.05 * poll, 0.05, {"torque_steel": 1.0 / 3.0, "speed_steel": 1e5 / 3.0})
        preview.beat()
    assert len(writes) == pytest.approx(20_000 * 0.05 / 0.25, rel=0.3)
    assert (folder / PREVIEW).stat().st_size < 8000
    assert [path.name for path in folder.iterdir()] == [PREVIEW]


def test_a_folder_that_takes_no_file_ends_no_run(tmp_path):
    preview = Preview(tmp_path / "none", {}, simulated=False)
    preview.step("Cell 1", "", 0, 1, asks=True)
    preview.levels(1.0, 0.05, {})
    preview.beat()
    preview.end("finished")
    assert look(tmp_path / "none") is None


def test_what_is_off_and_how_it_ended_is_the_journals_word(shown):
    preview, _, folder = shown
    preview.show_outputs({"vibration": "on, sine 750 Hz"})
    preview.show_outputs({"steel": "on, 1 V"})
    book = Journal(folder)
    book.write("off", why="start", took_s=0.1, read_back={"steel": "off"})
    book.write("started")
    book.write("begun", action="a")
    found = look(folder)
    # It was off before, and was switched on since.
    assert (found["off"], found["ended"]) == (None, None)
    assert [one["told"] for one in found["outputs"]] == ["on, sine 750 Hz", "on, 1 V"]
    book.write("off", why="hangs", took_s=0.4, read_back={"steel": "off"}, still_on=["vibration"])
    assert look(folder)["off"]["still_on"] == ["vibration"]
    book.write("off", why="asked", took_s=0.1, read_back={"steel": "off"}, by_hand=["vibration"])
    assert look(folder)["off"]["by_hand"] == ["vibration"]
    assert look(folder)["ended"] is None
    book.write("latched", reason="hangs")
    book.close()
    # One that is on its way is no line yet.
    with (folder / "journal.jsonl").open("ab") as file:
        file.write(b'{"line": 6, "kind": "begun"')
    assert look(folder)["ended"] == {"kind": "latched", "reason": "hangs"}
    preview.end("latched")
    assert {one["told"] for one in look(folder)["outputs"]} == {"off"}


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "3", '{"age": NaN}', '{"a": Infinity}', "[" * 100_000]
)
def test_what_is_no_preview_is_no_run(tmp_path, text):
    (tmp_path / PREVIEW).write_text(text)
    assert look(tmp_path) is None
    assert runs(tmp_path) == []


@pytest.mark.skipif(os.name != "posix", reason="links")
def test_links_are_not_followed(shown, tmp_path_factory):
    _, _, folder = shown
    other = tmp_path_factory.mktemp("other")
    Preview(other, {}, simulated=True).write()
    Preview(folder / "none", {}, simulated=True).write()
    (folder / "linked").symlink_to(other)
    (folder / "own").mkdir()
    (folder / "own" / PREVIEW).symlink_to(other / PREVIEW)
    assert runs(folder) == []
    (folder / "own" / stop.NAME).symlink_to(other / "made")
    with pytest.raises(OSError):  # noqa: PT011 - which one the system says
        stop.press(folder / "own")
    assert not (other / "made").exists()


def test_runs_are_listed_by_their_folders_the_latest_first(tmp_path):
    for number, name in enumerate((".", "a", "out/b", "out/deep/c")):
        folder = tmp_path / name
        folder.mkdir(parents=True, exist_ok=True)
        Preview(folder, {}, simulated=True).write()
        os.utime(folder / PREVIEW, (1e9 + number, 1e9 + number))
    assert [one["name"] for one in runs(tmp_path)] == ["out/b", "a", "."]
    assert [one["name"] for one in runs(tmp_path, most=1)] == ["out/b"]


def test_a_stop_is_heard_once_and_one_of_before_not_at_all(tmp_path):
    import threading

    heard, came = [], threading.Event()
    stop.press(tmp_path)
    button = stop.StopButton(lambda: (heard.append(1), came.set()))
    button.watch(tmp_path)
    assert not (tmp_path / stop.NAME).exists()
    stop.press(tmp_path)
    assert came.wait(60.0)
    while (tmp_path / stop.NAME).exists():
        came.clear()
        came.wait(0.01)
    button.leave()
    assert heard == [1]


def test_a_stop_that_came_before_the_first_look_is_heard(tmp_path):
    import threading
    import time

    came = threading.Event()
    given = time.time()
    # As while a command loads; an old one is new with that.
    (tmp_path / stop.NAME).touch()
    os.utime(tmp_path / stop.NAME, (given - 60.0, given - 60.0))
    stop.press(tmp_path)
    button = stop.StopButton(came.set, given - 1.0)
    button.watch(tmp_path)
    button.watch(tmp_path)
    assert came.wait(60.0)
    button.leave()


def test_a_command_is_given_when_its_process_begins():
    import subprocess
    import sys
    import time

    before = time.time()
    script = (
        "import time; time.sleep(0.3); from asperity.processes import began; "
        "now = time.time(); assert now - 1.0 < began.began(); began.note(); print(began.began())"
    )
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    if os.path.exists("/proc/self/stat"):
        assert -0.05 < float(told.stdout) - before < 0.3, told
    assert float(told.stdout) >= before - 0.05


def test_a_disk_that_answers_with_an_error_ends_no_stop_button(tmp_path, monkeypatch):
    import threading

    came, failed = threading.Event(), threading.Event()
    stat = os.stat

    def stale(path, *args, **given):
        if str(path).endswith(stop.NAME) and not failed.is_set():
            failed.set()
            raise OSError(errno.ESTALE, "Stale file handle")
        return stat(path, *args, **given)

    monkeypatch.setattr(os, "stat", stale)
    button = stop.StopButton(came.set)
    button.watch(tmp_path)
    assert failed.wait(60.0)
    stop.press(tmp_path)
    assert came.wait(20.0)
    button.leave()


def test_journal_lines_stay_json(shown):
    preview, _, folder = shown
    preview.show_outputs({"a\nb": "on"})
    preview.write()
    assert json.loads((folder / PREVIEW).read_text())["outputs"] == [
        {"output": "a\nb", "told": "on"}
    ]
