"""The decorator that makes a function a formula of a standard."""

import contextlib
import functools
import inspect
import math
from collections.abc import Callable, Mapping
from typing import Any, Literal, ParamSpec, Protocol, cast, get_args, get_origin, overload

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError, one_of, shown
from asperity.formulas.masks import (
    Invalid,
    Mask,
    Masked,
    by_value,
    check,
    common_shape,
    current_mask,
    masking,
    real,
)
from asperity.formulas.symbols import Bounds, Symbol, Unit, finite
from asperity.formulas.traced import Traced
from asperity.sources import Source
from asperity.units import is_quantity, to_si

P = ParamSpec("P")

_FLOAT = np.dtype(np.float64)

_MOST_KNOWN = 200

# Within `masking` NumPy is silent already.
_UNTOLD = contextlib.nullcontext()


class Formula(Protocol[P]):
    """A function made by `formula`.

    Attributes
    ----------
    symbol, unit, equation : str
        Of what it returns.
    source : Source or None
        Who says so.
    parameters : mapping of str to Symbol
        What it is given.
    body : callable
        The function itself, which checks nothing.
    """

    __name__: str
    symbol: str
    unit: str
    equation: str
    source: Source | None
    parameters: Mapping[str, Symbol]
    body: Callable[..., Any]

    @overload
    def __call__(self, *args: P.args, **kwargs: P.kwargs) -> Any: ...
    @overload
    def __call__(self, *args: Any, on_invalid: Invalid, **kwargs: Any) -> Any: ...


def formula(
    *,
    symbol: str,
    unit: str | Unit = "",
    equation: str = "",
    source: Source | None = None,
    result: Bounds = finite,
    because: str = "the numbers given are too large or too small together",
    error: Callable[..., InputError] | None = None,
) -> Callable[[Callable[P, Any]], Formula[P]]:
    """Make a function of annotated parameters a formula of a standard.

    Parameters
    ----------
    symbol : str
        Of what it returns.
    unit : str or Unit
        Its unit; ``""`` for a ratio.
    equation : str
        In the symbols of its parameters.
    source : Source, optional
        Who says so.
    result : Bounds
        What is a result.
    because : str
        The end of the message about a result that is none.
    error : callable, optional
        Takes the value that is not within ``result`` and all arguments by name, as numbers, and
        returns the error to raise in place of that message.
    """

    def decorate(body: Callable[P, Any]) -> Formula[P]:
        made = _Made(body, symbol, unit, result, f"{symbol} is not defined: {because}", error)

        @functools.wraps(body)
        def apply(*args: Any, on_invalid: Invalid = "raise", **kwargs: Any) -> Any:
            system = kwargs.pop("units", "si") if made.own else "si"
            given, shape = made.bind(args, kwargs, system)
            if on_invalid == "mask" and shape:
                with masking(shape) as mask:
                    values = made.evaluate(given, shape, system)
                return Masked(values, mask.reason, mask.legend)
            if on_invalid not in ("raise", "mask"):
                raise InputError(f"on_invalid is {on_invalid!r}; it must be 'raise' or 'mask'")
            kept = current_mask()
            if kept is None:
                return made.evaluate(given, shape, system)
            if not shape:
                return made.known(given, system)
            # What rests on the same arrays is worked out once.
            of, whole = (made, system, *given), tuple(given.values())
            return kept.once(lambda: made.evaluate(given, shape, system), whole, *of)

        record: dict[str, Any] = {
            "symbol": symbol,
            "unit": unit if isinstance(unit, str) else unit.si,
            "equation": equation,
            "source": source,
            "parameters": made.symbols,
            "body": body,
            "__signature__": made.signature,
            "__doc__": made.described(body.__doc__ or "", equation, source),
        }
        for name, value in record.items():
            setattr(apply, name, value)
        return cast(Formula[P], apply)

    return decorate


class _Made:
    """A decorated function in its parts."""

    def __init__(
        self,
        body: Callable[..., Any],
        symbol: str,
        unit: str | Unit,
        result: Bounds,
        undefined: str,
        error: Callable[..., InputError] | None,
    ) -> None:
        self.body, self.undefined, self.error = body, undefined, error
        self._known: dict[tuple[Any, ...], float] = {}
        self.symbols: dict[str, Symbol] = {}
        self.words: dict[str, tuple[str, ...]] = {}
        self.meanings: dict[str, str] = {}
        self.needed: list[str] = []
        for name, annotation in inspect.get_annotations(body, eval_str=True).items():
            if name == "return":
                continue
            # An optional symbol is a union with None.
            for part in (annotation, *get_args(annotation)):
                for about in getattr(part, "__metadata__", ()):
                    if isinstance(about, Symbol):
                        self.symbols[name] = about
                    elif isinstance(about, str):
                        self.meanings[name] = about
            if name in self.symbols and type(None) not in get_args(annotation):
                self.needed.append(name)
            origin: Any = get_origin(annotation)
            if origin is Literal:
                self.words[name] = get_args(annotation)
        self.result = Symbol(symbol, unit, result)
        units = [s.unit for s in (*self.symbols.values(), self.result) if isinstance(s.unit, Unit)]
        self.own = {u.system for u in units}
        self.checks = {
            system: [
                (name, within, *within.bounds.ends, size)
                for name, symbol in self.symbols.items()
                for within, size in [symbol.within(system)]
            ]
            for system in ("si", *self.own)
        }
        self.scales = {
            system: unit.scale(system) if isinstance(unit, Unit) else 1.0 for system in self.checks
        }
        parameters = list(inspect.signature(body).parameters.values())
        self.positional = [
            p.name for p in parameters if p.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD
        ]
        parameters = [p.replace(annotation=inspect.Parameter.empty) for p in parameters]
        added = {"on_invalid": "raise"} | ({"units": "si"} if self.own else {})
        parameters += [
            inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default)
            for name, default in added.items()
        ]
        self.signature = inspect.Signature(parameters)

    def bind(
        self, args: tuple[Any, ...], kwargs: dict[str, Any], system: str
    ) -> tuple[dict[str, Any], tuple[int, ...]]:
        """Return the arguments by name, numbers as floats and arrays, and their common shape."""
        given = dict(zip(self.positional, args, strict=False))
        if kwargs or len(args) > len(self.positional):
            if len(args) > len(self.positional) or not given.keys().isdisjoint(kwargs):
                inspect.signature(self.body).bind(*args, **kwargs)
            given.update(kwargs)
        arrays = {}
        for name, value in given.items():
            if name in self.symbols:
                if type(value) is np.ndarray and value.dtype == _FLOAT and value.ndim:
                    arrays[name] = value
                elif type(value) is not float and value is not None:
                    given[name] = number = real(
                        name, _in_unit(name, value, self.symbols[name], system)
                    )
                    if type(number) is not float:
                        arrays[name] = number
            elif name in self.words and value not in self.words[name]:
                allowed = self.words[name]
                raise InputError(f"{name} is {value!r}; {one_of(allowed, value)}")
        return given, common_shape(arrays) if arrays else ()

    def known(self, given: dict[str, Any], system: str) -> Any:
        """Return `evaluate` of numbers and words, remembered: beside arrays they come again."""
        values = given.values()
        kinds = [*map(type, values)]
        if not all(map(by_value, kinds)):
            return self.evaluate(given, (), system)
        # A zero of either sign is the same by value, and not to a body.
        key = system, *given, *kinds, *(one or repr(one) for one in values)
        found = self._known.get(key)
        if found is None:
            found = self.evaluate(given, (), system)
            if type(found) is float and math.isfinite(found):
                if len(self._known) >= _MOST_KNOWN:
                    self._known.clear()
                self._known[key] = found
        return found

    def evaluate(self, given: dict[str, Any], shape: tuple[int, ...], system: str) -> Any:
        """Return what the body gives for the arguments, checked before and after."""
        if system not in self.checks:
            raise InputError(f"units is {system!r}; {one_of(self.checks, system)}")
        holes: list[Any] = []
        mask = current_mask() if shape else None
        for name, symbol, lowest, highest, size in self.checks[system]:
            value = given.get(name)
            if value is None:
                continue
            if mask is not None and type(value) is np.ndarray:
                known = mask.seen(value)
                if known is None or not (lowest <= known.lowest and known.highest <= highest):
                    checked = check(name, value, symbol)
                    if checked is not value:
                        holes.append(np.isnan(checked))
                    value = checked
                elif known.holes is not None:
                    holes.append(known.holes)
            elif type(value) is not float or not lowest <= value <= highest:
                checked = check(name, value, symbol)
                if checked is not value:
                    holes.append(np.isnan(checked))
                value = checked
            if type(value) is float:
                # A Python float raises where an array has an infinite number.
                value = np.float64(value)
            if size != 1.0:
                with np.errstate(over="ignore"):
                    value = value / size
            given[name] = value
        lowest, highest = self.result.bounds.ends
        with _UNTOLD if mask is not None else np.errstate(all="ignore"):
            try:
                values = self.body(**given)
            except TypeError:
                self._refuse_none(given)
                raise
            if isinstance(values, Traced):
                return values if self.scales[system] == 1.0 else values * self.scales[system]
            if not shape:
                number = float(values)
                if lowest <= number <= highest and not holes:
                    return number * self.scales[system]
                return math.nan if holes else self._refuse(np.asarray(number), given)
            values = np.asarray(values, dtype=np.float64)
            if values.shape != shape:
                values = np.broadcast_to(values, shape).copy()
            if holes:
                hole = functools.reduce(np.logical_or, holes)
                values = np.where(hole, np.nan, values)
            if values.size and not self._holds(values, mask):
                values = self._refuse(values, given)
            scale = self.scales[system]
        return values if scale == 1.0 else values * scale

    def _holds(self, values: FloatArray, mask: Mask | None) -> bool:
        """Whether all are results, but for NaN that has its reason already."""
        lowest, highest = self.result.bounds.ends
        known = None if mask is None else mask.seen(values)
        if known is not None:
            return lowest <= known.lowest and known.highest <= highest
        return bool(values.min() >= lowest and values.max() <= highest)

    def _refuse_none(self, given: dict[str, Any]) -> None:
        for name in self.needed:
            if name in given and given[name] is None:
                raise InputError(f"{name} is None; it must be a number") from None

    def _refuse(self, values: FloatArray, given: dict[str, Any]) -> Any:
        """Return NaN in place of what is no result, or raise."""
        wrong = ~self.result.bounds.holds(values)
        mask = current_mask()
        if values.ndim and mask is not None:
            mask.refuse(wrong, self.undefined)
            return np.where(wrong, np.nan, values)
        error = InputError(self.undefined)
        if self.error is not None and np.isfinite(values[wrong].flat[0]):
            first = {
                name: float(np.broadcast_to(value, values.shape)[wrong].flat[0])
                if name in self.symbols and value is not None
                else value
                for name, value in given.items()
            }
            error = self.error(float(values[wrong].flat[0]), **first)
        if mask is None:
            raise error
        mask.refuse(True, str(error))
        return math.nan

    def _errors(self) -> list[str]:
        """What is raised, and when, each as its docstring has it."""
        words = "a word is none of those named, " if self.words or self.own else ""
        not_result = f"{words}or {self.result.symbol} is not {self.result.bounds.text()}"
        lines = ["InputError"]
        lines += [f"    A number is not allowed, arrays have no common shape, {not_result}."]
        for symbol in self.symbols.values():
            if symbol.error is not InputError:
                lines += [symbol.error.__name__, f"    {symbol.symbol}: {symbol.allowed}."]
        if self.error is not None:
            says = inspect.get_annotations(self.error, eval_str=True)
            lines += [says.get("return", InputError).__name__, f"    {self.undefined}."]
        return lines

    def described(self, text: str, equation: str, source: Source | None) -> str:
        """Return a docstring with its sections of parameters, results, errors and source."""
        before, heading, examples = inspect.cleandoc(text).partition("\nExamples\n")
        summary, _, more = before.partition("\n")
        lines = [summary, ""]
        if equation:
            lines += [f"``{self.result.symbol} = {equation}``", ""]
        lines += [more.strip(), ""] if more.strip() else []
        lines += ["Parameters", "----------"]
        array = "array_like, broadcast together" if len(self.symbols) > 1 else "array_like"
        for name, parameter in self.signature.parameters.items():
            if name in self.symbols:
                symbol = self.symbols[name]
                optional = "" if parameter.default is inspect.Parameter.empty else ", optional"
                unit = _named(symbol.unit)
                lines += [f"{name} : {array}{optional}", f"    {symbol.symbol}{unit};"]
                lines[-1] += f" {symbol.allowed.removeprefix('it must be ')}."
            elif name in self.words:
                lines += [f"{name} : {{{', '.join(map(repr, self.words[name]))}}}", ""]
            elif name in self.meanings:
                lines += [f"{name} : {type(parameter.default).__name__}", ""]
                lines[-1] = f"    {self.meanings[name]}."
        if self.own:
            lines += ["units : {'si', " + ", ".join(map(repr, sorted(self.own))) + "}"]
            lines += ["    Of arguments and result; the second in brackets."]
        lines += ["on_invalid : {'raise', 'mask'}"]
        lines += ["    What to do with elements of arrays that are not allowed."]
        lines += ["", "Returns", "-------", "float, or ndarray or Masked of their common shape"]
        lines += [f"    {self.result.symbol}{_named(self.result.unit)}."]
        lines += ["", "Raises", "------", *self._errors()]
        if source is not None:
            lines += ["", "Notes", "-----", f"{source}."]
        if heading:
            lines += ["", "Examples", *examples.split("\n")]
        return "\n".join(lines)


def _in_unit(name: str, value: Any, symbol: Symbol, system: str) -> Any:
    """Return a text or a quantity with a unit as a number in that of a symbol."""
    unit = symbol.unit
    if isinstance(unit, Unit):
        unit = unit.si if system == "si" else unit.own
    if not unit or not (isinstance(value, str) or is_quantity(value)):
        return value
    try:
        return to_si(value, unit)
    except InputError as error:
        raise InputError(f"{name} is {shown(value)}: {error}") from None


def _named(unit: str | Unit) -> str:
    if isinstance(unit, Unit):
        return f", {unit.si} [{unit.own}]"
    return f", {unit}" if unit else ""
