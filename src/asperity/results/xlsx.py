"""Workbooks for spreadsheets: texts, numbers and live formulas, as Office Open XML."""

import io
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from xml.sax.saxutils import escape

from asperity.errors import plain
from asperity.files.store import write_atomically
from asperity.results.unit_systems import US, system


class Formula(NamedTuple):
    """A formula and what it comes to; spreadsheets calculate it anew when they open the file."""

    text: str
    value: float | str


class Sheet(NamedTuple):
    """A sheet: its rows, the first a heading, and how wide its columns are, in characters."""

    rows: Sequence[Sequence[Any]]
    widths: Sequence[float] = ()


_MAIN = 'xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006/relationships"
_SHEETML = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
# Files of the same content are the same bytes.
_WHEN = (1980, 1, 1, 0, 0, 0)
_STYLES = (
    '<fonts count="2"><font><sz val="11"/><name val="Calibri"/></font>'
    '<font><b/><sz val="11"/><name val="Calibri"/></font></fonts>'
    '<fills count="3"><fill><patternFill patternType="none"/></fill>'
    '<fill><patternFill patternType="gray125"/></fill>'
    '<fill><patternFill patternType="solid"><fgColor rgb="FFFFF2CC"/></patternFill></fill></fills>'
    '<borders count="1"><border><left/><right/><top/><bottom/><diagonal/></border></borders>'
    '<cellStyleXfs count="1"><xf numFmtId="0" fontId="0" fillId="0" borderId="0"/></cellStyleXfs>'
    '<cellXfs count="3"><xf numFmtId="0" fontId="0" fillId="0" borderId="0" xfId="0"/>'
    '<xf numFmtId="0" fontId="1" fillId="0" borderId="0" xfId="0" applyFont="1"/>'
    '<xf numFmtId="0" fontId="0" fillId="2" borderId="0" xfId="0" applyFill="1"/></cellXfs>'
    '<cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles>'
)
_PLAIN, _BOLD, _INPUT = range(3)


class Input(NamedTuple):
    """A number that is there to be changed; its cell is coloured."""

    value: float


def place(sheet: str, row: int, column: int) -> str:
    """Return what a formula calls a cell; rows and columns count from 0."""
    return f"'{sheet}'!${chr(ord('A') + column)}${row + 1}"


def in_shown_units(rows: Sequence[Sequence[Any]], width: int) -> list[tuple[Any, ...]]:
    """Return rows with value and unit as people are shown them behind their columns.

    Parameters
    ----------
    rows : sequence of sequence
        A heading and rows with the value in the second column and its unit in the third.
    width : int
        Columns that they have.
    """
    if system() == "si":
        return [tuple(row) for row in rows]
    made = []
    for number, row in enumerate(rows):
        shown, value = US.get(row[2]), getattr(row[1], "value", row[1])
        more: tuple[Any, ...] = ()
        if number == 0:
            more = "value, US", "unit, US"
        elif shown is not None and isinstance(value, int | float):
            text = f"B{number + 1}*{shown.factor!r}+{shown.offset!r}"
            more = Formula(text, value * shown.factor + shown.offset), shown.unit
        padding = ("",) * (width - len(row)) if more else ()
        made.append((*row, *padding, *more))
    return made


def write_workbook(sheets: Mapping[str, Sheet], path: Path) -> Path:
    """Write sheets by name, of at most 26 columns, whole or not at all."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in _parts(sheets):
            package.writestr(zipfile.ZipInfo(name, _WHEN), _HEAD + text, zipfile.ZIP_DEFLATED)
    return write_atomically(path, lambda target: target.write_bytes(file.getvalue()))


def _parts(sheets: Mapping[str, Sheet]) -> Iterator[tuple[str, str]]:
    count = range(1, len(sheets) + 1)
    overrides = [("/xl/workbook.xml", "sheet.main"), ("/xl/styles.xml", "styles")]
    overrides += [(f"/xl/worksheets/sheet{n}.xml", "worksheet") for n in count]
    types = "".join(
        f'<Override PartName="{part}" ContentType="{_SHEETML}.{kind}+xml"/>'
        for part, kind in overrides
    )
    yield (
        "[Content_Types].xml",
        '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
        '<Default Extension="rels" '
        'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
        f'<Default Extension="xml" ContentType="application/xml"/>{types}</Types>',
    )
    yield "_rels/.rels", _relations([("officeDocument", "xl/workbook.xml")])
    listed = "".join(
        f'<sheet name="{escape(name)}" sheetId="{n}" r:id="rId{n}"/>'
        for n, name in zip(count, sheets, strict=True)
    )
    yield (
        "xl/workbook.xml",
        f'<workbook {_MAIN} xmlns:r="{_OFFICE}"><sheets>{listed}</sheets>'
        '<calcPr calcId="0" fullCalcOnLoad="1"/></workbook>',
    )
    parts = [("worksheet", f"worksheets/sheet{n}.xml") for n in count]
    yield "xl/_rels/workbook.xml.rels", _relations([*parts, ("styles", "styles.xml")])
    yield "xl/styles.xml", f"<styleSheet {_MAIN}>{_STYLES}</styleSheet>"
    for n, sheet in zip(count, sheets.values(), strict=True):
        yield f"xl/worksheets/sheet{n}.xml", _sheet(sheet)


def _relations(parts: Sequence[tuple[str, str]]) -> str:
    listed = "".join(
        f'<Relationship Id="rId{n}" Type="{_OFFICE}/{kind}" Target="{target}"/>'
        for n, (kind, target) in enumerate(parts, start=1)
    )
    return f'<Relationships xmlns="{_PACKAGE}">{listed}</Relationships>'


def _sheet(sheet: Sheet) -> str:
    columns = "".join(
        f'<col min="{n}" max="{n}" width="{width}" customWidth="1"/>'
        for n, width in enumerate(sheet.widths, start=1)
    )
    rows = "".join(
        f'<row r="{n + 1}">{"".join(_cells(n, row))}</row>' for n, row in enumerate(sheet.rows)
    )
    frozen = '<pane ySplit="1" topLeftCell="A2" activePane="bottomLeft" state="frozen"/>'
    return (
        f'<worksheet {_MAIN}><sheetViews><sheetView workbookViewId="0">{frozen}</sheetView>'
        f"</sheetViews>{f'<cols>{columns}</cols>' if columns else ''}"
        f"<sheetData>{rows}</sheetData></worksheet>"
    )


def _number(value: float) -> str:
    """Return a number as Python writes it, also one of NumPy's."""
    return repr(int(value) if isinstance(value, int) else float(value))


def _cells(row: int, values: Sequence[Any]) -> Iterator[str]:
    style = _PLAIN if row else _BOLD
    for column, value in enumerate(values):
        begin = f'<c r="{chr(ord("A") + column)}{row + 1}" s="{style}"'
        if isinstance(value, Input):
            yield f'{begin[:-2]}{_INPUT}"><v>{_number(value.value)}</v></c>'
        elif isinstance(value, Formula):
            kind = ' t="str"' if isinstance(value.value, str) else ""
            shown = value.value if isinstance(value.value, str) else repr(float(value.value))
            yield f"{begin}{kind}><f>{escape(value.text)}</f><v>{escape(shown)}</v></c>"
        elif isinstance(value, int | float) and not isinstance(value, bool):
            yield f"{begin}><v>{_number(value)}</v></c>"
        elif value != "":
            # An inline text is never taken for a formula.
            text = escape(plain(str(value)))
            yield f'{begin} t="inlineStr"><is><t xml:space="preserve">{text}</t></is></c>'
