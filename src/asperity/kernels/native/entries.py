"""The kernels that Python calls, with the types it calls them with, and which command calls which.

The list stands beside this file. ``python tests/harvest.py`` makes it anew from the command lines
whose answers are recorded.
"""

import dataclasses
import functools
import hashlib
import json
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from asperity.kernels.native.target import PLAIN, Target, here, targets

LIST = Path(__file__).parent / "entries.json"


@dataclasses.dataclass(frozen=True)
class Entry:
    """A kernel that Python calls with arguments of certain types.

    Attributes
    ----------
    number : int
        Its place in the list.
    name : str
        Full name of the kernel.
    arguments : list
        What it is called with, as the table of a library says it.
    seconds : float
        About how long it is compiled, s, beside others of its kind.
    target : Target
        The processors that its machine code is for.
    """

    number: int
    name: str
    arguments: list[Any] = dataclasses.field(hash=False)
    seconds: float
    target: Target = PLAIN

    @property
    def module(self) -> str:
        """Full name of the module that the kernel stands in."""
        return _module(self.name)


@dataclasses.dataclass(frozen=True)
class Listed:
    """What the list holds.

    Attributes
    ----------
    entries : tuple of Entry
        All of them.
    lines : dict
        Command line -> numbers of its entries, in the order of their first calls.
    """

    entries: tuple[Entry, ...]
    lines: Mapping[str, tuple[int, ...]]

    def named(self, name: str) -> list[Entry]:
        """Return the entries of a kernel."""
        return [entry for entry in self.entries if entry.name == name]


@functools.cache
def listed() -> Listed:
    """Return the list as it stands, each entry for this processor."""
    held = json.loads(LIST.read_text("utf-8"))
    types, rows = held["types"], held["entries"]
    entries = (
        Entry(number, name, [types[each] for each in arguments], seconds, here(_module(name)))
        for number, (name, arguments, seconds) in enumerate(rows.values())
    )
    numbers = {mark: number for number, mark in enumerate(rows)}
    lines = {
        line: tuple(numbers[mark] for mark in called) for line, called in held["lines"].items()
    }
    return Listed(tuple(entries), lines)


def for_all_processors() -> tuple[Entry, ...]:
    """Return the entries of a library that goes elsewhere: of alike ones the fastest first."""
    each = [(entry, one) for entry in listed().entries for one in targets(entry.module)]
    return tuple(
        dataclasses.replace(entry, number=number, target=one)
        for number, (entry, one) in enumerate(each)
    )


def _module(name: str) -> str:
    return name.rpartition(".")[0]


def write(
    entries: Iterable[tuple[str, list[Any], float]], lines: Mapping[str, Sequence[int]]
) -> None:
    """Write the list: names with types of arguments and seconds; numbers of entries by line."""
    # By marks that follow from what they stand for, so that two lists can be merged as texts.
    types: dict[str, str] = {}
    rows: dict[str, str] = {}
    for name, arguments, seconds in entries:
        texts = [json.dumps(each) for each in arguments]
        marks = [_mark(text) for text in texts]
        types |= dict(zip(marks, texts, strict=True))
        rows[_mark(json.dumps([name, marks]))] = json.dumps([name, marks, seconds])
    numbered = list(rows)
    called = {line: [numbered[number] for number in numbers] for line, numbers in lines.items()}
    parts = (
        '"types": {\n' + ",\n".join(f'"{mark}": {text}' for mark, text in types.items()) + "\n}",
        '"entries": {\n' + ",\n".join(f'"{mark}": {row}' for mark, row in rows.items()) + "\n}",
        '"lines": {\n'
        + ",\n".join(f"{json.dumps(line)}: {json.dumps(marks)}" for line, marks in called.items())
        + "\n}",
    )
    new = LIST.with_suffix(".new")
    new.write_text("{\n" + ",\n".join(parts) + "\n}\n", "utf-8")
    # Whoever reads it meanwhile reads all of it.
    new.replace(LIST)


def _mark(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:8]


def shared_out(entries: Iterable[Entry], processes: int, depth: int = 2) -> list[list[Entry]]:
    """Return which entries each process is to make: about equal shares, of whole rooms.

    What several entries of a room call is compiled once where one process makes them all.

    Parameters
    ----------
    entries : iterable of Entry
        Those of a room stay in their order.
    processes : int
        How many shares; those beyond the number of rooms are empty.
    depth : int
        So many names of a module make a room, the package's own among them.
    """
    shares: list[list[Entry]] = [[] for _ in range(processes)]
    rooms: dict[str, list[Entry]] = {}
    for entry in entries:
        rooms.setdefault(".".join(entry.module.split(".")[:depth]), []).append(entry)
    for room in sorted(rooms.values(), key=_seconds, reverse=True):
        min(shares, key=_seconds).extend(room)
    return shares


def _seconds(entries: Iterable[Entry]) -> float:
    return sum(entry.seconds for entry in entries)


def likely(asked: Iterable[int], words: Sequence[str] = ()) -> list[Entry]:
    """Return what a process that has asked for some entries most likely asks for next, in order.

    It is what half of the commands call that call all that were asked for. Where some of them are
    of the same command and case, or else of the same command, those alone count.

    Parameters
    ----------
    asked : iterable of int
        Numbers of entries; they are not among what is returned.
    words : sequence of str
        The process's command line, where it has one.
    """
    held, known = listed(), set(asked)
    alike = {line: called for line, called in held.lines.items() if known.issubset(called)}
    for count in (2, 1):
        first = list(words[:count])
        nearer = [called for line, called in alike.items() if first == line.split()[:count]]
        if first and nearer:
            break
    else:
        nearer = list(alike.values())
    counts = Counter(number for called in nearer for number in called)
    # By the longest one, which is of most kinds of steps.
    order = [number for called in sorted(nearer, key=len, reverse=True) for number in called]
    return [
        held.entries[number]
        for number in dict.fromkeys(order)
        if number not in known and 2 * counts[number] >= len(nearer)
    ]
