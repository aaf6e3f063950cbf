"""Break one line of the package at a time and see whether the tests nearest to it notice.

``python tests/mutants/run.py`` tries the seeded list of 200, in a copy of the package, and goes on
where it was stopped: what is known stands in ``out/mutants/results.jsonl``. ``--list`` shows the
list, ``--only NAME`` tries those whose name or key holds NAME, ``--survivors`` those again that
nothing had noticed, ``--count N`` the first N; ``--share`` tries nothing and tells what is known.
``--jobs N`` tries N at a time, ``--compiled`` those of compiled modules first, ``--minutes M``
begins none after that time, ``--told`` takes the list of what is told, marked and ranked, and
``--results FILE`` keeps what is known elsewhere: lines of JSON, of which the last on a mutant
holds as long as its line is what it was.

Of a line that kernels follow from the tests are run with kernels as plain Python first
(``plain.py``), and with what Numba compiles only if nothing has noticed it.
"""

import argparse
import contextlib
import json
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from concurrent.futures import ThreadPoolExecutor
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
_SPARE, _PLAIN = 2.0, 40.0  # s of a test and of all, with kernels as plain Python


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
            "PYTHONPATH": os.pathsep.join(
                [str(self.package.parent), *filter(None, [os.environ.get("PYTHONPATH")])]
            ),
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
        self._servers = {}

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

    def fails(self, tests, longest=LONGEST, spare=None):
        """Run tests until one fails; return its name, "" for none, None where time was up.

        The name is that of a file where it cannot be read at all. With ``spare`` kernels are plain
        Python, and tests that take longer are skipped; 0 skips none.
        """
        tests = list(tests)
        while tests:
            code, output = self._pytest(tests, longest, spare)
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

    def _pytest(self, tests, longest, spare):
        options = [
            "-q", "-x", "--no-header", "--tb=no", "-rfE", "-p", "no:cacheprovider",
            "-m", "slow or not slow", f"--basetemp={self._folder / 'pytest'}",
        ]  # fmt: skip
        if spare is not None:
            options += ["-p", "mutants.plain", "--spare", str(spare), "-W", "ignore"]
        output = self._folder / "output"
        asked = {
            "arguments": [*options, *tests], "output": str(output), "cpu": round(longest),
            "seconds": _AT_ALL * longest, "bytes": _MEMORY,
        }  # fmt: skip
        server = self._server(plain=spare is not None)
        print(json.dumps(asked), file=server.stdin, flush=True)
        code = json.loads(server.stdout.readline())
        return code, output.read_text("utf-8", "replace")

    def _server(self, plain):
        if plain not in self._servers:
            extra = {"NUMBA_DISABLE_JIT": "1", "ASPERITY_NATIVE": "0"} if plain else {}
            tests = os.pathsep.join((self._environment["PYTHONPATH"], str(near.TESTS)))
            self._servers[plain] = subprocess.Popen(
                [sys.executable, near.HERE / "server.py"], stdin=subprocess.PIPE,
                stdout=subprocess.PIPE, cwd=near.ROOT, text=True,
                env=self._environment | extra | ({"PYTHONPATH": tests} if plain else {}),
            )  # fmt: skip
        return self._servers[plain]

    def close(self):
        """End the processes that test."""
        for server in self._servers.values():
            server.communicate()

    def _new_cache(self):
        """Forget all but kernels, which are kept under what they follow from."""
        from asperity.files.folders import cache_folder

        kernels = self._cache / "asperity" / "kernels"
        kernels.mkdir(parents=True, mode=0o700, exist_ok=True)
        for kept in kernels.parent.iterdir():
            if kept != kernels:
                shutil.rmtree(kept, ignore_errors=True)
        if (compiled := cache_folder("kernels")) is not None:
            for folder in compiled.iterdir():
                if folder.is_dir() and not (kernels / folder.name).exists():
                    _linked(folder, kernels / folder.name)


def _linked(folder, copy):
    """Take over what was compiled; what is added stays here: Numba writes files anew."""
    try:
        shutil.copytree(folder, copy, copy_function=os.link)
    except (shutil.Error, OSError):
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(folder, copy)


def tried(
    copy: Copy, mutant, longest: float = LONGEST, without=frozenset(), spare: float | None = None
) -> dict:
    """Break a line and tell whether it was noticed, by other tests than those named.

    With ``spare`` by tests that take no longer while kernels are plain Python.
    """
    tests = _others(mutant, without)
    began = time.perf_counter()
    with copy.broken(mutant):
        # Most are caught by the first: the files of the others are not read then.
        failed = copy.fails(tests[:_FIRST], longest, spare)
        if failed == "":
            failed = copy.fails(tests[_FIRST:], longest, spare)
    outcome = {None: "timeout", "": "survived"}.get(failed, "caught")
    return {
        "key": mutant.key, "name": mutant.name, "outcome": outcome, "by": failed or "",
        "of": len(tests), "seconds": round(time.perf_counter() - began, 1),
        "file": mutant.module, "line": mutant.line, "diff": mutant.diff(copy.text(mutant.module)),
    }  # fmt: skip


def _others(mutant, without):
    """Tests nearest to a mutant, but for those named by themselves or by their file."""
    nearest = near.nearest(mutant)
    return [test for test in nearest if without.isdisjoint({test, test.partition("::")[0]})]


def results(file: Path = RESULTS) -> dict:
    """What is known, by key: the last of each."""
    if not file.exists():
        return {}
    lines = map(json.loads, file.read_text("utf-8").splitlines())
    return {line["key"]: line for line in lines}


def standing(mutants, file: Path = RESULTS) -> dict:
    """What is known of mutants whose line is still what it was, by key."""
    found = results(file)
    texts = {name: _source(name) for name in {mutant.module for mutant in mutants}}

    def is_standing(mutant):
        line = found.get(mutant.key)
        return line and _lines(line["diff"]) == _lines(mutant.diff(texts[mutant.module]))

    return {mutant.key: found[mutant.key] for mutant in mutants if is_standing(mutant)}


def _lines(diff):
    """Lines of a difference, wherever they stand."""
    return [line for line in diff.splitlines() if not line.startswith("@@")]


def _source(module):
    return (sites.SOURCE / "asperity" / module).read_text("utf-8")


def equivalents() -> dict:
    """Mutants that change nothing observable, by key, with the reason."""
    return {entry["key"]: entry["why"] for entry in sites.known()["equivalent"]}


def share(mutants, file: Path = RESULTS) -> str:
    """The share that was caught, of those that were tried and change something."""
    same = equivalents()
    change = [mutant for mutant in mutants if mutant.key not in same]
    outcomes = [line["outcome"] for line in standing(change, file).values()]
    unchanging = len(mutants) - len(change)
    caught, out_of_time = outcomes.count("caught"), outcomes.count("timeout")
    per_cent = f", {100.0 * caught / len(outcomes):.1f} %" if outcomes else ""
    return (
        f"{caught} of {len(outcomes)} caught{per_cent}; {outcomes.count('survived')} survived, "
        f"{out_of_time} ran out of time; {unchanging} more change nothing; "
        f"{len(outcomes) + unchanging} of {len(mutants)} are known"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, help="try so many at most")
    parser.add_argument("--told", action="store_true", help="the list of what is told")
    parser.add_argument("--only", action="append", help="those whose name or key holds this")
    parser.add_argument("--again", action="store_true", help="also those that are known")
    parser.add_argument("--survivors", action="store_true", help="those that survived, again")
    parser.add_argument("--list", action="store_true", help="show them and try none")
    parser.add_argument("--share", action="store_true", help="tell what is known and try none")
    parser.add_argument("--seconds", type=float, default=LONGEST, help="for one mutant")
    parser.add_argument("--minutes", type=float, default=math.inf, help="begin none after these")
    parser.add_argument("--jobs", type=int, default=1, help="so many at a time")
    parser.add_argument("--compiled", action="store_true", help="compiled modules first, not last")
    parser.add_argument("--results", type=Path, default=RESULTS, help="file of what is known")
    asked = parser.parse_args()
    ends = time.monotonic() + 60.0 * asked.minutes
    every = sites.listed_told() if asked.told else sites.listed()
    chosen = every
    if asked.only:
        chosen = [m for m in every if any(o in m.name or o in m.key for o in asked.only)]
    found, same = standing(every, asked.results), equivalents()
    if asked.list:
        for mutant in chosen:
            outcome = found.get(mutant.key, {}).get("outcome", "not tried")
            text = _source(mutant.module)
            print(f"{mutant.name} ({outcome}): {mutant.key}\n{mutant.diff(text)}\n")
    if asked.survivors:
        chosen = [
            m for m in chosen if found.get(m.key, {}).get("outcome") in ("survived", "timeout")
        ]
    elif not asked.again and not asked.only:
        chosen = [mutant for mutant in chosen if mutant.key not in found]
    chosen = [mutant for mutant in chosen if mutant.key not in same]
    if not asked.list and not asked.share:
        # The quickest first: for a kernel all that calls it is compiled anew.
        anew = _compiled_anew({mutant.module for mutant in chosen})
        chosen.sort(key=lambda m: (asked.compiled and not anew[m.module], anew[m.module]))
        Trial(asked.results, asked.seconds, ends).of(chosen[: asked.count], asked.jobs)
    print(share(every, asked.results))


def _compiled_anew(modules):
    """Bytes of the modules with kernels that follow from each of these modules, or 0."""
    from asperity.kernels.closure import closure

    package = sites.SOURCE / "asperity"
    sizes = dict.fromkeys(modules, 0)
    for path in sorted(package.rglob("*.py")):
        if "@kernel" in path.read_text("utf-8"):
            name = ".".join(path.relative_to(sites.SOURCE).with_suffix("").parts)
            for part in closure(name, file=path):
                module = part.relative_to(package).as_posix()
                if module in sizes:
                    sizes[module] += path.stat().st_size
    return sizes


class Trial:
    """Mutants that are tried one after another, or several at a time, each in a copy of its own."""

    def __init__(self, file: Path, longest: float, ends: float) -> None:
        self._file, self._longest, self._ends = file, longest, ends
        file.parent.mkdir(parents=True, exist_ok=True)
        self._lock = threading.Lock()
        # Of kernels that are compiled and, True, of those that are plain Python.
        self._passed = {False: set(), True: set()}
        self._failing = {False: set(), True: set()}
        for line in results(file).values():
            self._passed[line.get("plain", False)].add(line["by"])

    def of(self, mutants, jobs: int) -> None:
        """Try mutants, so many at a time."""
        if jobs > 1:
            import warm

            # Once, not by each.
            warm.compile_kernels()
        left = iter(mutants)
        caches = RESULTS.parent / "cache"
        with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(jobs) as pool:
            doing = []
            for n in range(jobs):
                (own := Path(folder) / str(n)).mkdir()
                doing.append(pool.submit(self._job, left, own, caches / str(n)))
            for job in doing:
                job.result()

    def _job(self, left, folder, cache):
        copy = Copy(folder, cache)
        try:
            while (mutant := self._next(left)) is not None:
                line = self._tried(copy, mutant)
                with self._lock:
                    self._keep(mutant, line)
        except BaseException:
            self._ends = -math.inf  # the others begin no more
            raise
        finally:
            copy.close()

    def _next(self, left):
        with self._lock:
            return next(left, None) if time.monotonic() < self._ends else None

    def _tried(self, copy, mutant):
        if _compiled_anew({mutant.module})[mutant.module]:
            line = self._tried_as(copy, mutant, True)
            if line["outcome"] == "caught":
                return line
        return self._tried_as(copy, mutant, False)

    def _tried_as(self, copy, mutant, plain):
        passed, failing = self._passed[plain], self._failing[plain]
        longest, spare, any_time = (_PLAIN, _SPARE, 0.0) if plain else (self._longest, None, None)
        line = tried(copy, mutant, longest, failing.copy(), spare)
        # A test that fails of itself has noticed nothing.
        while line["by"].startswith("tests/") and line["by"] not in passed:
            failed = line["by"]
            # Of a file that could not be read any test tells whether it can be.
            of_it = [t for t in near.nearest(mutant) if t.startswith(f"{failed}::")]
            if copy.fails([*of_it, failed][:1], 10 * self._longest, any_time) == "":
                passed.add(failed)
            else:
                if not plain:
                    print(f"fails where nothing is broken: {failed}", flush=True)
                failing.add(failed)
                line = tried(copy, mutant, longest, failing.copy(), spare)
        if line["by"].startswith("exit"):
            whole = _others(mutant, failing)[:1]
            if whole and copy.fails(whole, spare=any_time) != "":
                raise SystemExit(f"tests do not run where nothing is broken: {line['by']}")
        return line | ({"plain": True} if plain else {})

    def _keep(self, mutant, line):
        with self._file.open("a", encoding="utf-8") as file:
            file.write(json.dumps(line) + "\n")
        print(f"{line['outcome']:9}{line['seconds']:6.1f} s  {line['name']}  {line['by']}")
        if line["outcome"] != "caught":
            print(f"{mutant.key}\n{line['diff']}")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
