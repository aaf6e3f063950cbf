"""A guided body on a rigid drive goes to the closed forms of rigid Coulomb friction.

Sources: the phase means of (1 - k cos(theta) cos(p)) / |v|; longitudinal: W. Littmann, H. Storck,
J. Wallaschek, Sliding friction in the presence of ultrasonic oscillations, Archive of Applied
Mechanics 71 (2001); transverse: H. Storck et al., Ultrasonics 40 (2002); both: V. C. Kumar,
I. M. Hutchings, Tribology International 37 (2004). The functions are tested next door.
"""

import math

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.closed_forms import (
    directed_power,
    directed_ratio,
    longitudinal_power,
    transverse_power,
    triangle_directed_ratio,
    vibration_power,
)

LAWS = ["split", "unsplit", "vector"]
METHODS = ["march", "periodic"]
FULL = 5.08 * 0.5e-3  # mu F_N v_d of Table 4.4, W


def guided(*settings, **values):
    """Table 4.4's contact, guided, on a rigid drive, all of the vibration transferred."""
    case = read_case(
        "table-4.4",
        TABLES,
        [
            "slider.lateral=guided", "friction.transfer=1", "vibration.start=0 s",
            "solve.method=periodic", "solve.duration=0.1 s", *settings,
        ],
    )  # fmt: skip
    settings = {"slider.drive_stiffness": None, "slider.drive_damping": None}
    settings |= {key.replace("__", "."): value for key, value in values.items()}
    return solve(Model.from_case(case.replace_values(settings)), history=False)


def along(k, theta):
    return f"vibration.velocity_ratio={k}", f"vibration.direction={theta} deg"


@pytest.mark.parametrize(
    ("k", "theta", "method"),
    grid([0.5, 1.5, 2.0, 6.0, 20.0], [0, 30, 45, 90, 135, 200], METHODS, ordinary=7),
)
def test_rigid_friction_under_a_sine_is_the_closed_form(k, theta, method):
    answer = guided(
        "friction.model=coulomb", *along(k, theta), f"solve.method={method}",
        "solve.step=0.1 us", "solve.duration=20 ms",
    )  # fmt: skip
    ledger = answer.ledger
    assert answer.ratio == pytest.approx(directed_ratio(k, math.radians(theta)), abs=2.5e-7 * k)
    assert ledger.friction / FULL == pytest.approx(directed_power(k, math.radians(theta)), rel=2e-6)
    assert ledger.vibration / FULL == pytest.approx(
        vibration_power(k, math.radians(theta)), rel=2e-6, abs=2e-6
    )


@pytest.mark.parametrize(("k", "theta"), [(2.0, 0), (6.0, 0), (6.0, 45), (6.0, 90)])
def test_rigid_friction_converges_with_order_two(k, theta):
    exact = directed_ratio(k, math.radians(theta))
    steps = (400, 800, 1600, 3200)
    errors = [
        guided("friction.model=coulomb", *along(k, theta), solve__step=1.0 / (3000.0 * n)).ratio
        - exact
        for n in steps
    ]
    slope, _ = np.polyfit(np.log(steps), np.log(np.abs(errors)), 1)
    assert slope == pytest.approx(-2.0, abs=0.2)


@pytest.mark.parametrize("theta", [0, 30, 90])
@pytest.mark.parametrize("k", [0.5, 1.5, 6.0])
def test_rigid_friction_under_a_triangle_wave_is_exact_at_any_step(k, theta):
    answer = guided(
        "friction.model=coulomb", *along(k, theta), "vibration.waveform=triangle",
        solve__step=1.0 / (3000.0 * 256),
    )  # fmt: skip
    assert answer.ratio == pytest.approx(triangle_directed_ratio(k, math.radians(theta)), abs=1e-12)


def approach(exact, halvings, *settings):
    """Errors of the ratio while the deflection limit is halved again and again."""
    return np.array(
        [
            guided(*settings, friction__max_deflection=75.49e-9 / 2.0**n).ratio - exact
            for n in halvings
        ]
    )


# Rate in the deflection limit: the friction changes sign with a jump of the slip's direction
# longitudinally (order 1), and turns smoothly otherwise (order 2).
SINES = {
    (2, 0): 1.0,
    (6, 0): 1.0,
    (20, 0): 1.0,
    (2, 45): 2.0,
    (2, 90): 2.0,
    (6, 45): 2.0,
    (6, 90): 2.0,
}


@pytest.mark.ordinary(9)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(("k", "theta"), SINES)
def test_every_law_goes_to_the_closed_form_of_the_sine(k, theta, law):
    exact = directed_ratio(float(k), math.radians(theta))
    errors = approach(exact, (7, 8, 9), *along(k, theta), f"friction.law={law}")
    rate = math.log2(abs(errors[1] / errors[2]))
    assert rate == pytest.approx(SINES[k, theta], abs=0.1)
    assert abs(errors[2]) < (3e-3 if theta == 0 else 4e-5)
    if theta == 0:
        extrapolated = 2.0 * errors[2] - errors[1]
        assert abs(extrapolated) < 2e-5


@pytest.mark.ordinary(3)
@pytest.mark.parametrize(
    ("place", "law"),
    grid(
        [(2, 0), (6, 0), (20, 0), (2, 90), (6, 90), (20, 90)],
        LAWS,
        ordinary=[
            ((2, 0), "split"), ((20, 0), "vector"), ((6, 0), "unsplit"),
            ((2, 90), "vector"), ((6, 90), "split"), ((20, 90), "unsplit"),
        ],
    ),
)  # fmt: skip
def test_every_law_goes_to_the_closed_form_of_the_triangle_wave(place, law):
    k, theta = place
    exact = triangle_directed_ratio(float(k), math.radians(theta))
    settings = (
        *along(k, theta),
        f"friction.law={law}",
        "vibration.waveform=triangle",
        "solve.step=0.01 us",
    )
    # As small against the way of a cycle for every speed ratio.
    errors = approach(exact, (1, 2, 3) if k == 20 else (4, 5, 6), *settings)
    if law == "vector" and theta == 90:
        # Across, the two directions of the slip are mirror images: nothing of the limit is left.
        assert errors == pytest.approx(0.0, abs=1e-11)
    else:
        assert math.log2(abs(errors[1] / errors[2])) == pytest.approx(1.0, abs=0.1)
        assert abs(errors[2]) < 1.2e-2


@pytest.mark.parametrize("law", LAWS)
def test_what_is_not_transferred_does_not_count_across(law):
    exact = directed_ratio(0.71 * 6.0, 0.5 * math.pi)
    settings = (*along(6, 90), f"friction.law={law}", "friction.transfer=0.71")
    errors = approach(exact, (8, 9), *settings)
    assert abs(errors[1]) < 4e-5
    assert math.log2(abs(errors[0] / errors[1])) == pytest.approx(2.0, abs=0.15)


@pytest.mark.parametrize(
    ("k", "theta", "total", "exact", "order"),
    [(6, 0, 3.8729, longitudinal_power(6.0), 1.0), (6, 90, 4.0144, transverse_power(6.0), 2.0)],
)
def test_the_power_of_an_elastic_contact_goes_to_the_rigid_power(k, theta, total, exact, order):
    assert exact == pytest.approx(total, abs=5e-5)
    powers = [
        guided(*along(k, theta), friction__max_deflection=75.49e-9 / 2.0**n).ledger.friction / FULL
        for n in (7, 8, 9)
    ]
    errors = np.abs(np.array(powers) - exact)
    assert np.log2(errors[:-1] / errors[1:]) == pytest.approx(order, abs=0.1)
    assert errors[-1] < 3e-3 * exact


MASS = {"slider__drive_stiffness": 96068.0, "friction__law": "vector"}


@pytest.mark.parametrize(("k", "theta"), [(2, 60), (6, 60), (6, 90)])
def test_rigid_friction_of_a_body_with_mass_converges_with_order_two(k, theta):
    settings = ("friction.model=coulomb", "slider.lateral=free", *along(k, theta))
    ratios = [
        guided(*settings, solve__step=1.0 / (3000.0 * n), **MASS).ratio
        for n in (400, 800, 1600, 3200)
    ]
    changes = np.abs(np.diff(ratios))
    assert np.log2(changes[:-1] / changes[1:]) == pytest.approx(2.0, abs=0.4)
    assert changes[-1] < 1e-5


@pytest.mark.parametrize("k", [2, 6])
def test_rigid_friction_of_a_body_with_mass_is_right_at_its_reversals(k):
    settings = ("friction.model=coulomb", "slider.lateral=free", *along(k, 0))
    coarse, fine = (
        guided(*settings, solve__step=1.0 / (3000.0 * n), **MASS).ratio for n in (300, 6000)
    )
    assert coarse == pytest.approx(fine, rel=2e-4)


@pytest.mark.slow
def test_friction_of_a_body_with_mass_is_the_limit_of_a_stiff_asperity():
    settings = ("slider.lateral=free", *along(6, 60), "solve.step=0.1 us")
    limit = guided(*settings, "friction.model=coulomb", **MASS).ratio
    errors = [
        guided(*settings, friction__max_deflection=deflection, **MASS).ratio - limit
        for deflection in (4e-9, 1e-9, 0.25e-9)
    ]
    assert np.log(np.divide(errors[:-1], errors[1:])) / np.log(4.0) == pytest.approx(1.0, abs=0.25)
    assert abs(errors[-1]) < 2e-3


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("k", [20.0, 100.0, 1000.0])
def test_a_slip_that_turns_fast_is_resolved_without_being_asked(k, method):
    answer = guided(
        "friction.model=coulomb", *along(k, 90), f"solve.method={method}", "solve.duration=4 ms"
    )
    assert answer.substeps > 1
    assert answer.ratio == pytest.approx(directed_ratio(k, 0.5 * math.pi), rel=2e-4)
