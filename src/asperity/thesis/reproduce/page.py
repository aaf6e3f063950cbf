"""The page: ledger, tables and pictures beside it, how each number was made, what is to come."""

import dataclasses
import functools
import importlib.metadata
import platform
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.results.page import environment
from asperity.results.typeset import typeset
from asperity.thesis import contents
from asperity.thesis.contents import Chapter, chapter_of
from asperity.thesis.exhibits import CLAIM, FIGURE, TABLE
from asperity.thesis.products import Cell
from asperity.thesis.reproduce.files import Shown

if TYPE_CHECKING:
    from jinja2 import Template

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib")
_TEMPLATE = Path(__file__).with_name("page.html.j2")


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
        return self._count("differs")

    @property
    def fitted(self) -> int:
        """How many of them hold because a model was fitted to them."""
        return self._count("fitted")

    def _count(self, verdict: str) -> int:
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
    claimed = sum(len(part.shown[CLAIM]) for part in parts)
    rendered: str = _template().render(
        parts=[part for part in parts if not part.empty],
        claimed=claimed,
        different=sum(part.differ for part in parts),
        fitted=sum(part.fitted for part in parts),
        to_come=len(to_come),
        failed=len(failed),
        versions={"asperity": version} | _versions(),
        title="Vibration, sliding friction and worm gears: the thesis, reproduced",
    )
    return rendered


@functools.cache
def _template() -> "Template":
    made = environment().overlay()
    made.filters = made.filters | {"cell": cell}
    return made.from_string(_TEMPLATE.read_text("utf-8"))


@functools.cache
def _versions() -> dict[str, str]:
    found = {name: importlib.metadata.version(name) for name in _PACKAGES}
    return {"Python": platform.python_version()} | found


def _chapter(name: str) -> str:
    return chapter_of(name.rpartition(" ")[2])


def cell(value: Cell) -> Any:
    """Return a cell of a table as HTML: a number to five digits, a text with its symbols set.

    Examples
    --------
    >>> print(cell(1.390279), cell(60), cell("m_x1"))
    1.3903 60 m<sub>x1</sub>
    """
    return f"{value:.5g}" if isinstance(value, float) else typeset(str(value))
