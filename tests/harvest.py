"""List the kernels that Python calls, with the types it calls them with, for what is made of them.

``python tests/harvest.py`` runs every command line whose answer is recorded and each of ``ROOMS``,
those that are in the list already left out; ``--again`` and words run those that hold all the words
once more, ``--all`` every one. ``--seconds`` compiles all entries and notes how long each takes.
Run it where a test says that a command calls what the list does not have.
"""

import argparse
import concurrent.futures
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "answers"))

from observe import command_lines  # noqa: E402

from asperity.native import entries  # noqa: E402

# Command lines that call the kernels of a room, in the way of `answers/commands.toml`, beside
# those that are recorded.
ROOMS = (
    "drive drive-screw --static --set drive.teeth=1 --set drive.phases=1",
    "drive drive-screw --set drive.model=teeth --set drive.teeth=1 --set drive.window=1 "
    "--set drive.protocol=window --set vibration.frequency='20 kHz'",
    "slide table-4.4 LUGRE --set solve.method=periodic",
    "static table-4.3",
    "slide table-4.3 EARLY --out OUT",
    "sweep table-4.3 --over vibration.velocity_ratio=1,6 EARLY",
    "slide normal-pin",
    "slide normal-pin EARLY --set solve.method=march",
    "flank gearset-3b --density coarse",
    "rig run rig-final RIG --out OUT",
    "rig reduce RECORDING",
)

_OBSERVE = (
    "import sys, tempfile; from pathlib import Path; from observe import observe\n"
    "if __name__ == '__main__':\n"
    "    with tempfile.TemporaryDirectory() as folder:\n"
    "        observe(sys.argv[1], Path(folder))\n"
)


def lines():
    """All command lines whose kernels are listed."""
    return list(dict.fromkeys([*ROOMS, *command_lines("ordinary"), *command_lines("slow")]))


def called(line):
    """Return what a command line calls: names of kernels with types, in order."""
    with tempfile.TemporaryDirectory() as folder:
        # The package may stand on the path alone.
        paths = [str(HERE / "harvesting"), str(HERE / "answers"), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {
            "HARVEST": folder,
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "OPENBLAS_NUM_THREADS": "1",
        }
        subprocess.run([sys.executable, "-c", _OBSERVE, line], env=environment, check=True)
        # The command's own process first, which began before those that it began.
        files = sorted(Path(folder).glob("*.jsonl"), key=lambda file: int(file.stem))
        texts = [text for file in files for text in file.read_text("utf-8").splitlines()]
    found = map(json.loads, dict.fromkeys(texts))
    return [(name, types) for name, types in found if types is not None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--again", nargs="+", metavar="WORD", help="of lines to run once more")
    parser.add_argument("--all", action="store_true", help="run every line once more")
    parser.add_argument("--seconds", action="store_true", help="note how long compiling takes")
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    given = parser.parse_args()
    old = entries.listed() if entries.LIST.exists() and not given.all else entries.Listed((), {})
    wanted = lines()
    of_line = {
        line: [(old.entries[n].name, old.entries[n].arguments) for n in numbers]
        for line, numbers in old.lines.items()
        if line in wanted and not (given.again and all(word in line for word in given.again))
    }
    to_do = [line for line in wanted if line not in of_line]
    with concurrent.futures.ThreadPoolExecutor(given.processes) as pool:
        for line, found in zip(to_do, pool.map(called, to_do), strict=True):
            print(f"{len(found):4d} {line}", flush=True)
            of_line[line] = found
    seconds = {(entry.name, json.dumps(entry.arguments)): entry.seconds for entry in old.entries}
    numbers = {}
    told = {}
    for line in wanted:
        keys = [(name, json.dumps(types)) for name, types in of_line[line]]
        told[line] = [numbers.setdefault(key, len(numbers)) for key in keys]
    rows = [(name, json.loads(types), seconds.get((name, types), 1.0)) for name, types in numbers]
    if given.seconds:
        rows = list(timed(rows))
    entries.write(rows, told)


def timed(rows):
    """Yield rows with the time that compiling takes, in the order that shares least."""
    from asperity.building import lean, making

    making.began()
    for number, (name, types, _) in enumerate(rows):
        entry = entries.Entry(number, name, types, 0.0)
        start = time.process_time()
        try:
            lean.make(making.kernel(entry), types, "entry")
        except lean.UnfitError as reason:
            print(f"{name}: {reason}", flush=True)
        yield name, types, round(time.process_time() - start, 1)


if __name__ == "__main__":
    main()
