"""Tables of a case file that describe shafts and their bearings."""

from asperity.casefile import Table
from asperity.shafts.parameters import BearingOptions, WheelShaft, WormShaft

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (WormShaft, WheelShaft, BearingOptions)
}
