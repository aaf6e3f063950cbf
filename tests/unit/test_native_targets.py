"""Kernels as they are made for processors with AVX-512 and for others."""

import itertools
import os
import subprocess
import sys

import pytest
from apparatus import called

from asperity.casefile import read_case
from asperity.friction.dahl import SPLIT, UNSPLIT, VECTOR
from asperity.kernels.native import load, target
from asperity.slider import batch_kernels, solve
from asperity.slider.batch import solve_many
from asperity.slider.kernels import march_stretches
from asperity.slider.model import Model
from asperity.slider.shooting import shoot
from asperity.slider.tables import TABLES
from asperity.slider.two_phase import march_two_phase

WITHOUT = os.environ | {"ASPERITY_NATIVE": "0"}

BOTH = """
import sys
from pathlib import Path
from asperity.kernels.building import lean, link, making
from asperity.kernels.native.entries import for_all_processors
making.began()
made = {}
for entry in for_all_processors():
    if entry.name == sys.argv[2]:
        one = lean.make(making.kernel(entry), entry.arguments, link.symbol(entry), entry.target)
        made.setdefault(entry.target.processor, []).append((entry, one))
for processor, entries in made.items():
    folder = Path(sys.argv[1]) / processor
    folder.mkdir()
    link.write(folder, entries, link.support())
"""


FITS = pytest.mark.skipif(
    not set(target.WIDE.features) <= target.features(), reason="this processor has no AVX-512"
)


def for_both(kernel, folder):
    """A kernel as it is made for AVX-512, and for other processors."""
    name = f"{kernel.__module__}.{kernel.__qualname__}"
    subprocess.run([sys.executable, "-c", BOTH, folder, name], env=WITHOUT, check=True)
    ways = target.targets(kernel.__module__)
    assert len(ways) == 2
    return [load.from_folder(folder / one.processor).entry(name) for one in ways]


@pytest.mark.slow
@FITS
def test_lanes_in_wide_registers_are_the_same_to_the_bit(tmp_path):
    wide, plain = for_both(batch_kernels.march_batch, tmp_path)
    settings = "solve.method=march", "vibration.start=20 ms", "solve.duration=50 ms"
    models = [
        Model.from_case(
            read_case(
                "table-4.4",
                TABLES,
                [f"friction.law={law}", f"vibration.velocity_ratio={k}", *settings],
            )
        )
        for law in ("vector", "split", "unsplit")
        for k in (0.5, 1.5, 4.0)
    ]
    with called.recorded() as calls:
        solve_many(models)
    lanes = [
        given
        for kernel, given in itertools.chain(*calls.values())
        if kernel.__name__ == "march_batch"
    ]
    assert {given[8] for given in lanes} == {VECTOR, SPLIT, UNSPLIT}
    for given in lanes:
        first, second = called.copied(given), called.copied(given)
        assert (wide(first), plain(second)) == (None, None)
        assert called.words(first) == called.words(second) != called.words(given)


@pytest.mark.slow
@FITS
@pytest.mark.parametrize(
    ("kernel", "settings"),
    [
        (march_stretches, ["vibration.start=5 ms", "solve.duration=30 ms"]),
        (march_two_phase, ["solve.scheme=two-phase", "solve.duration=0.3 s"]),
        (shoot, ["solve.method=periodic"]),
    ],
)
def test_a_body_in_more_registers_is_the_same_to_the_bit(kernel, settings, tmp_path):
    wide, plain = for_both(kernel, tmp_path)
    with called.recorded() as calls:
        solve(Model.from_case(read_case("table-4.3", TABLES, settings)), history=False)
    found = [given for each, given in itertools.chain(*calls.values()) if each is kernel]
    assert found
    for given in found:
        first, second = called.copied(given), called.copied(given)
        answers = wide(first), plain(second)
        assert NotImplemented not in answers
        assert called.words(answers[0]) == called.words(answers[1])
        assert called.words(first) == called.words(second) != called.words(given)


APART = """
from asperity.kernels.building import lean, link, making
from asperity.kernels.native.entries import listed
optimise = lean._optimise
def told(module, *target, **options):
    optimise(module, *target, **options)
    loops = [each for each in module.functions if "5block" in each.name]
    print(len(loops))
lean._optimise = told
making.began()
(entry,) = listed().named("asperity.slider.batch_kernels.march_batch")
lean.make(making.kernel(entry), entry.arguments, link.symbol(entry), entry.target)
"""


@pytest.mark.slow
def test_each_loop_over_lanes_has_its_registers_for_itself():
    functions = subprocess.run(
        [sys.executable, "-c", APART], env=WITHOUT, check=True, capture_output=True, text=True
    ).stdout
    # One of a law and a stage.
    assert int(functions) == 9
