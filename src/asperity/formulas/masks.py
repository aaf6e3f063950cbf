"""Numbers and arrays that may hold nonsense: checked, and masked with the reason of each."""

import contextlib
import contextvars
import functools
import math
from collections.abc import Callable, Iterator, Mapping
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, Real
from asperity.errors import InputError
from asperity.formulas.symbols import Symbol
from asperity.formulas.traced import Traced

Invalid = Literal["raise", "mask"]
Reasons = npt.NDArray[np.int16]


class Masked(NamedTuple):
    """What a formula returns for arrays with ``on_invalid="mask"``.

    Attributes
    ----------
    values : ndarray of float, shape of the arguments
        The results; NaN where there is none.
    reason : ndarray of int, the same shape
        0 where there is a result, else the code of the reason.
    legend : mapping of int to str
        The codes as sentences.
    """

    values: FloatArray
    reason: Reasons
    legend: Mapping[int, str]


_FEW = 50
_BY_VALUE = frozenset([float, int, str, bool, type(None), np.float64])


@functools.cache
def by_value(kind: type) -> bool:
    """Whether what is of a kind is known by its value, or never changes and equals itself alone."""
    # Its own: what is derived of a frozen class need not be frozen.
    made = vars(kind).get("__dataclass_params__")
    return kind in _BY_VALUE or (made is not None and made.frozen and not made.eq)


class Seen(NamedTuple):
    """What is known of an array whose formulas go on: its ends, and where it has no number.

    Attributes
    ----------
    array : ndarray
        The array itself, so that no other takes its place in memory.
    lowest, highest : float
        Of its numbers.
    holes : ndarray of bool or None
        Where it is NaN, each with its reason; None where it nowhere is.
    """

    array: FloatArray
    lowest: float
    highest: float
    holes: npt.NDArray[np.bool_] | None


class Mask:
    """Why elements of arrays have no answer: the first reason of each.

    Parameters
    ----------
    shape : tuple of int
        Of the arrays; ``()`` for numbers.

    Attributes
    ----------
    reason : ndarray of int
        0 where there is an answer, else a code.
    legend : dict of int to str
        The codes as sentences.
    """

    def __init__(self, shape: tuple[int, ...] = ()) -> None:
        self.reason: Reasons = np.zeros(shape, dtype=np.int16)
        self.legend: dict[int, str] = {}
        self._seen: dict[int, Seen] = {}
        self._kept: dict[tuple[Any, ...], tuple[tuple[Any, ...], Any]] = {}

    def once(self, function: Callable[..., Any], given: tuple[Any, ...], *about: Any) -> Any:
        """Return what a function gives for the very same arrays, worked out once.

        Parameters
        ----------
        function : callable
            Called without arguments where it is not known yet.
        given : tuple
            What it rests on: numbers and words are the same by value, all else by identity.
        *about
            What else tells it from others.
        """
        key = (*about, *(one if type(one) in _BY_VALUE else id(one) for one in given))
        known = self._kept.get(key)
        if known is None:
            # What is known by its place in memory is kept, so that no other takes it.
            known = self._kept[key] = given, function()
        return known[1]

    def seen(self, array: FloatArray) -> Seen | None:
        """Return what is known of an array, looked at once; None where NaN has no reason yet."""
        known = self._seen.get(id(array))
        if known is not None:
            return known
        if not array.size:
            return None
        if array.size <= _FEW:
            # Python looks through few numbers in less time than NumPy takes to begin.
            few = array.ravel().tolist()
            if not math.isnan(sum(few)):
                return self.remember(Seen(array, min(few), max(few), None))
        lowest, holes = float(array.min()), None
        if math.isnan(lowest):
            holes = np.isnan(array)
            if holes.shape != self.reason.shape or np.any(self.reason[holes] == 0) or holes.all():
                return None
            lowest, highest = float(np.fmin.reduce(array, None)), float(np.fmax.reduce(array, None))
        else:
            highest = float(array.max())
        return self.remember(Seen(array, lowest, highest, holes))

    def remember(self, known: Seen) -> Seen:
        """Keep what is known of an array, which must not change any more."""
        self._seen[id(known.array)] = known
        return known

    def copy(self) -> "Mask":
        """Return another that goes on from here."""
        other = Mask()
        other.reason, other.legend = self.reason.copy(), dict(self.legend)
        return other

    def part(self, where: Any) -> "Mask":
        """Return one of some of the elements; what it refuses is refused here."""
        other = Mask()
        other.reason, other.legend = self.reason[where], self.legend
        return other

    def stacked(self, count: int) -> "Mask":
        """Return one of as many rows of the elements, which knows what is known here."""
        other = Mask()
        other.reason = np.repeat(self.reason[None], count, axis=0)
        other.legend, other._seen, other._kept = dict(self.legend), self._seen, self._kept
        return other

    def refuse_as(self, other: "Mask") -> None:
        """Give what any row of another has no answer for its reason here."""
        for code, sentence in other.legend.items():
            self.refuse((other.reason == code).any(axis=0), sentence)

    def refuse(self, where: npt.ArrayLike, sentence: str) -> None:
        """Give a reason where there is none yet; what holds for all is always remembered."""
        holds = np.asarray(where)
        new = np.broadcast_to(holds, self.reason.shape) & (self.reason == 0)
        if not new.any() and (holds.ndim or not holds):
            return
        code = next((c for c, known in self.legend.items() if known == sentence), None)
        if code is None:
            code = len(self.legend) + 1
            self.legend[code] = sentence
        self.reason[new] = code


_MASK: contextvars.ContextVar[Mask | None] = contextvars.ContextVar("mask", default=None)


def current_mask() -> Mask | None:
    """Return what keeps the reasons within `masking`; None where nothing is masked."""
    return _MASK.get()


@contextlib.contextmanager
def masking(mask: Mask | tuple[int, ...] = ()) -> Iterator[Mask]:
    """Let formulas go on without an answer, NaN in its place, and keep the reasons.

    NaN goes through them without another reason.

    Parameters
    ----------
    mask : Mask or tuple of int
        What keeps the reasons, or the shape of a new one.

    Yields
    ------
    Mask
        The reasons so far.

    Examples
    --------
    >>> torque = Symbol("T", "N m")
    >>> with masking((2,)) as mask:
    ...     check("torque", np.array([1.0, np.nan]), torque)
    array([ 1., nan])
    >>> mask.reason.tolist(), mask.legend
    ([0, 1], {1: 'torque is not allowed; it must be finite'})
    """
    kept = mask if isinstance(mask, Mask) else Mask(mask)
    token = _MASK.set(kept)
    try:
        # For all formulas at once: to say it for each takes as long as many of them.
        with np.errstate(all="ignore"):
            yield kept
    finally:
        _MASK.reset(token)


def once(function: Callable[..., Any]) -> Callable[..., Any]:
    """Make a part of a formula work out once, within `masking`, what rests on the same arrays."""

    @functools.wraps(function)
    def wrapped(*given: Any) -> Any:
        mask = _MASK.get()
        if mask is None or not any(isinstance(one, np.ndarray) for one in given):
            return function(*given)
        return mask.once(lambda: function(*given), given, function)

    return wrapped


def check(name: str, value: Real, symbol: Symbol) -> Real:
    """Return a number or array of which all is allowed; NaN within `masking` where it is not.

    Raises
    ------
    InputError
        Something is not allowed.
    """
    lowest, highest = symbol.bounds.ends
    number = not isinstance(value, np.ndarray)
    if number and lowest <= value <= highest:
        return value
    mask = _MASK.get()
    if not number:
        known = None if mask is None else mask.seen(value)
        if known is not None:
            if lowest <= known.lowest and known.highest <= highest:
                return value
        elif value.size == 0 or (value.min() >= lowest and value.max() <= highest):
            return value
    # Comparisons with NaN are false, so that NaN is not allowed either.
    outside = np.True_ if number else ~symbol.bounds.holds(value)
    if mask is None or number:
        first = value if number else value[outside].flat[0]
        first = first.value if isinstance(first, Traced) else first
        unit = f" {symbol.unit}" if symbol.unit else ""
        sentence = f"{name} is {first:.6g}{unit}; {symbol.allowed}"
        if mask is None:
            raise symbol.error(sentence)
        if not (math.isnan(first) and mask.legend):
            mask.refuse(True, sentence)
        return np.float64(np.nan)
    mask.refuse(outside, f"{name} is not allowed; {symbol.allowed}")
    # The same array for the same, so that what rests on it is known again.
    return mask.once(lambda: np.where(outside, np.nan, value), (value,), lowest, highest)


def real(name: str, value: Any) -> Any:
    """Return a number as a float, and anything else of numbers as an array of floats.

    Raises
    ------
    InputError
        It is neither.
    """
    try:
        if isinstance(value, float) or type(value) is int:
            return float(value)
        if isinstance(value, Traced):
            return value
        array = np.asarray(value)
    except (OverflowError, ValueError):
        array = np.empty(0, dtype=object)
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name} is {str(value)[:60]!r}; it must be a number")
    return array.astype(np.float64, copy=False) if array.ndim else float(array)


def common_shape(arrays: Mapping[str, Any]) -> tuple[int, ...]:
    """Return the shape to which arrays broadcast, by their names.

    Raises
    ------
    InputError
        They do not go together.
    """
    if not arrays:
        return ()
    found = tuple(
        array.shape if type(array) is np.ndarray else np.shape(array) for array in arrays.values()
    )
    first: tuple[int, ...] = found[0]
    if found.count(first) == len(found):
        return first
    try:
        return _together(found)
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in zip(arrays, found, strict=True))
        raise InputError(f"the shapes {listed} do not go together; make them equal") from None


@functools.lru_cache
def _together(shapes: tuple[tuple[int, ...], ...]) -> tuple[int, ...]:
    return np.broadcast_shapes(*shapes)
