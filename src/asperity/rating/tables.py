"""Tables of a case file that describe a worm gearset and how it is rated."""

from asperity.casefile import Case, Table
from asperity.gearset import Gearset
from asperity.rating.housing import Housing
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.spectrum import Spectrum

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (Gearset, Operation, RatingOptions, Spectrum, Housing)
}


def operation_of(case: Case) -> Operation:
    """Return how the gearset of a case is run, with its load spectrum and housing.

    Raises
    ------
    InputError
        There is no ``[operation]``, or the tables do not go together.
    """
    return case.require(Operation).with_tables(case.get(Spectrum), case.get(Housing))
