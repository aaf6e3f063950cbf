"""Case files: TOML tables with units as text, read and validated into frozen tables in SI.

:Entry: `read_case`, which gives a `Case`; `Case.require` hands out a table, `Table` is what one
    derives from.
:Data: the tables of each room, gathered by `asperity.commands.tables`.
:Where: `check` (all mistakes at once), `schema` and `forms` (what may be said), `columns` (CSV),
    `setting`, `overruled` (what is set), `written` (a
    case as text).
:Tests: `unit/test_casefile*`, `property/test_casefile_schema`.
"""

from asperity.casefile.case import Case, naming_source, read_case
from asperity.casefile.setting import bare_unit
from asperity.casefile.table import MOST_DIGITS, Table, names_file, same_thing

__all__ = [
    "MOST_DIGITS",
    "Case",
    "Table",
    "bare_unit",
    "names_file",
    "naming_source",
    "read_case",
    "same_thing",
]
