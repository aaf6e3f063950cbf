import dataclasses

import pytest

from asperity.errors import ConvergenceError
from asperity.results.ledger import PowerLedger, PressedLedger, guard

CLOSED = PowerLedger(
    drive=1.0, vibration=2.0, friction=2.5, damping=0.25, stored=0.25, untransferred=7.0
)
ADVICE = "give a solve.step of at most 1e-06 s, or none"


def missing(power, **changes):
    return dataclasses.replace(CLOSED, vibration=2.0 + power, **changes)


@pytest.mark.parametrize("power", [0.0, 9e-4, -9e-4])
def test_a_ledger_that_closes_to_a_thousandth_of_the_drive_needs_no_word(power):
    assert guard(missing(power), ADVICE) == ()


@pytest.mark.parametrize("power", [1.01e-3, 5e-3, 9.9e-3])
def test_a_ledger_that_nearly_closes_is_noted(power):
    (note,) = guard(missing(power), ADVICE)
    assert f"{power:.2g} of the drive's" in note
    assert ADVICE in note


def test_what_a_pressed_ledger_misses_is_told_over_the_sum_of_what_is_put_in():
    pressed = PressedLedger(**vars(CLOSED), normal=7.0, contact_damping=7.0)
    assert pressed.residual == 0.0
    nearly = dataclasses.replace(pressed, normal=7.05)
    assert nearly.residual == pytest.approx(0.05 / 10.05)
    assert guard(nearly, ADVICE) == (
        f"the powers balance only to 0.005 of what is put in: {ADVICE}",
    )
    with pytest.raises(
        ConvergenceError, match=r"0\.11 of what is put in is missing, at most 0\.01"
    ):
        guard(dataclasses.replace(pressed, contact_damping=5.9), ADVICE)


@pytest.mark.parametrize("power", [1.01e-2, 2e-2, -2e-2, float("nan")])
def test_an_answer_whose_powers_do_not_balance_is_refused_with_what_was_reached(power):
    with pytest.raises(ConvergenceError, match=ADVICE) as raised:
        guard(missing(power), ADVICE, reached={"ratio": 0.1})
    assert raised.value.reached["ratio"] == 0.1
    assert raised.value.reached["power_residual"] == pytest.approx(abs(power), nan_ok=True)


def test_a_drive_that_does_nothing_is_measured_by_a_thousandth_of_frictions_work():
    idle = PowerLedger(
        drive=0.0, vibration=2.5, friction=2.5 + 2e-6, damping=0.0, stored=0.0, untransferred=0.0
    )
    assert idle.residual == pytest.approx(8e-4, rel=1e-4)
    assert guard(idle, ADVICE) == ()


def test_where_nothing_happens_nothing_is_missing():
    nothing = {field.name: 0.0 for field in dataclasses.fields(PowerLedger)}
    assert PowerLedger(**nothing).residual == 0.0


def test_rounding_of_powers_that_go_in_circles_is_not_charged_to_a_drive_that_does_nothing():
    rung = PowerLedger(
        drive=1e-10, vibration=1.0, friction=0.0, damping=0.0, stored=1.0 - 1e-10, untransferred=0.0
    )
    assert rung.residual > 1e-2
    assert guard(rung, ADVICE) == ()
