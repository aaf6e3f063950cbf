"""What reducing a recording costs, against the package as it was at another commit.

``.venv/bin/python benchmarks/reduce_since.py COMMIT`` takes that commit's sources out of git into
a folder of their own, and imports and reduces a recording of 8 channels of 3.6 million samples with
both, in turn, each in a process of its own. What counts is the ratio of the least times that the
processor was busy with reducing: what is checked of a recording since (zeros, signs, ratios, noise,
copies) may not make it dearer.
"""

import argparse
import sys
import tempfile
from pathlib import Path

from _common import in_turn
from tribometer import mat_file

ROUNDS, CALLS = 3, 3
MOST = 1.0

REDUCTION = """
import json, sys, time
from pathlib import Path
from asperity.casefile import read_case
from asperity.runs import Run
from asperity.tribometer.importing.study import answer, prepare
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.study import Reducible, reduce_recording
from asperity.tribometer.tables import TABLES
case, recording = read_case("rig-final", TABLES), Path(sys.argv[1]).with_suffix(".nc")
answer(prepare(case, file=sys.argv[1]), Run()).save(recording)
one = Reducible(Recording.open(recording), case)
assert len(reduce_recording(one)[1]) == 6
best = float("inf")
for _ in range(int(sys.argv[2])):
    began = time.process_time()
    reduce_recording(one)
    best = min(best, time.process_time() - began)
print(json.dumps(best))
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "commit", nargs="?", default="fe3c291e~1", help="that is reduced with in turn"
    )
    commit = parser.parse_args().commit
    with tempfile.TemporaryDirectory() as name:
        recorded = str(mat_file(Path(name)))
        then, now = in_turn(commit, REDUCTION, recorded, str(CALLS), rounds=ROUNDS)
    if not then:
        return 0
    old, new = min(then), min(now)
    print(f"reduce, 3.6 million x 8: {old:.3f} s then, {new:.3f} now: {new / old:.3f}")
    return int(new > MOST * old)


if __name__ == "__main__":
    sys.exit(main())
