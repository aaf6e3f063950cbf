"""What is kept of an entry is loaded where it is the user's alone and for this processor."""

import shutil
import sys

import numpy as np
import pytest
from apparatus.native_library import function, object_files, signature

from asperity.files import folders
from asperity.kernels import compiled, machine_code
from asperity.kernels.building import lean, link
from asperity.kernels.native import kept, keys, layout, load, makers, table, target
from asperity.kernels.native.entries import Entry, listed

HALF = Entry(0, "asperity.errors.half", [["d"]], 1.0)

pytestmark = [
    pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler to link with"),
    pytest.mark.skipif(
        not load.is_for_here(makers.MADE_HERE, target.FEATURES), reason="nothing is made here"
    ),
]


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    """The object of a kernel that gives back what it gets, and the one that all have in common."""
    row = signature(link.symbol(HALF), HALF.arguments, ["d"])
    common, code = object_files(tmp_path_factory.mktemp("parts"), function(row))
    return code.read_bytes(), common.read_bytes()


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """An empty one, where no process begins to fill it."""

    def begun(kernels):
        raise AssertionError("a process begins")

    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    monkeypatch.delenv("ASPERITY_NATIVE", raising=False)
    monkeypatch.setattr(kept, "_begun", begun)
    monkeypatch.setattr(kept.kernel_folder, "_TOLD", set())
    monkeypatch.setattr(load, "_shipped", lambda: None)
    return folders.cache_folder("kernels")


def keeps(cache, parts):
    """Keep the kernel; return the folder."""
    code, common = parts
    folder = cache / keys.key(HALF)
    folder.mkdir(mode=0o700)
    link.keep(folder, HALF, lean.Made(code, ["d"], (1, 1)), common)
    return folder


@pytest.fixture
def half(monkeypatch):
    """A kernel of the entry's name, which Numba answers with another number."""

    def half(x):
        return x / 2

    half.__module__, half.__qualname__ = "asperity.errors", "half"
    monkeypatch.setattr(load, "_kept", lambda name: kept.Kept([HALF]))
    monkeypatch.setattr(compiled, "made", lambda *arguments: lambda x: x / 2)
    return compiled.kernel(half)


@pytest.fixture
def without_compiler(monkeypatch):
    monkeypatch.setenv("CC", "no-such-compiler")


def test_what_is_kept_is_loaded(cache, parts, half, caplog):
    folder = keeps(cache, parts)
    assert (folder / table.LIBRARY).exists()
    assert half(3.0) == 3.0
    assert not caplog.messages


def test_without_a_compiler_llvm_loads_what_is_kept_and_numba_is_not(
    cache, parts, half, without_compiler, monkeypatch, caplog
):
    folder = keeps(cache, parts)
    assert not (folder / table.LIBRARY).exists()
    # Whatever imports it fails.
    monkeypatch.setitem(sys.modules, "numba", None)
    assert half(3.0) == 3.0
    assert half(-0.0) == 0.0
    # And Numba's way where the types are others.
    assert half(np.float32(3.0)) == 1.5
    assert not caplog.messages


def test_without_a_compiler_a_damaged_object_is_not_loaded(
    cache, parts, half, without_compiler, caplog
):
    folder = keeps(cache, parts)
    for name in table.OBJECTS:
        held = (folder / name).read_bytes()
        (folder / name).write_bytes(held[:-1] + bytes([held[-1] ^ 1]))
        assert kept._obtained(HALF) is None
        assert not folder.exists()
        keeps(cache, parts)
    assert half(3.0) == 3.0
    (told,) = caplog.messages
    assert "is damaged" in told


@pytest.mark.parametrize("mode", [0o020, 0o002], ids=["group", "all"])
@pytest.mark.parametrize("name", [".", table.LIBRARY, table.TABLE])
def test_what_others_may_have_written_is_not_loaded(name, mode, cache, parts, half, caplog):
    folder = keeps(cache, parts)
    folder.chmod(0o755)
    (folder / name).chmod((folder / name).stat().st_mode | mode)
    assert [half(3.0), half(3.0)] == [1.5, 1.5]
    (told,) = caplog.messages
    assert told.startswith(f"{folder / name} can be written to by others; kernels are compiled ")
    assert "remove it, or all kernels by `asperity cache kernels --clear`" in told
    # It is for the user to look at.
    assert (folder / table.LIBRARY).exists()


def test_of_many_that_others_may_have_written_one_line_is_said(cache, caplog):
    for name in ("one", "two", "three"):
        (cache / name).mkdir()
        (cache / name).chmod(0o777)
        assert not kept.kernel_folder.is_kept(cache / name)
    (told,) = caplog.messages
    assert told.startswith(f"{cache / 'one'} can be written to by others")


def test_from_a_cache_that_others_may_write_to_nothing_is_loaded(cache, parts, half, caplog):
    keeps(cache, parts)
    cache.chmod(0o770)
    assert [half(3.0), half(3.0)] == [1.5, 1.5]
    (told,) = caplog.messages
    assert told.startswith(f"{cache} can be written to by others; kernels are compiled anew")


def test_nor_does_numba_read_a_folder_that_others_may_write_to(cache, caplog):
    folder = cache / f"{1:016}"
    folder.mkdir(mode=0o700)
    assert machine_code._kernel_folder(folder.name) == folder
    folder.chmod(0o770)
    assert machine_code._kernel_folder(folder.name) is None
    (told,) = caplog.messages
    assert told.startswith(f"{folder} can be written to by others; kernels are compiled anew")


def test_files_that_nobody_else_reaches_are_loaded_whatever_the_umask(cache, parts, half, caplog):
    folder = keeps(cache, parts)
    for file in folder.iterdir():
        file.chmod(0o666)
    assert folder.stat().st_mode & 0o777 == 0o700
    assert half(3.0) == 3.0
    assert not caplog.messages


@pytest.mark.parametrize("name", table.OBJECTS)
def test_without_a_compiler_no_object_that_others_may_have_written_is_loaded(
    name, cache, parts, half, without_compiler, caplog
):
    folder = keeps(cache, parts)
    folder.chmod(0o755)
    (folder / name).chmod(0o666)
    assert [half(3.0), half(3.0)] == [1.5, 1.5]
    (told,) = caplog.messages
    assert told.startswith(f"{folder / name} can be written to by others")


def test_what_belongs_to_another_is_not_loaded(cache, parts, half, monkeypatch, caplog):
    folder = keeps(cache, parts)
    monkeypatch.setattr(kept.kernel_folder, "kernels", lambda: cache)
    monkeypatch.setattr(folders.os, "geteuid", lambda: folder.stat().st_uid + 1)
    assert half(3.0) == 1.5
    (told,) = caplog.messages
    assert told.startswith(f"{folder} belongs to another user; kernels are compiled anew")


@pytest.fixture
def listed_kernel(monkeypatch):
    """A kernel of the list as a checkout calls it, with Numba's answer a word."""

    def friction_limit(a, b):
        return a

    friction_limit.__module__ = "asperity.slider.pressed"
    friction_limit.__qualname__ = "friction_limit"
    kept.library.cache_clear()
    monkeypatch.setattr(compiled, "made", lambda *arguments: lambda *given: "Numba's")
    yield compiled.kernel(friction_limit)
    kept.library.cache_clear()


@pytest.mark.parametrize(
    ("place", "name", "value"),
    [
        (target, "features", frozenset()),
        (target, "features", frozenset(target.FEATURES[1:])),
        (target, "platform_name", "aarch64-linux"),
        (target, "platform_name", "x86_64-darwin"),
        (layout, "types", None),
    ],
)
def test_for_another_processor_nothing_is_made_and_numba_compiles(
    place, name, value, cache, listed_kernel, monkeypatch, caplog
):
    monkeypatch.setattr(place, name, lambda: value)
    assert listed_kernel(1.0, 2.0) == "Numba's"
    kept.make(listed().entries)
    assert not list(cache.iterdir())
    assert not caplog.messages


def test_for_this_processor_a_process_is_asked(cache, listed_kernel):
    with pytest.raises(AssertionError, match="a process begins"):
        listed_kernel(1.0, 2.0)
