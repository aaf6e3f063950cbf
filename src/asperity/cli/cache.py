"""What ``asperity cache`` does."""

import time
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from asperity.cli import show
from asperity.errors import plain
from asperity.files import caches
from asperity.files.caches import CacheUse
from asperity.files.folders import cache_root

_HEADS = ("kind", "files", "size", "oldest use", "what it is")


def cache(names: Sequence[str], *, clear: bool, as_json: bool) -> None:
    """Print what is kept of some kinds, or of all; remove it first, if that is asked for."""
    kinds = caches.require_kinds(names)
    removed = caches.clear(kinds) if clear else None
    found = caches.uses_of(kinds)
    _tell_what_stays(found, clear=clear)
    if as_json:
        show.print_json(_json(found, removed))
    elif removed is not None:
        show.print_text(f"removed {_files(removed[0])}, {_size(removed[1])}")
    else:
        root = cache_root()
        where = "no folder: name one in ASPERITY_CACHE" if root is None else plain(str(root))
        show.print_text(f"{where}\n\n{_table(found)}")


def _tell_what_stays(uses: Sequence[CacheUse], *, clear: bool) -> None:
    for each in uses:
        if each.is_link:
            show.note(f"{each.kind}: its folder is a link, which is not followed")
        if each.others and clear:
            things = "1 thing" if each.others == 1 else f"{each.others} things"
            show.note(f"{each.kind}: {things} of another name stayed")


def _json(uses: Sequence[CacheUse], removed: tuple[int, int] | None) -> dict[str, Any]:
    root = cache_root()
    kinds = [{**asdict(each), "oldest": _date(each, "%Y-%m-%dT%H:%M:%SZ")} for each in uses]
    gone = None if removed is None else dict(zip(("files", "bytes"), removed, strict=True))
    return {"folder": None if root is None else str(root), "kinds": kinds, "removed": gone}


def _table(uses: Sequence[CacheUse]) -> str:
    # Without the tables of answers, which take numpy.
    rows = [_HEADS]
    for each in uses:
        date = _date(each, "%Y-%m-%d") or "-"
        rows.append((each.kind, str(each.files), _size(each.bytes), date, each.what))
    if uses[1:]:
        files, size = sum(each.files for each in uses), sum(each.bytes for each in uses)
        rows.append(("all", str(files), _size(size), "", ""))
    k, n, s, d, _ = (max(map(len, column)) for column in zip(*rows, strict=True))
    return "\n".join(
        f"{kind:{k}}  {count:>{n}}  {amount:>{s}}  {date:{d}}  {what}".rstrip()
        for kind, count, amount, date, what in rows
    )


def _date(each: CacheUse, form: str) -> str | None:
    return None if each.oldest is None else time.strftime(form, time.gmtime(each.oldest))


def _files(count: int) -> str:
    return "1 file" if count == 1 else f"{count} files"


def _size(count: int) -> str:
    if count < 1000:
        return f"{count} B"
    return f"{count / 1e3:.1f} kB" if count < 1e6 else f"{count / 1e6:.1f} MB"
