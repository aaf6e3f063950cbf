"""All entries as one library: ``python -m asperity.building.library FOLDER``.

It is for the machine that it is made on and others like it; it needs a C compiler, to link.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from asperity.native.entries import Entry, listed

NO_COMPILER = 3
"""Exit code where there is nothing to link with."""


def build(folder: Path, entries: Sequence[Entry], processes: int) -> list[str]:
    """Make a library of entries in a folder.

    Parameters
    ----------
    folder : path
        It is made where it is not there.
    entries : sequence of Entry
        What goes into it.
    processes : int
        So many compile at a time.

    Returns
    -------
    list of str
        What is left to Numba, and why.
    """
    from asperity.building import lean, link, making

    with tempfile.TemporaryDirectory() as name, ThreadPoolExecutor(processes) as pool:
        list(pool.map(lambda part: _made(Path(name), part), _parts(entries, processes)))
        made, left = [], []
        for entry in entries:
            told = json.loads((Path(name) / f"{entry.number}.json").read_text("utf-8"))
            if "unfit" in told:
                left.append(f"{entry.name}: {told['unfit']}")
                continue
            code = (Path(name) / f"{entry.number}.o").read_bytes()
            made.append((entry, lean.Made(code, told["returns"], told["words"])))
    making.began()
    folder.mkdir(parents=True, exist_ok=True)
    link.write(folder, made, link.support())
    return left


def _parts(entries: Sequence[Entry], processes: int) -> list[list[int]]:
    """Modules that call much the same stay together, of about equal length each."""
    parts: list[list[Entry]] = [[] for _ in range(processes)]
    rooms: dict[str, list[Entry]] = {}
    for entry in entries:
        rooms.setdefault(".".join(entry.module.split(".")[:3]), []).append(entry)
    for room in sorted(rooms.values(), key=_seconds, reverse=True):
        min(parts, key=_seconds).extend(room)
    return [[entry.number for entry in part] for part in parts if part]


def _seconds(entries: Sequence[Entry]) -> float:
    return sum(entry.seconds for entry in entries)


def _made(folder: Path, numbers: Sequence[int]) -> None:
    command = [
        sys.executable,
        "-P",
        "-m",
        "asperity.building.library",
        str(folder),
        "--only",
        *map(str, numbers),
    ]
    subprocess.run(command, check=True, env=os.environ | {"ASPERITY_NATIVE": "0"})


def _make(folder: Path, entries: Iterator[Entry]) -> None:
    """Write each entry's object file into a folder, and what is known of it."""
    from asperity.building import lean, link, making

    making.began()
    for entry in entries:
        try:
            made = lean.make(making.kernel(entry), entry.arguments, link.symbol(entry))
        except lean.UnfitError as error:
            told: dict[str, object] = {"unfit": str(error)}
        else:
            (folder / f"{entry.number}.o").write_bytes(made.code)
            told = {"returns": made.returns, "words": made.words}
        (folder / f"{entry.number}.json").write_text(json.dumps(told), "utf-8")


def main() -> None:
    """Build it, or with ``--only`` object files of some entries."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--only", type=int, nargs="+", metavar="NUMBER", help=argparse.SUPPRESS)
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    given = parser.parse_args()
    entries = listed().entries
    if given.only:
        _make(given.folder, (entries[number] for number in given.only))
        return

    from asperity.building import link

    if link.compiler() is None:
        print("no C compiler (cc, or what CC names): no library of kernels", file=sys.stderr)
        sys.exit(NO_COMPILER)
    for line in build(given.folder, entries, given.processes):
        print(f"left to Numba: {line}", file=sys.stderr)


if __name__ == "__main__":
    main()
