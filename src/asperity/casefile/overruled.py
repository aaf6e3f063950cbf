"""Settings that gave way to later ones."""

from collections.abc import Iterator

from asperity.casefile.case import Case
from asperity.casefile.table import same_thing


def overruled(case: Case) -> Iterator[str]:
    """Yield a line for each setting that gave way to a later one, another form of the same thing.

    Parameters
    ----------
    case : Case
        As `asperity.casefile.read_case` returns it, with its settings applied.
    """
    for path, setting in case.settings.items():
        name, _, key = path.partition(".")
        entries = case.raw.get(name, {})
        if key in entries:
            continue
        for other in sorted(same_thing(case.known[name], key)):
            later = case.settings.get(f"{name}.{other}")
            if other in entries and later is not None:
                yield f"--set {setting} gives way to --set {later}: [{name}] takes one of them"
