"""What is read of a report: its numbers with their keys, its sentences, what it asks for."""

import decimal
import functools
import html.parser
import math
import operator
import re

import numpy as np
import pytest


class Page(html.parser.HTMLParser):
    """What is checked of a page: its numbers with their keys, its tags, and what they ask for.

    And its sentences without these numbers.
    """

    def __init__(self, text):
        super().__init__()
        self.numbers, self.tags, self.asked, self.sentences = [], [], [], []
        self._open, self._in_sentence = None, False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.tags.append(tag)
        self.asked += [found[key] for key in ("src", "href") if key in found]
        if tag in ("p", "li"):
            self.sentences.append("")
            self._in_sentence = True
        if tag == "data" or "data-value" in found:
            value = found.get("value", found.get("data-value"))
            times = float(found.get("data-times", 1.0))
            self._open = [float(value), found.get("data-key"), "", times]

    def handle_data(self, data):
        if self._open is not None:
            self._open[2] += data
        elif self._in_sentence:
            self.sentences[-1] += data

    def handle_endtag(self, tag):
        if tag in ("data", "tspan") and self._open is not None:
            self.numbers.append(tuple(self._open))
            self._open = None
        if tag in ("p", "li"):
            self._in_sentence = False


def check_numbers(page, answer):
    """Hold every number of a page against the JSON, by its key."""
    for value, key, shown, times in page.numbers:
        assert key is not None, shown
        path = (int(part) if part.isdigit() else part for part in key.split("."))
        assert functools.reduce(operator.getitem, path, answer) == value, key
        # A sentence has fewer digits than a table: what is shown is rounded in its last one.
        least = last_digit(shown)
        assert float(shown) == pytest.approx(times * value, rel=6e-5, abs=least), (key, shown)


SCALES = (*(10.0**power for power in range(-9, 10)), 180.0 / math.pi)
"""What units of a table are of those in JSON."""


def check_told(page, answer):
    """Hold every number of a page that has no key against all that JSON tells, in any unit."""

    def numbers(part):
        if isinstance(part, dict | list):
            for value in part.values() if isinstance(part, dict) else part:
                yield from numbers(value)
        elif isinstance(part, int | float):
            yield float(part)

    known = np.unique(np.abs([*numbers(answer)])) if answer else np.zeros(0)
    known = np.sort(np.outer(SCALES, known).ravel())
    for value, key, shown, _ in page.numbers:
        if key is None and value:
            # What was rounded for the table is as near as its last digit.
            allowed = max(1e-9 * abs(value), last_digit(shown))
            place = np.searchsorted(known, abs(value) - allowed)
            assert place < len(known), shown
            assert known[place] <= abs(value) + allowed, shown


def last_digit(shown):
    """Return half of what the last digit of a number is worth, and a little more."""
    digits = decimal.Decimal(shown)
    return 0.51 * 10.0 ** (digits if "." in shown else digits.normalize()).as_tuple().exponent


NAMED = (
    r"(ISO/TR|ISO/TS|ANSI/AGMA|AGMA|BS|ISO|DIN) "
    r"[\d.]+(-[A-Z]?\d+)?(:\d+)?(, table \d+)?(, series \d+)?",
    r"\b[A-Za-z]+_\w+",
)
"""Digits that are no numbers: names of standards, and symbols."""

ANGLES = r"friction ([\d.]+) to ([\d.]+) deg"
"""Of the frictions that JSON tells, the least and the greatest as angles."""


def unmarked(page, answer):
    """Return the sentences with digits that are not marked and do not stand in the JSON."""

    def texts(part):
        if isinstance(part, dict):
            for key, value in part.items():
                yield from texts(key)
                yield from texts(value)
        elif isinstance(part, list):
            for value in part:
                yield from texts(value)
        elif isinstance(part, str):
            yield part

    # A word or a digit alone proves nothing.
    known = sorted({text for text in texts(answer) if len(text) > 12}, key=len, reverse=True)
    found = []
    for sentence in page.sentences:
        for angles in re.findall(ANGLES, sentence):
            frictions = [one["friction"] for one in answer["self_locking"]["verdicts"]]
            ends = (math.degrees(math.atan(end(frictions))) for end in (min, max))
            assert angles == tuple(f"{end:.2g}" for end in ends)
        rest = re.sub(ANGLES, "", sentence)
        for text in known:
            rest = rest.replace(text, "")
        for pattern in NAMED:
            rest = re.sub(pattern, "", rest)
        if re.search(r"\d", rest):
            found.append(rest)
    return found
