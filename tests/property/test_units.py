import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from asperity.errors import InputError
from asperity.units import to_si

UNITS = {
    "m": ["m", "mm", "um", "nm", "in"],
    "m/s": ["m/s", "mm/s", "km/h"],
    "Hz": ["Hz", "kHz", "1/min"],
    "rad": ["rad", "deg", "turn", "mrad"],
    "N/m": ["N/m", "kN/mm", "lbf/in"],
    "K": ["K", "degC"],
    "": ["%", "mm/m"],
}
numbers = st.floats(-1e12, 1e12, allow_subnormal=False)
units = st.sampled_from([(si, unit) for si, names in UNITS.items() for unit in names])


@given(numbers, st.sampled_from(list(UNITS)))
def test_a_number_in_si_comes_back_exactly(number, unit):
    assert to_si(f"{number!r} {unit}", unit) == number
    assert to_si(number, unit) == number


@given(numbers, units)
def test_equal_steps_in_a_unit_are_equal_steps_in_si(number, pair):
    si, unit = pair
    zero, one, value = (to_si(f"{x!r} {unit}", si) for x in (0.0, 1.0, number))
    assert value - zero == pytest.approx(number * (one - zero), rel=1e-9, abs=1e-9 * abs(zero))


@given(
    st.one_of(
        st.text(max_size=40),
        st.text("0123456789.eE+-*/^() mskgNHzradeg%\u00b0\u00b5_,", max_size=30),
        st.from_regex(r"[0-9]{1,3} [a-z*/()0-9 -]{0,25}", fullmatch=True),
    ),
    st.sampled_from(list(UNITS)),
    st.sampled_from([None, "refuse", "mm"]),
)
@example("1 m/(1-1)", "m", None)
@example("9 9**9**9 m", "m", None)
@example("1 m**99999999", "m", None)
@example("1e9999 m", "m", None)
@example("\u0663 m", "m", None)
def test_any_text_is_a_finite_number_or_an_input_error(text, unit, bare):
    try:
        value = to_si(text, unit, bare=bare)
    except InputError as error:
        message = str(error)
    else:
        message = "finite" if math.isfinite(value) else ""
    assert len(message.splitlines()) == 1
