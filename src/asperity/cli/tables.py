"""Every table a case file may have, whichever command reads it."""

from asperity.block.tables import TABLES as CONTACT_TABLES
from asperity.casefile import Table
from asperity.flanks.tables import TABLES as FLANKS_TABLES
from asperity.rating.tables import TABLES as RATING_TABLES
from asperity.slider.tables import TABLES as SLIDER_TABLES

TABLES: dict[str, type[Table]] = {
    **SLIDER_TABLES,
    **RATING_TABLES,
    **CONTACT_TABLES,
    **FLANKS_TABLES,
}
