import errno
import importlib
import json
import os
import pickle
import shutil
import stat
import subprocess
import sys
import time
from pathlib import Path

import numba
import numpy as np
import pytest
from apparatus.grid import slow
from numba.core.base import BaseContext

from asperity.files.folders import cache_folder
from asperity.friction.tangent import update
from asperity.kernels import compiled
from asperity.kernels import folder as kernel_folder
from asperity.kernels.compiled import kernel, kernel_key

PROGRAM = """
import json, sys
from pathlib import Path
package = Path(sys.argv[1])
sys.path.insert(0, str(package.parent))
from fake.outer import outer
value = outer(2.0)
stats = outer.stats
compiling = [name for name in ("scipy.linalg", "numba.np.linalg") if name in sys.modules]
print(json.dumps([value, sum(stats.cache_hits.values()), stats.cache_path, compiling]))
"""


@pytest.fixture
def package(tmp_path):
    """A package of two modules, one calling the other."""
    folder = tmp_path / "fake"
    folder.mkdir()
    (folder / "__init__.py").touch()
    (folder / "inner.py").write_text(
        "from asperity.kernels.compiled import kernel\n@kernel\ndef inner(x):\n    return x + 1.0\n"
    )
    (folder / "outer.py").write_text(
        "from asperity.kernels.compiled import kernel\nfrom fake.inner import inner\n"
        "@kernel\ndef outer(x):\n    return inner(x) * 10.0\n"
    )
    return folder


@pytest.fixture
def run_process(package, tmp_path):
    """Call ``outer(2)`` in a fresh process; returns value, cache hits and cache folder."""

    def call():
        done = subprocess.run(
            [sys.executable, "-W", "error", "-c", PROGRAM, str(package)],
            env={**os.environ, "ASPERITY_CACHE": str(tmp_path / "cache")},
            capture_output=True,
            text=True,
            check=False,
        )
        assert (done.returncode, done.stderr) == (0, "")
        return json.loads(done.stdout)

    return call


@pytest.fixture
def run(package, monkeypatch, tmp_path):
    """Call ``outer(2)`` as `run_process` does, of the package imported anew in this process."""
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    monkeypatch.setattr(kernel_folder, "_TOLD", set())

    def call(cache=tmp_path / "cache", package=package):
        monkeypatch.setenv("ASPERITY_CACHE", str(cache))
        kernel_folder._kernels.cache_clear()
        for name in ("fake", "fake.inner", "fake.outer"):
            sys.modules.pop(name, None)
        with monkeypatch.context() as patched:
            patched.syspath_prepend(package.parent)
            outer = importlib.import_module("fake.outer").outer
            value = outer(2.0)
        return [value, sum(outer.stats.cache_hits.values()), outer.stats.cache_path]

    yield call
    kernel_folder._kernels.cache_clear()


@pytest.mark.slow
def test_a_second_process_finds_the_kernel_in_the_cache(run_process, run, tmp_path):
    first, hits, folder, _ = run_process()
    assert (first, hits) == (30.0, 0)
    assert Path(folder).is_relative_to(tmp_path / "cache" / "asperity" / "kernels")
    assert run_process()[:3] == run() == [30.0, 1, folder]


@pytest.mark.slow
def test_a_kernel_that_is_only_loaded_loads_nothing_that_compiling_needs(run_process, run):
    run()
    *answer, compiling = run_process()
    assert (answer[:2], compiling) == ([30.0, 1], [])


def test_a_kernel_that_is_only_loaded_does_not_ask_for_all_that_compiling_may_need(
    run, monkeypatch
):
    run()

    def refreshed(_):
        raise AssertionError("half a second of modules were loaded")

    monkeypatch.setattr(BaseContext, "refresh", refreshed)
    assert run()[:2] == [30.0, 1]


@pytest.mark.slow
def test_a_change_in_a_called_module_gives_the_new_answer(run, package):
    run()
    inner = package / "inner.py"
    inner.write_text(inner.read_text().replace("1.0", "2.0"))
    assert run()[:2] == [40.0, 0]


@pytest.mark.parametrize("older", [False, True])
@pytest.mark.parametrize("changed", ["outer", "inner"])
def test_what_is_changed_between_its_import_and_its_call_is_not_kept(
    run, package, monkeypatch, changed, older
):
    """Numba compiles what was imported: under the new source's key it would be taken for that."""
    source = package / f"{changed}.py"
    made = compiled.made

    def edited(*arguments):
        _edit(source, older=older)
        return made(*arguments)

    with monkeypatch.context() as patched:
        patched.setattr(compiled, "made", edited)
        assert run()[0] == 30.0
    assert run()[:2] == [60.0 if changed == "outer" else 40.0, 0]


def test_what_a_later_module_calls_as_it_was_imported_is_not_kept(run, package, monkeypatch):
    declared = compiled._note

    def note(function):
        declared(function)
        if function.__name__ == "inner":
            _edit(package / "inner.py")

    with monkeypatch.context() as patched:
        patched.setattr(compiled, "_note", note)
        assert run()[0] == 30.0
    assert run()[:2] == [40.0, 0]


def test_sources_of_the_future_are_kept(run, package):
    for source in package.glob("*.py"):
        os.utime(source, (time.time() + 7200.0,) * 2)
    run()
    assert run()[:2] == [30.0, 1]


def _edit(source, *, older=False):
    new = source.with_suffix(".new")
    new.write_text(source.read_text().replace("+ 1.0", "+ 2.0").replace("* 10.0", "* 20.0"))
    if older:
        os.utime(new, (time.time() - 3600.0,) * 2)
    new.replace(source)


def half(content):
    return content[: len(content) // 2]


def one_byte_changed(content):
    middle = len(content) // 2
    return content[:middle] + bytes([content[middle] ^ 0xFF]) + content[middle + 1 :]


@pytest.mark.parametrize(
    ("suffix", "damage"),
    [
        ("nbi", lambda content: b"garbage"),
        slow("nbi", half),
        slow("nbc", lambda content: b""),
        slow("nbc", half),
        ("nbc", one_byte_changed),
    ],
)
def test_a_damaged_cache_file_costs_a_compilation_and_is_repaired(run, tmp_path, suffix, damage):
    run()
    (file,) = (tmp_path / "cache").rglob(f"outer.outer*.{suffix}")
    file.write_bytes(damage(file.read_bytes()))
    assert run()[:2] == [30.0, 0]
    assert run()[:2] == [30.0, 1]


def test_without_a_writable_folder_kernels_work_uncached(run, tmp_path):
    (tmp_path / "file").touch()
    assert run(tmp_path / "file") == [30.0, 0, None]


@pytest.mark.skipif(os.name != "posix", reason="a folder in use cannot be removed")
def test_a_kernel_is_compiled_where_the_current_folder_is_gone(monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "cache"))

    @kernel
    def taken(values, place):
        return values[place]

    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    # What Numba finds to be no constant it looks up in the source.
    assert taken(np.array([1.0, 2.0]), 1) == 2.0


def test_a_failed_save_is_ignored(monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))

    @kernel
    def double(x):
        return 2.0 * x

    def full(name, data):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(double._cache._cache_file, "_save_data", full)
    assert double(3.0) == 6.0


def test_a_kernel_keeps_its_options_docstring_and_numbas_settings():
    folder_before = numba.config.CACHE_DIR

    @kernel(fastmath=True, inline="always")
    def inverse(x):
        """Return 1/x."""
        return 1.0 / x

    assert inverse.__doc__ == "Return 1/x."
    assert inverse.targetoptions["fastmath"] is True
    assert inverse.targetoptions["nogil"] is True
    assert folder_before == numba.config.CACHE_DIR
    assert np.isinf(inverse(0.0))


@pytest.mark.slow
def test_declaring_a_kernel_loads_no_compiler_and_calling_one_does():
    code = (
        "import sys\nimport asperity.friction.dahl, asperity.slider.kernels\n"
        "assert not {'numba', 'llvmlite'} & set(sys.modules)\n"
        "from asperity.kernels.compiled import machine\nmachine()\nassert 'numba' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_kernel_that_is_sent_elsewhere_is_found_there_by_its_name():
    sent = pickle.loads(pickle.dumps(update))
    assert sent is update


@pytest.mark.slow
def test_machine_code_that_others_could_have_written_is_not_run(run, tmp_path, caplog):
    cache = tmp_path / "cache"
    _, _, folder = run()
    kernels = cache / "asperity" / "kernels"
    for place in (cache / "asperity", kernels, Path(folder)):
        assert stat.S_IMODE(place.stat().st_mode) == 0o700
    for place in (kernels, Path(folder)):
        place.chmod(0o777)
        kernel_folder._TOLD.clear()
        assert run() == [30.0, 0, None]
        (told,) = caplog.messages
        assert told.startswith(f"{place} can be written to by others; kernels are compiled anew")
        caplog.clear()
        place.chmod(0o700)
    assert run()[1] == 1


def test_machine_code_of_another_user_is_not_run(monkeypatch, tmp_path, caplog):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    monkeypatch.setattr(os, "geteuid", lambda: os.getuid() + 1)

    @kernel
    def double(x):
        return 2.0 * x

    assert double(3.0) == 6.0
    assert double.stats.cache_path is None
    assert "belongs to another user" in caplog.text


def test_a_function_without_a_file_is_compiled_uncached():
    space = {}
    exec("def double(x):\n    return 2 * x", space)
    assert kernel(space["double"])(3) == 6


def test_the_key_follows_the_imports_and_nothing_else(package):
    def key():
        return kernel_key("fake.outer", package / "outer.py")

    before = key()
    assert len(before) == 16
    (package / "other.py").write_text("from fake.outer import outer\n")
    assert key() == before
    inner = package / "inner.py"
    inner.write_text(inner.read_text() + "# changed\n")
    assert key() != before


def test_the_key_is_the_same_in_another_place(package, tmp_path):
    moved = tmp_path / "elsewhere" / "fake"
    shutil.copytree(package, moved)
    key = kernel_key("fake.outer", package / "outer.py")
    assert kernel_key("fake.outer", moved / "outer.py") == key


def test_a_kernel_compiled_in_one_place_serves_in_another(run, package, tmp_path):
    run()
    moved = tmp_path / "elsewhere" / "fake"
    shutil.copytree(package, moved)
    assert run(package=moved)[:2] == [30.0, 1]


def test_cache_folders_stand_under_the_folder_that_the_environment_names(monkeypatch, tmp_path):
    monkeypatch.delenv("ASPERITY_CACHE", raising=False)
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    assert cache_folder("sweeps") == tmp_path / "home" / ".cache" / "asperity" / "sweeps"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_folder("sweeps") == tmp_path / "xdg" / "asperity" / "sweeps"
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "own"))
    folder = cache_folder("sweeps")
    assert folder == tmp_path / "own" / "asperity" / "sweeps"
    assert not list(folder.iterdir())
    (tmp_path / "file").touch()
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "file"))
    assert cache_folder("sweeps") is None


def test_folders_of_old_sources_go_after_a_month(monkeypatch, tmp_path):
    kernels = tmp_path / "asperity" / "kernels"
    old, recent, other = kernels / ("a" * 16), kernels / ("b" * 16), kernels / "something else"
    for folder in (old, recent, other):
        folder.mkdir(parents=True)
    month_ago = time.time() - 31 * 86400
    for folder in (old, other):
        os.utime(folder, (month_ago, month_ago))
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))

    @kernel
    def double(x):
        return 2.0 * x

    assert double(1.0) == 2.0
    assert {folder.name for folder in kernels.iterdir()} == {
        recent.name,
        other.name,
        kernel_key(__name__, Path(__file__)),
    }


def full(path, content):
    raise OSError(errno.ENOSPC, "No space left on device", str(path))


def read_only(path, **options):
    raise OSError(errno.EROFS, "Read-only file system", str(path))


@pytest.mark.parametrize(
    ("method", "instead", "why"),
    [("write_bytes", full, "no space left on device"), ("mkdir", read_only, "read-only file sys")],
)
def test_a_cache_that_takes_no_kernels_is_told_of_once(
    monkeypatch, tmp_path, caplog, method, instead, why
):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / method))
    monkeypatch.setattr(kernel_folder, "_TOLD", set())
    monkeypatch.setattr(Path, method, instead)
    assert kernel_folder.with_room() is None
    assert kernel_folder.with_room() is None
    (told,) = caplog.messages
    assert told.startswith(f"the cache folder {tmp_path / method / 'asperity'} cannot be written ")
    assert f"({why}" in told
    assert "set ASPERITY_CACHE" in told


def test_of_a_cache_that_takes_no_more_what_stands_there_is_read(
    run, tmp_path, monkeypatch, caplog
):
    def fails(*_given, **_options):
        raise OSError(errno.EROFS, "Read-only file system")

    run()
    for name in ("write_bytes", "write_text", "touch"):
        monkeypatch.setattr(Path, name, fails)
    monkeypatch.setattr(os, "utime", fails)
    assert run()[:2] == [30.0, 1]
    assert not caplog.messages


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("trouble", "lines"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), 1),
        (FileNotFoundError(errno.ENOENT, "removed since"), 0),
        (PermissionError(errno.EACCES, "Permission denied", "/usr/bin/cc"), 0),
        (OSError(errno.EIO, "Input/output error"), 0),
        (pickle.PicklingError(), 0),
    ],
    ids=["full", "removed", "elsewhere", "passes", "not to be written down"],
)
def test_a_cache_that_fills_up_is_told_of_by_the_run_that_fills_it(
    monkeypatch, tmp_path, caplog, trouble, lines
):
    def save(*_given):
        raise trouble

    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path))
    monkeypatch.setenv("ASPERITY_NATIVE", "0")
    monkeypatch.setattr(kernel_folder, "_TOLD", set())
    monkeypatch.setattr(numba.core.caching.FunctionCache, "save_overload", save)
    twice = kernel(lambda x: 2 * x)
    assert [twice(2.0), twice(2)] == [4.0, 4]
    assert len(caplog.messages) == lines
    assert not lines or "cannot be written to (no space left on device)" in caplog.text
