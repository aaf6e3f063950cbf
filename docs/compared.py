"""The directive ``compared``: a table of comparisons, calculated while building."""

import comparisons
from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList


class ComparedTable(Directive):
    """A row for each number: theirs, ours, and by how much they differ."""

    required_arguments = 1

    def run(self):
        rows = [("", "theirs", "ours", "differ by")]
        for each in comparisons.ALL[self.arguments[0]]():
            unit = f" {each.unit}" if each.unit else ""
            differ = "less than 1e-7" if abs(each.deviation) < 1e-7 else f"{each.deviation:.1e}"
            rows.append(
                (each.quantity, f"{each.theirs:.6g}{unit}", f"{each.ours:.6g}{unit}", differ)
            )
        lines = [".. list-table::", "   :header-rows: 1", "   :widths: 46 18 18 18", ""]
        for row in rows:
            lines += [f"   {'  -' if place else '* -'} {cell}" for place, cell in enumerate(row)]
        holder = nodes.container()
        self.state.nested_parse(StringList(lines, "compared"), 0, holder)
        return holder.children


def setup(app):
    """Make the directive known."""
    app.add_directive("compared", ComparedTable)
    return {"parallel_read_safe": True}
