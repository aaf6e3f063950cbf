"""What a page may ask: every file that any table names is confined, and commands as they are."""

import shlex
from pathlib import Path

import pytest

from asperity.casefile import Case, names_file
from asperity.commands import COMMANDS, case_tables
from asperity.errors import InputError
from asperity.web.ask import confine, request_of
from asperity.web.folder import Folder

FILES = [
    (name, key)
    for name, model in case_tables().items()
    for key in model.model_fields
    if names_file(model, key)
]


@pytest.fixture
def folder(tmp_path):
    made = Folder(tmp_path / "folder")
    made.path.mkdir()
    return made


def case_of(folder, name, key, path, **settings):
    table = case_tables()[name].model_construct(**{key: path})
    return Case("case", folder, {name: table}, {}, case_tables(), settings)


def test_there_are_tables_that_name_files():
    assert {("vibration", "samples"), ("rating", "bs721_tables")} <= {*FILES}


@pytest.mark.parametrize(("name", "key"), FILES)
def test_every_file_that_any_table_names_lies_in_the_folder(folder, tmp_path, name, key):
    (folder.path / "link").symlink_to(tmp_path)
    for outside in ("../x", "/etc/passwd", "a/../../x", "link/x", tmp_path / "x"):
        for value in (Path(outside), [Path(outside)], {"one": (Path(outside),)}):
            with pytest.raises(InputError, match="outside the folder"):
                confine(case_of(folder.path, name, key, value), folder)
    confine(case_of(folder.path, name, key, Path("a/../inside.csv")), folder)


@pytest.mark.parametrize(("name", "key"), FILES)
def test_a_case_that_ships_brings_its_own_files_and_no_setting_adds_one(
    folder, tmp_path, name, key
):
    ships = tmp_path / "cases"
    confine(case_of(ships, name, key, Path("own.csv")), folder)
    with pytest.raises(InputError, match="outside the folder"):
        confine(case_of(ships, name, key, Path("own.csv"), **{f"{name}.{key}": "set"}), folder)


@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command.name)
def test_every_command_can_be_asked_and_says_how_on_a_terminal(folder, command):
    arguments = {a.name: ["a.nc", "b.nc"] if a.many else "a.csv" for a in command.arguments}
    options = {
        option.name: ["x=1"] if option.many else "x" if option.metavar else True
        for option in command.options
        if option.name not in ("cluster", "acknowledge", "backend")
    }
    body = {"command": command.name, "arguments": arguments, "options": options}
    if command.case:
        body["case"] = "table-4.3"
    asked = request_of(body, folder)
    assert asked.given == arguments | options
    words = shlex.split(asked.line)
    assert words[: 1 + len(command.name.split())] == ["asperity", *command.name.split()]
    assert {f"--{name}" for name in options} <= {*words}
    with pytest.raises(InputError, match="none of the options"):
        request_of({**body, "options": {**options, "no-such": "x"}}, folder)
    for name, option in ((o.name, o) for o in command.options if o.name in options):
        with pytest.raises(InputError, match=f"{name} is 5"):
            request_of({**body, "options": {**options, name: 5}}, folder)
        if option.default is None:
            left = {key: value for key, value in options.items() if key != name}
            with pytest.raises(InputError, match=f"needs {name}"):
                request_of({**body, "options": left}, folder)


def asked_key(folder, command, **body):
    return request_of({"command": command, **body}, folder).key(None)


def test_what_lies_beside_recordings_is_part_of_what_is_asked(folder):
    run = folder.path / "run"
    run.mkdir()
    (run / "file-01.nc").write_bytes(b"recorded")
    (run / "journal.jsonl").write_text("{}\n")
    before = asked_key(folder, "rig report", arguments={"folder": str(run)})
    assert asked_key(folder, "rig report", arguments={"folder": str(run)}) == before
    (run / "journal.jsonl").write_text('{}\n{"kind": "weighed"}\n')
    assert asked_key(folder, "rig report", arguments={"folder": str(run)}) != before


def test_data_files_of_ones_own_are_part_of_what_is_asked(folder, tmp_path, monkeypatch):
    file = tmp_path / "mine.toml"
    keys = set()
    monkeypatch.setenv("ASPERITY_MATERIALS", str(file))
    for text in ("", "# of another week\n"):
        file.write_text(text)
        keys.add(asked_key(folder, "rate", case="gearset-2"))
    assert len(keys) == 2
