"""The comparisons that the documentation's page of validation is calculated from.

Sources: closed forms of rigid friction; Shigley's Mechanical Engineering Design, example 15-3; a
public report of a commercial program for DIN 3996.
"""

import importlib.util
from pathlib import Path

import pytest

FILE = Path(__file__).parents[2] / "docs" / "comparisons.py"
SPEC = importlib.util.spec_from_file_location("comparisons", FILE)
comparisons = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(comparisons)


@pytest.mark.parametrize("name", comparisons.ALL)
def test_what_is_compared_differs_by_less_than_its_limit(name):
    rows = list(comparisons.ALL[name]())
    assert rows
    for row in rows:
        assert abs(row.deviation) < row.limit, row
    assert f".. compared:: {name}" in (FILE.parent / "validation.rst").read_text("utf-8")
