"""A whole wheel by cyclic symmetry: against a sector of many teeth, and a disc in torsion."""

import dataclasses
import functools
import math
from types import SimpleNamespace

import numpy as np
import pytest
from apparatus.drives import case, problem

from asperity.contact.elastic import ElasticMaterial, elastic_body
from asperity.contact.interface.surface import contact_surface
from asperity.drive.deck.setup import TeethSetup
from asperity.drive.static.solve import wheel_of
from asperity.drive.teeth.rim_moves import MovingRim
from asperity.drive.teeth.sector import right_handed
from asperity.drive.teeth.whole import Ring, kept_blocks, with_web
from asperity.errors import InputError
from asperity.flanks.mesh.tooth import Counts, tooth
from asperity.flanks.wheel.frame import turned
from asperity.gearset.blanks import WheelBody, rim_radius
from asperity.runs.cache import Cache

COUNTS = Counts(flank=4, face=6, thickness=3, rim=3, land=2, low_fillet=2, high_fillet=2)
MATERIAL = ElasticMaterial(120e9, 0.35, 7500.0)
HELD = 1e3  # mm: a hub as wide as the rim's inside


@functools.cache
def wheel(rim):
    return right_handed(wheel_of(problem(f"gearset.rim_thickness={rim} mm")))


@functools.cache
def ring(rim, web, hub):
    made = wheel(rim)
    counts = COUNTS._replace(rim=max(3, round(rim / 1.5)))
    one = tooth(made, counts)
    surface = contact_surface(one, "flank_plus")
    mesh, held = with_web(one, WheelBody(web, hub), made.pair.geometry)
    assert mesh.scaled_jacobian().min() > 0.2
    assert np.array_equal(mesh.points[: len(one.points)], one.points)
    return Ring.of(mesh, held, surface.nodes, MATERIAL, 60), surface


def even(surface):
    """Forces of 1 N in all along the normal, spread evenly."""
    return surface.to_forces(surface.normals / surface.area).reshape(-1)


@pytest.mark.slow
def test_on_a_held_rim_it_is_the_sector_of_many_teeth():
    whole, surface = ring(4.3, 5.0, HELD)
    own, *further = whole.blocks(2)
    sector = tooth(wheel(4.3), COUNTS, teeth=11)
    body = elastic_body(sector, MATERIAL, element="hex8i", tied="inner")
    force = np.zeros((len(sector.points), 3))
    middle = contact_surface(sector, "flank_plus_5")
    force[middle.nodes] = even(middle).reshape(-1, 3)
    moved = body.response(force.reshape(-1)).reshape(-1, 3)
    one = even(surface)
    for m, block in enumerate((own, *further)):
        # In the mesh teeth follow one another about -Z.
        other = contact_surface(sector, f"flank_plus_{5 - m}")
        found = float(even(other) @ moved[other.nodes].reshape(-1))
        assert one @ block @ one == pytest.approx(found, rel=2e-3), m


@pytest.mark.slow
@pytest.mark.parametrize("rim", [2.2])
def test_a_rim_moved_by_its_web_carries_its_teeth_as_the_whole_wheel(rim):
    web = WheelBody(5.0, 23.2)
    own, *further = ring(rim, web.web_width, web.hub_radius)[0].blocks(2)
    made = wheel(rim)
    counts = COUNTS._replace(rim=max(3, round(rim / 1.5)))
    one = tooth(made, counts)
    surface = contact_surface(one, "flank_plus")
    moving = MovingRim.of(one, surface, web, made.pair.geometry, MATERIAL)
    sector = tooth(made, counts, teeth=5)
    body = elastic_body(sector, MATERIAL, element="hex8i", tied="inner")
    turn = turned(2 * 2.0 * math.pi / 60)
    force = np.zeros((len(sector.points), 3))
    middle = contact_surface(sector, "flank_plus_2")
    force[middle.nodes] = even(middle).reshape(-1, 3)
    held = np.zeros_like(force)
    points = body.mesh.points[body.tied] @ turn
    held[body.tied] = moving.at(points, {0: even(surface).reshape(-1, 3)}) @ turn.T
    moved = body.carried(force.reshape(-1, 1), held.reshape(-1, 1)).reshape(-1, 3)
    still = body.response(force.reshape(-1)).reshape(-1, 3)
    load = even(surface)
    for m in (-1, 0, 1):
        block = own if m == 0 else further[0] if m > 0 else further[0].T
        other = contact_surface(sector, f"flank_plus_{2 - m}")
        asked = float(load @ block @ load)
        found, before = (
            float(even(other) @ each[other.nodes].reshape(-1)) for each in (moved, still)
        )
        assert found == pytest.approx(asked, rel=0.02), m
        assert abs(before - asked) > 0.5 * asked


@pytest.mark.slow
def test_a_load_on_all_teeth_twists_the_web_as_a_disc():
    width, radii = 6.6, (40.0, 30.0)
    turns, torque = [], 0.0
    for hub in radii:
        whole, surface = ring(4.3, width, hub)
        x, y, _ = surface.positions.T
        about = np.stack([-y, x, np.zeros_like(x)], axis=-1)
        force = surface.nodal_area[:, None] * about
        torque = 60.0 * float((force * about).sum())
        turns.append(float(force.reshape(-1) @ whole.under(0).real @ force.reshape(-1)))
    shear = MATERIAL.youngs_modulus / (2.0 * (1.0 + MATERIAL.poissons_ratio))
    more = torque / (4.0 * math.pi * shear * 1e-3 * width)
    more *= 1e6 * (radii[1] ** -2 - radii[0] ** -2)
    assert (turns[1] - turns[0]) / (torque / 60.0) == pytest.approx(more, rel=5e-3)


@pytest.mark.slow
def test_a_thicker_rim_on_its_web_is_stiffer():
    found = []
    for rim in (2.2, 4.3, 8.6):
        whole, surface = ring(rim, 6.6, 40.0)
        found.append(even(surface) @ whole.blocks(0)[0] @ even(surface))
    assert found[0] > found[1] > found[2]


@pytest.mark.slow
def test_a_wider_web_and_a_larger_hub_are_stiffer():
    whole, surface = ring(4.3, 6.6, 40.0)
    one = even(surface)
    for width, hub in ((10.0, 40.0), (6.6, 50.0), (6.6, HELD)):
        assert one @ ring(4.3, width, hub)[0].blocks(0)[0] @ one < one @ whole.blocks(0)[0] @ one


def test_a_case_says_which_and_its_blank_how_wide():
    assert problem().wheel_body is None
    assert problem("drive.wheel_body=web", "blank.web_width=5 mm").wheel_body == WheelBody(
        5.0, problem("drive.wheel_body=web").wheel_body.hub_radius
    )
    given = problem("drive.wheel_body=web", "blank.hub_diameter=60 mm").wheel_body
    assert given.hub_radius == pytest.approx(30.0)
    assert dataclasses.astuple(given)[0] == pytest.approx(0.5 * wheel(4.3).blank.face_width)
    assert rim_radius(wheel(4.3).pair.geometry) > 50.0


def test_a_hub_that_leaves_no_rim_is_refused_before_anything_is_solved():
    with pytest.raises(InputError, match=r"blank\.hub_diameter is 150 mm; the inside of the rim"):
        problem("drive.wheel_body=web", "blank.hub_diameter=150 mm")


def test_a_wheel_is_condensed_once(monkeypatch, tmp_path):
    made = []

    def condensed(*asked):
        made.append(asked)
        return SimpleNamespace(blocks=lambda: [np.eye(3)] * 2)

    monkeypatch.setattr(Ring, "of", condensed)
    monkeypatch.setattr(Cache, "of_this_user", lambda *_: Cache(tmp_path))
    mesh = tooth(wheel(4.3), COUNTS)
    nodes = np.arange(8)
    for loaded in (nodes, nodes, nodes[:4]):
        found = kept_blocks(mesh, nodes[:2], loaded, MATERIAL, 60)
        np.testing.assert_array_equal(found, [np.eye(3)] * 2)
    # What else is loaded is another condensation.
    assert len(made) == 2


def test_a_deck_of_a_wheel_on_its_web_is_refused():
    given = case("drive.wheel_body=web")
    with pytest.raises(InputError, match="a deck holds the inside of the rim"):
        TeethSetup.from_case(given)
