"""Materials, lubricants and bearings by name, with their sources, and files of one's own."""

import os

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import library
from asperity.gearset.bearings import Bearings
from asperity.gearset.library import VARIABLE, find, resolve
from asperity.gearset.lubricants import BaseOil, Lubricant
from asperity.gearset.materials import Steel, WheelMaterial, WormMaterial, worm_material
from asperity.rating import rate_command
from asperity.runs import Run

OWN = """
[source.maker]
name = "data sheet"
confidence = "one source"

[wheel."our bronze"]
family = "tin bronze"
youngs_modulus = "95 GPa"
poisson_ratio = 0.35
material_factor = 1.0
pitting_strength = "450 MPa"
shear_strength = "95 MPa"
from = { shear_strength = "maker" }

[bearings.fixed-floating]
loss_coefficient = 0.02
"""


@pytest.fixture
def own_file(tmp_path, monkeypatch):
    path = tmp_path / "own.toml"
    path.write_text(OWN)
    monkeypatch.setenv(VARIABLE, str(path))
    return path


def names(model):
    return [
        name for section, name in library._library(library._stamps()) if section == model.section
    ]


def test_every_value_that_ships_has_a_source():
    for model in (WheelMaterial, WormMaterial, Steel, Lubricant, BaseOil, Bearings):
        assert names(model)
        for name in names(model):
            thing = find(model, name)
            keys = thing.model_fields_set - {"name", "sources", "assumption"}
            assert keys <= set(thing.sources), name
            assert all(thing.source(key).note != "given by the user" for key in keys), name


def test_aluminium_bronze_counts_as_centrifugal_phosphor_bronze_and_says_so():
    material = find(WheelMaterial, "CuAl10Fe5Ni5-C-GZ")
    assert material.bs721 == "phosphor bronze centrifugal"
    assert material.agma6034 == "centrifugal"
    assert "no row for aluminium bronze" in material.source("bs721").note
    assert material.source("bs721").confidence == "from memory"


def test_iron_is_not_in_the_tables_of_agma():
    for name in ("EN-GJS-400-15", "EN-GJL-250"):
        assert find(WheelMaterial, name).agma6034 is None
    assert find(WheelMaterial, "EN-GJS-400-15").bs721 is None
    assert "no row" in find(WheelMaterial, "EN-GJS-400-15").source("bs721").note


def test_a_file_of_your_own_adds_names_and_replaces_them(own_file, monkeypatch):
    material = find(WheelMaterial, "our bronze")
    assert material.youngs_modulus == 95e9
    assert material.source("shear_strength").name == "data sheet"
    assert material.source("youngs_modulus").note == "given by the user"
    assert find(Bearings, "fixed-floating").loss_coefficient == 0.02
    monkeypatch.delenv(VARIABLE)
    assert find(Bearings, "fixed-floating").loss_coefficient == 0.013


def test_the_environment_names_files_of_your_own(own_file, monkeypatch):
    assert "our bronze" in names(WheelMaterial)
    assert find(WheelMaterial, "our bronze").name == "our bronze"
    monkeypatch.delenv(VARIABLE)
    assert "our bronze" not in names(WheelMaterial)


def test_a_changed_file_is_read_again(own_file):
    assert find(Bearings, "fixed-floating").loss_coefficient == 0.02
    stamp = own_file.stat().st_mtime_ns + 10**9
    own_file.write_text(OWN.replace("0.02", "0.025"))
    os.utime(own_file, ns=(stamp, stamp))
    assert find(Bearings, "fixed-floating").loss_coefficient == 0.025


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[wheel", "own.toml: not valid TOML"),
        ("[wheels.x]", r"own.toml: \[wheels\] is not a table .*did you mean 'wheel'"),
        ("wheel = 3", r"\[wheel\] must hold tables with names"),
        ("[wheel]\nyoungs_modulus = 3", r"\[wheel\] must hold tables with names"),
        ('[wheel.x]\nfrom = "maker"', r'\[wheel."x"\]: from is \'maker\'; it must be a table'),
        ('[wheel.x]\nfrom = { "*" = "maker" }', r"from.\* is 'maker'"),
        ('[wheel.x]\nfrom = { "*" = ["maker"] }', r"from.\* is \['maker'\]"),
        ('[source.x]\nname = "a\\u001b"\nconfidence = "verified"', "must be one line of text"),
        ("[source.x]\nname = 5\nconfidence = 'verified'", "must be one line of text"),
        ("[source.x]\nnam = 'a'", r"\[source.x\] must have name, confidence"),
        ("[source.x]\nname = 'a'\nconfidence = 'sure'", r"\[source.x\]: confidence is 'sure'"),
        ("[wheel.x]\nfamily = 'tin bronze'", r'own.toml: \[wheel."x"\]: .*youngs_modulus is miss'),
    ],
)
def test_a_bad_file_of_your_own_is_named_in_one_line(text, message, tmp_path, monkeypatch):
    path = tmp_path / "own.toml"
    path.write_text(text)
    monkeypatch.setenv(VARIABLE, str(path))
    with pytest.raises(InputError, match=message) as refused:
        find(WheelMaterial, "x")
    assert "\n" not in str(refused.value)


def test_a_missing_file_of_your_own_is_named(tmp_path, monkeypatch):
    monkeypatch.setenv(VARIABLE, str(tmp_path / "gone.toml"))
    with pytest.raises(InputError, match=r"gone\.toml cannot be read"):
        find(WheelMaterial, "CuSn12-C-GZ")


@pytest.mark.parametrize(
    ("files", "said"),
    [
        ([], "where a data file of your own has it, name that as asperity --materials FILE"),
        (["[motor.x]\npower = '1 kW'\n"], "none of the data files that are named has one"),
    ],
)
def test_a_name_of_a_thing_that_never_ships_says_where_it_may_come_from(
    monkeypatch, tmp_path, files, said
):
    from asperity.shafts.bearing import RollingBearing

    for text in files:
        (tmp_path / "own.toml").write_text(text, "utf-8")
        monkeypatch.setenv(library.VARIABLE, str(tmp_path / "own.toml"))
    with pytest.raises(InputError, match=f"no rolling bearing of that name is known; {said}$"):
        find(RollingBearing, "6205")


def test_a_name_that_is_not_known_brings_the_near_one_or_all():
    with pytest.raises(InputError, match="did you mean 'preloaded'"):
        find(Bearings, "preload")
    with pytest.raises(InputError, match=r"allowed: 'fixed-floating', 'preloaded'"):
        find(Bearings, "x")
    with pytest.raises(InputError, match=r"operation\.lubricant is .*did you mean 'ISO VG 220 min"):
        resolve(Lubricant, "ISO VG 220 mineal")


def test_bearings_of_your_own_are_a_class():
    assert Bearings(loss_coefficient=0.02).source("loss_coefficient").note == "given by the user"


def test_the_oil_of_the_thesis_is_a_stand_in_and_says_so():
    oil = resolve(Lubricant, "Fuchs Titan Gear MP SAE 80")
    assert "stands in" in oil.assumed["lubricant"]
    assert oil.source("viscosity_40").confidence == "from memory"
    assert resolve(Lubricant, "ISO VG 220 mineral").assumed == {}


def test_a_lubricant_of_your_own_takes_its_density_from_the_base_oil():
    oil = resolve(
        Lubricant,
        {"base_oil": "polyglycol", "viscosity_40": "460 cSt", "viscosity_100": "77 mm^2/s"},
        {"text_only": True},
    )
    assert oil.viscosity_40 == 460e-6
    assert oil.density(288.15) == pytest.approx(1050.0, rel=1e-12)
    assert oil.assumed == {"lubricant.density_15": "1050 kg/m^3, typical of polyglycol oil"}
    assert oil.source("density_15").name == "MITCalc 1.74"


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"base_oil": "minerals"}, "base_oil is 'minerals'; .*did you mean 'mineral'"),
        ({"viscosity_40": 68}, "viscosity_40 is 68; it must be a kinematic viscosity such as"),
        ({"viscosity_100": "70 mm^2/s"}, "viscosity_100 is 70 mm.2/s; it must be below visc.* 68"),
        ({"viscosity_100": "0.1 mm^2/s"}, "viscosity_100 is '0.1 mm.2/s'; it must be at least"),
        ({"density": "890 kg/m^3"}, "density is not a key .*did you mean 'density_15'"),
    ],
)
def test_a_lubricant_that_is_none_is_refused(changes, message):
    given = {"base_oil": "mineral", "viscosity_40": "68 mm^2/s", "viscosity_100": "8.7 mm^2/s"}
    with pytest.raises(InputError, match=rf"^operation\.lubricant\.{message}"):
        resolve(Lubricant, {**given, **changes}, {"text_only": True})


def test_every_steel_stands_by_name_and_number_for_a_class_and_says_so():
    numbers = {}
    for name in names(Steel):
        steel = find(Steel, name)
        worm, of_class = worm_material(name), find(WormMaterial, steel.worm)
        assert (worm.name, worm.bs721, worm.hardened) == (name, of_class.bs721, of_class.hardened)
        assert worm.youngs_modulus == of_class.youngs_modulus
        assert f"{name} ({steel.number}) is taken for {steel.worm}" in worm.taken_for.note
        assert worm.source("bs721").confidence == "from memory"
        numbers.setdefault(steel.number, steel)
    for number, steel in numbers.items():
        assert worm_material(number).name == steel.name
    assert find(WormMaterial, "0.4C steel").taken_for is None


@pytest.mark.parametrize(
    ("name", "taken"),
    [("1.7131", "case-hardened steel"), ("20MnCr5", "case-hardened steel"),
     ("18CrNiMo7-6", "case-hardened steel"), ("17CrNiMo6", "case-hardened steel"),
     ("42CrMo4", "0.4C steel"), ("34CrNiMo6", "0.4C steel"), ("C45", "0.4C steel"),
     ("C60", "0.55C steel")],
)  # fmt: skip
def test_a_steel_is_taken_for_the_class_of_its_treatment_and_carbon(name, taken):
    assert worm_material(name).bs721 == find(WormMaterial, taken).bs721


@pytest.mark.parametrize(
    ("given", "said"),
    [("16MnCr6", "did you mean '16MnCr5'"), ("17131", "did you mean '1.7131'"),
     ("granite", "allowed: 'case-hardened steel', '0.55C"), (1.581, "in quotes as '1.7131'")],
)  # fmt: skip
def test_a_steel_that_is_not_known_is_told_the_nearest(given, said):
    with pytest.raises(InputError, match=said):
        worm_material(given)


def test_a_steel_of_ones_own_stands_for_its_class(tmp_path, monkeypatch):
    own = tmp_path / "own.toml"
    own.write_text(
        '[steel.ours]\nnumber = "9"\nworm = "0.55C steel"\ntreatment = "tempered"\n'
        '[steel.wrong]\nnumber = "8"\nworm = "0.5C steel"\ntreatment = "tempered"\n'
    )
    monkeypatch.setenv(VARIABLE, str(own))
    assert worm_material("ours").bs721 == "0.55C steel"
    with pytest.raises(InputError, match=r"steel.wrong.worm is '0.5C steel'.*'0.55C steel'"):
        worm_material("wrong")


ADI = """
[wheel."our ADI"]
family = "nodular iron"
youngs_modulus = "165 GPa"
poisson_ratio = 0.27
material_factor = 1.0
pitting_strength = "700 MPa"
shear_strength = "220 MPa"

[worm."ADI, ground"]
youngs_modulus = "165 GPa"
poisson_ratio = 0.27
"""


@pytest.mark.slow
def test_austempered_iron_is_rated_by_its_owner_s_strengths_where_the_standards_have_none(
    tmp_path, monkeypatch
):
    path = tmp_path / "adi.toml"
    path.write_text(ADI)
    monkeypatch.setenv(VARIABLE, str(path))
    told = {}
    for wheel in ("our ADI", "EN-GJS-400-15"):
        case = read_case("gearset-3", case_tables(), [f"gearset.wheel_material={wheel}"])
        verdict = rate_command.answer(rate_command.prepare(case), Run()).to_json()["verdict"]
        told[wheel] = verdict
    root = {
        wheel: next(one["value"] for one in verdict["safeties"] if one["symbol"] == "S_F")
        for wheel, verdict in told.items()
    }
    # Of iron alike in all but its strength and, by the mesh, its modulus: as the strengths.
    assert root["our ADI"] / root["EN-GJS-400-15"] == pytest.approx(220.0 / 115.0, rel=0.02)
    standing = told["our ADI"]["standing"]
    assert "no stress factors" in standing["bs721"]["reasons"][0]
    assert "no bronze that AGMA 6034 covers" in standing["agma6034"]["reasons"][0]
    worm = read_case("gearset-3", case_tables(), ["gearset.worm_material=ADI, ground"])
    assert rate_command.answer(rate_command.prepare(worm), Run()).to_json()["verdict"]["safeties"]
