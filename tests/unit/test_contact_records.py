"""What compiled functions take of one body of several is what is meant for that body."""

import numpy as np
import pytest

from asperity.contact.candidates.records import (
    Answer,
    Candidates,
    Kept,
    answer_of,
    candidates_of,
    kept_of,
)

BODIES = 3


@pytest.mark.parametrize("k", range(BODIES))
@pytest.mark.parametrize(
    ("record", "taken"), [(Candidates, candidates_of), (Answer, answer_of), (Kept, kept_of)]
)
def test_what_is_taken_of_one_body_is_its_row_of_every_array(record, taken, k):
    several = record(*(np.zeros((BODIES, 2)) for _ in record._fields))
    part = taken._function(several, k)
    assert type(part) is record
    # What a solve writes for this body goes to its rows, and to no others.
    for n, values in enumerate(part):
        values += 1.0 + n
    for n, values in enumerate(several):
        assert np.unique(values[k]) == pytest.approx([1.0 + n]), record._fields[n]
        assert not np.delete(values, k, axis=0).any(), record._fields[n]
