"""When a file's recording began, by what the file itself says."""

import datetime
import re
from collections.abc import Sequence

from asperity.errors import InputError, shown
from asperity.tribometer.importing.cells import is_clock

_MONTHS = {
    name: number
    for number, names in enumerate(
        (
            ("jan", "gen", "ene"), ("feb", "fév", "fev"), ("mar", "mär", "mrz"),
            ("apr", "avr", "abr"), ("may", "mai", "mag", "mei"), ("jun", "jui", "giu"),
            ("jul", "lug"), ("aug", "aoû", "ago"), ("sep", "set"), ("oct", "okt", "ott"),
            ("nov",), ("dec", "dez", "dic", "déc"),
        ), start=1,
    )
    for name in names
}  # fmt: skip
_YEAR_FIRST = re.compile(r"(?<!\d)(\d{4})[-./](\d{1,2})[-./](\d{1,2})(?!\d)")
_YEAR_LAST = re.compile(r"(?<![\d.])(\d{1,2})([-./])(\d{1,2})\2(\d{4}|\d{2})(?![\d.])")
_NAMED = re.compile(r"(?<!\d)(\d{1,2})[-. ]+([^\W\d]{3})[^\W\d]*[-., ]+(\d{4})(?!\d)")
_NAME_FIRST = re.compile(r"([^\W\d]{3})[^\W\d]* +(\d{1,2}),? +(\d{4})(?!\d)")
_CLOCK = re.compile(
    r"(?<![\d:])(\d{1,2}):(\d{2})(?::(\d{2})(?:[.,](\d{1,9})\d*)?)?(?: ?([AaPp])[Mm])?"
    r" ?(Z|[+-]\d{2}:?\d{2})?(?![\d:])"
)
# Days of something else than the recording.
_OTHERS = re.compile(
    r"calib|kalib|due|fällig|version|export|creat|generat|erstellt|copyright|saved|print|firmware",
    re.IGNORECASE,
)
_FIRST_YEAR, _LAST_YEAR = 1990, 2100
_SINCE_1970 = 8e8, 4e9  # s, of the years that recordings are of
_FROM_A_COUNT = "its times are seconds since 1970"

Moment = tuple[datetime.datetime, str]
"""When it began, and by what."""


def days_in(text: str) -> list[datetime.date]:
    """Return what day a text may name: none, one, or two where day and month may be exchanged.

    Examples
    --------
    >>> [str(day) for day in days_in("05/06/2026")], [str(day) for day in days_in("1.5.26")]
    (['2026-06-05', '2026-05-06'], ['2026-05-01'])
    """
    if found := _YEAR_FIRST.search(text):
        return _day(found[1], found[2], found[3])
    for shape, year, month, day in ((_NAMED, 3, 2, 1), (_NAME_FIRST, 3, 1, 2)):
        if (found := shape.search(text)) and found[month].lower() in _MONTHS:
            return _day(found[year], str(_MONTHS[found[month].lower()]), found[day])
    if not (found := _YEAR_LAST.search(text)):
        return []
    one, sign, other, year_told = found.groups()
    year_told = year_told if len(year_told) == 4 else f"20{year_told}"
    made = _day(year_told, other, one)
    if sign != "." and one != other:
        # Half days are no sign of a month that comes first: Australia and India write them as well.
        made = [*made, *_day(year_told, one, other)]
    return made


def _day(year: str, month: str, day: str) -> list[datetime.date]:
    try:
        made = datetime.date(int(year), int(month), int(day))
    except ValueError:
        return []
    return [made] if _FIRST_YEAR <= made.year <= _LAST_YEAR else []


def clock_in(text: str) -> tuple[datetime.time, bool] | None:
    """Return the time of day in a text, with its zone, and whether it tells one."""
    if not (found := _CLOCK.search(text)):
        return None
    hour, minute, second, part, half, zone = found.groups()
    hours = int(hour) % 12 + 12 * (half in "Pp") if half else int(hour)
    micro = int(f"{part or 0:<06}"[:6]) if part else 0
    told = None
    if zone:
        away = 0 if zone == "Z" else int(zone[1:3]) * 60 + int(zone[-2:])
        sign = -1 if zone[0] == "-" else 1
        told = datetime.timezone(sign * datetime.timedelta(minutes=away))
    try:
        return datetime.time(hours, int(minute), int(second or 0), micro, told), bool(zone)
    except ValueError:
        return None


def said_to_begin(text: str) -> datetime.datetime:
    """Read when somebody says that a recording began: a day, or a day with its time.

    Raises
    ------
    InputError
        It is none, or day and month may be exchanged.
    """
    days = days_in(text)
    if len(days) != 1:
        raise InputError(
            f"--start is {shown(text)}; it must be a day with or without its time, as in "
            '"2026-05-01 14:30" or 2026-05-01T14:30:00Z'
        )
    return _at(days[0], clock_in(text.replace("T", " ")))


def in_future(began: datetime.datetime, then: str) -> tuple[str, ...]:
    """Return a note that a recording would begin after today, and what to do then, or none."""
    # Clocks of two computers, and zones that a file does not tell.
    tomorrow = datetime.datetime.now(datetime.UTC) + datetime.timedelta(days=1)
    return (f"{began:%Y-%m-%d} is in the future; {then}",) if began > tomorrow else ()


def _at(
    day: datetime.date, clock: tuple[datetime.time, bool] | None
) -> datetime.datetime:  # fmt: skip
    told = datetime.datetime.combine(day, clock[0] if clock else datetime.time(12))
    # Without a zone it is that of this computer.
    return told.astimezone(datetime.UTC)


def begun_in(
    head: Sequence[str], row: Sequence[str], seconds: float
) -> tuple[Moment | None, tuple[str, ...]]:
    """Return when a table of text began, and notes on that.

    Parameters
    ----------
    head : sequence of str
        The rows above its numbers.
    row : sequence of str
        Cells of its first row of numbers.
    seconds : float
        Its first time, s.
    """
    clock = None
    for cell in filter(is_clock, row):
        cell_days, clock = days_in(cell), clock_in(cell)
        if cell_days:
            return _judged(cell_days, clock, cell, "its first row", 0.0)
    for number, line in enumerate(head):
        if _OTHERS.search(line) or not (days := days_in(line)):
            continue
        own = clock_in(line)
        if clock is None and own is None:
            # The time of day may stand in a row beside.
            near = (*head[number + 1 : number + 3], *head[max(0, number - 2) : number])
            own = next((one for text in near if (one := clock_in(text))), None)
        after = seconds if clock is None and own is not None else 0.0
        return _judged(days, clock or own, line.strip(), f"its row {number + 1}", after)
    return begun_by_count(seconds), ()


def begun_by_count(seconds: float) -> Moment | None:
    """Return when a first time that counts seconds since 1970 is; None where it does not."""
    if not _SINCE_1970[0] < seconds < _SINCE_1970[1]:
        return None
    return datetime.datetime.fromtimestamp(seconds, datetime.UTC), _FROM_A_COUNT


def begun_by_stamp(stamp: object, what: str) -> Moment | None:
    """Return when a stamp is that a library gives, a date and time; None where it is none."""
    text = str(stamp)
    days = days_in(text)
    if not days:
        return None
    clock = clock_in(text.replace("T", " "))
    # What is stored as a stamp is of no zone but the world's.
    if clock is not None and not clock[1]:
        clock = clock[0].replace(tzinfo=datetime.UTC), True
    return _at(days[0], clock), what


def _judged(
    days: Sequence[datetime.date],
    clock: tuple[datetime.time, bool] | None,
    text: str,
    where: str,
    seconds: float,
) -> tuple[Moment | None, tuple[str, ...]]:
    if len(days) > 1:
        names = " or ".join(map(str, days))
        note = f"{shown(text)} in {where} may be {names}; say when it began: --start"
        return None, (note,)
    began = _at(days[0], clock)
    if abs(seconds) < 86400.0:
        began += datetime.timedelta(seconds=seconds)
    zone = "" if clock and clock[1] else ", its time that of this computer's zone"
    return (began, f"{where}{zone if clock else ', without a time of day'}"), ()
