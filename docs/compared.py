"""The directives ``compared`` and ``sized``: tables of comparisons, calculated while building."""

import math

import comparisons
import gear_cases
import trust
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
        return _table(self, (46, 18, 18, 18), rows)


class SizedTable(Directive):
    """A row for each published gearset: theirs, ours, and what differs."""

    def run(self):
        rows = [("gearset", "ratio, torque, speed", "theirs (mm)", "ours (mm)", "what differs")]
        for each in comparisons.published():
            ours = f"{each.ours:g}" if math.isfinite(each.ours) else "none"
            said = each.fails or each.differs
            if each.differs:
                said += f": then {each.changed:g} mm"
            memory = " *(from memory)*" if each.trust == "from memory" else ""
            name = f"{each.name}: {each.source}{memory}"
            rows.append((name, each.asked, f"{each.theirs:g}", ours, said or "\\ "))
        return _table(self, (36, 18, 9, 9, 28), rows)


class CatalogueTable(Directive):
    """A row for each position of a catalogue: the maker's numbers and the standards'."""

    positions = staticmethod(gear_cases.catalogue)

    def run(self):
        rows = [
            ("a (mm), ratio", "torque (N m)", "BS 721 wear", "AGMA 6034", "efficiency (%)",
             "BS 721 teeth", "ISO gearbox")
        ]  # fmt: skip
        for each in self.positions():
            numbers = (each.torque, each.bs_wear, each.agma_torque, each.efficiency,
                       each.bs_teeth, each.iso_gearbox)  # fmt: skip
            shown = ("none" if n is None else f"{n:.3g}" for n in numbers)
            rows.append((f"{each.centre_distance:g}, {each.ratio:g}", *shown))
        return _table(self, (16, 14, 14, 14, 14, 14, 14), rows)


class SelectionTable(CatalogueTable):
    """The same for the table of a program that selects gearboxes."""

    positions = staticmethod(gear_cases.selection)


class TextbookTable(Directive):
    """A row for each number of Mott's example."""

    def run(self):
        rows = [("", "theirs", "ours")]
        rows += [(name, f"{a:g}", f"{b:.4g}") for name, a, b in gear_cases.mott()]
        return _table(self, (50, 25, 25), rows)


class TrustTable(Directive):
    """A row for each kind of number: how many are verified, of one source, our own, from memory."""

    def run(self):
        found = list(trust.trust())
        heads = "", "verified", "one source", "own choice", "from memory"
        rows = [heads, *(map(str, each) for each in found)]
        total = (sum(each[n] for each in found) for n in (1, 2, 3, 4))
        rows.append(("together", *map(str, total)))
        return _table(self, (40, 15, 15, 15, 15), [*map(tuple, rows)])


def _table(directive, widths, rows):
    """Return the nodes of a table whose first row is its heading."""
    widths = " ".join(map(str, widths))
    lines = [".. list-table::", "   :header-rows: 1", f"   :widths: {widths}", ""]
    for row in rows:
        lines += [f"   {'  -' if place else '* -'} {cell}" for place, cell in enumerate(row)]
    holder = nodes.container()
    directive.state.nested_parse(StringList(lines, "compared"), 0, holder)
    return holder.children


def setup(app):
    """Make the directive known."""
    app.add_directive("compared", ComparedTable)
    app.add_directive("sized", SizedTable)
    app.add_directive("catalogue", CatalogueTable)
    app.add_directive("selection", SelectionTable)
    app.add_directive("textbook-gear", TextbookTable)
    app.add_directive("trust", TrustTable)
    return {"parallel_read_safe": True}
