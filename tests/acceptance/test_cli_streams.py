"""Standard output and error that are full, closed or read no further; names a terminal obeys."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from apparatus.grid import slow

from asperity.files.shipped import shipped_cases

pytestmark = pytest.mark.skipif(os.name != "posix", reason="streams are closed by a shell")


GONE = "the current folder is no longer there; change to another, or name files in full\n"


@pytest.fixture
def shell(environment, tmp_path):
    """Run a command of the shell in which ``asperity`` is the command line."""

    def run(command):
        ended = subprocess.run(
            ["sh", "-c", f'asperity() {{ "{sys.executable}" -m asperity "$@"; }}\n{command}'],
            env=environment,
            cwd=tmp_path,
            capture_output=True,
            timeout=180,
            check=False,
        )
        return ended.returncode, ended.stdout.decode(), ended.stderr.decode()

    return run


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("command", ["cases --json", "cases", "--help", slow("rate gearset-3")])
@pytest.mark.parametrize(
    ("where", "why"),
    [(">&-", "it is closed"), pytest.param("> /dev/full", "no space left on device")],
)
def test_an_answer_that_cannot_be_printed_ends_with_2_and_a_line(shell, command, where, why):
    if "/dev/full" in where and not Path("/dev/full").exists():
        pytest.skip("there is no device that is always full")
    assert shell(f"asperity {command} {where}") == (
        2,
        "",
        f"standard output cannot be written: {why}\n",
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "code", "error"),
    [
        ("new slide --defaults", 2, GONE),
        ("new slide ../there.toml --defaults", 2, GONE),
        ('new slide "$there/my.toml" --defaults', 0, ""),
        ('check "$there/my.toml"', 0, ""),
        ("check my.toml", 2, "my.toml is neither a file nor a case that ships"),
    ],
)
def test_where_the_current_folder_is_gone_what_needs_it_says_so(
    shell, tmp_path, command, code, error
):
    if command.startswith("check"):
        shutil.copy(shipped_cases()["table-4.3"], tmp_path / "my.toml")
    gone = "there=$PWD; mkdir gone; cd gone; rmdir ../gone"
    ended, _, told = shell(f"{gone}; asperity {command}")
    assert ended == code
    assert told.startswith(error)
    assert told.count("\n") == bool(error)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "file"),
    [
        ("size --ratio 40 --output-torque '300 N m' --worm-speed '1500 rpm' --uncut", "size.json"),
        slow("compare gearset-2 gearset-3", "compare.json"),
    ],
)
def test_an_answer_that_nobody_reads_to_its_end_is_written_all_the_same(shell, command, file):
    code, output, _ = shell(f"asperity {command} --out out | head -c 0; cat out/{file}")
    assert code == 0
    assert json.loads(output)


IMPORTS = """
import signal, sys
from asperity.cli.main import main

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == sys.argv[1]:
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Finder())
main(sys.argv[2:])
"""


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(
    ("while_importing", "command"),
    [
        ("typer", "rate gearset-3"),
        slow("rich.panel", "--help"),
        slow("rich.panel", "rig --help"),
        slow("asperity.files.store", "cases"),
        ("asperity.casefile", "rig reduce run.nc"),
        slow("numpy", "rate gearset-3"),
    ],
)
def test_ctrl_c_at_any_import_ends_with_130_and_a_line(environment, while_importing, command):
    ended = subprocess.run(
        [sys.executable, "-c", IMPORTS, while_importing, *command.split()],
        env=environment, capture_output=True, text=True, timeout=180, check=False,
    )  # fmt: skip
    assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "interrupted\n")


@pytest.mark.slow
def test_without_standard_error_notes_do_not_spoil_the_answer(shell):
    code, output, errors = shell("asperity rate gearset-3 --json --out out 2>&-")
    assert (code, errors) == (0, "")
    assert json.loads(output)["name"] == "gearset 3"


@pytest.mark.slow
def test_a_name_is_shown_so_that_a_terminal_does_not_obey_it(shell):
    code, output, errors = shell("asperity slide \"$(printf 'a\\033[2J\\377')\"")
    assert (code, output) == (2, "")
    assert errors.startswith(r"a\x1b[2J\udcff is neither a file nor a case that ships")
    code, _, errors = shell("asperity \"$(printf -- '--a\\033[2J')\"")
    assert code == 2
    assert "\x1b" not in errors


@pytest.mark.slow
def test_a_case_whose_name_is_not_utf_8_is_solved(shell, tmp_path):
    name = os.fsdecode(b"caf\xe9.toml")
    (tmp_path / name).write_text(
        '[slider]\ndrive_velocity = "1 mm/s"\nnormal_force = "10 N"\n'
        '[friction]\nmodel = "coulomb"\nmu = 0.2\n'
        '[vibration]\nfrequency = "1 kHz"\nvelocity_ratio = 2\n'
        '[solve]\nmethod = "homogenised"\n'
    )
    code, output, errors = shell("asperity slide caf*.toml")
    assert (code, errors) == (0, "")
    assert output.startswith(r"caf\udce9.toml: homogenised")


@pytest.mark.slow
@pytest.mark.campaign(over="where")
@pytest.mark.parametrize("where", ["| true", ">&-", "> /dev/full"])
def test_no_file_is_lost_to_a_standard_output_that_takes_nothing(shell, tmp_path, where):
    settings = "--set solve.duration='20 ms' --set vibration.start='2 ms' --set solve.step='1 us'"
    shell(f"asperity slide table-4.3 {settings} --out out {where}")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "report.html",
        "slide.json",
        "slide.nc",
        "slide.png",
    }
