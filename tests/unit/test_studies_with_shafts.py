"""A best design whose shafts hold: their rows are constraints of a search, or it is refused."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.rating.verdict_rows import Row
from asperity.studies.climb import climb
from asperity.studies.with_shafts import Borne, with_shafts


@dataclasses.dataclass(frozen=True)
class Design:
    gearset: SimpleNamespace
    rows: tuple = ()

    @property
    def iso14521(self):
        return {"eta_z1_2": 0.9}


@dataclasses.dataclass(frozen=True)
class Best:
    before: Design
    after: Design
    made: Design | None = None
    limits: tuple = ()
    notes: tuple = ()


def gearset_at(point):
    return SimpleNamespace(q=8.0 + 6.0 * float(point[0]), alpha=14.5 + 15.5 * float(point[1]))


def rows_of(gearset):
    """A shaft that a thick worm helps, and a bearing that a steep flank wears out."""
    return (
        Row("worm shaft", "DIN 743", 0.1 * gearset.q, 1.0),
        Row("wheel bearing A", "ISO 281", 1e4 * (20.0 / gearset.alpha) ** 3, 5e3, "h"),
    )


def height(points):
    """The efficiency: thin and steep is best."""
    return np.stack([points[:, 1] - points[:, 0]], axis=-1)


def found(before, safety=1.0):
    start = np.array(before)

    def again(borne):
        top = climb(
            lambda points: np.hstack([height(points), borne.room(gearset_at, points)]), [start]
        )
        if top is None:
            raise InputError("nothing keeps it")
        return Best(Design(gearset_at(start)), Design(gearset_at(top.point)))

    best = Best(Design(gearset_at(start)), Design(gearset_at(np.array([0.0, 1.0]))))
    return with_shafts(best, rows_of, again, safety)


# As they are: both hold, the shaft fails, both fail.
@pytest.mark.parametrize("before", [(0.9, 0.2), (0.1, 0.2), (0.1, 1.0)])
@pytest.mark.parametrize("safety", [1.0, 1.1, 1.3])
def test_the_best_design_that_its_shafts_allow_is_found(before, safety):
    best = found(before, safety)
    # In closed form: as thin and as steep as the two rows allow.
    assert best.after.gearset.q == pytest.approx(10.0 * safety, rel=1e-6)
    assert best.after.gearset.alpha == pytest.approx(20.0 * (2.0 / safety) ** (1 / 3), rel=1e-6)
    assert all(row.margin >= safety for row in best.after.rows)
    assert [limit.active for limit in best.limits] == [True, True]
    assert "shafts and bearings are kept" in best.notes[-1]


def test_what_no_design_within_the_bounds_has_is_refused():
    with pytest.raises(
        InputError, match=r"1\.5 times what is asked, requirements\.safety; wheel bearing A"
    ):
        found((0.9, 0.2), 1.5)


def test_where_no_design_holds_nothing_falls_further_and_it_is_told():
    def weak(gearset):
        return (Row("worm shaft", "DIN 743", 0.1 * gearset.q, 2.0),)

    start = SimpleNamespace(q=12.0)
    asked = []

    def again(borne):
        asked.append(borne.least)
        if borne.least[0] > 0.7:
            raise InputError("nothing keeps it")
        return Best(Design(start), Design(start))

    best = with_shafts(Best(Design(start), Design(SimpleNamespace(q=8.0))), weak, again)
    assert np.allclose(asked, [[1.0], [0.6]], rtol=1e-6)
    assert "does not hold" in best.notes[-1]
    assert best.after.gearset.q == 12.0


def test_a_design_without_an_answer_has_no_room():
    def refuses(gearset):
        if gearset.q > 10.0:
            raise InputError("it cannot be")
        return rows_of(gearset)

    room = Borne(refuses, (1.0, 1.0)).room(gearset_at, np.array([[0.0, 0.0], [1.0, 0.0]]))
    assert np.isfinite(room[0]).all()
    assert np.isnan(room[1]).all()


def test_the_first_that_holds_is_the_one_that_trying_each_gives():
    borne, point = Borne(rows_of, (1.0, 1.0)), np.array([1.0 / 3.0, 0.6])
    others = point + 0.1 * np.random.default_rng(36).uniform(-1.0, 1.0, (60, 2))
    holds = np.all(borne.room(gearset_at, others) >= 0.0, axis=1)
    assert borne.first_of(gearset_at, point, others) == int(np.argmax(holds))
    assert borne.first_of(gearset_at, point, others[~holds]) is None
    assert borne.first_of(gearset_at, point, others[:0]) is None
