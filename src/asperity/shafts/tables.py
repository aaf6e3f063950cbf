"""Tables of a case file that describe shafts and their bearings."""

from asperity.casefile import Table
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import WheelShaft, WormShaft

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (WormShaft, WheelShaft, BearingOptions)
}
