r"""A formula of a standard: a plain function, and one decorator that says what it is.

A symbol is declared once, with its unit and what is allowed::

    T_2 = Annotated[Real, Symbol("T_2", "N m", positive)]

and a formula is its docstring and its body::

    @formula(symbol="P_Vz", unit="W", equation="0.1 T_2 n_1/u (1/eta - 1)", source=VERIFIED)
    def meshing_loss(wheel_torque: T_2, worm_speed: n_1, ratio: u, efficiency: eta) -> Real:
        '''Power lost between the teeth, worm driving.'''
        return 0.1 * wheel_torque * worm_speed / ratio * (1.0 / efficiency - 1.0)

From these come

- numbers and arrays: numbers give a float, arrays broadcast; the body sees NumPy floats or arrays,
  so that it divides by zero without an exception;
- checks: what is not allowed is an InputError of one line, and so is a result that is not finite or
  not within ``result`` (then ``because`` ends the message, or ``error`` makes it); a parameter
  annotated with a `typing.Literal` takes its words only; None is left alone;
- masks: with ``on_invalid="mask"`` arrays give a `Masked`, NaN with the reason of each. Within
  ``with masking(shape) as mask:`` all formulas do so, one after another, and ``mask`` keeps the
  first reason of each element: a chain of formulas is written once, as plain calls;
- units: a `Unit` in place of a unit's name makes the formula take ``units="si"`` or its own
  system, in which the body is written;
- the record: ``meshing_loss.symbol``, ``.unit``, ``.equation``, ``.source``, ``.parameters``, and
  the sections of its docstring.

A body whose bounds are not known before it runs (the ends of a table) checks by `check`.

:Entry: `formula` and `Symbol`.
:Data: none; symbols stand in the `symbols` of each standard.
:Where: `masks` (arrays that may hold nonsense), `traced` (a calculation as a spreadsheet's
    formulas).
:Tests: `unit/test_formulas`, `unit/test_workbook`.
"""

from asperity.formulas.formula import Formula, formula
from asperity.formulas.masks import (
    Invalid,
    Mask,
    Masked,
    Reasons,
    check,
    common_shape,
    current_mask,
    masking,
    once,
    real,
)
from asperity.formulas.symbols import (
    Bounds,
    Symbol,
    Unit,
    acute,
    finite,
    not_negative,
    positive,
)

__all__ = [
    "Bounds",
    "Formula",
    "Invalid",
    "Mask",
    "Masked",
    "Reasons",
    "Symbol",
    "Unit",
    "acute",
    "check",
    "common_shape",
    "current_mask",
    "finite",
    "formula",
    "masking",
    "not_negative",
    "once",
    "positive",
    "real",
]
