"""What the front page of the documentation and its tutorials say is what happens."""

import json
import re
import shlex
import textwrap
from pathlib import Path

import pytest
from apparatus.grid import slow

DOCS = Path(__file__).parents[2] / "docs"
ACTUATOR = "tutorials/an-actuator-from-its-duty"
PAGES = ("index", *(f"tutorials/{path.stem}" for path in sorted(DOCS.glob("tutorials/*.rst"))))


def blocks(page, language):
    text = (DOCS / f"{page}.rst").read_text("utf-8")
    found = re.findall(rf"^\.\. code-block:: {language}\n\n((?:   .*\n|\n)+)", text, re.MULTILINE)
    return [textwrap.dedent(block) for block in found]


def told(page):
    """Each command of a page, with the lines that it is said to print."""
    for block in blocks(page, "console"):
        for part in re.split(r"^\$ ", block.replace("\\\n", " "), flags=re.MULTILINE)[1:]:
            command, *lines = part.strip().splitlines()
            if command.startswith("asperity "):
                yield command.removeprefix("asperity "), lines


def words(line):
    return " ".join(line.split())


@pytest.mark.parametrize(
    "page", [slow(page) if page.startswith("tutorials") else page for page in PAGES]
)
def test_each_command_prints_what_the_page_says(asperity, tmp_path, page):
    commands = list(told(page))
    assert commands
    for command, lines in commands:
        code, output, errors = asperity(*shlex.split(command), cwd=tmp_path)
        assert code == 0, (command, errors)
        for line in lines:
            assert words(line) in words(output), (command, line)
    if page == ACTUATOR:
        assert len(commands) == 6
        holds_report_drawing_and_solids_in_inches(tmp_path / "out")


def holds_report_drawing_and_solids_in_inches(folder):
    """Hold what the six commands from duty to drawing leave to what its designer asked for."""
    import ezdxf

    rated = json.loads((folder / "rated" / "rate.json").read_text("utf-8"))
    assert set(rated["verdict"]["holds"]) >= {"iso14521", "bs721", "agma6034"}
    report = (folder / "rated" / "report.html").read_text("utf-8")
    assert "lbf·in" in report
    drawing = ezdxf.readfile(folder / "drawn" / "gearset.dxf")
    assert not drawing.audit().errors
    assert len(drawing.modelspace().query("DIMENSION")) > 5
    for solid in ("worm", "wheel", "gearset"):
        text = (folder / "drawn" / f"{solid}.step").read_text("utf-8")
        assert text.startswith("ISO-10303-21")
        assert "MANIFOLD_SOLID_BREP" in text


def test_the_law_of_the_pin_is_homogenised(capsys):
    (block,) = blocks("tutorials/your-pin-on-disc", "python")
    names = {}
    exec(compile(block, "your-pin-on-disc.rst", "exec"), names)
    assert names["law"](0.5e-3) == pytest.approx(0.137 * 5.5, rel=2e-3)
    assert str(names["law"]([0.0002, 0.0005, 0.002])) in capsys.readouterr().out
