"""A best design whose shafts hold: the worm gets thicker until they do, or it is refused."""

import dataclasses
from types import SimpleNamespace

import pytest

from asperity.errors import InputError
from asperity.rating.verdict_rows import Row
from asperity.studies.design import Bounds
from asperity.studies.with_shafts import with_shafts


@dataclasses.dataclass(frozen=True)
class Design:
    gearset: SimpleNamespace
    rows: tuple = ()

    @property
    def geometry(self):
        return self.gearset.geometry

    @property
    def iso14521(self):
        return {"eta_z1_2": 0.9}


@dataclasses.dataclass(frozen=True)
class Best:
    before: Design
    after: Design
    made: Design | None = None
    notes: tuple = ()


def of(factor):
    return Design(SimpleNamespace(geometry=SimpleNamespace(diameter_factor=factor)))


def rows_of(gearset):
    """A shaft whose safety is a tenth of its diameter factor."""
    return (Row("worm shaft", "DIN 743", 0.1 * gearset.geometry.diameter_factor, 1.0),)


def found(before, safety, most=14.0):
    bounds = Bounds(diameter_factor=(8.0, most))

    def again(within):
        return Best(of(before), of(within.diameter_factor[0]))

    return with_shafts(Best(of(before), of(8.0)), rows_of, bounds, again, safety)


@pytest.mark.parametrize(("before", "safety"), [(12.0, 1.0), (12.0, 1.1), (9.0, 1.1), (10.5, 1.3)])
def test_shafts_have_the_safety_that_is_required(before, safety):
    best = found(before, safety).after
    (row,) = best.rows
    # Nearly the thinnest worm that has it.
    assert safety <= row.value < safety + 0.1 * 6.0 / 2**5 + 1e-9


def test_what_no_worm_within_the_bounds_has_is_refused():
    with pytest.raises(
        InputError, match=r"1\.5 times what is asked, requirements\.safety; worm shaft"
    ):
        found(12.0, 1.5)


def test_without_a_required_safety_what_fails_as_it_is_is_told():
    best = found(9.0, 1.0)
    assert "does not hold" in best.notes[-1]
    assert best.after.geometry.diameter_factor == 8.0
