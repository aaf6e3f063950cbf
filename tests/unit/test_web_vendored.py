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


SHOWN = PAGE.parent / "shown"
OPENS_WITH = {
    "slide": ("live/slide.json", "live/slide-curve.json"),
    "sweep": ("sweep", "live/slide.json"),
    "block": ("block-settled", "block-march"),
    "gear": ("live/rate.json",),
    "size": ("optimise", "live/size.json"),
    "flanks": ("flank",),
    "drive": ("drive", "drive-static", "directions", "locking", "live/drive-rate.json"),
    "rig": ("rig-reduce", "fit"),
    "thesis": ("thesis",),
}
"""Answers that ship, by the screens that open with them."""

# The page comes from the machine itself, or through a tunnel from another one, of 10 Mbit/s at the
# least: 1.25 MB a second. What is bounded is what somebody waits for. A screen: its modules, styles
# and frame are there in 0.16 s, and in 0.5 s more what draws in space; the answer that it opens
# with in a third of a second, the flanks' in a little over one. All of it: who opens every screen
# loads each file once, 0.8 s of waiting in all. A further screen takes its share of that.
SCREEN, IN_SPACE, ANSWER, FLANKS, ALL = 200_000, 580_000, 400_000, 1_400_000, 1_000_000


def sizes():
    """Return the size of all code of the page by its path: modules, styles, frame."""
    return {
        path.resolve(): path.stat().st_size
        for path in PAGE.parent.rglob("*")
        if path.suffix in (".js", ".css", ".html", ".svg")
    }


def test_nobody_waits_for_more_than_a_screen_needs_nor_for_much_in_all():
    static, size = PAGE.parent.resolve(), sizes()
    page = {path for path in size if path.suffix != ".js"}
    shell = loaded(static / "js/main.js", set())
    in_space = {path for path in size if path.name in ("scene.js", "three.js")}
    for screen in (static / "js/screens").glob("*.js"):
        seen = page | loaded(screen, set(shell))
        assert len(seen) > len(page) + 10, screen.name
        assert sum(size[path] for path in seen - in_space) <= SCREEN, screen.name
    # What draws in space is loaded by the one screen that does.
    assert sum(size[path] for path in in_space) <= IN_SPACE
    assert sum(size.values()) <= ALL


def test_the_answers_that_a_screen_opens_with_are_there_in_a_moment():
    used = set()
    for screen, names in OPENS_WITH.items():
        paths = [path for name in names for path in (SHOWN / name, *(SHOWN / name).rglob("*"))]
        files = {path for path in paths if path.is_file()}
        used |= files
        most = FLANKS if screen == "flanks" else ANSWER
        assert 1_000 < sum(path.stat().st_size for path in files) <= most, screen
    others = {path for path in SHOWN.rglob("*") if path.is_file()} - used
    assert {path.name for path in others} == {"index.json"}


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
