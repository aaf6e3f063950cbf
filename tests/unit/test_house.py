"""How large the parts of the house may be, and what they say of themselves."""

import ast
import pkgutil
import re
from pathlib import Path

import pytest

import asperity
from asperity.commands import case_tables

SOURCES = Path(asperity.__file__).parent
TESTS = Path(__file__).parents[1]
PAGE = SOURCES / "web/static"


def lines(paths):
    return {path.relative_to(SOURCES): path.read_text("utf-8").splitlines() for path in paths}


def test_no_module_is_longer_than_400_lines():
    assert not [name for name, text in lines(SOURCES.rglob("*.py")).items() if len(text) > 400]


@pytest.mark.parametrize("room", ["contact", "flanks"])
def test_a_folder_has_at_most_ten_entries(room):
    inner = (path for path in (SOURCES / room).rglob("*") if path.is_dir())
    folders = [SOURCES / room, *(path for path in inner if path.name != "__pycache__")]
    full = {
        folder.relative_to(SOURCES): entries
        for folder in folders
        if len(entries := [e.name for e in folder.iterdir() if not e.name.startswith("__")]) > 10
    }
    assert not full


def test_the_page_keeps_its_budget_of_python():
    # 1500 for what it does; a fifth more guards it against links, half requests and full disks, and
    # keeps what outlives a server.
    assert sum(map(len, lines((SOURCES / "web").glob("[a-z]*.py")).values())) <= 1800


def test_no_script_of_the_page_is_longer_than_300_lines_or_wider_than_120():
    for name, text in lines((PAGE / "js").rglob("*.js")).items():
        assert len(text) <= 300, name
        assert max(map(len, text)) <= 120, name


# What stands at the door of a room, under these heads.
HEADS = ("Entry", "Data", "Where", "Tests")
ROOMS = sorted(path.parent.name for path in SOURCES.glob("*/__init__.py"))


def door(room):
    """What a room says under each head: (text, names in backquotes)."""
    text = ast.get_docstring(ast.parse((SOURCES / room / "__init__.py").read_text("utf-8")))
    found = re.findall(
        rf"^:({'|'.join(HEADS)}): ((?:.+\n?)+?)(?=^:\w+: |^$|\Z)", text, re.MULTILINE
    )
    return {head: re.findall("`([^`]+)`", said) for head, said in found}


def stands(room, name):
    """Whether a name in backquotes is a module or folder of a room, or something in one."""
    steps = re.split(r"[./]", name.removeprefix("asperity."))
    place = SOURCES if name.startswith("asperity.") else SOURCES / room
    if "/" in name:
        return (place / name).exists()
    parts = ".".join(["asperity", *place.relative_to(SOURCES).parts, *steps])
    try:
        pkgutil.resolve_name(parts)
    except (ImportError, AttributeError):
        return place.joinpath(*steps).is_dir()
    return True


def is_data(room, name):
    """Whether a name is a table of a case, a file of a room or of the checkout, or a module."""
    if name.startswith("["):
        return name.strip("[]") in case_tables()
    folders = SOURCES / room, SOURCES.parents[1]
    return stands(room, name) or any([*folder.glob(name)] for folder in folders)


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_says_it_in_ten_lines(room):
    text = ast.get_docstring(ast.parse((SOURCES / room / "__init__.py").read_text("utf-8")))
    listed = text[text.index(":Entry:") :].partition("\n\n")[0]
    assert len(listed.splitlines()) < 10
    assert text.splitlines()[1] == ""  # below the line that says what it is for


@pytest.mark.parametrize("room", ROOMS)
def test_a_room_says_at_its_door_what_stands_where(room):
    said = door(room)
    assert tuple(said) == HEADS
    names = {*said["Entry"], *said["Where"]}
    wrong = [n for n in names if not re.match(r"asperity( |$)", n) and not stands(room, n)]
    assert not wrong
    assert not [name for name in said["Data"] if not is_data(room, name)]
    for pattern in said["Tests"]:
        found = pattern.rstrip("/") if pattern.endswith("/") else f"{pattern}.py"
        assert [*TESTS.glob(found)], pattern
