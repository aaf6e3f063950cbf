"""The walks of docs/built.rst: their names exist, and what is asked arrives where they say."""

import importlib.util
import pkgutil
import re
import shlex
import sys
from pathlib import Path

import pytest

import asperity
from asperity.casefile import read_case
from asperity.commands import COMMANDS, case_tables
from asperity.drive.problem import DriveProblem
from asperity.rating.tables import operation_of
from asperity.tribometer.options import Plan

PACKAGE = Path(asperity.__file__).parent
DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "built.rst").read_text("utf-8")
PAGES = [*sorted(DOCS.glob("*.rst")), *(DOCS.parent / n for n in ("README.md", "CONTRIBUTING.md"))]
COMMAND_NAMES = {command.name for command in COMMANDS} | {"page"}


@pytest.fixture(scope="module")
def drawing():
    sys.path.insert(0, str(DOCS))
    try:
        pytest.importorskip("grimp")
        spec = importlib.util.spec_from_file_location("draw_walks", DOCS / "draw_walks.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
    finally:
        sys.path.remove(str(DOCS))
    return module


def sections():
    parts = re.split(r"^(.+)\n~{3,}\n", TEXT[TEXT.index("Five walks") :], flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2], strict=True))


def names(body):
    return [" ".join(name.split()) for name in re.findall(r"``([^`]+)``", body)]


def exists(name):
    """Whether a name is something of the package, a file, a table or key, or a command."""
    if name.startswith("asperity "):
        words = shlex.split(name)[1:]
        return bool({words[0], " ".join(words[:2])} & COMMAND_NAMES)
    if (PACKAGE / name).exists() or (DOCS.parent / name).exists():
        return True
    table, _, key = name.strip("[]").partition(".")
    if table in case_tables() and (not key or key in case_tables()[table].model_fields):
        return True
    owner, _, last = name.rpartition(".")
    for place in (f"asperity.{name}", f"asperity.{owner}"):
        try:
            found = pkgutil.resolve_name(place)
        except (ImportError, AttributeError, ValueError):
            continue
        if place.endswith(name) or last in getattr(found, "__annotations__", ()):
            return True
    return last == "useLive" and "function useLive(" in (
        PACKAGE / "web/static/js/api.js"
    ).read_text("utf-8")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_dotted_name_of_a_page_exists(page):
    found = {*re.findall(r"`~?asperity\.([a-z]\w*(?:\.\w+)+)[`(]", page.read_text("utf-8"))}
    assert sorted(name for name in found if not exists(name)) == []


def test_there_are_five_walks_of_at_least_six_steps(drawing):
    walks = drawing.walks(TEXT)
    assert [walk.title for walk in walks] == [*sections()]
    assert len(walks) == 5
    assert all(len(walk.steps) >= 6 for walk in walks)


@pytest.mark.parametrize("title", sections())
def test_every_name_of_a_walk_exists(title):
    assert [name for name in names(sections()[title]) if not exists(name)] == []


@pytest.mark.parametrize("name", ["drive.problem.DriveProblem.speed", "web/static/js/slide.js"])
def test_a_name_that_is_gone_is_noticed(name):
    assert not exists(name)


def asked(title):
    """The case of a walk's command, with its settings."""
    words = shlex.split(names(sections()[title])[0])
    settings = [words[n + 1] for n, word in enumerate(words) if word == "--set"]
    case = words[3] if words[1] == "rig" else words[2]
    return read_case(case, case_tables(), settings)


def test_a_velocity_ratio_arrives_in_the_drive():
    problem = DriveProblem.from_case(asked("A velocity ratio in a drive"))
    assert problem.velocity_ratio == pytest.approx(1.2, rel=1e-12)
    assert problem.velocity == pytest.approx(1.2 * problem.reference_speed, rel=1e-12)


def test_steps_of_a_spectrum_arrive_in_the_operation():
    steps = operation_of(asked("A step of a load spectrum")).steps
    assert [step.output_torque for step in steps] == [60.0, 250.0]
    assert [step.duration / 3600.0 for step in steps] == [3000.0, 500.0]


def test_a_sampling_rate_arrives_in_the_plan():
    assert asked("The sampling rate of a rig").require(Plan).sample_rate == 50e3


@pytest.mark.slow
def test_a_walk_is_drawn_over_the_folders_that_it_touches(drawing, tmp_path):
    drawing.draw_all(DOCS / "built.rst", tmp_path)
    found = sorted(path.name for path in tmp_path.iterdir())
    assert found == [f"walk-{name}.png" for name in ("drive", "page", "rig", "slide", "spectrum")]
    folder, name = drawing.parted("drive.protocols.solve.solve_shaken")
    assert (folder, name) == ("drive.protocols", "solve\nsolve_shaken")
