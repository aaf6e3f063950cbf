"""Formulas as MathML, made while building: a browser needs no script for them."""

import html
import re
from xml.etree import ElementTree

from docutils import nodes
from docutils.utils.math import MathError, latex2mathml
from sphinx.util import logging

_LOG = logging.getLogger(__name__)
_NAMED = re.compile(r"&(?!(?:amp|lt|gt|quot|apos);)\w+;")


def _written(node, *, as_block):
    try:
        return _mended(latex2mathml.tex2mathml(node.astext(), as_block=as_block))
    except MathError as error:
        _LOG.warning("formula %r: %s", node.astext(), error, location=node)
        return ""


def _mended(mathml):
    r"""What docutils sets another way than TeX: the index of ``\dot x_b``, and overlines."""
    ElementTree.register_namespace("", "http://www.w3.org/1998/Math/MathML")
    # XML knows five entities of HTML's.
    root = ElementTree.fromstring(_NAMED.sub(lambda found: html.unescape(found[0]), mathml))
    space = root.tag.removesuffix("math")
    for each in root.iter(f"{space}munderover"):
        base, index, accent = each
        if base.tag != f"{space}mo" and accent.get("stretchy") == "false":
            each.tag = f"{space}msub"
            each[:] = [ElementTree.Element(f"{space}mover", {"accent": "true"}), index]
            each[0].extend([base, accent])
    for each in root.iter(f"{space}mover"):
        if each[-1].text == "_":
            each[-1].text = "\N{OVERLINE}"
    return ElementTree.tostring(root, encoding="unicode")


def _inline(self, node):
    self.body.append(_written(node, as_block=False))
    raise nodes.SkipNode


def _block(self, node):
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(_written(node, as_block=True))
    self.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app):
    """Make the renderer known."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
