"""What a command loads before it answers: nothing heavy that its answer does not need."""

import io
import json
import pstats
import subprocess
import sys

import pytest
import typer

from asperity.cli.application import app
from asperity.cli.command_line import built
from asperity.commands import COMMANDS

HEAVY = {
    "h5netcdf", "h5py", "jinja2", "llvmlite", "markdown_it", "matplotlib", "multiprocessing",
    "numba", "numpy", "pandas", "pint", "pydantic", "pygments", "rich", "scipy", "skfem",
    "starlette", "uvicorn", "xarray",
}  # fmt: skip
# Numba loads some of these for itself, where it is needed.
WITH_KERNELS = {"numpy", "pydantic", "numba", "llvmlite", "scipy"}
RATED = {"numpy", "pydantic"}
# Those of a row in one process: what one has loaded is there for those behind it.
ROWS = (
    {
        "cases": set(),
        "cases table-4.3": set(),
        "cache": set(),
        "cache --json": set(),
        "--version": set(),
        "rig --help": {"rich"},
        "--help": {"rich"},
        "materials": {"rich", *RATED},
        "new gear FOLDER/mine.toml --defaults": {"rich", *RATED},
        "schema": {"rich", *RATED},
        "rate gearset-3": {"rich", *RATED},
        "compare gearset-2 gearset-3": {"rich", *RATED},
        "size --ratio 40 --output-torque '300 N m' --worm-speed '1500 rpm' --uncut": {
            "rich", *RATED
        },
        "check table-4.3": {"rich", *RATED},
        "sensitivity gearset-3": {"rich", *RATED},
        "methods gearset-3": {"rich", "scipy", *RATED},
    },
    {
        "slide table-4.3 --set 'solve.duration=20 ms' --set 'vibration.start=2 ms'": WITH_KERNELS,
        "flank gearset-3 --density coarse": WITH_KERNELS,
    },
)  # fmt: skip
PROGRAM = """
import contextlib, io, json, shlex, sys
from asperity.cli.main import main
for line in sys.argv[2:]:
    with contextlib.redirect_stdout(io.StringIO()):
        try:
            main(shlex.split(line.replace("FOLDER", sys.argv[1])))
        except SystemExit as end:
            assert not end.code, (line, end.code)
    print(json.dumps(sorted(sys.modules)))
"""


@pytest.mark.parametrize("row", ROWS, ids=["light", "kernels"])
def test_a_command_loads_nothing_heavy_that_it_does_not_need(row, tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, tmp_path, *row], capture_output=True, text=True, check=True
    )
    for (line, allowed), loaded in zip(row.items(), done.stdout.splitlines(), strict=True):
        found = {name.partition(".")[0] for name in json.loads(loaded)}
        assert HEAVY & found <= allowed, line
        # Of SciPy these take longer than all of a rating.
        assert not {"scipy.optimize", "scipy.interpolate"} & {*json.loads(loaded)}


def _helps(command, name):
    context = typer.Context(command, info_name=name)
    with io.StringIO() as out, pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "stdout", out)
        command.get_help(context)
        return out.getvalue()


def test_a_command_that_is_made_alone_helps_as_among_all():
    everything = built(app).commands
    asked = {command.name.split()[0] for command in COMMANDS} | {"cases", "check", "thesis"}
    for name in sorted(asked):
        alone = built(app, ["--materials", "mine.toml", name, "--json"]).commands
        assert [*alone] == [name]
        assert _helps(alone[name], name) == _helps(everything[name], name) != ""


@pytest.mark.parametrize("words", [[], ["--help"], ["rat"], ["--nothing", "rate"], ["--", "rate"]])
def test_where_no_command_is_named_all_are_made(words):
    assert {"rate", "cases", "rig", "thesis"} <= set(built(app, words).commands)


def test_a_data_file_of_plastics_is_begun_and_listed(asperity, tmp_path):
    file = str(tmp_path / "pom.toml")
    assert asperity("new", "plastic", file)[0] == 0
    assert "my POM" in asperity("--materials", file, "materials")[1]
    code, _, errors = asperity("new", "plastic", file)
    assert code == 2
    assert "is there already" in errors
    code, _, errors = asperity("new", "plastic", str(tmp_path / "other.toml"), "--ratio", "4")
    assert code == 2
    assert "a data file of plastics has none" in errors


def test_what_a_drive_begins_with_and_nobody_gave_is_said_to_be_assumed(asperity, tmp_path):
    assumed = "shaft.torsional_stiffness", "drive.worm_mass"
    file = tmp_path / "mine.toml"
    code, out, _ = asperity("new", "drive", str(file), "--defaults")
    assert code == 0
    comments = file.read_text().replace("\n#  ", "").split("\n\n")
    for path in assumed:
        key = path.partition(".")[2]
        assert f"{path} = " in out
        (own,) = (part for part in comments if f"\n{key} = " in part)
        assert "Assumed: give that of your" in own
    assert "friction.max_deflection = 70 nm: " in out
    # With --defaults nothing is asked, so that all that would be is an example as well.
    (examples,) = (
        line for line in out.splitlines() if "and examples, as nothing was asked" in line
    )
    for path in ("drive.load_inertia", "drive.worm_inertia", "friction.mu", "vibration.frequency"):
        assert path in examples
    assert "shaft." not in examples
    # The diameter over the span says it as well.
    other = tmp_path / "other.toml"
    given = "--set=shaft.diameter=30 mm", "--set=shaft.span=150 mm", "--set=drive.worm_mass=1 kg"
    code, out, _ = asperity("new", "drive", str(other), "--defaults", *given)
    assert code == 0
    assert not any(path in out for path in assumed)
    code, out, _ = asperity(
        "new", "drive", str(tmp_path / "third.toml"), "--defaults", "--set=friction.mu=0.04"
    )
    assert "drive.load_inertia" in out
    assert "friction.mu" not in out
    assert "\n#torsional_stiffness" in other.read_text()
    assert 'worm_mass = "1 kg"\n' in other.read_text()


AT_THE_END = """
import atexit, sys, threading
from asperity.cli.main import program
sys.argv = ["asperity", *sys.argv[1:]]
atexit.register(print, "at the end")
HERE
program()
"""
LATER = "threading.Thread(target=lambda: (threading.main_thread().join(), print('later'))).start()"


@pytest.mark.parametrize(("here", "said"), [("", []), (LATER, ["later"])], ids=["alone", "thread"])
def test_what_is_to_be_done_at_the_end_is_done_and_threads_are_waited_for(here, said):
    words = [sys.executable, "-c", AT_THE_END.replace("HERE", here)]
    done = subprocess.run([*words, "--version"], capture_output=True, text=True, check=True)
    version, *others = done.stdout.splitlines()
    assert version.startswith("asperity ")
    assert others == [*said, "at the end"]
    wrong = subprocess.run([*words, "rate", "nowhere"], capture_output=True, text=True)
    assert wrong.returncode == 2
    assert wrong.stdout.splitlines() == [*said, "at the end"]


def test_a_profile_of_a_command_is_written(tmp_path):
    words = [sys.executable, "-m", "cProfile", "-o", tmp_path / "seen", "-m", "asperity", "cases"]
    subprocess.run(words, check=True, capture_output=True)
    assert pstats.Stats(str(tmp_path / "seen")).total_calls > 1000
