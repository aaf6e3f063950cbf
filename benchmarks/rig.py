"""Recording against a plain write, and the simulated rig against real time.

Run it with ``make bench``. Recorded are 8 channels of 500 kS/s in blocks of half a second, as a run
does, each flushed; a plain write hands the same counts to the operating system. What one more block
takes is counted, without what making a file takes, in pairs of both ways one after the other; the
median of the pairs' ratios is told, since others use the disk and the cores: of processor time, and
beside it by the clock. ``while_it_streams`` is what a block takes as it comes; once a recording is
closed its blocks are joined to a file, which reads them and writes them again:
``with_its_file``, and how many times the stream's rate both keep together.

Beside the guardian the same stream is watched and recorded as in a run: interlocks with vibration
and motors on, preview, a heartbeat with every poll to a guardian in its own process, which reads
the supplies. Samples are handed over as fast as they are taken, so that what is told is how many
times the stream's own rate one core keeps while it streams: blocks are joined to a file once it
has ended, which `recording` counts and this does not.

A file of six cells is run at each of three speeds, at 20 kS/s on eight channels, by the whole
procedure: interlocks, journal, recording, compression. The rest of the thesis's thirty files differ
in nothing that takes time. Files are compressed and noise is drawn in threads beside;
``times_real_time`` counts the busier of the main thread and all others: what two cores do that
nobody else uses. ``times_real_time_by_the_clock`` is what they did.
"""

import dataclasses
import tempfile
import time
from pathlib import Path

import numpy as np
from _common import finish

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.tribometer.guardian.backends import open_bench
from asperity.tribometer.instruments.protocols import Poll
from asperity.tribometer.preview import Preview, units_of
from asperity.tribometer.procedure.interlock import Expected, Interlock
from asperity.tribometer.procedure.logger import Logger
from asperity.tribometer.procedure.study import answer, prepare
from asperity.tribometer.recording import Recorder, Source
from asperity.tribometer.signals import SIGNALS

FILES = (
    'plan.modes=["transverse"]', 'plan.lubricants=["oil"]', 'plan.waveforms=["sine"]',
    "plan.excluded=[]", "plan.repeats=1",
)  # fmt: skip
BRIEF = ('plan.before="1 s"', 'plan.shaken="1 s"', 'plan.idle="0 s"', 'plan.frequencies=["750 Hz"]')
LEAST = {
    "times_real_time": 50.0, "while_it_streams_of_a_plain_write": 1.0 / 3.0,
    "times_8_x_500_kS_per_s": 10.0, "times_8_x_500_kS_per_s_guarded": 10.0,
}  # fmt: skip
RATE, CHANNELS, BLOCK, BLOCKS = 500e3, 8, 0.5, (10, 50)
PAIRS = 9


def written(path, blocks, counts):
    """Write blocks plainly."""
    with path.open("wb", buffering=0) as file:
        for _ in range(blocks):
            file.write(counts.data)


def streamed(path, blocks, counts):
    """Record blocks, and leave them as they came."""
    _recorder(path, blocks, counts)


def recorded(path, blocks, counts):
    """Record blocks, and join them to a file."""
    _recorder(path, blocks, counts).close(compress=False)


def _recorder(path, blocks, counts):
    sources = [Source(name, "V", 1e-3) for name in list(SIGNALS)[:CHANNELS]]
    recorder = Recorder(path, sources, 1.0 / RATE, block=len(counts))
    for block in range(blocks):
        recorder.append(counts, BLOCK * (block + 1))
    return recorder


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
            [seconds_a_block(way, Path(folder), counts) for way in (written, streamed, recorded)]
            for _ in range(PAIRS)
        ])  # fmt: skip
    plain, came, kept = np.median(pairs, axis=0)
    shares = [np.median(pairs[:, 0] / pairs[:, way], axis=0) for way in (1, 2)]
    return {
        "plain_MB_per_s": 1e-6 * counts.nbytes / plain[0],
        "streamed_MB_per_s": 1e-6 * counts.nbytes / came[0],
        "recorded_MB_per_s": 1e-6 * counts.nbytes / kept[0],
        "while_it_streams_of_a_plain_write": shares[0][0],
        "the_same_by_the_clock": shares[0][1],
        "with_its_file_of_a_plain_write": shares[1][0],
        "with_its_file_by_the_clock": shares[1][1],
        "times_8_x_500_kS_per_s": BLOCK / kept[0],
        "times_it_by_the_clock": BLOCK / kept[1],
    }


class Handed:
    """An oscilloscope that has always sampled already, in a time of its own."""

    by_hand = False
    name = "samples that are there"

    def __init__(self, inputs, counts):
        self.inputs, self._counts = inputs, counts
        self._now, self._given, self._begun = 0.0, 0, 0.0

    def identify(self):
        return self.name

    def now(self):
        return self._now

    def sleep(self, seconds):
        self._now += seconds

    def start(self, interval):
        self._interval, self._given, self._begun = interval, 0, self._now
        return interval

    def poll(self):
        count = round((self._now - self._begun) / self._interval) - self._given
        self._given += count
        over = (False,) * len(self.inputs)
        return Poll(tuple(one[:count] for one in self._counts), self._now, over)

    def stop(self):
        pass

    close = safe = stop


def guarded():
    """Return how many times the rate of the stream is kept beside a guardian."""
    case = read_case("rig-final", case_tables(), FILES)
    rng, frequency = np.random.default_rng(0), 750.0
    with tempfile.TemporaryDirectory() as folder:
        bench = open_bench(case, "sim")
        try:
            inputs = bench.scope.inputs
            interlock = Interlock.from_case(case, inputs)
            counts = rng.integers(-30, 30, (len(inputs), round(BLOCK * RATE)), dtype=np.int16)
            place = [one.signal for one in inputs].index("drive_voltage")
            times = np.arange(counts.shape[1]) / RATE
            volts = interlock.swing * np.sin(2.0 * np.pi * frequency * times)
            counts[place] = (volts - interlock.offsets[place]) / interlock.gains[place]
            scope = Handed(inputs, counts)
            bench = dataclasses.replace(bench, scope=scope, clock=scope)
            for motor in bench.motors.values():
                motor.set(1.0)
                motor.on()
            bench.vibration.configure("sine", frequency)
            bench.vibration.on()
            preview = Preview(
                Path(folder), units_of([one.signal for one in inputs]), simulated=True
            )

            def watched(blocks):
                path = Path(folder, "run.nc")
                logger = Logger(bench, interlock, 1.0 / RATE, path, "{}", lambda: None, preview)
                logger.expect(Expected(frequency, "sine", dict.fromkeys(bench.motors, 1.0)))
                began = time.process_time()
                logger.watch(blocks * BLOCK)
                took = time.process_time() - began
                logger.close()
                return took

            watched(2)
            few, many = (np.array([watched(blocks) for _ in range(3)]) for blocks in BLOCKS)
            assert not bench.safe()
        finally:
            bench.close()
    seconds = BLOCK * (BLOCKS[1] - BLOCKS[0]) / (np.median(many) - np.median(few))
    return {"channels": len(inputs), "times_8_x_500_kS_per_s_guarded": seconds * len(inputs) / 8}


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
        "beside the guardian": guarded(),
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
