"""Tables of numbers and defaults are edited on purpose, or not at all.

A digit of a standard's table, or of a default that users rely on, changes answers by less than a
tolerance allows, or only those of sizes that no test has. Here each table that stands at the top of
a module, and the defaults of each class, has a short hash of its numbers, which
``python tests/unit/test_tables.py`` writes anew once an edit was compared with its source. One that
is new, or has moved, has none until then.
"""

import ast
import hashlib
import re
import tomllib
from pathlib import Path

import pytest

import asperity

PACKAGE = Path(asperity.__file__).parent
KEPT = Path(__file__).with_name("tables.toml")
_LEAST = 3  # numbers that make a table
_LAID_OUT = re.compile(r"(thesis|web)/|.*(plots|drawing|view)")  # pictures and pages
# To read all files as Python takes a second: most have neither.
_MAY_HAVE = re.compile(
    r"^\(?_?[A-Z][A-Z\d_]*\b[^=\n]*= *[^\s\w\"'f]|^    \w+: [^#\n]* = [^#\n]*\d", re.MULTILINE
)


def numbers(node):
    """Numbers of an expression in their order, their signs with them."""
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        yield "-"
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        yield repr(node.value)
    for child in ast.iter_child_nodes(node):
        yield from numbers(child)


def tables_of(tree):
    """Names of tables and of classes with defaults, each with its numbers."""
    for statement in tree.body:
        if isinstance(statement, ast.ClassDef):
            defaults = [
                (part.target.id, *numbers(part.value))
                for part in statement.body
                if isinstance(part, ast.AnnAssign) and part.value is not None
            ]
            # What is sorted may be put into another order.
            if found := sorted(default for default in defaults if len(default) > 1):
                yield statement.name, [word for default in found for word in default]
        elif isinstance(statement, ast.Assign | ast.AnnAssign) and statement.value is not None:
            targets = getattr(statement, "targets", [getattr(statement, "target", None)])
            found = list(numbers(statement.value))
            if len(found) >= _LEAST and isinstance(targets[0], ast.Name | ast.Tuple):
                yield ast.unparse(targets[0]), found


def found():
    """Hashes of all tables by their module and name."""
    files = {path.relative_to(PACKAGE).as_posix(): path for path in sorted(PACKAGE.rglob("*.py"))}
    texts = {
        module: path.read_text("utf-8")
        for module, path in files.items()
        if not _LAID_OUT.match(module)
    }
    return {
        f"{module}:{name}": hashlib.sha256(" ".join(words).encode()).hexdigest()[:8]
        for module, text in texts.items()
        if _MAY_HAVE.search(text)
        for name, words in tables_of(ast.parse(text))
    }


def test_no_digit_of_a_table_or_a_default_has_changed_unseen():
    kept, now = tomllib.loads(KEPT.read_text("utf-8")), found()
    other = sorted(name for name in kept.keys() & now.keys() if kept[name] != now[name])
    assert not other, (
        f"numbers were edited: {', '.join(other)}. Compare them with their source, then write "
        "tests/unit/tables.toml anew with `python tests/unit/test_tables.py`"
    )
    new = sorted(now.keys() - kept.keys())
    assert len(new) < 0.1 * len(now), f"too many have no hash: {', '.join(new)}"


@pytest.mark.parametrize(
    "edited", ["_A = (1.0, 2.5, 3)", "_A = (1.0, -2.0, 3)", "_A = (1.0, 3, 2.0)", "_A = (1.0, 2.0)"]
)
def test_a_digit_a_sign_and_an_order_change_a_table(edited):
    (before,) = tables_of(ast.parse("_A = (1.0, 2.0, 3)"))
    assert before not in list(tables_of(ast.parse(edited)))


if __name__ == "__main__":
    lines = [f'"{name}" = "{digest}"' for name, digest in sorted(found().items())]
    KEPT.write_text("\n".join(lines) + "\n", "utf-8")
