"""The exceptions of the package, and how a message says what was given and what is allowed."""

import difflib
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any, ClassVar, get_args

from asperity import exit_codes


class AsperityError(Exception):
    """Base of every exception the package raises on purpose.

    The text is one line: what was given, what is allowed, what to do.
    """

    exit_code: ClassVar[int] = exit_codes.FAILED


class InputError(AsperityError, ValueError):
    """Something given by the user cannot be used."""

    exit_code = exit_codes.BAD_INPUT


class ConvergenceError(AsperityError, RuntimeError):
    """An iteration ended without an answer.

    Parameters
    ----------
    message : str
        What did not converge.
    reached : mapping of str to float, optional
        What was reached, such as the residual and the number of iterations.
    """

    exit_code = exit_codes.NOT_DONE

    def __init__(self, message: str, *, reached: Mapping[str, float] | None = None) -> None:
        super().__init__(message)
        self.reached = dict(reached or {})


class StorageError(AsperityError, OSError):
    """A file or folder cannot be read or written."""

    exit_code = exit_codes.BAD_INPUT


class MissingExtraError(AsperityError, ImportError):
    """An optional dependency is needed and not installed."""

    exit_code = exit_codes.BAD_INPUT


# Formats that turn the direction of writing, so that a text reads as another than it is.
_TURNING = frozenset("\u200e\u200f\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")
_CONTROLS = frozenset(("Cc", "Cs", "Zl", "Zp"))


def is_plain(text: str) -> bool:
    """Whether a text is one line of characters that do nothing where it is shown."""
    return text.isprintable() or not any(map(_acts, text))


def plain(text: str, *, keep: str = "") -> str:
    """Return a text with what would act where it is shown written as its escape.

    A terminal obeys ESC, a line of an input deck ends at a line feed, and half a surrogate, as a
    file name that is not UTF-8 holds, cannot be written at all.

    Parameters
    ----------
    text : str
        Any text, such as the name of a file.
    keep : str
        Characters to leave as they are.
    """
    if text.isprintable():
        return text
    return "".join(
        character.encode("unicode_escape").decode()
        if _acts(character) and character not in keep
        else character
        for character in text
    )


def shown(value: object) -> str:
    """Return a value as a message quotes it, cut where it is long."""
    try:
        text = repr(value)
    except ValueError:  # a whole number of more digits than Python writes
        text = "a whole number of very many digits"
    return text if len(text) <= 60 else f"{text[:57]}..."


def _acts(character: str) -> bool:
    return unicodedata.category(character) in _CONTROLS or character in _TURNING


def require_fields(record: Any) -> None:
    """Refuse fields of a dataclass of another type than it declares; as :func:`require_types`."""
    kinds = {field.name: (getattr(record, field.name), field.type) for field in fields(record)}
    require_types(type(record).__name__, **kinds)


def require_types(what: str, **given: tuple[object, Any]) -> None:
    """Refuse arguments of another type, as those in a wrong order are.

    Parameters
    ----------
    what : str
        Who is given them.
    **given : tuple
        By name: the argument and its type, or a union of one with None.

    Raises
    ------
    InputError
        Naming the argument, what it is and what it must be.
    """
    for name, (value, kind) in given.items():
        if not isinstance(value, kind):
            plainly = value is None or isinstance(value, str | int | float)
            is_given = shown(value) if plainly else f"a {type(value).__name__}"
            wanted = (*get_args(kind), kind)[0].__name__
            raise InputError(f"{what} is given {is_given} as {name}; it must be a {wanted}")


def choices(known: Iterable[str]) -> str:
    """Return the known words quoted and separated by commas."""
    return ", ".join(f"'{word}'" for word in known)


def suggestion(word: object, known: Iterable[str]) -> str:
    """Return `` (did you mean 'x'?)`` if a known word is near, else nothing."""
    if not isinstance(word, str):
        return ""
    lowered = {name.lower(): name for name in known}
    near = difflib.get_close_matches(word.lower(), lowered, n=1)
    return f" (did you mean '{lowered[near[0]]}'?)" if near else ""


def one_of(known: Iterable[object], given: object) -> str:
    """Return what a word that is not known must be, and which was meant if one is near."""
    words = [str(word) for word in known]
    which = "one of " if len(words) > 1 else ""
    return f"it must be {which}{choices(words)}{suggestion(str(given), words)}"


def nearest(word: object, known: Iterable[str]) -> str:
    """Return the end of a message about an unknown word.

    Parameters
    ----------
    word : str
        What was given; near to what is no text there is nothing.
    known : iterable of str
        What is allowed.

    Returns
    -------
    str
        `` (did you mean 'x'?)``, or everything that is allowed where nothing is near.
    """
    allowed = list(known)
    return suggestion(word, allowed) or (f" (allowed: {choices(allowed)})" if allowed else "")
