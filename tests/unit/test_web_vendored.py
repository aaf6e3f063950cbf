"""What is brought along from others is what VENDORED.toml says, with its licences."""

import hashlib
import re
import tomllib
from pathlib import Path

import pytest

import asperity

PAGE = Path(asperity.__file__).parent / "web/static/vendor"
TESTS = Path(__file__).parents[1] / "browser/vendor"
# `import ... from "x"`, also over several lines; what is loaded later is `import("x")`.
IMPORTS = re.compile(r"""^(?:import|export)\b[^;]*?from "([^"]+)";""", re.MULTILINE)


@pytest.mark.parametrize("folder", [PAGE, TESTS], ids=["page", "tests"])
def test_every_vendored_file_is_listed_unchanged_and_has_its_licence(folder):
    listed = tomllib.loads((folder / "VENDORED.toml").read_text("utf-8"))
    there = {path.name for path in folder.iterdir() if path.suffix in (".js", ".css")}
    assert set(listed) == there
    for name, entry in listed.items():
        assert hashlib.sha256((folder / name).read_bytes()).hexdigest() == entry["sha256"], name
        for package in entry["packages"]:
            assert package["version"]
            assert package["licence"] in ("MIT", "Apache-2.0", "MPL-2.0")
            assert len((folder / package["text"]).read_text("utf-8")) > 500


def loaded(module, known):
    """Add a module and all that it imports without being asked to what is known."""
    if module not in known:
        known.add(module)
        for name in IMPORTS.findall(module.read_text("utf-8")):
            loaded((module.parent / name).resolve(), known)
    return known


def test_a_screen_takes_at_most_200_kb_and_what_draws_in_space_580_more():
    static = PAGE.parent
    size = {
        path.resolve(): path.stat().st_size
        for path in static.rglob("*")
        if path.suffix in (".js", ".css", ".html", ".svg")
    }
    page = {path for path in size if path.suffix != ".js"}
    shell = loaded(static.resolve() / "js/main.js", set())
    in_space = {path for path in size if path.name in ("scene.js", "three.js")}
    for screen in (static.resolve() / "js/screens").glob("*.js"):
        seen = page | loaded(screen, set(shell))
        assert len(seen) > len(page) + 10, screen.name
        assert sum(size[path] for path in seen - in_space) <= 200_000, screen.name
    # What draws in space is loaded by the one screen that does.
    assert sum(size[path] for path in in_space) <= 580_000


def test_all_that_the_page_begins_with_is_asked_for_at_once():
    static = PAGE.parent.resolve()
    begins = loaded(static / "js/main.js", set())
    text = (static / "index.html").read_text("utf-8")
    told = re.findall(r'<link rel="modulepreload" href="([^"]+)">', text)
    assert {static / name for name in [*told, "js/main.js"]} == begins


def test_the_modules_of_the_page_are_short_and_so_are_their_lines():
    for path in (PAGE.parent / "js").rglob("*.js"):
        lines = path.read_text("utf-8").splitlines()
        assert len(lines) <= 300, path.name
        assert max(map(len, lines)) <= 120, path.name
