"""Recording against a plain write, and the simulated rig against real time.

Run it with ``make bench``. Recorded are 8 channels of 500 kS/s in blocks of half a second, as a run
does, each flushed; a plain write hands the same counts to the operating system. What one more block
takes is counted, without what making a file takes, in pairs of both ways one after the other; the
median of the pairs' ratios is told, since others use the disk and the cores: of processor time, and
beside it by the clock.

A file of six cells is run at each of three speeds, at 20 kS/s on eight channels, by the whole
procedure: interlocks, journal, recording, compression. The rest of the thesis's thirty files differ
in nothing that takes time. Files are compressed and noise is drawn in threads beside;
``times_real_time`` counts the busier of the main thread and all others: what two cores do that
nobody else uses. ``times_real_time_by_the_clock`` is what they did.
"""

import tempfile
import time
from pathlib import Path

import numpy as np
from _common import finish

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.tribometer.procedure.study import answer, prepare
from asperity.tribometer.recording import Recorder, Source
from asperity.tribometer.signals import SIGNALS

FILES = (
    'plan.modes=["transverse"]', 'plan.lubricants=["oil"]', 'plan.waveforms=["sine"]',
    "plan.excluded=[]", "plan.repeats=1",
)  # fmt: skip
BRIEF = ('plan.before="1 s"', 'plan.shaken="1 s"', 'plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
LEAST = {"times_real_time": 50.0, "of_a_plain_write": 1.0 / 3.0, "times_8_x_500_kS_per_s": 10.0}
RATE, CHANNELS, BLOCK, BLOCKS = 500e3, 8, 0.5, (10, 50)
PAIRS = 9


def written(path, blocks, counts):
    """Write blocks plainly."""
    with path.open("wb", buffering=0) as file:
        for _ in range(blocks):
            file.write(counts.data)


def recorded(path, blocks, counts):
    """Record blocks."""
    sources = [Source(name, "V", 1e-3) for name in list(SIGNALS)[:CHANNELS]]
    recorder = Recorder(path, sources, 1.0 / RATE, block=len(counts))
    for block in range(blocks):
        recorder.append(counts, BLOCK * (block + 1))
    recorder.close(compress=False)


def seconds_a_block(way, folder, counts):
    """Return what one more block takes, of the processor and by the clock."""
    few, many = (_seconds(way, folder / "run", blocks, counts) for blocks in BLOCKS)
    return (many - few) / (BLOCKS[1] - BLOCKS[0])


def _seconds(way, path, blocks, counts):
    began = time.process_time(), time.perf_counter()
    way(path, blocks, counts)
    return np.array((time.process_time() - began[0], time.perf_counter() - began[1]))


def recording():
    """Return how fast a recording is."""
    rng = np.random.default_rng(0)
    counts = rng.integers(-3000, 3000, (round(BLOCK * RATE), CHANNELS), dtype=np.int16)
    with tempfile.TemporaryDirectory() as folder:
        pairs = np.array([
            [seconds_a_block(way, Path(folder), counts) for way in (written, recorded)]
            for _ in range(PAIRS)
        ])  # fmt: skip
    plain, kept = np.median(pairs, axis=0)
    share, share_by_the_clock = np.median(pairs[:, 0] / pairs[:, 1], axis=0)
    return {
        "plain_MB_per_s": 1e-6 * counts.nbytes / plain[0],
        "recorded_MB_per_s": 1e-6 * counts.nbytes / kept[0],
        "of_a_plain_write": share,
        "of_a_plain_write_by_the_clock": share_by_the_clock,
        "times_8_x_500_kS_per_s": BLOCK / kept[1],
    }


def done(*settings):
    """Run a plan; returns recorded seconds, and those of the busier core and of the clock."""
    case = read_case("rig-final", case_tables(), settings)
    with tempfile.TemporaryDirectory() as folder:
        problem = prepare(case)
        began = time.thread_time(), time.process_time(), time.monotonic()
        found = answer(problem, Run(folder=Path(folder)))
        main = time.thread_time() - began[0]
        beside = time.process_time() - began[1] - main
        clock = time.monotonic() - began[2]
    assert found.failure is None
    plan = case["plan"]
    recorded = found.cells_done * (plan.before + plan.shaken + plan.idle)
    return recorded, max(main, beside), clock


def main():
    """Run all and print one line a figure."""
    done(*FILES, *BRIEF)  # Kernels are compiled before.
    recorded, busy, clock = done(*FILES)
    report = {
        "recording": recording(),
        "simulated rig": {
            "recorded_s": recorded,
            "busier_core_s": busy,
            "clock_s": clock,
            "times_real_time": recorded / busy,
            "times_real_time_by_the_clock": recorded / clock,
        },
    }
    finish(report, least=LEAST)


if __name__ == "__main__":
    main()
