"""What README and the page on case files say is what happens."""

import re
import shlex
import tomllib
from pathlib import Path

import matplotlib
import pytest

from asperity.casefile.schema import keys_of
from asperity.commands import GROUPS, case_tables
from asperity.files.store import read_dataset
from asperity.units import quantity_of

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text("utf-8")
PROGRAM = "asperity "
# What a reader's first command on elastic teeth condenses is proven where drives are.
TEETH = [
    *("--set", 'drive.deflection=[["23 N m", "47.6 urad"], ["366 N m", "365 urad"]]'),
    *("--set", "drive.effective_radius=9.35 mm"),
    *("--set", "drive.tangential_compliance=2.9 nm/N"),
]


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
    assert {command.split()[0] for command in COMMANDS} == {
        "new", "rate", "slide", "sweep", "drive", "directions", "rig",
    }  # fmt: skip


@pytest.fixture(scope="module")
def outputs(asperity, folder):
    """What each command printed."""
    printed = {}
    for command in COMMANDS:
        arguments = shlex.split(command)
        teeth = TEETH if arguments[0] in ("drive", "directions") else []
        code, output, errors = asperity(*arguments, *teeth, cwd=folder)
        assert code == 0, (command, errors)
        printed[command] = output
    return printed


@pytest.mark.slow
def test_each_command_answers_and_writes_what_it_is_asked_to(outputs, folder):
    for command, output in outputs.items():
        assert output
        arguments = shlex.split(command)
        if "--out" in arguments:
            out = folder / arguments[arguments.index("--out") + 1]
            name = arguments[1] if arguments[0] in GROUPS else arguments[0]
            assert read_dataset(out / f"{name}.nc").attrs


@pytest.mark.slow
def test_what_the_readme_shows_is_what_is_printed(outputs):
    printed = {" ".join(line.split()) for text in outputs.values() for line in text.splitlines()}
    for block in blocks("text"):
        assert {" ".join(line.split()) for line in block.splitlines()} <= printed


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
