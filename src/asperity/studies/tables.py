"""Tables of a case file that studies of a worm gearset read."""

from asperity.casefile import Table
from asperity.studies.requirements import Requirements

TABLES: dict[str, type[Table]] = {Requirements.table: Requirements}
