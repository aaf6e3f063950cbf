"""A report: one page that prints, headed by what it is of, for whom and by whom."""

import base64
import dataclasses
import datetime
import io
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.casefile.case import Case
from asperity.casefile.project import Project
from asperity.results.language import language, said
from asperity.results.page import environment
from asperity.results.table import Table
from asperity.results.unit_systems import shown_table, shown_text

if TYPE_CHECKING:
    from markupsafe import Markup
    from matplotlib.figure import Figure


@dataclasses.dataclass(frozen=True)
class Picture:
    """A picture within a page, which needs no file beside it.

    Attributes
    ----------
    title, caption : str
        Below it.
    figure : Figure or None
        What is drawn as SVG ...
    png : path or None
        ... or a file that holds it ...
    svg : str
        ... or SVG itself, of this package's own making ...
    moving : path or None
        ... or a file of WebP that moves; where that is not wanted, and on paper, its first frame
        stands.
    beside : str
        A file that may stand beside the page, to open what is drawn with.
    """

    title: str
    figure: "Figure | None" = None
    caption: str = ""
    png: Path | None = None
    svg: str = ""
    moving: Path | None = None
    beside: str = ""

    @property
    def html(self) -> "Markup":
        """It as an element of HTML."""
        from markupsafe import Markup

        if self.svg:
            return Markup(self.svg)
        if self.moving is not None:
            shown = ("moving", self.moving.read_bytes()), ("still", _first_frame(self.moving))
            return Markup("\n").join(
                Markup('<img class="{}" alt="{}" src="data:image/webp;base64,{}">').format(
                    name, self.title, base64.b64encode(content).decode("ascii")
                )
                for name, content in shown
            )
        kind, content = "svg+xml", b""
        if self.png is not None:
            kind, content = "png", self.png.read_bytes()
        elif self.figure is not None:
            drawn = io.BytesIO()
            from asperity.results.figures import spoken_figure

            spoken_figure(self.figure).savefig(drawn, format="svg", metadata={"Date": None})
            content = drawn.getvalue()
        encoded = base64.b64encode(content).decode("ascii")
        return Markup('<img alt="{}" src="data:image/{};base64,{}">').format(
            self.title, kind, encoded
        )


def _first_frame(path: Path) -> bytes:
    from PIL import Image

    drawn = io.BytesIO()
    with Image.open(path) as picture:
        picture.convert("RGB").save(drawn, "WEBP", quality=80)
    return drawn.getvalue()


@dataclasses.dataclass(frozen=True)
class Section:
    """A part of a report.

    Attributes
    ----------
    title : str
        Above it; empty for none.
    texts : tuple of str
        Sentences below the title.
    pictures, tables
        Below these.
    """

    title: str
    texts: tuple[str, ...] = ()
    pictures: tuple[Picture, ...] = ()
    tables: tuple[Table, ...] = ()


@dataclasses.dataclass(frozen=True)
class Heading:
    """What a report is headed by.

    Attributes
    ----------
    project : Project
        For whom and by whom.
    case : str
        The case's file or name.
    given : mapping of str to str
        What the case says, as it is written, by ``table.key``.
    settings : mapping of str to str
        The settings among it, by the same.
    axes : mapping of str to str
        What gave all the values of a grid, by the same.
    version : str
        Of this package.
    date : datetime.date
        Of the report.
    """

    project: Project = dataclasses.field(default_factory=Project)
    case: str = ""
    given: Mapping[str, str] = dataclasses.field(default_factory=dict)
    settings: Mapping[str, str] = dataclasses.field(default_factory=dict)
    axes: Mapping[str, str] = dataclasses.field(default_factory=dict)
    version: str = ""
    date: datetime.date = dataclasses.field(default_factory=lambda: datetime.datetime.now().date())

    @classmethod
    def of(cls, case: Case, version: str = "") -> "Heading":
        """Return the heading of what a version of this package makes of a case."""
        project = case.get(Project, Project())
        given = {
            f"{table}.{key}": value if isinstance(value, str) else _written(value)
            for table, entries in case.raw.items()
            if table != Project.table
            for key, value in entries.items()
        }
        return cls(project, case.source, given, case.settings, case.axes, version)

    @property
    def made_with(self) -> str:
        """Name and version of this package."""
        return f"asperity {self.version}".rstrip()

    @property
    def signed(self) -> str:
        """Below each printed page: who, when, with what, of what."""
        parts = (
            self.project.author, self.date.isoformat(), self.made_with, self.case,
        )  # fmt: skip
        return ", ".join(part for part in parts if part)

    @property
    def lines(self) -> tuple[tuple[str, str], ...]:
        """What stands below the title, by what it is."""
        project = self.project
        lines = (
            ("Customer", project.customer), ("Author", project.author),
            ("Date", self.date.isoformat()), ("Case file", self.case),
            ("Made with", self.made_with), ("Note", project.note),
        )  # fmt: skip
        return tuple((said(name), text) for name, text in lines if text)

    def table(self) -> Table:
        """Return what the case says."""
        rows = [self._row(key, value) for key, value in self.given.items()]
        return Table.of(("key", "as written", "from"), rows, left=3)

    def _row(self, key: str, value: str) -> tuple[str, str, str]:
        if key in self.axes:
            # The case has the first of its values.
            _, equals, values = self.axes[key].partition("=")
            return key, values if equals else f"{value}, ...", self.axes[key]
        return key, value, f"--set {self.settings[key]}" if key in self.settings else "case file"


def _written(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, dict):
        return ", ".join(f"{key} = {_written(part)}" for key, part in value.items())
    if isinstance(value, list | tuple):
        return "; ".join(map(_written, value))
    return str(value)


def report(title: str, sections: Iterable[Section], heading: Heading | None = None) -> str:
    """Return a report as text: a page without requests, which prints on A4."""
    heading = heading or Heading()
    template = environment().get_template("report.html.j2")
    title = said(title)
    named = f"{heading.project.name}: {title}" if heading.project.name else title
    parts = [*map(_shown, sections), *_given(heading)]
    words = {"lang": language(), "page": said("page"), "of": said("of")}
    return template.render(title=named, heading=heading, sections=parts, **words)


def _shown(section: Section) -> Section:
    """Return a part as people are shown it; the case stands as it was written."""
    return dataclasses.replace(
        section,
        title=said(section.title),
        pictures=tuple(map(_captioned, section.pictures)),
        texts=tuple(map(shown_text, section.texts)),
        tables=tuple(map(shown_table, section.tables)),
    )


def _captioned(picture: Picture) -> Picture:
    return dataclasses.replace(
        picture, title=said(picture.title), caption=shown_text(picture.caption)
    )


def _given(heading: Heading) -> Iterator[Section]:
    if heading.given:
        yield Section(said("The case file"), tables=(shown_table(heading.table()),))
