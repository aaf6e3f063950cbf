"""The registry of commands and of the tables that a case file may have."""

from asperity.block.tables import TABLES as BLOCK
from asperity.casefile.project import Project
from asperity.commands import case_tables
from asperity.drive.tables import TABLES as DRIVE
from asperity.flanks.tables import TABLES as FLANKS
from asperity.rating.tables import TABLES as RATING
from asperity.shafts.tables import TABLES as SHAFTS
from asperity.slider.tables import TABLES as SLIDER
from asperity.tribometer.tables import TABLES as TRIBOMETER


def test_a_case_file_may_have_every_table_of_every_room():
    tables = case_tables()
    rooms = {**SLIDER, **RATING, **SHAFTS, **BLOCK, **FLANKS, **DRIVE, **TRIBOMETER}
    assert dict(tables) == {**rooms, "project": Project}
    assert len(tables) == len(list(tables))
    assert all(name in tables and table.table == name for name, table in tables.items())
    assert "oil" not in tables
