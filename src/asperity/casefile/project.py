"""The table ``[project]``: for whom and by whom; it heads a report and calculates nothing."""

from typing import ClassVar, Literal

from asperity.casefile.table import Table


class Project(Table):
    """For whom a case is made and by whom, as the report of ``--out`` is headed.

    Parameters
    ----------
    name : str, optional
        What the work is called.
    customer : str, optional
        For whom it is done.
    author : str, optional
        Who does it.
    note : str, optional
        What else a reader of the report should know.
    units : {'si', 'us'}
        What screen, report, workbook and CSV are in; numbers of JSON and netCDF keep the units
        that their keys and attributes have, whatever it says.
    language : str
        What screen and report are in: ``en``, ``de``, or a file of sentences that ends in .toml.
    """

    table: ClassVar[str] = "project"
    counts: ClassVar[bool] = False

    name: str | None = None
    customer: str | None = None
    author: str | None = None
    note: str | None = None
    units: Literal["si", "us"] = "si"
    language: str = "en"
