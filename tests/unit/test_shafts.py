"""What the tables of shafts and bearings take, and what is refused of them."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.parameters import STEEL_MODULUS
from asperity.drive.shafts import bending_stiffness, compliances
from asperity.drive.worm_shaft import shaft_of
from asperity.errors import InputError
from asperity.runs import Run
from asperity.shafts import RollingBearing, ShaftBearing, ShaftSection, ShaftSteel, WormShaft
from asperity.shafts import study as shafts
from asperity.shafts.beam import mesh_compliance
from asperity.shafts.bearings import Carried, life_of
from asperity.shafts.loads import EVERY, conditions
from asperity.shafts.model import model_of, share_axial
from asperity.shafts.options import BearingOptions
from asperity.shafts.strength.section import Actions, Detail, judged, strength


def case_of(*settings):
    return read_case("actuator-shafts", case_tables(), settings)


def solved(*settings):
    return shafts.answer(shafts.prepare(case_of(*settings)), Run())


BALL = {
    "kind": "deep groove", "bore": "30 mm", "series": "02", "dynamic_rating": "20 kN",
    "static_rating": "11 kN", "f0": 13.8,
}  # fmt: skip
ROLLER = {key: value for key, value in BALL.items() if key != "f0"}
ANGULAR = ROLLER | {"kind": "angular contact", "contact_angle": "40 deg"}
TAPER = ROLLER | {"kind": "taper", "e": 0.37, "Y": 1.6, "Y0": 0.9}


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (BALL | {"series": "04"}, "bearing.series is '04'; it must be one of '10', '02', '03'"),
        (BALL | {"bore": "31 mm"}, "bearing.bore is '31 mm'; the dimensions of series 02 are"),
        (BALL | {"f0": None}, "bearing.f0 is missing; a deep groove bearing needs it"),
        ({k: v for k, v in BALL.items() if k != "series"}, "bearing.outside_diameter is missing"),
        (ANGULAR | {"contact_angle": "35 deg"}, "bearing.contact_angle is 35 deg; factors are"),
        (
            TAPER | {"contact_angle": "15 deg"},
            "bearing.contact_angle is given, which does not count with kind = 'taper'",
        ),
        (
            ANGULAR | {"f0": 13.8},
            "bearing.f0 is given, which does not count with kind = 'angular contact'",
        ),
        (TAPER | {"Y": None}, "bearing.Y is missing; a taper bearing needs it"),
        (BALL | {"dynamic_rating": "20"}, "bearing.dynamic_rating is '20'"),
        (BALL | {"dynamic_rating": "-20 kN"}, "bearing.dynamic_rating is '-20 kN'"),
        (BALL | {"outside_diameter": "20 mm"}, "bearing.outside_diameter is 20 mm; it must be"),
    ],
)
def test_a_bearing_that_cannot_be_is_refused_in_a_line(given, said):
    with pytest.raises(InputError) as refused:
        RollingBearing.model_validate(given, context={"text_only": True})
    assert str(refused.value).startswith(said)
    assert "\n" not in str(refused.value)


def test_a_bearing_has_the_dimensions_of_its_series():
    found = RollingBearing.model_validate(BALL, context={"text_only": True})
    assert (found.outside_diameter, found.width) == (0.062, 0.016)
    assert found.pitch_diameter == pytest.approx(46.0)


TWO = "[{at='10 mm',carries='both'},{at='90 mm'}]"


@pytest.mark.parametrize(
    ("setting", "said"),
    [
        ("worm_shaft.mesh='250 mm'", "worm_shaft.mesh is 250 mm; the sections end at 190 mm"),
        (
            "worm_shaft.mesh='20 mm'",
            "worm_shaft.mesh is 20 mm; its threads are at 60 to 150 mm from the end, and the teeth",
        ),
        (
            "worm_shaft.bearing=[{at='105 mm',carries='both'},{at='180 mm'}]",
            "worm_shaft.mesh is 105 mm, where a bearing stands; the teeth touch between",
        ),
        ("worm_shaft.mesh='250'", "worm_shaft.mesh is 250 without a unit"),
        ("worm_shaft.section=[]", "worm_shaft.section is []; it must be a list of tables"),
        ("worm_shaft.section=3", "worm_shaft.section is 3; it must be a list of tables"),
        ("wheel_shaft.bearing=[{at='10 mm'}]", "wheel_shaft.bearing has 1 places; a shaft has two"),
        (
            "wheel_shaft.bearing=[{at='10 mm'},{at='10 mm'}]",
            "wheel_shaft.bearing.at is 10 mm twice; the bearings must stand apart",
        ),
        (
            "wheel_shaft.bearing=[{at='10 mm',carries='both'},{at='90 mm',carries='away'}]",
            "wheel_shaft.bearing.carries: both bearings carry the axial force 'away'",
        ),
        ("wheel_shaft.section=[{length='170 mm'}]", "wheel_shaft.section.diameter is missing"),
        ("wheel_shaft.material='unobtainium'", "wheel_shaft.material: shaft_steel is 'unobtain"),
        (
            "worm_shaft.load=[{at='0 mm',element='rope',diameter='1 m'}]",
            "worm_shaft.load, number 1 of the list: load.element is 'rope'; it must be one of",
        ),
        (
            "worm_shaft.load=[{at='0 mm',element='v-belt'}]",
            "worm_shaft.load, number 1 of the list: load.diameter and load.element belong together",
        ),
        ("worm_shaft.load=[{at='0 mm'}]", "worm_shaft.load, number 1 of the list: load.radial is"),
        ("bearings.reliability='93 %'", "bearings.reliability is 93; it must be one of 90"),
        ("bearings.contamination=clean", "bearings.contamination is 'clean'; it must be one of"),
        ("bearings.raises=up", "bearings.raises is 'up'; it must be one of"),
        ("worm_shaft.peak=0.5", "worm_shaft.peak is 0.5; it must be at least 1"),
    ],
)
def test_a_shaft_that_cannot_be_is_refused_in_a_line(setting, said):
    with pytest.raises(InputError) as refused:
        case_of(setting)
    text = str(refused.value)
    assert said in text
    assert "\n" not in text


@pytest.mark.parametrize(
    ("arrangement", "kind", "said"),
    [
        ("single", ANGULAR, "one angular contact bearing alone does not locate a shaft"),
        ("pair back-to-back", BALL, "a deep groove bearing is single"),
        ("adjusted face-to-face", BALL, "a deep groove bearing cannot be adjusted"),
        ("pair back-to-back", TAPER, "give taper bearings as adjusted"),
        ("pair tandem", ANGULAR, "which carries one way"),
    ],
)
def test_an_arrangement_that_cannot_be_is_refused(arrangement, kind, said):
    with pytest.raises(InputError, match=said):
        ShaftBearing.model_validate(
            {"at": "10 mm", "bearing": kind, "arrangement": arrangement},
            context={"text_only": True},
        )


def test_a_groove_needs_its_depth_and_radius():
    with pytest.raises(InputError, match=r"groove_depth and section\.groove_radius belong"):
        ShaftSection(length="10 mm", diameter="20 mm", notch="groove")
    with pytest.raises(InputError, match="below half the diameter"):
        ShaftSection(
            length="10 mm", diameter="20 mm", notch="groove", groove_depth="10 mm",
            groove_radius="1 mm",
        )  # fmt: skip


def test_a_case_without_shafts_is_told_which_tables_to_add():
    case = read_case("gearset-3", case_tables())
    with pytest.raises(InputError, match=r"gearset-3: the table \[worm_shaft\] is missing"):
        shafts.prepare(case)


def test_an_axial_force_that_no_bearing_carries_is_refused():
    one_way = f"wheel_shaft.bearing={TWO.replace('both', 'away')}"
    with pytest.raises(InputError, match=r"no bearing carries the axial force of 322\.3 N towards"):
        solved(one_way)


def test_a_load_that_never_reverses_keeps_the_sign_of_the_axial_force():
    assert len(conditions(None)) == len(EVERY) == 4
    found = solved("bearings.raises=clockwise").found["worm_shaft"]
    axial = [each.carried.axial for each in found.hardest]
    assert len(axial) == 2
    assert axial[0] == axial[1] < 0.0


def test_face_to_face_the_bearing_carries_what_pushes_towards_it_and_back_to_back_the_other():
    taper = {"bearing": TAPER, "at": "10 mm"}
    for arrangement, pushed in (("adjusted face-to-face", 0), ("adjusted back-to-back", 1)):
        places = [
            ShaftBearing.model_validate(
                taper | {"arrangement": arrangement}, context={"text_only": True}
            )
        ] * 2
        # Towards the end, where the first bearing stands.
        found = share_axial("worm_shaft", places, 5000.0, (800.0, 800.0))
        assert found.loads[pushed] == 5250.0
        assert found.loads[1 - pushed] == 250.0
        assert sum(found.forces) == pytest.approx(5000.0)


def test_a_bearing_lasts_longer_in_cleaner_and_thicker_oil():
    place = ShaftBearing.model_validate(
        {"at": "0 mm", "bearing": BALL}, context={"text_only": True}
    )

    def life(contamination, viscosity):
        load = Carried(2000.0, 0.0, 100.0, 1000.0, viscosity)
        return life_of(place, [load], BearingOptions(contamination=contamination)).judged_hours

    dirt = [life(word, 30.0) for word in ("severe", "typical", "slight", "normal", "high")]
    assert dirt == sorted(dirt)
    assert dirt[0] < dirt[-1]
    assert life("normal", 10.0) < life("normal", 20.0) < life("normal", 40.0)


def test_a_higher_reliability_costs_life():
    place = ShaftBearing.model_validate(
        {"at": "0 mm", "bearing": BALL}, context={"text_only": True}
    )
    load = [Carried(2000.0, 0.0, 100.0, 1000.0, 30.0)]
    found = life_of(place, load, BearingOptions(reliability="95 %"))
    assert found.judged_hours == pytest.approx(0.64 * found.rating_life)
    assert life_of(place, load, BearingOptions()).modified is None


STEEL = ShaftSteel(tensile_strength="1100 MPa", yield_strength="900 MPa")
FILLET = Detail(0.0, "fillet", 25.0, "shoulder", 6.3, 30.0, 30.0, 1.0)


def safeties(kind="constant", **changes):
    actions = Actions(**({"bending": 60.0, "torque": 200.0, "axial": 3000.0} | changes))
    return judged(FILLET, STEEL, strength(FILLET, STEEL), actions, torque=kind)


def test_a_torque_that_reverses_tires_more_than_one_that_stands():
    constant, pulsating, reversing = (
        safeties(torque).fatigue_2 for torque in ("constant", "pulsating", "reversing")
    )
    assert constant > pulsating > reversing
    assert safeties("constant").yielding == safeties("reversing").yielding


def test_twice_the_load_has_half_the_safety_where_the_ratio_stays():
    one = safeties()
    two = safeties(bending=120.0, torque=400.0, axial=6000.0)
    for key in ("fatigue_2", "yielding", "goodman"):
        assert getattr(one, key) == pytest.approx(2.0 * getattr(two, key), rel=1e-12)


def test_a_section_that_carries_nothing_has_no_end_of_safety():
    assert safeties(bending=0.0, torque=0.0, axial=0.0).fatigue_1 == math.inf


def test_a_mean_stress_that_is_too_much_leaves_no_safety_in_case_1():
    assert safeties(axial=3e6).fatigue_1 == 0.0


def test_hardening_and_smoothness_help():
    rough, smooth = (strength(FILLET._replace(roughness=rz), STEEL).part[0] for rz in (25.0, 1.6))
    assert smooth > rough
    plain, hard = (strength(FILLET, STEEL, k).part[0] for k in (1.0, 1.2))
    assert hard == pytest.approx(1.2 * plain, rel=1e-12)


def test_a_v_belt_pulls_by_the_torque_of_the_worm():
    belt = "worm_shaft.load=[{at='0 mm',element='v-belt',diameter='90 mm'}]"
    found = solved(belt).found["worm_shaft"].hardest[0]
    torque = abs(1e-3 * found.carried.torque)
    assert found.loads[1].force[1] == pytest.approx(1.75 * 2e3 * torque / 90.0, rel=1e-12)


def test_a_step_without_a_fillet_is_not_judged_and_said_so():
    notes = solved().notes
    assert any("the step from 30 to 31.86 mm at 60 mm has no fillet" in note for note in notes)
    assert any("notch factors of 2 and 1.7, which are assumed" in note for note in notes)


def test_a_shaft_without_a_material_has_loads_and_lives_alone():
    case = case_of().replace_values({"worm_shaft.material": None})
    found = shafts.answer(shafts.prepare(case), Run())
    assert found.found["worm_shaft"].sections == ()
    assert "worm_shaft.material is not given: its strength is not judged" in found.notes


def test_the_drive_takes_from_the_worms_shaft_what_its_own_lacks():
    case = case_of()
    shaft = shaft_of(case)
    model = model_of(case.require(WormShaft), case["gearset"].geometry)
    wanted = mesh_compliance(model.stretches, model.bearings, model.mesh, model.modulus)[0, 0]
    given = compliances(
        0.02, span=shaft.span, bending=bending_stiffness(shaft.diameter, STEEL_MODULUS)
    )
    assert shaft.span == pytest.approx(0.15)
    assert given["bending"][3, 3] == pytest.approx(1e-3 * wanted, rel=1e-12)
    # By hand: 20 mm of 25, 40 of 30 and 45 of 1.1 root diameters.
    root = 1.1 * float(case["gearset"].geometry.worm_root_diameter)
    lengths, diameters = (20.0, 40.0, 45.0), (25.0, 30.0, root)
    twists = sum(32.0 * a / (math.pi * d**4) for a, d in zip(lengths, diameters, strict=True))
    assert shaft.torsion == pytest.approx(1e-3 * 206e3 / 2.6 / twists, rel=1e-12)
    own = shaft_of(case_of("shaft.torsional_stiffness='4000 N m/rad'"))
    assert own.torsion == 4000.0
    assert own.diameter == pytest.approx(shaft.diameter)


def test_a_drive_without_a_worm_shaft_keeps_its_own():
    case = read_case("drive-thesis", case_tables())
    assert shaft_of(case) == case["shaft"]


def test_bearings_that_yield_do_so_for_the_drive_too():
    yields = (
        "worm_shaft.bearing=[{at='30 mm',carries='both',stiffness='100 kN/mm'},"
        "{at='180 mm',stiffness='300 kN/mm'}]"
    )
    # Midway each end moves half: (1/100 + 1/300)/4 um/N.
    assert shaft_of(case_of(yields)).bearing_radial == pytest.approx(150e6)
    found = solved(yields)
    assert found.worm_deflection > solved().worm_deflection


def test_a_step_with_a_rotation_of_its_own_has_it_in_every_case():
    steps = (
        "operation.duty_cycle=[{duration='1 h',output_torque='250 N m',rotation='clockwise'},"
        "{duration='1 h',output_torque='100 N m',rotation='anticlockwise',drives='load'}]"
    )
    found = solved(steps).found["worm_shaft"]
    # What drives in the first step is still open.
    assert len(found.cases) == 2
    for case in found.every:
        assert [each.condition.rotation for each in case] == ["clockwise", "anticlockwise"]
        assert case[1].condition.drives == "load"


@pytest.mark.slow
def test_many_loads_have_what_each_has_alone():
    step = "{duration='10 h',output_torque='%g N m',worm_speed='%g rpm'}"
    loads = [(250.0 - 4.0 * place, 1400.0 - 20.0 * place) for place in range(20)]
    many = solved(f"operation.duty_cycle=[{','.join(step % load for load in loads)}]").loads
    for own, load in list(zip(many, loads, strict=True))[::7]:
        first = step % load
        torque = "operation.output_torque='250 N m'"
        alone, *rated = solved(torque, f"operation.duty_cycle=[{first}]").loads
        assert len(rated) == (load[0] < 250.0)
        for key in ("tangential", "axial", "radial", "driven", "viscosity", "speed", "hours"):
            assert getattr(own, key) == pytest.approx(getattr(alone, key), rel=1e-12)


def test_a_rated_torque_above_every_part_is_seen_by_all_but_the_lives():
    rated, known = solved("operation.output_torque='1000 N m'"), solved()
    # Of one torque, with the friction and the speed that the hardest part has.
    (alone,) = {load for load in rated.loads if load.like is not None}
    hardest = known.loads[0]
    assert (alone.hours, alone.torque, alone.speed) == (0.0, 1000.0, hardest.speed)
    for key in ("tangential", "axial", "radial", "driven"):
        assert getattr(alone, key) == pytest.approx(4.0 * getattr(hardest, key), rel=1e-12)
    assert rated.worm_deflection == pytest.approx(4.0 * known.worm_deflection, rel=1e-9)
    for own, other in zip(rated.rows, known.rows, strict=True):
        assert own.name == other.name
        if own.standard == "ISO 281":
            assert own == other
        elif own.standard == "ISO 76":
            assert own.value == pytest.approx(other.value / 4.0, rel=1e-9)
        else:
            assert own.value < 0.3 * other.value
    # As high as a part there is no load beside them.
    assert len(known.loads) == 3


def test_the_application_factor_loads_shafts_and_bearings_as_it_loads_the_teeth():
    found, known = solved("operation.application_factor=2"), solved()
    for own, other in zip(found.loads, known.loads, strict=True):
        assert (own.torque, own.hours) == (other.torque, other.hours)
        for key in ("tangential", "axial", "radial", "driven"):
            assert getattr(own, key) == pytest.approx(2.0 * getattr(other, key), rel=1e-12)
    assert found.iso_deflection == pytest.approx(2.0 * known.iso_deflection, rel=1e-9)
    assert found.worm_deflection == pytest.approx(2.0 * known.worm_deflection, rel=1e-9)
    assert found.least_yield_safety == pytest.approx(known.least_yield_safety / 2.0, rel=1e-9)
    assert found.least_static_safety == pytest.approx(known.least_static_safety / 2.0, rel=1e-9)
    assert any("K_A = 2 times" in note for note in found.notes)
    assert not any("K_A" in note for note in known.notes)


def test_a_rated_torque_has_each_rotation_that_a_part_has():
    steps = (
        "operation.duty_cycle=[{duration='1 h',output_torque='100 N m',rotation='clockwise'},"
        "{duration='1 h',output_torque='80 N m',rotation='anticlockwise',drives='load'}]"
    )
    found = solved(steps)
    rated = [load for load in found.loads if load.like is not None]
    assert [(one.rotation, one.lets_down) for one in rated] == [
        ("clockwise", False), ("anticlockwise", True),
    ]  # fmt: skip
    for case in found.found["worm_shaft"].every:
        assert [one.condition.rotation for one in case] == ["clockwise", "anticlockwise"] * 2


def test_a_spectrum_gives_the_loads_of_a_duty_cycle():
    case = case_of().replace_values({"operation.duty_cycle": None})
    steps = (
        "spectrum.step=[{duration='500 h',output_torque='250 N m'},"
        "{duration='1500 h',output_torque='150 N m'},"
        "{duration='3000 h',output_torque='60 N m',worm_speed='700 rpm'}]"
    )
    found = shafts.answer(shafts.prepare(case.replace([steps])), Run())
    wanted = solved()
    assert [load.hours for load in found.loads] == [500.0, 1500.0, 3000.0]
    for own, other in zip(found.loads, wanted.loads, strict=True):
        assert own.tangential == pytest.approx(other.tangential, rel=1e-12)
    assert found.life == wanted.life == pytest.approx(5000.0)


def test_the_radial_force_pushes_the_worm_away_from_the_wheel():
    case = solved().to_json()["worm_shaft"]["cases"]["clockwise_worm_drives"]
    assert case["mesh_shift_y_um"] > 0.0
    # And the tangential one against the sense in which it turns there.
    assert case["mesh_shift_z_um"] < 0.0
    whole = math.hypot(case["mesh_shift_y_um"], case["mesh_shift_z_um"])
    assert whole == pytest.approx(case["deflection_with_shear_um"], rel=1e-12)
