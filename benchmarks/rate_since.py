"""How fast one gearset is rated, against the package as it was at another commit.

``.venv/bin/python benchmarks/rate_since.py COMMIT`` takes that commit's sources out of git into
a folder of their own, and rates the same shipped cases with both, in turn, each in a process that
has rated them before. What counts is the ratio of the least times of the processor; a case that has
none of the tables that came since may take a tenth longer.
"""

import argparse
import io
import json
import os
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parents[1]
CASES = ("gearset-2", "gearset-3", "gearset-3b")
ROUNDS, CALLS = 7, 30
MOST = 1.10

RATING = """
import json, sys, time
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
cases = [read_case(name, case_tables()) for name in sys.argv[1].split()]
def timed(what):
    least = []
    for case in cases:
        what(case)
        best = float("inf")
        for _ in range(int(sys.argv[2])):
            began = time.process_time()
            what(case)
            best = min(best, time.process_time() - began)
        least.append(best)
    return least
found = [rate_case(case) for case in cases]
of = dict(zip(map(id, cases), found))
print(json.dumps({"rate": timed(rate_case), "brief": timed(lambda case: of[id(case)].brief())}))
"""


def measured(sources):
    """Return the least times of a tree: by what is done, of each case, s."""
    environment = {**os.environ, "PYTHONPATH": str(sources), "OMP_NUM_THREADS": "1"}
    line = [sys.executable, "-c", RATING, " ".join(CASES), str(CALLS)]
    done = subprocess.run(line, env=environment, capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "commit", nargs="?", default="d9f2ffef~1", help="that is rated with in turn"
    )
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        line = ["git", "archive", given.commit, "src", "cases"]
        packed = subprocess.run(line, cwd=HERE, capture_output=True).stdout
        if not packed:
            print(f"git has no {given.commit} here: nothing to measure against")
            return 0
        with tarfile.open(fileobj=io.BytesIO(packed)) as archive:
            archive.extractall(folder, filter="data")
        then, now = [], []
        for _ in range(ROUNDS):
            then.append(measured(Path(folder) / "src"))
            now.append(measured(HERE / "src"))
    over = False
    for what in ("rate", "brief"):
        for place, case in enumerate(CASES):
            old, new = (min(one[what][place] for one in each) for each in (then, now))
            over = over or new > MOST * old
            times = f"{1e3 * old:7.3f} ms then, {1e3 * new:7.3f} now"
            print(f"{what:6} {case:11} {times}: {new / old:.3f}")
    return int(over)


if __name__ == "__main__":
    raise SystemExit(main())
