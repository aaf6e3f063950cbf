"""A shaft's shape is what its table says, and one shape is what drawings and solids are made of."""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.flanks.export.cad.dxf import Sheet
from asperity.flanks.export.turned import Bodies, sections_of, shaft_sections, volume
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.blanks import Blanks, wheel_sizes
from asperity.gearset.keys import key_of
from asperity.rating import rate_case
from asperity.shafts import WheelShaft, WormShaft
from asperity.shafts.drawing import draw_shaft, scale_with
from asperity.shafts.shape import shape_of

CASE = read_case("actuator-shafts", case_tables())
GEARSET = CASE.require(Gearset)
G = GEARSET.geometry
WORM, WHEEL = (shape_of(CASE.require(kind), G) for kind in (WormShaft, WheelShaft))


def given(kind, sections, mesh, **more):
    """Return a shaft of sections, bearings at its ends."""
    length = sum(one["length"] for one in sections)
    return kind(
        section=sections, mesh=mesh, bearing=[{"at": 1e-3}, {"at": length - 1e-3}], units="SI",
        **more,
    )  # fmt: skip


class Paper:
    """A pen that remembers lines and circles."""

    def __init__(self):
        self.lines, self.circles = [], []

    def line(self, points, pen="wide", *, closed=False):
        self.lines.append((np.array(points), pen))

    def circle(self, centre, radius, pen="wide"):
        self.circles.append((centre, radius))

    def dimension(self, *_):
        pass

    hatch = dimension


def test_the_profile_is_the_sections_of_the_table():
    assert WORM.length == 190.0
    assert WORM.threads == (60.0, 150.0)
    drive, free = WORM.profiles
    assert max(radius for place, radius in drive if place < 19.0) == 12.5
    assert drive[-1] == (60.0, 15.0)
    assert free[0] == (150.0, 15.0)
    assert WHEEL.bore == 55.0
    assert WHEEL.threads is None
    (whole,) = WHEEL.profiles
    assert whole[0] == (0.0, 0.0)
    assert whole[-1] == (170.0, 0.0)


def test_a_fillet_is_tangent_to_the_thinner_section_and_ends_on_the_other():
    # d 20 to 30, r 2: an arc of a quarter and the rest of the shoulder.
    table = given(
        WheelShaft,
        [{"length": 0.05, "diameter": 0.02, "fillet": 0.002}, {"length": 0.05, "diameter": 0.03}],
        0.07,
    )
    (profile,) = shape_of(table, G).profiles
    arc = [point for point in profile if 48.0 - 1e-9 <= point[0] <= 50.0 + 1e-9]
    assert arc[0] == pytest.approx((48.0, 10.0))
    for place, radius in arc[:-1]:
        assert math.hypot(place - 48.0, radius - 12.0) == pytest.approx(2.0)
    assert arc[-1] == pytest.approx((50.0, 15.0))
    # A radius above the step ends where it meets the surface: cos of its angle is 1 - h/r.
    table = given(
        WheelShaft,
        [{"length": 0.05, "diameter": 0.02, "fillet": 0.01}, {"length": 0.05, "diameter": 0.03}],
        0.07,
    )
    (profile,) = shape_of(table, G).profiles
    assert (50.0 - 10.0 * math.sqrt(0.75), 10.0) in [pytest.approx(point) for point in profile]


def test_a_fillet_longer_than_its_section_is_refused():
    table = given(
        WheelShaft,
        [{"length": 0.005, "diameter": 0.02, "fillet": 0.008}, {"length": 0.05, "diameter": 0.05}],
        0.03,
    )
    with pytest.raises(InputError, match=r"wheel_shaft\.section\.fillet is 8 mm.*has 5 mm"):
        shape_of(table, G)


def test_the_fillets_volume_is_that_of_a_ring():
    # Turned by Pappus: between an arc of a quarter and the corner, (1 - pi/4) r^2.
    def turned(fillet):
        sections = [
            {"length": 0.05, "diameter": 0.02, **fillet}, {"length": 0.05, "diameter": 0.03}
        ]  # fmt: skip
        return -volume(sections_of(shape_of(given(WheelShaft, sections, 0.07), G))[0])

    # The points of the arc are 5 deg apart, and chords leave a little more than it does.
    r, step = 2.0, math.radians(5.0)
    area = (1.0 - math.pi / 4.0) * r**2 + 18.0 * 0.5 * r**2 * (step - math.sin(step))
    centroid = 10.0 + r * (10.0 - 3.0 * math.pi) / (3.0 * (4.0 - math.pi))
    more = turned({"fillet": 0.002}) - turned({})
    assert more == pytest.approx(2.0 * math.pi * centroid * area, rel=1e-3)


def test_a_keyway_has_the_key_of_its_diameter():
    (way,) = WORM.keyways
    key = key_of(25.0, "")
    assert (way.width, way.depth, way.diameter) == (key.width, key.in_shaft, 25.0)
    assert 0.0 < way.start < way.end < 20.0
    tiny = given(WheelShaft, [{"length": 0.1, "diameter": 0.005, "notch": "keyway"}], 0.05)
    shape = shape_of(tiny, G)
    assert not shape.keyways
    assert "wheel_shaft.section.diameter is 5 mm" in shape.notes[0]


def test_bearings_stand_where_and_as_wide_as_they_are():
    pair, single = WORM.seats
    assert [(start, end) for start, end, _ in pair.rings] == [(14.0, 30.0), (30.0, 46.0)]
    # Back to back the contact lines part towards the shaft.
    assert pair.angles == pytest.approx((math.radians(40.0), -math.radians(40.0)))
    assert single.rings == ((172.0, 188.0, 0.0),)
    assert (single.bore, single.outside) == (30.0, 62.0)


def test_threads_without_a_section_of_their_own_are_b_1_long():
    table = given(WormShaft, [{"length": 0.3, "diameter": 0.03}], 0.15)
    start, end = shape_of(table, G).threads
    assert end - start == pytest.approx(G.worm_face_width)
    assert 0.5 * (start + end) == pytest.approx(150.0)


@pytest.mark.parametrize("shape", [WORM, WHEEL], ids=["worm", "wheel"])
def test_the_drawing_is_to_scale(shape):
    s, paper = scale_with(G, WORM, WHEEL), Paper()
    draw_shaft(paper, shape, s, 0.0)
    wide = np.concatenate([points for points, pen in paper.lines if pen == "wide"])
    assert np.ptp(wide[:, 0]) == pytest.approx(s * shape.length)
    # The outermost is a bearing's ring.
    assert np.abs(wide[:, 1]).max() == pytest.approx(0.5 * s * shape.largest)
    for seat in shape.seats:
        corners = {(round(x, 6), round(y, 6)) for x, y in wide}
        for start, end, _ in seat.rings:
            for place in (start, end):
                for radius in (0.5 * seat.bore, 0.5 * seat.outside):
                    at = round(s * (shape.mesh - place), 6), round(s * radius, 6)
                    assert at in corners


@pytest.mark.slow
def test_dxf_has_the_lines_that_the_report_has():
    pytest.importorskip("ezdxf")
    s, paper, sheet = 0.5, Paper(), Sheet(0.5)
    draw_shaft(paper, WORM, s, 0.0)
    draw_shaft(sheet, WORM, s, 0.0)
    drawn = [np.array(one.get_points("xy")) for one in sheet._space.query("LWPOLYLINE")]
    assert len(drawn) == len(paper.lines)
    for (points, _), line in zip(paper.lines, drawn, strict=True):
        assert np.abs(points / s * [1.0, -1.0] - line).max() < 1e-9


def test_solids_are_turned_from_the_same_profile():
    pair = Pair.of(GEARSET)
    bodies = Bodies.of(CASE, pair)
    assert bodies.worm == WORM
    drive, free = shaft_sections(pair, bodies)
    assert drive[0].tolist() == [0.0, 105.0]
    assert drive[-1].tolist() == [15.0, 45.0]
    assert free[-1].tolist() == [0.0, -85.0]
    assert wheel_sizes(G, bodies.blanks)["bore"] == 55.0


def test_a_shaft_thicker_than_the_threads_root_is_closed_at_both_ends():
    table = given(
        WormShaft,
        [{"length": 0.05, "diameter": 0.04}, {"length": 0.09}, {"length": 0.05, "diameter": 0.03}],
        0.095,
    )
    pair = Pair.of(GEARSET)
    thick, thin = shaft_sections(pair, Bodies(worm=shape_of(table, G)))
    assert thick[0][0] == thick[-1][0] == 0.0
    assert thin[0][0] == 15.0


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("blank.bore", "30 mm", r"blank\.bore is 30 mm; \[wheel_shaft\] is 55 mm thick"),
        ("blank.shaft_diameter", "20 mm", r"blank\.shaft_diameter and \[worm_shaft\] both"),
        ("blank.keyways", "wheel", r"blank\.keyways is 'wheel'; the section of \[wheel_shaft\]"),
    ],
)
def test_two_tables_do_not_say_the_same(key, value, said):
    case = read_case("actuator-shafts", case_tables(), [f"{key}={value}"])
    with pytest.raises(InputError, match=said):
        Bodies.of(case, Pair.of(GEARSET))
    from asperity.shafts.study import prepare

    with pytest.raises(InputError, match=said):
        prepare(case)


def test_what_both_tables_say_alike_is_taken():
    same = "blank.bore=55 mm", "blank.keyways=worm", "blank.web_width=12 mm"
    case = read_case("actuator-shafts", case_tables(), same)
    made = Bodies.of(case, Pair.of(GEARSET))
    assert made.blanks == Blanks(bore="55 mm", keyways="worm", web_width="12 mm")


def test_threads_in_front_lean_by_the_lead_to_the_side_of_the_hand():
    from asperity.gearset.drawing import draw_threads

    for hand, sign in (("right", 1.0), ("left", -1.0)):
        paper = Paper()
        draw_threads(paper, G, 1.0, hand, -45.0, 45.0)
        tip = 0.5 * G.worm_tip_diameter
        whole = [
            line for line, pen in paper.lines
            if pen == "narrow" and np.ptp(line[:, 1]) == pytest.approx(2.0 * tip)
        ]  # fmt: skip
        assert len(whole) > 10
        for line in whole:
            assert np.diff(line[:, 0])[0] == pytest.approx(sign * 0.5 * G.lead)
        outline = paper.lines[0][0]
        # A space stands over the wheel's tooth, and half a lead on at the other side.
        below = outline[outline[:, 1] > -G.centre_distance]
        assert np.interp(0.0, below[:, 0], below[:, 1]) == pytest.approx(
            0.5 * G.worm_root_diameter - G.centre_distance
        )


@pytest.mark.slow
def test_the_report_of_a_rating_shows_shafts_bearings_and_what_they_come_to():
    from asperity.runs import Run
    from asperity.shafts.study import beside_rating

    rated = beside_rating(CASE)(rate_case(CASE), Run())
    page = rated.to_html()
    assert "driven end on the right, scale 1:2" in page
    assert "without hub" not in page
    assert rated.views()["gearset"] in page
    for row in rated.rows:
        assert f"{row.standard} {row.name}" in page
    assert "without hub" in rate_case(CASE).to_html()


@pytest.mark.slow
def test_a_shaft_too_thick_for_its_wheel_is_rated_and_makes_no_solid():
    from asperity.runs import Run
    from asperity.shafts.study import beside_rating

    sections = "wheel_shaft.section=[{length='170 mm', diameter='150 mm'}]"
    case = read_case("actuator-shafts", case_tables(), [sections])
    page = beside_rating(case)(rate_case(case), Run()).to_html()
    assert "without the hub, which has no room" in page
    with pytest.raises(InputError, match=r"\[wheel_shaft\] is thick at its mesh: blank\.bore"):
        Bodies.of(case, Pair.of(GEARSET))


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        (
            "worm_shaft.section=[{length='50 mm', diameter='35 mm'}, {length='90 mm'}, "
            "{length='50 mm', diameter='30 mm'}]",
            "worm_shaft: bearing A has a bore of 30 mm and stands on a section of 35 mm",
        ),
        (
            "worm_shaft.section=[{length='50 mm', diameter='30 mm'}, {length='140 mm'}]",
            "worm_shaft: bearing B at 180 mm stands on the threads",
        ),
    ],
)
def test_a_bearing_that_cannot_sit_where_it_stands_is_told(setting, said):
    from asperity.runs import Run
    from asperity.shafts import study

    case = read_case("actuator-shafts", case_tables(), [setting])
    found = study.answer(study.prepare(case), Run())
    assert said in found.notes
    assert [one.end for one in found.found["worm_shaft"].model.misseated] == [said.split()[2]]
    rated = study.beside_rating(case)(rate_case(case), Run())
    assert said in rated.notes
    lives = {row.name[-1]: row.value for row in rated.rows if row.name.startswith("worm bearing")}
    assert {end for end, life in lives.items() if life == 0.0} == {said.split()[2]}
    said = " ".join(rated.brief().split())
    assert "cannot sit there" in said
    # What cannot be mounted lives for no time, and does not hold.
    assert "0 h of" in said
    assert "FAILS" in said


def moved(at, *more):
    """Return the case with the worm's second bearing at another place, m."""
    places = [f"{{at='30 mm'}}, {{at='{at} mm', carries='both'}}"]
    return read_case("actuator-shafts", case_tables(), [f"worm_shaft.bearing=[{places[0]}]", *more])


@pytest.mark.parametrize("at", [150, 185])
def test_the_span_of_the_standards_is_that_of_the_shaft(at):
    plain = read_case("actuator-duty", case_tables(), [f"operation.bearing_span={at - 30} mm"])
    found = rate_case(moved(at))
    assert found.rating_inputs.bearing_span == at - 30
    assert "operation.bearing_span" not in found.assumed
    # The same by the sized gearset's own way, and by the forces of the standard.
    assert found.iso14521["delta_m_mm"] == rate_case(plain).iso14521["delta_m_mm"]
    assert [one.to_json() for one in found.forces] == [
        one.to_json() for one in rate_case(plain).forces
    ]
    same = moved(at, f"operation.bearing_span={at - 30} mm")
    assert rate_case(same).iso14521["delta_m_mm"] == found.iso14521["delta_m_mm"]


@pytest.mark.parametrize(("at", "told"), [(180, None), (150, "75 mm from bearing A, of 120 mm")])
def test_a_mesh_that_is_not_midway_is_told_beside_the_standard(at, told):
    from asperity.runs import Run
    from asperity.shafts import study

    case = moved(at)
    notes = study.beside_rating(case)(rate_case(case), Run()).notes
    off = [note for note in notes if "midway" in note]
    assert [told in note for note in off] == ([] if told is None else [True])


def test_another_span_than_that_of_the_shaft_is_refused():
    words = r"operation\.bearing_span is 300 mm, and the bearings of \[worm_shaft\] stand 120 mm"
    with pytest.raises(InputError, match=words):
        rate_case(moved(150, "operation.bearing_span=300 mm"))


def test_sizing_takes_the_span_of_the_shaft():
    from asperity.start.gear import operation_of

    case = moved(150)
    assert operation_of(dict(case.raw)).bearing_span == pytest.approx(0.12, rel=1e-12)
    with pytest.raises(InputError, match=r"leave operation\.bearing_span out"):
        operation_of(dict(moved(150, "operation.bearing_span=300 mm").raw))


@pytest.mark.parametrize(
    ("length", "wide", "told"),
    [(90, None, "90 mm of threads, and b_1 is 71.38 mm"), (90, 90, ""),
     (60, None, "60 mm of threads, and b_1 is 71.38 mm"), (90, 40, "b_1 is 40 mm")],
)  # fmt: skip
def test_threads_of_another_length_than_the_gearset_has_are_told(length, wide, told):
    from asperity.shafts.model import model_of

    sections = (
        f"worm_shaft.section=[{{length='60 mm', diameter='30 mm'}}, "
        f"{{length='{length} mm'}}, {{length='{130 - length} mm', diameter='30 mm'}}]"
    )
    more = [] if wide is None else [f"gearset.worm_face_width={wide} mm"]
    case = read_case("actuator-shafts", case_tables(), [sections, "worm_shaft.mesh=95 mm", *more])
    model = model_of(case.require(WormShaft), case.require(Gearset).geometry)
    assert told in model.threads
    assert bool(told) == bool(model.threads)
    assert (model.threads in model.notes) == bool(told)


def test_bearings_that_sit_are_not_told_of():
    from asperity.runs import Run
    from asperity.shafts import study

    notes = study.answer(study.prepare(CASE), Run()).notes
    assert not [note for note in notes if "bearing A" in note or "bearing B" in note]
