import dataclasses
import doctest
import html.parser
import json
import math

import pytest

from asperity.errors import InputError
from asperity.rating import result, verdict
from asperity.rating.result import Entry, Rating
from asperity.results.terminal import rendered
from asperity.sources import Source

VERIFIED = Source("ISO/TR 14521:2010", "verified")
ENTRIES = (
    Entry("ratio", "u", 15.0, "", "gear ratio", "z_2/z_1", VERIFIED),
    Entry("mu_zm", "mu_zm", 0.134415, "", "mean friction", "mu_0T Y_S Y_G [a<b]", VERIFIED),
    Entry("seals", "n_D", 2, "", "seals", "input", Source("the case", "one source"), True),
    Entry("Y_NL", "Y_NL", 1.0, "", "life factor", "1", Source("DIN", "from memory", "a & b"), True),
    Entry("locks", "", False, "", "whether it locks itself", "eta_z2-1 <= 0", VERIFIED),
    Entry("flank", "", "ZI", "", "flank", "input", VERIFIED),
)
RATING = Rating(
    "ISO/TR 14521:2010",
    ENTRIES,
    violations=("centre distance a is 60 mm; ISO/TR 14521:2010 is valid from 65 to 250 mm",),
    notes=("without a fan",),
)


class Tags(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.open, self.counts, self.words = [], {}, []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.counts[tag] = self.counts.get(tag, 0) + 1

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


def printed(rating, width=200):
    return rendered([rating.table()], width)


def test_values_are_found_by_key_and_kept_in_order():
    assert RATING["mu_zm"] == 0.134415
    assert RATING.entry("ratio").symbol == "u"
    assert [entry.key for entry in RATING] == [entry.key for entry in ENTRIES]
    assert len(RATING) == len(ENTRIES)
    assert "ratio" in RATING
    assert "mu" not in RATING


def test_an_unknown_key_is_named_with_the_one_that_is_near():
    with pytest.raises(InputError, match=r"'mu_z' is not part of the rating by ISO.*'mu_zm'"):
        RATING["mu_z"]


@pytest.mark.parametrize("key", [5, None, ("mu_zm",), b"mu_zm", ["mu_zm"], 2.5])
def test_a_key_that_is_no_text_is_refused_in_one_line(key):
    assert key not in RATING
    with pytest.raises(InputError, match="is not part of the rating by ISO") as raised:
        RATING[key]
    assert "did you mean" not in str(raised.value)
    assert "\n" not in str(raised.value)


def test_json_has_each_value_under_its_key_and_the_lists():
    plain = json.loads(json.dumps(RATING.to_json(), allow_nan=False))
    assert plain["ratio"] == 15.0
    assert plain["locks"] is False
    assert plain["flank"] == "ZI"
    assert plain["violations"] == list(RATING.violations)
    assert plain["notes"] == ["without a fan"]
    assert plain["assumed"] == ["seals", "Y_NL"]
    assert plain["from_memory"] == ["Y_NL"]
    assert plain["standard"] == "ISO/TR 14521:2010"


def test_what_rests_on_memory_or_was_assumed_is_said_in_words():
    remarks = RATING.remarks()
    assert remarks[0].startswith("outside its validity: centre distance a is 60 mm")
    assert remarks[1] == "from memory, check before use: Y_NL"
    assert remarks[2].endswith("n_D, Y_NL")
    assert remarks[3] == "without a fan"
    assert Rating("a", (ENTRIES[0],)).remarks() == ()


def test_rows_have_every_column_as_text():
    rows = [entry.row() for entry in RATING]
    assert all(tuple(row) == result.COLUMNS for row in rows)
    assert all(isinstance(text, str) for row in rows for text in row.values())
    assert rows[1]["value"] == "0.13442"
    assert rows[3]["confidence"] == "from memory"
    assert rows[3]["note"] == "a & b"
    assert [row["assumed"] for row in rows] == ["", "", "assumed", "assumed", "", ""]
    assert [row["value"] for row in rows[4:]] == ["no", "ZI"]


def test_the_terminal_shows_every_entry_and_remark():
    text = printed(RATING)
    assert "mu_0T Y_S Y_G [a<b]" in text
    assert "from memory" in text
    for remark in RATING.remarks():
        assert remark in " ".join(text.split())


def test_a_narrow_terminal_cuts_no_value_short():
    text = printed(RATING, width=60)
    assert all(entry.text in text for entry in RATING)


def test_html_is_whole_and_escaped():
    tags = Tags(RATING._repr_html_())
    assert tags.open == []
    assert tags.counts["tr"] == 1 + len(ENTRIES)
    assert tags.counts["td"] == len(ENTRIES) * len(result.COLUMNS)
    assert tags.counts["li"] == len(RATING.remarks())
    assert "mu_0T Y_S Y_G [a<b]" in tags.words
    assert "ul" not in Tags(Rating("a", (ENTRIES[0],))._repr_html_()).counts


def test_a_data_frame_holds_numbers_by_key():
    frame = RATING.to_frame()
    assert list(frame.columns) == list(result.COLUMNS)
    assert frame.loc["mu_zm", "value"] == 0.134415
    assert frame.loc["seals", "value"] == 2
    assert bool(frame.loc["seals", "assumed"]) is True
    assert frame.index.name == "key"
    assert frame.attrs["violations"] == list(RATING.violations)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_an_entry_holds_finite_numbers_only(value):
    with pytest.raises(ValueError, match=r"mu_zm is .*; a rating holds finite numbers only"):
        dataclasses.replace(ENTRIES[1], value=value)


def test_a_key_occurs_once():
    with pytest.raises(ValueError, match="ratio: an entry's key must occur once"):
        Rating("a", (ENTRIES[0], ENTRIES[0]))


def test_examples_in_the_docstrings_hold():
    assert doctest.testmod(result).failed == 0
    assert doctest.testmod(verdict).failed == 0


def test_a_number_is_found_by_the_symbol_that_is_printed():
    source = Source("ISO/TR 14521:2010", "verified")
    entry = Entry("safety_pitting", "S_H", 1.6, "", "safety against pitting", "", source)
    rating = Rating("ISO/TR 14521:2010", (entry,))
    assert rating["S_H"] == rating["safety_pitting"] == 1.6
    assert "S_H" in rating
    with pytest.raises(InputError, match=r"did you mean 'S_H'\?"):
        rating["S_h"]
