"""Words that a program writes below the numbers: that this is the end, how many there were."""

from collections.abc import Sequence

from asperity.errors import shown
from asperity.tribometer.importing.cells import BLANK, INFINITY, cells_of, is_number

_MOST = 20  # rows
_TOLD = 3  # of them
_LOOKED_AT = 1 << 14  # characters, from the end
_NUMBERS = (*"0123456789", "inf", INFINITY, *(one.casefold() for one in BLANK if one.strip()))


def without_footer(text: str, separator: str, columns: Sequence[int]) -> tuple[str, list[str]]:
    r"""Return a text without the rows of words that end it, and a note of them if there are any.

    A row in the midst of the numbers is none, nor one that begins as a number does, which may be
    a sample that is damaged.

    Parameters
    ----------
    text : str
        The file.
    separator : str
        Between cells; empty: spaces.
    columns : sequence of int
        That hold numbers or times.

    Examples
    --------
    >>> kept, notes = without_footer("0,1\n1,2\n\nEnd of data\n", ",", [0, 1])
    >>> kept, notes
    ('0,1\n1,2\n', ["left out from row 4 on, which are words: 'End of data'"])
    """
    words: list[str] = []
    end, row = len(text), 0
    lowest = max(len(text) - _LOOKED_AT, 0)
    while end > lowest:
        begin = text.rfind("\n", 0, end - 1) + 1
        line = text[begin:end].strip()
        if line and (len(words) == _MOST or not _is_of_words(line, separator, columns)):
            break
        if line:
            words.insert(0, line)
            row = text.count("\n", 0, begin) + 1
        end = begin
    if not words:
        return text, []
    told = ", ".join(shown(one) for one in words[:_TOLD]) + ", ..." * (len(words) > _TOLD)
    return text[:end], [f"left out from row {row} on, which are words: {told}"]


def _is_of_words(line: str, separator: str, columns: Sequence[int]) -> bool:
    cells = cells_of(line, separator)
    counting = [cells[place] for place in columns if place < len(cells)] or cells[:1]
    first = counting[0]
    if not first or first.casefold().lstrip("+-.,").startswith(_NUMBERS):
        return False
    # A whole row of numbers but one may be a sample.
    numbers = any(is_number(one, separator) for one in counting)
    return len(counting) < len(columns) or not numbers
