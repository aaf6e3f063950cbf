"""A gearset's case from ratio, torque and speed alone."""

from typing import Any

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import Operation, RatingOptions
from asperity.start.kinds import KINDS, Values
from asperity.studies.proposals import Proposals, propose
from asperity.units import to_si

MACRO = ("starts", "wheel_teeth", "centre_distance", "axial_module", "diameter_factor")
"""Keys of a gearset that are proposed."""

_STAND_IN = {"starts": 1, "wheel_teeth": 40, "centre_distance": "100 mm", "axial_module": "4 mm"}


def ratio_of(text: object) -> float:
    """Return a ratio that somebody gave; raises InputError."""
    try:
        return to_si(text, "")
    except InputError:
        raise InputError(f"ratio is {text!r}; it must be a number such as 40") from None


def proposals(
    values: Values, ratio: float, rank: str = "size", *, exact: bool = False
) -> Proposals:
    """Propose gearsets for what a case file begins with.

    Parameters
    ----------
    values : dict
        The tables ``gearset``, ``operation`` and perhaps ``rating`` as a file has them; what the
        gearset says of its macro-geometry is replaced.
    ratio : float
        Of the speeds.
    rank, exact
        As in `asperity.studies.proposals.propose`.
    """
    drop = (*MACRO, "worm_pitch_diameter", "profile_shift")
    kept = {key: value for key, value in values["gearset"].items() if key not in drop}
    gearset = _table(Gearset, kept | _STAND_IN)
    operation = _table(Operation, values["operation"])
    options = _table(RatingOptions, values.get("rating", {}))
    return propose(ratio, gearset, operation, options, rank=rank, exact=exact)


def begun() -> Values:
    """Return what a gearset's file begins with."""
    return KINDS["gear"].begun()


def _table(model: type[Table], values: dict[str, Any]) -> Any:
    return model.model_validate(values, context={"text_only": True})
