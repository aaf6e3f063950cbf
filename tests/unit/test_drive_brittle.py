"""Dahl's asperities of exponent 0 in a drive: the law of other exponents where it ends."""

import numpy as np
import pytest
from apparatus.drives import all_solved, case
from apparatus.grid import slow

from asperity.drive.locking import answer as locking
from asperity.drive.locking import prepare as prepare_locking
from asperity.drive.reduced.in_series import COULOMB, deflect
from asperity.friction.dahl import closed_form
from asperity.runs import Run


def drawn_steps(count, seed):
    """Yield what teeth give, limit, deflection and way of steps of any size and direction."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        soft = rng.choice([0.0, 0.05, 1.0, 3.0, 20.0])
        limit = 10 ** rng.uniform(-2.0, 0.5)
        size = rng.choice([0.0, rng.random(), 1.0 - 1e-9, 1.0, 1.0 + rng.random()])
        start, way = rng.uniform(0.0, 2.0 * np.pi, 2)
        way = start + np.pi * rng.integers(0, 2) if rng.random() < 0.3 else way
        length = 10 ** rng.uniform(-5.0, 1.0)
        yield (
            soft, limit, limit * size * np.array([np.cos(start), np.sin(start)]),
            length * np.array([np.cos(way), np.sin(way)]),
        )  # fmt: skip


@pytest.mark.usefixtures("plain_kernels")
def test_what_teeth_leave_of_a_way_bends_asperities_by_the_law_of_exponent_0():
    for soft, limit, start, way in drawn_steps(1000, 1902):
        *end, off = deflect(0.0, soft, *start, *way, limit, limit)
        size = np.linalg.norm(start)
        # Slipped back to a limit that fell below it, which the teeth follow.
        before = start * min(1.0, limit / max(size, 1e-300))
        slip = way - soft * (np.array(end) - start)
        by_law = limit * np.array(closed_form(*(before / limit), *(slip / limit), 0.0))
        assert np.abs(end - by_law).max() < 1e-8 * limit
        assert off < 1e-9 * (limit + np.linalg.norm(way))
        assert np.linalg.norm(end) <= limit * (1.0 + 1e-12)


@pytest.mark.usefixtures("plain_kernels")
def test_it_never_gives_energy_and_is_the_end_of_ever_smaller_exponents():
    for soft, limit, start, way in drawn_steps(600, 1976):
        if np.linalg.norm(start) > limit:
            continue
        *end, _ = deflect(0.0, soft, *start, *way, limit, limit)
        moved = end - start
        lost = end @ (way - (1.0 + soft) * moved) + 0.5 * (1.0 + soft) * moved @ moved
        assert lost >= -1e-12 * limit * (limit + np.linalg.norm(way))
        *near, off = deflect(np.float64(1e-9), soft, *start, *way, limit, limit)
        if off < 1e-9 * limit:  # Newton's method comes near at kinks only
            assert np.abs(np.subtract(end, near)).max() < 1e-7 * limit


@pytest.mark.usefixtures("plain_kernels")
def test_on_a_line_teeth_and_asperities_are_two_springs_with_one_limit():
    limit, soft = 1.0, 0.7
    for start, way in ((0.0, 0.4), (0.9, 0.3), (0.5, -1.2), (-1.0, 9.0), (1.0, -5.0)):
        for exponent in (0.0, COULOMB):
            w, across, off = deflect(exponent, soft, start, 0.0, way, 0.0, limit, limit)
            assert w == pytest.approx(min(max(start + way / (1.0 + soft), -1.0), 1.0), rel=1e-14)
            assert across == off == 0.0
    # What sticks is elastic across a pull too by Coulomb's friction, and yields by exponent 0.
    for exponent, left in ((COULOMB, 0.5), (0.0, 0.5 - 1e-3 / np.sqrt(5.0))):
        bent = deflect(exponent, 0.0, 0.5, 0.0, 0.0, 1e-3, limit, limit)
        assert bent[0] == pytest.approx(left, abs=1e-5)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mode", "ratio", "compliance"),
    [
        ("axial", 0.8, 2.9), slow("axial", 0.8, 0.0), ("torsional", 1.5, 0.0),
        ("wheel-axial", 1.2, 0.3), slow("wheel-axial", 1.2, 0.0),
    ],
)  # fmt: skip
def test_a_drive_of_exponent_0_is_the_limit_of_others(mode, ratio, compliance):
    given = (
        f"vibration.mode={mode}", "vibration.frequency=20 kHz", "solve.duration=4 ms",
        f"vibration.velocity_ratio={ratio}", "drive.flanks=driving", "solve.step=0.02 us",
        f"drive.tangential_compliance={compliance} nm/N",
    )  # fmt: skip
    one, other = all_solved([(*given, f"friction.exponent={i}") for i in (0.0, 1e-6)])
    assert one.settled
    assert one.torque_ratio == pytest.approx(other.torque_ratio, abs=1e-4)
    assert one.ledger.actuator == pytest.approx(other.ledger.actuator, rel=1e-3)
    assert max(one.closure, other.closure) < 1e-5
    assert max(one.residual, other.residual) < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(("model", "holds"), [("dahl", False), ("coulomb", True)])
def test_exponent_0_creeps_where_it_is_shaken_across_too_and_what_holds_is_told(model, holds):
    given = ("vibration.mode=axial", "vibration.displacement_amplitude=4 um", "solve.duration=6 ms")
    asked = case(*given, f"friction.model={model}", name="drive-actuator")
    found = locking(prepare_locking(asked), Run())
    assert found.locked
    assert (found.threshold > 0.0) == holds
    said = [note for note in found.notes if note.startswith("friction.exponent is 0")]
    assert len(said) == (not holds)
    assert all("yield below their limit; friction.model 'coulomb' holds" in note for note in said)
