"""What kernels may do, for machine code that is called without Numba and without Python."""

import ast
import functools
import importlib
import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import asperity
from asperity.kernels import folder as kernel_folder
from asperity.kernels.dense import copy, multiply
from asperity.kernels.native import kept, keys, load, makers, table
from asperity.kernels.native.entries import listed
from asperity.kernels.native.target import FEATURES

PACKAGE = Path(asperity.__file__).parent
NUMBERS = {float, int, bool, "float", "int", "bool"}
ALLOCATING = {
    "arange", "array", "asarray", "concatenate", "copy", "empty", "empty_like", "eye", "full",
    "full_like", "linspace", "ones", "ones_like", "outer", "stack", "zeros", "zeros_like",
}  # fmt: skip
# Of arrays: they make new ones, raise where shapes do not fit, or may do either.
METHODS = {
    "all", "any", "argmax", "argmin", "argsort", "astype", "copy", "dot", "fill", "flatten", "max",
    "mean", "min", "ravel", "reshape", "sort", "sum", "transpose", "view",
}  # fmt: skip

ROOM_OF_THEIR_OWN = {
    # What a command calls a few times at most, for loops that then run without any. Arrays of no
    # nodes, where a march or a cycle records none.
    "asperity.slider.kernels.march_stretches",
    "asperity.slider.shooting.run",
    "asperity.slider.shooting.run_cycle",
    # What a whole march, search or recording then works in, as large as what it begins with.
    "asperity.drive.elastic.march.march",
    "asperity.slider.at_corners._let_down_in_a_cycle",
    "asperity.slider.held_kernels.carry",
    "asperity.slider.on_twice._moved",
    "asperity.slider.on_twice._pairs",
    "asperity.slider.search_room.room_for",
    "asperity.slider.shooting.shoot",
    "asperity.slider.unknowns.unknown_scales",
    "asperity.thesis.drive.appendix_e.follow",
    "asperity.tribometer.reduction.noise.weighed",
    "asperity.tribometer.reduction.noise.whitened",
    "asperity.tribometer.twin.plant_kernels.sample",
    # A few numbers that all points of a grid or all teeth share in turn; threads call them at once.
    "asperity.drive.teeth.contact._act",
    "asperity.flanks.meshing.kernels.transmission.least_each",
    "asperity.flanks.wheel.cutting.trim_grid.fillet_grid",
    "asperity.flanks.wheel.cutting.trim_grid.flank_grid",
    "asperity.flanks.wheel.cutting.trim_grid.limits_each",
    "asperity.flanks.wheel.cutting.trim_grid.locate_each",
    "asperity.flanks.wheel.cutting.undercut.regularity_map",
}

# NumPy's functions of numbers, for which there is none in `math` or one that answers otherwise; of
# an array they would make another.
OF_NUMBERS = {
    ("asperity.drive.elastic.march.march", "isfinite"),
    ("asperity.drive.elastic.rim.way_of", "sqrt"),
    ("asperity.normal.indentation", "cbrt"),
    ("asperity.slider.pieces.value_and_slope", "searchsorted"),
    ("asperity.thesis.drive.appendix_e.advance", "hypot"),
    ("asperity.thesis.drive.appendix_e.advance", "sign"),
    ("asperity.tribometer.twin.plant_kernels.friction_at", "searchsorted"),
    ("asperity.vibration.waveform.fill_increments", "floor"),
}
NO_FUNCTIONS = {"inf", "int16", "int64"}


def is_kernel(node):
    return isinstance(node, ast.FunctionDef) and any(
        (d.func if isinstance(d, ast.Call) else d).id == "kernel"
        for d in node.decorator_list
        if isinstance(d.func if isinstance(d, ast.Call) else d, ast.Name)
    )


IMPORTED = re.compile(r"^[ \t]*from[ \t]+([\w.]+)[ \t]+import\b", re.MULTILINE)


@functools.cache
def trees():
    """Modules that have kernels, and those that import from one or from the folder of one."""
    texts = {}
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE.parent).with_suffix("")
        texts[".".join(place.parts).removesuffix(".__init__")] = path.read_text("utf-8")
    having = {module for module, text in texts.items() if "@kernel" in text}
    known = having | {module.rpartition(".")[0] for module in having}
    return {
        module: ast.parse(text)
        for module, text in texts.items()
        if module in having or not known.isdisjoint(IMPORTED.findall(text))
    }


@functools.cache
def kernels():
    return {
        f"{module}.{node.name}": node
        for module, tree in trees().items()
        for node in ast.walk(tree)
        if is_kernel(node)
    }


def refused(kernel):
    """What a kernel does that machine code without Python cannot, or should not."""
    for node in ast.walk(kernel):
        if isinstance(node, ast.Raise | ast.Try | ast.Assert | ast.With):
            yield node.lineno, "exceptions"
        elif isinstance(node, ast.MatMult):
            yield kernel.lineno, "@"
        elif isinstance(node, ast.ListComp | ast.List | ast.Dict | ast.Set | ast.JoinedStr):
            yield node.lineno, "objects of Python"
        elif isinstance(node, ast.Attribute):
            name = ast.unparse(node)
            if name.startswith("np.linalg") or name in ("np.dot", "np.matmul"):
                yield node.lineno, name
            elif node.attr == "T":
                yield node.lineno, "transposed"
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute):
            of_numpy = ast.unparse(node.func.value) in ("np", "math")
            if not of_numpy and node.func.attr in METHODS:
                yield node.lineno, f".{node.func.attr}()"
        elif isinstance(node, ast.Assign):
            for target in node.targets:
                if is_part(target) and not isinstance(node.value, ast.Constant):
                    yield node.lineno, "a part of an array written at once"
                if isinstance(target, ast.Subscript) and isinstance(node.value, ast.Tuple):
                    yield node.lineno, "a row written at once"
        elif isinstance(node, ast.AugAssign) and is_part(node.target):
            yield node.lineno, "a part of an array written at once"


def is_part(target):
    return isinstance(target, ast.Subscript) and any(
        isinstance(node, ast.Slice) or (isinstance(node, ast.Constant) and node.value is ...)
        for node in ast.walk(target.slice)
    )


def of_numpy(kernel):
    """Names that a kernel takes from NumPy."""
    return {
        node.attr
        for node in ast.walk(kernel)
        if isinstance(node, ast.Attribute)
        and isinstance(node.value, ast.Name)
        and node.value.id == "np"
    }


@functools.cache
def called_from_python():
    """Kernels that other functions than kernels name."""
    return {
        name
        for module, tree in trees().items()
        for name in named_in(tree, module, but_for_kernels=True)
    }


def called_by(name):
    """A kernel with all that it calls, and that those call."""
    known, waiting = set(), [name]
    while waiting:
        name = waiting.pop()
        if name not in known:
            known.add(name)
            waiting += calls_of(name)
    return known


@functools.cache
def calls_of(name):
    return {*named_in(kernels()[name], name.rpartition(".")[0])}


@functools.cache
def names_in(module):
    """Kernels by what a module calls them, and what else it imports."""
    known = {name.rsplit(".", 1)[1]: name for name in kernels() if name.startswith(f"{module}.")}
    modules = {}
    for node in ast.walk(trees()[module]):
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                full = f"{node.module}.{alias.name}"
                if full in kernels():
                    known[alias.asname or alias.name] = full
                modules[alias.asname or alias.name] = full
    return known, modules


def named_in(top, module, but_for_kernels=False):
    known, modules = names_in(module)
    waiting = [top]
    while waiting:
        node = waiting.pop()
        inner = ast.iter_child_nodes(node)
        waiting += [each for each in inner if not (but_for_kernels and is_kernel(each))]
        if isinstance(node, ast.Name) and node.id in known:
            yield known[node.id]
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            full = f"{modules.get(node.value.id)}.{node.attr}"
            if full in kernels():
                yield full


def kinds_of(made):
    return made.__annotations__.values()


def test_kernels_are_found():
    assert len(kernels()) > 300
    assert {"asperity.kernels.dense.copy", "asperity.slider.shooting.shoot"} <= {*kernels()}
    entries = called_from_python()
    assert {"asperity.slider.shooting.shoot", "asperity.contact.motion.march.march"} <= entries
    assert "asperity.slider.shooting._newton" not in entries


@pytest.mark.parametrize(
    "line",
    [
        "np.linalg.solve(a, b)",
        "a[0] = b @ c",
        "np.dot(a, b, out)",
        "raise ValueError",
        "assert a",
        "a[:] = b",
        "a[0, 1:] += b",
        "a[...] = b",
        "a[0] = 1.0, 2.0",
        "b = a[:6].reshape(2, 3)",
        "b = a.copy()",
        "b = a.T",
        "b = [a, a]",
    ],
)
def test_what_needs_python_is_seen(line):
    (kernel,) = ast.parse(f"@kernel\ndef one(a, b):\n    {line}").body
    assert is_kernel(kernel)
    assert [*refused(kernel)]


def test_kernels_need_nothing_of_python():
    found = [
        f"{name}:{line}: {why}" for name, node in kernels().items() for line, why in refused(node)
    ]
    assert found == []


def test_only_kernels_that_are_named_make_arrays():
    making = {name for name, node in kernels().items() if of_numpy(node) & ALLOCATING}
    assert making == ROOM_OF_THEIR_OWN


def test_of_numpy_kernels_call_only_what_makes_arrays_and_what_is_named():
    """Any other, of an array, would make one."""
    called = {(name, one) for name, node in kernels().items() for one in of_numpy(node)}
    assert {
        (name, one) for name, one in called if one not in ALLOCATING | NO_FUNCTIONS
    } == OF_NUMBERS


@pytest.mark.slow
@pytest.mark.skipif(
    not load.is_for_here(makers.MADE_HERE, FEATURES), reason="kernels are Numba's on this machine"
)
def test_no_machine_code_asks_for_memory_but_that_of_kernels_that_are_named():
    """Also an expression of arrays makes one: what asks for memory is in the machine code.

    Where something that is called has room of its own, it hides others; most kernels are called by
    an entry that has nothing such.
    """
    kept.make(listed().entries)
    asking, having, seen = set(), set(), set()
    for entry in listed().entries:
        called = called_by(entry.name)
        if called & ROOM_OF_THEIR_OWN:
            having.add(entry.name)
        else:
            seen |= called
        folder = kernel_folder.kernels() / keys.key(entry)
        # An object's table of what it needs from elsewhere is words that end with a zero.
        if b"malloc\0" in (folder / table.OBJECTS[0]).read_bytes():
            asking.add(entry.name)
    assert asking == having
    assert len(seen) > 250


def test_what_python_calls_returns_numbers():
    for name in called_from_python():
        space = vars(importlib.import_module(name.rsplit(".", 1)[0]))
        for node in ast.walk(kernels()[name]):
            if isinstance(node, ast.Return) and isinstance(node.value, ast.Call):
                made = space.get(ast.unparse(node.value.func))
                if hasattr(made, "_fields"):
                    kinds = {getattr(kind, "__forward_arg__", kind) for kind in kinds_of(made)}
                    assert kinds <= NUMBERS, (name, made)
            if isinstance(node, ast.Return) and isinstance(node.value, ast.Tuple):
                assert not any(isinstance(part, ast.Tuple) for part in node.value.elts), name


@pytest.mark.usefixtures("plain_kernels")
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(0, 40))
def test_a_product_is_that_of_numpy(seed, rows, columns):
    rng = np.random.default_rng(seed)
    a, x, out = rng.normal(size=(rows, columns)), rng.normal(size=rows), np.full(columns, np.nan)
    multiply(a, x, out)
    assert np.abs(out - x @ a).max(initial=0.0) <= 1e-14 * rows * np.abs(x).max() * 10.0


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("shape", [(0,), (5,), (3, 4)])
def test_a_copy_is_that_of_the_original(shape):
    source, target = np.random.default_rng(1).normal(size=shape), np.full(shape, np.nan)
    copy(source, target)
    assert np.array_equal(source, target)
