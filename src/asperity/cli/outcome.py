"""How a command ends: its exit code, and one line about what went wrong."""

import functools
import os
import sys
from collections.abc import Callable
from typing import ParamSpec

import typer

from asperity.errors import AsperityError, ConvergenceError

INTERRUPTED = 130
BROKEN_PIPE = 141

# What typer raises for a wrong command line, wherever this version of it keeps the class.
USAGE_ERROR: type[Exception] = typer.BadParameter.__mro__[2]

P = ParamSpec("P")


def reported(command: Callable[P, None]) -> Callable[P, None]:
    """Make a command end with a line and an exit code where it would end with an exception."""

    @functools.wraps(command)
    def wrapped(*arguments: P.args, **options: P.kwargs) -> None:
        try:
            command(*arguments, **options)
        except AsperityError as error:
            _end(_line(error), error.exit_code)
        except KeyboardInterrupt as error:
            _end(str(error) or "interrupted", INTERRUPTED)
        except BrokenPipeError:
            # Who read the output has seen enough. Python would complain at its own last flush.
            silence_standard_output()
            _end("", BROKEN_PIPE)

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
        print(" ".join(line.split()), file=sys.stderr)
    raise typer.Exit(code)


def silence_standard_output() -> None:
    """Let what is still to be written to standard output go nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, sys.stdout.fileno())
    os.close(nowhere)
