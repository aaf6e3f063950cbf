"""List the kernels that Python calls, with the types it calls them with, for what is made of them.

``python tests/harvest.py`` runs every command line whose answer is recorded and each of ``ROOMS``,
those that are in the list already left out; ``--again`` and words run those that hold all the words
once more, ``--all`` every one. What is found is written after each line. ``--seconds`` compiles
each entry of the list by itself and notes how long it takes, ``--missing`` those only of which that
is not known. Run it where a test says that a command calls what the list does not have.
"""

import argparse
import concurrent.futures
import json
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE / "answers"))

from observe import command_lines  # noqa: E402

from asperity.kernels.native import entries  # noqa: E402

# Command lines that call the kernels of a room, in the way of `answers/commands.toml`, beside
# those that are recorded.
ROOMS = (
    "drive drive-screw --static --set drive.teeth=1 --set drive.phases=1",
    "drive drive-screw --set drive.model=teeth --set drive.teeth=1 --set drive.window=1 "
    "--set drive.protocol=window --set vibration.frequency='20 kHz'",
    "drive drive-thesis",
    "slide table-4.4 LUGRE --set solve.method=periodic",
    "static table-4.3",
    "slide table-4.3 EARLY --out OUT",
    "sweep table-4.3 --over vibration.velocity_ratio=1,6 EARLY",
    # So many states that the kernel of each is waited for (`asperity.slider.at_hand`).
    "sweep table-4.3 --over vibration.velocity_ratio=0.1:100:0.1 --set solve.method=periodic",
    "slide normal-pin",
    "slide normal-pin --set vibration.waveform=triangle",
    "slide normal-pin --set vibration.waveform=triangle --set friction.model=coulomb",
    "slide normal-pin EARLY --set solve.method=march",
    "slide normal-pin --set solve.method=march",
    "slide normal-pin --set solve.method=march --set vibration.velocity_ratio=20 "
    "--set vibration.start='0.14 s' --set solve.duration='0.6 s'",
    "sweep normal-pin --over vibration.velocity_ratio=1,6 EARLY --set solve.method=march",
    "flank gearset-3b --density coarse",
    "rig run rig-final RIG --out OUT",
    "rig reduce RECORDING",
    "rig reduce RECORDING --set reduction.speed_settling='0.3 s'",
)

# What is called by these alone, a fifth of all there is to compile, slow tests alone call.
SLOW_ROOMS = ROOMS[1:3]

# What stands where nobody has measured how long an entry is compiled, s.
UNKNOWN = 1.0

_OBSERVE = (
    "import sys, tempfile; from pathlib import Path; from observe import observe\n"
    "if __name__ == '__main__':\n"
    "    with tempfile.TemporaryDirectory() as folder:\n"
    "        observe(sys.argv[1], Path(folder))\n"
)


def lines():
    """All command lines whose kernels are listed."""
    return list(dict.fromkeys([*ROOMS, *command_lines("ordinary"), *command_lines("slow")]))


def noted(line):
    """Run a command line and return what its processes note: names of kernels with types, in order.

    Types are None where no list holds them; a name is None with the compilers that a process has
    loaded at its end.
    """
    with tempfile.TemporaryDirectory() as folder:
        # The package may stand on the path alone.
        paths = [str(HERE / "harvesting"), str(HERE / "answers"), os.environ.get("PYTHONPATH", "")]
        environment = os.environ | {
            "HARVEST": folder,
            "PYTHONPATH": os.pathsep.join(filter(None, paths)),
            "OPENBLAS_NUM_THREADS": "1",
        }
        # On two cores, by which processes share out what there is to do.
        subprocess.run(
            [sys.executable, "-c", _OBSERVE, line], env=environment, check=True,
            preexec_fn=lambda: os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:2]),
        )  # fmt: skip
        # The command's own process first, which began before those that it began.
        files = sorted(Path(folder).glob("*.jsonl"), key=lambda file: int(file.stem))
        texts = [text for file in files for text in file.read_text("utf-8").splitlines()]
    return list(map(json.loads, dict.fromkeys(texts)))


def called(line):
    """Return what a command line calls: names of kernels with types, in order."""
    return [(name, types) for name, types in noted(line) if None not in (name, types)]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--again", nargs="+", metavar="WORD", help="of lines to run once more")
    parser.add_argument("--all", action="store_true", help="run every line once more")
    parser.add_argument("--seconds", action="store_true", help="note how long compiling takes")
    parser.add_argument("--missing", action="store_true", help="where it is not known only")
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    given = parser.parse_args()
    wanted = lines()
    held = List()
    to_do = [
        line
        for line in wanted
        if given.all
        or line not in held.lines
        or (given.again and all(word in line for word in given.again))
    ]
    with concurrent.futures.ThreadPoolExecutor(given.processes) as pool:
        runs = {pool.submit(called, line): line for line in to_do}
        for done in concurrent.futures.as_completed(runs):
            print(f"{len(done.result()):4d} {runs[done]}", flush=True)
            held.add(runs[done], done.result())
            held.write()
    held.keep(wanted)
    held.write()
    if given.seconds:
        held.time(given.processes, only_missing=given.missing)


class List:
    """The list as it grows: entries keep their numbers, by which other processes ask for them."""

    def __init__(self):
        old = entries.listed() if entries.LIST.exists() else entries.Listed((), {})
        self.lines = {line: list(numbers) for line, numbers in old.lines.items()}
        self._seconds = {_text(each.name, each.arguments): each.seconds for each in old.entries}

    def add(self, line, found):
        texts = [_text(name, types) for name, types in found]
        for text in texts:
            self._seconds.setdefault(text, UNKNOWN)
        places = {text: number for number, text in enumerate(self._seconds)}
        self.lines[line] = [places[text] for text in texts]

    def keep(self, wanted):
        """Leave out other lines than those, and what none of them calls."""
        texts = list(self._seconds)
        called = {line: [texts[n] for n in self.lines[line]] for line in wanted}
        still = {text for found in called.values() for text in found}
        self._seconds = {text: self._seconds[text] for text in texts if text in still}
        places = {text: number for number, text in enumerate(self._seconds)}
        self.lines = {line: [places[text] for text in found] for line, found in called.items()}

    def write(self):
        rows = [(*json.loads(text), seconds) for text, seconds in self._seconds.items()]
        entries.write(rows, self.lines)

    def time(self, processes, *, only_missing):
        """Note how long each entry is compiled by a process that has compiled nothing before."""
        texts = [
            text
            for text, seconds in self._seconds.items()
            if not only_missing or seconds == UNKNOWN
        ]
        spawn = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(
            processes, mp_context=spawn, max_tasks_per_child=1
        ) as pool:
            runs = {pool.submit(seconds_of, *json.loads(text)): text for text in texts}
            for done in concurrent.futures.as_completed(runs):
                text = runs[done]
                self._seconds[text] = done.result()
                print(f"{done.result():6.1f} s {json.loads(text)[0]}", flush=True)
                self.write()


def _text(name, types):
    return json.dumps([name, types])


def seconds_of(name, types):
    """Return how long an entry is compiled, s of the processor, Numba's own start left out."""
    os.environ["ASPERITY_NATIVE"] = "0"

    from asperity.kernels.building import lean, making

    making.began()
    entry = entries.Entry(0, name, types, 0.0)
    kernel = making.kernel(entry)
    start = time.process_time()
    try:
        lean.make(kernel, types, "entry")
    except lean.UnfitError as reason:
        print(f"{name}: {reason}", flush=True)
    return round(max(time.process_time() - start, 0.1), 1)


if __name__ == "__main__":
    main()
