"""The page: one HTML file that holds the ledger, the pictures and how each number was made."""

import base64
import importlib.metadata
import platform
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.thesis.ledger import Entry

if TYPE_CHECKING:
    from asperity.thesis.reproduce import FigureFiles

_PACKAGES = ("numpy", "scipy", "numba", "xarray", "matplotlib")
_TEMPLATE = Path(__file__).with_name("report.html.j2")


def render(claims: Sequence[Entry], figures: "Sequence[FigureFiles]", version: str) -> str:
    """Return the page as text, pictures included."""
    import jinja2

    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True
    )
    environment.filters["typeset"] = typeset
    template = environment.from_string(_TEMPLATE.read_text("utf-8"))
    versions = {"asperity": version, "Python": platform.python_version()}
    versions |= {name: importlib.metadata.version(name) for name in _PACKAGES}
    return template.render(
        claims=claims,
        reproduced=sum(entry.finding.verdict == "reproduced" for entry in claims),
        figures=figures,
        pictures={figure.number: _data(figure.picture) for figure in figures},
        versions=versions,
    )


def typeset(text: str) -> Any:
    """Return a text as HTML with its symbols set: ``mu F_N``, ``eta_y``, ``<=``.

    Examples
    --------
    >>> print(typeset("s_max <= 5 % of mu F_N"))
    s<sub>max</sub> ≤ 5 % of µ F<sub>N</sub>
    """
    from markupsafe import Markup, escape

    text = text.replace("<=", "≤").replace("+-", "±")
    text = re.sub(r"\bmu\b", "µ", re.sub(r"\beta_", "η_", text))
    return Markup(re.sub(r"\b([A-Za-zη])_(\w+)", r"\1<sub>\2</sub>", str(escape(text))))


def _data(picture: Path) -> str:
    return base64.b64encode(picture.read_bytes()).decode("ascii")
