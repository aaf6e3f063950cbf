"""What README and the page on case files say is what happens."""

import re
import shlex
import tomllib
from pathlib import Path

import matplotlib
import pytest
from apparatus.grid import slow

from asperity.casefile.schema import keys_of
from asperity.commands import GROUPS, case_tables
from asperity.store import read_dataset
from asperity.units import quantity_of

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PROGRAM = ".venv/bin/asperity "


def blocks(language):
    every = re.findall(r"^```(\w*)\n(.*?)^```$", README, re.MULTILINE | re.DOTALL)
    return [block for written, block in every if written == language]


COMMANDS = [
    line.removeprefix(PROGRAM)
    for block in blocks("")
    for line in block.replace("\\\n", "").splitlines()
    if line.startswith(PROGRAM)
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Where the README's commands are run, one after the other, as a reader would."""
    return tmp_path_factory.mktemp("reader")


def test_the_python_block_runs_and_comes_to_its_numbers(tmp_path, monkeypatch, capsys):
    (block,) = blocks("python")
    monkeypatch.chdir(tmp_path)
    names = {}
    with matplotlib.rc_context({"backend": "agg"}):
        exec(compile(block, "README.md", "exec"), names)
    assert names["result"].ratio == pytest.approx(0.1370, rel=1e-3)
    assert (tmp_path / "slide.png").read_bytes().startswith(b"\x89PNG")
    # At the drive velocity the law is what is left of the drive force.
    assert names["law"](0.5e-3) == pytest.approx(names["result"].drive_force, rel=1e-3)
    said = capsys.readouterr().out
    assert "does not hold by ISO/TR 14521" in said
    assert str(names["result"].ratio) in said


def test_the_case_file_works_as_it_stands(asperity, tmp_path):
    (block,) = blocks("toml")
    assert tomllib.loads(block).keys() == {"slider", "friction", "vibration", "solve"}
    (tmp_path / "own.toml").write_text(block, "utf-8")
    code, output, errors = asperity("slide", "own.toml", cwd=tmp_path)
    assert (code, errors) == (0, "")
    assert re.search(r"^mean drive force over mu F_N .* 0\.1\d+", output, re.MULTILINE)


def test_the_readme_has_the_commands_below():
    assert {command.split()[0] for command in COMMANDS} >= {"slide", "sweep"}


@pytest.mark.parametrize(
    "command",
    [
        slow(line) if re.match("block|optimise|flank|drive|directions|locking", line) else line
        for line in COMMANDS
    ],
)
def test_each_command_runs(asperity, folder, command):
    arguments = shlex.split(command)
    code, output, errors = asperity(*arguments, cwd=folder)
    assert code == 0, errors
    assert output
    if "--out" in arguments:
        out = folder / arguments[arguments.index("--out") + 1]
        if arguments[0] == "export":
            assert (out / "block.inp").read_text("utf-8").startswith("*HEADING")
        else:
            name = arguments[1] if arguments[0] in GROUPS else arguments[0]
            assert read_dataset(out / f"{name}.nc").attrs


def test_each_target_of_make_that_the_readme_names_exists():
    rules = (ROOT / "Makefile").read_text("utf-8")
    targets = set(re.findall(r"^make (\w+)|`make (\w+)`", README, re.MULTILINE))
    named = {name for pair in targets for name in pair if name}
    assert named >= {"run", "test"}
    assert named <= set(re.findall(r"^(\w+):", rules, re.MULTILINE))


def test_each_file_that_the_readme_names_exists():
    named = re.findall(r"\]\(([\w./-]+)\)|`?((?:docs|examples)/[\w.-]+\.py)", README)
    for name in {name for pair in named for name in pair if name}:
        assert (ROOT / name).is_file(), name


@pytest.mark.parametrize("name", case_tables())
def test_the_default_that_a_key_is_said_to_have_is_its_default(name):
    model = case_tables()[name]
    for key in keys_of(model):
        field, quantity = model.model_fields[key.name], quantity_of(model, key.name)
        assert (key.default == "required") == field.is_required()
        if quantity is not None and quantity.unit and isinstance(field.default, float):
            assert quantity.check(key.default, text_only=True) == field.default
