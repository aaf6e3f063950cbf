"""Settings that gave way to later ones, and what of a case file gave way to a setting."""

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from asperity.casefile.case import Case
from asperity.casefile.table import same_thing


def overruled(case: Case, options: Mapping[str, str] = MappingProxyType({})) -> Iterator[str]:
    """Yield a line for each setting or key of the file that gave way to another form of itself.

    Parameters
    ----------
    case : Case
        As `asperity.casefile.read_case` returns it, with its settings applied.
    options : mapping of str to str
        Options of a command that gave a ``table.key``, as they were written.
    """
    settings = {path: f"--set {setting}" for path, setting in case.settings.items()}
    for path, setting in settings.items():
        for table, later in _instead(case, path, settings):
            yield f"{setting} gives way to {later}: [{table}] takes one of them"
    asked = {**options, **case.axes, **settings}
    for path in sorted(case.written - set(settings)):
        for _, later in _instead(case, path, asked):
            yield f"{later} takes the place of {path}, which {case.source} gives"


def _instead(case: Case, path: str, asked: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Yield the table, and what was asked for in it that took the place of one of its keys."""
    table, _, key = path.partition(".")
    entries = case.raw.get(table, {})
    if key in entries:
        return
    for other in sorted(same_thing(case.known[table], key)):
        later = asked.get(f"{table}.{other}")
        if other in entries and later is not None:
            yield table, later
