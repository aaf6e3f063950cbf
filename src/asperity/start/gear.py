"""A gearset's case from ratio, torque and speed alone."""

import functools
import math
from collections.abc import Collection, Mapping
from typing import Any

from asperity.casefile import Table
from asperity.commands import Command, Option
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.parameters import Disc, Hob, Modification, Mount
from asperity.gearset.masses import masses
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.housing import Housing
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.spectrum import Spectrum
from asperity.rating.tables import spanned
from asperity.shafts.parameters import WormShaft
from asperity.start.borne import borne_by
from asperity.start.kinds import KINDS, Values
from asperity.studies.proposals import propose
from asperity.studies.proposed import Proposals
from asperity.studies.requirements import Requirements
from asperity.units import quantity_of, to_si

MACRO = ("starts", "wheel_teeth", "centre_distance", "axial_module", "diameter_factor")
"""Keys of a gearset that are proposed."""

_HELD = (*MACRO, "worm_pitch_diameter", "profile_shift")
_COUNTED = {
    "starts": 1, "wheel_teeth": 40, "axial_module": "4 mm", "diameter_factor": 10.0,
    "worm_material": "case-hardened steel", "wheel_material": "CuSn12Ni2-C-GZ",
}  # fmt: skip
_STAND_IN = {"starts": 1, "wheel_teeth": 40, "centre_distance": "100 mm", "axial_module": "4 mm"}


SIZE = Command(
    "size",
    "Propose worm gearsets for a ratio, a torque and a speed, rated by all standards.",
    "With --out also report.html, size.json, size.nc and a case file for each proposal.",
    module="",
    case="",
    options=(
        Option("ratio", "of the speeds", "RATIO", default=None),
        Option("output_torque", "of the wheel", "TORQUE", default=None),
        Option("worm_speed", "of the worm", "SPEED", default=None),
        Option("rank", "size, efficiency or margin", "BY", default="size"),
        Option("locks", "rest or motion: when the worm must lock itself", "WHEN", default=""),
        Option("uncut", "whether the wheels of those that hold are not cut", default=False),
    ),
)
"""As it is asked from a page."""


def ratio_of(text: object) -> float:
    """Return a ratio that somebody gave; raises InputError."""
    try:
        return to_si(text, "")
    except InputError:
        raise InputError(f"ratio is {text!r}; it must be a number such as 40") from None


def proposals(
    values: Values,
    ratio: float | None = None,
    rank: str = "size",
    *,
    exact: bool = False,
    cut: bool = False,
    locks: str = "",
) -> Proposals:
    """Propose gearsets for what a case file begins with.

    Parameters
    ----------
    values : dict
        The tables ``gearset``, ``operation`` and perhaps ``rating``, ``spectrum``, ``housing`` and
        ``requirements`` as a file has them; what the gearset says of its macro-geometry is held,
        and the rest of it proposed.
    ratio : float, optional
        Of the speeds; left out: that of ``requirements``, or of teeth and starts that are held.
    rank, exact
        As in `asperity.studies.proposals.propose`.
    cut : bool
        Whether to cut the wheel of each one that is shown, and leave out what no hob cuts.
    locks
        As in `asperity.studies.proposals.propose`.

    Raises
    ------
    InputError
        No ratio, or two of them; and as in `asperity.studies.proposals.propose`.
    """
    asked: Requirements = _table(Requirements, values.get("requirements", {}))
    kept = {key: value for key, value in values["gearset"].items() if key not in _HELD}
    held = _held({key: value for key, value in values["gearset"].items() if key in _HELD})
    gearset = _table(Gearset, kept | _STAND_IN)
    operation = operation_of(values)
    options = _table(RatingOptions, values.get("rating", {}))
    return propose(
        _ratio(ratio, asked, held),
        gearset,
        operation,
        options,
        rank=rank,
        exact=exact,
        can_be_cut=functools.partial(_can_be_cut, kept) if cut else None,
        borne=borne_by(values, kept, operation, options, asked),
        details=functools.partial(_details, kept, values),
        held=held,
        locks=locks,
        requirements=asked,
    )


def _ratio(given: float | None, requirements: Requirements, held: Mapping[str, float]) -> float:
    if given is None:
        if requirements.ratio is None and {"starts", "wheel_teeth"} <= held.keys():
            return held["wheel_teeth"] / held["starts"]
        if requirements.ratio is None:
            raise InputError("ratio is missing: give --ratio 40, or --set requirements.ratio=40")
        return requirements.ratio
    if requirements.ratio is not None and not math.isclose(given, requirements.ratio):
        raise InputError(
            f"ratio is {given:g}, and requirements.ratio {requirements.ratio:g}; keep one of them"
        )
    return given


def operation_of(values: Values) -> Operation:
    """Return how it is run, with spectrum, housing and the bearings' span; raises InputError."""
    run: Operation = _table(Operation, values["operation"])
    tables = {
        model.table: _table(model, values[model.table])
        for model in (Spectrum, Housing)
        if model.table in values
    }
    run = run.with_tables(**tables)
    if WormShaft.table not in values:
        return run
    return spanned(run, _table(WormShaft, values[WormShaft.table]).bearing_span)


def _held(values: Mapping[str, Any]) -> dict[str, float]:
    """Return what is given of the macro-geometry as numbers, lengths in mm; raises InputError."""
    counts = {key: value for key, value in values.items() if key in ("starts", "wheel_teeth")}
    one = _table(Gearset, _COUNTED | counts)
    held = {key: float(getattr(one, key)) for key in counts}
    for key, value in values.items():
        quantity = quantity_of(Gearset, key)
        if key not in counts and quantity is not None:
            try:
                number = quantity.check(value, text_only=True)
            except InputError as error:
                raise InputError(f"gearset.{key} is {value!r}; {error}") from None
            held[key] = float(f"{1e3 * number:.12g}") if quantity.unit == "m" else number
    if "diameter_factor" in held and "worm_pitch_diameter" in held:
        raise InputError(
            "gearset.diameter_factor and gearset.worm_pitch_diameter are given; keep one of them"
        )
    return held


def _can_be_cut(values: Mapping[str, Any], keys: Mapping[str, Any]) -> bool:
    from asperity.flanks.wheel.enveloped import Wheel
    from asperity.flanks.worm.setting import Pair

    try:
        Wheel.cut(Pair.of(_table(Gearset, {**values, **keys})))
    except (InputError, ConvergenceError):
        return False
    return True


def _details(kept: Mapping[str, Any], values: Values, keys: Mapping[str, Any]) -> dict[str, Any]:
    """Return what a gearset weighs and, with tolerances, its backlash by its exact flanks."""
    gearset = _table(Gearset, {**kept, **keys})
    whole, rim = masses(gearset)
    told: dict[str, Any] = {"mass_kg": whole, "rim_kg": rim}
    if Tolerances.table in values:
        from asperity.flanks.study.rated_play import Manufacture, exact_backlash

        tables = (
            _table(model, values[model.table]) if model.table in values else None
            for model in (Hob, Mount, Modification, Disc)
        )
        try:
            play = exact_backlash(
                gearset, Manufacture(*tables), _table(Tolerances, values["tolerances"])
            )
        except ConvergenceError:
            return told
        at_wheel = play.states["new"].times(play.measures[2].factor)
        told["backlash_arcmin"] = (at_wheel.least, at_wheel.greatest)
    return told


def drop_begun_life(values: Values, keys: Collection[str]) -> None:
    """Leave out the life that a file begins with where the steps of a spectrum say it.

    Parameters
    ----------
    values : dict
        The tables, changed in place.
    keys : collection of str
        Keys that somebody gave, as ``table.key``; a life among them stays.
    """
    if "spectrum" in values and "operation.life" not in keys:
        values["operation"].pop("life", None)


def begun() -> Values:
    """Return what a gearset's file begins with."""
    return KINDS["gear"].begun()


def _table(model: type[Table], values: dict[str, Any]) -> Any:
    return model.model_validate(values, context={"text_only": True})
