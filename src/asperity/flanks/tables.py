"""Tables of a case file that describe how flanks are made and mounted."""

from asperity.casefile import Table
from asperity.flanks.parameters import Disc, Hob, Modification, Mount

TABLES: dict[str, type[Table]] = {table.table: table for table in (Hob, Disc, Modification, Mount)}
