"""What a command answers by the library of kernels it answers by Numba's way, bit for bit."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from apparatus import called
from compare import LEFT_OUT
from observe import command_lines

from asperity.kernels.native import entries, kept, load
from asperity.kernels.native.target import FEATURES

ANSWERS = Path(called.__file__).parents[1] / "answers"

# Of arrays in files all bits count, and the place of each.
OBSERVE = """
import hashlib, json, sys
from pathlib import Path
import numpy as np
import observe

def bits(array):
    array = np.asarray(array)
    held = array.tobytes() if array.dtype.kind in "biuf" else repr(array.tolist()).encode()
    digest = hashlib.sha256(held).hexdigest()
    return {"kind": str(array.dtype), "shape": list(array.shape), "bits": digest}

if __name__ == "__main__":
    observe.digest = bits
    line, folder = sys.argv[1], Path(sys.argv[2])
    seen = observe.observe(line, folder)
    seen["numba"] = "numba" in sys.modules
    (folder / "seen.json").write_text(json.dumps(seen), "utf-8")
"""


def seen(line, native, folder):
    """What a process of its own answers, and whether it has loaded Numba."""
    folder.mkdir()
    environment = os.environ | {
        "ASPERITY_NATIVE": native,
        "PYTHONPATH": os.pathsep.join(filter(None, [str(ANSWERS), os.environ.get("PYTHONPATH")])),
        # Sums are added up in the same order.
        "OPENBLAS_NUM_THREADS": "1",
    }
    subprocess.run([sys.executable, "-c", OBSERVE, line, folder], env=environment, check=True)
    return json.loads((folder / "seen.json").read_text("utf-8"))


def as_told(answer):
    """JSON without what takes its time or has its place: texts of numbers, so that -0.0 is not 0.0.

    Floats are written so that another text is another number.
    """
    if isinstance(answer, dict):
        return {key: as_told(each) for key, each in answer.items() if key not in LEFT_OUT}
    return [*map(as_told, answer)] if isinstance(answer, list) else repr(answer)


def places(one, other, at=""):
    """Where two answers differ."""
    if isinstance(one, dict) and isinstance(other, dict):
        for key in sorted(one.keys() | other.keys()):
            yield from places(one.get(key), other.get(key), f"{at}.{key}")
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        for number, pair in enumerate(zip(one, other, strict=True)):
            yield from places(*pair, f"{at}[{number}]")
    elif one != other:
        yield f"{at}: {one} by the library, {other} by Numba"


def test_what_differs_in_a_bit_is_found():
    one = {"json": {"ratio": 0.1, "seconds": 1.0, "rows": [1.0, -0.0]}}
    other = {"json": {"ratio": 0.1, "seconds": 2.0, "rows": [1.0, 0.0]}}
    assert [*places(as_told(one), as_told(one))] == []
    (found,) = places(as_told(one), as_told(other))
    assert found == ".json.rows[1]: -0.0 by the library, 0.0 by Numba"
    other["json"] = {"ratio": 0.1 + 2.0**-56, "rows": [1.0, -0.0], "more": None}
    assert len([*places(as_told(one), as_told(other))]) == 2


def _compiled(line):
    """About how long Numba compiles for a command line, s."""
    return sum(entries.listed().entries[number].seconds for number in entries.listed().lines[line])


# The cheapest first, of which the smallest share is.
CALLING = sorted(
    filter(_compiled, (*command_lines("ordinary"), *command_lines("slow"))), key=_compiled
)

# These have workers call all their kernels, and Numba is loaded there.
BY_WORKERS = "thesis", "relief"


@pytest.mark.slow
@pytest.mark.campaign
@pytest.mark.skipif(
    not load.is_for_here(kept._MADE_HERE, FEATURES), reason="kernels are Numba's on this machine"
)
@pytest.mark.parametrize("line", CALLING, ids=CALLING)
def test_both_ways_answer_the_same_to_the_bit(line, tmp_path):
    by_library, by_numba = (seen(line, way, tmp_path / f"way-{way}") for way in ("1", "0"))
    # They were two.
    loaded = by_library.pop("numba"), by_numba.pop("numba")
    assert loaded == (False, not line.startswith(BY_WORKERS))
    found = [*places(as_told(by_library), as_told(by_numba))]
    assert not found, "\n".join([line, *found[:20], f"{len(found)} differences"])
