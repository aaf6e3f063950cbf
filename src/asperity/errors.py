"""The exceptions of the package, and the suggestion that ends their messages."""

import difflib
from collections.abc import Iterable, Mapping
from typing import ClassVar


class AsperityError(Exception):
    """Base of every exception the package raises on purpose.

    The text is one line: what was given, what is allowed, what to do.
    """

    exit_code: ClassVar[int] = 1


class InputError(AsperityError, ValueError):
    """Something given by the user cannot be used."""

    exit_code = 2


class ConvergenceError(AsperityError, RuntimeError):
    """An iteration ended without an answer.

    Parameters
    ----------
    message : str
        What did not converge.
    reached : mapping of str to float, optional
        What was reached, such as the residual and the number of iterations.
    """

    exit_code = 3

    def __init__(self, message: str, *, reached: Mapping[str, float] | None = None) -> None:
        super().__init__(message)
        self.reached = dict(reached or {})


class StorageError(AsperityError, OSError):
    """A file or folder cannot be read or written."""

    exit_code = 2


class MissingExtraError(AsperityError, ImportError):
    """An optional dependency is needed and not installed."""

    exit_code = 2


def choices(known: Iterable[str]) -> str:
    """Return the known words quoted and separated by commas."""
    return ", ".join(f"'{word}'" for word in known)


def suggestion(word: str, known: Iterable[str]) -> str:
    """Return `` (did you mean 'x'?)`` if a known word is near, else nothing."""
    lowered = {name.lower(): name for name in known}
    near = difflib.get_close_matches(word.lower(), lowered, n=1)
    return f" (did you mean '{lowered[near[0]]}'?)" if near else ""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return the end of a message about an unknown word.

    Parameters
    ----------
    word : str
        What was given.
    known : iterable of str
        What is allowed.

    Returns
    -------
    str
        `` (did you mean 'x'?)``, or everything that is allowed where nothing is near.
    """
    allowed = list(known)
    return suggestion(word, allowed) or (f" (allowed: {choices(allowed)})" if allowed else "")
