"""Units at the edge: text with a unit comes in, floats in SI go on.

Inside the package every quantity is a plain float in SI units; an angle is in radians and a
frequency in cycles per second. In Python a bare number is refused as it is in a file, unless its
unit is named: see :class:`Named`. Angles have a dimension of their own here, so that ``45 deg`` is
not taken for a ratio, nor ``4 kHz`` for an angular speed.
"""

import dataclasses
import functools
import math
import numbers
import re
import typing
from collections.abc import Iterator, Mapping
from decimal import Decimal
from typing import TYPE_CHECKING, Any

from asperity.errors import InputError, shown
from asperity.units import measures

if TYPE_CHECKING:
    from pydantic import BaseModel, GetCoreSchemaHandler, ValidationInfo
    from pydantic_core import CoreSchema

_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,4})?(?![0-9.])")
_COMMA = re.compile(r"\s*[+-]?[0-9]*,[0-9]+(?![0-9.,])")
_UNIT = re.compile(r"[A-Za-z\u00b5\u03bc\u00b0%\u00b7\u00b2\u00b3*/^() 0-9-]{0,60}")
_A_MINUTE = frozenset(("1/min", "/min", "min^-1", "min**-1"))
# "2000 lb-in" is a torque as it is written in the US, a pound that of a force.
_TORQUE = re.compile(r"lbf?[- \u00b7*]?(in|ft)|(in|ft)[- \u00b7*]?lbf?")
_DEGREE = re.compile(r"\bdeg([CF])\b")
_DIFFERENCE = {"C": "K", "F": "degR"}
_PLAIN_POWER = re.compile(r"(?<=[A-Za-z])([23])(?![0-9])")
LARGEST = 1e30
"""In SI, either way: nothing of a machine is larger, and more is meant by nobody."""


@functools.cache
def registry() -> Any:
    """Return what pint makes of the list of units."""
    import pint

    # Decimals make the result the float nearest to what was written: 1 us is 1e-6 exactly.
    made: Any = pint.UnitRegistry(None, non_int_type=Decimal)
    made.load_definitions(measures.DEFINITIONS.splitlines())
    made._build_cache()
    return made


def split_unit(text: str) -> tuple[str, str] | None:
    """Split ``"0.5 mm/s"`` into ``("0.5", "mm/s")``; None if it does not begin with a number."""
    text = text.strip()
    number = _NUMBER.match(text)
    return (number.group(), text[number.end() :].strip()) if number else None


@functools.lru_cache(maxsize=512)
def _convert(number: str, given: str, unit: str) -> float:
    if not _UNIT.fullmatch(given):
        raise InputError(f"{given!r} is not a unit")
    text = _PLAIN_POWER.sub(r"**\1", re.sub("\u00b0([CF])", r"deg\1", given))
    if unit == "rad/s" and text.replace(" ", "") in _A_MINUTE:
        # Of turns, as standards write a speed of rotation.
        text = "rpm"
    if unit == "N m" and (torque := _TORQUE.fullmatch(text)):
        text = f"lbf*{torque[1] or torque[2]}"
    if not _DEGREE.fullmatch(text):
        # Of "W/m**2/degC" the degree is one of a difference.
        text = _DEGREE.sub(lambda found: _DIFFERENCE[found[1]], text)
    converted = measures.convert(number, text, unit)
    if converted is not None:
        return float(converted)
    import pint

    try:
        quantity = registry().Quantity(Decimal(number), registry().parse_units(text))
        return float(quantity.to(unit).magnitude)
    except pint.DimensionalityError:
        raise InputError(f"{given!r} does not convert to {unit or 'a plain number'}") from None
    except Exception:
        # pint hands the text to a tokenizer and an expression parser, each with errors of its own.
        raise InputError(f"{given!r} is not a unit") from None


def _from_text(text: str, unit: str, bare: str | None) -> float:
    parts = split_unit(text)
    if parts is None:
        raise InputError(f"{shown(text)} is not a number{' with a unit' if unit else ''}")
    number, given = parts
    if given or not unit:
        return _convert(number, given, unit) if given else float(number)
    if bare is None or bare == "refuse":
        raise InputError(f"{shown(text)} has no unit; give one that converts to {unit}")
    return _convert(number, bare, unit)


def _from_pint(value: Any, unit: str) -> float:
    try:
        number = repr(float(value.magnitude))
    except (TypeError, ValueError):
        raise InputError(f"{shown(value)} is not one number") from None
    # Whatever registry it is of, so that it comes to the same bits as the text.
    try:
        return _convert(number, f"{value.units:~C}", unit)
    except InputError:
        return _convert(number, str(value.units), unit)


def is_quantity(value: object) -> bool:
    """Return whether something is a quantity of pint, of whatever registry."""
    return hasattr(value, "magnitude") and hasattr(value, "units")


def to_si(value: object, unit: str, *, bare: str | None = None) -> float:
    """Return a quantity as a float in SI units.

    Parameters
    ----------
    value : str, float or quantity of pint
        Text such as ``"0.5 mm/s"``, a number, or a quantity of any of pint's registries.
    unit : str
        SI unit of the result: ``"m/s"``; ``"rad"`` for an angle, ``"Hz"`` for cycles per second,
        ``"K"`` for an absolute temperature, ``""`` for a ratio.
    bare : str, optional
        What a number without unit means: SI (None, numbers only: text still needs its unit),
        a quantity in this unit, or a mistake (``"refuse"``). A ratio is always a bare number.

    Raises
    ------
    InputError
        Wrong dimension, unknown unit, not a number, not finite.

    Examples
    --------
    >>> to_si("0.5 mm/s", "m/s")
    0.0005
    >>> to_si(180, "rad", bare="deg")
    3.141592653589793
    """
    if is_quantity(value):
        result = _from_pint(value, unit)
    elif isinstance(value, bool) or not isinstance(value, str | numbers.Real):
        raise InputError(f"{shown(value)} is not a number{' with a unit' if unit else ''}")
    elif isinstance(value, str):
        result = _from_text(value, unit, bare)
    else:
        try:
            result = float(value)
        except OverflowError:
            raise InputError(f"{shown(value)} is too large") from None
        if unit and bare == "refuse":
            raise InputError(f"{shown(value)} has no unit; give one that converts to {unit}")
        if unit and bare is not None and math.isfinite(result):
            result = _from_text(repr(result), unit, bare)
    if not math.isfinite(result):
        raise InputError(f"{shown(value)} is not finite")
    # Without the sign of a negative zero, equal cases have equal text and so equal cache entries.
    return result + 0.0


class Held(float):
    """A number that has been checked and is in SI already."""


class Named:
    """The units that are named for bare numbers in Python.

    Parameters
    ----------
    units : str, sequence of str or mapping, optional
        ``"SI"`` for all of them; units such as ``"mm, rpm, N m"``, of which each number takes the
        one that fits what it is; or a unit by key. Left out: a bare number is a mistake.

    Raises
    ------
    InputError
        One of them is no unit, or two are of the same kind.

    Examples
    --------
    >>> Named("mm, rpm").of("centre_distance", "m")
    'mm'
    """

    def __init__(self, units: object = None) -> None:
        self._by_key: dict[str, str] = {}
        self._listed: tuple[str, ...] = ()
        self._si = units == "SI"
        if units is None or self._si:
            return
        if isinstance(units, Mapping):
            self._by_key = {str(key): str(unit) for key, unit in units.items()}
        elif isinstance(units, str):
            self._listed = tuple(part.strip() for part in units.split(","))
        elif isinstance(units, list | tuple) and all(isinstance(unit, str) for unit in units):
            self._listed = tuple(units)
        else:
            raise InputError(
                f"units is {shown(units)}; it must be 'SI', units such as 'mm, rpm', or a unit by "
                "key"
            )
        for unit in (*self._by_key.values(), *self._listed):
            if measures.measure(unit) is None:
                raise InputError(f"units names {shown(unit)}, which is not a unit")
        kinds = [_kind(unit) for unit in self._listed]
        for place, unit in enumerate(self._listed):
            if kinds[place] in kinds[:place]:
                other = self._listed[kinds.index(kinds[place])]
                raise InputError(
                    f"units names {other!r} and {unit!r}, which are of one kind; name the keys, as "
                    f"in units={{'key': {unit!r}}}"
                )

    def of(self, key: str, unit: str) -> str | None:
        """Return the unit of a bare number by its key and SI unit; None where none is named."""
        if self._si:
            return unit
        fitting = (named for named in self._listed if _kind(named) == _kind(unit))
        return self._by_key.get(key) or next(fitting, None)


def _kind(unit: str) -> Mapping[str, int]:
    found = measures.measure(unit)
    return {} if found is None else found.powers


@dataclasses.dataclass(frozen=True)
class Quantity:
    """Annotation that makes a float field of a pydantic model a quantity with a unit.

    None may be above 1e30 in SI either way, whatever its bounds: what is calculated with such a
    number overflows.

    The model takes text with a unit, a quantity of pint, or a number in SI units. As validation
    context ``{"text_only": True}`` is that of a file: what has a unit must be text, a ratio may be
    a number; ``{"units": Named(...)}`` is that of Python: the unit of a number must be named.

    Parameters
    ----------
    unit : str
        SI unit of the stored float; ``""`` for a ratio.
    what : str
        The quantity with its article, as it reads in a message.
    example : str
        A value that would be right, in the unit that messages write bounds in.
    gt, ge, lt, le : float, optional
        Bounds in SI units: above, at least, below, at most.

    Examples
    --------
    >>> from typing import Annotated
    >>> Velocity = Annotated[float, Quantity("m/s", gt=0)]
    """

    unit: str
    what: str = "a velocity"
    example: str = "0.5 mm/s"
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None

    def expected(self) -> str:
        """Return what a right value is, as the end of a message."""
        return f"it must be {self.what} such as " + (
            f"'{self.example}'" if self.unit else self.example
        )

    def bounds(self) -> str:
        """Return the bounds in the example's unit, as the end of a message."""
        limits = {"above": self.gt, "at least": self.ge, "below": self.lt, "at most": self.le}
        given = {word: limit for word, limit in limits.items() if limit is not None}
        if given == {"above": 0}:
            return "it must be positive"
        if given == {"at least": 0}:
            return "it must be zero or positive"
        unit = (split_unit(self.example) or ("", self.unit))[1] if self.unit else ""
        zero, one = (_convert(n, unit, self.unit) if unit else float(n) for n in ("0", "1"))
        texts = [
            f"{word} {(limit - zero) / (one - zero):g} {unit}".strip()
            for word, limit in given.items()
        ]
        return f"it must be {' and '.join(texts)}"

    def text(self, value: float) -> str:
        """Return a value in SI as text in the example's unit, or in SI where that is not exact."""
        unit = (split_unit(self.example) or ("", self.unit))[1]
        zero, one = to_si(f"0 {unit}", self.unit), to_si(f"1 {unit}", self.unit)
        written = f"{(value - zero) / (one - zero):.12g} {unit}"
        exact = math.isfinite(value) and to_si(written, self.unit) == value
        return written if exact else f"{value!r} {self.unit}"

    def named(self) -> str:
        """Return the ways to give a right value in Python, as the end of a message."""
        unit = (split_unit(self.example) or ("", self.unit))[1]
        return (
            f"it must be {self.what} with its unit: as text such as '{self.example}', as a "
            f"quantity of pint, or as a number with units='{unit}'"
        )

    def check(
        self,
        value: object,
        *,
        text_only: bool = False,
        named: Named | None = None,
        key: str = "",
    ) -> float:
        """Return the value in SI units, or raise InputError saying what it must be.

        Parameters
        ----------
        value : object
            Text, number or quantity of pint.
        text_only : bool
            Whether a number without unit is refused.
        named : Named, optional
            The units of numbers without one, for the key that it is.
        key : str
            Name of the key.
        """
        bare = "refuse" if text_only else None
        number = isinstance(value, numbers.Real) and not isinstance(value, Held | bool)
        if named is not None and self.unit and number:
            bare = named.of(key, self.unit)
            if bare is None:
                raise InputError(self.named())
            bare = None if bare == self.unit else bare
        try:
            result = to_si(value, self.unit, bare=bare)
        except InputError:
            comma = isinstance(value, str) and _COMMA.match(value)
            point = ", with a point in place of the comma" if comma else ""
            raise InputError(self.expected() + point) from None
        if (
            (self.gt is not None and not result > self.gt)
            or (self.ge is not None and not result >= self.ge)
            or (self.lt is not None and not result < self.lt)
            or (self.le is not None and not result <= self.le)
        ):
            raise InputError(self.bounds())
        if abs(result) > LARGEST:
            either_way = "" if self.gt is not None or self.ge is not None else " either way"
            most = f"{LARGEST:g} {self.unit}".rstrip()
            raise InputError(
                f"it must be at most {most}{either_way}; look at its unit and exponent"
            )
        return result

    def __get_pydantic_core_schema__(
        self, source: Any, handler: "GetCoreSchemaHandler"
    ) -> "CoreSchema":
        from pydantic_core import core_schema

        def validate(value: object, info: "ValidationInfo[Any]") -> float:
            context = info.context or {}
            return self.check(
                value,
                text_only=bool(context.get("text_only")),
                named=context.get("units"),
                key=info.field_name or "",
            )

        return core_schema.with_info_plain_validator_function(validate)


def bounds_of(quantity: Quantity) -> dict[str, float]:
    """Return the bounds that a quantity has, in SI, by ``gt``, ``ge``, ``lt`` and ``le``."""
    limits = {name: getattr(quantity, name) for name in ("gt", "ge", "lt", "le")}
    return {name: float(limit) for name, limit in limits.items() if limit is not None}


def _quantities(annotation: Any) -> Iterator[Quantity]:
    if isinstance(annotation, Quantity):
        yield annotation
    for part in typing.get_args(annotation):
        yield from _quantities(part)


@functools.cache
def quantity_of(model: "type[BaseModel]", field: str) -> Quantity | None:
    """Return the quantity a field of a model is; None for an unknown field or one without."""
    info = model.model_fields.get(field)
    if info is None:
        return None
    found = [item for item in info.metadata if isinstance(item, Quantity)]
    found += _quantities(info.annotation)
    return found[0] if found else None


def unit_of(model: "type[BaseModel]", field: str) -> str | None:
    """Return the SI unit of a field of a model; None for an unknown field or one without."""
    quantity = quantity_of(model, field)
    return quantity.unit if quantity else None
