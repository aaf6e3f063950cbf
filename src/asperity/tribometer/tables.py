"""Tables of a case file that describe a disc-on-disc rig."""

from collections.abc import Mapping

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


def tables_of(raw: Mapping[str, object]) -> Mapping[str, type[Table]]:
    """Return the tables of a configuration: with ``[gearset]`` those of a drive as well.

    Parameters
    ----------
    raw : mapping
        Tables as they are written, by name.

    Returns
    -------
    mapping of str to type
        What reads each.
    """
    if "gearset" not in raw:
        return TABLES
    from asperity.drive.tables import TABLES as OF_DRIVES
    from asperity.flanks.tables import TABLES as OF_FLANKS
    from asperity.friction import Friction
    from asperity.rating.tables import TABLES as OF_RATING
    from asperity.shafts.tables import TABLES as OF_SHAFTS
    from asperity.slider.parameters import Solve
    from asperity.vibration import Vibration

    beside = {table.table: table for table in (Friction, Vibration, Solve)}
    return {**OF_RATING, **OF_SHAFTS, **OF_FLANKS, **OF_DRIVES, **beside, **TABLES}
