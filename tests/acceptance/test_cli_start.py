"""What a command loads before it answers: nothing heavy that its answer does not need."""

import io
import json
import pstats
import subprocess
import sys

import pytest
import typer
from observe import arguments

from asperity.cli.application import app
from asperity.cli.command_line import built
from asperity.commands import COMMANDS
from asperity.kernels.native import kept, load
from asperity.kernels.native.target import FEATURES

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
# One line of each other command that answers by itself, each in a process of its own. What solves
# many cases begins processes; what looks for a root or a least value needs SciPy's ways to it.
RATES, SOLVES = {"numpy", "pydantic"}, {"numpy", "pydantic", "scipy"}
MANY = {"multiprocessing"}
RECORDING = SOLVES | {"h5py"}
COMMANDS_ALONE = {
    "block block-transverse BLOCK --set solve.duration='3 ms'": SOLVES,
    "branches normal-pin --set vibration.frequency='1.7 kHz' --set vibration.elevation='90 deg' "
    "--over vibration.displacement_amplitude='0.2:0.5:0.1 um'": RATES | MANY,
    "control drive-actuator TEETH --set drive.stroke='16 deg' --set control.rise='1 ms' "
    "--set control.failures=dead": RATES,
    "crossed gearset-3": SOLVES,
    "directions drive-screw TEETH --set vibration.frequency='20 kHz' "
    "--set vibration.displacement_amplitude='5 um'": RATES | MANY,
    "drive drive-actuator TEETH": RATES,
    "fit RATIOS table-4.3 --free friction.max_deflection --law vector": SOLVES,
    "flank gearset-3b --density coarse --set gearset.flank=ZA": RATES,
    "locking drive-actuator TEETH": RATES | MANY,
    "misalign drive-screw --set drive.teeth=1 --set drive.phases=2 "
    "--over mount.axial_offset='-20,20 um' --over mount.shaft_angle_error='0,0.1 deg'": (
        SOLVES | MANY
    ),
    "optimise gearset-3": SOLVES,
    "relief drive-screw --set drive.teeth=1 --set drive.phases=2 "
    "--over modification.tip_relief='0,20 um'": SOLVES | MANY,
    "rexs gearset-3b": RATES,
    "rig check RECORDING": RECORDING,
    "rig import RECORDING rig-final": RECORDING,
    "rig plan rig-final": SOLVES,
    "rig reduce RECORDING --budget": RECORDING,
    "roots drive-screw --set drive.teeth=1 --set drive.phases=2": SOLVES | {"skfem"},
    "shafts actuator-shafts --set bearings.raises=clockwise": RATES,
    "slide RIGID": RATES,
    "slide normal-pin": RATES,
    "static normal-pin": RATES,
    "sweep table-4.4 --over vibration.direction='0 deg:90 deg:30 deg' "
    "--set solve.method=homogenised": SOLVES | MANY,
    "wear drive-screw --set drive.teeth=1 --set drive.phases=2 --revolutions 20": SOLVES,
}
# These work on the files of a run of the rig, or run it; `rig check` reads one like them.
NOT_ALONE = {"rig look", "rig package", "rig report", "rig run"}
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


ALONE = """
import contextlib, io, json, sys
from asperity.cli.main import main
with contextlib.redirect_stdout(io.StringIO()):
    try:
        main(sys.argv[1:])
    except SystemExit as end:
        assert not end.code, end.code
print(json.dumps(sorted(sys.modules)))
"""


@pytest.mark.slow
@pytest.mark.skipif(
    not load.is_for_here(kept._MADE_HERE, FEATURES), reason="kernels are Numba's on this machine"
)
@pytest.mark.parametrize("line", COMMANDS_ALONE)
def test_a_command_alone_loads_nothing_heavy_that_it_does_not_need(line, tmp_path, monkeypatch):
    monkeypatch.delenv("ASPERITY_NATIVE", raising=False)
    done = subprocess.run(
        [sys.executable, "-c", ALONE, *arguments(line, tmp_path)],
        capture_output=True,
        text=True,
        check=True,
    )
    assert (
        HEAVY & {name.partition(".")[0] for name in json.loads(done.stdout)}
        == (COMMANDS_ALONE[line])
    )


def test_of_every_command_it_is_known_what_it_loads():
    lines = [*COMMANDS_ALONE, *(line for row in ROWS for line in row)]
    known = {
        each.name
        for each in COMMANDS
        if any(f"{line} ".startswith(f"{each.name} ") for line in lines)
    }
    assert {each.name for each in COMMANDS} - known == NOT_ALONE


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
