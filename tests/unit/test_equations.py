"""The equation that a formula shows is the one it calculates."""

import math
import re

import numpy as np
import pytest

from asperity.gearset import relations
from asperity.rating import agma6034, bs721, iso14521, shaft
from asperity.rating.iso14521 import hertz

FUNCTIONS = {
    "sqrt": math.sqrt,
    "tan": math.tan,
    "atan": math.atan,
    "acos": math.acos,
    "cos": math.cos,
    "sin": math.sin,
    "asin": math.asin,
    "exp": math.exp,
    "min": min,
    "max": max,
}
WORDS = {"if", "else"}
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
    "bs721.friction",
    "wear_speed_factor",
    "zone_factor",
    "strength_speed_factor",
    "materials_factor",
    "lewis_form_factor",
    "maximum_lead_angle",
}


def formulas():
    for module in (relations, iso14521, hertz, shaft, bs721, agma6034):
        for name, thing in sorted(vars(module).items()):
            said = f"{module.__name__.rpartition('.')[2]}.{name}"
            if hasattr(thing, "equation") and not {name, said} & ABRIDGED:
                yield pytest.param(thing, id=said)


def value(equation, numbers):
    """Value of an equation as it is shown: a space multiplies, ``^`` is a power."""
    names = {symbol: f"v{n}" for n, symbol in enumerate(numbers)}
    text, before = "", "("
    for token in TOKEN.findall(equation):
        starts = token not in WORDS and (token[0].isalnum() or token == "(")
        ended = before not in WORDS and (before[0].isalnum() or before[-1] in "*)")
        if starts and ended and before not in FUNCTIONS:
            text += "*"
        text += {"^": "**"}.get(token, names.get(token, f" {token} " if token in WORDS else token))
        before = token
    given = {names[symbol]: number for symbol, number in numbers.items()}
    return eval(text, {"__builtins__": {}}, {**FUNCTIONS, "pi": math.pi, **given})


# Where any numbers within the bounds of each would not do together.
TOGETHER = {
    relations.worm_reach: {"wheel_outside_diameter": 9.0, "worm_tip_diameter": 3.0},
    relations.reference_chord: {"diameter_factor": 8.0},
    iso14521.efficiency.worm_driving_efficiency: {"mean_friction": 0.1},
    iso14521.forces.worm_tangential_force: {"lead_angle": 0.3},
    iso14521.strength.worm_deflection: {"lead_angle": 0.3},
    bs721.torque.root_arc: {"worm_tip_diameter": 3.0},
    agma6034.forces.friction_force: {"lead_angle": 0.3, "pressure_angle": 0.3},
    agma6034.forces.worm_tangential_load: {"lead_angle": 0.3, "pressure_angle": 0.3},
}
# A number within each piece of what is defined by pieces.
PIECES = {
    agma6034.mesh.friction: (0.0, 0.03, 0.06),
    agma6034.capacity.ratio_correction_factor: (10.0, 50.0, 100.0),
    agma6034.capacity.velocity_factor: (1.0, 8.0, 20.0),
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


@pytest.mark.parametrize("formula", PIECES, ids=lambda formula: formula.__name__)
def test_the_equation_shown_is_the_one_calculated_in_each_piece(formula):
    (symbol,) = formula.parameters.values()
    for number in PIECES[formula]:
        shown = value(formula.equation, {symbol.symbol: number})
        assert formula(number) == pytest.approx(shown, rel=1e-12)
