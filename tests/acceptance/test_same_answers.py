"""Every command answers what it answered when its answers were recorded, to twelve digits."""

import pytest
from compare import differences
from observe import command_lines, observe
from record import records

CHANGES = (
    # (command lines, what in their answers, why it is no longer what was recorded)
)


def _marked(group, *marks):
    return [pytest.param(line, id=line, marks=marks) for line in command_lines(group)]


@pytest.mark.parametrize("line", _marked("ordinary") + _marked("slow", pytest.mark.slow))
def test_the_answer_is_the_recorded_one(line, tmp_path):
    recorded = records(line.split()[0])[line]
    found = differences(line, recorded, observe(line, tmp_path), CHANGES)
    assert not found, "\n".join([line, *found[:20], f"{len(found)} differences"])
