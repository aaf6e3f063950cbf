"""Tables as HTML: a fragment for a notebook, or a page of its own."""

import base64
import dataclasses
import functools
import io
from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment, Template
    from matplotlib.figure import Figure

    from asperity.results.table import Table

STYLE = """
body { margin: 0 auto; max-width: 76rem; padding: 1.5rem 1rem 4rem; color: #1a1a1a;
  font: 1rem/1.45 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; }
table.asperity { border-collapse: collapse; margin-top: 2rem; font-size: .9rem; }
main table.asperity { width: 100%; }
.asperity caption { text-align: left; font-size: 1.25rem; font-weight: 600; padding-bottom: .4rem; }
.asperity th, .asperity td { text-align: left; vertical-align: top; padding: .3rem .5rem;
  border-top: 1px solid #ddd; }
.asperity .number { text-align: right; font-variant-numeric: tabular-nums; }
ul { max-width: 56rem; }
figure { margin: 2rem 0; }
figure img { max-width: 100%; }
"""

_FRAGMENT = """\
{% for table in tables %}
<table class="asperity">
{% if table.title %}<caption>{{ table.title }}</caption>
{% endif %}
<thead><tr>
{%- for column in table.columns -%}
<th{% if column.right %} class="number"{% endif %}>{{ column.heading }}</th>
{%- endfor -%}
</tr></thead>
<tbody>
{% for row in table.rows %}
<tr>
{%- for cell in row -%}
<td{% if table.columns[loop.index0].right %} class="number"{% endif %}>{{ cell }}</td>
{%- endfor -%}
</tr>
{% endfor %}
</tbody>
</table>
{% if table.remarks %}<ul>
{% for remark in table.remarks %}<li>{{ remark }}</li>
{% endfor %}
</ul>
{% endif %}
{% endfor %}
"""

_PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ title }}</title>
<style>{{ style|safe }}</style>
</head>
<body>
<main>
<h1>{{ title }}</h1>
{% if remarks %}<ul>
{% for remark in remarks %}<li>{{ remark }}</li>
{% endfor %}
</ul>
{% endif %}
{{ body|safe }}
{% for picture in pictures %}
<figure>
<img alt="{{ picture.title }}" src="data:image/svg+xml;base64,{{ picture.encoded }}">
<figcaption><b>{{ picture.title }}.</b> {{ picture.caption }}</figcaption>
</figure>
{% endfor %}
</main>
</body>
</html>
"""


@functools.cache
def _environment() -> "Environment":
    import jinja2

    return jinja2.Environment(
        autoescape=True, trim_blocks=True, lstrip_blocks=True, undefined=jinja2.StrictUndefined
    )


@functools.cache
def _template(text: str) -> "Template":
    return _environment().from_string(text)


def fragment(tables: "Iterable[Table]") -> str:
    """Return tables as HTML without a page around them."""
    return _template(_FRAGMENT).render(tables=list(tables))


@dataclasses.dataclass(frozen=True)
class Picture:
    """A picture within a page, which needs no file beside it.

    Attributes
    ----------
    title, caption : str
        Below it.
    figure : Figure
        The picture.
    """

    title: str
    figure: "Figure"
    caption: str = ""

    @property
    def encoded(self) -> str:
        """It as SVG in letters."""
        drawn = io.BytesIO()
        self.figure.savefig(drawn, format="svg", metadata={"Date": None})
        return base64.b64encode(drawn.getvalue()).decode("ascii")


def page(
    title: str,
    tables: "Iterable[Table]",
    remarks: Iterable[str] = (),
    pictures: Iterable[Picture] = (),
) -> str:
    """Return a page of its own with tables, remarks above them and pictures below."""
    return _template(_PAGE).render(
        title=title, style=STYLE, remarks=list(remarks), body=fragment(tables),
        pictures=list(pictures),
    )  # fmt: skip
