import itertools
import logging
import math
import subprocess
import sys
from decimal import Decimal
from typing import Annotated

import numpy as np
import pydantic
import pytest

from asperity.errors import InputError
from asperity.units import Quantity, measures, quantity_of, registry, split_unit, to_si, unit_of


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("0.5 mm/s", "m/s", 0.5e-3),
        ("1.8 m/h", "m/s", 0.5e-3),
        ("4 kHz", "Hz", 4000.0),
        ("96068 N/m", "N/m", 96068.0),
        ("80 MN/m", "N/m", 80e6),
        ("0 N s/m", "N s/m", 0.0),
        ("68.75 nm", "m", 6.875e-8),
        ("1 us", "s", 1e-6),
        ("1 \u00b5s", "s", 1e-6),
        ("1\u03bcs", "s", 1e-6),
        ("20 degC", "K", 293.15),
        ("32 degF", "K", 273.15),
        ("212 \u00b0F", "K", 373.15),
        ("-40 degF", "K", 233.15),
        ("20 \u00b0C", "K", 293.15),
        ("270 deg", "rad", 1.5 * math.pi),
        ("45\u00b0", "rad", 0.25 * math.pi),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("4394 Nm/rad", "N m/rad", 4394.0),
        ("194.3 N/mm2", "Pa", 194.3e6),
        ("194.3 N/mm^2", "Pa", 194.3e6),
        ("50 cSt", "m^2/s", 50e-6),
        ("1e-3 m", "m", 1e-3),
        ("-.5 m", "m", -0.5),
        ("71 %", "", 0.71),
        ("0.71", "", 0.71),
        ("1 lb-in", "N m", 0.1129848290276167),
        ("1 lbf-in", "N m", 0.1129848290276167),
        ("1 lbf\u00b7in", "N m", 0.1129848290276167),
        ("1 in-lb", "N m", 0.1129848290276167),
        ("1 ft-lb", "N m", 1.3558179483314004),
        ("1 lb ft", "N m", 1.3558179483314004),
        ("1 BTU/(h ft2 degF)", "W/m**2/K", 5.678263341113488),
        ("1 Btu/(hr*ft^2*\u00b0F)", "W/m**2/K", 5.678263341113488),
        ("1 BTU/degF", "J/K", 1899.100534716),
        ("15 W/m**2/degC", "W/m**2/K", 15.0),
        ("1 acre", "m**2", 4046.8564224),
    ],
)
def test_text_becomes_the_nearest_float_in_si(text, unit, expected):
    assert to_si(text, unit) == expected


@pytest.mark.parametrize(
    ("value", "unit"),
    [
        ("4 kHz", "rad"),
        ("4 kHz", "rad/s"),
        ("60 rpm", "Hz"),
        ("45 deg", ""),
        ("3", "rad"),
        ("3", "m"),
        ("4 kN", "Hz"),
        ("1 N m", "N"),
        ("0.5 mm/z", "m/s"),
        ("0,5 mm/s", "m/s"),
        ("1.2.3 m", "m"),
        ("1_000 m", "m"),
        ("3 4 m", "m"),
        ("nan m", "m"),
        ("inf m", "m"),
        ("1e9999 m", "m"),
        ("m", "m"),
        ("", "m"),
        ("", ""),
        ("9 m**9**9**9", "m"),
        ("1 m/0", "m"),
        ("1 ((m", "m"),
        ("__import__('os')", "m"),
        (math.nan, "m"),
        (-math.inf, ""),
        (10**400, "m"),
        (True, ""),
        (np.True_, ""),
        (None, "m"),
        ([1.0], "m"),
        (1 + 2j, ""),
    ],
)
def test_what_is_no_such_quantity_is_refused_in_one_line(value, unit):
    with pytest.raises(InputError) as raised:
        to_si(value, unit)
    assert "\n" not in str(raised.value)


def test_a_bare_number_is_si_or_refused_or_in_the_unit_named():
    assert to_si(3, "m") == 3.0
    assert to_si(np.float32(0.5), "m") == 0.5
    assert to_si(180, "rad", bare="deg") == math.pi
    assert to_si("180", "rad", bare="deg") == math.pi
    assert to_si("1 rad", "rad", bare="deg") == 1.0
    assert to_si(0.71, "", bare="refuse") == 0.71
    with pytest.raises(InputError, match="has no unit"):
        to_si(3, "m", bare="refuse")
    with pytest.raises(InputError, match="has no unit"):
        to_si("3", "m", bare="refuse")


def test_zero_has_no_sign():
    assert math.copysign(1.0, to_si("-0 m/s", "m/s")) == 1.0


def test_a_number_is_split_from_its_unit():
    assert split_unit(" 0.5mm/s ") == ("0.5", "mm/s")
    assert split_unit("12") == ("12", "")
    assert split_unit("fast") is None


def test_importing_units_does_not_load_pint():
    code = "import sys, asperity.units; sys.exit('pint' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_the_own_reader_agrees_with_pint_to_the_last_bit_on_every_unit_and_prefix(monkeypatch):
    # Some names have two readings, of which pint takes one and tells the log of the other.
    monkeypatch.setattr(logging.getLogger("pint.util"), "disabled", True)
    number = Decimal("1.2345678901234567")
    prefixes, units = measures.listed()
    read = 0
    for name in map("".join, itertools.product(("", *prefixes), units)):
        if measures.measure(name) is None:
            continue
        base = registry().Quantity(number, registry().parse_units(name)).to_base_units()
        si = " * ".join(f"{unit}**{power}" for unit, power in base.unit_items())
        assert float(measures.convert(str(number), name, si)) == float(base.magnitude), name
        read += 1
    # A temperature with a zero of its own takes no prefix.
    scaled = [name for name, definition in units.items() if "offset: 2" not in definition]
    assert read > 0.9 * len(scaled) * (len(prefixes) + 1)


@pytest.mark.parametrize(
    ("unit", "si"),
    [
        ("N/mm**2", "Pa"),
        ("W/m/K", "W/(m K)"),
        ("N m/s rad", "W rad"),
        ("mm**-1", "1/m"),
        ("1/min", "Hz"),
        ("m ^ 2/ s", "m**2/s"),
        ("lbf/in", "N/m"),
        ("degC", "K"),
        ("N\u00b7m", "J"),
        ("mm**3/(N m)", "m**2/N"),
        ("W/ (m ** 2 * K)", "kg/s**3/K"),
        ("kg*m/(s**2 mm**2)", "Pa"),
    ],
)
def test_the_own_reader_agrees_with_pint_on_products_and_powers(unit, si):
    for number in ("0.1", "-3.3e-7", "219.12345678901234567", "1e300"):
        whole = registry().Quantity(Decimal(number), unit).to(si)
        assert to_si(f"{number} {unit}", si) == float(whole.magnitude)
        assert measures.convert(number, unit, si) is not None


@pytest.mark.parametrize(
    "unit",
    [
        "degC**2",
        "degC/m",
        "kdegC",
        "degF/m",
        "mdegF",
        "/m",
        "*m",
        "2 m",
        "m**9**9",
        "m**0",
        "m m2x",
        "m2/(s",
        "m s/(m/s)s",
        "",
        "fnord",
    ],
)
def test_what_the_own_reader_does_not_know_it_leaves_to_pint(unit):
    assert measures.convert("1", unit, "m") is None


class Model(pydantic.BaseModel):
    speed: Annotated[float, Quantity("m/s", gt=0)]
    angle: Annotated[float, Quantity("rad", "an angle", "45 deg")] | None = None
    share: Annotated[float, Quantity("", "a share", "0.71", ge=0, le=1)] = 1.0
    name: str = ""


def test_a_field_takes_text_with_a_unit_or_si():
    assert Model(speed="2 mm/s").speed == 2e-3
    assert Model(speed=2).speed == 2.0
    assert Model(speed=1, angle="90 deg").angle == math.pi / 2
    assert Model(speed=1, angle=None).angle is None


@pytest.mark.parametrize(
    ("field", "value", "message"),
    [
        ("speed", "4 kHz", "it must be a velocity such as '0.5 mm/s'"),
        ("speed", True, "it must be a velocity such as '0.5 mm/s'"),
        ("speed", "-1 m/s", "it must be positive"),
        ("angle", "90", "it must be an angle such as '45 deg'"),
        ("share", "x", "it must be a share such as 0.71"),
        (
            "speed",
            "2,5 mm/s",
            "it must be a velocity such as '0.5 mm/s', with a point in place of the comma",
        ),
        ("share", "0,5", "it must be a share such as 0.71, with a point in place of the comma"),
        ("share", "0,5,7", "it must be a share such as 0.71"),
        ("share", 1.5, "it must be at least 0 and at most 1"),
    ],
)
def test_a_field_says_what_it_must_be(field, value, message):
    with pytest.raises(pydantic.ValidationError) as raised:
        Model(**{"speed": 1.0, field: value})
    assert str(raised.value.errors()[0]["ctx"]["error"]) == message


def test_a_bound_has_the_unit_of_the_example():
    length = Quantity("m", "a length", "2 mm", lt=0.5)
    assert length.bounds() == "it must be below 500 mm"
    warm = Quantity("K", "a temperature", "20 degC", ge=273.15, lt=373.15)
    assert warm.bounds() == "it must be at least 0 degC and below 100 degC"
    assert Quantity("m", ge=0).bounds() == "it must be zero or positive"


def test_only_text_is_taken_where_the_context_says_so():
    context = {"text_only": True}
    given = {"speed": "1 m/s", "share": 0.5}
    assert Model.model_validate(given, context=context).share == 0.5
    with pytest.raises(pydantic.ValidationError):
        Model.model_validate({"speed": 1.0}, context=context)


def test_the_unit_of_a_field_can_be_asked():
    assert [unit_of(Model, field) for field in ("speed", "angle", "share")] == ["m/s", "rad", ""]
    assert unit_of(Model, "name") is None
    assert unit_of(Model, "nothing") is None
    assert quantity_of(Model, "angle") == Quantity("rad", "an angle", "45 deg")
