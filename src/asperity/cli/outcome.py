"""How a command ends: its exit code, and one line about what went wrong."""

import errno
import functools
import io
import os
import sys
from collections.abc import Callable
from typing import Any, ParamSpec, TextIO

import typer

from asperity import exit_codes
from asperity.cli import interrupt
from asperity.errors import AsperityError, ConvergenceError, plain, shown
from asperity.files.store import reason

# What typer raises for a wrong command line, wherever this version of it keeps the class.
USAGE_ERROR: type[Exception] = typer.BadParameter.__mro__[2]

P = ParamSpec("P")


def reported(command: Callable[P, None]) -> Callable[P, None]:
    """Make a command end with a line and an exit code where it would end with an exception."""

    @functools.wraps(command)
    def wrapped(*arguments: P.args, **options: P.kwargs) -> None:
        starting = interrupt.as_exception()
        try:
            # Loaded here, for the help does without.
            from asperity.files.store import inputs_kept

            with inputs_kept():
                command(*arguments, **options)
        except AsperityError as error:
            _end(_line(error), error.exit_code)
        except KeyboardInterrupt as error:
            _end(str(error) or interrupt.LINE, exit_codes.INTERRUPTED)
        except (MemoryError, RuntimeError) as error:
            if isinstance(error, RuntimeError) and "new thread" not in str(error):
                raise
            what = "memory" if isinstance(error, MemoryError) else "threads"
            line = f"the system gives no more {what}; raise its limit (ulimit), or ask for less"
            _end(line, exit_codes.FAILED)
        except BrokenPipeError:
            # Who read the output has seen enough. Python would complain at its own last flush.
            silence_standard_output()
            _end("", exit_codes.BROKEN_PIPE)
        finally:
            if starting:
                # Of a group, what follows is the start of the command itself.
                interrupt.at_once()

    return wrapped


def usage(error: BaseException) -> str:
    """Return what is wrong with the command line itself as one line."""
    context = getattr(error, "ctx", None)
    command = context.command_path if context is not None else "asperity"
    format_message = getattr(error, "format_message", error.__str__)
    message = " ".join(format_message().split()).rstrip(".")
    return f"{command}: {message[:1].lower()}{message[1:]}; see {command} --help"


def _line(error: AsperityError) -> str:
    reached = error.reached if isinstance(error, ConvergenceError) else {}
    if not reached:
        return str(error)
    return f"{error} (reached: {', '.join(f'{k} {v:.4g}' for k, v in reached.items())})"


def _end(line: str, code: int) -> None:
    if line:
        tell(line)
    raise typer.Exit(code)


def tell(line: str) -> None:
    """Print a line to standard error, with nothing in it that a terminal would obey."""
    try:
        print(plain(" ".join(line.split())), file=sys.stderr, flush=True)
    except OSError:
        # A terminal that is gone changes nothing of how a command ends.
        _silence(sys.stderr)


def hold_streams() -> None:
    """Give streams that were closed a place of their own, and let every text be written.

    Otherwise the next file that is opened would take the place of a closed stream, and what is
    meant for standard error would go to standard output.
    """
    if sys.stderr is None:
        sys.stderr = _stand_in(2, os.O_WRONLY)
    if sys.stdout is None:
        # It refuses what is written to it, as the one that was closed would.
        sys.stdout = _stand_in(1, os.O_RDONLY)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _stand_in(number: int, mode: int) -> io.TextIOWrapper:
    nowhere = os.open(os.devnull, mode)
    if nowhere != number:
        os.dup2(nowhere, number)
        os.close(nowhere)
    return open(number, "w", encoding="utf-8", closefd=False)


def unwritten(error: OSError) -> str:
    """Return what is to be said of a standard output that cannot be written to."""
    if isinstance(error, FileNotFoundError) and error.filename is None:
        # Of what has no name only the current folder can be gone.
        return "the current folder is no longer there; change to another, or name files in full"
    if error.filename is not None:
        # Not of a standard output, which has no name.
        return f"{shown(str(error.filename))} cannot be read or written: {reason(error)}"
    why = "it is closed" if error.errno == errno.EBADF else reason(error)
    return f"standard output cannot be written: {why}"


def silence_standard_output() -> None:
    """Let what is still to be written to standard output go nowhere."""
    _silence(sys.stdout)


def _silence(stream: TextIO) -> None:
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream.fileno())
    os.close(nowhere)


class StandardError:
    """Standard error of a terminal that may be closed while something is shown on it."""

    def __init__(self) -> None:
        self._stream = sys.stderr

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def write(self, text: str) -> int:
        """Write a text, as far as there is a terminal."""
        try:
            return self._stream.write(text)
        except OSError:
            _silence(self._stream)
            return len(text)

    def flush(self) -> None:
        """Bring it there, as far as there is a terminal."""
        try:
            self._stream.flush()
        except OSError:
            _silence(self._stream)
