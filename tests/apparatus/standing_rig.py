"""A simulated rig that stands on while procedures and guardians come and go, with faults."""

import contextlib
import dataclasses
import importlib
import json
import os
import select
import signal
import sys
import threading
import time

import numpy as np

from apparatus import rigs
from apparatus.forked_guardian import OwnTime, forked_guardians
from asperity.errors import AsperityError
from asperity.runs import Run
from asperity.tribometer.guardian import backends
from asperity.tribometer.guardian.rig import RigLine, RigServer, objects_of
from asperity.tribometer.instruments.protocols import InstrumentError, Reading
from asperity.tribometer.procedure import study

_STUCK = 7  # counts
PATIENT = 60.0  # s that a busy machine may take for what is to come


def _in_a_child(act):
    """Do something in a process of its own, which ends with it; returns its number."""
    child = os.fork()
    if child:
        return child
    code = 70
    try:
        code = act()
    except BaseException as error:
        print(f"{type(error).__name__}: {error}", file=sys.stderr, flush=True)
    finally:
        os._exit(code)


class _Server(RigServer):
    """Asked for a device, it answers as a device with a fault does."""

    def __init__(self, bench, rig):
        super().__init__(objects_of(bench))
        self._rig = rig
        self._faults, self._held, self._mended = {}, False, threading.Event()
        self._doing = set()
        self._begun = rig.state()
        self._time = OwnTime()

    def fault(self, key, kind, seconds=0.0):
        self._faults[key] = kind, seconds

    def sound(self):
        self._faults = {}
        mended, self._mended = self._mended, threading.Event()
        mended.set()

    def hold(self, held):
        self._held = held

    def on(self):
        return sorted(self._rig.on)

    def doing(self):
        return sorted(self._doing)

    def lost(self):
        return self._time.lost()

    def quiet(self):
        self._rig.on.clear()

    def left(self, afresh):
        """Take that who used it is gone; afresh, it stands where it stood in the beginning."""
        if self._rig.streams:
            self._rig.end()
        if afresh:
            self.quiet()
            self._rig.restore(self._begun)

    def _done(self, head):
        key, verb = head["to"], head["do"]
        if key == "test":
            return getattr(self, verb)(*head["with"])
        self._doing |= {f"{key}.{verb}"}
        try:
            return self._as_it_is(key, verb, head)
        finally:
            self._doing -= {f"{key}.{verb}"}

    def _as_it_is(self, key, verb, head):
        kind, seconds = self._faults.get(key, ("", 0.0))
        if kind in ("absent", "garbling"):
            raise InstrumentError(f"{key} is {kind}", kind="line lost")
        if kind in ("silent", "late"):
            self._mended.wait(seconds or None)
        if kind in ("stuck on", "welded") and verb in ("off", "safe"):
            return None
        if kind == "welded" and verb in ("output", "vibrates"):
            return False
        if kind == "stuck at a value" and verb == "reading":
            return Reading(1.0, 2.4)
        if kind == "stuck at a value" and verb == "poll":
            poll = super()._done(head)
            stuck = tuple(np.full_like(one, _STUCK) for one in poll.counts)
            return dataclasses.replace(poll, counts=stuck)
        if (key, verb) == ("clock", "sleep") and self._held and "vibration" in self._rig.on:
            time.sleep(0.02)
            return self._rig.now
        return super()._done(head)


class StandingRig:
    """A rig of a case in a process of its own.

    ``fault(key, kind)`` is one of absent, silent, garbling, late (by seconds), stuck on, welded
    (off by its state, on by its current or its signal) and stuck at a value, until ``sound()``;
    while it is held its time stands still as long as it vibrates. ``left(True)`` has it stand as in
    the beginning.
    ``lost()`` tells how long others had its processor so far, s.
    """

    def __init__(self, case):
        # Once for all that are forked from here, on rig and runs alike.
        study.prepare(case)
        importlib.import_module("h5netcdf")
        heard, told = os.pipe()

        def be():
            os.close(heard)
            bench, rig = rigs.made_bench(case)
            _warm(bench, rig, case)
            server = _Server(*rigs.made_bench(case))
            server._rig.plant = rig.plant
            server._rig.on -= {"amplifier"}
            os.write(told, json.dumps(server.address).encode())
            os.close(told)
            server.serve()
            return 0

        self._process = _in_a_child(be)
        os.close(told)
        with os.fdopen(heard) as file:
            self.address = tuple(json.load(file))
        self._line = RigLine(self.address)

    def __getattr__(self, name):
        return lambda *given: self._line.ask("test", name, *given)

    def close(self):
        self._line.close()
        with contextlib.suppress(ProcessLookupError):
            os.kill(self._process, signal.SIGKILL)
        os.waitpid(self._process, 0)


def _warm(bench, rig, case):
    """Compile and tabulate what a run needs, so that no answer is late for that."""
    for frequency in case["plan"].frequencies:
        for on in (set(), {"steel", "bronze"}, {"steel", "bronze", "vibration", "amplifier"}):
            rig.volts = {"steel": 1.0, "bronze": 0.9}
            rig.on, rig.frequency = on, frequency
            rig.change()
            rig.begin(1.0 / case["plan"].sample_rate)
            bench.clock.sleep(0.1)
            rig.taken()
            rig.end()
            bench.clock.sleep(0.01)
            rig.change()


class Procedure:
    """``asperity rig run`` in a process of its own, on a rig that stands.

    With dials its guardians are forked and go by these, ``begins`` called in each with its number;
    without, they are begun as for a user.
    """

    def __init__(
        self, case, folder, rig, *, resume=False, acknowledge="", before=None, dials=None,
        begins=lambda number: None,
    ):  # fmt: skip
        folder.mkdir(exist_ok=True)
        self.folder = folder
        noted = folder / "guardian"
        noted.unlink(missing_ok=True)
        self._there, there = os.pipe()
        os.set_inheritable(there, True)

        class Noted(backends.Guard):
            def _start(self):
                super()._start()
                noted.write_text(str(self.process))

        def work():
            # Where the tests run in the background they would not be heard.
            signal.signal(signal.SIGINT, signal.default_int_handler)
            signal.signal(signal.SIGQUIT, signal.SIG_DFL)
            if dials is not None:
                forked_guardians(dials, keep=(there,), begins=begins)
            errors = os.open(folder / "errors", os.O_WRONLY | os.O_CREAT | os.O_APPEND)
            os.dup2(errors, 2)
            backends.begun_rig = lambda case: rig.address
            backends.Guard = Noted
            if before is not None:
                before()
            problem = study.prepare(case, "sim", "", resume, acknowledge)
            try:
                answer = study.answer(problem, Run(folder=folder, stem="rig-run"))
            except KeyboardInterrupt as stop:
                os.write(2, f"{stop}\n".encode())
                return 130
            except AsperityError as error:
                os.write(2, f"{error}\n".encode())
                return error.exit_code
            if answer.failure is None:
                return 0
            os.write(2, f"{answer.failure}\n".encode())
            return answer.failure.exit_code

        self.number = _in_a_child(work)
        os.close(there)
        self._status = None

    def kill(self, number):
        os.kill(self.number, number)
        return time.monotonic()

    @property
    def guardian(self):
        """Number of the guardian's process."""
        return int((self.folder / "guardian").read_text())

    def ended(self, patience=PATIENT):
        """Wait for its end; returns its exit code, negative if a signal ended it."""
        waited_for(self._gone, patience)
        return os.waitstatus_to_exitcode(self._status)

    def _gone(self):
        if self._status is None:
            gone, status = os.waitpid(self.number, os.WNOHANG)
            if gone:
                self._status = status
        return self._status is not None

    def gone(self):
        """Wait until it and its guardians, if they are forked, have ended."""
        assert select.select([self._there], [], [], PATIENT)[0], "nobody ended"

    @property
    def said(self):
        return (self.folder / "errors").read_text()

    def end(self):
        """Leave nothing behind."""
        if not self._gone():
            os.kill(self.number, signal.SIGCONT)
            os.kill(self.number, signal.SIGKILL)
            self.ended()


def waited_for(what, patience=PATIENT):
    """Wait until something is so; returns what it gives."""
    last = time.monotonic() + patience
    while not (found := what()):
        assert time.monotonic() < last, "nothing came"
        time.sleep(0.01)
    return found


def lines_of(folder, kind):
    """Return the lines of a kind of a journal that may just be written."""
    return [line for line in rigs.whole_lines(folder) if line["kind"] == kind]
