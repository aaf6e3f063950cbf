"""Record what today's commands answer, for tests to hold tomorrow's against: this is what is kept.

``python tests/answers/record.py`` runs every command line of ``commands.toml`` that has no record;
``--again`` and words of a command line run those that hold all the words once more, and ``--all``
every one. An answer that changes on purpose is recorded again and the change told in the log.
"""

import argparse
import gzip
import json
import os
import tempfile
import time
from pathlib import Path

# As the tests' workers have it: an active set may follow the last digits of a sum. Before numpy,
# which reads it as it is loaded.
for _library in ("OMP", "OPENBLAS", "MKL"):
    os.environ.setdefault(f"{_library}_NUM_THREADS", "1")

from observe import HERE, command_lines, observe  # noqa: E402


def records(command):
    """What is recorded of a command: {command line: what `observe` saw}."""
    path = HERE / "recorded" / f"{command}.json.gz"
    return json.loads(gzip.decompress(path.read_bytes())) if path.exists() else {}


def _keep(command, answers):
    text = json.dumps(answers, indent=0, sort_keys=True, allow_nan=False)
    path = HERE / "recorded" / f"{command}.json.gz"
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(gzip.compress(text.encode(), mtime=0))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--again", nargs="+", metavar="WORD", help="of lines to run once more")
    parser.add_argument("--all", action="store_true", help="run every line once more")
    given = parser.parse_args()
    lines = [*command_lines("ordinary"), *command_lines("slow")]
    for command in dict.fromkeys(line.split()[0] for line in lines):
        known = records(command)
        answers = {}
        for line in (line for line in lines if line.split()[0] == command):
            asked = given.all or (given.again and all(word in line for word in given.again))
            if line in known and not asked:
                answers[line] = known[line]
                continue
            began = time.perf_counter()
            with tempfile.TemporaryDirectory() as folder:
                answers[line] = observe(line, Path(folder))
            took = time.perf_counter() - began
            print(f"{took:6.2f} s  exit {answers[line]['code']}  {line}", flush=True)
            _keep(command, answers)
        _keep(command, answers)


if __name__ == "__main__":
    main()
