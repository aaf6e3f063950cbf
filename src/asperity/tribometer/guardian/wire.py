"""Messages between the procedure, the guardian and a simulated rig: one object asks another.

A message is a head, which is JSON, and a body of bytes that may be empty. Nothing in it is run.
"""

import contextlib
import dataclasses
import json
import struct
import threading
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from asperity.errors import AsperityError, InputError, StorageError
from asperity.tribometer.instruments.protocols import InstrumentError

_LENGTHS = struct.Struct(">II")
_MOST_BYTES = 1 << 28

Head = dict[str, Any]
Objects = Mapping[str, Any]


class Stream(Protocol):
    """Bytes that come and go, unbuffered: a pipe, or a socket's file."""

    def read(self, size: int, /) -> bytes | None:
        """Return some bytes, none at the end."""

    def write(self, data: memoryview, /) -> int | None:
        """Write some bytes."""


class Wire:
    """One end of a line.

    Parameters
    ----------
    read, write : Stream
        Where messages come from and go to.
    """

    def __init__(self, read: Any, write: Any) -> None:
        self._read, self._write = read, write
        self._sending = threading.Lock()

    def send(self, head: Head, body: bytes = b"") -> None:
        """Send a message; raises OSError where nobody is at the other end."""
        text = json.dumps(head).encode()
        left = memoryview(_LENGTHS.pack(len(text), len(body)) + text + body)
        with self._sending:
            while left:
                left = left[self._write.write(left) or 0 :]

    def receive(self) -> tuple[Head, bytes] | None:
        """Return the next message, None when there will be none."""
        try:
            lengths = _LENGTHS.unpack(self._exactly(_LENGTHS.size))
            if sum(lengths) > _MOST_BYTES:
                return None
            head = json.loads(self._exactly(lengths[0]))
            return head, self._exactly(lengths[1])
        except (OSError, EOFError, ValueError):
            return None

    def _exactly(self, size: int) -> bytes:
        parts = bytearray()
        while len(parts) < size:
            part = self._read.read(size - len(parts))
            if not part:
                raise EOFError
            parts += part
        return bytes(parts)

    def deaf(self) -> None:
        """Hear no more, what is still said included."""
        with contextlib.suppress(OSError):
            self._read.close()

    def close(self) -> None:
        """Hang up."""
        for stream in (self._read, self._write):
            with contextlib.suppress(OSError):
                stream.close()


def done(objects: Objects, head: Head) -> Any:
    """Do what a message asks of one of some objects; returns what that gave."""
    name, verb = head["to"], head["do"]
    if name not in objects or verb.startswith("_"):
        raise InputError(f"nobody here is called {name}, to {verb}")
    return getattr(objects[name], verb)(*head.get("with", ()))


def answered(number: int, act: Callable[[], Any]) -> tuple[Head, bytes]:
    """Return the message that answers another: what was given, or why not."""
    try:
        gave = act()
    except Exception as error:
        return failed(number, error), b""
    body = b""
    if isinstance(gave, tuple) and len(gave) == 2 and isinstance(gave[1], bytes):
        gave, body = gave
    if dataclasses.is_dataclass(gave) and not isinstance(gave, type):
        gave = dataclasses.astuple(gave)
    return {"n": number, "gave": gave}, body


def failed(number: int, error: BaseException) -> Head:
    """Return the head that tells of an error."""
    kind = getattr(error, "kind", None)
    if isinstance(error, InstrumentError):
        sort = "instrument"
    elif isinstance(error, StorageError):
        sort = "storage"
    else:
        sort = "input" if isinstance(error, InputError) else "other"
    text = str(error) if isinstance(error, AsperityError) else f"{type(error).__name__}: {error}"
    return {"n": number, "error": text, "sort": sort, "kind": kind}


def given(head: Head) -> Any:
    """Return what an answer gave; raises what it tells of."""
    if "error" not in head:
        return head["gave"]
    text = head["error"]
    if head["sort"] == "storage":
        raise StorageError(text)
    if head["sort"] == "input":
        raise InputError(text)
    raise InstrumentError(text, kind=head.get("kind") or "instrument")
