"""Files that settings name, known before anything is read."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from asperity.casefile.setting import apply
from asperity.casefile.table import Table, names_file


def named_files(settings: Iterable[str], known: Mapping[str, type[Table]]) -> Iterator[str]:
    """Yield the files that settings name.

    Parameters
    ----------
    settings : iterable of str
        As ``--set`` takes them.
    known : mapping of str to type of Table
        The tables that there are.

    Yields
    ------
    str
        A path, absolute.

    Raises
    ------
    InputError
        One that is no setting, or of no table.
    """
    raw = dict[str, dict[str, Any]]()
    for setting in settings:
        table, _, key = apply(raw, setting, known).partition(".")
        if names_file(known[table], key):
            yield str(raw[table].get(key, ""))
