"""Pages: tables as HTML, and the templates and the style that every page is made of."""

import functools
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.results.table import Bar, Number
from asperity.results.typeset import typeset
from asperity.results.unit_systems import shown_table
from asperity.results.words import Sentence

if TYPE_CHECKING:
    from jinja2 import Environment
    from markupsafe import Markup

    from asperity.results.table import Table

_TEMPLATES = Path(__file__).with_name("templates")


@functools.cache
def style() -> str:
    """Return the style of every page."""
    return (_TEMPLATES / "page.css").read_text("utf-8")


@functools.cache
def environment() -> "Environment":
    """Return what templates are rendered in: ``page.html.j2`` is there to be extended."""
    import jinja2

    made = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES), autoescape=True, trim_blocks=True,
        lstrip_blocks=True, undefined=jinja2.StrictUndefined,
    )  # fmt: skip
    made.filters |= {"typeset": typeset, "cell": _cell, "css": _css_text}
    made.globals["style"] = style()
    return made


def fragment(tables: "Iterable[Table]", headline: "Iterable[str]" = ()) -> str:
    """Return tables as HTML without a page around them, below sentences."""
    from markupsafe import Markup

    made: Any = environment().get_template("tables.html.j2").module
    above = [Markup("<p>{}</p>\n").format(_cell(sentence)) for sentence in headline]
    return "".join([*above, str(made.of([shown_table(table) for table in tables]))])


def data(number: Number) -> "Markup":
    """Return a number as HTML that holds all its digits, and its key in JSON."""
    from markupsafe import Markup

    key = Markup(' data-key="{}"').format(number.key) if number.key else ""
    times = Markup(' data-times="{:g}"').format(number.times) if number.times != 1.0 else ""
    return Markup('<data value="{!r}"{}{}>{}</data>').format(number.value, key, times, str(number))


def _cell(text: str, symbols: bool = False) -> "Markup | str":
    from markupsafe import Markup

    if isinstance(text, Number):
        return data(text)
    if isinstance(text, Sentence):
        # A number of a sentence that stands in JSON as it is has no key of its own.
        parts = (p if getattr(p, "key", True) else str(p) for p in text.parts)
        return Markup("").join(_cell(part, symbols) for part in parts)
    if isinstance(text, Bar):
        length = min(max(text.value, 0.0), Bar.LONGEST) * 100.0
        return Markup(
            '<svg class="bar" viewBox="0 0 300 12" preserveAspectRatio="none" aria-hidden="true">'
            '<rect x="0" y="2" width="300" height="8" fill="none" stroke="#999"/>'
            '<rect x="0" y="2" width="{:.4g}" height="8" fill="{}" stroke="#000"/>'
            '<path d="M100 0V12" stroke="#000" stroke-width="3"/></svg>'
        ).format(length, "#fff" if text.value < 1.0 else "#777")
    return typeset(text) if symbols else text


def _css_text(text: str | None) -> "Markup":
    """Return a text as a string of CSS, in which nothing can end the string or the style."""
    from markupsafe import Markup

    made = (
        sign if sign.isalnum() and sign.isascii() else f"\\{ord(sign):06x}" for sign in text or ""
    )
    return Markup('"{}"').format(Markup("".join(made)))
