"""Of many designs those are shown that nothing beats once all have been judged, however few are."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from asperity.errors import InputError
from asperity.rating.verdict_rows import Row
from asperity.studies.chosen import Borne, Judges, choose, undominated

FEW = st.integers(0, 4)
DESIGN = st.tuples(FEW, FEW, st.integers(2, 8), st.integers(0, 8), st.booleans(), st.booleans())


def chosen(designs, least):
    """Return what is shown of designs, and how many were asked about."""
    rest, margins = np.array([d[:2] for d in designs], dtype=float), [d[2] for d in designs]
    margins = np.array(margins, dtype=float)
    asked = []

    def borne(keys):
        asked.append(keys["n"])
        _, _, _, margin, judged, _ = designs[keys["n"]]
        if not judged:
            raise InputError("its shafts cannot be judged")
        return Borne((Row("bearing", "ISO 281", 10.0 * margin, 10.0, "h"), Row("shaft", "", 99, 1)))

    def best(of):
        if least is None:
            return of[np.argsort(-margins[of], kind="stable")[:3]]
        return of[undominated(np.column_stack([rest, margins])[of])]

    judges = Judges(lambda n: {"n": n}, lambda keys: designs[keys["n"]][5], borne)
    # What falls short by the standards is not among what is chosen from.
    kept = np.flatnonzero(margins >= (least or -np.inf))
    found = choose(kept, margins, best, judges, least)
    return found, margins, asked


def every(designs):
    """Return the margins of all designs, minus infinity of those that are left out."""
    return np.array(
        [min(own, margin) if judged and cut else -np.inf
         for _, _, own, margin, judged, cut in designs],
        dtype=float,
    )  # fmt: skip


@settings(max_examples=100, deadline=None)
@given(st.lists(DESIGN, min_size=1, max_size=25), st.integers(1, 6))
def test_those_that_hold_and_nothing_beats_are_found_by_judging_few(designs, least):
    found, _, asked = chosen(designs, float(least))
    whole = every(designs)
    left = np.flatnonzero(whole >= least)
    rest = np.array([d[:2] for d in designs], dtype=float)
    expected = left[undominated(np.column_stack([rest, whole])[left])] if len(left) else left
    assert sorted(found.shown) == sorted(expected)
    assert len(asked) == len(set(asked))
    assert all(row.margin < least for row in found.weak)
    assert set(found.refused) == {n for n in asked if not designs[n][4]}


@settings(max_examples=100, deadline=None)
@given(st.lists(DESIGN, min_size=1, max_size=25))
def test_where_none_holds_the_nearest_are_found_by_judging_few(designs):
    found, margins, asked = chosen(designs, None)
    whole = every(designs)
    assert len(found.shown) == min(3, int(np.isfinite(whole).sum()))
    assert sorted(margins[found.shown]) == sorted(np.sort(whole[np.isfinite(whole)])[-3:])
    assert len(asked) == len(set(asked))
