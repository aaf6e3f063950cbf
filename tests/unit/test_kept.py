"""What is kept of plain ways is of these as they are, and of the numbers given."""

import json

import numpy as np
from apparatus import kept, plain_body, plain_drive


def test_all_that_is_kept_is_of_the_plain_ways_as_they_are():
    known = json.loads(kept.FILE.read_text("utf-8"))
    assert {key.partition("-")[0] for key in known} == {
        kept.source(module.__file__) for module in (plain_body, plain_drive)
    }


def test_other_numbers_or_another_source_are_calculated_anew(monkeypatch, tmp_path):
    known = {}
    monkeypatch.setattr(kept, "_known", lambda: known)
    ways, tried = [tmp_path / name for name in ("a.py", "b.py")], []
    for number, way in enumerate(ways):
        way.write_text(f"{number}")

    def calculated(*given):
        tried.append(given)
        return [float(len(tried))]

    given = (1.0, np.array([2.0, 3.0])), 4
    assert kept.answer(ways[0], calculated, *given) == [1.0]
    assert kept.answer(ways[0], calculated, *given) == [1.0]
    assert kept.answer(ways[1], calculated, *given) == [2.0]
    assert kept.answer(ways[0], calculated, (1.0, np.array([2.0, 3.0 + 1e-7])), 4) == [3.0]
    assert kept.answer(ways[0], calculated, (1.0, np.array([2.0, 3.0 + 1e-12])), 4) == [1.0]
