"""What every answer is: quantities with symbol, unit and meaning, said once where they are fields.

JSON, netCDF, tables, pages, pictures and the variables of a sweep follow from them.

:Entry: `Result`, `quantity`, `measured`, `part`, `labelled`; `read` opens a file.
:Data: none.
:Where: `payload` (JSON for the page), `interval`, `table`, `terminal`, `report`, `xlsx`, `panels`
    (what pictures show, as data), `figures` (their look), `svg`, `settled`.
:Tests: `unit/test_results*`, `unit/test_settled`, `unit/test_terminal`, `unit/test_workbook`.
"""

from asperity.results.quantity import Quantities, labelled, measured, part, quantity
from asperity.results.result import Result, Saved, read

__all__ = ["Quantities", "Result", "Saved", "labelled", "measured", "part", "quantity", "read"]
