"""Compile what the tests use, once, on all cores and before they start.

``python tests/warm.py`` does it by itself. Kernels are kept on disk under what they follow from, so
that nothing is done where it was done before.
"""

import concurrent.futures
import hashlib
import multiprocessing
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "answers"))

# Command lines that call the kernels of a room, in the way of `answers/commands.toml`: one process
# each. The dearest to compile stands first.
ROOMS = (
    (
        "drive drive-screw --static --set drive.teeth=1 --set drive.phases=1",
        "drive drive-screw --set drive.model=teeth --set drive.teeth=1 --set drive.window=1 "
        "--set drive.protocol=window --set vibration.frequency='20 kHz'",
    ),
    (
        "slide table-4.3 --set solve.method=periodic --out OUT",
        "slide table-4.4 LUGRE --set solve.method=periodic",
        "static table-4.3",
        "static normal-pin",
    ),
    (
        "slide table-4.3 EARLY --out OUT",
        "slide table-4.3 EARLY --set solve.scheme=two-phase",
        "slide table-4.1-L1",
    ),
    ("sweep table-4.3 --over vibration.velocity_ratio=1,6 EARLY",),
    ("slide table-4.3 --set solve.method=homogenised --out OUT",),
    ("slide normal-pin", "slide normal-pin EARLY --set solve.method=march"),
    ("block block-longitudinal BLOCK", "block block-longitudinal BLOCK --set contact.normal=hard"),
    ("flank gearset-3b --density coarse",),
    ("drive drive-screw TEETH --out OUT",),
    ("rig run rig-final RIG --out OUT", "rig reduce RECORDING"),
)


def compile_kernels(processes):
    """Compile what is not compiled yet, in so many processes."""
    from asperity.folders import cache_folder

    folder = cache_folder("kernels")
    if folder is None:
        return
    done = folder / f"compiled-{_key()}"
    if done.exists():
        return
    spawn = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(processes, mp_context=spawn) as pool:
        list(pool.map(_run, ROOMS))
    done.touch()


def _key():
    """What all kernels of the package follow from."""
    import asperity
    from asperity.compiled import kernel_key

    package = Path(asperity.__file__).parent
    keys = []
    for path in sorted(package.rglob("*.py")):
        if "@kernel" in path.read_text("utf-8"):
            place = path.relative_to(package.parent).with_suffix("")
            keys.append(kernel_key(".".join(place.parts), path))
    return hashlib.sha256("".join(keys).encode()).hexdigest()[:16]


def _run(lines):
    from observe import observe

    # The processes have the cores among themselves.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    for line in lines:
        with tempfile.TemporaryDirectory() as folder:
            assert observe(line, Path(folder))["code"] == 0, line


if __name__ == "__main__":
    compile_kernels(os.cpu_count() or 1)
