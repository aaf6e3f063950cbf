"""What is kept in the user's cache folder: shown, and removed where that is asked for."""

import contextlib
import json
import os
import re
import shutil
import sqlite3
import stat
import time
from pathlib import Path

import numpy as np
import pytest

from asperity.files.caches import KINDS
from asperity.files.folders import cache_folder
from asperity.files.leftovers import temporary_beside
from asperity.kernels.compiled import kernel
from asperity.runs.cache import Cache
from asperity.runs.row_cache import Rows
from asperity.web.token import token_of

KEY = "0f" * 16
ANSWERS = ("condensed", "reduced", "loaded", "modes", "thesis")


@pytest.fixture
def root(tmp_path, monkeypatch):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "user"))
    return tmp_path / "user" / "asperity"


@pytest.fixture
def cache(asperity, root):
    """Run the command: its exit code, what it prints and what it says beside that."""

    def run(*arguments):
        return asperity("cache", *arguments, env={**os.environ, "COLUMNS": "100"})

    return run


@pytest.fixture
def shown(cache):
    """Return the JSON object, its kinds by name."""

    def run(*arguments):
        code, output, _ = cache(*arguments, "--json")
        assert code == 0
        answer = json.loads(output)
        return {**answer, "kinds": {each["kind"]: each for each in answer["kinds"]}}

    return run


@pytest.fixture
def filled(root):
    for kind in ANSWERS:
        Cache.of_this_user(kind).put(KEY, {"one": np.arange(10.0)})
    rows = Rows.of_this_user("sweep", pytest.fail)
    rows.put({KEY: {"ratio": 0.5}})
    rows.close()
    made = cache_folder("kernels") / KEY
    made.mkdir(mode=0o700)
    (made / "kernels.so").write_bytes(bytes(1000))
    (made / "kernels.table").write_bytes(bytes(234))
    token_of(root)
    long_ago = time.mktime((2025, 6, 7, 12, 0, 0, 0, 0, -1))
    os.utime(made, (long_ago, long_ago))
    return root


def files(folder):
    return sorted(path for path in folder.rglob("*") if not path.is_dir())


def test_a_new_user_has_nothing_and_nothing_is_made(cache, shown, root):
    code, output, errors = cache()
    assert (code, errors) == (0, "")
    assert output.startswith(f"{root}\n")
    answer = shown()
    assert answer["folder"] == str(root)
    assert answer["removed"] is None
    assert list(answer["kinds"]) == list(KINDS)
    for each in answer["kinds"].values():
        assert (each["files"], each["bytes"], each["oldest"]) == (0, 0, None)
    assert shown("--clear")["removed"] == {"files": 0, "bytes": 0}
    assert not root.exists()


def test_every_kind_has_a_row_with_files_bytes_and_the_oldest(cache, shown, filled):
    answer = shown()
    kinds = answer["kinds"]
    assert {kind: each["files"] for kind, each in kinds.items()} == dict.fromkeys(KINDS, 1) | {
        "kernels": 2
    }
    assert kinds["kernels"]["bytes"] == 1234
    assert kinds["kernels"]["oldest"].startswith("2025-06-07T")
    for kind in KINDS:
        assert kinds[kind]["bytes"] == sum(path.stat().st_size for path in files(filled / kind))
    code, output, errors = cache()
    assert (code, errors) == (0, "")
    assert [line.split()[0] for line in output.splitlines()[2:]] == ["kind", *KINDS, "all"]
    assert re.search(r"^kernels +2 +1\.2 kB  2025-06-07  machine code", output, re.MULTILINE)
    assert len(files(filled)) == len(ANSWERS) + 4


def test_every_kind_that_the_package_keeps_is_known():
    source = Path(__file__).parents[2] / "src" / "asperity"
    words = ('of_this_user("', 'cache_folder("', 'standing_folder("')
    named = {
        text.partition('"')[0]
        for path in source.rglob("*.py")
        for word in words
        for text in path.read_text("utf-8").split(word)[1:]
    }
    assert named == set(KINDS)


def test_all_of_it_or_one_kind_is_removed_and_the_folders_stay(cache, shown, filled):
    code, output, _ = cache("--clear", "modes")
    assert (code, output.startswith("removed 1 file, ")) == (0, True)
    assert [path.parent.name for path in files(filled)].count("modes") == 0
    assert len(files(filled)) == len(ANSWERS) + 3
    before = shown()["kinds"]
    answer = shown("--clear")
    assert answer["removed"] == {
        "files": len(ANSWERS) + 3,
        "bytes": sum(each["bytes"] for each in before.values()),
    }
    assert files(filled) == []
    assert {path.name for path in filled.iterdir()} == set(KINDS)
    assert not any(each["files"] for each in answer["kinds"].values())


def test_an_unknown_kind_is_refused_and_nothing_removed(cache, filled):
    code, output, errors = cache("--clear", "modes", "kernel")
    assert (code, output) == (2, "")
    assert errors == "'kernel' is no kind of what is kept (did you mean 'kernels'?)\n"
    assert len(files(filled)) == len(ANSWERS) + 4


def test_no_link_is_followed(cache, shown, filled, tmp_path):
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "precious").write_text("text")
    (outside / f"{KEY}.npz").write_text("text")
    (filled / "kernels" / ("a" * 32)).symlink_to(outside)
    (filled / "kernels" / KEY / "inner").symlink_to(outside)
    (filled / "modes" / f"{'b' * 32}.npz").symlink_to(outside / "precious")
    (outside / "rows").write_bytes((filled / "sweep" / "results-1.sqlite").read_bytes())
    (filled / "sweep" / "results-9.sqlite").symlink_to(outside / "rows")
    rows = (outside / "rows").read_bytes()
    shutil.rmtree(filled / "condensed")
    (filled / "condensed").symlink_to(outside)
    assert shown()["kinds"]["condensed"]["files"] == 0
    assert shown()["kinds"]["condensed"]["is_link"]
    code, _, errors = cache("--clear")
    assert code == 0
    assert errors == "condensed: its folder is a link, which is not followed\n"
    assert {path.name for path in outside.iterdir()} == {"precious", "rows", f"{KEY}.npz"}
    assert (outside / "precious").read_text() == "text"
    assert (outside / "rows").read_bytes() == rows
    assert files(filled) == []
    assert (filled / "condensed").is_symlink()


@pytest.mark.parametrize("where", [".", "modes"])
def test_a_folder_that_others_may_write_to_is_refused(cache, filled, where):
    (filled / where).chmod(0o770)
    code, output, errors = cache("--clear")
    assert (code, output, errors.count("\n")) == (2, "", 1)
    assert f"{filled / where} can be written to by others; nothing is removed" in errors
    assert len(files(filled)) == len(ANSWERS) + 4
    assert cache()[0] == 0


def test_a_folder_of_another_user_is_refused(cache, filled, monkeypatch):
    own = os.geteuid()
    monkeypatch.setattr(os, "geteuid", lambda: own + 1)
    code, _, errors = cache("--clear", "thesis")
    assert (code, errors.count("\n")) == (2, 1)
    assert "belongs to another user" in errors
    assert len(files(filled)) == len(ANSWERS) + 4


def test_what_has_another_name_stays(cache, filled):
    mine = filled / "thesis" / "mine.txt"
    mine.touch()
    (filled / "notes").mkdir()
    (filled / "notes" / f"{KEY}.npz").touch()
    code, _, errors = cache("--clear")
    assert (code, errors) == (0, "thesis: 1 thing of another name stayed\n")
    assert files(filled) == [filled / "notes" / f"{KEY}.npz", mine]


def test_nothing_goes_on_telling_that_all_kernels_are_there(cache, filled):
    (filled / "kernels" / f"compiled-{'0a' * 8}").touch()
    assert cache("--clear", "kernels")[::2] == (0, "")
    assert files(filled / "kernels") == []


def test_what_a_process_is_making_stays(cache, filled):
    working, killed = (filled / "kernels" / f"new-{word}" for word in ("0a", "0b"))
    for folder in (working, killed):
        folder.mkdir()
        (folder / "kernels.so").touch()
    os.utime(killed, (0.0, time.time() - 7200.0))
    lock = filled / "kernels" / "maker-0.lock"
    lock.touch()
    writing = temporary_beside(filled / "thesis" / f"{KEY}.npz")
    writing.touch()
    assert cache("--clear")[::2] == (0, "")
    assert files(filled) == sorted([working / "kernels.so", lock, writing])


def test_a_sweep_that_runs_keeps_what_it_finds_from_then_on(cache, shown, filled):
    told = []
    running = Rows.of_this_user("sweep", told.append)
    running.put({f"{n:032x}": {"text": "x" * 2000} for n in range(100)})
    code, _, errors = cache("--clear", "sweep")
    assert (code, errors) == (0, "")
    assert running.get([KEY, f"{5:032x}"]) == {}
    running.put({KEY: {"ratio": 0.25}})
    running.close()
    again = Rows.of_this_user("sweep", told.append)
    assert again.get([KEY]) == {KEY: {"ratio": 0.25}}
    again.close()
    assert told == []
    assert shown()["kinds"]["sweep"]["bytes"] < 20_000


def test_a_sweep_in_the_midst_of_writing_is_not_disturbed(cache, filled, monkeypatch):
    connect = sqlite3.connect
    monkeypatch.setattr(sqlite3, "connect", lambda *a, **k: connect(*a, **{**k, "timeout": 0.01}))
    (database,) = files(filled / "sweep")
    with contextlib.closing(connect(database, isolation_level=None)) as writing:
        writing.execute("BEGIN IMMEDIATE")
        code, _, errors = cache("--clear")
        assert (code, errors.count("\n")) == (2, 1)
        assert "results-1.sqlite cannot be removed: it is being written to; try again" in errors
        writing.execute("COMMIT")
        assert len(writing.execute("SELECT key FROM results").fetchall()) == 1
    assert {path.parent.name for path in files(filled)} <= {"sweep"}


@pytest.mark.parametrize("content", [b"no database" * 500, b""])
def test_a_damaged_file_of_rows_goes(cache, filled, content):
    (database,) = files(filled / "sweep")
    database.write_bytes(content)
    assert cache("--clear", "sweep")[::2] == (0, "")
    assert files(filled / "sweep") == []


def test_a_cache_that_is_in_use_goes_on(cache, filled):
    kept = Cache.of_this_user("thesis")
    assert kept.get(KEY) is not None
    cache("--clear")
    assert kept.get(KEY) is None
    kept.put(KEY, {"one": np.arange(3.0)})
    assert list(kept.get(KEY)["one"]) == [0.0, 1.0, 2.0]


@pytest.mark.slow
def test_a_kernel_that_is_loaded_goes_on_and_keeps_what_it_compiles_next(cache, root, monkeypatch):
    monkeypatch.setenv("ASPERITY_NATIVE", "0")

    @kernel
    def double(x):
        return 2.0 * x

    before = os.umask(0o002)
    try:
        assert double(1.0) == 2.0
        (made,) = (root / "kernels").iterdir()
        assert cache("--clear")[::2] == (0, "")
        assert not made.exists()
        assert double(1.0) == 2.0
        assert double(np.arange(2.0)).tolist() == [0.0, 2.0]
    finally:
        os.umask(before)
    # Or it would never be read from again.
    assert stat.S_IMODE(made.stat().st_mode) == 0o700
    assert files(made)


def test_a_folder_that_is_none_is_told(cache, root):
    root.parent.touch()
    code, output, errors = cache()
    assert (code, errors) == (0, "")
    assert output.startswith(str(root))
    assert cache("--clear")[:2] == (0, "removed 0 files, 0 B\n")


def test_a_user_without_a_home_is_told_what_to_name(cache, monkeypatch):
    monkeypatch.delenv("ASPERITY_CACHE")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setattr(Path, "home", lambda: (_ for _ in ()).throw(RuntimeError("no home")))
    code, output, _ = cache("--clear")
    assert (code, output) == (0, "removed 0 files, 0 B\n")
    assert cache()[1].startswith("no folder: name one in ASPERITY_CACHE\n")
