"""What holds for any axis."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.slider import TABLES
from asperity.sweep import parse_axes

CASE = read_case("table-4.3", TABLES)


@given(
    start=st.integers(-1000, 1000),
    # the last of them is within the ten turns that an angle of a vibration has at most
    step=st.integers(1, 60).flatmap(lambda n: st.sampled_from([n, -n])),
    count=st.integers(0, 40),
    rest=st.integers(0, 99),
    decimals=st.integers(0, 6),
)
def test_a_range_has_exactly_its_steps_and_never_passes_the_stop(
    start, step, count, rest, decimals
):
    scale = 10**decimals
    past = step * rest // 100
    stop = start + count * step + (past if abs(past) < abs(step) else 0)
    text = ":".join(f"{number}e-{decimals}" for number in (start, stop, step))
    (axis,) = parse_axes([f"vibration.direction={text} deg"], CASE)
    assert list(axis.shown) == [(start + place * step) / scale for place in range(count + 1)]


@pytest.mark.slow
@given(st.sampled_from(["vibration.direction=", "friction.law=", ""]), st.text(max_size=40))
def test_any_text_is_an_axis_or_an_input_error_of_one_line(path, text):
    said = "an axis"
    try:
        parse_axes([path + text], CASE)
    except InputError as error:
        said = str(error)
    assert len(said.splitlines()) == 1


@given(
    values=st.lists(
        st.decimals(0, 1000, allow_nan=False, places=3), min_size=1, max_size=8, unique=True
    ),
    unit=st.sampled_from(["mm/s", "um/s", "m/s"]),
)
def test_a_list_written_with_its_unit_last_equals_one_written_with_each(values, unit):
    written = [f"{value:f}" for value in values]
    path = "vibration.velocity_amplitude="
    (last,) = parse_axes([path + ",".join(written) + f" {unit}"], CASE)
    (each,) = parse_axes([path + ",".join(f"{number} {unit}" for number in written)], CASE)
    assert last == each
    assert last.shown == pytest.approx([float(value) for value in values], rel=1e-15)
