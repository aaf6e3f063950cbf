"""Whether the shafts and bearings that a duty has bear what a proposed gearset puts on them."""

import re
from collections.abc import Callable, Mapping
from typing import Any

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.gearset.library import every
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.shafts.bearing import RollingBearing
from asperity.shafts.bearing_shelf import BearingPlace, from_shelf
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import WheelShaft, WormShaft
from asperity.shafts.study import prepared, studied
from asperity.start.kinds import Values
from asperity.studies.chosen import Borne
from asperity.studies.requirements import Requirements

_PLACE = re.compile(r"(\w+)\.bearing\.(\d+)")


def borne_by(
    values: Values,
    kept: Mapping[str, Any],
    operation: Operation,
    options: RatingOptions,
    requirements: Requirements,
) -> Callable[[Mapping[str, Any]], Borne] | None:
    """Return what says of a gearset, by its keys, what its shafts come to; None without shafts.

    Parameters
    ----------
    values : dict
        The tables of a case.
    kept : mapping
        What the gearset has beside its macro-geometry.
    operation, options : Operation, RatingOptions
        How it is run and rated.
    requirements : Requirements
        What is kept beside the safeties.

    Raises
    ------
    InputError
        A table that cannot be read, or bearings are to be taken from data files that have none.
    """
    worm, wheel, own = (_read(model, values) for model in (WormShaft, WheelShaft, BearingOptions))
    shelf = every(RollingBearing) if requirements.bearings == "own" else ()
    if requirements.bearings == "own" and not shelf:
        raise InputError(
            'requirements.bearings is "own", but no data file has a bearing: name one, as asperity '
            "--materials FILE size (asperity new bearing begins one)"
        )
    if worm is None and wheel is None:
        return None

    def borne(keys: Mapping[str, Any]) -> Borne:
        gearset = Gearset.model_validate({**kept, **keys}, context={"text_only": True})
        problem = prepared(gearset, operation, options, (worm, wheel), own or BearingOptions())
        chosen: dict[BearingPlace, str] = {}
        if shelf:
            problem, chosen = from_shelf(problem, shelf, requirements.safety)
        names = {f"{at.table}.bearing.{at.number + 1}": name for at, name in chosen.items()}
        found = studied(problem)
        return Borne(found.rows, names, found.lacking)

    return borne


def _read(model: type[Table], values: Values) -> Any:
    given = values.get(model.table)
    return None if given is None else model.model_validate(given, context={"text_only": True})


def with_bearings(values: Values, names: Mapping[str, str]) -> Values:
    """Return the tables of a case with bearings of these names, by where they stand."""
    made = dict(values)
    for where, name in names.items():
        found = _PLACE.fullmatch(where)
        assert found is not None
        table, number = found[1], int(found[2]) - 1
        bearings = [dict(each) for each in made[table]["bearing"]]
        bearings[number]["bearing"] = name
        made[table] = {**made[table], "bearing": bearings}
    return made
