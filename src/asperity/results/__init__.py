"""What every answer is: quantities with symbol, unit and meaning, said once where they are fields.

JSON, netCDF, tables, pages, pictures and the variables of a sweep follow from them.
"""

from asperity.results.quantity import Quantities, labelled, part, quantity
from asperity.results.result import Result, Saved, read

__all__ = ["Quantities", "Result", "Saved", "labelled", "part", "quantity", "read"]
