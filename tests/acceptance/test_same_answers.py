"""Every command answers what it answered when its answers were recorded, to twelve digits.

Nothing is left out of it but by `compare.LEFT_OUT`: an answer that changes on purpose is recorded
again, by `python tests/answers/record.py --again WORDS`.
"""

import pytest
from apparatus.called import left_to_numba
from compare import differences
from observe import command_lines, observe
from record import records


def _marked(group, *marks):
    return [
        pytest.param(line.split()[0], line, id=line, marks=marks) for line in command_lines(group)
    ]


SLOW = pytest.mark.slow, pytest.mark.campaign


@pytest.mark.parametrize(("command", "line"), _marked("ordinary") + _marked("slow", *SLOW))
def test_the_answer_is_the_recorded_one(command, line, tmp_path):
    recorded = records(command)[line]
    with left_to_numba() as unlisted:
        observed = observe(line, tmp_path)
    found = differences(line, recorded, observed)
    assert not found, "\n".join([line, *found[:20], f"{len(found)} differences"])
    # Where it fails, `python tests/harvest.py --again` with words of the line.
    assert not unlisted, line
