"""How large the parts of the house may be."""

from pathlib import Path

import pytest

import asperity

SOURCES = Path(asperity.__file__).parent
PAGE = SOURCES / "web/static"


def lines(paths):
    return {path.relative_to(SOURCES): path.read_text("utf-8").splitlines() for path in paths}


def test_no_module_is_longer_than_400_lines():
    assert not [name for name, text in lines(SOURCES.rglob("*.py")).items() if len(text) > 400]


@pytest.mark.parametrize("room", ["contact", "flanks"])
def test_a_folder_has_at_most_ten_entries(room):
    folders = [SOURCES / room, *(path for path in (SOURCES / room).rglob("*") if path.is_dir())]
    full = {
        folder.relative_to(SOURCES): entries
        for folder in folders
        if len(entries := [e.name for e in folder.iterdir() if not e.name.startswith("__")]) > 10
    }
    assert not full


def test_the_page_keeps_its_budget_of_python():
    # 1500 for what it does; a fifth more guards it against links, half requests and full disks, and
    # keeps what outlives a server.
    assert sum(map(len, lines((SOURCES / "web").glob("*.py")).values())) <= 1800


def test_no_script_of_the_page_is_longer_than_300_lines_or_wider_than_120():
    for name, text in lines((PAGE / "js").rglob("*.js")).items():
        assert len(text) <= 300, name
        assert max(map(len, text)) <= 120, name
