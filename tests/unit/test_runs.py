"""Long works: kept now and then, interrupted between steps, gone on with, bit for bit."""

import dataclasses
import errno
import os
import signal
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.errors import StorageError
from asperity.runs import Interrupted, Run
from asperity.runs import run as run_module
from asperity.runs.cache import Cache
from asperity.runs.key import code_key, key
from asperity.runs.tree import DamagedError, from_tree, read_tree, to_tree, write_tree

KEY = key("code", "what was asked")


@dataclasses.dataclass(frozen=True)
class Inner:
    values: np.ndarray
    name: str


@dataclasses.dataclass(frozen=True)
class Outer:
    inner: Inner | None
    several: tuple[Inner, ...]
    rows: list[np.ndarray]
    pair: tuple[float, int]
    by_name: dict[str, float]
    count: int


@pytest.fixture
def outer():
    inner = Inner(np.arange(3.0), "first")
    return Outer(inner, (inner, inner), [np.eye(2)], (0.1, 2), {"x": 1.0}, 7)


def same(one, other):
    return repr(one) == repr(other)


def test_a_dataclass_comes_back_from_its_file(outer, tmp_path):
    write_tree(tmp_path / "kept.npz", to_tree(outer))
    assert same(from_tree(Outer, read_tree(tmp_path / "kept.npz")), outer)


@given(st.floats(allow_nan=False), st.integers(-(2**60), 2**60), st.text(max_size=20))
def test_numbers_and_texts_keep_every_bit(tmp_path_factory, number, count, text):
    path = tmp_path_factory.getbasetemp() / "kept.npz"
    tree = {"a": {"b": [number, count, text, None, True]}, "array": np.array([number])}
    write_tree(path, tree)
    assert same(read_tree(path), tree)


def test_what_is_no_part_of_a_tree_is_refused(tmp_path):
    with pytest.raises(TypeError, match="object is not part of a tree"):
        write_tree(tmp_path / "kept.npz", {"a": object()})
    assert not list(tmp_path.iterdir())


def test_any_flipped_bit_that_matters_is_found(tmp_path):
    path = tmp_path / "kept.npz"
    tree = {"a": np.arange(4.0), "b": "text"}
    write_tree(path, tree)
    whole = path.read_bytes()
    found = 0
    for place in range(len(whole)):
        path.write_bytes(whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1 :])
        try:
            assert same(read_tree(path), tree), place
        except DamagedError:
            found += 1
    assert found > len(whole) // 3


def test_a_damaged_entry_of_a_cache_is_set_aside_and_told(tmp_path):
    told = []
    cache = Cache(tmp_path, told.append)
    cache.put(KEY, {"a": np.arange(100.0)})
    (file,) = tmp_path.iterdir()
    content = bytearray(file.read_bytes())
    content[200] ^= 1
    file.write_bytes(content)
    assert cache.get(KEY) is None
    assert [path.name for path in tmp_path.iterdir()] == [f"{KEY}.npz.damaged"]
    assert "is damaged" in told[0]
    assert "set aside" in told[0]
    cache.put(KEY, {"a": np.arange(2.0)})
    assert list(cache.get(KEY)["a"]) == [0.0, 1.0]


def test_a_cache_without_a_folder_keeps_nothing():
    cache = Cache(None)
    cache.put(KEY, {"a": 1})
    assert cache.get(KEY) is None


def work(run, steps, press_at=None):
    """Sum the numbers up to `steps`, pressing Ctrl-C at one of them."""
    kept = run.resume(KEY)
    state = kept or {"total": 0.0, "done": 0}
    first = state["done"]
    with run.interruptible():
        while state["done"] < steps:
            state["done"] += 1
            state["total"] += state["done"]
            if state["done"] == press_at:
                os.kill(os.getpid(), signal.SIGINT)
            run.checkpoint(state["done"], steps, lambda: state)
    return state["total"], first


def test_an_interrupted_work_goes_on_where_it_was(tmp_path):
    told = []
    with pytest.raises(Interrupted, match=r"interrupted after 40 of 100 steps; .* goes on from"):
        work(Run(folder=tmp_path), 100, press_at=40)
    run = Run(folder=tmp_path, notify=told.append)
    assert work(run, 100) == (5050.0, 40)
    run.finished()
    assert not list(tmp_path.iterdir())
    assert told == []


def test_what_was_kept_before_is_told_where_nothing_is_kept_now(tmp_path):
    run = Run(folder=tmp_path)
    run.resume(KEY)
    with run.interruptible():
        run._file.save({"done": 3})
        os.kill(os.getpid(), signal.SIGINT)
        with pytest.raises(
            Interrupted, match=r"after 3 of 9 cycles; the same command goes on from"
        ):
            run.checkpoint(3, 9, what="cycles")


def test_a_state_of_something_else_is_not_gone_on_from(tmp_path):
    with pytest.raises(Interrupted):
        work(Run(folder=tmp_path), 100, press_at=40)
    told = []
    run = Run(folder=tmp_path, notify=told.append)
    assert run.resume(key("code", "another case")) is None
    assert "another case or version" in told[0]


def test_a_damaged_state_is_set_aside_and_told(tmp_path):
    with pytest.raises(Interrupted):
        work(Run(folder=tmp_path), 100, press_at=40)
    (file,) = tmp_path.iterdir()
    file.write_bytes(file.read_bytes()[:-60])
    told = []
    assert work(Run(folder=tmp_path, notify=told.append), 100) == (5050.0, 0)
    assert "set aside as run.interrupted.npz.damaged" in told[0]


def test_a_state_that_cannot_be_opened_is_told_and_stays(tmp_path, monkeypatch):
    with pytest.raises(Interrupted):
        work(Run(folder=tmp_path), 100, press_at=40)
    (file,) = tmp_path.iterdir()
    kept = file.read_bytes()

    def opened(path, mode="r"):
        raise OSError(errno.EMFILE, "Too many open files")

    told = []
    with monkeypatch.context() as patched:
        patched.setattr(Path, "open", opened)
        with pytest.raises(StorageError, match="cannot be read: too many open files; it holds"):
            Run(folder=tmp_path).resume(KEY)
        assert Cache(tmp_path, told.append).get("run.interrupted") is None
    assert told == []
    assert file.read_bytes() == kept


def test_a_work_without_a_folder_is_interrupted_without_a_trace(tmp_path):
    with pytest.raises(Interrupted, match=r"interrupted after 3 of 9 steps$"):
        work(Run(), 9, press_at=3)


def test_a_work_that_keeps_nothing_is_interrupted_at_its_next_step(tmp_path):
    run = Run(folder=tmp_path)
    with run.interruptible():
        run.checkpoint(3, 9, what="pulls")
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(Interrupted, match=r"^interrupted after 4 of 9 pulls$"):
            run.checkpoint(4, 9, what="pulls")
    assert not list(tmp_path.iterdir())


def test_progress_is_told():
    told = []
    work(Run(progress=lambda done, total: told.append((done, total))), 3)
    assert told == [(1, 3), (2, 3), (3, 3)]


@pytest.fixture
def timed(monkeypatch):
    """A run, the clock in its sight, which a test sets, and what it tells."""
    now, told = [0.0], []
    monkeypatch.setattr(run_module.time, "monotonic", lambda: now[0])
    return Run(notify=told.append), now, told


def test_a_work_of_more_than_a_minute_is_announced_once(timed):
    run, now, told = timed
    for done in range(1, 100):
        now[0] += 1.0
        run.checkpoint(done, 1000)
    assert told == ["this will take about 17 minutes"]


@pytest.mark.parametrize("compiling", [1, 2])
def test_steps_that_compile_are_no_measure_of_what_a_work_takes(timed, compiling):
    run, now, told = timed
    run.checkpoint(0, 1600)
    for done in range(1, 1601):
        now[0] += 18.0 if done <= compiling else 0.02
        run.checkpoint(done, 1600)
    # It takes a minute altogether, and never looked like hours.
    assert told in ([], ["this will take about 32 seconds"])


def test_a_work_that_begins_anew_is_measured_anew(timed):
    run, now, told = timed
    # As a march with a finer step does: what it did before is no measure of it.
    for total in (1000, 2000):
        for done in range(1, total + 1):
            now[0] += 0.02
            run.checkpoint(done, total)
    assert told == []


def test_before_more_than_two_steps_are_measured_nothing_is_forecast(timed):
    run, now, told = timed
    for done in range(3):
        run.checkpoint(done, 100)
        now[0] += 10.0
    assert told == []
    run.checkpoint(3, 100)
    run.checkpoint(4, 100)
    assert len(told) == 1


def test_a_look_that_cannot_be_written_ends_nothing_and_is_told_once():
    looks, told = [], []

    def look(made):
        looks.append(made())
        raise StorageError("so-far.nc cannot be written: no space left on device")

    run = Run(watch=look, notify=told.append)
    for n in range(2):
        run.watch(lambda n=n: n)
    assert looks == [0]
    assert told == ["so-far.nc cannot be written: no space left on device; goes on without"]


def test_a_short_work_is_not_announced(timed):
    run, now, told = timed
    for done in range(1, 50):
        now[0] += 1.0
        run.checkpoint(done, 50)
    assert told == []


def test_a_forecast_of_more_than_a_minute_is_announced_and_not_said_again(timed):
    run, now, told = timed
    run.forecast(20.0, "9 points")
    run.forecast(810.0, "9e+09 steps")
    for done in range(1, 100):
        now[0] += 1.0
        run.checkpoint(done, 1000)
    assert told == ["9e+09 steps take about 14 minutes"]


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(70.0, "70 seconds"), (600.0, "10 minutes"), (9e4, "25 hours"), (4e8, "4630 days")],
)
def test_a_duration_is_told_in_the_unit_that_suits_it(seconds, words):
    assert run_module.duration(seconds) == words


def test_a_key_follows_what_was_asked_and_what_it_is_computed_by():
    keys = {
        key("code", "a"),
        key("code", "b"),
        key("other code", "a"),
        key("code", "a", ""),
        key("code", np.arange(2.0)),
        key("code", np.arange(2)),
    }
    assert len(keys) == 6
    assert code_key("asperity.rating.rate") != code_key("asperity.slider.batch")


def test_a_key_depends_on_the_content_shape_and_type_of_arrays():
    a = np.arange(6.0)
    assert len({key("", a), key("", a.reshape(2, 3)), key("", a.astype(int)), key("", a, "")}) == 4
    assert key("", a[::-1][::-1]) == key("", a)
