"""Simulated rigs for tests: small plans, faults, and runs that are killed."""

import importlib
import json
import os
import signal
import sys
import traceback

import numpy as np
import pytest

from apparatus.fake_picoscope import FakeDriver
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.runs import Run
from asperity.tribometer.instruments.inputs import inputs_of, lines_of
from asperity.tribometer.instruments.protocols import FULL_SCALE, InstrumentError, Poll, Reading
from asperity.tribometer.instruments.sim import SimulatedClock, simulated_bench
from asperity.tribometer.procedure import study
from asperity.tribometer.twin.plant import Plant

SMALL = (
    'plan.modes=["transverse"]', 'plan.lubricants=["oil"]', "plan.excluded=[]",
    'plan.waveforms=["sine"]', 'plan.steel_supplies=["1 V"]', "plan.repeats=1",
    'plan.frequencies=["250 Hz","750 Hz"]', 'plan.before="1 s"', 'plan.shaken="1 s"',
    'plan.idle="0.5 s"', 'plan.sample_rate="4 kHz"',
)  # fmt: skip
BLOCK = 0.1


def small_case(*settings):
    """Return the final rig with a plan of two cells of 2.5 s."""
    return read_case("rig-final", case_tables(), (*SMALL, *settings))


def made_bench(case):
    """Return bench and rig of a case, all simulated."""
    channels = case["channels"]
    inputs = inputs_of(channels, case["sonotrode"])
    return simulated_bench(Plant.from_case(case), inputs, lines_of(channels, inputs))


def run(case, folder, *, bench=None, resume=False, acknowledge=""):
    """Run a plan, on a bench of one's own if given; returns the answer."""
    folder.mkdir(exist_ok=True)
    problem = study.prepare(case, "sim", "", resume, acknowledge)
    work = Run(folder=folder, stem="rig-run")
    if bench is None:
        # All in this process; `apparatus.benches` runs it beside a guardian.
        bench = made_bench(case)[0]
    return study._run(problem, bench, work, folder)


def picoscope_on(rig, monkeypatch):
    """Return a PicoScope whose library in C is a fake, behind which a simulated rig is measured."""
    library = pytest.importorskip("picosdk.library", reason="picosdk (extra daq) is missing")
    from asperity.tribometer.instruments.picoscope import LETTERS, PicoScope

    class Driver(FakeDriver):
        def _RunStreaming(self, handle, interval, *rest):
            super()._RunStreaming(handle, interval, *rest)
            rig.begin(interval._obj.value * 1e-9)

        def _GetStreamingLatestValues(self, handle, ready, parameter):
            counts = rig.taken()
            if not len(counts):
                return 0x27
            for column, given in enumerate(rig.inputs):
                self.buffers[LETTERS.index(given.channel)][: len(counts)] = counts[:, column]
            ready(handle.value, len(counts), 0, 0, 0, 0, 0, parameter)
            return 0

        def _Stop(self, handle):
            super()._Stop(handle)
            rig.end()

    fake = Driver()
    monkeypatch.setattr(library.Library, "_load", lambda self: fake)
    monkeypatch.delitem(sys.modules, "picosdk.ps4000a", raising=False)
    # Not left behind for those that come later, who would meet this rig.
    monkeypatch.setitem(sys.modules, "picosdk.ps4000a", importlib.import_module("picosdk.ps4000a"))
    return PicoScope(rig.inputs, clock=SimulatedClock(rig))


def serial_controller(rig=None):
    """Return a controller on a pseudo-terminal that moves a rig, and what is at its other end."""
    from apparatus.pty_controller import DIALECT, PtyController
    from asperity.tribometer.instruments.parameters import Controller
    from asperity.tribometer.instruments.serial_vibration import SerialVibration

    class Moving(PtyController):
        breaks = ""

        def break_when_it_vibrates(self, fault):
            self.breaks = fault

        def _answer(self, line):
            said = super()._answer(line)
            if rig is None:
                return said
            rig.change()
            rig.waveform = "triangle" if self.waveform == "TRI" else "sine"
            rig.frequency = self.frequency
            if self.vibrates != ("vibration" in rig.on):
                rig.on ^= {"vibration"}
            if line == "HERE" and self.vibrates and self.breaks:
                if self.breaks == "pulled":
                    self.pull()
                self.fault = "silent"
                self.vibrates = True
                self._answer = lambda line: "OK"
            return said

    fake = Moving()
    return SerialVibration(Controller(port=fake.port, timeout="1 s", **DIALECT)), fake


def cells(folder):
    """What the journal tells of the cells, without where they stand in a file."""
    return cells_of(journal(folder))


def cells_of(lines):
    """The same, of its lines."""
    return [
        (line["cell"], line["crc32"], line["level_before"], line["level_with"])
        for line in lines if line["kind"] == "done" and "cell" in line
    ]  # fmt: skip


def journal(folder):
    """The lines of a journal."""
    return [json.loads(row) for row in (folder / "journal.jsonl").read_text().splitlines()]


def whole_lines(folder):
    """The lines of a journal that may just be written, or of which the last was."""
    path = folder / "journal.jsonl"
    rows = path.read_bytes().split(b"\n")[:-1] if path.exists() else []
    return list(map(json.loads, rows))


class FaultyScope:
    """An oscilloscope behind which something is done to the samples once vibration is on."""

    def __init__(self, scope, rig, change, begins):
        self._scope, self._rig, self._change, self._begins = scope, rig, change, begins
        self.inputs, self.name = scope.inputs, scope.name
        self.since = None
        self.held = {}

    def __getattr__(self, name):
        return getattr(self._scope, name)

    def poll(self):
        poll = self._scope.poll()
        if self.since is None and self._begins(self._rig):
            self.since = self._rig.now
        if self.since is None:
            return poll
        counts = [np.array(one) for one in poll.counts]
        over = self._change(self, counts)
        return Poll(tuple(counts), poll.clock, poll.overrange if over is None else over)

    def column(self, signal):
        return next(n for n, one in enumerate(self.inputs) if one.signal == signal)


def losing(signal, samples=200):
    """Samples of a channel are lost, once."""

    def change(scope, counts):
        if not scope.held.get("lost"):
            scope.held["lost"] = True
            place = scope.column(signal)
            counts[place] = counts[place][samples:]

    return change


def late(signal):
    """Samples of a channel come no more."""

    def change(scope, counts):
        counts[scope.column(signal)] = counts[0][:0]

    return change


def silent(scope, counts):
    """No samples come at all."""
    for place in range(len(counts)):
        counts[place] = counts[place][:0]


def at_limit(signal):
    """A sensor is at its limit."""

    def change(scope, counts):
        counts[scope.column(signal)][:] = FULL_SCALE

    return change


def scaled(signal, factor):
    """A signal is a multiple of what it was."""

    def change(scope, counts):
        place = scope.column(signal)
        counts[place][:] = np.clip(factor * counts[place].astype(float), -32000, 32000)

    return change


def exchanged(first, second):
    """Two cables are exchanged."""

    def change(scope, counts):
        a, b = scope.column(first), scope.column(second)
        counts[a], counts[b] = counts[b], counts[a]

    return change


class Deaf:
    """An instrument whose line breaks once the vibration is on; it does nothing any more."""

    def __init__(self, instrument, rig, kind):
        self._instrument, self._rig, self._kind = instrument, rig, kind
        self.name, self.since = instrument.name, None

    def _heard(self):
        if self.since is None and self._rig.vibrates:
            self.since = self._rig.now
        if self.since is not None:
            raise InstrumentError(f"{self.name} is gone", kind=self._kind)

    def __getattr__(self, name):
        found = getattr(self._instrument, name)
        if not callable(found):
            return found

        def called(*arguments):
            self._heard()
            return found(*arguments)

        return called


class WrongSupply:
    """A supply that gives something else than it was told."""

    def __init__(self, supply, rig):
        self._supply, self._rig, self.name, self.since = supply, rig, supply.name, None

    def __getattr__(self, name):
        return getattr(self._supply, name)

    def reading(self):
        given = self._supply.reading()
        if self._rig.vibrates:
            self.since = self._rig.now if self.since is None else self.since
            return Reading(0.5 * given.voltage, given.current)
        return given


class StuckSupply:
    """A supply that takes no order to be off."""

    def __init__(self, supply):
        self._supply, self.name = supply, supply.name

    def __getattr__(self, name):
        return getattr(self._supply, name)

    def off(self):
        pass

    safe = off


def in_a_child(act):
    """Do something in a process of its own; returns whether it came to its end and was true."""
    child = os.fork()
    if child:
        _, status = os.waitpid(child, 0)
        return os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0
    try:
        os._exit(0 if act() else 1)
    except BaseException:
        traceback.print_exc()
        os._exit(2)


def killed_run(case, folder, seconds, *, resume):
    """Run in a process of its own that is ended at some moment; returns whether it was done."""

    def killed():
        # Nothing hears this signal: it ends the process wherever it stands, as kill -9 does. By
        # the process's own time, so that a busy machine ends it no earlier.
        signal.signal(signal.SIGPROF, signal.SIG_DFL)
        signal.setitimer(signal.ITIMER_PROF, seconds)
        run(case, folder, resume=resume)
        return True

    return in_a_child(killed)


def run_on_a_full_disk(case, folder, most):
    """Run where no file may have more bytes; returns whether everything is off then."""
    import resource

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))
    bench, rig = made_bench(case)
    answer = run(case, folder, bench=bench)
    ended = answer.failure
    latched = ended is not None and (ended.exit_code, getattr(ended, "kind", "")) == (3, "disk")
    return latched and not rig.on & {"steel", "bronze", "vibration"}
