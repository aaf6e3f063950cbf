"""Break one line of the package at a time and see whether the tests nearest to it notice.

``python tests/mutants/run.py`` tries the seeded list of 200, in a copy of the package, and goes on
where it was stopped: what is known stands in ``out/mutants/results.jsonl``. ``--list`` shows the
list, ``--only NAME`` tries those whose name or key holds NAME, ``--survivors`` those again that
nothing had noticed, ``--count N`` the first N; ``--share`` tries nothing and tells what is known.
"""

import argparse
import contextlib
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from mutants import near, sites

RESULTS = near.ROOT / "out" / "mutants" / "results.jsonl"
LONGEST = 120.0  # s of a processor for the tests of one mutant
_AT_ALL = 8.0  # times as long a wait, where others use the processors too
_FAILED = re.compile(r"^(?:FAILED|ERROR) (tests/.*?)(?: - .*)?$", re.MULTILINE)
_NOT_FOUND = re.compile(r"^ERROR: (?:file or directory )?not found: .*?(tests/.*)$", re.MULTILINE)
# Exit codes of pytest.
_NO_SUCH_TEST, _NONE_CHOSEN = 4, 5

_MEMORY = 8 * 2**30
_FIRST = 26  # tests that are tried first


class Copy:
    """A copy of the package in which a line at a time is broken, with a cache of its own."""

    def __init__(self, folder: Path, cache: Path | None = None) -> None:
        # As it is now, whatever is edited meanwhile.
        self.source = folder / "whole"
        self.package = folder / "src" / "asperity"
        shutil.copytree(sites.SOURCE / "asperity", self.source / "asperity")
        shutil.copytree(self.source / "asperity", self.package)
        (folder / "cases").symlink_to(near.ROOT / "cases")
        self._cache = cache or folder / "cache"
        self._environment = os.environ | {
            "PYTHONPATH": str(self.package.parent),
            "ASPERITY_CACHE": str(self._cache),
            "OPENBLAS_NUM_THREADS": "1",
        }
        # Python takes a file for unchanged by its size and the second it was written in: what it
        # has compiled is taken over, and nothing is added.
        self._environment["PYTHONDONTWRITEBYTECODE"] = "1"
        self._folder = folder
        self._new_cache()
        used = subprocess.run(
            [sys.executable, "-c", "import asperity; print(asperity.__file__)"],
            env=self._environment, cwd=near.ROOT, capture_output=True, text=True, check=True,
        ).stdout.strip()  # fmt: skip
        assert Path(used).parent == self.package, used
        self._server = subprocess.Popen(
            [sys.executable, near.HERE / "server.py"], stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, cwd=near.ROOT, env=self._environment, text=True,
        )  # fmt: skip

    def text(self, module: str) -> str:
        """Source of a module as it should be."""
        return (self.source / "asperity" / module).read_text("utf-8")

    @contextlib.contextmanager
    def broken(self, mutant):
        """Hold a line broken, with nothing in the cache that others have left."""
        self._new_cache()
        path, whole = self.package / mutant.module, self.source / "asperity" / mutant.module
        path.write_text(mutant.applied(self.text(mutant.module)), "utf-8")
        try:
            yield
        finally:
            shutil.copy2(whole, path)

    def fails(self, tests, longest=LONGEST):
        """Run tests until one fails; return its name, "" for none, None where time was up."""
        tests = list(tests)
        while tests:
            code, output = self._pytest(tests, longest)
            if code is None:
                return None
            if code == _NO_SUCH_TEST and (gone := set(_NOT_FOUND.findall(output))):
                names = [
                    {test, *(test.partition(sign)[0] for sign in ("[", "::"))} for test in tests
                ]
                left = [test for test, own in zip(tests, names, strict=True) if not gone & own]
                if len(left) < len(tests):
                    tests = left
                    continue
                raise RuntimeError(f"tests that nobody asked for are not found: {gone}")
            if code in (0, _NONE_CHOSEN):
                return ""
            failed = _FAILED.search(output)
            return failed.group(1) if failed else f"exit {code}: {output.strip()[-300:]}"
        return ""

    def _pytest(self, tests, longest):
        options = [
            "-q", "-x", "--no-header", "--tb=no", "-rfE", "-p", "no:cacheprovider",
            "-m", "slow or not slow", f"--basetemp={self._folder / 'pytest'}",
        ]  # fmt: skip
        output = self._folder / "output"
        asked = {
            "arguments": [*options, *tests], "output": str(output), "cpu": round(longest),
            "seconds": _AT_ALL * longest, "bytes": _MEMORY,
        }  # fmt: skip
        print(json.dumps(asked), file=self._server.stdin, flush=True)
        code = json.loads(self._server.stdout.readline())
        return code, output.read_text("utf-8", "replace")

    def close(self):
        """End the process that tests."""
        self._server.communicate()

    def _new_cache(self):
        """Forget all but kernels, which are kept under what they follow from."""
        from asperity.folders import cache_folder

        kernels = self._cache / "asperity" / "kernels"
        kernels.mkdir(parents=True, mode=0o700, exist_ok=True)
        for kept in kernels.parent.iterdir():
            if kept != kernels:
                shutil.rmtree(kept, ignore_errors=True)
        if (compiled := cache_folder("kernels")) is not None:
            for folder in compiled.iterdir():
                if folder.is_dir() and not (kernels / folder.name).exists():
                    (kernels / folder.name).symlink_to(folder)


def tried(copy: Copy, mutant, longest: float = LONGEST, without=frozenset()) -> dict:
    """Break a line and tell whether it was noticed, by other tests than those named."""
    tests = [test for test in near.nearest(mutant) if test not in without]
    began = time.perf_counter()
    with copy.broken(mutant):
        # Most are caught by the first: the files of the others are not read then.
        failed = copy.fails(tests[:_FIRST], longest)
        if failed == "":
            failed = copy.fails(tests[_FIRST:], longest)
    outcome = {None: "timeout", "": "survived"}.get(failed, "caught")
    return {
        "key": mutant.key, "name": mutant.name, "outcome": outcome, "by": failed or "",
        "of": len(tests), "seconds": round(time.perf_counter() - began, 1),
        "file": mutant.module, "line": mutant.line, "diff": mutant.diff(copy.text(mutant.module)),
    }  # fmt: skip


def results() -> dict:
    """What is known, by key: the last of each."""
    if not RESULTS.exists():
        return {}
    lines = map(json.loads, RESULTS.read_text("utf-8").splitlines())
    return {line["key"]: line for line in lines}


def equivalents() -> dict:
    """Mutants that change nothing observable, by key, with the reason."""
    return {entry["key"]: entry["why"] for entry in sites.known()["equivalent"]}


def share(mutants) -> str:
    """The share that was caught, of those that were tried and change something."""
    found, same = results(), equivalents()
    known = [found[mutant.key] for mutant in mutants if mutant.key in found]
    outcomes = [line["outcome"] for line in known if line["key"] not in same]
    caught, out_of_time = outcomes.count("caught"), outcomes.count("timeout")
    per_cent = f", {100.0 * caught / len(outcomes):.1f} %" if outcomes else ""
    return (
        f"{caught} of {len(outcomes)} caught{per_cent}; {outcomes.count('survived')} survived, "
        f"{out_of_time} ran out of time; {len(known) - len(outcomes)} more change nothing; "
        f"{len(known)} of {len(mutants)} tried"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, help="try so many at most")
    parser.add_argument("--only", action="append", help="those whose name or key holds this")
    parser.add_argument("--again", action="store_true", help="also those that are known")
    parser.add_argument("--survivors", action="store_true", help="those that survived, again")
    parser.add_argument("--list", action="store_true", help="show them and try none")
    parser.add_argument("--share", action="store_true", help="tell what is known and try none")
    parser.add_argument("--seconds", type=float, default=LONGEST, help="for one mutant")
    asked = parser.parse_args()
    every = sites.listed()
    chosen = every
    if asked.only:
        chosen = [m for m in every if any(o in m.name or o in m.key for o in asked.only)]
    found, same = results(), equivalents()
    if asked.list:
        for mutant in chosen:
            outcome = found.get(mutant.key, {}).get("outcome", "not tried")
            text = (sites.SOURCE / "asperity" / mutant.module).read_text("utf-8")
            print(f"{mutant.name} ({outcome}): {mutant.key}\n{mutant.diff(text)}\n")
    if asked.survivors:
        chosen = [
            m for m in chosen if found.get(m.key, {}).get("outcome") in ("survived", "timeout")
        ]
    elif not asked.again and not asked.only:
        chosen = [mutant for mutant in chosen if mutant.key not in found]
    chosen = [mutant for mutant in chosen if mutant.key not in same]
    if not asked.list and not asked.share:
        # Those of plain Python first: for a kernel all that calls it is compiled anew.
        _try(sorted(chosen, key=_is_compiled)[: asked.count], asked.seconds)
    print(share(every))


def _is_compiled(mutant):
    return "@kernel" in (sites.SOURCE / "asperity" / mutant.module).read_text("utf-8")


def _try(mutants, longest):
    RESULTS.parent.mkdir(parents=True, exist_ok=True)
    passed, failing = {line["by"] for line in results().values()}, set()
    with tempfile.TemporaryDirectory() as folder:
        copy = Copy(Path(folder), RESULTS.parent / "cache")
        for mutant in mutants:
            line = tried(copy, mutant, longest, failing)
            # A test that fails of itself has noticed nothing.
            while line["by"].startswith("tests/") and line["by"] not in passed:
                if copy.fails([line["by"]], 10 * longest) == "":
                    passed.add(line["by"])
                else:
                    print(f"fails where nothing is broken: {line['by']}")
                    failing.add(line["by"])
                    line = tried(copy, mutant, longest, failing)
            if line["by"].startswith("exit") and copy.fails(near.nearest(mutant)[:1]) != "":
                sys.exit(f"tests do not run where nothing is broken: {line['by']}")
            with RESULTS.open("a", encoding="utf-8") as file:
                file.write(json.dumps(line) + "\n")
            print(f"{line['outcome']:9}{line['seconds']:6.1f} s  {line['name']}  {line['by']}")
            if line["outcome"] != "caught":
                print(f"{mutant.key}\n{line['diff']}")
            sys.stdout.flush()


if __name__ == "__main__":
    main()
