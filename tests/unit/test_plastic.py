"""A wheel of plastic is judged by its owner's table: interpolation, Archard's law, refusals."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import library
from asperity.gearset.plastics import Plastic
from asperity.rating import own_table, rate_case
from asperity.rating.standards import STANDARDS
from asperity.results.language import catalogue_of, spoken
from asperity.start.data_file import DATA_FILES

TABLE = {
    "name": "ours", "youngs_modulus": "2.6 GPa", "poisson_ratio": 0.4, "friction": 0.1,
    "temperatures": ["20 degC", "80 degC"], "cycles": [1e4, 1e6],
    "root": [["40 MPa", "20 MPa"], ["20 MPa", "10 MPa"]],
}  # fmt: skip
RUN = [
    "operation.output_torque=10 N m", "operation.through_travel_torque=10 N m",
    "operation.oil_temperature=60 degC", "operation.application_factor=1",
]  # fmt: skip


@pytest.fixture
def ours(tmp_path, monkeypatch):
    path = tmp_path / "ours.toml"
    path.write_text(DATA_FILES["plastic"].text("plastic"), "utf-8")
    monkeypatch.setenv(library.VARIABLE, str(path))
    return path


def case(*settings, name="gearset-3"):
    return read_case(name, case_tables(), ["gearset.wheel_material=my POM", *RUN, *settings])


def test_the_table_is_read_between_its_values():
    plastic = Plastic.model_validate(TABLE)
    assert plastic.bears("root", 20.0, 1e4) == pytest.approx(40e6)
    assert plastic.bears("root", 80.0, 1e6) == pytest.approx(10e6)
    assert plastic.bears("root", 50.0, 1e4) == pytest.approx(30e6)
    # Halved over two decades: at one decade by the root of a half.
    assert plastic.bears("root", 20.0, 1e5) == pytest.approx(40e6 * math.sqrt(0.5))
    # No more is known of fewer cycles.
    assert plastic.bears("root", 20.0, 10.0) == pytest.approx(40e6)
    assert plastic.bears("flank", 20.0, 1e5) is None


@pytest.mark.parametrize(
    ("celsius", "cycles", "said"),
    [(81.0, 1e4, "from 20 to 80 degC"), (19.0, 1e4, "from 20"), (50.0, 2e6, "ends at 1e.06")],
)
def test_it_is_not_read_beyond(celsius, cycles, said):
    with pytest.raises(InputError, match=said):
        Plastic.model_validate(TABLE).bears("root", celsius, cycles)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"root": [["40 MPa", "20 MPa"]]}, "it must have 2, one for each of temperatures"),
        ({"root": [["40 MPa"], ["20 MPa"]]}, "2 values each"),
        ({"cycles": [1e6, 1e4]}, "cycles must be rising"),
        ({"temperatures": []}, "temperatures must be rising"),
        ({"root": None}, "says nothing of strength"),
        ({"wear_depth": "0.3 mm"}, "belong together"),
        ({"friction": 0.0}, "friction"),
    ],
)
def test_a_bad_table_is_refused(change, said):
    with pytest.raises(InputError, match=said):
        Plastic.model_validate(TABLE | change)


def test_no_standard_covers_it_and_its_own_table_judges(ours):
    rated = rate_case(case())
    assert not rated.found
    assert set(rated.unanswered) == set(STANDARDS)
    for said in rated.unanswered.values():
        assert "a plastic, which" in said
    assert [row.name for row in rated.rows] == ["wheel root", "wheel flank", "wheel wear"]
    assert {row.standard for row in rated.rows} == {"own table"}
    screen = rated.brief()
    assert "holds by own table" in screen
    assert "does not lock itself" not in screen
    assert "no standard covers a wheel of plastic" in screen
    assert "own table wheel root" in rated.to_html()
    # All that is told in full has it as well.
    (beside,) = [t for t in rated.tables() if "besides the standards" in heads(t)]
    assert [row[0] for row in beside.rows] == [f"own table {row.name}" for row in rated.rows]
    assert [float(row[1]) for row in beside.rows] == pytest.approx(
        [row.value for row in rated.rows], rel=1e-4
    )
    assert not [t for t in rate_case(bronze()).tables() if "besides the standards" in heads(t)]


def bronze():
    return read_case("gearset-3", case_tables())


def heads(table):
    return [column.heading for column in table.columns]


def test_it_is_told_in_german_too(ours):
    german = catalogue_of("de")
    german.missing.clear()
    with spoken(german):
        rated = rate_case(case())
        assert "hält nach eigener Tabelle" in rated.brief()
        assert "nach eigener Tabelle, " in rated.brief()
        steel = "gearset.worm_material=16MnCr5"
        assert "taken for" not in rate_case(case(steel)).brief()
        rated.to_html()
    assert german.missing <= {"gearset 3"}


def test_what_does_not_count_is_said_and_no_table_is_empty(ours):
    steps = "spectrum.step=[{duration='5 h',output_torque='10 N m'}]"
    left_out = ("operation.wheel_revolutions", "operation.through_travel_torque")
    bare = case().replace_values(dict.fromkeys(left_out))
    duty = bare.replace([steps, "spectrum.duty=S3 25 %", "housing.area=1 m**2"])
    told = [note for note in rate_case(duty).notes if "does not count" in note]
    assert [note.split(" does")[0] for note in told] == ["S3 25 %", "[housing]"]
    rated = rate_case(bare.replace([steps]))
    assert not [note for note in rated.notes if "does not count" in note]
    assert all(table.rows or not table.columns for table in rated.tables())
    german = catalogue_of("de")
    with spoken(german):
        german.missing.clear()
        rate_case(duty).to_html()
    assert german.missing <= {"gearset 3"}


def test_stresses_are_those_that_the_standard_has_for_the_same_geometry(ours):
    # Of bronze with the moduli of the plastic; its wear leaves the root as it was.
    rated = rate_case(case())
    found = own_table.judged(rated.rating_inputs, own_table.plastic_of(rated.rating_inputs))
    bronze = rate_case(
        case(
            "gearset.wheel_material={family='tin bronze', youngs_modulus='2.6 GPa', "
            "poisson_ratio=0.4, material_factor=1, pitting_strength='300 MPa', "
            "shear_strength='90 MPa'}", "operation.wheel_revolutions=1",
        ), ("iso14521",),
    ).iso14521  # fmt: skip
    assert found.flank == pytest.approx(bronze["sigma_Hm_MPa"], rel=1e-12)
    assert found.root == pytest.approx(bronze["tau_F_MPa"], rel=1e-4)
    assert rated.rows[0].value == pytest.approx(
        1e-6
        * own_table.plastic_of(rated.rating_inputs).bears("root", 60.0, found.cycles)
        / found.root
    )


def test_what_is_worn_off_is_archards_volume(ours):
    rated = rate_case(case())
    given, plastic = rated.rating_inputs, own_table.plastic_of(rated.rating_inputs)
    found = own_table.judged(given, plastic)
    # The wheel's turns times the way of a turn of it, by the worm's sliding at its mean diameter.
    turns = found.cycles
    way = turns * given.gear_ratio * math.pi * given.worm_pitch_diameter
    way /= 1e3 * math.cos(given.lead_angle)
    force = own_table.normal_force(given, 10.0, plastic.friction)
    volume = 1e9 * plastic.wear_coefficient * force * way
    assert found.worn * own_table.flank_area(given) == pytest.approx(volume, rel=1e-9)


def test_the_force_across_the_flanks_gives_torque_and_efficiency(ours):
    given = rate_case(case()).rating_inputs
    mu, gamma, alpha = 0.1, given.lead_angle, given.pressure_angle
    force = own_table.normal_force(given, 10.0, mu)
    round_wheel = force * (math.cos(alpha) * math.cos(gamma) - mu * math.sin(gamma))
    assert round_wheel * given.wheel_mean_diameter / 2e3 == pytest.approx(10.0)


def test_wear_adds_up_over_loads_and_the_rated_torque_is_for_all_cycles(ours):
    first, second = (f"{{duration='5 h', output_torque='{torque} N m'}}" for torque in (10, 5))
    both, one, half = (
        own_table.judged(*_of(f"operation.duty_cycle=[{parts}]"))
        for parts in (f"{first}, {second}", first, second)
    )
    assert both.worn == pytest.approx(one.worn + half.worn)
    assert both.cycles == pytest.approx(one.cycles + half.cycles)
    assert both.root == one.root == half.root
    # Above every part the rated torque is what root and flank are judged by; wear is the parts'.
    more = own_table.judged(
        *_of("operation.output_torque=40 N m", f"operation.duty_cycle=[{first}, {second}]")
    )
    assert more.root == pytest.approx(4.0 * both.root)
    assert more.flank == pytest.approx(2.0 * both.flank)
    assert (more.worn, more.cycles) == (both.worn, both.cycles)


def _of(*settings):
    given = rate_case(case("operation.wheel_revolutions=", *settings)).rating_inputs
    return given, own_table.plastic_of(given)


def test_without_the_temperature_of_its_teeth_it_is_refused(ours):
    missing = read_case("gearset-3", case_tables(), ["gearset.wheel_material=my POM", *RUN[:2]])
    with pytest.raises(InputError, match=r"operation\.oil_temperature is missing"):
        rate_case(missing)


def test_one_standard_alone_refuses_it(ours):
    with pytest.raises(InputError, match="which BS 721 does not cover"):
        rate_case(case(), ("bs721",))


def test_a_family_of_plastic_is_not_given_by_hand():
    with pytest.raises(InputError, match="asperity new plastic begins one"):
        case(
            "gearset.wheel_material={family='plastic', youngs_modulus='2.6 GPa', "
            "poisson_ratio=0.4, material_factor=1, pitting_strength='300 MPa', "
            "shear_strength='90 MPa', own={root=3}}"
        )
