"""Tables of a case file that describe a worm gearset and how it is rated."""

from asperity.casefile import Table
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.parameters import Operation, RatingOptions

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (Gearset, Tolerances, Operation, RatingOptions)
}
