"""The screen of a verdict says how much it leaves out."""

import re

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate, rate_case


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


def test_every_force_names_the_standard_that_it_is_by():
    """Each has its own friction: of one force on the worm two were told, 2 % apart."""
    rated = rate_case(read_case("gearset-3", case_tables()))
    told = rated.to_json()
    assert {one["standard"] for one in told["forces"].values()} == {"ISO/TR 14521"}
    iso, agma = (told[name][key] for name, key in (("iso14521", "F_tm1_N"), ("agma6034", "W_W_N")))
    assert iso != pytest.approx(agma, rel=1e-3)
    assert abs(told["forces"]["clockwise"]["worm_tangential_N"]) == pytest.approx(iso)
    named = {"F_tm1": "ISO/TR 14521", "F_tm2": "ISO/TR 14521", "F_rm": "ISO/TR 14521"}
    named |= dict.fromkeys(("W_G", "W_W", "W_f"), "AGMA 6034")
    screen = {row[0]: row for table in rated.tables() for row in table.rows}
    for symbol, by in named.items():
        assert any(str(cell).endswith(f" by {by}") for cell in screen[symbol]), symbol
    titles = [one.title for one in rated.sections()]
    assert "Forces on shafts and bearings, by ISO/TR 14521" in titles
