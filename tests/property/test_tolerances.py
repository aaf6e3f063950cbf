"""Assemblies made at random lie within the backlash that their tolerances leave.

By the exact flanks: how thick thread and tooth are turns out in the play exactly, where the worm
stands is solved for. Deviations are normal, cut off at their limits, three standard deviations from
their middle. The interval is that of ``asperity rate``, and of ``asperity flank``.
"""

import dataclasses
import functools

import numpy as np
import pytest
from apparatus.duties import A100
from apparatus.grid import slow

import asperity
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.flanks.measuring.corners import Mounted, Offset
from asperity.flanks.meshing.backlash import worm_turn
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.parameters import Hob, Mount
from asperity.flanks.sides import both
from asperity.flanks.study.rated_play import Manufacture, exact_backlash
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.allowances import fit_backlash
from asperity.gearset.tolerancing.backlash import backlash
from asperity.gearset.tolerancing.table import Temperatures, Tolerances
from asperity.gearset.tolerancing.warmth import Warmth

OFFS = 'tolerances.thread=["-40 um", "-70 um"]', 'tolerances.tooth=["-50 um", "-100 um"]'
GIVEN = Tolerances(centre_distance="js7", thread=["-40 um", "-70 um"], tooth=["-50 um", "-100 um"])
ASSEMBLIES, PARTS = 10_000, 100
THREAD, TOOTH = (40.0, 70.0), (50.0, 100.0)
SHIPPED = "gearset-3", "actuator-duty"
MADE = [("A100", None), ("A100", 1.05), ("gearset-3", "own"), *(
    (case, hob) for case in SHIPPED for hob in (None, 1.05))]  # fmt: skip
"""Gearsets, and by how much their hob is larger than the worm: None, it is; "own", the case's."""


@functools.cache
def gearset_of(name):
    return A100 if name == "A100" else read_case(name, case_tables()).require(Gearset)


def hob_of(name, oversize):
    if oversize == "own":
        return read_case(name, case_tables()).require(Hob)
    return None if oversize is None else Hob(oversize=oversize)


@functools.cache
def mounted(name="A100", oversize=1.05):
    pair = Pair.of(gearset_of(name), hob_of(name, oversize))
    return Mounted.of(pair, Wheel.cut(pair), GIVEN)


@functools.cache
def interval(name="A100", oversize=1.05):
    """What a rating says of it: by the command where the gearset ships."""
    if name == "A100":
        return exact_backlash(A100, Manufacture(hob_of(name, oversize)), GIVEN).states["new"]
    own = [f"hob.oversize={oversize or 1.0}", "hob.tilt=0 deg"] if oversize != "own" else []
    rated = asperity.rate(name, settings=["tolerances.centre_distance=js7", *OFFS, *own])
    assert rated.backlash.by == "by the exact flanks"
    return rated.backlash.states["new"]


def drawn(count, seed, off):
    """Thicknesses that are missing, normal thread and tooth, and offsets of the centre, um."""
    rng = np.random.default_rng(seed)
    sigmas = np.empty((count, 3))
    for column in range(3):
        values = rng.standard_normal(2 * count)
        sigmas[:, column] = values[np.abs(values) <= 3.0][:count]
    middle = np.array([np.mean(THREAD), np.mean(TOOTH), 0.0])
    half = np.array([np.ptp(THREAD), np.ptp(TOOTH), 2.0 * off]) / 2.0
    return middle + half * sigmas / 3.0


def off_of(name):
    """How far the centre distance may be off, um."""
    return 1e3 * mounted(name, None).deviations.centre_distance


def assembled(thread, tooth, off, name="A100", oversize=1.05):
    """Backlash on the mean circle of an assembly, um, from its own threads and place."""
    own = mounted(name, oversize)
    pair, g = own.pair, own.pair.geometry
    slant = np.cos(pair.worm.lead_angle)
    thin = pair.with_worm(pair.worm.half_space + 0.5e-3 * thread / slant)
    stood = Offset(1e-3 * off).of(thin)
    turn = worm_turn(both(lambda side: transmission(stood, own.wheel.flank(side))))
    return 0.5e3 * g.wheel_mean_diameter * turn / pair.ratio + tooth


@functools.cache
def plays_of(name, oversize):
    """Backlash by the offset of the centre, um: a polynomial to each side of none.

    An identical hob has a kink there.
    """
    own, off = mounted(name, oversize), off_of(name)
    place = 0.5 * off * (1.0 - np.cos(np.pi * np.arange(7) / 6))
    sides = []
    for sign in (-1.0, 1.0):
        values = [own.play(Offset(1e-3 * sign * value)) for value in place]
        sides.append(np.polynomial.Polynomial.fit(sign * place, values, 6))
    return lambda value: np.where(value < 0.0, sides[0](value), sides[1](value))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "oversize"), MADE)
def test_centre_distance_moves_the_exact_backlash_smoothly_to_each_side(name, oversize):
    # So that what follows takes the flanks' own numbers between the places that are solved.
    plays = plays_of(name, oversize)
    for off in off_of(name) * np.random.default_rng(3).uniform(-1.0, 1.0, 3):
        solved = mounted(name, oversize).play(Offset(1e-3 * off))
        assert float(plays(off)) == pytest.approx(solved, abs=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "oversize"), MADE)
def test_of_ten_thousand_assemblies_the_squares_contain_99_7_percent_and_the_worst_case_all(
    name, oversize
):
    own, found = mounted(name, oversize), interval(name, oversize)
    g = own.pair.geometry
    thread, tooth, off = drawn(ASSEMBLIES, 1, off_of(name)).T
    # In units of the mean circle, which turns as the reference circle does.
    along = thread / np.cos(g.lead_angle) * g.wheel_mean_diameter / g.wheel_reference_diameter
    values = plays_of(name, oversize)(off) + along + tooth
    assert found.least <= values.min() < values.max() <= found.greatest
    share = np.mean((values >= found.likely_least) & (values <= found.likely_greatest))
    assert share >= 0.997
    # Not by being too wide: what is wider than three standard deviations says nothing.
    assert found.likely_greatest - found.likely_least < 6.5 * values.std()


@pytest.mark.slow
@pytest.mark.campaign(over="part")
@pytest.mark.parametrize("part", range(PARTS))
def test_assemblies_solved_one_by_one_lie_within(part):
    found = interval()
    rows = drawn(ASSEMBLIES, 2, off_of("A100"))[part::PARTS]
    values = np.array([assembled(*row) for row in rows])
    assert found.least <= values.min() <= values.max() <= found.greatest
    inside = (values >= found.likely_least) & (values <= found.likely_greatest)
    assert np.mean(inside) >= 0.97


@pytest.mark.slow
@pytest.mark.parametrize(("name", "oversize"), MADE)
def test_the_worst_assembly_is_the_least_of_the_interval(name, oversize):
    found, off = interval(name, oversize), off_of(name)
    given = {"name": name, "oversize": oversize}
    assert assembled(THREAD[0], TOOTH[0], -off, **given) == pytest.approx(found.least, abs=1e-5)
    assert assembled(THREAD[1], TOOTH[1], off, **given) == pytest.approx(found.greatest, abs=1e-5)


def test_a_rating_says_that_a_gearset_may_jam_where_its_worst_assembly_does():
    # By the formula, which knows no hob, 10 um are left.
    settings = ["tolerances.centre_distance=js9", 'tolerances.thread=["0 um", "-10 um"]',
                'tolerances.tooth=["-40 um", "-60 um"]']  # fmt: skip
    rated = asperity.rate("gearset-3", settings=settings)
    given = Tolerances(centre_distance="js9", thread=["0 um", "-10 um"],
                       tooth=["-40 um", "-60 um"])  # fmt: skip
    assert backlash(rated.gearset, given).least > 0.0 > rated.backlash.least
    pair = Pair.of(rated.gearset, read_case("gearset-3", case_tables()).require(Hob))
    own = Mounted.of(pair, Wheel.cut(pair), given)
    worst = own.play(Offset(-own.deviations.centre_distance)) + 40.0
    assert rated.backlash.states["new"].least == pytest.approx(worst, abs=1e-9)
    assert "MAY JAM" in rated.brief()


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_a_fit_leaves_its_least_backlash_by_the_exact_flanks(name):
    # Hob and mounting take more of it than the formula knows.
    hob = read_case(name, case_tables()).get(Hob)
    found = exact_backlash(
        gearset_of(name), Manufacture(hob), Tolerances(centre_distance="js9", fit="C")
    )
    least = 1e3 * fit_backlash(gearset_of(name).geometry.centre_distance, "C")
    assert found.least == pytest.approx(least, abs=1e-9)


def test_a_fit_that_leaves_none_does_not_jam_by_rounding():
    hob = read_case("gearset-3", case_tables()).get(Hob)
    given = Tolerances(centre_distance="js7", fit="H")
    found = exact_backlash(gearset_of("gearset-3"), Manufacture(hob), given)
    assert found.least == 0.0
    assert "MAY JAM" not in str(found.sentence())


@pytest.mark.slow
def test_a_hob_that_is_the_worm_leaves_no_play_and_no_overlap():
    for name in ("A100", *SHIPPED):
        own = mounted(name, None)
        assert own.play(Offset()) == pytest.approx(0.0, abs=1e-6)
        less = exact_backlash(gearset_of(name), Manufacture(), GIVEN).states["new"]
        solved = exact_backlash(gearset_of(name), Manufacture(Hob()), GIVEN).states["new"]
        assert less == pytest.approx(solved, abs=1e-6)


@pytest.mark.slow
def test_a_warm_backlash_is_that_of_axes_as_far_apart():
    hot = GIVEN.model_copy(update={"temperatures": Temperatures(gears="80 degC")})
    states = exact_backlash(A100, Manufacture(), hot).states
    apart = Warmth.of(A100, hot.temperatures, hot.housing).apart
    worst = mounted("A100", None).play(Offset(apart - 1e-3 * off_of("A100")))
    new = mounted("A100", None).play(Offset(-1e-3 * off_of("A100")))
    assert states["warm"].least - states["new"].least == pytest.approx(worst - new, abs=1e-5)
    # Closing, it takes more than the formula has.
    assert states["warm"].least - states["new"].least < backlash(A100, hot).warmth < 0.0


@pytest.mark.slow
def test_an_identical_hob_makes_the_centre_distance_count_more_where_it_closes():
    # The flanks touch at the edges of the face there, under another angle than in its middle.
    pair = Pair.of(A100)
    own = Mounted.of(pair, Wheel.cut(pair), GIVEN)
    off = 1e-3 * off_of("A100")
    closed, opened = own.play(Offset(-off)), own.play(Offset(off))
    middle = backlash(A100, GIVEN).parts[2].greatest
    assert 0.0 < opened < middle < -closed


@pytest.mark.slow
@pytest.mark.parametrize(("hob", "mount"), [
    slow(None, Mount(shaft_angle_error="0.03 deg")), (Hob(tilt="0.03 deg"), None)])  # fmt: skip
def test_where_the_worm_stands_as_its_hob_stood_an_angle_that_may_be_off_leaves_most(hob, mount):
    given = Tolerances(shaft_angle="0.08 deg", thread=["-100 um", "-102 um"],
                       tooth=["-20 um", "-22 um"])  # fmt: skip
    found = exact_backlash(gearset_of("actuator-duty"), Manufacture(hob, mount), given)
    # An identical hob leaves no play of its own there: what is left is off thread and tooth.
    _, thread, tooth, angle = found.parts
    assert found.states["new"].greatest == pytest.approx(thread.greatest + tooth.greatest, abs=1e-3)
    assert angle.greatest == pytest.approx(-found.parts[0].middle, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("oversize", [1.0, 1.05])
def test_no_place_has_more_play_than_the_worst_case_however_the_worm_is_mounted(oversize):
    gearset = gearset_of("actuator-duty")
    mount = Mount(axial_offset="15 um", shaft_angle_error="0.03 deg")
    given = Tolerances(axial_offset="40 um", shaft_angle="0.2 deg")
    pair = Pair.of(gearset, Hob(oversize=oversize), mount)
    own = Mounted.of(pair, Wheel.cut(pair), given)
    plays = own.plays()
    rng = np.random.default_rng(7)
    for _ in range(40):
        place = Offset(*(rng.uniform(-1, 1, 3) * own.deviations))
        assert min(plays.values()) - 1e-6 <= own.play(place) <= max(plays.values()) + 1e-3


@pytest.mark.slow
def test_no_place_within_the_mounting_tolerances_has_less_play_than_their_corners():
    given = dataclasses.replace(mounted(), deviations=Offset(0.02, 0.03, 1e-3))
    least = min(given.play(place) for place in given.places((-1, 1)))
    rng = np.random.default_rng(5)
    for _ in range(12):
        place = Offset(*(rng.uniform(-1, 1, 3) * given.deviations))
        assert given.play(place) >= least - 1e-6
