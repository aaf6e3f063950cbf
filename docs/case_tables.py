"""The directive ``case-table``: the keys of a table of a case file, from what the package says.

``asperity schema`` prints the same text for editors.
"""

from typing import get_args

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList
from sphinx.util.nodes import nested_parse_with_titles

from asperity.casefile import Table
from asperity.casefile.schema import keys_of
from asperity.commands import case_tables

_ACTS = str.maketrans({sign: f"\\{sign}" for sign in "\\*_`|"})


class CaseTable(Directive):
    """A row for each key: example, default, meaning and what is allowed."""

    required_arguments = 1

    def run(self):
        lines = [
            ".. list-table::",
            "   :header-rows: 1",
            "   :widths: 22 20 16 42",
            "",
            *_row("Key", "Example", "Left out", "Meaning"),
        ]
        for key in keys_of(_table(self.arguments[0])):
            default = {"required": "required", "": ""}.get(key.default, _code(key.default))
            words = key.schema.get("enum") or []
            allowed = f" One of {key.allowed}." if words else ""
            lines += _row(
                _code(key.name), _code(key.example), default, _plain(key.meaning + allowed)
            )
        holder = nodes.container()
        nested_parse_with_titles(self.state, StringList(lines, "case-table"), holder)
        return holder.children


def _table(path):
    """Return a table by its name, or the one that a key of it lists: ``worm_shaft.section``."""
    name, _, key = path.partition(".")
    model = case_tables()[name]
    if not key:
        return model
    listed = get_args(model.model_fields[key].annotation)
    return next(each for each in listed if isinstance(each, type) and issubclass(each, Table))


def _row(*cells):
    return [f"   {'* -' if not place else '  -'} {cell}" for place, cell in enumerate(cells)]


def _code(text):
    return f"``{text}``" if text else ""


def _plain(text):
    return text.translate(_ACTS)


def setup(app):
    """Make the directive known."""
    app.add_directive("case-table", CaseTable)
    return {"parallel_read_safe": True}
