"""Entries that other processes make: what is waited for, by whom, and what is not kept."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import threading
import time
import types
from pathlib import Path

import pytest

from asperity.flanks.sides import both
from asperity.kernels.building import lean, link, making
from asperity.kernels.native import kept, keys, table
from asperity.kernels.native import makers as native_makers
from asperity.kernels.native.entries import Entry, listed, shared_out


class Doubled:
    """A library of one kernel of a number."""

    def entry(self, name):
        return lambda arguments: 2.0 * arguments[0]


@pytest.fixture
def entry():
    (found,) = listed().named("asperity.slider.pressed.friction_limit")
    return found


@pytest.fixture
def of_a_number():
    return kept.Kept([Entry(0, "asperity.errors.doubled", [["d"]], 1.0)])


def test_threads_that_wait_for_an_entry_all_get_it(of_a_number, monkeypatch):
    asked = []

    def obtained(entry):
        asked.append(entry)
        time.sleep(0.05)
        return Doubled()

    monkeypatch.setattr(kept, "_obtained", obtained)
    call, answers = of_a_number.entry("doubled"), []
    threads = [threading.Thread(target=lambda: answers.append(call((3.0,)))) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [6.0] * 4
    assert len(asked) == 1


def test_who_interrupts_the_wait_may_call_once_more(of_a_number, monkeypatch):
    def interrupted(entry):
        raise KeyboardInterrupt

    call = of_a_number.entry("doubled")
    monkeypatch.setattr(kept, "_obtained", interrupted)
    with pytest.raises(KeyboardInterrupt):
        call((3.0,))
    monkeypatch.setattr(kept, "_obtained", lambda entry: Doubled())
    assert call((3.0,)) == 6.0


def test_an_entry_is_made_where_it_is_kept_or_loaded(of_a_number, tmp_path, monkeypatch):
    monkeypatch.setattr(kept.keys, "key", lambda entry: "key")
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: tmp_path)
    assert not of_a_number.is_made((3.0,))
    # Of other types, or of none that a list holds, nothing is made in advance.
    assert of_a_number.is_made((3,))
    assert of_a_number.is_made(("text",))
    (tmp_path / "key").mkdir()
    assert of_a_number.is_made((3.0,))
    monkeypatch.setattr(kept, "_obtained", lambda entry: Doubled())
    assert of_a_number.entry("doubled")((3.0,)) == 6.0
    (tmp_path / "key").rmdir()
    assert of_a_number.is_made((3.0,))


def test_where_nothing_can_be_kept_nothing_is_waited_for(of_a_number, monkeypatch):
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: None)
    assert of_a_number.is_made((3.0,))


def test_what_cannot_be_obtained_is_asked_for_once(of_a_number, monkeypatch):
    asked = []
    monkeypatch.setattr(kept, "_obtained", asked.append)
    call = of_a_number.entry("doubled")
    assert [call((3.0,)), call((3.0,))] == [NotImplemented] * 2
    assert len(asked) == 1


@pytest.mark.parametrize("trouble", [OSError, ValueError])
def test_where_no_process_begins_nobody_waits(entry, trouble, tmp_path, monkeypatch):
    def begun(kernels):
        raise trouble

    monkeypatch.setattr(kept, "_begun", begun)
    kept._Makers(tmp_path).make([entry])


DIES = """
import os
key = input().split()[0]
print(key, flush=True)
os.kill(os.getpid(), 9)
"""
MAKES = """
import pathlib, sys
for line in sys.stdin:
    for key in line.split():
        print(key, flush=True)
        (pathlib.Path(sys.argv[1]) / key).mkdir(exist_ok=True)
        print(flush=True)
"""
LEAVES = "import sys; input(); sys.exit(1)"


@pytest.fixture
def begun(tmp_path, monkeypatch):
    """Programs of the processes that begin, in turn; which have begun."""
    programs, begun, processes = [], [], []

    def begin(kernels):
        program = programs[min(len(begun), len(programs) - 1)]
        begun.append(program)
        process = subprocess.Popen(
            [sys.executable, "-S", "-c", program, str(tmp_path)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        processes.append(process.pid)
        return process

    monkeypatch.setattr(kept, "_begun", begin)
    monkeypatch.setattr(kept, "likely", lambda asked, words: [])
    yield programs, begun
    for process in processes:
        # But for those whose end was seen.
        with contextlib.suppress(ChildProcessError):
            os.waitid(os.P_PID, process, os.WEXITED | os.WNOHANG | os.WNOWAIT)
            os.kill(process, signal.SIGKILL)
            os.waitpid(process, 0)


@pytest.mark.parametrize("cores", [1, 2])
def test_an_entry_that_a_process_dies_of_is_left_and_the_others_are_made(
    cores, begun, tmp_path, monkeypatch
):
    programs, started = begun
    programs += [DIES, MAKES]
    monkeypatch.setattr(kept, "most_makers", lambda: cores)
    first, second = listed().entries[:2]
    makers = kept._Makers(tmp_path)
    makers.make([first])
    makers.make([second])
    # Nobody waits for it again.
    makers.make([first])
    makers.leave()
    assert not (tmp_path / keys.key(first)).exists()
    assert (tmp_path / keys.key(second)).exists()
    assert started == [DIES, MAKES]


def test_processes_that_die_of_everything_are_not_begun_for_ever(begun, tmp_path, monkeypatch):
    programs, started = begun
    programs += [DIES]
    monkeypatch.setattr(kept, "most_makers", lambda: 2)
    makers = kept._Makers(tmp_path)
    makers.make(listed().entries[:20])
    makers.leave()
    assert len(started) < 6


SAYS = """
import sys
key = input().split()[0]
print(key, "! the disk is full", "! of process 1", "! of process 2", sep="\\n", flush=True)
sys.exit({code})
"""


def test_where_nothing_can_be_kept_nobody_waits_and_it_is_told(
    begun, tmp_path, monkeypatch, caplog
):
    programs, started = begun
    programs += [SAYS.format(code=native_makers.UNWRITABLE)]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    monkeypatch.setattr(kept.kernel_folder, "_TOLD", set())
    makers = kept._Makers(tmp_path)
    makers.make(listed().entries[:2])
    makers.make(listed().entries[2:4])
    assert len(started) == 1
    # What differs in a number is told once.
    assert caplog.messages == ["the disk is full", "of process 1"]


def ends(makers, entries):
    """Return whether a wait for entries comes to an end; then the processes are left."""
    waits = threading.Thread(target=makers.make, args=(entries,), daemon=True)
    waits.start()
    waits.join(20.0)
    is_over = not waits.is_alive()
    makers._lost |= {keys.key(entry) for entry in entries}
    makers.leave()
    return is_over


def test_where_nothing_can_be_kept_the_others_are_left_too(begun, tmp_path, monkeypatch):
    programs, _ = begun
    programs += [SAYS.format(code=native_makers.UNWRITABLE), "import sys; sys.stdin.read()"]
    monkeypatch.setattr(kept, "most_makers", lambda: 2)
    makers = kept._Makers(tmp_path)
    assert ends(makers, listed().entries[:2])


def test_what_a_process_says_is_not_what_it_is_at(begun, tmp_path, monkeypatch):
    programs, started = begun
    programs += [SAYS.format(code=1), MAKES]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    makers = kept._Makers(tmp_path)
    first, second = listed().entries[:2]
    makers.make([first])
    makers.make([second])
    makers.leave()
    assert makers._lost == {keys.key(first)}
    assert started == [SAYS.format(code=1), MAKES]


HINDERED = """
import sys
for line in sys.stdin:
    for key in line.split():
        print(key, "- " + key, "", sep="\\n", flush=True)
"""


def test_what_a_process_leaves_is_not_waited_for_and_costs_no_process(
    begun, tmp_path, monkeypatch, caplog
):
    programs, started = begun
    programs += [HINDERED]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    monkeypatch.setattr(kept, "_REMIND", 0.01)
    makers = kept._Makers(tmp_path)
    makers.make(listed().entries[:5])
    makers.leave()
    assert makers._lost == {keys.key(entry) for entry in listed().entries[:5]}
    assert started == [HINDERED]
    assert not caplog.messages


def test_a_source_that_cannot_be_read_hinders_no_other_entry(entry, begun, tmp_path, monkeypatch):
    programs, _ = begun
    programs += [MAKES]
    other = next(each for each in listed().entries if each.module != entry.module)

    def key(each):
        if each is other:
            raise PermissionError(13, "Permission denied", "kernels.py")
        return f"{each.number:032}"

    monkeypatch.setattr(kept.keys, "key", key)
    monkeypatch.setattr(kept, "likely", lambda asked, words: [other])
    makers = kept._Makers(tmp_path)
    makers.make([entry])
    makers.leave()
    assert (tmp_path / key(entry)).exists()


STOPS = """
import os, signal
print(input().split()[0], flush=True)
os.kill(os.getpid(), signal.SIGSTOP)
"""


def test_a_process_that_is_stopped_is_not_waited_for(begun, tmp_path, monkeypatch, caplog):
    programs, started = begun
    programs += [STOPS, MAKES]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    monkeypatch.setattr(kept, "_REMIND", 0.01)
    monkeypatch.setattr(kept.kernel_folder, "_TOLD", set())
    makers = kept._Makers(tmp_path)
    first = listed().entries[0]
    thread = threading.Thread(target=makers.make, args=([first],), daemon=True)
    thread.start()
    thread.join(60.0)
    makers.leave()
    (told,) = caplog.messages
    assert re.match("process ([0-9]+) is at kernels", told)
    assert (tmp_path / keys.key(first)).exists()
    assert started == [STOPS, MAKES]


def test_processes_that_are_all_stopped_are_not_begun_for_ever(begun, tmp_path, monkeypatch):
    programs, started = begun
    programs += [STOPS]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    monkeypatch.setattr(kept, "_REMIND", 0.01)
    monkeypatch.setattr(kept, "_LOOKS", 1)
    makers = kept._Makers(tmp_path)
    assert ends(makers, listed().entries[:1])
    assert len(started) == 2


def test_another_process_begins_as_soon_as_one_is_not_waited_for(begun, tmp_path, monkeypatch):
    """However long after the last reminder: who waits would have none."""
    programs, started = begun
    programs += [STOPS, MAKES]
    now = [0.0]

    def sleep(seconds):
        time.sleep(0.001)
        now[0] += seconds

    clock = types.SimpleNamespace(monotonic=lambda: now[0], sleep=sleep)
    monkeypatch.setattr(kept, "time", clock)
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    monkeypatch.setattr(kept, "_LOOKS", 1)
    makers = kept._Makers(tmp_path)
    now[0] += 0.5 * kept._REMIND
    first = listed().entries[0]
    makers.make([first])
    makers.leave()
    assert (tmp_path / keys.key(first)).exists()
    assert started == [STOPS, MAKES]


def test_a_process_that_is_stopped_for_a_moment_is_waited_for():
    process = subprocess.Popen(
        [sys.executable, "-S", "-c", "input()"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    maker = kept._Maker(process, set())
    try:
        for _ in range(2):
            process.send_signal(signal.SIGSTOP)
            while os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT) is None:
                pass
            looks = [maker.is_stopped() for _ in range(kept._LOOKS)]
            assert looks == [False] * (kept._LOOKS - 1) + [True]
            # More than a pipe holds.
            asks = threading.Thread(target=maker.ask, args=("0" * 200_000,), daemon=True)
            asks.start()
            asks.join(20.0)
            assert not asks.is_alive()
            process.send_signal(signal.SIGCONT)
            os.waitid(os.P_PID, process.pid, os.WCONTINUED | os.WNOWAIT)
            assert not maker.is_stopped()
    finally:
        process.kill()
        process.communicate()


def test_a_process_that_knows_no_such_entry_is_not_begun_again(begun, tmp_path, monkeypatch):
    programs, started = begun
    programs += [LEAVES]
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    makers = kept._Makers(tmp_path)
    makers.make(listed().entries[:2])
    makers.make(listed().entries[2:4])
    makers.leave()
    assert started == [LEAVES]


def test_what_is_waited_for_is_asked_for_first(entry, tmp_path, monkeypatch):
    told = []

    class Told:
        def ask(self, line):
            told.append(line.split())
            (tmp_path / keys.key(entry)).mkdir()

        def ended(self):
            return None

    others = [each for each in listed().entries[:3] if each is not entry]
    monkeypatch.setattr(kept, "likely", lambda asked, words: others)
    monkeypatch.setattr(kept, "most_makers", lambda: 0)
    makers = kept._Makers(tmp_path)
    makers._running, makers._deaths = [Told()], 1
    makers.make([entry])
    assert told == [[keys.key(each) for each in (entry, *others)]]


def test_a_flank_that_nobody_waits_for_does_not_wait_for_its_kernels(
    entry, begun, tmp_path, monkeypatch
):
    """Ctrl-C in one flank left the other until its kernel was compiled, up to 16 s."""
    programs, started = begun
    programs.append("import time; time.sleep(30)")
    monkeypatch.setattr(kept, "most_makers", lambda: 1)
    makers, asked = kept._Makers(tmp_path), threading.Event()

    def flank(side):
        if side == 1:
            assert asked.wait(60.0)
            raise KeyboardInterrupt
        threading.Timer(0.05, asked.set).start()
        makers.make([entry])

    with pytest.raises(KeyboardInterrupt):
        both(flank)
    makers.leave()
    assert started
    assert not makers._waited_for


@pytest.mark.parametrize("begin", [False, True])
def test_one_process_goes_on_to_what_is_called_next_and_the_others_to_the_dearest(
    begin, entry, tmp_path
):
    others = [each for each in listed().entries if each is not entry][:9]
    makers = kept._Makers(tmp_path)
    makers._waited_for = [entry]
    orders = makers._orders({keys.key(each): each for each in (entry, *others)}, 3, begin)
    dearest = sorted(others, key=lambda each: -each.seconds)
    # Later all of them are at something, and whoever is ready first takes what is waited for.
    first = [entry] if not begin else []
    assert orders[0] == [keys.key(each) for each in (entry, *others)]
    for order in orders[1:]:
        assert order[: len(first) + 1] == [keys.key(each) for each in (*first, dearest[0])]
        assert sorted(order) == sorted(orders[0])
    assert others != dearest


@pytest.mark.ordinary(3)
@pytest.mark.parametrize("processes", [1, 2, 3, 20])
def test_of_all_each_process_makes_whole_rooms_first_and_helps_with_the_others(
    processes, tmp_path, monkeypatch
):
    told = {}

    class Told:
        def ask(self, line):
            told[self] = line.split()
            if len(told) == processes:
                for key in told[self]:
                    (tmp_path / key).mkdir()

        def ended(self):
            return None

    all_of_them = sorted(listed().entries, key=lambda each: -each.seconds)
    monkeypatch.setattr(kept, "likely", lambda asked, words: [])
    monkeypatch.setattr(kept, "most_makers", lambda: 0)
    makers = kept._Makers(tmp_path)
    makers._running, makers._deaths = [Told() for _ in range(processes)], 1
    makers.make(all_of_them)
    shares = shared_out(all_of_them, processes)
    rooms = [{".".join(each.module.split(".")[:2]) for each in share} for share in shares]
    assert sum(map(len, rooms)) == len(set().union(*rooms)) > 5
    assert sum(map(len, shares)) == len(all_of_them)
    for share, order in zip(shares, told.values(), strict=True):
        assert sorted(order) == sorted(map(keys.key, all_of_them))
        assert order[: len(share)] == [keys.key(each) for each in share]
    # About equal, or as unequal as one room that is dearer makes them.
    seconds = sorted(sum(each.seconds for each in share) for share in shares)
    dearest = max(sum(e.seconds for e in all_of_them if f"{room}." in e.name) for room in rooms[0])
    assert seconds[-1] <= max(1.5 * sum(seconds) / processes, dearest)


def test_as_many_processes_make_as_there_is_room_for(monkeypatch):
    def of(cores, pages):
        monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(cores)))
        sizes = {"SC_PAGE_SIZE": 4096, "SC_PHYS_PAGES": pages}
        monkeypatch.setattr(os, "sysconf", sizes.__getitem__)
        return kept.most_makers()

    gigabyte = 1 << 18
    assert [of(2, 64 * gigabyte), of(64, 64 * gigabyte), of(8, 3 * gigabyte)] == [2, 8, 3]
    assert of(4, gigabyte // 2) == 1


def test_processes_that_make_are_no_freer_than_this_one(tmp_path, monkeypatch):
    begun = {}

    def popen(command, *, env, **_others):
        begun.update(command=command, env=env)

    monkeypatch.setenv("NUMBA_OPT", "0")
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    monkeypatch.setattr(subprocess, "Popen", popen)
    kept._begun(tmp_path)
    assert begun["command"][1] == ("-I" if sys.flags.isolated else "-P")
    assert begun["env"]["ASPERITY_CACHE"] == str(tmp_path)
    # What it makes is kept for runs without the variable.
    assert not any(name.startswith("NUMBA_") for name in begun["env"])


def test_an_entry_of_other_sources_is_not_made(entry, tmp_path):
    with pytest.raises(making.ChangedError):
        making.keep(tmp_path, entry, "0" * 32, 1)
    assert not list(tmp_path.iterdir())


def test_sources_that_changed_while_it_was_made_leave_nothing(entry, tmp_path, monkeypatch):
    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(making, "_support", lambda: b"")
    monkeypatch.setattr(lean, "make", lambda *_given: lean.Made(b"code", ["d"], (1, 2)))
    monkeypatch.setattr(link, "linked", lambda *_given: b"linked")
    key = keys.key(entry)
    monkeypatch.setattr(keys, "stands", lambda module: False)
    with pytest.raises(making.ChangedError):
        making.keep(tmp_path, entry, key, 1)
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]
    monkeypatch.undo()
    assert keys.stands(entry.module)


@pytest.fixture
def quickly_made(monkeypatch):
    """Entries cost nothing here."""
    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(making, "_support", lambda: b"")
    monkeypatch.setattr(lean, "make", lambda *_given: lean.Made(b"code", ["d"], (1, 2)))
    monkeypatch.setattr(link, "linked", lambda *_given: b"linked")


def test_what_another_has_made_meanwhile_stands(entry, tmp_path, quickly_made, monkeypatch):
    """As while this process was stopped."""
    folder = tmp_path / keys.key(entry)

    def make(*_given):
        folder.mkdir()
        link.keep(folder, entry, lean.Made(b"theirs", ["d"], (1, 2)), b"")
        return lean.Made(b"ours", ["d"], (1, 2))

    monkeypatch.setattr(lean, "make", make)
    assert making.keep(tmp_path, entry, folder.name, 1)
    assert link.kept(folder, entry).code == b"theirs"
    assert [path for path in tmp_path.iterdir() if path.is_dir()] == [folder]


def test_what_cannot_be_put_in_its_place_is_trouble(entry, tmp_path, quickly_made, monkeypatch):
    """Said to be made, it would be asked for again, for ever."""

    def rename(path, other):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "rename", rename)
    with pytest.raises(OSError, match="No space"):
        making.keep(tmp_path, entry, keys.key(entry), 1)
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]


WORKER = """
import logging, sys
from asperity.kernels.native import keys
from asperity.kernels.native.entries import listed
from asperity.kernels.building import making, worker
def keep(*given):
    {does}
making.keep = keep
sys.argv = ["worker", ".", "1"]
wanted = iter([keys.key(listed().entries[0])])
class Wanted:
    def listen(self): pass
    def next(self): return next(wanted, None)
worker._Wanted = Wanted
worker.main()
"""
HINDERS = "raise PermissionError(13, 'Permission denied', '/usr/bin/cc')"
FULL = "raise OSError(28, 'No space left on device')"
TALKS = "[logging.getLogger('asperity').warning('%d is so', n) for n in range(20_000)]"


@pytest.mark.slow
def test_a_process_that_can_keep_nothing_tells_it(tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", WORKER.format(does=FULL)],
        env=os.environ | {"ASPERITY_CACHE": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    key, told = done.stdout.splitlines()
    assert (done.returncode, key) == (native_makers.UNWRITABLE, keys.key(listed().entries[0]))
    where = tmp_path / "asperity"
    assert told.startswith(f"! the cache folder {where} cannot be written to (no space left on dev")


@pytest.mark.slow
def test_trouble_that_is_not_the_folders_is_not_told_as_such():
    done = subprocess.run(
        [sys.executable, "-c", WORKER.format(does=HINDERS)],
        capture_output=True,
        text=True,
        check=False,
    )
    key = keys.key(listed().entries[0])
    assert (done.returncode, done.stdout.splitlines()) == (0, [key, f"- {key}", ""])


@pytest.mark.slow
def test_a_process_whom_nobody_listens_to_goes_on():
    """Who asked may be computing; what is told fills the pipe."""
    process = subprocess.Popen(
        [sys.executable, "-c", WORKER.format(does=TALKS)], stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.wait(60.0) == 0
        assert process.stdout.read().count(" is so\n") > 1000
    finally:
        process.kill()
        process.communicate()


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "arguments"),
    [("friction_limit", [["d"]]), ("gone", [["d"], ["d"]]), ("friction_limit", [["d"], ["0"]])],
)
def test_an_entry_that_no_kernel_is_like_is_told_once(name, arguments, tmp_path):
    of_room = f"asperity.slider.pressed.{name}"
    program = (
        "import sys; from pathlib import Path; from asperity.kernels.building import making\n"
        "from asperity.kernels.native import keys\n"
        "from asperity.kernels.native.entries import Entry\n"
        f"entry = Entry(0, {of_room!r}, {arguments!r}, 1.0)\n"
        "making.keep(Path(sys.argv[1]), entry, keys.key(entry), 1)\n"
    )
    subprocess.run(
        [sys.executable, "-c", program, str(tmp_path)],
        env=os.environ | {"ASPERITY_NATIVE": "0"},
        check=True,
    )
    (told,) = tmp_path.glob(f"*/{kept.UNFIT}")
    assert told.read_text("utf-8").startswith(of_room)


@pytest.mark.parametrize(
    "trouble",
    [
        OSError(28, "No space left on device"),
        MemoryError(),
        # A package that is installed later, or is just being replaced.
        ModuleNotFoundError("No module named 'scipy'"),
    ],
)
def test_trouble_that_may_pass_leaves_nothing(entry, tmp_path, monkeypatch, trouble):
    def hindered(*_given):
        raise trouble

    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(lean, "make", hindered)
    with pytest.raises(type(trouble)):
        making.keep(tmp_path, entry, keys.key(entry), 1)
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]


def test_a_compiler_that_cannot_link_leaves_object_files(entry, tmp_path, monkeypatch):
    monkeypatch.setenv("CC", "false")
    made = lean.Made(b"code", ["d"], (1, 2))
    link.keep(tmp_path, entry, made, b"common")
    assert [(tmp_path / name).read_bytes() for name in table.OBJECTS] == [b"code", b"common"]
    assert not (tmp_path / table.LIBRARY).exists()
    with pytest.raises(link.NotLinkedError):
        link.write(tmp_path, [(entry, made)] * 2, b"common")


def test_on_a_full_disk_what_is_kept_is_read_and_nothing_else_made(tmp_path, monkeypatch, caplog):
    def full(folder):
        raise OSError(28, "No space left on device")

    def begun(kernels):
        raise AssertionError

    first, second = listed().entries[:2]
    folder = tmp_path / "asperity" / "kernels" / keys.key(first)
    folder.mkdir(parents=True, mode=0o700)
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    monkeypatch.setattr(kept, "_begun", begun)
    monkeypatch.setattr(kept.kernel_folder, "_TOLD", set())
    monkeypatch.setattr(kept.kernel_folder, "require_room", full)
    monkeypatch.setattr(kept.load, "checked", lambda *_given: {})
    monkeypatch.setattr("asperity.kernels.native.unlinked.opened", lambda rows, files: rows)
    assert kept._obtained(first) == {}
    assert not caplog.messages
    assert kept._obtained(second) is None
    (told,) = caplog.messages
    assert "cannot be written to (no space left on device)" in told


def test_a_library_that_is_whole_but_does_not_load_is_left(entry, tmp_path, monkeypatch):
    monkeypatch.setattr(link, "linked", lambda *_given: b"no library")
    folder = tmp_path / keys.key(entry)
    folder.mkdir(mode=0o700)
    link.keep(folder, entry, lean.Made(b"code", ["d"], (1, 2)), b"common")
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: tmp_path)
    # Otherwise each run would make it anew, and in vain.
    assert kept._obtained(entry) is None
    assert folder.exists()
    (folder / table.LIBRARY).write_bytes(b"damaged")
    assert kept._obtained(entry) is None
    assert not folder.exists()


def test_of_many_that_are_damaged_one_is_told(tmp_path, monkeypatch, caplog):
    damaged = listed().named("asperity.slider.pressed.friction_limit")[:1]
    damaged += listed().named("asperity.slider.kernels.march_block")[:1]
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: tmp_path)
    for entry in damaged:
        folder = tmp_path / keys.key(entry)
        folder.mkdir(mode=0o700)
        link.keep(folder, entry, lean.Made(b"code", ["d"], (1, 2)), b"common")
        (folder / table.LIBRARY).write_bytes(b"damaged")
        assert kept._obtained(entry) is None
        assert not folder.exists()
    assert len(damaged) == 2
    (told,) = caplog.messages
    assert "is damaged: kernels are compiled instead; it is made anew the next time" in told


def test_what_is_of_another_form_does_not_silence_what_is_damaged(tmp_path, monkeypatch, caplog):
    (first,) = listed().named("asperity.slider.pressed.friction_limit")
    second = listed().named("asperity.slider.kernels.march_block")[0]
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: tmp_path)
    for entry in (first, second):
        folder = tmp_path / keys.key(entry)
        folder.mkdir(mode=0o700)
        link.keep(folder, entry, lean.Made(b"code", ["d"], (1, 2)), b"common")
    rows = table.read(tmp_path / keys.key(first))
    table.write(tmp_path / keys.key(first), rows | {"format": table.FORMAT + 1})
    (tmp_path / keys.key(second) / table.LIBRARY).write_bytes(b"damaged")
    assert kept._obtained(first) is None
    assert not caplog.messages
    assert kept._obtained(second) is None
    assert "is damaged" in caplog.text
