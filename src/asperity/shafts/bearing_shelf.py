"""Bearings of a shelf: which of those that somebody has stand where a shaft names none.

The smallest that does what is asked is taken, each place for itself: how the axial force is shared
rests on what a place carries, and not on which bearing stands there. Adjusted bearings share it by
what both are, so that they are named in the case.
"""

from collections.abc import Sequence
from typing import NamedTuple

from asperity.errors import InputError
from asperity.rating.standards import rate_by
from asperity.shafts.bearing import RollingBearing
from asperity.shafts.loads import loads_of
from asperity.shafts.model import Model
from asperity.shafts.parameters import ShaftBearing
from asperity.shafts.shaft import LoadedShaft
from asperity.shafts.study import Prepared, asked_life, found_of

_SAME = 1e-9


class BearingPlace(NamedTuple):
    """A place of a bearing: the table of its shaft, and which of the table's list it is."""

    table: str
    number: int


def from_shelf(
    problem: Prepared, shelf: Sequence[RollingBearing], factor: float = 1.0
) -> tuple[Prepared, dict[BearingPlace, str]]:
    """Return a problem with a bearing of a shelf at each place that names none.

    Parameters
    ----------
    problem : Prepared
        Of `asperity.shafts.study.prepare`.
    shelf : sequence of RollingBearing
        What there is.
    factor : float
        Times what is asked of life and static safety.

    Returns
    -------
    problem : Prepared
        With bearings at all places.
    chosen : dict of BearingPlace to str
        Their names. Where none does what is asked it is the one that comes nearest.

    Raises
    ------
    InputError
        A place that no bearing of the shelf fits.
    """
    models = {"worm_shaft": problem.worm, "wheel_shaft": problem.wheel}
    if all(m is None or all(place.bearing for place in m.places) for m in models.values()):
        return problem, {}
    loads = loads_of(
        problem.rating_inputs, rate_by("iso14521", problem.rating_inputs, problem.tables)
    )
    life = asked_life(problem, loads)
    chosen: dict[BearingPlace, str] = {}
    for key, found in found_of(problem, loads).items():
        bearings = list(found.model.table.bearing)
        for number, place in enumerate(bearings):
            if place.bearing is None:
                own = _best_bearing(found, place, shelf, life, factor)
                assert own.bearing is not None
                bearings[number], chosen[BearingPlace(key, number)] = own, own.bearing.name
        table = found.model.table.model_copy(update={"bearing": tuple(bearings)})
        models[key] = found.model._replace(table=table)
    return problem._replace(worm=models["worm_shaft"], wheel=models["wheel_shaft"]), chosen


def _best_bearing(
    shaft: LoadedShaft,
    bearing: ShaftBearing,
    shelf: Sequence[RollingBearing],
    life: float,
    factor: float,
) -> ShaftBearing:
    model = shaft.model
    number = 0 if bearing is model.places[0] else 1
    best: tuple[float, ShaftBearing] | None = None
    for candidate in _fitting(model, bearing, shelf):
        assert candidate.bearing is not None
        asked = shaft.options.at_rest(candidate.bearing.elements)
        margin = min(
            min(own.judged_hours / life, own.static_safety / asked)
            for own in shaft.lives_of(number, candidate).values()
        )
        if best is None or margin > best[0]:
            best = margin, candidate
        if margin >= factor:
            break
    assert best is not None
    return best[1]


def _fitting(
    model: Model, place: ShaftBearing, shelf: Sequence[RollingBearing]
) -> list[ShaftBearing]:
    """Return a place with each bearing that fits it, the smallest first."""
    at, seats = 1e3 * place.at, set[float]()
    for section, stretch in zip(model.table.section, model.stretches, strict=True):
        if section.diameter is not None and stretch.start - _SAME <= at <= stretch.end + _SAME:
            seats.add(section.diameter)
    fitting, why = [], ""
    for bearing in sorted(shelf, key=_size):
        if not any(abs(bearing.bore - seat) < _SAME for seat in seats):
            continue
        given = {key: getattr(place, key) for key in place.model_fields_set}
        try:
            fitting.append(ShaftBearing.model_validate({**given, "bearing": bearing}))
        except InputError as error:
            why = why or f": {error}"
    if not fitting:
        bores = " or ".join(f"{1e3 * seat:g}" for seat in sorted(seats)) or "the threads'"
        raise InputError(
            f"{model.table.table}.bearing at {at:g} mm names none, and of the {len(shelf)} of data "
            f"files none has a bore of {bores} mm and suits the place{why}"
        )
    return fitting


def _size(bearing: RollingBearing) -> tuple[float, float, float]:
    return bearing.outside_diameter, bearing.width, bearing.dynamic_rating
