"""What holds for every worm and hob that can be made, and that the others are refused."""

import math

import hypothesis
import hypothesis.strategies as st
import numpy as np
import pytest
from apparatus.worm_distance import distances_with_derivatives

from asperity.errors import InputError
from asperity.flanks.parameters import Hob, Modification
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.types import TYPES
from asperity.gearset import Geometry

geometries = st.builds(
    Geometry.of,
    starts=st.integers(1, 6),
    wheel_teeth=st.integers(30, 82),
    axial_module=st.floats(0.5, 10.0),
    diameter_factor=st.floats(8.0, 14.0),
    profile_shift=st.floats(-0.5, 0.5),
    pressure_angle=st.floats(14.5, 30.0).map(math.radians),
    tooth_proportions=st.sampled_from(["bs721", "iso"]),
)
hobs = st.builds(
    Hob, oversize=st.floats(1.0, 1.3), rule=st.sampled_from(["normal-module", "axial-module"])
)
modifications = st.builds(
    Modification,
    units=st.just("SI"),
    lead_correction=st.floats(-0.002, 0.002),
    tip_relief=st.floats(0.0, 2e-5),
    tip_relief_start=st.floats(0.0, 0.9),
)


def made(make, *arguments):
    """The worm or hob, or None where it is refused for a cause that is named."""
    try:
        return make(*arguments)
    except InputError as refused:
        text = str(refused)
    assert text.startswith(("gearset.pressure_angle is ", "gearset.flank is "))
    return None


@pytest.mark.slow
@hypothesis.settings(max_examples=40)
@hypothesis.given(geometry=geometries, kind=st.sampled_from(TYPES), change=modifications)
def test_on_a_worms_own_surface_the_distance_is_zero(geometry, kind, change):
    worm = made(Helicoid.worm, geometry, kind, change)
    if worm is None:
        return
    # Next to the core, and next to the land, the nearest surface is another one.
    low = worm.root_radius + 0.02 * geometry.axial_module
    start = (low - worm.root_radius) / (worm.flank_end - worm.root_radius)
    rho, z, _, _ = worm.curve(np.linspace(start, 1.99, 30))
    theta = np.linspace(-3.0, 3.0, 30)
    side = np.where(np.arange(30) % 2, 1.0, -1.0)
    points = np.stack(
        [rho * np.cos(theta), rho * np.sin(theta), side * z + worm.reduced_lead * theta], axis=-1
    )
    found = distances_with_derivatives(points, worm)
    assert np.abs(found.distance).max() < 2e-14 * worm.tip_radius
    assert np.linalg.norm(found.gradient, axis=-1) == pytest.approx(1.0, abs=1e-14)


@pytest.mark.slow
@hypothesis.given(geometry=geometries, kind=st.sampled_from(TYPES), hob=hobs)
def test_a_hobs_generating_curve_rises_from_root_to_tip_and_ends_in_the_middle(geometry, kind, hob):
    tool = made(Helicoid.hob, geometry, kind, hob)
    if tool is None:
        return
    rho, z, _, _ = tool.curve(np.linspace(0.0, 3.0, 61))
    assert (np.diff(rho[:41]) > 0.0).all()
    assert (np.diff(z[20:]) > 0.0).all()
    assert z[-1] == pytest.approx(math.pi * tool.reduced_lead / tool.starts)
    assert tool.tip_rounding > 0.0


@pytest.mark.slow
@hypothesis.given(geometry=geometries, size=st.floats(0.5, 20.0), kind=st.sampled_from(TYPES[:3]))
def test_a_gearset_of_another_size_has_the_same_flanks(geometry, size, kind):
    """Lengths scale, slopes stay and curvatures are divided."""
    larger = Geometry.of(
        starts=geometry.starts,
        wheel_teeth=geometry.wheel_teeth,
        axial_module=size * geometry.axial_module,
        diameter_factor=geometry.diameter_factor,
        profile_shift=geometry.profile_shift,
        pressure_angle=geometry.pressure_angle,
        tooth_proportions="bs721" if geometry.wheel_addendum < geometry.axial_module else "iso",
    )
    small, large = made(Helicoid.worm, geometry, kind), made(Helicoid.worm, larger, kind)
    if small is None or large is None:
        assert small is large
        return
    rho = np.linspace(geometry.worm_pitch_diameter / 2.0, small.tip_radius, 5)
    for power, one, other in zip(
        (1, 0, -1), small.width(rho), large.width(size * rho), strict=True
    ):
        assert other == pytest.approx(size**power * one, rel=1e-9, abs=1e-11 * size**power)
