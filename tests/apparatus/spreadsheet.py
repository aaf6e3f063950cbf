"""A spreadsheet of its own: it reads a workbook and calculates every formula."""

import math
import re
import zipfile
from xml.etree import ElementTree

from asperity.results.xlsx import Formula

MAIN = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}"
REFERENCE = re.compile(r"(?:'([^']+)'!)?\$?(?<![A-Z0-9'])([A-Z]{1,2})\$?(\d+)(?![\d(])")
FUNCTIONS = {
    "ABS": abs, "SQRT": math.sqrt, "EXP": math.exp, "LN": math.log, "LOG10": math.log10,
    "SIN": math.sin, "COS": math.cos, "TAN": math.tan, "ASIN": math.asin, "ACOS": math.acos,
    "ATAN": math.atan, "ATAN2": lambda x, y: math.atan2(y, x), "DEGREES": math.degrees,
    "RADIANS": math.radians, "MIN": min, "MAX": max, "NA": lambda: math.nan,
    "IF": lambda condition, yes, no: yes if condition else no,
}  # fmt: skip


class Workbook:
    """A spreadsheet of its own: it reads the file and calculates every formula."""

    def __init__(self, path):
        self.cells, self.shown = {}, {}
        with zipfile.ZipFile(path) as package:
            listed = ElementTree.fromstring(package.read("xl/workbook.xml"))
            self.names = [sheet.get("name") for sheet in listed.iter(f"{MAIN}sheet")]
            for number, name in enumerate(self.names, start=1):
                text = package.read(f"xl/worksheets/sheet{number}.xml")
                for cell in ElementTree.fromstring(text).iter(f"{MAIN}c"):
                    self._read(name, cell)

    def _read(self, sheet, cell):
        column, row = re.fullmatch(r"([A-Z])(\d+)", cell.get("r")).groups()
        key = sheet, column, int(row)
        formula, value = cell.find(f"{MAIN}f"), cell.find(f"{MAIN}v")
        inline = cell.find(f"{MAIN}is/{MAIN}t")
        if inline is not None:
            self.cells[key] = inline.text
            return
        shown = value.text if cell.get("t") == "str" else float(value.text)
        self.cells[key] = shown if formula is None else Formula(formula.text, shown)

    def rows(self, sheet):
        last = max(row for name, _, row in self.cells if name == sheet)
        for row in range(2, last + 1):
            yield row, [self.cells.get((sheet, column, row), "") for column in "ABCDE"]

    def value(self, key, known):
        if key not in known:
            cell = self.cells[key]
            known[key] = (
                self._calculated(cell.text, key[0], known) if isinstance(cell, Formula) else cell
            )
        return known[key]

    def _calculated(self, text, sheet, known):
        places = []

        def place(match):
            other, column, row = match.groups()
            places.append(self.value((other or sheet, column, int(row)), known))
            return f"_{len(places) - 1}_"

        python = re.sub(r"(?<![<>])=", "==", REFERENCE.sub(place, text)).replace("^", "**")
        names = {f"_{number}_": value for number, value in enumerate(places)}
        return eval(python, {"__builtins__": {}}, FUNCTIONS | names)

    def change(self, key, factor):
        """Multiply an input."""
        (row,) = (row for row, cells in self.rows("inputs") if cells[4] == key)
        self.cells["inputs", "B", row] *= factor
