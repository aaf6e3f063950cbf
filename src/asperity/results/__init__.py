<<<<<<< HEAD
"""What every answer is: quantities, the power ledger, tables, pages, figures, files."""
=======
"""What every answer is: quantities with symbol, unit and meaning, said once where they are fields.

JSON, netCDF, tables, pages, pictures and the variables of a sweep follow from them.
"""

from asperity.results.quantity import Quantities, labelled, part, quantity
from asperity.results.result import Result, Saved, read

__all__ = ["Quantities", "Result", "Saved", "labelled", "part", "quantity", "read"]
>>>>>>> 46aa969 (Say a quantity once: answers with JSON, netCDF, tables, pages and pictures from their fields)
