"""Tables of a case file that describe the drive of a worm gearset."""

from asperity.casefile import Table
from asperity.drive.control.parameters import Control
from asperity.drive.parameters import Actuator, Drive, Shaft

TABLES: dict[str, type[Table]] = {table.table: table for table in (Drive, Shaft, Actuator, Control)}
