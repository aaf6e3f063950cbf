"""Tests notice when a line of the package is broken: campaigns of 200 lines and 60, one at a time.

``python tests/mutants/run.py`` tries the same list and says which share of it was caught; with
``--told`` that of what is told, marked and ranked.
"""

import pytest
from mutants import run, sites

pytestmark = pytest.mark.slow

# The list is made when it is wanted: each worker collects this file.
ALWAYS = len(sites.known()["always"])


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    made = run.Copy(tmp_path_factory.mktemp("mutants"))
    yield made
    made.close()


def _is_noticed(copy, mutant):
    if why := run.equivalents().get(mutant.key):
        pytest.skip(why)
    line = run.tried(copy, mutant)
    # What makes a test endless is noticed by whoever runs it; `run.py --share` counts it apart.
    assert line["outcome"] != "survived", (
        f"{line['of']} tests let this through, {mutant.key}:\n{line['diff']}\n"
        "write one that does not, or say in tests/mutants/known.toml why none can"
    )


@pytest.mark.campaign
@pytest.mark.parametrize("n", range(ALWAYS))
def test_a_line_that_was_once_broken_unnoticed_is_tested(copy, n):
    _is_noticed(copy, sites.always()[n])


@pytest.mark.campaign
@pytest.mark.parametrize("n", range(sites.COUNT - ALWAYS))
def test_a_line_cannot_be_broken_unnoticed(copy, n):
    _is_noticed(copy, sites.listed()[len(sites.always()) + n])


@pytest.mark.campaign
@pytest.mark.parametrize("n", range(sites.COUNT_TOLD))
def test_what_is_told_cannot_be_broken_unnoticed(copy, n):
    _is_noticed(copy, sites.listed_told()[n])
