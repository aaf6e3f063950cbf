"""Settings shared by all tests."""

import gc
import math
import os
import re
import shutil
import signal
from collections import defaultdict
from collections.abc import Generator
from pathlib import Path
from zlib import crc32

import hypothesis
import numpy as np
import pytest
import warm

from asperity.kernels import compiled

# Workers have the cores among themselves; threads of linear algebra on top of them wait for each
# other. Without workers too: an active set follows the last digits of a sum, and with it recorded
# answers. Read by the libraries when they are first imported, here or by a program that a test
# starts.
for _library in ("OMP", "OPENBLAS", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

# Tests and the libraries they load are millions of objects that stay to the end: looking through
# them takes a tenth of the time. What is not theirs is still found, less often.
gc.set_threshold(50_000, 20, 20)

# pytest asks for these whatever a file of tests has imported, and a kernel would ask Numba.
compiled._Lazy._mock_name = None
compiled._Lazy.pytestmark = ()

# What is started in the background of a script, or by nohup, ignores these signals, and so would
# all that it starts; tests send them.
for _name, _default in {
    "SIGINT": signal.default_int_handler,
    "SIGQUIT": signal.SIG_DFL,
    "SIGHUP": signal.SIG_DFL,
}.items():
    _number = getattr(signal, _name, None)
    if _number is not None and signal.getsignal(_number) == signal.SIG_IGN:
        signal.signal(_number, _default)

# Without a deadline, because the first example may load a unit registry or compile a kernel; the
# same examples every time, so that a failure is about the change at hand. Others are tried with
# ``--hypothesis-profile thorough``.
_ALWAYS = {"deadline": None, "database": None}
hypothesis.settings.register_profile("asperity", **_ALWAYS, max_examples=40, derandomize=True)
hypothesis.settings.register_profile("thorough", **_ALWAYS, max_examples=1000)
hypothesis.settings.load_profile("asperity")

# Programs of others that some tests compare with: name of the program, files of tests.
_NEEDS = {
    "gfortran": [
        "literature/test_fric_subroutine.py",
        "literature/test_appendix_e_subroutine.py",
    ],
    "ccx": ["literature/test_calculix.py"],
}
_absent = [program for program in _NEEDS if shutil.which(program) is None]
collect_ignore = [name for program in _absent for name in _NEEDS[program]]


def _part(given: str) -> tuple[int, int]:
    which, of = map(int, given.split("/"))
    if not 0 <= which < of:
        raise ValueError(f"{given}: 0/{of} to {of - 1}/{of} are parts")
    return which, of


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--share",
        type=float,
        default=1.0,
        metavar="SHARE",
        help="of each campaign (a statement tried on thousands of inputs, in parts) run this share",
    )
    parser.addoption(
        "--part",
        type=_part,
        default=(0, 1),
        metavar="WHICH/OF",
        help="of what is no campaign run one part, as 0/2 and 1/2, which are all of it together",
    )


def pytest_collection_finish() -> None:
    gc.freeze()


_ALL_SLOW = re.compile(r"^pytestmark = (\[\n\s*)?pytest\.mark\.slow\b", re.MULTILINE)

# A slow test stands in a file or a folder that says so, has a grid of cases or a few ordinary ones.
_NAMES_SLOW = re.compile(r"\b(slow|grid|ordinary)\b")


def _may_be_slow(path: Path) -> bool:
    files = (path, path.with_name("conftest.py"))
    return any(_NAMES_SLOW.search(file.read_text("utf-8")) for file in files if file.exists())


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    # Of some files nothing is asked for: collecting them takes each worker as long as a dear test.
    asked = config.option.markexpr
    if asked not in ("slow", "not slow") or not collection_path.match("test_*.py"):
        return None
    if asked == "slow":
        return None if _may_be_slow(collection_path) else True
    return True if _ALL_SLOW.search(collection_path.read_text("utf-8")) else None


@pytest.hookimpl(tryfirst=True)
def pytest_pycollect_makeitem(collector: pytest.Collector, obj: object) -> list[pytest.Item] | None:
    # A third of all parameters are those of slow tests: no worker counts them where none is asked.
    config = collector.config
    if config.option.markexpr != "not slow" or not hasattr(config, "workerinput"):
        return None
    marks = getattr(obj, "pytestmark", ())
    is_slow = isinstance(marks, list) and any(mark.name == "slow" for mark in marks)
    return [] if is_slow else None


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_collection_modifyitems(
    config: pytest.Config, items: list[pytest.Item]
) -> Generator[None]:
    _leave_few_ordinary(items)
    for path in {item.path for item in items if item.get_closest_marker("slow")}:
        if not _may_be_slow(path):
            raise pytest.UsageError(f"{path}: has slow tests, and no word of what makes them slow")
    yield
    # When ordinary tests are deselected: `apparatus.grid` leaves parts of campaigns to them.
    # Parts of a campaign differ in the parameter it is over, or in any if it names none. Of each
    # campaign one part is run at least, but where another test tries the statement on less.
    share, (which, of) = config.getoption("share"), config.getoption("part")
    left_out = {
        item
        for item in items
        if not item.get_closest_marker("campaign") and crc32(item.nodeid.encode()) % of != which
    }
    if share < 1.0:
        left_out |= _outside_the_share(items, share)
    if left_out:
        config.hook.pytest_deselected(items=[item for item in items if item in left_out])
        items[:] = [item for item in items if item not in left_out]


def _leave_few_ordinary(items: list[pytest.Item]) -> None:
    """Mark as slow what a test that says how many parameters are ordinary has more than those."""
    alike = defaultdict(list)
    for item in items:
        if item.get_closest_marker("ordinary") and not item.get_closest_marker("slow"):
            alike[item.nodeid.partition("[")[0]].append(item)
    for parts in alike.values():
        (count,) = parts[0].get_closest_marker("ordinary").args
        kept = {math.floor(n * len(parts) / count) for n in range(count)}
        for n, item in enumerate(parts):
            if n not in kept:
                item.add_marker("slow")


def _outside_the_share(items: list[pytest.Item], share: float) -> set[pytest.Item]:
    """Return the parts of campaigns that are left to a run of all of them."""
    left_out, campaigns = set(), defaultdict(list)
    for item in items:
        if mark := item.get_closest_marker("campaign"):
            over, tried_by = map(mark.kwargs.get, ("over", "tried_by"))
            if tried_by and not hasattr(item.module, tried_by):
                raise pytest.UsageError(f"{item.nodeid}: no {tried_by} is in its module")
            given = item.callspec.params if hasattr(item, "callspec") else {}
            apart = [one for one in given.items() if over and one[0] != over]
            campaign = item.nodeid.partition("[")[0], repr(sorted(apart)), not tried_by
            campaigns[campaign].append(item)
    for (*_, least), parts in campaigns.items():
        count = max(least, round(share * len(parts)))
        left_out |= set(parts) - {parts[math.floor(n * len(parts) / count)] for n in range(count)}
    return left_out


@pytest.fixture
def plain_kernels(
    request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> Generator[None]:
    """Let kernels that are not in the list be plain Python: few calls take less than compiling.

    In slow tests, which call them many times, they are compiled. What Python refuses is infinite to
    NumPy's numbers as to a kernel: an exponent below zero, of nothing, is given as `np.float64`.
    """
    if request.node.get_closest_marker("slow"):
        yield
        return
    from mutants import plain

    monkeypatch.setattr(compiled._Lazy, "_dispatcher", property(plain.plainly))
    # What an earlier test had compiled would compile for other types, and cannot call these.
    never = property(lambda _: None, lambda self, made: vars(self).update(_compiled=made))
    monkeypatch.setattr(compiled._Lazy, "_compiled", never, raising=False)
    for name, make in plain.makers().items():
        monkeypatch.setattr(np, name, make)
    with np.errstate(divide="ignore"):
        yield


def pytest_report_header() -> list[str]:
    return [f"{program} is not installed: left out {_NEEDS[program]}" for program in _absent]


# Ordinary tests of the page that is served: one server and its worker do for all of them.
_SERVED = re.compile(r"tests/acceptance/test_(hardening|web_(answers|guard|jobs))\.py::")


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object | None:
    if config.getvalue("dist") != "loadfile" or config.option.markexpr != "not slow":
        return None
    from xdist.scheduler import LoadFileScheduling

    class ByFileAndServer(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return "page" if _SERVED.match(nodeid) else super()._split_scope(nodeid)

    return ByFileAndServer(config, log)


def pytest_sessionstart(session: pytest.Session) -> None:
    # Before the workers start, each of which would compile the same kernels at the same time.
    workers = getattr(session.config.option, "numprocesses", None)
    if workers and not session.config.option.collectonly:
        warm.compile_kernels(slow=session.config.option.markexpr != "not slow")
