"""The LuGre equations of Appendix A, (42) to (47), against what they must come to."""

import numpy as np
import pytest

from asperity.thesis.sliding.appendix_a import (
    LuGre,
    phases_of,
    steady_viscous,
    step_differences,
)

PLAIN = LuGre(stiffness=67.29e6, full=5.08)
ALONG, NONE = np.array([1.0, 0.0]), np.zeros(2)


def slide(law, velocity, step, steps):
    size, direction = 1e-12, ALONG
    for _ in range(steps):
        slips = np.array([velocity * step, 0.0]), NONE
        size, force = phases_of(law, size, direction, *slips, step)
        direction = force / np.hypot(*force)
    return size, force


def test_without_its_terms_each_step_is_dahls():
    assert step_differences().max() < 1e-12


def test_steady_sliding_comes_to_full_friction_against_the_slip():
    size, force = slide(PLAIN, 0.5e-3, 1e-6, 3000)
    assert size == pytest.approx(5.08 / 67.29e6, rel=1e-6)
    assert force == pytest.approx([5.08, 0.0], rel=1e-6)


def test_steady_sliding_with_stribeck_comes_to_the_kinetic_friction_of_its_velocity():
    law = LuGre(67.29e6, 5.08, stiction=7.62, stribeck=1e-3)
    _, force = slide(law, 0.5e-3, 1e-6, 3000)
    assert force[0] == pytest.approx(5.08 + 2.54 * np.exp(-0.25), rel=1e-6)


def test_as_it_stands_46_has_no_viscous_friction_in_steady_sliding_along_x():
    # N'_1 M'^2 is measured once the first phase has let the root follow.
    assert steady_viscous() == pytest.approx(0.0, abs=1e-5)


def test_viscous_friction_counts_what_the_second_phase_slips():
    law = LuGre(67.29e6, 5.08, viscous=40.0)
    size, step, slip = 5.08 / 67.29e6, 1e-6, 1e-10
    plain = phases_of(PLAIN, size, ALONG, NONE, np.array([slip, 0.0]), step)[1]
    viscous = phases_of(law, size, ALONG, NONE, np.array([slip, 0.0]), step)[1]
    assert viscous[0] - plain[0] == pytest.approx(40.0 * slip / step, rel=1e-9)


def test_damping_of_the_contact_is_gone_where_the_deflection_rests():
    damped = LuGre(67.29e6, 5.08, damping=100.0)
    _, force = slide(damped, 0.5e-3, 1e-6, 3000)
    assert force[0] == pytest.approx(5.08, rel=1e-6)
    # Stuck, it is in parallel with the stiffness.
    step, slip = 1e-6, 1e-12
    _, force = phases_of(damped, 1e-15, ALONG, np.array([slip, 0.0]), NONE, step)
    assert force[0] == pytest.approx(67.29e6 * slip + 100.0 * slip / step, rel=2e-3)
