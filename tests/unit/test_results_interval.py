"""An estimate with its interval: its arithmetic, and how a result declares it."""

import math

import pytest

from asperity.results import Quantities
from asperity.results.interval import Interval, numbers_of, value_of
from asperity.results.quantity import measured


class Torque(Quantities):
    before: Interval | None = measured("T_b", "N m", "torque before", key="before_Nm")
    share: Interval | None = measured("", "%", "share of it", ends_only="json")


def test_another_unit_scales_value_ends_and_deviation():
    assert Interval(2.0, 1.5, 2.5, 0.25).times(10.0) == Interval(20.0, 15.0, 25.0, 2.5)


def test_a_factor_below_zero_turns_the_ends_round():
    assert Interval(2.0, 1.5, 3.0, 0.25).times(-1.0) == Interval(-2.0, -3.0, -1.5, 0.25)


def test_an_open_end_stays_open():
    one = Interval(0.0, None, 1.0)
    assert one.times(-2.0).ends == (-2.0, None)
    assert one.mapped(math.exp).ends == (None, pytest.approx(math.e))
    assert one.width is None
    assert str(one) == "0 (open to 1)"


def test_what_is_not_there_has_no_numbers():
    assert value_of(None) is None
    assert numbers_of(None) == (None, None, None)


def test_a_declared_interval_is_two_keys_and_two_variables():
    found = Torque(before=Interval(2.0, 1.5, None), share=Interval(5.0, 4.0, 6.0))
    assert found.to_json() == {
        "before_Nm": 2.0, "before_ci95_Nm": [1.5, None],
        "share_percent": 5.0, "share_ci95_percent": [4.0, 6.0],
    }  # fmt: skip
    in_file = {entry.variable for entry in found.entries() if entry.in_file}
    assert in_file == {"before", "before_ci95", "share"}


def test_a_declared_interval_that_is_not_there_is_null():
    assert set(Torque().to_json().values()) == {None}
    assert [entry.name for entry in Torque.declared()] == [
        "before", "before_ci95", "share", "share_ci95",
    ]  # fmt: skip
    assert Torque.scalars() == ()
