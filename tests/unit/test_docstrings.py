"""What docstrings show is what comes out."""

import doctest
import importlib
from pathlib import Path

import pytest

import asperity

PACKAGE = Path(asperity.__file__).parent
SHOWING = [
    ".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts)
    for path in sorted(PACKAGE.rglob("*.py"))
    if ">>> " in path.read_text("utf-8")
]


@pytest.mark.parametrize("name", SHOWING)
def test_examples_give_what_stands_below_them(name):
    failed, tried = doctest.testmod(importlib.import_module(name))
    assert tried
    assert failed == 0
