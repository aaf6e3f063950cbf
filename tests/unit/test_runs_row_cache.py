"""Rows kept on disk."""

import errno
import os
import sqlite3

import pytest

from asperity.runs import row_cache
from asperity.runs.row_cache import Rows

KEYS = ["00" * 16, "01" * 16]


@pytest.fixture
def told():
    return []


@pytest.fixture
def open_cache(tmp_path, told):
    caches = []

    def open_(name="results.sqlite"):
        caches.append(Rows(tmp_path / name, told.append))
        return caches[-1]

    yield open_
    for cache in caches:
        cache.close()


def keys(count):
    return [f"{n:032x}" for n in range(count)]


def test_what_was_put_is_found_by_another_who_opens_the_file(open_cache, told):
    rows = {key: {"ratio": 0.1 * n, "breakaway_time": None} for n, key in enumerate(keys(1200))}
    open_cache().put(rows)
    assert open_cache().get([*rows, "unknown"]) == rows
    assert told == []


def test_two_sweeps_at_once_do_not_hinder_each_other(open_cache, told):
    one, other = open_cache(), open_cache()
    for n, key in enumerate(keys(100)):
        (one if n % 2 else other).put({key: {"ratio": float(n)}})
    assert len(one.get(keys(100))) == len(other.get(keys(100))) == 100
    assert told == []


@pytest.mark.parametrize("content", [b"no database" * 500, b"SQLite format 3\0" + b"\xaa" * 9000])
def test_a_damaged_file_is_moved_aside_and_replaced(open_cache, told, tmp_path, content):
    (tmp_path / "results.sqlite").write_bytes(content)
    cache = open_cache()
    cache.put({KEYS[0]: {"ratio": 0.5}})
    assert cache.get(KEYS[:2]) == {KEYS[0]: {"ratio": 0.5}}
    assert (tmp_path / "results.sqlite.damaged").read_bytes() == content
    (line,) = told
    assert "is damaged; set aside as results.sqlite.damaged and started again" in line


def test_a_damaged_file_that_cannot_be_replaced_is_told_why_in_words(
    open_cache, told, tmp_path, monkeypatch
):
    def refused(path):
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM), str(path))

    monkeypatch.setattr(row_cache, "set_aside", refused)
    (tmp_path / "results.sqlite").write_bytes(b"no database" * 500)
    open_cache().put({KEYS[0]: {"ratio": 0.5}})
    (line,) = told
    assert line.endswith("cannot be replaced (operation not permitted) and is not used")


def test_a_file_damaged_behind_its_head_costs_no_more_than_its_rows(open_cache, told, tmp_path):
    rows = {key: {"ratio": 1.0} for key in keys(500)}
    cache = open_cache()
    cache.put(rows)
    cache.close()
    path = tmp_path / "results.sqlite"
    content = bytearray(path.read_bytes())
    content[4096:] = bytes(byte ^ 0x5A for byte in content[4096:])
    path.write_bytes(content)
    cache = open_cache()
    assert cache.get(list(rows)) == {}
    cache.put(rows)
    assert cache.get(list(rows)) == rows
    assert len(told) == 1


def test_a_damaged_row_counts_as_missing(open_cache, told, tmp_path):
    cache = open_cache()
    cache.put({key: {"ratio": 0.25} for key in keys(3)})
    with sqlite3.connect(tmp_path / "results.sqlite") as database:
        first, second, _ = keys(3)
        database.execute("UPDATE results SET value = ? WHERE key = ?", (b'{"ratio": 0.75}', first))
        database.execute("UPDATE results SET value = 7 WHERE key = ?", (second,))
    database.close()
    assert list(cache.get(keys(3))) == keys(3)[2:]
    assert told == []


def test_a_file_that_cannot_be_opened_is_told_once_and_done_without(open_cache, told, tmp_path):
    (tmp_path / "folder.sqlite").mkdir()
    cache = open_cache("folder.sqlite")
    cache.put({KEYS[0]: {"ratio": 0.5}})
    assert cache.get(KEYS[:1]) == {}
    assert not cache.usable
    (line,) = told
    assert "no longer kept" in line


def test_a_full_disk_costs_the_cache_and_not_the_sweep(open_cache, told, tmp_path):
    cache = open_cache()
    cache.put({KEYS[0]: {"ratio": 0.5}})
    cache._database.execute("PRAGMA max_page_count = 3")
    cache.put({key: {"text": "long" * 1000} for key in keys(100)})
    assert not cache.usable
    assert told == [
        f"{tmp_path / 'results.sqlite'}: database or disk is full; results are no longer kept in "
        "this cache"
    ]


def test_rows_older_than_a_month_are_forgotten(open_cache, tmp_path):
    cache = open_cache()
    cache.put({KEYS[0]: {"ratio": 0.5}, KEYS[1]: {"ratio": 0.6}})
    cache.close()
    with sqlite3.connect(tmp_path / "results.sqlite") as database:
        database.execute("UPDATE results SET day = day - 31 WHERE key = ?", (KEYS[0],))
    database.close()
    assert list(open_cache().get(KEYS[:2])) == [KEYS[1]]


def test_without_a_writable_cache_folder_there_is_no_cache(monkeypatch, tmp_path, told):
    (tmp_path / "file").touch()
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "file"))
    assert Rows.of_this_user("sweep", told.append) is None
    (line,) = told
    assert "not kept" in line


def test_what_is_asked_for_now_and_then_is_kept(open_cache, told, monkeypatch):
    today = row_cache._today()
    open_cache().put({KEYS[0]: {"ratio": 0.5}, KEYS[1]: {"ratio": 0.6}})
    monkeypatch.setattr(row_cache, "_today", lambda: today + row_cache.KEPT_DAYS - 1)
    assert open_cache().get(KEYS[:1]) == {KEYS[0]: {"ratio": 0.5}}
    monkeypatch.setattr(row_cache, "_today", lambda: today + row_cache.KEPT_DAYS + 1)
    assert open_cache().get(KEYS) == {KEYS[0]: {"ratio": 0.5}}
    assert told == []
