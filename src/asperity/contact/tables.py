"""Tables of a case file that describe elastic bodies in contact."""

from asperity.casefile import Table
from asperity.contact.parameters import Block, Contact

TABLES: dict[str, type[Table]] = {table.table: table for table in (Block, Contact)}
