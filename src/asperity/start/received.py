"""Files that somebody hands over: looked at before they are kept."""

from collections.abc import Callable
from pathlib import Path

from asperity.casefile import Case
from asperity.casefile.check import check_case
from asperity.commands import case_tables
from asperity.errors import InputError, StorageError
from asperity.files import store
from asperity.start.check import check

_CASE, _RECORDING, _BINARY = ".toml", ".nc", (".mat", ".tdms", ".wav", ".sr", ".mf4")
_MOST_READ = 16_000_000
"""Bytes of a table that is read whole; a longer one is told of when it is used."""


def refuse_unreadable(
    path: Path, name: str, *, recorded: bool, allowed: Callable[[Case], None] = lambda case: None
) -> None:
    """Refuse a file that nothing here reads, in one line that calls it by its name.

    Parameters
    ----------
    path : Path
        Where it lies meanwhile.
    name : str
        What it is to be called; its ending says what it must be.
    recorded : bool
        Whether it is to be a rig's recording or what an oscilloscope's program exported, and no
        other table.
    allowed : callable
        Takes a case before any file that it names is read; may refuse it.

    Raises
    ------
    InputError
        A case with mistakes, which are counted and of which the first one is told; a recording or
        an export that cannot be read; a text that is none.
    """
    ending = path.suffix.lower()
    try:
        if ending == _CASE:
            _refuse_case(path, name, allowed)
        elif ending == _RECORDING:
            _refuse_recording(path, name)
        elif path.stat().st_size > _MOST_READ:
            return
        elif recorded or ending in _BINARY:
            from asperity.tribometer.importing.files import read_export

            read_export(path, name)
        else:
            store.read_text(path, name)
    except (InputError, StorageError) as error:
        raise InputError(str(error).replace(str(path), name)) from None


def _refuse_recording(path: Path, name: str) -> None:
    from asperity.tribometer.recording import Recording

    try:
        Recording.open(path)
    except StorageError:
        raise InputError(f"{name} is no recording of a rig, or it is damaged") from None


def _refuse_case(path: Path, name: str, allowed: Callable[[Case], None]) -> None:
    allowed(check_case(path, case_tables())[0])
    found = check(str(path), ())
    if found.mistakes:
        first, *more = found.mistakes
        where = f"line {first.line}: " if first.line else ""
        also = f" (and {len(more)} more mistake{'s' if len(more) > 1 else ''})" if more else ""
        raise InputError(f"{name} is no case that can be used: {where}{first.text}{also}")
    if not (found.takers or found.besides):
        raise InputError(f"{name} is no case: no command takes what it holds")
