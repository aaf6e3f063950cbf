"""A library of all entries: what one entry does to the rest, and what is kept of a build."""

import os
import subprocess
import sys
import textwrap

import pytest
from apparatus.native_library import object_files

from asperity import exit_codes
from asperity.kernels.building import lean, library, link, making
from asperity.kernels.building.compiler import compiler, hindrance
from asperity.kernels.native import keys, load, table
from asperity.kernels.native.entries import Entry, listed, shared_out
from asperity.kernels.native.kept import UNFIT

needs_compiler = pytest.mark.skipif(hindrance() is not None, reason="no library is made here")


def numbered(count):
    return [Entry(n, f"asperity.errors.kernel_{n}", [["d"]], 1.0 + n) for n in range(count)]


@pytest.fixture
def in_place_of_makers(tmp_path, monkeypatch):
    """Let a text of Python be the processes that make entries."""

    def place(text):
        program = tmp_path / "maker.py"
        program.write_text("import os, sys\n" + textwrap.dedent(text), "utf-8")

        def command(kernels, processes, numbers):
            return [sys.executable, str(program), str(tmp_path), *map(str, numbers)]

        monkeypatch.setattr(library, "_command", command)
        monkeypatch.setattr(library, "_PATIENCE", 0.01)

    return place


def makers(tmp_path, entries, told, processes=2):
    return library._Makers(tmp_path, entries, processes, told.append)


def test_an_entry_that_ends_its_process_is_left_out_alone(tmp_path, in_place_of_makers):
    in_place_of_makers("""
        for number in sys.argv[2:]:
            print("at", number, "", flush=True)
            if number == "2":
                os.kill(os.getpid(), 9)
            print("done", number, "no such type" if number == "3" else "", flush=True)
    """)
    told = []
    left = makers(tmp_path, numbered(6), told).make()
    assert left == {2: "a process that compiled it ended (-9)", 3: "no such type"}
    assert sorted(line.partition(": ")[2][-1] for line in told) == ["0", "1", "4", "5"]
    assert [line.partition(":")[0] for line in told] == [f"{n} of 6" for n in (1, 2, 3, 4)]


def test_what_another_build_is_at_is_waited_for(tmp_path, in_place_of_makers):
    in_place_of_makers("""
        from pathlib import Path
        asked = Path(sys.argv[1], "asked")
        for number in sys.argv[2:]:
            print("at", number, "", flush=True)
            if number == "1" and not asked.exists():
                asked.touch()
                continue
            print("done", number, "", flush=True)
    """)
    told = []
    assert makers(tmp_path, numbered(2), told, processes=1).make() == {}
    assert len(told) == 2


def test_where_no_process_begins_there_is_no_library(tmp_path, in_place_of_makers):
    in_place_of_makers("sys.exit(7)")
    with pytest.raises(library.NoLibraryError, match=r"ended \(7\)"):
        makers(tmp_path, numbered(3), []).make()


def test_a_build_that_is_stopped_leaves_no_process(tmp_path, in_place_of_makers):
    in_place_of_makers("""
        from pathlib import Path
        print("at", sys.argv[2], "", flush=True)
        print("done", sys.argv[2], "", flush=True)
        sys.stdin.read()
        Path(sys.argv[1], "ended").touch()
    """)

    def tell(line):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        library._Makers(tmp_path, numbered(2), 1, tell).make()
    assert (tmp_path / "ended").exists()


def test_what_calls_much_the_same_stays_together():
    entries = listed().entries
    parts = shared_out(entries, 3, depth=3)
    assert sorted(each.number for part in parts for each in part) == [*range(len(entries))]
    rooms = [{".".join(each.module.split(".")[:3]) for each in part} for part in parts]
    assert not rooms[0] & rooms[1]
    assert not rooms[1] & rooms[2]


@pytest.fixture
def entry():
    (found,) = listed().named("asperity.slider.pressed.friction_limit")
    return found


MADE = lean.Made(b"code", ["d"], (1, 2))


def test_an_object_is_read_as_it_was_kept(entry, tmp_path, monkeypatch):
    monkeypatch.setattr(link, "linked", lambda *_given: b"linked")
    link.keep(tmp_path, entry, MADE, b"common")
    assert link.kept(tmp_path, entry) == MADE
    assert link.kept(tmp_path, Entry(0, entry.name, [["d"], ["q"]], 1.0)) is None
    (tmp_path / table.OBJECTS[0]).write_bytes(b"cod")
    assert link.kept(tmp_path, entry) is None


def test_an_entry_without_its_object_is_made_once_more(entry, tmp_path, monkeypatch):
    made = []

    def make(*given):
        made.append(given)
        return MADE

    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(making, "_support", lambda: b"common")
    monkeypatch.setattr(lean, "make", make)
    monkeypatch.setattr(link, "linked", lambda *_given: b"linked")
    folder = tmp_path / keys.key(entry)
    assert making.keep(tmp_path, entry, folder.name, 1)
    (folder / table.OBJECTS[0]).unlink()
    for _ in range(2):
        assert making.keep(tmp_path, entry, folder.name, 1)
    assert len(made) == 2
    assert link.kept(folder, entry) == MADE
    assert sorted(path.name for path in tmp_path.iterdir() if path.is_dir()) == [folder.name]


@needs_compiler
def test_a_compiler_that_does_not_link_is_told_before_anything_is_compiled(
    entry, tmp_path, monkeypatch
):
    monkeypatch.setenv("CC", "false")
    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(link, "support", lambda: b"common")
    monkeypatch.setattr(library, "_Makers", None)
    with pytest.raises(library.NoLibraryError, match="the C compiler does not link: "):
        library.build(tmp_path, [entry], 1)
    assert not list(tmp_path.iterdir())


def test_a_symbol_follows_from_the_entry_and_not_from_its_place(entry):
    moved = Entry(entry.number + 1, entry.name, entry.arguments, 2.0, entry.target)
    other = Entry(entry.number, entry.name, [["d"], ["q"]], 1.0, entry.target)
    assert link.symbol(entry) == link.symbol(moved) != link.symbol(other)


@pytest.mark.slow
@needs_compiler
def test_what_cannot_be_made_is_named_and_the_rest_linked(entry, tmp_path, monkeypatch):
    other = next(one for one in listed().entries if one.name != entry.name)
    unfit = tmp_path / "kernels" / keys.key(other)
    unfit.mkdir(parents=True)
    (unfit / UNFIT).write_text(f"{other.name}: it returns a record\n", "utf-8")
    program = (
        "import sys; from pathlib import Path; from asperity.kernels.building import library\n"
        "from asperity.kernels.native.entries import listed\n"
        "library.kernel_folder.kernels = lambda: Path(sys.argv[1])\n"
        "entries = [listed().entries[int(n)] for n in sys.argv[3:]]\n"
        "library.build(Path(sys.argv[2]), entries, 2, print)\n"
    )
    numbers = [str(one.number) for one in (entry, other)]
    out = tmp_path / "out"
    done = subprocess.run(
        [sys.executable, "-c", program, str(tmp_path / "kernels"), str(out), *numbers],
        env=os.environ | {"ASPERITY_NATIVE": "0"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout.splitlines() == [
        f"1 of 2: {entry.name}",
        f"left to Numba: {other.name}: it returns a record",
    ]
    assert {path.name for path in out.iterdir()} == {table.LIBRARY, table.TABLE}
    found = load.from_folder(out)
    assert found.entry(entry.name)((0.5, 2.0)) == 0.25
    assert found.entry(other.name) is None


@pytest.mark.parametrize(
    ("entries", "why"),
    [([], "no kernel is listed"), (numbered(1), "no C compiler is found")],
)
def test_where_there_is_nothing_to_link_or_to_link_with_it_is_told(
    entries, why, tmp_path, monkeypatch
):
    if entries:
        monkeypatch.setenv("CC", "no-such-compiler")
    monkeypatch.setattr("asperity.kernels.building.compiler.platform_name", lambda: "x86_64-linux")
    with pytest.raises(library.NoLibraryError, match=why):
        library.build(tmp_path, entries, 1)
    assert not list(tmp_path.iterdir())


@needs_compiler
def test_a_folder_that_cannot_be_made_is_told(tmp_path, monkeypatch, capsys):
    (tmp_path / "file").touch()
    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(link, "support", lambda: b"common")
    monkeypatch.setattr(sys, "argv", ["library", str(tmp_path / "file" / "made")])
    with pytest.raises(SystemExit) as end:
        library.main()
    assert end.value.code == exit_codes.NO_LIBRARY
    assert "no library of kernels: " in capsys.readouterr().err


def test_another_platform_is_told(monkeypatch):
    monkeypatch.setattr("asperity.kernels.building.compiler.platform_name", lambda: "arm64-darwin")
    assert hindrance() == "it is made for x86_64-linux only, not for arm64-darwin"


@pytest.fixture
def objects(tmp_path, monkeypatch):
    """Contents of object files that a library is linked of; no compiler is known yet."""
    monkeypatch.setattr(link, "_LOADS", set())
    return [path.read_bytes() for path in object_files(tmp_path)]


@pytest.fixture
def adds(tmp_path, monkeypatch):
    """Let the compiler add to a library what runs as it is loaded."""

    def add(text, includes="<unistd.h>"):
        source = tmp_path / "added.c"
        loads = "__attribute__((constructor)) static void loads(void)"
        source.write_text(f"#include {includes}\n{loads} {{ {text} }}\n", "utf-8")
        monkeypatch.setenv("CC", f"{compiler()[0]} -fPIC {source}")

    return add


@needs_compiler
def test_a_library_that_would_end_who_loads_it_is_none(objects, entry, tmp_path, adds):
    """As one does whose compiler was told to add what must be loaded before anything else."""
    adds("_exit(7);")
    with pytest.raises(link.NotLinkedError, match=r"does not load: it ends a process \(7\)"):
        link.linked(tmp_path, objects)
    folder = tmp_path / "kept"
    folder.mkdir()
    link.keep(folder, entry, lean.Made(objects[1], ["d"], (1, 2)), objects[0])
    assert not (folder / table.LIBRARY).exists()
    assert [(folder / name).read_bytes() for name in table.OBJECTS] == objects[::-1]


@needs_compiler
def test_a_library_that_changes_how_is_calculated_is_none(objects, tmp_path, adds):
    """As one does that -ffast-math links: 5e-311 would be 0 in all that the process calculates."""
    adds("_mm_setcsr(_mm_getcsr() | 0x8040);", "<xmmintrin.h>")
    with pytest.raises(link.NotLinkedError, match="does not load: it takes the smallest numbers"):
        link.linked(tmp_path, objects)


@needs_compiler
def test_a_library_of_something_else_is_none(objects, tmp_path, script):
    (tmp_path / "other.c").write_text("int other(void) { return 1; }\n", "utf-8")
    script(f'exec {compiler()[0]} -shared -fPIC -o "$4" {tmp_path / "other.c"}')
    with pytest.raises(link.NotLinkedError, match=r"does not load: .*asperity_gather"):
        link.linked(tmp_path, objects)


@pytest.fixture
def script(tmp_path, monkeypatch):
    """Let a shell's words be the compiler."""

    def write(text):
        path = tmp_path / "script"
        path.write_text(f"#!/bin/sh\n{text}\n", "utf-8")
        path.chmod(0o700)
        monkeypatch.setenv("CC", str(path))

    return write


@needs_compiler
def test_a_library_that_needs_what_was_loaded_before_is_none(objects, tmp_path, adds, monkeypatch):
    before = tmp_path / "before.so"
    (tmp_path / "before.c").write_text("int before(void) { return 1; }\n", "utf-8")
    command = [*compiler(), "-shared", "-fPIC", "-o", before, tmp_path / "before.c"]
    subprocess.run(command, check=True)
    adds("extern int before(void); before();")
    monkeypatch.setenv("LD_PRELOAD", str(before))
    with pytest.raises(link.NotLinkedError, match="undefined symbol: before"):
        link.linked(tmp_path, objects)


@pytest.mark.ordinary(1)
@needs_compiler
@pytest.mark.parametrize("text", ["kill(getpid(), SIGKILL);", "sleep(20);"])
def test_trouble_at_loading_that_may_pass_keeps_nothing(
    objects, entry, tmp_path, adds, script, monkeypatch, text
):
    """As where memory is short, or the machine has too much to do."""
    adds(text, "<unistd.h>\n#include <signal.h>")
    library = tmp_path / "made.so"
    subprocess.run(
        [*compiler(), "-shared", "-fPIC", "-o", library, tmp_path / "added.c"], check=True
    )
    script(f'cp {library} "$4"')
    monkeypatch.setattr(link, "_TIMEOUT", 1.0)
    folder = tmp_path / "kept"
    folder.mkdir()
    with pytest.raises(subprocess.SubprocessError):
        link.keep(folder, entry, lean.Made(objects[1], ["d"], (1, 2)), objects[0])
    assert not (folder / table.TABLE).exists()


def test_a_compiler_that_hangs_is_waited_for_once(tmp_path, script, monkeypatch, caplog):
    script('echo >> "$0.runs"; exec sleep 60')
    monkeypatch.setattr(link, "_TIMEOUT", 0.5)
    for _ in range(3):
        with pytest.raises(subprocess.SubprocessError):
            link.linked(tmp_path, [b"object"])
    (runs,) = tmp_path.rglob("*.runs")
    assert len(runs.read_text().splitlines()) == 1
    (line,) = caplog.messages
    assert "has not ended in 0.5 s: Numba compiles instead" in line


@pytest.mark.parametrize(
    "text",
    [
        "echo 'ld: final link failed: No space left on device' >&2; exit 1",
        "echo 'collect2: fatal error: ld terminated with signal 9 [Killed]' >&2; exit 1",
        "kill -9 $$",
    ],
)
def test_trouble_at_linking_that_may_pass_keeps_nothing(entry, tmp_path, script, text):
    script(text)
    with pytest.raises(subprocess.SubprocessError):
        link.keep(tmp_path, entry, MADE, b"common")
    assert not (tmp_path / table.TABLE).exists()


@needs_compiler
@pytest.mark.parametrize("text", ["echo >&2; exit 1", "exit 1", "#"])
def test_a_compiler_that_says_nothing_is_told(tmp_path, script, monkeypatch, text):
    script(text)
    monkeypatch.setattr(making, "began", lambda: None)
    monkeypatch.setattr(link, "support", lambda: b"common")
    with pytest.raises(library.NoLibraryError, match="the C compiler does not link: "):
        library.build(tmp_path / "made", numbered(1), 1)


@needs_compiler
def test_what_is_linked_is_tried_where_it_will_stand(objects, tmp_path, monkeypatch):
    """From the folder of what passes, which everybody writes to, nothing may be loaded."""
    tried = []
    monkeypatch.setattr(link, "_try", tried.append)
    place = tmp_path / "place"
    place.mkdir()
    link.linked(place, objects)
    assert place in tried[0].parents
    assert not list(place.iterdir())


@needs_compiler
def test_a_compiler_is_tried_once_with_each_of_its_options(objects, tmp_path, monkeypatch):
    tried = []
    monkeypatch.setattr(link, "_try", tried.append)
    words = compiler()[0]
    for options in ("", "-O1", "-O1", ""):
        monkeypatch.setenv("CC", f"{words} {options}")
        link.linked(tmp_path, objects)
    assert len(tried) == 2


PASSES = """
import sys
from pathlib import Path
from asperity.kernels.building import library, making
from asperity.kernels.native.entries import listed
library._PATIENCE = 0.01
asked = []
def keep(kernels, entry, key, processes):
    asked.append(entry.number)
    return entry.number == 1 or len(asked) > 3
making.keep = keep
library._make(Path(sys.argv[1]), listed().entries[:2], 1)
"""


@pytest.mark.slow
def test_a_process_of_a_build_looks_on_while_others_are_at_what_is_left(tmp_path):
    """One that began anew each time would never see that they have stood still."""
    done = subprocess.Popen(
        [sys.executable, "-c", PASSES, str(tmp_path)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        told = [line.strip() for line in done.stdout]
    finally:
        done.kill()
        done.communicate()
    assert told == ["at 0", "passed 0", "at 1", "done 1", "at 0", "passed 0", "at 0", "done 0"]


def test_a_compiler_that_is_misquoted_is_none(monkeypatch):
    monkeypatch.setenv("CC", "'gcc")
    assert compiler() is None
    monkeypatch.setenv("CC", "no-such-compiler -O2")
    assert compiler() is None
