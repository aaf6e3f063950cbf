"""The simulated rig as a process of its own, which stands on when who ran it is gone.

Procedure and guardian are connected to it as to devices: by lines that break with the process at
the other end. It ends when nobody is connected any more.
"""

import contextlib
import json
import os
import secrets
import socket
import sys
import threading
from collections.abc import Mapping
from typing import Any

from asperity.casefile import Case
from asperity.tribometer.guardian import wire as wires
from asperity.tribometer.guardian.casing import cased
from asperity.tribometer.guardian.wire import Wire
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.protocols import InstrumentError

_HOST = "127.0.0.1"
_ALONE = 30.0  # s that it waits for somebody to come
_ANSWER = 300.0  # s; kernels may be compiled meanwhile

Address = tuple[int, str]
"""Port on this machine, and a word that lets in."""


class RigLine:
    """A line to the process of a simulated rig.

    Parameters
    ----------
    address : tuple
        Its port and word.

    Raises
    ------
    InstrumentError
        Nobody is there.
    """

    def __init__(self, address: Address) -> None:
        self._lock = threading.Lock()
        try:
            self._socket = socket.create_connection((_HOST, address[0]), timeout=_ANSWER)
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            stream = self._socket.makefile("rwb", buffering=0)
            self._wire = Wire(stream, stream)
            self._wire.send({"word": address[1]})
        except OSError as error:
            raise InstrumentError(
                f"the simulated rig does not answer: {error}", kind="line lost"
            ) from None

    def ask(self, to: str, do: str, *arguments: Any) -> Any:
        """Return what an object gives; raises what it raises."""
        return self.ask_bytes(to, do, *arguments)[0]

    def ask_bytes(self, to: str, do: str, *arguments: Any) -> tuple[Any, bytes]:
        """Return what an object gives, with its bytes."""
        with self._lock:
            try:
                self._wire.send({"to": to, "do": do, "with": arguments, "n": 1})
            except (OSError, ValueError):
                answer = None
            else:
                answer = self._wire.receive()
        if answer is None:
            raise InstrumentError("the line to the simulated rig is lost", kind="line lost")
        return wires.given(answer[0]), answer[1]

    def close(self) -> None:
        """Hang up."""
        with contextlib.suppress(OSError):
            self._socket.shutdown(socket.SHUT_RDWR)
        self._wire.close()
        self._socket.close()


class _Scope:
    """The oscilloscope, its samples as bytes."""

    def __init__(self, bench: Bench) -> None:
        self._scope = bench.scope
        self.identify, self.start = self._scope.identify, self._scope.start
        self.stop, self.safe = self._scope.stop, self._scope.safe

    def poll(self) -> tuple[Any, bytes]:
        poll = self._scope.poll()
        body = b"".join(part.tobytes() for part in poll.counts)
        return (poll.clock, [part.size for part in poll.counts], poll.overrange), body


class _Clock:
    def __init__(self, bench: Bench) -> None:
        self._clock = bench.clock
        self.now = bench.clock.now

    def sleep(self, seconds: float) -> float:
        self._clock.sleep(seconds)
        return self._clock.now()


def objects_of(bench: Bench) -> dict[str, Any]:
    """Return what can be asked of a simulated bench."""
    return {
        "scope": _Scope(bench),
        "clock": _Clock(bench),
        "vibration": bench.vibration,
        "amplifier": bench.amplifier,
        **bench.motors,
        "tachometer": bench.tachometer,
        "listener": bench.listener,
        "person": bench.person,
        "memory": bench.memory,
    }


class RigServer:
    """Lets a rig be asked over lines, one question at a time.

    Parameters
    ----------
    objects : mapping
        What can be asked.
    """

    def __init__(self, objects: Mapping[str, Any]) -> None:
        self._objects = objects
        self._lock = threading.Lock()
        self._word = secrets.token_hex(16)
        self._there = 0
        self._change = threading.Condition()
        self._listening = socket.create_server((_HOST, 0))

    @property
    def address(self) -> Address:
        """Where it is."""
        return self._listening.getsockname()[1], self._word

    def serve(self) -> None:
        """Answer until nobody is connected any more."""
        threading.Thread(target=self._welcome, daemon=True).start()
        with self._change:
            self._change.wait_for(lambda: self._there > 0, timeout=_ALONE)
            self._change.wait_for(lambda: self._there == 0)

    def _welcome(self) -> None:
        while True:
            line, _ = self._listening.accept()
            line.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            with self._change:
                self._there += 1
                self._change.notify_all()
            threading.Thread(target=self._hear, args=(line,), daemon=True).start()

    def _hear(self, line: socket.socket) -> None:
        try:
            with line, line.makefile("rwb", buffering=0) as stream:
                wire = Wire(stream, stream)
                first = wire.receive()
                if first is None or not secrets.compare_digest(
                    str(first[0].get("word")), self._word
                ):
                    return
                while (asked := wire.receive()) is not None:
                    wire.send(*wires.answered(1, lambda head=asked[0]: self._done(head)))  # type: ignore[misc]
        except OSError:
            pass
        finally:
            with self._change:
                self._there -= 1
                self._change.notify_all()

    def _done(self, head: wires.Head) -> Any:
        with self._lock:
            return wires.done(self._objects, head)


def simulated(case: Case) -> Bench:
    """Return the simulated bench of a case."""
    from asperity.tribometer.channels import Channels
    from asperity.tribometer.instruments.acquisition import inputs_for
    from asperity.tribometer.instruments.inputs import lines_of, simulated_of
    from asperity.tribometer.instruments.sim import simulated_bench
    from asperity.tribometer.twin.plants import plant_of

    channels = case.require(Channels)
    inputs = simulated_of(inputs_for(case))
    return simulated_bench(plant_of(case), inputs, lines_of(channels, inputs))[0]


def main() -> None:
    """Read a case from standard input, say where the rig is, and be it."""
    server = RigServer(objects_of(simulated(cased(json.loads(sys.stdin.readline())))))
    print(json.dumps(server.address), flush=True)
    nowhere = os.open(os.devnull, os.O_RDWR)
    for number in (0, 1):
        os.dup2(nowhere, number)
    server.serve()


if __name__ == "__main__":
    main()
