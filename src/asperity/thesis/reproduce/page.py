"""The page: ledger, tables and pictures beside it, how each number was made, what is to come."""

import dataclasses
import functools
import importlib.metadata
import platform
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.results.page import environment
from asperity.results.typeset import typeset
from asperity.thesis import contents
from asperity.thesis.contents import chapter_of
from asperity.thesis.exhibits import CLAIM, FIGURE, TABLE
from asperity.thesis.products import DIFFERS, VERDICTS, Cell
from asperity.thesis.reproduce.files import Shown
from asperity.thesis.said import Chapter, disputed, findings, lost, read_by_a_machine, slips

if TYPE_CHECKING:
    from jinja2 import Template

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib")
_TEMPLATE = Path(__file__).with_name("page.html.j2")
_SCRIPT = Path(__file__).with_name("page.js")
_SENTENCES = 2
# A stop, and then what begins a sentence.
_STOP = re.compile(r"(?<=[A-Za-z0-9%)”][.:?!]) (?=[A-Z“(])")


@dataclasses.dataclass(frozen=True)
class Part:
    """A chapter with what is shown of it, the names of what is to come, and what failed and why."""

    chapter: Chapter
    shown: dict[str, list[Shown]]
    to_come: list[str]
    failed: dict[str, str]

    @property
    def empty(self) -> bool:
        """Whether there is nothing to say of it."""
        return not any((*self.shown.values(), self.to_come, self.failed))

    @property
    def differ(self) -> int:
        """How many of its claims do not hold."""
        return self.count(DIFFERS)

    def count(self, verdict: str) -> int:
        """How many of its claims have a verdict."""
        return sum(claim.plain["verdict"] == verdict for claim in self.shown[CLAIM])


def render(
    shown: Sequence[Shown], to_come: Sequence[str], failed: Mapping[str, str], version: str
) -> str:
    """Return the page of a version of this package as text.

    While names of exhibits are still to come it loads itself again now and then; of those that
    could not be made it says why.
    """
    there = {one.exhibit.name: one for one in shown}
    order = [there[one.name] for one in contents.everything() if one.name in there]
    parts = [
        Part(
            chapter,
            {kind: [one for one in order if one.exhibit.kind == kind
                    and chapter_of(one.number) == chapter.number]
             for kind in (CLAIM, FIGURE, TABLE)},
            [name for name in to_come if _chapter(name) == chapter.number],
            {name: why for name, why in failed.items() if _chapter(name) == chapter.number},
        )
        for chapter in contents.CHAPTERS
    ]  # fmt: skip
    claims = [claim for part in parts for claim in part.shown[CLAIM]]
    rendered: str = _template().render(
        parts=[part for part in parts if not part.empty],
        claimed=len(claims),
        counts={verdict: sum(part.count(verdict) for part in parts) for verdict in VERDICTS},
        kinds=VERDICTS,
        there=set(there),
        findings=findings(),
        resting_on={
            name: [claim.number for claim in claims if name in claim.plain["rests_on"]]
            for name in findings()
        },
        lost=lost(),
        disputed=disputed(),
        judged_otherwise={one.claim for one in disputed()},
        slips=slips(),
        letters=sorted({slip.line for slip in slips() if not slip.why}),
        read_by_a_machine=read_by_a_machine(),
        script=_SCRIPT.read_text("utf-8"),
        to_come=len(to_come),
        failed=len(failed),
        versions={"asperity": version} | _versions(),
        title="Vibration, sliding friction and worm gears: the thesis, reproduced",
    )
    return rendered


@functools.cache
def _template() -> "Template":
    made = environment().overlay()
    made.filters = made.filters | {
        "cell": cell, "lead": lead, "rest": rest, "lower_first": _lower_first,
    }  # fmt: skip
    return made.from_string(_TEMPLATE.read_text("utf-8"))


@functools.cache
def _versions() -> dict[str, str]:
    found = {name: importlib.metadata.version(name) for name in _PACKAGES}
    return {"Python": platform.python_version()} | found


def _chapter(name: str) -> str:
    return chapter_of(name.rpartition(" ")[2])


def lead(reason: str) -> str:
    """Return the first two sentences of a reason.

    Examples
    --------
    >>> lead("It is 1.5 N. By (61) it holds. The rest is told below.")
    'It is 1.5 N. By (61) it holds.'
    """
    return " ".join(_sentences(reason)[:_SENTENCES])


def rest(reason: str) -> str:
    """Return what follows its first two sentences."""
    return " ".join(_sentences(reason)[_SENTENCES:])


def _sentences(reason: str) -> list[str]:
    found: list[str] = []
    for piece in _STOP.split(reason):
        if found and found[-1].endswith(":"):
            found[-1] += f" {piece}"
        else:
            found.append(piece)
    return found


def _lower_first(text: str) -> str:
    return text[:1].lower() + text[1:]


def cell(value: Cell) -> Any:
    """Return a cell of a table as HTML: a number to five digits, a text with its symbols set.

    Examples
    --------
    >>> print(cell(1.390279), cell(60), cell("m_x1"))
    1.3903 60 m<sub>x1</sub>
    """
    return f"{value:.5g}" if isinstance(value, float) else typeset(str(value))
