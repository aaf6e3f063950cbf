"""The tests nearest to a line: those that call the function it stands in, and little else.

``python tests/mutants/near.py`` runs the ordinary tests, notes which functions of the package each
calls (``reach.py``) and writes ``near.json.gz``. A function that is not in it, since it has come
later, has the tests of its module's others; a module that is not, the files of tests that name it
or its room.
"""

import ast
import functools
import gzip
import json
import os
import re
import subprocess
import sys
from collections import Counter, defaultdict
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[1]))

from mutants.sites import HERE, SOURCE, computing_modules

TESTS = HERE.parent
ROOT = TESTS.parent
KEPT = HERE / "near.json.gz"
ANSWERS = "tests/acceptance/test_same_answers.py"

# What is about processes, files, texts or the page, and what needs programs of others.
_LEFT_OUT = re.compile(
    r"test_(web|docs|house|processes|rig_|terminal|store|interrupts|runs|casefile|compiled|errors|"
    r"units|thesis_run|thesis_figures|fric_subroutine|calculix|python_units|sweep_axes|mutants)"
)
_OF_A_FUNCTION = 2  # tests that differ in their parameters alone
_OF_A_FILE = 5
_NEAREST = 16
_RECORDED = 4
_DEAREST = 20.0  # s, of one test
_FALLBACK_FILES = 4


def nearest(mutant) -> list[str]:
    """Tests that are nearest to a mutant, the nearest first, as pytest names them."""
    kept = _kept()
    counts = Counter()
    for function in _readers(mutant):
        tests = kept["near"].get(f"{mutant.module}:{function}", ())
        counts.update({test: _NEAREST + _RECORDED - n for n, test in enumerate(tests)})
    if not counts:
        for name, tests in kept["near"].items():
            if name.startswith(f"{mutant.module}:"):
                counts.update({test: _NEAREST + _RECORDED - n for n, test in enumerate(tests)})
    chosen = [kept["tests"][n] for n, _ in counts.most_common(_NEAREST + _RECORDED)]
    return chosen or _naming(mutant.module)


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
        return [mutant.function]
    if mutant.function:
        return [name for name in functions if name.startswith(f"{mutant.function}.")]
    names = {
        target.id
        for statement in tree.body
        if statement.lineno <= mutant.line <= statement.end_lineno
        for target in ast.walk(statement)
        if isinstance(target, ast.Name) and isinstance(target.ctx, ast.Store)
    }
    return [
        name
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
    texts = {path: path.read_text("utf-8") for path in sorted(TESTS.glob("*/test_*.py"))}
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
    """Make the map of what :mod:`reach` noted, lines of JSON."""
    modules = set(computing_modules())
    lines = {line["test"]: line for line in map(json.loads, reached)}
    callers, size = defaultdict(set), {}
    for test, line in lines.items():
        called = {_plain(name) for name in line["called"] if name.partition(":")[0] in modules}
        size[test] = len(called)
        for name in called:
            callers[name].add(test)
    near = {name: _nearest(tests, size, lines) for name, tests in sorted(callers.items())}
    used = sorted({test for tests in near.values() for test in tests})
    number = {test: n for n, test in enumerate(used)}
    return {
        "tests": used,
        "near": {name: [number[test] for test in tests] for name, tests in near.items()},
    }


def _plain(name):
    """Qualified name of a function as it is written: a comprehension is of what it stands in."""
    return re.sub(r"(\.<locals>)|(\.<(listcomp|genexpr|dictcomp|setcomp|lambda)>)", "", name)


def _nearest(tests, size, lines):
    chosen, functions, files = [], Counter(), Counter()
    for test in sorted(tests, key=lambda test: (size[test], lines[test]["seconds"], test)):
        file, function = test.partition("::")[0], test.partition("[")[0]
        if lines[test]["seconds"] > _DEAREST or len(chosen) == _NEAREST or file == ANSWERS:
            continue
        if functions[function] < _OF_A_FUNCTION and files[file] < _OF_A_FILE:
            chosen.append(test)
            functions[function] += 1
            files[file] += 1
    # Of the recorded answers, which see whatever moves, the cheapest, of different commands.
    commands = Counter()
    recorded = []
    for test in sorted(tests, key=lambda test: (lines[test]["seconds"], test)):
        if test.startswith(ANSWERS) and len(recorded) < _RECORDED:
            command = test.partition("[")[2].split(" ")[0]
            if commands[command] < _OF_A_FUNCTION and lines[test]["seconds"] <= _DEAREST:
                recorded.append(test)
                commands[command] += 1
    return chosen + recorded


def measure(out: Path) -> Path:
    """Run the ordinary tests, with a cache of their own, and return what they reached."""
    out.mkdir(parents=True, exist_ok=True)
    reached = out / "reached.jsonl"
    reached.unlink(missing_ok=True)
    files = [
        path.relative_to(ROOT).as_posix()
        for folder in ("unit", "literature", "property")
        for path in sorted((TESTS / folder).glob("test_*.py"))
        if not _LEFT_OUT.match(path.name)
    ]
    environment = os.environ | {
        "PYTHONPATH": os.pathsep.join((str(SOURCE), str(TESTS))),
        "OPENBLAS_NUM_THREADS": "1",
        "REACHED": str(reached),
    }
    subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "mutants.reach", "-p", "no:cacheprovider",
         *files, ANSWERS],
        cwd=ROOT, env=environment, check=False,
    )  # fmt: skip
    return reached


def write(reached: Path) -> None:
    """Write the map, the same bytes for the same tests."""
    found = make(reached.read_text("utf-8").splitlines())
    KEPT.write_bytes(gzip.compress(json.dumps(found, separators=(",", ":")).encode(), mtime=0))
    print(f"{KEPT}: {len(found['near'])} functions, {len(found['tests'])} tests")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        write(Path(sys.argv[1]))  # what an earlier run has noted
    else:
        write(measure(ROOT / "out" / "mutants"))
