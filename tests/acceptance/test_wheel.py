"""What a wheel brings: kernels in a library, called where it fits, and Numba's way where not."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from asperity.kernels.building.compiler import compiler, hindrance
from asperity.kernels.native import entries, table

pytest.importorskip("hatchling", reason="hatchling is not installed")

ROOT = Path(__file__).resolve().parents[2]
PARTS = ("LICENSE", "README.md", "hatch_build.py", "pyproject.toml", "constraints.txt")
PLAIN, ANY = "asperity-0.1.0-py3-none-linux_x86_64.whl", "asperity-0.1.0-py3-none-any.whl"
SDIST = "asperity-0.1.0.tar.gz"
KERNELS = (
    "asperity.slider.pressed.friction_limit",
    "asperity.friction.lugre.stribeck_share",
    "asperity.friction.springs.stored_in_springs",
)
# In the folder of a wheel: what the kernels answer, called once with types of the library and once
# with others, and who answered.
PROGRAM = """
import json, sys
import numpy as np
from asperity.friction.lugre import stribeck_share
from asperity.friction.springs import stored_in_springs
from asperity.slider.pressed import friction_limit
x = np.array([1.0, -2.0])
listed = [friction_limit(0.5, 2.0), stribeck_share(1.0, 3.0, 1.0), stored_in_springs(x, x, x * x)]
library = "numba" not in sys.modules
others = [friction_limit(2, 2.0), stribeck_share(1.0, 3, 1.0), stored_in_springs(x[::-1], x, x * x)]
print(json.dumps([listed, others, library, "numba" in sys.modules]))
"""
LISTED, OTHERS = [0.25, 1.0 + 2.0 * 0.36787944117144233, 17.0], [4.0, 1.7357588823428847, 12.5]

needs_library = pytest.mark.skipif(hindrance() is not None, reason="no library is made here")
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """The sources, with a short list of entries."""
    folder = tmp_path_factory.mktemp("sources")
    for name in PARTS:
        shutil.copy(ROOT / name, folder)
    for name in ("src", "cases"):
        shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
    short = [entry for entry in entries.listed().entries if entry.name in KERNELS]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(entries, "LIST", folder / "src/asperity/kernels/native/entries.json")
        rows = [(entry.name, entry.arguments, entry.seconds) for entry in short]
        entries.write(rows, {"slide": range(len(rows))})
    return folder


def made(sources, out, kind="wheel", **variables):
    """Make a wheel, or an sdist; return its name and what was said."""
    program = f"import sys, hatch_build; print(hatch_build.build_{kind}(sys.argv[1]))"
    environment = {name: os.environ[name] for name in os.environ if not name.startswith("ASPERITY")}
    environment["PYTHONPATH"] = os.pathsep.join([str(sources), str(sources / "src")])
    if "ASPERITY_CACHE" in os.environ:
        environment["ASPERITY_CACHE"] = os.environ["ASPERITY_CACHE"]
    done = subprocess.run(
        [sys.executable, "-c", program, str(out)],
        env=environment | variables,
        cwd=sources,
        capture_output=True,
        text=True,
        check=False,
    )
    files = [file.name for pattern in ("*.whl", "*.tar.gz") for file in out.glob(pattern)]
    return done.returncode, files, done.stdout + done.stderr


@pytest.fixture(scope="module")
def wheel(sources, tmp_path_factory):
    out = tmp_path_factory.mktemp("wheel")
    code, wheels, said = made(sources, out)
    assert (code, wheels) == (0, [PLAIN]), said
    assert "no library" not in said
    return out / PLAIN


@pytest.fixture
def installed(wheel, tmp_path):
    """The folder of a wheel's files."""
    with zipfile.ZipFile(wheel) as files:
        files.extractall(tmp_path)
    return tmp_path


def called(folder, **variables):
    """What `PROGRAM` prints, and what it says on standard error."""
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        env=os.environ | {"PYTHONPATH": str(folder), "ASPERITY_NATIVE": "1"} | variables,
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout), done.stderr


def rewritten(folder, **changed):
    """Change rows of the table as who builds it would."""
    table.write(folder, table.read(folder) | changed)


@needs_library
def test_a_wheel_answers_without_numba_and_others_types_with_it(installed, tmp_path):
    answers, said = called(installed, ASPERITY_CACHE=str(tmp_path / "empty"))
    assert (answers, said) == ([LISTED, OTHERS, True, True], "")


@needs_library
def test_a_wheel_is_for_who_it_says(wheel):
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        told = files.read("asperity-0.1.0.dist-info/WHEEL").decode()
    made = "asperity/kernels/native/made"
    assert {f"{made}/{name}" for name in (table.LIBRARY, table.TABLE)} < {*names}
    assert not [name for name in names if name.endswith((".o", ".pyc"))]
    assert "Root-Is-Purelib: false" in told
    assert "Tag: py3-none-linux_x86_64" in told


def truncated(folder):
    file = folder / table.LIBRARY
    file.write_bytes(file.read_bytes()[:-100])


def table_damaged(folder):
    file = folder / table.TABLE
    file.write_bytes(file.read_bytes().replace(b"asperity_", b"asperity-", 1))


def another_processor(folder):
    rewritten(folder, features=["a-processor-of-tomorrow"])


def another_platform(folder):
    rewritten(folder, target="riscv64-linux")


def gone(folder):
    shutil.rmtree(folder)


@needs_library
@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (truncated, f"{table.LIBRARY} is damaged: kernels are compiled instead; install"),
        (table_damaged, f"{table.TABLE} is damaged: kernels are compiled instead; install"),
        (another_processor, ""),
        (another_platform, ""),
        (gone, ""),
    ],
)
def test_where_the_library_does_not_fit_answers_are_the_same(installed, damage, told):
    damage(installed / "asperity/kernels/native/made")
    (listed, others, *_), said = called(installed)
    assert (listed, others) == (LISTED, OTHERS)
    assert (told in said, said.count("\n")) == (True, bool(told)), said


@needs_library
def test_a_changed_source_is_answered_by_what_it_says_now(installed):
    source = installed / "asperity/slider/pressed.py"
    text = source.read_text("utf-8")
    source.write_text(text.replace("return load**power", "return load**power + 1.0"), "utf-8")
    (listed, others, *_), said = called(installed)
    assert listed == [LISTED[0] + 1.0, *LISTED[1:]]
    assert others == [OTHERS[0] + 1.0, *OTHERS[1:]]
    assert not said


def broken(folder):
    program = folder / "cc"
    program.write_text("#!/bin/sh\necho cannot find -lm >&2\nexit 1\n", "utf-8")
    program.chmod(0o755)
    return str(program)


@pytest.mark.parametrize(
    ("variables", "told"),
    [
        ({"ASPERITY_LIBRARY": "0"}, ""),
        ({"CC": "no-such-compiler"}, "no library of kernels: no C compiler is found"),
        ({"CC": "BROKEN"}, "the C compiler does not link: cannot find -lm"),
    ],
    ids=["not wanted", "no compiler", "a broken compiler"],
)
def test_without_a_library_a_wheel_is_for_all_and_says_why(sources, tmp_path, variables, told):
    variables = {
        name: value.replace("BROKEN", broken(tmp_path)) for name, value in variables.items()
    }
    code, wheels, said = made(sources, tmp_path, **variables)
    assert (code, wheels) == (0, [ANY])
    assert told in said
    assert said.count("no library") == bool(told)


def test_a_library_that_must_be_there_and_cannot_be_is_an_error(sources, tmp_path):
    code, wheels, said = made(sources, tmp_path, ASPERITY_LIBRARY="1", CC="no-such-compiler")
    assert (code != 0, wheels) == (True, [])
    assert said.splitlines()[-1].endswith("or what CC names)")


@pytest.fixture(scope="module")
def unpacked(sources, tmp_path_factory):
    """The sources as who downloads them has them."""
    out = tmp_path_factory.mktemp("sdist")
    code, files, said = made(sources, out, "sdist", CC="no-such-compiler")
    assert (code, files) == (0, [SDIST]), said
    assert "no library" not in said
    with tarfile.open(out / SDIST) as packed:
        packed.extractall(out, filter="data")
    return out / SDIST.removesuffix(".tar.gz")


@needs_library
def test_of_an_sdist_a_wheel_with_a_library_is_made(unpacked, tmp_path):
    code, wheels, said = made(unpacked, tmp_path)
    assert (code, wheels) == (0, [PLAIN]), said
    assert "no library" not in said
    with zipfile.ZipFile(tmp_path / PLAIN) as files:
        files.extractall(tmp_path / "installed")
    answers, said = called(tmp_path / "installed", ASPERITY_CACHE=str(tmp_path / "empty"))
    assert (answers, said) == ([LISTED, OTHERS, True, True], "")


def test_of_an_sdist_without_a_compiler_a_wheel_for_all_is_made_and_says_why(
    sources, unpacked, tmp_path
):
    contents = []
    for origin in (sources, unpacked):
        out = tmp_path / origin.name
        out.mkdir()
        code, wheels, said = made(origin, out, CC="no-such-compiler")
        assert (code, wheels) == (0, [ANY]), said
        assert said.count("no library of kernels: no C compiler is found") == 1
        with zipfile.ZipFile(out / ANY) as files:
            contents.append({name: files.read(name) for name in files.namelist()})
    # The sdist lacks nothing.
    assert contents[0] == contents[1]


@pytest.mark.parametrize(("said", "needs_numba"), [("", True), ("0", False)])
def test_what_compiles_is_needed_only_where_a_wheel_gets_a_library(said, needs_numba, monkeypatch):
    monkeypatch.chdir(ROOT)
    monkeypatch.syspath_prepend(str(ROOT))
    import hatch_build

    monkeypatch.setenv("ASPERITY_LIBRARY", said)
    needed = " ".join(hatch_build.get_requires_for_build_wheel())
    assert ("numba" in needed) is (needs_numba and hindrance() is None)
    assert "numba" not in " ".join(hatch_build.get_requires_for_build_editable())


@pytest.mark.parametrize(("version", "target"), [("editable", "wheel"), ("standard", "sdist")])
def test_what_needs_no_library_makes_none(version, target, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT))
    import hatch_build

    def library(folder):
        raise AssertionError

    monkeypatch.setattr(hatch_build, "_library", library)
    hook = hatch_build.LibraryHook(str(ROOT), {}, None, None, "", target)
    data = {}
    hook.initialize(version, data)
    assert not data


@pytest.mark.parametrize(
    ("said", "words"),
    [("", ["cc"]), ("no-such-compiler", None), (f"{sys.executable} -B", [sys.executable, "-B"])],
)
def test_the_compiler_is_the_one_that_is_named(said, words, monkeypatch):
    monkeypatch.setenv("CC", said)
    if said or shutil.which("cc"):
        assert compiler() == words
