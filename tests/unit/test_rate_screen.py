"""The screen of a verdict says how much it leaves out."""

import re

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate


@pytest.mark.parametrize("case", ["gearset-2", "gearset-3", "gearset-3b"])
def test_remarks_that_are_shown_and_those_that_are_counted_are_all_there_are(case):
    read = read_case(case, case_tables())
    rated = rate(read.require(Gearset), read.require(Operation), read.require(RatingOptions))
    outside = [text for one in rated.found.values() for text in (*one.violations, *one.gaps)]
    said = {f"{one.standard}: {why}" for one in rated.verdict.standing for why in one.reasons}
    remarks = [*(note for note in rated.notes if note not in said), *outside]
    screen = rated.brief()
    shown = len(re.findall("^- ", screen, re.MULTILINE))
    left = re.search(r"(\d+) remarks: --full", screen)
    assert 0 < shown <= len(remarks)
    assert int(left.group(1) if left else 0) == len(remarks) - shown
