"""Tables of a case file that describe how flanks are made and mounted."""

from asperity.casefile import Table
from asperity.flanks.parameters import Disc, Hob, MeasuringOptions, Modification, Mount
from asperity.gearset.blanks import Blanks

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (Hob, Disc, Modification, Mount, Blanks, MeasuringOptions)
}
"""Hob, grinding disc, modification and mount; what wheel and worm are beside their teeth, and how
they are measured.
"""
