"""Tables of a case file that describe a disc-on-disc rig."""

from asperity.casefile import Table
from asperity.tribometer.channels import Channels
from asperity.tribometer.deposit import Package
from asperity.tribometer.instruments.acquisition import Acquisition
from asperity.tribometer.instruments.parameters import Controller, Guard, Supplies
from asperity.tribometer.options import Plan, Reduction, Twin
from asperity.tribometer.parameters import (
    BronzeDisc,
    Conditions,
    Drives,
    Limits,
    Lubricant,
    Rig,
    Sonotrode,
    SteelDisc,
)

TABLES: dict[str, type[Table]] = {
    table.table: table
    for table in (
        Rig, SteelDisc, BronzeDisc, Drives, Sonotrode, Channels, Lubricant, Limits, Plan, Twin,
        Reduction, Acquisition, Controller, Supplies, Guard, Conditions, Package,
    )
}  # fmt: skip
