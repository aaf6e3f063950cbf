"""Case files: TOML tables with units as text, read and validated into frozen tables in SI."""

from asperity.casefile.case import Case, bare_unit, naming_source, read_case
from asperity.casefile.table import Table, names_file, same_thing

__all__ = ["Case", "Table", "bare_unit", "names_file", "naming_source", "read_case", "same_thing"]
