"""What a library's machine code answers is what Numba's answers, bit for bit."""

import contextlib
import shlex

import numpy as np
import pytest
from apparatus.called import copied, moved, recorded, words

from asperity.cli.main import main

CALLS = 1000
LINES = (
    # A march of many steps proves no more of each than one of some.
    "slide table-4.3 --set vibration.start='5 ms' --set solve.duration='30 ms' --json",
    "slide table-4.3 --set solve.method=periodic --json",
    "static table-4.3 --json",
    "slide normal-pin --json",
    "flank gearset-3b --density coarse --json",
    "drive drive-thesis --json",
    "block block-longitudinal --set block.elements='[2, 2, 2]' --set block.element=hex8 "
    "--set vibration.start='0.2 ms' --set solve.step='4 us' --set solve.duration='0.8 ms' --json",
)


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.parametrize("line", LINES)
def test_a_thousand_calls_of_an_entry_answer_as_numba_does(line, monkeypatch, tmp_path):
    monkeypatch.delenv("ASPERITY_NATIVE", raising=False)
    monkeypatch.chdir(tmp_path)
    with recorded() as calls, contextlib.suppress(SystemExit):
        main(shlex.split(line))
    assert calls
    kernels = {id(kernel): kernel for kernel, _ in calls}
    answered = 0
    for own in kernels:
        starts = [arguments for kernel, arguments in calls if id(kernel) == own]
        answered += same_answers(kernels[own], starts)
    assert answered


def same_answers(kernel, starts):
    """Compare calls near those recorded; return how many the library answered."""
    rng = np.random.default_rng(1)
    answered = 0
    for number in range(CALLS):
        here = moved(starts[number % len(starts)], rng)
        there = copied(here)
        answer = kernel._native(here)
        if answer is NotImplemented:
            continue
        answered += 1
        expected = kernel._dispatcher(*there)
        assert words(answer) == words(expected), kernel.__qualname__
        # Also what was filled.
        assert words(here) == words(there), kernel.__qualname__
    return answered
