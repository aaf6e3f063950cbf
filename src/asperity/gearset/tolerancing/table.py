"""The `[tolerances]` table: how far worm, wheel and housing may be from their numbers."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, ValidationInfo, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.gearset.tolerancing.grades import Grade
from asperity.gearset.tolerancing.iso286 import symmetric_grade
from asperity.units import Quantity, split_unit, to_si

Fit = Literal["H", "E", "D", "C", "B", "A"]
Housing = Literal["cast iron", "steel", "aluminium"]

_WIDEST = 0.01
_REFERENCE = 293.15


def _deviation(value: object) -> str:
    """Return a symmetric deviation as one text: ``js7``, or the length in metres."""
    expected = "it must be a symmetric deviation such as 'js7', or a length such as '17.5 um'"
    if not isinstance(value, str):
        raise InputError(expected)
    grade = symmetric_grade(value)
    if grade is not None:
        return f"js{grade}"
    if split_unit(value) is None:
        raise InputError(expected)
    try:
        size = to_si(value, "m", bare="refuse")
    except InputError:
        raise InputError(expected) from None
    if not 0.0 <= size <= _WIDEST:
        raise InputError(f"it must be zero or positive and at most {1e3 * _WIDEST:g} mm")
    return f"{size!r} m"


def _length(example: str, **bounds: float) -> Quantity:
    return Quantity("m", what="a length", example=example, **bounds)


_Allowance = Annotated[float, _length("-40 um", ge=-_WIDEST, le=0.0)]
_Temperature = Annotated[
    float, Quantity("K", what="a temperature", example="60 degC", gt=173.15, lt=573.15)
]
_Pair = tuple[_Allowance, _Allowance]


def _two(value: object) -> object:
    if value is not None and not (isinstance(value, list | tuple) and len(value) == 2):
        raise InputError("it must be a list of two lengths, as ['-40 um', '-70 um']")
    return value


Allowances = Annotated[_Pair, BeforeValidator(_two, json_schema_input_type=_Pair)]
"""Upper and lower allowance, m, neither above zero."""


class Temperatures(Table):
    """Temperatures of a gearbox as it runs.

    Parameters
    ----------
    housing : float or str
        K; 20 degC if left out.
    gears : float or str
        Of worm and wheel alike, K; 20 degC if left out.
    """

    table: ClassVar[str] = "tolerances.temperatures"

    housing: _Temperature = _REFERENCE
    gears: _Temperature = _REFERENCE


def _temperatures(value: object, info: ValidationInfo[Any]) -> Temperatures | None:
    if value is None or isinstance(value, Temperatures):
        return value
    if not isinstance(value, Mapping):
        raise InputError("it must be a table such as { housing = '60 degC', gears = '70 degC' }")
    return Temperatures.model_validate(value, context=info.context)


class Tolerances(Table):
    r"""How far a gearset may be from its numbers; what is left out has no deviation.

    Parameters
    ----------
    centre_distance : str, optional
        To either side: a symmetric deviation of ISO 286 such as "js7", or a length.
    thread : list of two float or str, optional
        Upper and lower allowance of the worm's normal thread thickness :math:`E_{sn1}`, m, neither
        above zero. Left out: from zero to the tolerance of ``measuring``, or as ``fit`` asks.
    tooth : list of two float or str, optional
        The same of the wheel's thickness on the mean circle :math:`E_{s2}`, m.
    fit : {'H', 'E', 'D', 'C', 'B', 'A'}, optional
        Fit of GOST 3675, whose least normal backlash the upper allowance of the thread then leaves
        in the worst case. Give this or ``thread``.
    grade : int, optional
        Grade of accuracy of pitch, helix and profile, as it stands on the drawing: 6 to 9.
    axial_offset : float or str
        By how much the worm may stand off the wheel's mid-plane to either side, m; 0 if left out.
    shaft_angle : float or str
        By how much the shaft angle may differ from 90 deg to either side, rad; 0 if left out.
    temperatures : table, optional
        ``housing`` and ``gears`` as they run. Left out, nothing is said of the warm gearbox.
    housing : {'cast iron', 'steel', 'aluminium'}
        What the housing is made of.
    """

    table: ClassVar[str] = "tolerances"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("thread", "fit"),)

    centre_distance: (
        Annotated[str, BeforeValidator(_deviation, json_schema_input_type=str)] | None
    ) = None
    thread: Allowances | None = None
    tooth: Allowances | None = None
    fit: Fit | None = None
    grade: Grade | None = None
    axial_offset: Annotated[float, _length("20 um", ge=0.0, le=_WIDEST)] = 0.0
    shaft_angle: Annotated[
        float,
        Quantity("rad", what="an angle", example="0.02 deg", ge=0.0, le=math.radians(5.0)),
    ] = 0.0
    temperatures: Annotated[Temperatures, BeforeValidator(_temperatures)] | None = None
    housing: Housing = "cast iron"

    @model_validator(mode="after")
    def _ordered(self) -> "Tolerances":
        for key in ("thread", "tooth"):
            given = getattr(self, key)
            if given is not None and given[1] > given[0]:
                raise InputError(
                    f"tolerances.{key} is {shown([f'{1e6 * v:g} um' for v in given])}; it must be "
                    "the upper allowance and then the lower one, which is not above it"
                )
        return self
