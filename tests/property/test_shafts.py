"""Statics, deflection and bearings of shafts on random ones."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from asperity.drive.shafts import beam_with_ends
from asperity.shafts.beam import Stretch, at_position, deflection, mesh_compliance
from asperity.shafts.rolling.equivalent import shared_axial
from asperity.shafts.rolling.life import rating_life_hours, spectrum_life
from asperity.shafts.statics import PointLoad, mesh_load, moments, reactions

E = 206e3
force = st.floats(-1e4, 1e4)
vector = st.tuples(force, force, force)
share = st.floats(0.0, 1.0)


@st.composite
def shafts(draw):
    """Return stretches, loads and bearings of a random shaft."""
    lengths = draw(st.lists(st.floats(5.0, 100.0), min_size=1, max_size=6))
    ends = np.cumsum(lengths)
    starts = [0.0, *ends[:-1]]
    diameters = draw(st.lists(st.floats(10.0, 80.0), min_size=len(lengths), max_size=len(lengths)))
    stretches = [
        Stretch(float(a), float(b), d) for a, b, d in zip(starts, ends, diameters, strict=True)
    ]
    length = float(ends[-1])
    first = draw(share) * 0.4 * length
    second = length * (1.0 - 0.4 * draw(share))
    loads = [
        mesh_load(length * draw(share), draw(vector), draw(st.floats(-80.0, 80.0)))
        for _ in range(draw(st.integers(1, 4)))
    ]
    return stretches, loads, (first, second)


@given(shafts())
@settings(max_examples=100, deadline=None)
def test_reactions_balance_forces_and_moments(shaft):
    _, loads, (first, second) = shaft
    found = reactions(loads, first, second)
    size = sum(abs(f) for load in loads for f in load.force) + 1e-6
    for axis in (0, 1):
        left = math.fsum(load.force[axis + 1] for load in loads)
        assert abs(left - found.first[axis] - found.second[axis]) <= 1e-12 * size
    assert abs(math.fsum(load.force[0] for load in loads) - found.axial) <= 1e-12 * size
    # Moments about any point: the origin of s.
    arms = sum(abs(c) for load in loads for c in load.couple) + 1e3 * size
    about_z = math.fsum(-load.at * load.force[1] + load.couple[2] for load in loads)
    about_z += first * found.first[0] + second * found.second[0]
    about_y = math.fsum(load.at * load.force[2] + load.couple[1] for load in loads)
    about_y -= first * found.first[1] + second * found.second[1]
    about_x = math.fsum(load.couple[0] for load in loads) + found.torque
    assert max(abs(about_x), abs(about_y), abs(about_z)) <= 1e-12 * arms


@given(shafts())
@settings(max_examples=60, deadline=None)
def test_nothing_is_left_at_the_end_of_a_shaft(shaft):
    stretches, loads, bearings = shaft
    found = reactions(loads, *bearings)
    end = np.array([stretches[-1].end])
    m = moments(end, loads, found, bearings, (found.axial, 0.0))
    size = sum(abs(f) for load in loads for f in load.force) + 1e-6
    arm = sum(abs(c) for load in loads for c in load.couple) + 1e3 * size
    assert np.abs(m.shear[0, 1]).max() <= 1e-11 * size
    assert np.abs(m.bending[0, 1]).max() <= 1e-11 * arm
    assert abs(m.torque[0, 1]) <= 1e-11 * arm
    assert abs(m.axial[0, 1]) <= 1e-11 * size


@given(
    st.floats(20.0, 400.0), st.floats(0.05, 0.95), st.floats(10.0, 60.0),
)  # fmt: skip
@settings(max_examples=60, deadline=None)
def test_a_plain_shaft_bends_as_beam_tables_say(span, place, diameter):
    at = place * span
    found = mesh_compliance([Stretch(0.0, span, diameter)], (0.0, span), at, E)
    bare = beam_with_ends(span, at, E * math.pi * diameter**4 / 64.0, math.inf, math.inf)
    shear = 6.0 * 1.3 / 8.8 * E / 2.6 * math.pi / 4.0 * diameter**2
    bare[0, 0] += at * (span - at) / (span * shear)
    assert found[0, 0] == pytest.approx(bare[0, 0], rel=1e-10)
    assert found[1, 0] == pytest.approx(bare[1, 0], rel=1e-9, abs=1e-12 / diameter**3)
    assert found[1, 1] == pytest.approx(bare[1, 1], rel=1e-10)


def test_an_overhung_worm_bends_as_beam_tables_say():
    span, over, diameter = 100.0, 65.0, 30.0
    stiffness, area = E * math.pi * diameter**4 / 64.0, math.pi / 4.0 * diameter**2
    shear = 6.0 * 1.3 / 8.8 * E / 2.6 * area
    for ends, mesh in (((40.0, 140.0), 205.0), ((90.0, 190.0), 25.0)):
        found = mesh_compliance([Stretch(0.0, 250.0, diameter)], ends, mesh, E)
        bent = over**2 * (span + over) / (3.0 * stiffness)
        slid = (over + over**2 / span) / shear
        assert found[0, 0] == pytest.approx(bent + slid, rel=1e-10)
        turn = over * (2.0 * span + 3.0 * over) / (6.0 * stiffness)
        assert abs(found[1, 0]) == pytest.approx(turn, rel=1e-10)
        assert found[1, 1] == pytest.approx((span + 3.0 * over) / (3.0 * stiffness), rel=1e-10)


def _by_finite_elements(stretches, loads, bearings):
    """Deflection by Hermite elements of scikit-fem, one plane, at the bearings and loads."""
    from skfem import Basis, BilinearForm, ElementLineHermite, MeshLine, condense, solve
    from skfem.helpers import dd, ddot

    marks = {0.0, *(s.end for s in stretches), *bearings, *(load.at for load in loads)}
    points = np.array(sorted(marks))
    ends = np.array([s.end for s in stretches])
    stiffness = np.array([E * math.pi / 64.0 * s.diameter**4 for s in stretches])
    basis = Basis(MeshLine(points), ElementLineHermite(), intorder=4)

    @BilinearForm
    def bending(u, v, w):
        of = np.minimum(np.searchsorted(ends, w.x[0], side="right"), len(ends) - 1)
        return stiffness[of] * ddot(dd(u), dd(v))

    k = bending.assemble(basis)
    # Nodes of a line mesh keep the order of its points.
    at = {float(p): n for n, p in enumerate(basis.mesh.p[0])}
    f = np.zeros(basis.N)
    for load in loads:
        f[basis.nodal_dofs[0, at[load.at]]] += load.force[1]
        f[basis.nodal_dofs[1, at[load.at]]] -= load.couple[2]
    held = np.array([basis.nodal_dofs[0, at[b]] for b in bearings])
    u = solve(*condense(k, f, D=held))
    return {p: u[basis.nodal_dofs[0, n]] for p, n in at.items()}


@given(shafts())
@settings(max_examples=25, deadline=None)
def test_a_stepped_shaft_bends_as_by_finite_elements(shaft):
    stretches, loads, bearings = shaft
    places = sorted({0.0, *(s.end for s in stretches), *bearings, *(load.at for load in loads)})
    if min(np.diff(places)) < 0.5:
        return
    wanted = _by_finite_elements(stretches, loads, bearings)
    found = deflection(stretches, loads, bearings, E)
    size = max(max(map(abs, wanted.values())), 1e-9)
    for place, value in wanted.items():
        assert abs(at_position(found, place)[0][0] - value) <= 1e-6 * size


def test_a_bearing_that_yields_lets_its_end_go_by_its_force():
    load = PointLoad(30.0, (0.0, 900.0, 0.0))
    stretches = [Stretch(0.0, 90.0, 40.0)]
    found = deflection(stretches, [load], (0.0, 90.0), E, radial_compliance=(1e-5, 2e-5))
    assert at_position(found, 0.0)[0][0] == pytest.approx(600.0 * 1e-5)
    assert at_position(found, 90.0)[0][0] == pytest.approx(300.0 * 2e-5)


@given(st.floats(-1e4, 1e4), st.floats(0.0, 1e4), st.floats(0.0, 1e4))
def test_adjusted_bearings_carry_the_load_between_them_and_at_least_what_they_induce(load, a, b):
    one, other = shared_axial(load, a, b)
    assert other - one == pytest.approx(load, abs=1e-9 * (abs(load) + a + b))
    assert one >= a - 1e-9
    assert other >= b - 1e-9
    assert min(one - a, other - b) == pytest.approx(0.0, abs=1e-8)


@given(
    st.lists(
        st.tuples(st.floats(1.0, 1e4), st.floats(100.0, 1e4), st.floats(10.0, 3000.0)),
        min_size=1, max_size=6,
    ),
    st.sampled_from([3.0, 10.0 / 3.0]),
)  # fmt: skip
def test_a_spectrum_has_the_life_of_its_mean_load_however_it_is_ordered(bins, p):
    hours = [h for h, _, _ in bins]
    lives = [float(rating_life_hours(3e4, load, p, speed)) for _, load, speed in bins]
    turns = sum(h * n for h, _, n in bins)
    mean = (sum(h * n * load**p for h, load, n in bins) / turns) ** (1.0 / p)
    whole = float(rating_life_hours(3e4, mean, p, turns / sum(hours)))
    assert spectrum_life(hours, lives) == pytest.approx(whole, rel=1e-12)
    assert spectrum_life(hours[::-1], lives[::-1]) == pytest.approx(whole, rel=1e-12)
    halves = [h / 2.0 for h in hours]
    split = spectrum_life([*halves, *halves], [*lives, *lives])
    assert split == pytest.approx(whole, rel=1e-12)
