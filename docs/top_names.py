"""The directive ``top-names``: what stands at the top of the package, each with its room's page."""

import importlib

from docutils import nodes
from docutils.parsers.rst import Directive
from docutils.statemachine import StringList

import asperity


class TopNames(Directive):
    """A list of names by the module that they come from."""

    def run(self):
        by_place = {}
        for name in asperity.__all__:
            found = getattr(asperity, name)
            by_place.setdefault(found.__module__, []).append(name)
        lines = []
        for place, names in sorted(by_place.items()):
            home = _documented_in(place, names)
            said = ", ".join(f":obj:`{name} <{home}.{name}>`" for name in names)
            lines += [f"* {said}", ""]
        holder = nodes.container()
        self.state.nested_parse(StringList(lines, "top-names"), 0, holder)
        return holder.children


def _documented_in(place, names):
    """The room, where that offers the names, or the module itself."""
    room = ".".join(place.split(".")[:2])
    offered = getattr(importlib.import_module(room), "__all__", ())
    return room if set(names) <= set(offered) else place


def setup(app):
    """Make the directive known."""
    app.add_directive("top-names", TopNames)
    return {"parallel_read_safe": True}
