"""A run of the thesis: what is made again, in which order, and what the page says meanwhile."""

import functools
import json
import math
import os
import shutil
import sys
import tempfile
import time
from concurrent.futures import Executor, Future
from pathlib import Path

import pytest
from apparatus.grid import slow

from asperity.errors import InputError, StorageError
from asperity.kernels import closure
from asperity.runs import Interrupted, key, workers
from asperity.runs.workers import Task, done
from asperity.thesis import contents, exhibits
from asperity.thesis.contents import CLAIMS, FIGURES, TABLES, everything, select
from asperity.thesis.exhibits import Exhibit
from asperity.thesis.reproduce import run as reproduction
from asperity.thesis.reproduce.files import Collection, MadeExhibit, key_of
from asperity.thesis.reproduce.run import run
from asperity.thesis.said import Chapter

MODULE = """
import os, time
import numpy as np
from asperity.runs.workers import Task
from asperity.thesis import said
from asperity.thesis.exhibits import claim, figure, table
from asperity.results.dataset import described
from asperity.thesis.products import Finding, Grid

HERE = os.path.dirname(__file__)
words = said._read()
words["figure"]["9.1"] = {"title": "Figure", "caption": "F."}
words["table"] |= dict.fromkeys(("9.1", "9.2"), {"title": "Table", "caption": "T."})
words["claim"]["9.3"] = {"section": "9", "claim": "Text.", "thesis": "1"}

def note(name):
    with open(os.path.join(HERE, "made"), "a") as file:
        file.write(name + "\\n")

def draw(dataset):
    from matplotlib.figure import Figure
    return Figure()

@figure("9.1", draw, "figure 9.1")
def drawn(name, full=False):
    note(name + " in full" * full)
    return described(k=((), 1.0, "1", "k")), ["asperity slide table-4.3"]

@table("9.1")
def calculated():
    note("table 9.1")
    return Grid(("symbol", "value"), (("m_x1", 1.0 / 3.0), ("gone", "")), ("how",))

@table("9.2")
def harmed():
    if os.path.exists(os.path.join(HERE, "harm")):
        raise ZeroDivisionError("nothing to divide by")
    note("table 9.2")
    return Grid(("symbol",), (("q_1",),), ())

@claim("9.3")
def claimed():
    note("claim 9.3")
    return Finding.judged({"one": True}, "1", "Because.", {"ratio": 1.0}, ["asperity cases"])

class Shared:
    task = Task("shared", __import__("functools").partial(note, "shared"), "elsewhere")

def shared(full):
    return [Shared()]

class Finer:
    task = Task("finer", int, "elsewhere")

def finer(full):
    return [Finer()] if full else []
"""


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Some exhibits of a module of their own; returns a list of what has been made so far."""
    home = tmp_path / "module"
    home.mkdir()
    (home / "made_in_a_test.py").write_text(MODULE, "utf-8")
    monkeypatch.syspath_prepend(home)
    monkeypatch.delitem(sys.modules, "made_in_a_test", raising=False)
    import made_in_a_test as module

    name = module.__name__
    shelves = {
        "FIGURES": [Exhibit("figure", "9.1", name, parts=module.finer)],
        "TABLES": [
            Exhibit("table", number, name, parts=module.shared) for number in ("9.1", "9.2")
        ],
        "CLAIMS": [Exhibit("claim", "9.3", name)],
    }
    for shelf, own in shelves.items():
        monkeypatch.setattr(contents, shelf, {one.number: one for one in own})
    monkeypatch.setattr(contents, "CHAPTERS", (Chapter("9", "Chapter", "What it is."),))
    monkeypatch.setattr(key, "code_key", lambda module: "sources")

    def so_far():
        path = home / "made"
        return sorted(path.read_text("utf-8").splitlines()) if path.exists() else []

    so_far.home = home
    return so_far


ALL = ["claim 9.3", "figure 9.1", "table 9.1", "table 9.2"]


@pytest.mark.parametrize("processes", [1, slow(2)])
def test_a_run_makes_everything_once_and_the_next_finds_it(tmp_path, made, processes):
    lines = []
    first = run(tmp_path, processes=processes)
    assert [line for line in made() if line != "shared"] == ALL
    # What several need is made once, before them, where there are processes to share it among.
    assert made().count("shared") == processes - 1
    again = run(tmp_path, progress=lines.append)
    assert [line for line in made() if line != "shared"] == ALL
    assert sorted(lines) == [f"{name}: there already" for name in ALL]
    for one, other in zip(
        (*first.figures, *first.tables), (*again.figures, *again.tables), strict=True
    ):
        assert (one.reused, other.reused) == (False, True)
    assert again.figures[0].plain["how"] == ["asperity slide table-4.3"]
    assert again.tables[0].plain["rows"] == [["m_x1", 1.0 / 3.0], ["gone", ""]]
    assert [one.plain for one in again.claims] == [one.plain for one in first.claims]
    assert json.loads((tmp_path / "claims.json").read_text())["claims"][0]["id"] == "9.3"


@pytest.mark.parametrize("came", [(0, 1, 2, 3), (3, 1, 0, 2)])
def test_the_ledger_is_in_the_order_of_the_thesis_however_its_claims_came(tmp_path, came):
    names = ["claim 4.9", "claim 4.10", "claim 10.1", "claim A.2"]
    collection = Collection(tmp_path)
    for name in (names[place] for place in came):
        collection.add(MadeExhibit(name, "key", {"id": name}, {}, 0.0))
    claims = json.loads((tmp_path / "claims.json").read_text("utf-8"))["claims"]
    assert [one["id"] for one in claims] == names


def test_one_number_alone_is_made_and_the_rest_stays_on_the_page(tmp_path, made):
    run(tmp_path, ["9.3"])
    page = run(tmp_path, ["9.2"]).index.read_text("utf-8")
    assert made() == ["claim 9.3", "table 9.2"]
    assert 'id="claim-9.3"' in page
    assert 'id="table-9.2"' in page


def test_a_figure_in_full_serves_where_that_is_not_asked_for(tmp_path, made):
    run(tmp_path, ["9.1"], processes=1)
    run(tmp_path, ["9.1"], full=True)
    assert made() == ["figure 9.1", "figure 9.1 in full", "table 9.1"]
    run(tmp_path, ["9.1"])
    run(tmp_path, ["9.1"], full=True)
    assert len(made()) == 3


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["figure-9.1.png", "figure-9.1.nc", "table-9.1.csv", "table-9.1.json"]
)
def test_what_is_damaged_is_made_again(tmp_path, made, name):
    run(tmp_path, ["9.1"], processes=1)
    before = made()
    path = tmp_path / name
    path.write_bytes(path.read_bytes()[:-3])
    run(tmp_path, ["9.1"])
    assert len(made()) == len(before) + 1
    path.unlink()
    run(tmp_path, ["9.1"])
    assert len(made()) == len(before) + 2


def test_a_note_of_what_was_made_that_is_damaged_costs_only_the_making(tmp_path, made):
    run(tmp_path, ["9.3"])
    for harm in ("", "[1", '[{"name": 1}]'):
        (tmp_path / "made.json").write_text(harm)
        assert run(tmp_path, ["9.3"]).claims[0].plain["verdict"] == "reproduced"
    assert made() == ["claim 9.3"] * 4


def test_what_other_sources_make_is_made_again(tmp_path, made, monkeypatch):
    run(tmp_path, ["9.3"])
    monkeypatch.setattr(key, "code_key", lambda module: "other sources")
    assert run(tmp_path, ["9.2"]).claims == ()
    run(tmp_path, ["9.3"])
    assert made().count("claim 9.3") == 2


@pytest.mark.parametrize("processes", [1, slow(2)])
def test_what_fails_is_said_and_keeps_nothing_else_from_being_made(tmp_path, made, processes):
    (made.home / "harm").touch()
    lines = []
    result = run(tmp_path, progress=lines.append, processes=processes)
    assert result.failed == {"table 9.2": "ZeroDivisionError: nothing to divide by"}
    assert "table 9.2: failed: ZeroDivisionError: nothing to divide by" in lines
    assert "Not made: table 9.2. ZeroDivisionError" in result.index.read_text("utf-8")
    assert [one.number for one in result.tables] == ["9.1"]
    (made.home / "harm").unlink()
    assert not run(tmp_path).failed
    assert [line for line in made() if line != "shared"] == ALL


def test_an_interruption_keeps_what_was_made(tmp_path, made):
    def interrupt(line):
        raise KeyboardInterrupt

    with pytest.raises(
        Interrupted, match=r"interrupted: 1 of 4 are kept; the same command goes on"
    ):
        run(tmp_path, progress=interrupt, processes=1)
    assert made() == ["claim 9.3"]
    run(tmp_path, processes=1)
    assert made() == ALL


def test_the_page_is_there_before_anything_is_made_and_fills(tmp_path, made, monkeypatch):
    pages = []
    show = reproduction._Reproduction.show

    def shown(work, after=0.0):
        show(work)
        pages.append((work.index.read_text("utf-8"), made()))

    monkeypatch.setattr(reproduction._Reproduction, "show", shown)
    run(tmp_path, processes=1)
    first, nothing = pages[0]
    assert nothing == []
    assert "Still to come: claim 9.3, figure 9.1, table 9.1, table 9.2." in first
    to_come = [sum(name in page.partition("Still to come")[2] for name in ALL) for page, _ in pages]
    assert sorted(to_come, reverse=True) == to_come
    last, _ = pages[-1]
    assert "to come" not in last
    # While something is to come the page loads itself again, and no longer.
    assert 'http-equiv="refresh"' in first
    assert 'http-equiv="refresh"' not in last


def test_an_unknown_number_is_refused_with_the_nearest():
    with pytest.raises(InputError, match=r"'4\.177' is neither .*\(did you mean '4\.17'\?\)"):
        select(["4.177"])
    # Near to none: what there is, in a short line.
    with pytest.raises(InputError, match=r"'9' is .*: give one such as .* a chapter, 1 to 8$"):
        select(["9"])


def test_a_number_asks_for_all_that_have_it_in_the_order_of_the_page():
    assert [one.name for one in select(["4.17", "2.7"])] == [
        "claim 2.7", "figure 2.7", "figure 4.17",
    ]  # fmt: skip
    assert [one.name for one in select(["3.2"])] == ["claim 3.2", "figure 3.2", "table 3.2"]
    assert [one.name for one in select(["figure 7.10"])] == ["figure 7.10"]
    of_a_chapter = [one.number.partition(".")[0] for one in select(["3"])]
    assert set(of_a_chapter) == {"3"}
    assert [one for one in select([]) if one.number.startswith("3.")] == select(["3"])
    assert len(select([])) == len(CLAIMS) + len(FIGURES) + len(TABLES)


@pytest.mark.slow
def test_everything_has_a_function_that_makes_it_and_cases_that_ship():
    for exhibit in everything():
        assert callable(exhibit.maker.make), exhibit.name
        assert len(key_of(exhibit)) == 32
    marked = {name for name in exhibits._MAKERS if " 9." not in name}
    assert marked == {exhibit.name for exhibit in everything()}


@pytest.fixture
def follow_from(tmp_path, monkeypatch):
    """Chapters, and names, of what is made again after a change in a file of the package."""
    package = Path(closure.__file__).parents[1]
    copy = tmp_path / "asperity"
    shutil.copytree(package, copy, ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(closure, "_PACKAGE", copy)
    modules = {exhibit.module for exhibit in everything()}

    def keys():
        return {module: closure.source_key(module) for module in modules}

    def changed(file):
        before = keys()
        with (copy / file).open("a", encoding="utf-8") as source:
            source.write("# changed\n")
        after = keys()
        return {one.name for one in everything() if before[one.module] != after[one.module]}

    return changed


@pytest.mark.slow
def test_a_change_reaches_what_follows_from_it_and_nothing_else(follow_from):
    again = follow_from("rating/__init__.py")
    assert {"claim 7.1", "table 3.2"} <= again
    elsewhere = ("4.", "5.2", "5.5", "5.6", "5.7", "5.8", "5.9", "5.10", "5.11", "7.8", "7.9")
    found = {name for name in again if name.split()[1].startswith(elsewhere)}
    # A pressure of the rating, though chapter 7 states it.
    assert found <= {"claim 7.9"}
    again = follow_from("slider/batch.py")
    assert {"figure 4.17", "claim 4.6", "figure 5.5", "claim 5.1", "figure 7.8"} <= again
    assert not {"figure 2.11", "figure 7.11"} & again


def part(name, **options):
    return Task(name, functools.partial(str, name), name, **options)


class AtOnce(Executor):
    """In place of processes: what is begun has ended."""

    def submit(self, do, /, *given):
        ended = Future()
        ended.set_result(do(*given))
        return ended


def test_first_begins_what_calls_no_compiled_code_then_one_of_each_room_the_dearest_first():
    def order(*tasks):
        return [task.name for task, _ in workers._fed(AtOnce(), 1, tasks, lambda: None)]

    def of(name, room, seconds, *after):
        return Task(name, str, room, seconds, after)

    rooms = of("a1", "a", 3.0), of("a2", "a", 9.0), of("b", "b", 1.0), of("free", "", 0.5)
    assert order(*rooms) == ["free", "a2", "b", "a1"]
    waits = of("late", "l", 1.0, "small"), of("small", "s", 1.0), of("dear", "d", 9.0)
    assert order(*waits) == ["dear", "small", "late"]


@pytest.mark.slow
def test_the_dearest_begins_first_and_nothing_before_what_it_needs():
    tasks = [part("late", after=("small",)), part("small"), part("dear", seconds=9.0)]
    ended = [(task.name, future.result()) for task, future in done(tasks, 1)]
    assert ended == [("dear", "dear"), ("small", "small"), ("late", "late")]


def order_of(tasks, processes=1):
    return [task.name for task, _ in done(tasks, processes)]


@pytest.mark.slow
def test_what_calls_no_compiled_code_begins_first_then_one_of_each_room():
    def of(name, room, seconds):
        return Task(name, functools.partial(str, name), room, seconds)

    tasks = [of("a1", "a", 3.0), of("a2", "a", 9.0), of("b", "b", 1.0), of("free", "", 0.5)]
    assert order_of(tasks) == ["free", "a2", "b", "a1"]


@pytest.mark.slow
def test_tasks_without_compiled_code_do_not_wait_for_one_another():
    with tempfile.TemporaryDirectory() as folder:
        each = functools.partial(meet, folder)
        tasks = [Task(name, functools.partial(each, name), "") for name in ("one", "other")]
        assert all(future.result() for _, future in done(tasks, 2))


def meet(folder, name):
    """Whether two of a folder are there at the same time, within a minute."""
    Path(folder, name).touch()
    for _ in range(600):
        if len(os.listdir(folder)) == 2:
            return True
        time.sleep(0.1)
    return False


def test_what_ended_is_shown_while_nothing_else_does(tmp_path, made, monkeypatch):
    # The page is not written for each exhibit of many that end at once.
    page = []
    monkeypatch.setattr(reproduction, "_REFRESH", 0.0)
    monkeypatch.setattr(
        reproduction, "render", lambda shown, *rest: page.append(len(shown)) or "page"
    )

    def hesitant(tasks, processes, meanwhile):
        monkeypatch.setattr(reproduction, "_REFRESH", math.inf)
        for task in [task for task in tasks if task.name in ALL]:
            future = Future()
            future.set_result(task.do())
            yield task, future
        assert page == [0]
        monkeypatch.setattr(reproduction, "_REFRESH", 0.0)
        meanwhile()
        meanwhile()
        assert page == [0, len(ALL)]

    monkeypatch.setattr(reproduction, "done", hesitant)
    run(tmp_path, processes=2)
    assert made()


@pytest.mark.slow
def test_a_process_that_dies_is_told_in_one_line():
    dying = Task("dying", functools.partial(os._exit, 3), "room")
    with pytest.raises(StorageError, match="a process ended"):
        list(done([dying, part("other")], 1))


@pytest.mark.slow
def test_linear_algebra_in_the_processes_has_one_thread(monkeypatch):
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    asked = Task("asked", functools.partial(os.getenv, "OMP_NUM_THREADS"), "room")
    ((_, future),) = done([asked], 1)
    assert future.result() == "1"
    assert "OMP_NUM_THREADS" not in os.environ
    assert workers.cores() >= 1
