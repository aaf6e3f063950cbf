"""Places in the package where a line can be broken, and the seeded lists of those that are tried.

One list is of what computes, the other of what is told of it: marked, ranked, put into tables and
heads. There a condition turned round, or a part left out of a list, is broken too.

A place is known by what stands there: module, function, kind, text and, of equals in a function,
which one. A hash of that and of the seed is its rank, and of each kind those of lowest rank are
taken. An edit elsewhere therefore leaves the list as it is, and an edit of a line takes away, or
brings, what that line has.
"""

import ast
import difflib
import fnmatch
import functools
import hashlib
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).parent
SOURCE = HERE.parents[1] / "src"
SEED = 20
COUNT, COUNT_TOLD = 200, 60
KINDS = ("sign", "factor", "exponent", "index", "bound", "constant")
KINDS_TOLD = ("condition", "part", "order", "bound", "index", "sign")

COMPUTING = (
    "slider/*", "friction/*", "normal.py", "vibration/*", "rating/*", "drive/*",
    "flanks/*", "contact/*", "block/*", "gearset/*", "tribometer/reduction/*", "formulas/*",
    "results/ledger.py",
)  # fmt: skip
# What draws, tells, writes files for others, or declares.
_NOT_COMPUTING = (
    "*plots.py", "*drawing.py", "*view.py", "*view*s.py", "*/overview.py", "*/symbols.py",
    "*/__init__.py", "*/deck/*", "flanks/export/*", "rating/report.py", "rating/workbook.py",
    "*/headline.py", "*/refusal.py", "*/notes.py", "*/library.py", "formulas/traced.py",
    "rating/levers.py", "*/result.py", "*/tables.py", "*/files.py", "*/file.py", "*/law_files.py",
    "*/dahl_files.py",
)  # fmt: skip
# Tables of a standard are numbers of the standard; those of other rooms list the case's tables.
_COMPUTING_ALL_THE_SAME = ("rating/iso14521/tables.py", "rating/bs721/tables.py")

# What is told, marked and ranked.
TELLING = (
    "results/*", "sweep/*", "start/*", "studies/*", "drive/headline.py", "drive/result.py",
    "drive/directions.py", "drive/locking.py", "drive/judgement.py", "drive/studies/*",
    "slider/result.py", "block/solution/*", "rating/result.py", "rating/standing.py",
    "rating/verdict.py", "cli/*",
)  # fmt: skip

# Functions that make words, and calls whose arguments are words or declarations.
_WORDS = ("note", "words", "text", "told", "sentence", "label", "title", "message", "describe",
          "__repr__", "__str__", "hint", "advice")  # fmt: skip
_DECLARED = {"Source", "quantity", "Symbol", "Bounds", "InputError", "warn", "round"}

_SWAPPED = {
    ast.Add: ast.Sub, ast.Sub: ast.Add,
    ast.Lt: ast.LtE, ast.LtE: ast.Lt, ast.Gt: ast.GtE, ast.GtE: ast.Gt,
    ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
}  # fmt: skip
_TURNED = {ast.Lt: ast.Gt, ast.LtE: ast.GtE, ast.Gt: ast.Lt, ast.GtE: ast.LtE,
           ast.Eq: ast.NotEq, ast.NotEq: ast.Eq}  # fmt: skip
_EXTREMES = {"min": "max", "max": "min", "minimum": "maximum", "maximum": "minimum"}
_SHORT_NAMES = 2


@dataclass(frozen=True)
class Mutant:
    """One line of the package, broken."""

    module: str  #: path below ``src/asperity``
    function: str  #: qualified name, empty at the top of the module
    kind: str
    text: str  #: the expression as it stands
    occurrence: int  #: which of equals in the function
    broken: str  #: what takes its place
    start: int = field(compare=False)  #: where it stands, in bytes
    end: int = field(compare=False)
    line: int = field(compare=False)

    @property
    def key(self) -> str:
        """What it is known by."""
        return "|".join((self.module, self.function, self.kind, self.text, str(self.occurrence)))

    @property
    def name(self) -> str:
        """Short, for the name of a test."""
        digest = hashlib.sha256(self.key.encode()).hexdigest()[:6]
        return f"{self.module.removesuffix('.py').replace('/', '.')}-{self.kind}-{digest}"

    def rank(self, seed: int) -> str:
        """Place among the others of its kind."""
        return hashlib.sha256(f"{seed}|{self.key}".encode()).hexdigest()

    def applied(self, source: str) -> str:
        """Source of the module with the line broken."""
        data = source.encode()
        return (data[: self.start] + self.broken.encode() + data[self.end :]).decode()

    def diff(self, source: str) -> str:
        """Lines before and after."""
        lines = difflib.unified_diff(
            source.splitlines(), self.applied(source).splitlines(), lineterm="", n=0
        )
        return "\n".join(list(lines)[2:])


def computing_modules(source: Path = SOURCE) -> list[str]:
    """Modules that are broken, as paths below ``asperity``."""
    package = source / "asperity"
    names = sorted(path.relative_to(package).as_posix() for path in package.rglob("*.py"))
    return [name for name in names if _computes(name)]


def telling_modules(source: Path = SOURCE) -> list[str]:
    """Modules that tell what was computed, as paths below ``asperity``."""
    package = source / "asperity"
    names = sorted(path.relative_to(package).as_posix() for path in package.rglob("*.py"))
    return [name for name in names if _among(name, TELLING) and "__init__" not in name]


def _computes(name: str) -> bool:
    return _among(name, _COMPUTING_ALL_THE_SAME) or (
        _among(name, COMPUTING) and not _among(name, _NOT_COMPUTING)
    )


def _among(name, patterns):
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns)


def mutants_of(module: str, source: str, *, told: bool = False) -> list[Mutant]:
    """All places of a module, in what it computes or in what it tells."""
    finder = (_Teller if told else _Finder)(module, source)
    finder.visit(ast.parse(source))
    return finder.found


def _of(module, source, *, told=False):
    path = source / "asperity" / module
    return mutants_of(module, path.read_text("utf-8"), told=told) if path.exists() else []


def _every(source):
    return [mutant for module in computing_modules(source) for mutant in _of(module, source)]


def seeded(candidates, count: int, seed: int = SEED, kinds=KINDS) -> list[Mutant]:
    """Of each kind as many, those of lowest rank; all kinds in turn mixed by their rank."""
    chosen = []
    for n, kind in enumerate(kinds):
        share = (count + len(kinds) - 1 - n) // len(kinds)
        of_kind = [mutant for mutant in candidates if mutant.kind == kind]
        chosen += sorted(of_kind, key=lambda mutant: mutant.rank(seed))[:share]
    return sorted(chosen, key=lambda mutant: mutant.rank(seed))


def known() -> dict:
    """Those that are always tried, and those that change nothing that can be observed."""
    return tomllib.loads((HERE / "known.toml").read_text("utf-8"))


def always(source: Path = SOURCE) -> list[Mutant]:
    """Those of ``known.toml`` that are always tried; of one whose text has gone, nothing."""
    wanted = [entry["key"] for entry in known()["always"]]
    modules = dict.fromkeys(key.partition("|")[0] for key in wanted)
    by_key = {mutant.key: mutant for module in modules for mutant in _of(module, source)}
    return [by_key[key] for key in wanted if key in by_key]


@functools.cache
def listed(count: int = COUNT, seed: int = SEED, source: Path = SOURCE) -> list[Mutant]:
    """The seeded list, those that are always tried first."""
    first = always(source)
    others = [mutant for mutant in _every(source) if mutant not in first]
    return first + seeded(others, count - len(first), seed)


@functools.cache
def listed_told(count: int = COUNT_TOLD, seed: int = SEED, source: Path = SOURCE) -> list[Mutant]:
    """The seeded list of what is told."""
    every = [m for module in telling_modules(source) for m in _of(module, source, told=True)]
    return seeded(every, count, seed, KINDS_TOLD)


class _Finder(ast.NodeVisitor):
    def __init__(self, module, source):
        self.module, self._data = module, source.encode()
        self.found = []
        self._names = []
        self._counts = {}
        self._starts = [0]
        for line in self._data.splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        # What some parent has looked at already, by id.
        self._taken = set()

    # What is not computing.

    def visit(self, node):
        if not isinstance(node, ast.Raise | ast.Assert | ast.JoinedStr):
            super().visit(node)

    def visit_FunctionDef(self, node):
        if any(word in node.name for word in _WORDS) or node.name.startswith(("plot", "draw")):
            return
        self._names.append(node.name)
        for default in (*node.args.defaults, *node.args.kw_defaults):
            if default is not None:
                self.visit(default)
        for statement in node.body:
            self.visit(statement)
        self._names.pop()

    def visit_ClassDef(self, node):
        self._names.append(node.name)
        for statement in node.body:
            self.visit(statement)
        self._names.pop()

    def visit_AnnAssign(self, node):
        if node.value is not None:
            self.visit(node.value)

    def visit_Assign(self, node):
        named = {target.id for target in node.targets if isinstance(target, ast.Name)}
        # An alias of a type (`Annotated[...]`, `Literal[...]`) is none that computes.
        is_type = isinstance(node.value, ast.Subscript) and isinstance(node.value.value, ast.Name)
        is_type = is_type and node.value.value.id in {"Annotated", "Literal"}
        if not is_type and "__all__" not in named:
            self.generic_visit(node)

    def visit_Call(self, node):
        called = getattr(node.func, "id", getattr(node.func, "attr", ""))
        if called in _DECLARED or any(word in called for word in _WORDS):
            return
        if called == "sqrt" and len(node.args) == 1:
            self._take(node, "exponent", node.args[0])
        if called in _EXTREMES and (len(node.args) > 1 or "." not in ast.unparse(node.func)):
            other = _copy(node)
            name = _EXTREMES[called]
            if isinstance(other.func, ast.Name):
                other.func.id = name
            else:
                other.func.attr = name
            self._take(node, "bound", other)
        for keyword in node.keywords:
            if keyword.arg == "axis" and (step := _int(keyword.value)) is not None:
                self._take(keyword.value, "index", ast.Constant(1 - step if step >= 0 else 0))
                self._taken.add(id(keyword.value))
        self.generic_visit(node)

    # What is.

    def visit_BinOp(self, node):
        op = type(node.op)
        # Texts and lists are put together by the same signs.
        if any(isinstance(side, (ast.JoinedStr, ast.List, ast.Tuple, ast.ListComp))
               or isinstance(getattr(side, "value", None), str)
               for side in (node.left, node.right)):  # fmt: skip
            return
        if op in (ast.Add, ast.Sub):
            self._take_operator(node, {ast.Add: "-", ast.Sub: "+"}[op])
        elif op in (ast.Mult, ast.Div):
            sides = [side for side in (node.left, node.right) if _number(side) not in (None, 0)]
            for side in sides:
                self._take(side, "factor", ast.Constant(_scaled(_number(side))))
                self._taken.add(id(side))
            if not sides:
                self._take(node, "factor", node.left)
        elif op is ast.Pow:
            power = node.right
            if (value := _number(power)) is not None:
                self._taken.add(id(power))
                more = value + 1 if isinstance(value, int) else _scaled(value)
                self._take(power, "exponent", ast.Constant(more))
            else:
                self._take(node, "exponent", ast.BinOp(node.left, ast.Pow(), ast.BinOp(
                    ast.Constant(1.1), ast.Mult(), power)))  # fmt: skip
        self.generic_visit(node)

    def visit_AugAssign(self, node):
        swap = {**_SWAPPED, ast.Mult: ast.Div, ast.Div: ast.Mult}.get(type(node.op))
        if swap is not None and not isinstance(node.value, (ast.JoinedStr, ast.List, ast.Tuple)):
            kind = "sign" if swap in (ast.Add, ast.Sub) else "factor"
            self._take(node, kind, ast.AugAssign(node.target, swap(), node.value))
        self.generic_visit(node)

    def visit_UnaryOp(self, node):
        if isinstance(node.op, ast.USub) and id(node) not in self._taken:
            self._take(node, "sign", node.operand)
        self.generic_visit(node)

    def visit_Subscript(self, node):
        indices = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
        for index in indices:
            for part in (index.lower, index.upper) if isinstance(index, ast.Slice) else (index,):
                if part is None:
                    continue
                if (value := _int(part)) is not None:
                    self._mark(part)
                    self._take(part, "index", _constant(value + (1 if value <= 0 else -1)
                               if value != -1 else -2))  # fmt: skip
                elif isinstance(part, ast.Name) and len(part.id) <= _SHORT_NAMES:
                    self._take(part, "index", ast.BinOp(part, ast.Sub(), ast.Constant(1)))
        self.generic_visit(node)

    def visit_Compare(self, node):
        op = type(node.ops[0])
        if len(node.ops) == 1 and op in _TURNED:
            right, left = node.comparators[0], node.left
            texts = any(isinstance(getattr(side, "value", None), str) for side in (left, right))
            named = ast.unparse(node)
            value = _number(right)
            if texts or any(word in named for word in ("__", "version", "model", "mode ", "law")):
                pass
            elif isinstance(value, float) and value:
                self._mark(right)
                self._take(right, "bound", ast.Constant(_scaled(value)))
            else:
                is_count = _int(right) is not None or "len(" in named or ".size" in named
                changed = (_SWAPPED if is_count and _int(right) != 0 else _TURNED)[op]
                self._mark(right)
                self._take(node, "bound", ast.Compare(left, [changed()], [right]))
        self.generic_visit(node)

    def visit_Constant(self, node):
        value = _number(node)
        if value is None or id(node) in self._taken:
            return
        self._take(node, "constant", ast.Constant(_other(value)))

    def _mark(self, node):
        for part in ast.walk(node):
            self._taken.add(id(part))

    def _take_operator(self, node, sign):
        """A sum in which the sign alone is changed, where it stands."""
        first, last = self._ends(node.left)[1], self._ends(node.right)[0]
        between = self._data[first:last]
        place = between.find(b"+" if sign == "-" else b"-")
        if b"#" not in between:
            self._add(node, "sign", sign, first + place, first + place + 1)

    def _take(self, node, kind, other):
        ast.fix_missing_locations(other)
        broken = ast.unparse(other)
        if isinstance(other, ast.BinOp | ast.UnaryOp) and kind != "index":
            broken = f"({broken})"
        self._add(node, kind, broken, *self._ends(node))

    def _add(self, node, kind, broken, start, end):
        function, text = ".".join(self._names), ast.unparse(node)
        count = self._counts.get((function, kind, text), 0)
        self._counts[function, kind, text] = count + 1
        self.found.append(
            Mutant(self.module, function, kind, text, count, broken, start, end, node.lineno)
        )

    def _ends(self, node):
        start = self._starts[node.lineno - 1] + node.col_offset
        return start, self._starts[node.end_lineno - 1] + node.end_col_offset


class _Teller(_Finder):
    """Places in what is told: conditions, parts of lists and orders, in words' functions too."""

    def visit_FunctionDef(self, node):
        self._names.append(node.name)
        for statement in node.body:
            self.visit(statement)
        self._names.pop()

    def visit_If(self, node):
        self._condition(node.test)
        self.generic_visit(node)

    def visit_IfExp(self, node):
        self._condition(node.test)
        self.generic_visit(node)

    def visit_comprehension(self, node):
        for test in node.ifs:
            self._condition(test)
        self.generic_visit(node)

    def visit_Starred(self, node):
        # An iteration's rest or a call's options are none that is told.
        if isinstance(node.ctx, ast.Load) and not isinstance(node.value, ast.Name):
            self._add(node.value, "part", "()", *self._ends(node.value))
        self.generic_visit(node)

    def visit_Call(self, node):
        called = getattr(node.func, "id", getattr(node.func, "attr", ""))
        if called in {"sorted", "sort"}:
            turned = _copy(node)
            flags = {keyword.arg: keyword for keyword in turned.keywords}
            if "reverse" in flags:
                flags["reverse"].value = ast.UnaryOp(ast.Not(), flags["reverse"].value)
            else:
                turned.keywords.append(ast.keyword("reverse", ast.Constant(True)))
            self._take(node, "order", turned)
        if called in _EXTREMES and (len(node.args) > 1 or "." not in ast.unparse(node.func)):
            other = _copy(node)
            if isinstance(other.func, ast.Name):
                other.func.id = _EXTREMES[called]
            else:
                other.func.attr = _EXTREMES[called]
            self._take(node, "order", other)
        self.generic_visit(node)

    def _condition(self, test):
        if id(test) not in self._taken and not isinstance(test, ast.Constant):
            self._mark(test)
            other = (
                test.operand
                if isinstance(test, ast.UnaryOp) and isinstance(test.op, ast.Not)
                else ast.UnaryOp(ast.Not(), test)
            )
            self._take(test, "condition", other)


def _copy(node):
    return ast.parse(ast.unparse(node), mode="eval").body


def _number(node):
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub):
        value = _number(node.operand)
        return None if value is None else -value
    value = getattr(node, "value", None) if isinstance(node, ast.Constant) else None
    return value if isinstance(value, int | float) and not isinstance(value, bool) else None


def _int(node):
    value = _number(node)
    return value if isinstance(value, int) else None


def _constant(value):
    return ast.Constant(value) if value >= 0 else ast.UnaryOp(ast.USub(), ast.Constant(-value))


def _scaled(value):
    """A factor that is wrong: by a tenth; a tiny or huge one, a tolerance or a cap, by 1000."""
    if isinstance(value, int):
        return value + 1 if abs(value) < 10 else value // 2
    if 0.0 < abs(value) < 1e-4:
        return float(f"{value * 1000.0:.6g}")
    if abs(value) >= 1e5:
        return float(f"{value / 1000.0:.6g}")
    return float(f"{value * 1.1:.6g}")


def _other(value):
    """A number that is wrong."""
    if value == 0:
        return 1 if isinstance(value, int) else 1.0
    return _scaled(value)
