"""Tables of a case file that describe elastic bodies in contact."""

from asperity.block.parameters import Block, Contact
from asperity.casefile import Table

TABLES: dict[str, type[Table]] = {table.table: table for table in (Block, Contact)}
