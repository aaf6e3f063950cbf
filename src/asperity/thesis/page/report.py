"""The page: one HTML file that holds ledger, pictures and tables, and how each number was made."""

import base64
import dataclasses
import importlib.metadata
import platform
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from asperity.thesis.contents import CHAPTERS, Chapter, chapter_of
from asperity.thesis.exhibits import Cell
from asperity.thesis.ledger import Entry
from asperity.thesis.reproduce.files import FigureFiles, TableFiles

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib")
_GREEK = {"alpha": "α", "eta": "η", "gamma": "γ", "mu": "µ", "nu": "ν", "sigma": "σ"}
_SIGNS = {
    "<=": "≤",
    r"\+-": "±",
    r"\bmu\b": "µ",
    r"\bdegC\b": "°C",
    r"\bum\b": "µm",
    r"\bmm2\b": "mm²",
    # A hyphen that does not break, between the side that drives and the side that is driven.
    r"\beta_z(\d)_(\d)": r"eta_z\1‑\2",
    **{rf"\b{name}_": f"{letter}_" for name, letter in _GREEK.items()},
}
_INDEXED = r"\b(Ra|[A-Za-zµα-ω])_(\w+(?:[,‑]\w+)?)"
_TEMPLATE = Path(__file__).with_name("report.html.j2")


@dataclasses.dataclass(frozen=True)
class Part:
    """A chapter with what is shown of it."""

    chapter: Chapter
    claims: list[Entry]
    figures: list[FigureFiles]
    tables: list[TableFiles]

    @property
    def differ(self) -> int:
        """How many of its claims do not hold."""
        return sum(entry.finding.verdict == "differs" for entry in self.claims)


def render(
    claims: Sequence[Entry],
    figures: Sequence[FigureFiles],
    tables: Sequence[TableFiles],
    version: str,
) -> str:
    """Return the page as text, pictures included."""
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters |= {"typeset": typeset, "shown": shown}
    template = environment.from_string(_TEMPLATE.read_text("utf-8"))
    versions = {"asperity": version, "Python": platform.python_version()}
    versions |= {name: importlib.metadata.version(name) for name in _PACKAGES}
    parts = [
        Part(
            chapter,
            [entry for entry in claims if chapter_of(entry.id) == chapter.number],
            [figure for figure in figures if chapter_of(figure.number) == chapter.number],
            [table for table in tables if chapter_of(table.number) == chapter.number],
        )
        for chapter in CHAPTERS
    ]
    return template.render(
        parts=[part for part in parts if part.claims or part.figures or part.tables],
        claimed=len(claims),
        reproduced=sum(entry.finding.verdict == "reproduced" for entry in claims),
        pictures={figure.number: _data(figure.picture) for figure in figures},
        versions=versions,
    )


def shown(cell: Cell) -> Any:
    """Return a cell of a table as HTML: a number to five digits, a text with its symbols set.

    Examples
    --------
    >>> print(shown(1.390279), shown(60), shown("m_x1"))
    1.3903 60 m<sub>x1</sub>
    """
    return f"{cell:.5g}" if isinstance(cell, float) else typeset(str(cell))


def typeset(text: str) -> Any:
    """Return a text as HTML with its symbols set: ``mu F_N``, ``eta_y``, ``<=``.

    Examples
    --------
    >>> print(typeset("s_max <= 5 % of mu F_N"))
    s<sub>max</sub> ≤ 5 % of µ F<sub>N</sub>
    """
    from markupsafe import Markup, escape

    for plain, sign in _SIGNS.items():
        text = re.sub(plain, sign, text)
    return Markup(re.sub(_INDEXED, r"\1<sub>\2</sub>", str(escape(text))))


def _data(picture: Path) -> str:
    return base64.b64encode(picture.read_bytes()).decode("ascii")
