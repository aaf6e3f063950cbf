"""The instruments of a configuration, by who makes them, their outputs owned by a guardian."""

import concurrent.futures as cf
import contextlib
import dataclasses
import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from asperity.casefile import Case
from asperity.errors import AsperityError
from asperity.tribometer.guardian import remote
from asperity.tribometer.guardian.casing import packed
from asperity.tribometer.guardian.devices import DRIVE, EAR, OUTPUTS, owned_by
from asperity.tribometer.guardian.guard import Guard
from asperity.tribometer.guardian.in_time import ScopeInTime, beaten
from asperity.tribometer.guardian.owned import LISTENER
from asperity.tribometer.guardian.rig import Address, RigLine
from asperity.tribometer.guardian.scopes import opened_scope
from asperity.tribometer.instruments.acquisition import Acquisition, inputs_for
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.inputs import simulated_of
from asperity.tribometer.instruments.manual import (
    ManualAccelerometer,
    ManualSupply,
    ManualTachometer,
    ManualVibration,
    Operator,
)
from asperity.tribometer.instruments.off import said
from asperity.tribometer.instruments.parameters import Guard as Table
from asperity.tribometer.instruments.protocols import (
    Input,
    Person,
    Supply,
    VibrationDrive,
)

# Kinds of what an interlock says of a rig that somebody else has switched off.
_AS_OFF = "vibration", "supply"
REPLAY = "replay"
_WORKING = 5.0  # s that a disk may take
T = TypeVar("T")
BACKENDS = "sim", REPLAY, "hardware", "manual"
"""All of it simulated; a run played back; all that can be had as hardware; a PicoScope, and a
person for the rest."""


class _Vibration(remote.RemoteVibration):
    """A drive that the guardian owns; what keeps it alive is the heartbeat."""

    def __init__(self, guard: Guard) -> None:
        super().__init__(guard, "vibration", DRIVE)
        self._guard = guard

    def keep_alive(self) -> None:
        """Tell the guardian that the procedure goes on."""
        self._guard.beat()


class _ByHand(ManualVibration):
    """A drive that a person operates, beside a guardian that wants a heartbeat all the same."""

    def __init__(self, person: Person, guard: Guard) -> None:
        super().__init__(person)
        self._guard = guard

    def keep_alive(self) -> None:
        """Tell the guardian that the procedure goes on."""
        self._guard.beat()


@dataclasses.dataclass(frozen=True)
class GuardedBench(Bench):
    """A bench whose outputs a guardian owns.

    Attributes
    ----------
    guard : Guard
        Who switches them.
    rig : RigLine, optional
        The line to a simulated rig.
    """

    guard: Guard = None  # type: ignore[assignment]
    rig: RigLine | None = None

    def safe(self) -> tuple[str, ...]:
        """Have everything switched off and read back; returns what was not, and why."""
        self.guard.off("the procedure asks", listen=False)
        # Then nobody else uses it, and its samples tell whether the drive is still; where it does
        # not let go, nothing is heard, and that is told.
        self._let_go_of_the_scope()
        found = self.guard.off("the procedure asks, and the drive signal is heard", listen=True)
        return (*found.get("still_on", ()), *self._by_hand())

    def cause_of(self, error: BaseException) -> BaseException:
        """Return why the guardian switched off, of an error that is only what that looks like.

        It says so when everything was read back, and the silence may be heard before.
        """
        return (getattr(error, "kind", "") in _AS_OFF and self.guard.switched_off()) or error

    def begun(self) -> tuple[str, ...]:
        """Return what was not read back to be off when the guardian began, and why."""
        found = self.guard.begun()
        trouble = [found["trouble"]] if "trouble" in found else []
        return (*found.get("still_on", ()), *trouble, *self._by_hand())

    def waiting(self) -> contextlib.AbstractContextManager[None]:
        """Return what tells the guardian meanwhile that the procedure goes on."""
        return self.guard.beating()

    def work(self, act: Callable[[], T]) -> T:
        """Return what a piece of work gives; the guardian is told that the procedure waits for it.

        What takes longer than a disk may is told no more, and ends as a procedure that hangs.
        """
        with cf.ThreadPoolExecutor(1) as pool:
            future = pool.submit(act)
            with contextlib.suppress(cf.TimeoutError):
                return beaten(future, self.guard.here, _WORKING)
            return future.result()

    def _let_go_of_the_scope(self) -> None:
        # Whatever a driver raises; it is no output, and keeps nothing on.
        with contextlib.suppress(Exception):
            self.scope.safe()
            self.scope.close()

    def _by_hand(self) -> list[str]:
        failures = []
        for one in (self.vibration, *self.motors.values()):
            if one.by_hand:
                try:
                    one.safe()
                except Exception as error:
                    failures.append(f"{one.name}: {said(error)}")
        return failures

    def close(self) -> None:
        """Let go of all of them; the guardian ends when everything is off."""
        with contextlib.suppress(Exception):
            self.scope.close()
        self.guard.close()
        if self.rig is not None:
            self.rig.close()


def open_bench(case: Case, backend: str, folder: Path | None = None) -> GuardedBench:
    """Return the instruments of a configuration, which their guardian begins to switch off.

    Parameters
    ----------
    case : Case
        The configuration.
    backend : str
        One of `BACKENDS`, but for a replay.
    folder : Path, optional
        Of the run.

    Raises
    ------
    InputError
        The configuration lacks something, or nobody sits at a terminal.
    InstrumentError
        No guardian can be started.
    """
    inputs = inputs_for(case)
    if backend == "sim":
        return _simulated(case, simulated_of(inputs), folder)
    person = Operator()
    guard = Guard(case, backend, None, folder)
    owned, _ = owned_by(case, backend)
    due = case.get(Table, Table()).due(simulated=False)
    sampled = case.get(Acquisition, Acquisition())
    late = sampled.late if sampled.folder else 0.0
    vibration: VibrationDrive = (
        _Vibration(guard) if "vibration" in owned else _ByHand(person, guard)
    )
    outputs: dict[str, Supply] = {
        key: remote.RemoteSupply(guard, key, name) if key in owned else ManualSupply(person, name)
        for key, name in OUTPUTS.items()
    }
    amplifier = outputs.pop("amplifier")
    return GuardedBench(
        scope=ScopeInTime(
            sampled.name,
            inputs,
            lambda: opened_scope(case, inputs),
            sampled.deadline(due),
            late=late,
            beat=guard.here,
        ),
        vibration=vibration,
        motors=outputs,
        tachometer=ManualTachometer(person),
        person=person,
        amplifier=amplifier if "amplifier" in owned else None,
        accelerometer=ManualAccelerometer(person),
        guard=guard,
    )


def _simulated(case: Case, inputs: tuple[Input, ...], folder: Path | None) -> GuardedBench:
    address = begun_rig(case)
    line = RigLine(address)
    try:
        guard = Guard(case, "sim", address, folder)
    except BaseException:
        line.close()
        raise
    clock = remote.RemoteClock(line)
    name = "simulated oscilloscope"
    scope = remote.RemoteScope(line, "scope", name, inputs)
    due = case.get(Table, Table()).due(simulated=True)
    outputs = {key: remote.RemoteSupply(guard, key, name) for key, name in OUTPUTS.items()}
    return GuardedBench(
        scope=ScopeInTime(name, inputs, lambda: scope, due, beat=guard.here),
        vibration=_Vibration(guard),
        motors={key: outputs[key] for key in ("steel", "bronze")},
        tachometer=remote.RemoteTachometer(line, "tachometer", "simulated tachometer"),
        person=remote.RemotePerson(line),
        clock=clock,
        amplifier=outputs["amplifier"],
        listener=remote.RemoteListener(line, LISTENER, EAR),
        memory=remote.RemoteMemory(line, clock),
        simulated=True,
        guard=guard,
        rig=line,
    )


def begun_rig(case: Case) -> Address:
    """Start the process of a simulated rig; returns where it is."""
    process: Any = subprocess.Popen(
        [sys.executable, "-P", "-m", "asperity.tribometer.guardian.rig"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip
    with contextlib.suppress(OSError):
        process.stdin.write(json.dumps(packed(case)).encode() + b"\n")
        process.stdin.close()
    said_at = process.stdout.readline()
    process.stdout.close()
    try:
        port, word = json.loads(said_at)
    except ValueError:
        process.kill()
        process.wait()
        raise AsperityError("the process of the simulated rig has not begun") from None
    _reap(process)
    return port, word


def _reap(process: Any) -> None:
    """Take note of its end, whenever that is."""
    import threading

    threading.Thread(target=process.wait, daemon=True).start()
