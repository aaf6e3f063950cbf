"""What the units of measurement are worth, in a list that pint reads too.

Most text is read here, because pint takes half a second to load; what this reader does not know,
or what does not fit together, is left to pint.
"""

import functools
import re
from collections import Counter
from collections.abc import Mapping
from decimal import Decimal
from types import MappingProxyType
from typing import NamedTuple

# A list of our own, because the one that ships with pint has no dimension for the angle, and
# takes ten times as long to load.
DEFINITIONS = """
pico- = 1e-12 = p-
nano- = 1e-9 = n-
micro- = 1e-6 = \u00b5- = \u03bc- = u-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
deci- = 1e-1 = d-
hecto- = 1e2 = h-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
meter = [length] = m = metre
second = [time] = s = sec
gram = [mass] = g
kelvin = [temperature]; offset: 0 = K
ampere = [current] = A
radian = [angle] = rad
percent = 0.01 = %
degree = 3.14159265358979323846264338327950288 / 180 * radian = deg = \u00b0
arcminute = degree / 60 = arcmin
turn = 360 * degree = rev = revolution
minute = 60 * second = min
hour = 60 * minute = h = hr
hertz = 1 / second = Hz
rpm = turn / minute
newton = kilogram * meter / second ** 2 = N
newton_meter = newton * meter = Nm
pascal = newton / meter ** 2 = Pa
bar = 1e5 * pascal
joule = newton * meter = J
watt = joule / second = W
volt = watt / ampere = V
ohm = volt / ampere
farad = ampere * second / volt = F
tonne = 1000 * kilogram = t
liter = 1e-3 * meter ** 3 = l = L
poise = 0.1 * pascal * second = P
stokes = 1e-4 * meter ** 2 / second = St
degree_Celsius = kelvin; offset: 273.15 = \u00b0C = degC
degree_Fahrenheit = 5 / 9 * kelvin; offset: 255.372222222222222222222222222222 = \u00b0F = degF
rankine = 5 / 9 * kelvin = degR
standard_gravity = 9.80665 * meter / second ** 2 = g_n
inch = 0.0254 * meter = in
foot = 12 * inch = ft
pound = 0.45359237 * kilogram = lb
pound_force = pound * standard_gravity = lbf
psi = pound_force / inch ** 2
ksi = 1000 * psi
british_thermal_unit = 1055.05585262 * joule = BTU = Btu
acre = 43560 * foot ** 2
horsepower = 550 * foot * pound_force / second = hp
"""

_FACTOR = re.compile(
    r"(?:^|\s*(?P<sign>[*/\u00b7])\s*|\s+)"
    r"(?:(?P<number>[0-9.]+(?:e-?[0-9]+)?)|(?P<name>[^\W\d]\w*|[%\u00b0]))"
    r"(?:\s*(?:\*\*|\^)\s*(?P<power>-?[1-9][0-9]?))?"
)
# What is divided by together, and what stands between its factors.
_DIVISOR = re.compile(r"/\s*\(([^()/]+)\)")
_TIMES = re.compile(r"\s*(?<!\*)[*\u00b7](?!\*)\s*|(?<![*^\s])\s+(?![*^\s])")


class Measure(NamedTuple):
    """A unit: its size in base units, their powers, and where its scale begins in base units."""

    size: Decimal = Decimal(1)
    powers: Mapping[str, int] = MappingProxyType({})
    zero: Decimal = Decimal(0)


def convert(number: str, given: str, wanted: str) -> Decimal | None:
    """Return a number of one unit in another; None where this reader cannot tell."""
    one, other = measure(given), measure(wanted)
    if one is None or other is None or one.powers != other.powers:
        return None
    if one.zero == other.zero:
        return Decimal(number) * (one.size / other.size)
    return (Decimal(number) * one.size + one.zero - other.zero) / other.size


@functools.cache
def measure(text: str, *, numbers: bool = False) -> Measure | None:
    """Return what a unit such as ``"kN/mm**2"`` is worth; None where this reader cannot tell.

    Parameters
    ----------
    text : str
        Names and their powers, multiplied or divided.
    numbers : bool
        Whether numbers other than 1 may stand among them, as they do in a definition.
    """
    text = _DIVISOR.sub(lambda found: "/" + _TIMES.sub("/", found[1].strip()), text)
    size, powers, end = Decimal(1), Counter[str](), 0
    while end < len(text):
        factor = _FACTOR.match(text, end)
        if factor is None or (factor["sign"] and not end):
            return None
        if factor["number"] not in (None, "1") and not numbers:
            return None
        unit = Measure(Decimal(factor["number"])) if factor["number"] else _named(factor["name"])
        if unit is None:
            return None
        if unit.zero:
            return unit if factor["name"] == text else None
        power = int(factor["power"] or 1) * (-1 if factor["sign"] == "/" else 1)
        size *= unit.size**power
        powers.update({name: power * own for name, own in unit.powers.items()})
        end = factor.end()
    return Measure(size, {name: power for name, power in powers.items() if power})


@functools.cache
def listed() -> tuple[dict[str, Decimal], dict[str, str]]:
    """Return the prefixes, and the definition of each unit by each of its names."""
    prefixes: dict[str, Decimal] = {}
    units: dict[str, str] = {}
    for line in DEFINITIONS.strip().splitlines():
        name, definition, *others = line.split(" = ")
        for called in (name, *others):
            if called.endswith("-"):
                prefixes[called.removesuffix("-")] = Decimal(definition)
            else:
                units[called] = definition
    return prefixes, units


@functools.cache
def _named(name: str) -> Measure | None:
    prefixes, units = listed()
    if name in units:
        definition, _, zero = units[name].partition("; offset: ")
        base = Measure(powers={definition: 1}) if definition.startswith("[") else None
        unit = base or measure(definition, numbers=True)
        return unit and unit._replace(zero=Decimal(zero or 0))
    split = [
        (size, name.removeprefix(prefix))
        for prefix, size in prefixes.items()
        if name.startswith(prefix) and name.removeprefix(prefix) in units
    ]
    unit = _named(split[0][1]) if len(split) == 1 else None
    return None if unit is None or unit.zero else unit._replace(size=split[0][0] * unit.size)
