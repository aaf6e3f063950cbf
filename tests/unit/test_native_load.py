"""Which libraries are loaded: those whole, for this machine and from the sources as they are."""

import hashlib
import json
import pickle
import shutil
import subprocess
import sys
import threading
import types
from pathlib import Path

import pytest
from apparatus.native_library import function, object_files, signature

import asperity
from asperity.kernels import compiled
from asperity.kernels.building import link
from asperity.kernels.compiled import kernel
from asperity.kernels.native import keys, layout, load, table, target
from asperity.kernels.native.entries import for_all_processors, listed

SOURCE = "asperity/errors.py"
NAME = "asperity.errors.half"
ROW = signature("asperity_0", [["d"]], ["d"])
HERE = Path(asperity.__file__).parents[1]

pytestmark = pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler to link with")


@pytest.fixture(scope="module")
def linked(tmp_path_factory):
    """A library of one kernel that gives back what it gets."""
    folder = tmp_path_factory.mktemp("linked")
    files = object_files(folder, function(ROW))
    made = folder / table.LIBRARY
    subprocess.run(["cc", "-shared", "-o", made, *files], check=True)
    return made.read_bytes()


@pytest.fixture
def rows(linked):
    return {
        "format": table.FORMAT,
        "target": target.platform_name(),
        "features": [],
        "library": hashlib.sha256(linked).hexdigest(),
        "sources": {SOURCE: hashlib.sha256((HERE / SOURCE).read_bytes()).hexdigest()},
        "entries": {NAME: {"sources": [SOURCE], "signatures": [ROW]}},
    }


@pytest.fixture
def made(linked, rows, tmp_path, monkeypatch):
    """The folder of a library, where that of a wheel stands."""
    (tmp_path / table.LIBRARY).write_bytes(linked)
    table.write(tmp_path, rows)
    monkeypatch.setattr(load, "_SHIPPED", tmp_path)
    monkeypatch.setattr(load, "_kept", lambda name: None)
    monkeypatch.setenv("ASPERITY_NATIVE", "1")
    for each in (load._shipped, load._digest, target.features):
        each.cache_clear()
    yield tmp_path
    load._shipped.cache_clear()
    load._digest.cache_clear()


def answer():
    """What the library says of a half; None where it is not asked."""
    load._shipped.cache_clear()
    found = load.entry(NAME)
    return found and found((0.5,))


def test_a_whole_library_is_called_and_nothing_is_said(made, caplog):
    assert answer() == 0.5
    assert load.entry("asperity.errors.other") is None
    assert load.entry(f"{NAME}.<locals>.inner") is None
    assert not caplog.messages


def half(content):
    return content[: len(content) // 2]


def one_byte_changed(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]


def last_byte_changed(content):
    return content[:-1] + b" "


@pytest.mark.parametrize("name", [table.LIBRARY, table.TABLE])
@pytest.mark.parametrize(
    "damage",
    [half, one_byte_changed, last_byte_changed, lambda content: b"", lambda content: b"garbage\n"],
    ids=["half", "one byte", "last byte", "empty", "garbage"],
)
def test_a_damaged_file_is_told_once_and_not_called(made, caplog, name, damage):
    file = made / name
    file.write_bytes(damage(file.read_bytes()))
    assert answer() is None
    assert load.entry(NAME) is None
    (told,) = caplog.messages
    assert told == f"{file} is damaged: kernels are compiled instead; install asperity anew"


def test_another_library_beside_the_table_is_not_called(made, linked, caplog):
    (made / table.LIBRARY).write_bytes(linked + b"\0")
    assert answer() is None
    assert "is damaged" in caplog.text


def test_a_table_without_its_library_is_told(made, caplog):
    (made / table.LIBRARY).unlink()
    assert answer() is None
    told = f"{made / table.LIBRARY} cannot be read (no such file or directory): kernels are "
    assert caplog.messages == [f"{told}compiled instead; install asperity anew"]


def test_a_library_without_its_table_is_told(made, caplog):
    (made / table.TABLE).unlink()
    assert answer() is None
    (told,) = caplog.messages
    assert told.startswith(f"{made / table.TABLE} is missing: kernels are compiled instead")


def test_a_table_that_cannot_be_read_is_told(made, caplog):
    (made / table.TABLE).unlink()
    (made / table.TABLE).mkdir()
    assert answer() is None
    told = f"{made / table.TABLE} cannot be read (is a directory): kernels are compiled instead; "
    assert caplog.messages == [f"{told}install asperity anew"]


def test_where_nothing_was_made_nothing_is_said(made, caplog):
    for file in (table.LIBRARY, table.TABLE):
        (made / file).unlink(missing_ok=True)
        assert file == table.LIBRARY or answer() is None
    assert not caplog.messages


@pytest.mark.parametrize(
    "changed",
    [
        {"format": table.FORMAT + 1},
        {"target": "riscv64-linux"},
        {"features": ["a-processor-of-tomorrow"]},
        {"sources": {SOURCE: "0" * 64}},
        {"entries": {}},
    ],
    ids=lambda changed: next(iter(changed)),
)
def test_what_is_not_for_here_is_passed_by_without_a_word(made, rows, caplog, changed):
    table.write(made, rows | changed)
    assert answer() is None
    assert not caplog.messages


def test_a_source_that_is_gone_is_a_changed_one(made, rows):
    gone = {"sources": {"asperity/gone.py": ""}}
    row = {"sources": ["asperity/gone.py"], "signatures": [ROW]}
    table.write(made, rows | gone | {"entries": {NAME: row}})
    assert answer() is None


def test_a_library_that_does_not_link_here_is_passed_by(made, rows, caplog):
    content = b"no library at all"
    (made / table.LIBRARY).write_bytes(content)
    table.write(made, rows | {"library": hashlib.sha256(content).hexdigest()})
    assert answer() is None
    assert not caplog.messages


def test_a_library_of_something_else_is_passed_by(made, rows, caplog, tmp_path):
    """As a compiler makes it that links what it was not given."""
    other = tmp_path / "other.c"
    other.write_text("int other(void) { return 1; }", "utf-8")
    subprocess.run(["cc", "-shared", "-fPIC", "-o", made / table.LIBRARY, other], check=True)
    content = (made / table.LIBRARY).read_bytes()
    table.write(made, rows | {"library": hashlib.sha256(content).hexdigest()})
    assert answer() is None
    assert not caplog.messages


def test_a_python_of_another_layout_has_no_library(made, monkeypatch):
    monkeypatch.setattr(layout, "types", lambda: None)
    assert answer() is None


def test_the_processor_is_asked_for_what_the_library_needs(made, rows, monkeypatch):
    known = sorted(target.features())
    assert known
    table.write(made, rows | {"features": known})
    assert answer() == 0.5
    monkeypatch.setattr(target, "features", lambda: frozenset(known[1:]))
    assert answer() is None


def test_of_alike_entries_the_first_is_called_that_the_processor_can_do(made, rows, monkeypatch):
    known = sorted(target.features())
    # Of another symbol: called, it would be another address, of nothing.
    first = ROW | {"symbol": "asperity_none", "features": known[:1]}
    rows["entries"][NAME]["signatures"] = [first, ROW]
    table.write(made, rows)
    with pytest.raises(AttributeError, match="asperity_none"):
        answer()
    monkeypatch.setattr(target, "features", lambda: frozenset(known[1:]))
    assert answer() == 0.5
    rows["entries"][NAME]["signatures"] = [first]
    table.write(made, rows)
    assert answer() is None


LANES, ALONE = "asperity.slider.batch_kernels", "asperity.slider.two_phase"


def test_modules_that_are_made_for_wide_processors_have_kernels():
    assert set(target._FASTEST) <= {entry.module for entry in listed().entries}


@pytest.mark.parametrize(("module", "fastest"), [(LANES, target.WIDE), (ALONE, target.HALF_WIDE)])
def test_bodies_are_made_for_wide_processors_where_this_is_one(module, fastest, monkeypatch):
    for lacks, expected in [(set(), fastest), ({"avx512dq"}, target.PLAIN)]:
        has = frozenset(target.WIDE.features) - lacks
        monkeypatch.setattr(target, "features", lambda has=has: has)
        assert target.here(module) is expected
        assert target.here("asperity.slider.unknowns") is target.PLAIN
    wide, plain = (entry for entry in for_all_processors() if entry.module == module)
    assert (wide.target, plain.target) == (fastest, target.PLAIN)
    assert keys.key(wide) != keys.key(plain)
    assert link.symbol(wide) != link.symbol(plain)


@pytest.mark.parametrize(
    ("variable", "value", "is_called"),
    [
        ("ASPERITY_NATIVE", "0", False),
        ("ASPERITY_NATIVE", "", True),
        ("NUMBA_DISABLE_JIT", "1", False),
        ("NUMBA_DISABLE_JIT", "0", True),
    ],
)
def test_variables_switch_the_library_off(made, monkeypatch, variable, value, is_called):
    monkeypatch.setenv(variable, value)
    monkeypatch.delitem(sys.modules, "numba", raising=False)
    assert (answer() == 0.5) is is_called


def test_the_library_is_called_while_another_thread_loads_numba(made, monkeypatch):
    monkeypatch.setitem(sys.modules, "numba", types.ModuleType("numba"))
    assert answer() == 0.5


def test_without_compiling_a_kernel_is_plain_python(made, monkeypatch):
    import numba

    monkeypatch.setattr(numba.config, "DISABLE_JIT", True)
    assert answer() is None


@pytest.fixture
def here(made):
    """A kernel with the name of the library's, which Python answers with another number."""

    def half(x):
        return x / 2

    half.__module__, half.__qualname__ = "asperity.errors", "half"
    return kernel(half)


def test_a_kernel_asks_the_library_first(here, monkeypatch):
    monkeypatch.setattr(compiled, "made", lambda *arguments: lambda x: ("numba", x))
    assert here(3.0) == 3.0
    # An int is another type.
    assert here(3) == ("numba", 3)
    assert here(4.0) == 4.0


def test_a_kernel_that_no_library_has_goes_to_numba(here, made, monkeypatch):
    (made / table.TABLE).unlink()
    monkeypatch.setattr(compiled, "made", lambda *arguments: lambda x: ("numba", x))
    assert here(3.0) == ("numba", 3.0)
    assert here._native is compiled._not_here


def test_a_kernel_is_made_where_a_library_has_it_or_numba_compiles_it(here, made, monkeypatch):
    class NotYet:
        def is_made(self, arguments):
            return not isinstance(arguments[0], float)

    monkeypatch.setattr(load, "_kept", lambda name: NotYet())
    assert here.is_made(3.0)
    (made / table.TABLE).unlink()
    load._shipped.cache_clear()
    assert not here.is_made(3.0)
    assert here.is_made(3)
    monkeypatch.setattr(load, "_kept", lambda name: None)
    assert here.is_made(3.0)
    monkeypatch.setattr(load, "_kept", lambda name: NotYet())
    monkeypatch.setenv("ASPERITY_NATIVE", "0")
    assert here.is_made(3.0)


@pytest.mark.slow
def test_kernels_called_from_a_library_do_not_load_numba(made):
    code = (
        "import sys\nfrom pathlib import Path\nfrom asperity.kernels.native import load\n"
        f"load._SHIPPED = Path({str(made)!r})\n"
        f"assert load.entry({NAME!r})((0.5,)) == 0.5\n"
        "assert not {'numba', 'llvmlite'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


@pytest.mark.slow
def test_a_compiled_kernel_calls_one_that_the_library_has(here):
    outer = kernel(lambda x: 10.0 * here(x))
    # Numba compiles both from their sources.
    assert outer(3.0) == 15.0


def test_threads_that_call_a_kernel_first_all_get_its_answer(here):
    start, answers = threading.Barrier(8), []

    def call(number):
        start.wait()
        answers.append(here(float(number)) == number)

    threads = [threading.Thread(target=call, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert answers == [True] * 8


def test_a_called_kernel_is_sent_elsewhere_by_its_name():
    from asperity.friction.tangent import update

    assert pickle.loads(pickle.dumps(update)) is update


def test_a_table_is_read_as_it_was_written(tmp_path):
    assert table.read(tmp_path) is None
    rows = {"format": table.FORMAT, "entries": {"ä": [1.5, None, True]}}
    table.write(tmp_path, rows)
    assert table.read(tmp_path) == rows
    first, second = (tmp_path / table.TABLE).read_bytes().splitlines()
    assert hashlib.sha256(second).hexdigest() == first.decode()
    assert json.loads(second) == rows
