"""The tests nearest to a line: those that call the function it stands in, and little else.

Of those the first are of files that import the function by its name: they look at what it returns.
Dear ones come behind cheap ones, so that time is not up before what would have noticed it ran.

``python tests/mutants/near.py`` runs the ordinary tests, notes which functions of the package each
calls (``reach.py``) and writes ``near.json.gz``; with files or names of tests it runs those, and
keeps what stands there of others; ``--jobs N`` runs N at a time. A function that is not in it,
since it has come later, has the tests of its module's others; a module that is not, the files of
tests that name it or its room.

What has come since cannot be noted there: a file of tests that is not what it was when the map was
made is near to each module that it imports, and comes behind the others.
"""

import argparse
import ast
import functools
import gzip
import hashlib
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter, defaultdict
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from mutants.sites import HERE, SOURCE, computing_modules, telling_modules

TESTS = HERE.parent
ROOT = TESTS.parent
KEPT = HERE / "near.json.gz"
ANSWERS = "tests/acceptance/test_same_answers.py"
TABLES = "tests/unit/test_tables.py"

# What is about processes, files, texts or the page, and what needs programs of others.
_LEFT_OUT = re.compile(
    r"test_(web|docs|house|processes|terminal|store|interrupts|runs|compiled|mutants|thesis_run|"
    r"thesis_figures|fric_subroutine|calculix|docstrings|language|questions|"
    r"rig_(acquisition|contract|guardian|instruments|plan|preview|procedure|twin|off|kills|package)|"
    r"cli_(rig_run|streams|cache|instruments|help))"
)
_FOLDERS = {
    "unit": "test_*", "literature": "test_*", "property": "test_*", "acceptance": "test_cli_*",
}  # fmt: skip
_OF_A_FUNCTION = 2  # tests that differ in their parameters alone
_OF_A_FILE = 4
_NEAREST = 20
# A test of what is refused goes through little and looks at less: it comes last.
_REFUSED = re.compile(r"refuse|cannot|asked_for|is_needed|nonsense|interrupted|hears")
_RECORDED = 6
_DEAREST = 20.0  # s, of one test
_MOST, _LONGEST = 100, 20.0  # tests, and s of all
_FEW, _FALLBACK_FILES = 5, 4
# s: up to which tests stand by how near they are alone, and at least of a whole file, whose slow
# tests nobody timed.
_CHEAP, _OF_FILES = 0.5, 10.0


def nearest(mutant) -> list[str]:
    """Tests that are nearest to a mutant, the nearest first, as pytest names them."""
    kept = _kept()
    counts = Counter()
    for function in _readers(mutant):
        tests = kept["near"].get(function, ())
        counts.update({test: _MOST - n for n, test in enumerate(tests)})
    if len(counts) < _FEW:
        # What is new has few: those of the module's other functions, and files that name it.
        others = Counter()
        for name, tests in kept["near"].items():
            if name.startswith(f"{mutant.module}:"):
                others.update({test: _MOST - n for n, test in enumerate(tests)})
        counts.update(dict.fromkeys(others.keys() - counts.keys(), 0))
    chosen = [kept["tests"][n] for n, _ in counts.most_common(_MOST)]
    if not mutant.function:
        # A number of a module: who names that may look at it without calling anything.
        named = _naming(mutant.module)
        own = [name for name in named if Path(mutant.module).stem in name]
        chosen = list(dict.fromkeys(own[:1] + named[:1])) + chosen
    chosen += _come_since(mutant.module)
    if len(chosen) < _FEW:
        chosen += _naming(mutant.module)
    if not _is_called(mutant):
        # A table or a default; what an answer says of it comes first.
        chosen.append(TABLES)
    return sorted(dict.fromkeys(chosen), key=_dearness)


def _dearness(test):
    """How often the time of cheap tests doubles in that of a test, or of all of a file."""
    seconds = _seconds()[test] if "::" in test else max(_seconds()[test], _OF_FILES)
    return math.ceil(math.log2(max(seconds / _CHEAP, 1.0)))


@functools.cache
def _seconds():
    """Seconds of each test, and of those of each file, as they were noted."""
    found = Counter()
    for test, seconds in zip(_kept()["tests"], _kept().get("seconds", ()), strict=False):
        found.update({test: seconds, test.partition("::")[0]: seconds})
    return found


def _is_called(mutant):
    tree = ast.parse((SOURCE / "asperity" / mutant.module).read_text("utf-8"))
    return mutant.function in dict(_functions(tree))


def _come_since(module):
    """Files of tests that import a module and are not what they were when the map was made."""
    room, _, last = ".".join(("asperity", *module.removesuffix(".py").split("/"))).rpartition(".")
    known = _kept().get("files", {})
    return [
        file
        for file, (imported, _) in _imports().items()
        if (f"{room}.{last}" in imported or last in imported.get(room, ()))
        and not _LEFT_OUT.match(Path(file).name)
        and known.get(file) != _digest(file)
    ]


@functools.cache
def _digest(file):
    return hashlib.sha256((ROOT / file).read_bytes()).hexdigest()[:8]


@functools.cache
def _kept():
    if not KEPT.exists():
        return {"tests": [], "near": {}}
    return json.loads(gzip.decompress(KEPT.read_bytes()))


def _readers(mutant):
    """Functions that use what is broken: its own, or those that name a constant or a field."""
    package = SOURCE / "asperity"
    tree = ast.parse((package / mutant.module).read_text("utf-8"))
    functions = dict(_functions(tree))
    if mutant.function in functions:
        return [f"{mutant.module}:{mutant.function}"]
    if mutant.function:
        inside = f"{mutant.function}."
        return [f"{mutant.module}:{name}" for name in functions if name.startswith(inside)]
    names = {
        target.id
        for statement in tree.body
        if statement.lineno <= mutant.line <= statement.end_lineno
        for target in ast.walk(statement)
        if isinstance(target, ast.Name) and isinstance(target.ctx, ast.Store)
    }
    found = _naming_any(mutant.module, functions, names)
    dotted = ".".join(("asperity", *mutant.module.removesuffix(".py").split("/")))
    for module in dict.fromkeys([*computing_modules(), *telling_modules()]):
        text = (package / module).read_text("utf-8")
        if f"from {dotted} import" in text:
            found += _naming_any(module, dict(_functions(ast.parse(text))), names)
    return found


def _naming_any(module, functions, names):
    return [
        f"{module}:{name}"
        for name, node in functions.items()
        if names & {part.id for part in ast.walk(node) if isinstance(part, ast.Name)}
    ]


def _functions(tree, above=""):
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            name = f"{above}{node.name}"
            if isinstance(node, ast.FunctionDef):
                yield name, node
            yield from _functions(node, f"{name}.")
        else:
            yield from _functions(node, above)


def _naming(module):
    """Files of tests that name a module, or its room, the closest first."""
    parts = module.removesuffix(".py").split("/")
    found = []
    texts = {
        path: path.read_text("utf-8")
        for path in sorted(TESTS.glob("*/test_*.py"))
        if path.parent.name != "browser"
    }
    for depth in range(len(parts), 0, -1):
        name = ".".join(("asperity", *parts[:depth]))
        package, _, last = name.rpartition(".")
        names = re.compile(
            rf"\b({re.escape(name)}\b|from {re.escape(package)} import .*\b{last}\b)"
        )
        for path, text in texts.items():
            if names.search(text) and not _LEFT_OUT.match(path.name):
                found.append(path.relative_to(ROOT).as_posix())
    return list(dict.fromkeys(found))[:_FALLBACK_FILES]


def make(reached) -> dict:
    """Make the map of what :mod:`reach` noted of each test."""
    modules = {*computing_modules(), *telling_modules()}
    lines = {line["test"]: line for line in reached}
    callers, size = defaultdict(set), {}
    for test, line in lines.items():
        called = {_plain(name) for name in line["called"] if name.partition(":")[0] in modules}
        size[test] = line.get("size", len(called))
        for name in called:
            callers[name].add(test)
    near = {
        name: _nearest(tests, size, lines, _importing(name))
        for name, tests in sorted(callers.items())
    }
    used = sorted({test for tests in near.values() for test in tests})
    number = {test: n for n, test in enumerate(used)}
    return {
        "tests": used,
        "sizes": [size[test] for test in used],
        "seconds": [round(lines[test]["seconds"], 3) for test in used],
        "near": {name: [number[test] for test in tests] for name, tests in near.items()},
    }


def _noted(kept, of_others):
    """What a map tells of other tests, as it was noted: of those for which ``of_others`` holds."""
    called = defaultdict(list)
    for name, tests in kept["near"].items():
        for test in tests:
            called[test].append(name)
    for n, test in enumerate(kept["tests"]):
        if of_others(test):
            size = kept["sizes"][n] if "sizes" in kept else len(called[n])
            seconds = kept["seconds"][n] if "seconds" in kept else 0.0
            yield {"test": test, "seconds": seconds, "called": called[n], "size": size}


def _plain(name):
    """Qualified name of a function as it is written: a comprehension is of what it stands in."""
    return re.sub(r"(\.<locals>)|(\.<(listcomp|genexpr|dictcomp|setcomp|lambda)>)", "", name)


def _importing(function):
    """Files of tests that import a function, or its class, by name, or name it by its module."""
    module, _, name = function.partition(":")
    dotted = ".".join(("asperity", *module.removesuffix(".py").split("/")))
    room, _, last = dotted.rpartition(".")
    own = name.partition(".")[0]
    return {
        file
        for file, (imported, text) in _imports().items()
        if own in imported.get(dotted, ())
        or (last in imported.get(room, ()) and re.search(rf"\b{last}\.{own}\b", text))
    }


@functools.cache
def _imports():
    """Names that each file of tests imports, by module, and its text."""
    found = {}
    for path in sorted(TESTS.glob("*/test_*.py")):
        text = path.read_text("utf-8")
        imported = defaultdict(set)
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ImportFrom) and node.module:
                imported[node.module].update(alias.name for alias in node.names)
        found[path.relative_to(ROOT).as_posix()] = imported, text
    return found


def _nearest(tests, size, lines, importing):
    def close(test):
        return (
            bool(_REFUSED.search(test)), test.partition("::")[0] not in importing,
            size[test], lines[test]["seconds"], test,
        )  # fmt: skip

    tests = {test for test in tests if lines[test]["seconds"] <= _DEAREST}
    recorded = {test for test in tests if test.startswith(ANSWERS)}
    ordered = sorted(tests - recorded, key=close)
    # First a few of each file, then recorded answers, which see whatever moves, then the others.
    first = _few_of_each(ordered, _OF_A_FILE, _NEAREST)
    answers = _few_of_each(sorted(recorded, key=close), _RECORDED, _RECORDED)
    chosen = list(dict.fromkeys(first + answers))[:_MOST]
    # A dear one among those takes nothing from the cheap ones that follow.
    spent = 0.0
    for test in _in_turns(ordered):
        own = lines[test]["seconds"]
        if test not in chosen and len(chosen) < _MOST and spent + own <= _LONGEST:
            chosen.append(test)
            spent += own
    return chosen


def _in_turns(tests):
    """Of those that differ in their parameters alone a few, then of all a few more, and so on."""
    had, turns = Counter(), {}
    for test in tests:
        turns[test] = had[test.partition("[")[0]] // _OF_A_FUNCTION
        had[test.partition("[")[0]] += 1
    return sorted(tests, key=turns.get)


def _few_of_each(tests, of_a_file, most):
    """Of each file a few, and of those that differ in their parameters alone fewer."""
    chosen, functions, files = [], Counter(), Counter()
    for test in tests:
        file, function = test.partition("::")[0], test.partition("[")[0]
        if file == ANSWERS:
            function = test.partition("[")[2].split(" ")[0]
        if functions[function] < _OF_A_FUNCTION and files[file] < of_a_file:
            chosen.append(test)
            functions[function] += 1
            files[file] += 1
    return chosen[:most]


def _ordinary():
    """Files of the tests that the map is made of."""
    return [
        *(
            path.relative_to(ROOT).as_posix()
            for folder, names_of in _FOLDERS.items()
            for path in sorted((TESTS / folder).glob(f"{names_of}.py"))
            if not _LEFT_OUT.match(path.name)
        ),
        ANSWERS,
    ]


def _slow():
    """Slow tests, as they stand."""
    told = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "--collect-only", "-m", "slow", *_ordinary()],
        cwd=ROOT, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return {line for line in told.stdout.splitlines() if "::" in line}


def measure(reached: Path, names=(), jobs: int = 1) -> None:
    """Run the ordinary tests, or those named and slow ones among them; note what they reach."""
    shared = ["-n", str(jobs), "--dist", "loadfile"] if jobs > 1 else []
    shared += ["-m", "slow or not slow"] if names else []
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join((str(SOURCE), str(TESTS))),
        "OPENBLAS_NUM_THREADS": "1",
        "REACHED": str(reached),
    }
    subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "mutants.reach", "-p", "no:cacheprovider",
         *shared, *(names or _ordinary())],
        cwd=ROOT, env=environment, check=False,
    )  # fmt: skip


def write(reached: Path, names=()) -> None:
    """Write the map, the same bytes for the same tests; of others than these as it stands.

    Where all are run, the others are slow ones. A file counts as known where a test of it is named.
    """
    lines = [json.loads(line) for line in reached.read_text("utf-8").splitlines()]
    slow = set() if names else _slow()

    def of_others(test):
        if not names:
            return test in slow
        return not {test, test.partition("[")[0], test.partition("::")[0]} & set(names)

    found = make([*_noted(_kept(), of_others), *lines])
    known = {file: is_it for file, is_it in _kept().get("files", {}).items() if names}
    files = [name.partition("::")[0] for name in names] or _ordinary()
    known |= {file: _digest(file) for file in files if (ROOT / file).is_file()}
    found["files"] = dict(sorted(known.items()))
    KEPT.write_bytes(gzip.compress(json.dumps(found, separators=(",", ":")).encode(), mtime=0))
    print(f"{KEPT}: {len(found['near'])} functions, {len(found['tests'])} tests")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--jobs", type=int, default=1, help="so many at a time")
    parser.add_argument("names", nargs="*", help="files or names of tests, instead of all")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        noted = Path(folder) / "reached.jsonl"
        measure(noted, asked.names, asked.jobs)
        write(noted, asked.names)
