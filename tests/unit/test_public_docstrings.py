"""The check of public docstrings, `make lint`: what it finds wrong, and whom it looks at."""

import importlib
import importlib.util
import sys
from pathlib import Path

import pytest

pytest.importorskip("numpydoc")

FILE = Path(__file__).parents[2] / "docs" / "docstrings.py"
SPEC = importlib.util.spec_from_file_location("checked_docstrings", FILE)
check = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(check)

GOOD = '''
"""A module."""
import numpy as np
from asperity.errors import InputError
from asperity.results import Result, quantity


def work(force: float, ways) -> float:
    """Return the work of a force along ways.

    Parameters
    ----------
    force : float
        N.
    ways : ndarray, shape (n,)
        m.

    Returns
    -------
    float
        J.

    Raises
    ------
    InputError
        The force is negative.
    """
    if force < 0.0:
        raise InputError("force is negative")
    return force * float(np.sum(ways))


class Pull(Result):
    """A pull.

    Attributes
    ----------
    rope : str
        What it is pulled by.
    """

    force: float = quantity("F", "N", "force")
    rope: str

    def heading(self):
        """Return the rope."""
        return self.rope
'''

# What is taken from it, and what is then wrong.
WRONG = {
    "a parameter that is not said": ("    force : float\n        N.\n", "", "PR01"),
    "a parameter that is not there": ("    force : float", "    power : float", "PR02"),
    "a parameter without a type": ("    force : float\n", "    force\n", "PR04"),
    "a parameter without a meaning": ("float\n        N.\n", "float\n", "PR07"),
    "no word of what is returned": (
        "    Returns\n    -------\n    float\n        J.\n\n",
        "",
        "RT01",
    ),
    "an error that is not named": ("    InputError\n", "    ValueError\n", "RS01"),
    "an array without its shape": ("ndarray, shape (n,)", "ndarray", "SH01"),
    "a field that nobody says": ("    rope : str\n", "    string : str\n", "PR01"),
}  # fmt: skip


@pytest.fixture
def faults(tmp_path, monkeypatch):
    """What is wrong with the docstrings of a module's text."""
    monkeypatch.syspath_prepend(tmp_path)

    def of(text, name="said_all"):
        # Python keeps the lines of a file that it has read: each has another name.
        (tmp_path / f"{name}.py").write_text(text, "utf-8")
        importlib.invalidate_caches()
        found = [check.faults(f"{name}.{own}") for own in ("work", "Pull", "Pull.heading")]
        sys.modules.pop(name)
        return [fault for each in found for fault in each]

    return of


def test_a_docstring_that_says_all_has_no_fault(faults):
    assert faults(GOOD) == []


@pytest.mark.ordinary(6)
@pytest.mark.parametrize("what", WRONG)
def test_what_a_docstring_leaves_out_is_found(faults, what):
    old, new, code = WRONG[what]
    text = GOOD.replace(old, new)
    assert text != GOOD
    assert any(
        fault.startswith(code) for fault in faults(text, f"said_less_{[*WRONG].index(what)}")
    )


def test_it_looks_at_the_top_of_the_package_and_at_every_page_of_the_reference():
    names = check.public_names()
    assert len(names) > 400
    wanted = "asperity.solve", "asperity.rating.Rated.to_html", "asperity.shafts.beam.deflection"
    assert {*wanted} < {*names}
    assert "asperity.slider.Model.rigid_pressing" not in names  # for rooms alone, by its page
    assert len(names) == len({*names})
