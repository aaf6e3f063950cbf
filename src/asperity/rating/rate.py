"""Rate a worm gearset by up to three standards."""

from collections.abc import Sequence
from pathlib import Path

from asperity.casefile import Case, naming_source
from asperity.errors import InputError, require_types
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating import own_table
from asperity.rating.backlash import play_of
from asperity.rating.driven import given_of, torque_notes
from asperity.rating.entries import assumptions
from asperity.rating.inputs import Inputs
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rated import Rated
from asperity.rating.result import Rating
from asperity.rating.self_locking import near_limit, self_locking
from asperity.rating.standards import STANDARDS, known_standards, rate_by, tables_of
from asperity.rating.tables import operation_of


def rate(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    standards: Sequence[str] = STANDARDS,
    *,
    folder: Path | None = None,
    tolerances: Tolerances | None = None,
) -> Rated:
    """Rate a worm gearset.

    Parameters
    ----------
    gearset : Gearset
        The ``[gearset]`` table.
    operation : Operation
        The ``[operation]`` table.
    options : RatingOptions, optional
        The ``[rating]`` table.
    standards : sequence of {'iso14521', 'bs721', 'agma6034'}
        Which to apply.
    folder : path, optional
        Where a relative file name among the options starts.
    tolerances : Tolerances, optional
        The ``[tolerances]`` table, which leaves a backlash.

    Returns
    -------
    Rated
        A standard that cannot be applied is None, and the notes say why.

    Raises
    ------
    InputError
        The gearset's numbers do not belong together, or the only standard asked for cannot be
        applied; `asperity.rating.iso14521.film_failure.FilmParameterError` where h* is
        not above zero.
    """
    require_types(
        "rate",
        gearset=(gearset, Gearset),
        operation=(operation, Operation),
        options=(options, RatingOptions | None),
        tolerances=(tolerances, Tolerances | None),
    )
    wanted = known_standards(standards)
    inputs = given_of(gearset, operation, options or RatingOptions(), wanted)
    return rated_of(inputs, operation, wanted, folder, tolerances)


def rated_of(
    inputs: Inputs,
    as_run: Operation,
    wanted: Sequence[str],
    folder: Path | None,
    tolerances: Tolerances | None,
) -> Rated:
    """Return the rating that `rate` describes, of what is given; ``as_run`` as it was operated."""
    gearset = inputs.gearset
    tables = tables_of(inputs.options, folder)
    found: dict[str, Rating] = {}
    unanswered: dict[str, str] = {}
    steel = gearset.worm_material.taken_for
    notes = []
    if steel is not None:
        notes.append(f"worm material: {steel.note}, by {steel.name} ({steel.confidence})")
    rows, told = own_table.rows_of(inputs)
    for name in wanted:
        try:
            found[name] = rate_by(name, inputs, tables)
        except InputError as error:
            if len(wanted) == 1:
                raise
            notes.append(f"{name}: {error}")
            unanswered[name] = str(error)
    locking = self_locking(inputs, found, tables)
    return Rated(
        levers=(),
        alternatives=(),
        unanswered=unanswered,
        contact=None,
        backlash=play_of(gearset, tolerances, found),
        rating_inputs=inputs,
        tables_bs721=tables,
        gearset=gearset,
        geometry=gearset.geometry,
        iso14521=found.get("iso14521"),
        bs721=found.get("bs721"),
        agma6034=found.get("agma6034"),
        self_locking=locking,
        notes=(
            *torque_notes(as_run, inputs.operation),
            *told,
            *notes,
            *near_limit(locking, gearset.geometry, inputs),
        ),
        rows=rows,
        assumed=assumptions(inputs),
    )


def rate_case(case: Case, standards: Sequence[str] = STANDARDS) -> Rated:
    """Rate the worm gearset of a case file; as `rate`.

    Parameters
    ----------
    case : Case
        With ``[gearset]`` and ``[operation]``.
    standards : sequence of str
        Of `STANDARDS`.

    Returns
    -------
    Rated
        As of `rate`.
    """
    options = case.get(RatingOptions)
    gearset, operation = case.require(Gearset), run_of(case)
    with naming_source(case):
        off, folder = case.get(Tolerances), case.folder
        return rate(gearset, operation, options, standards, folder=folder, tolerances=off)


def run_of(case: Case) -> Operation:
    """Return how the gearset of a case is run; what is refused names the case."""
    with naming_source(case):
        return operation_of(case)
