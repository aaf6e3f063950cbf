"""Tables of a case file that describe a worm gearset and how it is rated."""

import math
from typing import Protocol, runtime_checkable

from asperity.casefile import Case, Table
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.housing import Housing
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.spectrum import Spectrum

_SAME = 1e-6

TABLES: dict[str, type[Table]] = {
    table.table: table
    for table in (Gearset, Tolerances, Operation, RatingOptions, Spectrum, Housing)
}


@runtime_checkable
class _Spans(Protocol):
    """What of a case knows how far the worm's bearings stand apart: its shaft, of a room above."""

    @property
    def bearing_span(self) -> float:
        """In m."""


def operation_of(case: Case) -> Operation:
    """Return how the gearset of a case is run, with its load spectrum, housing and bearings' span.

    Raises
    ------
    InputError
        There is no ``[operation]``, or the tables do not go together.
    """
    run = case.require(Operation).with_tables(case.get(Spectrum), case.get(Housing))
    shaft = case.tables.get("worm_shaft")
    return spanned(run, shaft.bearing_span) if isinstance(shaft, _Spans) else run


def spanned(run: Operation, span: float) -> Operation:
    """Return an operation with the distance between the bearings that a shaft has, m.

    Raises
    ------
    InputError
        It has another one.
    """
    own = run.bearing_span
    if own is None:
        return run.model_copy(update={"bearing_span": span}, units="SI")
    if math.isclose(own, span, rel_tol=_SAME):
        return run
    raise InputError(
        f"operation.bearing_span is {1e3 * own:.6g} mm, and the bearings of [worm_shaft] stand "
        f"{1e3 * span:.6g} mm apart: leave operation.bearing_span out"
    )
