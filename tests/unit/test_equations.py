"""The equation that a formula shows is the one it calculates."""

import math
import re

import numpy as np
import pytest

from asperity.gearset import relations
from asperity.rating import hertz, iso14521, shaft

FUNCTIONS = {
    "sqrt": math.sqrt,
    "tan": math.tan,
    "atan": math.atan,
    "acos": math.acos,
    "cos": math.cos,
    "sin": math.sin,
    "min": min,
    "max": max,
}
TOKEN = re.compile(r"\d+\.?\d*(?:e-?\d+)?|[A-Za-z]\w*\*?|\S")
# What these show is abridged, a table, or of one case among several.
ABRIDGED = {
    "base_friction",
    "reference_wear_intensity",
    "film_parameter",
    "contact_parameter",
    "sump_temperature",
    "heat_transfer_coefficient",
    "lubricant_structure_factor",
    "root_thickness",
    "rim_factor",
    "worm_contact_stress",
}


def formulas():
    for module in (relations, iso14521, hertz, shaft):
        for name, thing in sorted(vars(module).items()):
            if hasattr(thing, "equation") and name not in ABRIDGED:
                yield pytest.param(thing, id=f"{module.__name__.rpartition('.')[2]}.{name}")


def value(equation, numbers):
    """Value of an equation as it is shown: a space multiplies, ``^`` is a power."""
    names = {symbol: f"v{n}" for n, symbol in enumerate(numbers)}
    text, before = "", "("
    for token in TOKEN.findall(equation):
        starts = token[0].isalnum() or token == "("
        if starts and (before[0].isalnum() or before[-1] in "*)") and before not in FUNCTIONS:
            text += "*"
        text += {"^": "**"}.get(token, names.get(token, token))
        before = token
    given = {names[symbol]: number for symbol, number in numbers.items()}
    return eval(text, {"__builtins__": {}}, {**FUNCTIONS, "pi": math.pi, **given})


# Where any numbers within the bounds of each would not do together.
TOGETHER = {
    relations.worm_reach: {"wheel_outside_diameter": 9.0, "worm_tip_diameter": 3.0},
    relations.reference_chord: {"diameter_factor": 8.0},
    iso14521.worm_driving_efficiency: {"mean_friction": 0.1},
    iso14521.worm_tangential_force: {"lead_angle": 0.3},
    iso14521.worm_deflection: {"lead_angle": 0.3},
}


@pytest.mark.parametrize("formula", list(formulas()))
def test_the_equation_shown_is_the_one_calculated(formula):
    rng = np.random.default_rng(14521)
    for _ in range(5):
        given = {}
        for name, symbol in formula.parameters.items():
            lower, upper = symbol.bounds.ends
            lowest = max(lower, 0.2)
            given[name] = rng.uniform(lowest, min(upper, 3.0 * lowest + 1.0))
        given |= TOGETHER.get(formula, {})
        numbers = {formula.parameters[name].symbol: number for name, number in given.items()}
        assert formula(**given) == pytest.approx(value(formula.equation, numbers), rel=1e-12)
