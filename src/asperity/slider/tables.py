"""Tables of a case file that describe a sliding body."""

from asperity.casefile import Table
from asperity.friction import Friction
from asperity.normal import Normal
from asperity.slider.parameters import Slider, Solve
from asperity.slider.wear import Wear
from asperity.vibration import Vibration

TABLES: dict[str, type[Table]] = {
    table.table: table for table in (Slider, Friction, Vibration, Normal, Wear, Solve)
}
