"""Make the bytecode of the tests and of the package on all cores, before workers start.

``python tests/bytecode.py`` does it: of tests as pytest has them, their assertions rewritten, and
beside it the constants that Hypothesis reads of each module of the package. Each of pytest's
workers would make all of it by itself, at the same time. What goes wrong here they make good.
"""

import concurrent.futures
import contextlib
import os
import py_compile
from pathlib import Path
from types import ModuleType

HERE = Path(__file__).parent


def rewrite(path):
    """Leave a file of tests as pytest runs it, where pytest looks for it."""
    from _pytest.assertion import rewrite as pytest_rewrites

    folder = pytest_rewrites.get_cache_dir(path)
    folder.mkdir(exist_ok=True)
    digest, code = pytest_rewrites._rewrite_test(path, None)
    compiled = folder / (path.name[:-3] + pytest_rewrites.PYC_TAIL)
    pytest_rewrites._write_pyc(None, code, digest, compiled)
    return compiled


def compile_module(path):
    """Compile a module and read its constants, which Hypothesis keeps of what is no test."""
    from hypothesis.internal.constants_ast import constants_from_module

    py_compile.compile(str(path), doraise=True)
    if not path.is_relative_to(HERE):
        module = ModuleType(path.stem)
        module.__file__ = str(path)
        constants_from_module(module)


def make(path):
    """Make what is to be made of a file."""
    is_test = path.name.startswith("test_") or path.name == "conftest.py"
    # Private names of others: without them it is done later.
    with contextlib.suppress(Exception):
        (rewrite if is_test else compile_module)(path)


def main():
    files = [*HERE.rglob("*.py"), *(HERE.parent / "src").rglob("*.py")]
    files.sort(key=lambda path: -path.stat().st_size)
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(make, files, chunksize=4))


if __name__ == "__main__":
    main()
