"""Heads that programs and instruments write in their own way.

As their makers' documentation and files show them: Rigol DS1000E, DS1000Z and others, Tektronix
TDS1000 to 2000 and MSO/DPO, LeCroy (text), Keysight Infiniium (text), LabVIEW measurement files,
sigrok's CSV.
"""

import re
from collections.abc import Callable, Mapping, Sequence

from asperity.errors import InputError, choices, shown
from asperity.tribometer.importing.cells import cells_of, is_number, trimmed, unit_of
from asperity.tribometer.importing.heads import MOST_ABOVE, FirstRows, Layout
from asperity.units import to_si

_CHANNEL = re.compile(r"(?:^|[^a-z])(ch?)[ _-]?(\d)(?!\d)", re.IGNORECASE)
_TDS_DATA = 3  # columns of words beside the numbers
_LABVIEW, _END = "LabVIEW measurement", "***End_of_Header***"


def channel_of(stem: str) -> str:
    """Return what a file of one channel calls it, by the file's own name.

    Examples
    --------
    >>> channel_of("C2Trace00000"), channel_of("F0001CH1"), channel_of("torque")
    ('C2', 'CH1', 'torque')
    """
    found = _CHANNEL.search(stem) or re.search(r"(CH)(\d)(?!\d)", stem)
    return f"{found[1].upper()}{found[2]}" if found else stem


def own_layout(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """Return the layout of a text that a program lays out in its own way; None for any other.

    Raises
    ------
    InputError
        It is known, and holds what cannot be a recording.
    """
    if not lines:
        return None
    for read in (_tds, _rigol, _labview, _infiniium, _lecroy):
        if layout := read(lines, stem, name):
            return layout
    return None


def _words(lines: Sequence[str], separator: str) -> dict[str, list[str]]:
    """Return what rows of a key and its values say, by the key in small letters."""
    found: dict[str, list[str]] = {}
    for line in lines[:MOST_ABOVE]:
        key, *values = cells_of(line, separator)
        if key and not is_number(key, separator):
            found.setdefault(key.lower(), values)
    return found


def _number(words: Mapping[str, Sequence[str]], key: str, name: str) -> float:
    text = next(iter(words.get(key, [])), "").replace(",", ".")
    try:
        return float(text)
    except ValueError:
        raise InputError(f"{name}: {key!r} is {shown(text)}; it must be a number") from None


def _tds(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """Tektronix TDS1000 to 2000: the words stand beside the first numbers, a file a channel."""
    first = cells_of(lines[0], ",")
    if first[0].lower() != "record length" or len(trimmed(first)) < _TDS_DATA + 2:
        return None
    words = _words(lines, ",")
    source = next(iter(words.get("source", [])), "") or channel_of(stem)
    unit = unit_of(next(iter(words.get("vertical units", [])), "V") or "V")
    width = len(first)
    headings = ["", "", "", "Time", source, *[""] * (width - 5)]
    units = ["", "", "", unit_of(next(iter(words.get("horizontal units", [])), "s") or "s"), unit]
    return Layout(
        "Tektronix TDS", ",", tuple(headings), (*units, *[""] * (width - 5)), 0, width,
        skipped=frozenset({0, 1, 2, *range(5, width)}), time=3,
    )  # fmt: skip


def _rigol(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """Rigol DS1000Z, DS2000, DS4000: rows are counted, and the second tells start and increment."""
    if len(lines) < 3:
        return None
    headings, said = cells_of(lines[0], ","), cells_of(lines[1], ",")
    if headings[0].upper() != "X" or said[0].lower() != "sequence":
        return None
    known = {heading.lower(): cell for heading, cell in zip(headings, said, strict=False)}
    if "increment" not in known:
        raise InputError(f"{name}: its second row counts samples and tells no increment")
    start, step = (
        _number({key: [known.get(key, "0")]}, key, name) for key in ("start", "increment")
    )
    width = len(cells_of(lines[2], ","))
    channels = [
        place for place in range(1, min(width, len(headings)))
        if headings[place].lower() not in ("", "start", "increment")
    ]  # fmt: skip
    return Layout(
        "Rigol", ",", tuple((headings + [""] * width)[:width]),
        tuple(unit_of(said[n]) if n in channels else "" for n in range(width)), 2, width,
        skipped=frozenset(range(width)) - {*channels}, interval=step, start=start,
    )  # fmt: skip


def _labview(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """LabVIEW measurement file (.lvm): heads of words, ended by a row of asterisks."""
    if not lines[0].startswith("LabVIEW Measurement"):
        return None
    ends = [n for n, line in enumerate(lines) if line.startswith(_END)]
    if len(ends) < 2:
        raise InputError(f"{name} is a LabVIEW measurement without the head of its channels")
    separator = "," if _END + "," in lines[ends[0]] or lines[0].rstrip().endswith(",") else "\t"
    words = _words(lines[: ends[1]], separator)
    count = int(_number(words, "channels", name))
    heads = cells_of(lines[ends[1] + 1], separator)
    steps = {one for one in words.get("delta_x", [])[:count] if one}
    if len(steps) != 1:
        raise InputError(
            f"{name}: its channels have {len(steps)} different Delta_X; save those of one rate"
        )
    units = words.get("y_unit_label", [])
    columns = [
        place for place, head in enumerate(heads) if head and head not in ("X_Value", "Comment")
    ]
    named = dict(zip(columns, units, strict=False))
    return Layout(
        _LABVIEW, separator, tuple(heads),
        tuple(unit_of(named.get(n, "")) for n in range(len(heads))), ends[1] + 2, len(heads),
        skipped=frozenset(range(len(heads))) - {*columns},
        interval=_number(words, "delta_x", name), start=_number(words, "x0", name),
    )  # fmt: skip


def refuse_segments(text: str, layout: Layout, name: str) -> None:
    """Refuse a LabVIEW measurement of several segments: each has a head, a start and a rate."""
    if layout.program != _LABVIEW:
        return
    segments = text.count("\n" + _END) - 1
    if segments > 1:
        raise InputError(
            f"{name}: {segments} segments stand in it, each with a head of its own; save it again "
            "with 'One header only' under Segment Headers, or export a segment a file"
        )


def _infiniium(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """Keysight Infiniium (text): a word a row, then "Data:" and numbers."""
    at = next((n for n, line in enumerate(lines[:MOST_ABOVE]) if line.strip() == "Data:"), None)
    if at is None or at + 1 >= len(lines):
        return None
    parted = (line.partition(":") for line in lines[:at])
    words = {key.strip().lower(): [value.strip()] for key, _, value in parted}
    first = trimmed(cells_of(lines[at + 1], ","))
    unit = unit_of(words.get("y units", words.get("yunits", ["V"]))[0])
    heading = channel_of(stem)
    if len(first) > 1:
        time = unit_of(words.get("x units", words.get("xunits", ["s"]))[0])
        return Layout("Keysight Infiniium", ",", ("Time", heading), (time, unit), at + 1, 2, time=0)
    key = "xinc" if "xinc" in words else "x increment"
    return Layout(
        "Keysight Infiniium", ",", (heading,), (unit,), at + 1, 1,
        interval=_number(words, key, name),
    )  # fmt: skip


def _lecroy(lines: Sequence[str], stem: str, name: str) -> Layout | None:
    """Teledyne LeCroy (text): a line that names the instrument, segments, then Time and Ampl."""
    if not lines[0].upper().startswith("LECROY"):
        return None
    at = next((n for n, line in enumerate(lines[:MOST_ABOVE]) if line.startswith("Time")), None)
    if at is None or at + 1 >= len(lines):
        raise InputError(f"{name} is a LeCroy's text without the row 'Time,Ampl'")
    separator = max((",", ";", "\t", " "), key=lines[at].count)
    separator = "" if separator == " " else separator
    words = cells_of(lines[1], separator) if at > 1 else []
    if len(words) > 1 and is_number(words[1], separator) and float(words[1]) > 1:
        raise InputError(
            f"{name} holds {words[1]} segments, with gaps between them; save a single one, or "
            "record without sequence mode"
        )
    heads = cells_of(lines[at], separator)
    names = tuple("Time" if n == 0 else channel_of(stem) for n in range(len(heads)))
    return Layout(
        "LeCroy", separator, names, ("s", *["V"] * (len(heads) - 1)), at + 1, len(heads), time=0,
        notes=("the file tells no units; its channel is taken as volts",),
    )  # fmt: skip


_HEADS: Mapping[str, Callable[[Mapping[str, Sequence[str]]], bool]] = {
    "Tektronix": lambda words: "vertical units" in words and "horizontal units" in words,
    "sigrok": lambda words: any(key.startswith("; samplerate") for key in words),
}


def program_above(lines: Sequence[str], first_rows: FirstRows) -> tuple[str, list[str], float]:
    """Return the program whose words stand above a plain table, units and interval by them.

    Units are those of the columns in order, empty where no words are known; the interval is 0
    where none is told.
    """
    above = lines[: first_rows.begin]
    words = _words(above, first_rows.separator or " ")
    program = next((one for one, knows in _HEADS.items() if knows(words)), "")
    count = len(trimmed(first_rows.rows[0]))
    if program == "Tektronix":
        vertical = [unit_of(one) for one in trimmed(words["vertical units"])] or ["V"]
        units = (vertical * count)[: count - 1]
        return program, [unit_of(words["horizontal units"][0] or "s"), *units], 0.0
    if program == "sigrok":
        rate = next(line for line in above if line.lower().startswith("; samplerate"))
        text = rate.partition(":")[2].strip()
        return program, ["V"] * count, 1.0 / to_si(text, "Hz")
    return "", [], 0.0


NOT_READ: tuple[tuple[bytes, int, str, str], ...] = (
    (b"WAVEDESC", -1, "LeCroy's binary trace", "save it as ASCII (text)"),
    (b":WFM#", 2, "Tektronix's binary waveform", "save it as CSV"),
    (b":WFMP", 0, "Tektronix's ISF", "save it as CSV"),
    (b"AG01", 0, "Keysight's binary waveform", "save it as CSV"),
    (b"AG03", 0, "Keysight's binary waveform", "save it as CSV"),
    (b"AG10", 0, "Keysight's binary waveform", "save it as CSV"),
    (b"\xd0\xcf\x11\xe0", 0, "an old Excel workbook", "save the sheet as CSV"),
    (b"\x1f\x8b", 0, "a gzip archive", "unpack it first"),
)
"""Files by their first bytes (at a place, -1: anywhere) that are not read, and what to do."""

ENDINGS: Mapping[str, tuple[str, str]] = {
    ".isf": ("Tektronix's ISF", "save it as CSV"),
    ".psdata": ("PicoScope's own file", "export it as CSV or .mat"),
    ".xlsx": ("an Excel workbook", "save the sheet as CSV"),
    ".sal": ("Saleae's capture", "export the analog channels as CSV"),
    ".trc": ("a LeCroy's binary trace", "save it as ASCII (text)"),
    ".wfm": ("an oscilloscope's binary waveform", "save it as CSV"),
    ".bin": ("a binary file", "export it as CSV, .mat or TDMS"),
    ".tst": ("a catman or TestXpert file", "export it as text"),
    ".d7d": ("Dewesoft's own file", "export it as CSV, .mat or TDMS"),
    ".zip": ("an archive", "unpack it first"),
}
"""The same by what a name ends in."""


def refuse_known(head: bytes, ending: str, name: str) -> None:
    """Refuse a file of a kind that is known and not read, with what to export instead."""
    for magic, place, what, instead in NOT_READ:
        if magic in head if place < 0 else head[place : place + len(magic)] == magic:
            raise InputError(f"{name} is {what}, which is not read; {instead}")
    if ending in ENDINGS:
        what, instead = ENDINGS[ending]
        raise InputError(f"{name} is {what}, which is not read; {instead}")


def readable() -> str:
    """Return what is read, for messages."""
    return choices(("CSV", "text", ".lvm", ".mat", "TDMS", "WAV", ".sr", ".mf4", "netCDF"))
