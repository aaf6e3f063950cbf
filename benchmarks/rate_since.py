"""How fast one gearset is rated, against the package as it was at another commit.

``.venv/bin/python benchmarks/rate_since.py COMMIT`` takes that commit's sources out of git into
a folder of their own, and rates the same shipped cases with both, in turn, each in a process that
has rated them before. What counts is the ratio of the least times of the processor; a case that has
none of the tables that came since may take a tenth longer.
"""

import argparse

from _common import in_turn

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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "commit", nargs="?", default="d9f2ffef~1", help="that is rated with in turn"
    )
    commit = parser.parse_args().commit
    then, now = in_turn(commit, RATING, " ".join(CASES), str(CALLS), rounds=ROUNDS)
    if not then:
        return 0
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
