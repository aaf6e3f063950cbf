"""Ways to less friction compared: what is reported, and vibration by the sliding body."""

import json
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.files.store import read_dataset, write_dataset
from asperity.friction.parameters import Friction
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions, rate
from asperity.rating.tables import TABLES as RATING
from asperity.slider.closed_forms import directed_ratio, vibration_power
from asperity.slider.tables import TABLES as SLIDER
from asperity.studies.methods import compare, compare_case
from asperity.studies.plots import plot_comparison
from asperity.studies.reported import more_methods, reported_methods
from asperity.studies.vibrated_friction import shake
from asperity.vibration import Vibration

OWN = """
[source.us]
name = "our own tests"
confidence = "one source"

[method.wax]
name = "wax"
kind = "coating"
reduction = 0.2
from = "us"
"""


def case(name="gearset-2", *settings):
    return read_case(name, {**RATING, **SLIDER}, settings)


def gearset(name="gearset-2", *settings):
    read = case(name, *settings)
    return read.require(Gearset), read.require(Operation), read.require(RatingOptions)


@pytest.fixture(scope="module")
def comparison():
    return compare(*gearset())


@pytest.fixture
def file(tmp_path):
    def write(text):
        path = tmp_path / "methods.toml"
        path.write_text(text)
        return path

    return write


def test_every_way_gives_the_efficiency_of_the_gearset_with_its_base_friction(comparison):
    for row in comparison.rows:
        options = RatingOptions(base_friction=row.base_friction)
        rated = rate(*gearset()[:2], options, ("iso14521",)).iso14521
        for key, value in (
            ("eta_z1_2", row.efficiency),
            ("eta_ges", row.total_efficiency),
            ("mu_zm", row.friction),
        ):
            assert value == pytest.approx(rated[key], rel=1e-12)


def test_a_reduction_acts_as_a_factor_on_the_friction_would(comparison):
    row = comparison["mos2_ti"]
    rated = rate(*gearset()[:2], RatingOptions(friction_factor=0.58), ("iso14521",)).iso14521
    assert row.efficiency == pytest.approx(rated["eta_z1_2"], rel=1e-12)


def test_every_way_names_who_reports_it(comparison):
    for row in comparison.rows:
        assert row.source.name
        assert row.source.confidence in ("verified", "one source")


def test_the_oil_of_the_case_is_not_compared_with_itself():
    keys = {row.key for row in compare(*gearset()).rows}
    assert {"polyalphaolefin_iso", "polyglycol_iso"} <= keys
    assert "mineral" not in keys
    oil = '{ base_oil = "polyglycol", viscosity_40 = "220 mm^2/s", viscosity_100 = "40 mm^2/s" }'
    other = compare(*gearset("gearset-2", f"operation.lubricant={oil}"))
    assert other["mineral"].gain < 0.0
    assert any("reported in mineral oil" in note for note in other.notes)


def test_a_base_friction_of_the_case_is_what_reductions_act_on():
    found = compare(*gearset("gearset-2", "rating.base_friction=0.06"))
    assert found["as_is"].base_friction == 0.06
    assert found["diamond"].base_friction == pytest.approx(0.03)
    assert found["mineral"].base_friction == pytest.approx(0.0715, abs=5e-5)


def test_a_given_mean_friction_leaves_nothing_to_compare():
    with pytest.raises(InputError, match=r"^rating\.friction is 0\.1, which leaves nothing"):
        compare(*gearset("gearset-2", "rating.friction=0.1"))


def test_without_friction_nothing_is_lost_and_nothing_to_gain():
    for row in compare(*gearset("gearset-2", "rating.friction_factor=0")).rows:
        assert (row.efficiency, row.gain, row.vibration_power) == (1.0, 0.0, 0.0)


def test_vibration_acts_as_rigid_friction_does_at_the_ratio_of_the_velocities(comparison):
    for key, direction in (("longitudinal", 0.0), ("transverse", math.pi / 2)):
        row = comparison[key]
        k = 2 * math.pi * 20e3 * 20e-6 / comparison.sliding_velocity
        assert row.vibration.velocity_ratio == pytest.approx(k)
        assert row.friction / comparison["as_is"].friction == pytest.approx(
            directed_ratio(k, direction)
        )


def test_the_power_of_friction_is_the_loss_between_the_teeth_plus_the_vibration(comparison):
    before = comparison["as_is"]
    for key in ("longitudinal", "transverse"):
        row = comparison[key]
        lost = comparison.output_power * (1.0 / row.efficiency - 1.0)
        k, direction = row.vibration.velocity_ratio, row.vibration.direction
        share = vibration_power(k, direction) / directed_ratio(k, direction)
        assert row.vibration_power == pytest.approx(share * lost)
        assert row.efficiency_with_vibration == pytest.approx(
            comparison.output_power / (comparison.output_power + lost + row.vibration_power)
        )
        assert row.efficiency_with_vibration < before.efficiency < row.efficiency


def test_longitudinal_vibration_slower_than_the_sliding_does_nothing():
    slow = Vibration(frequency=20e3, velocity_ratio=0.9, units="SI")
    found = compare(*gearset(), vibration=slow)
    assert found["longitudinal"].gain == pytest.approx(0.0, abs=1e-12)
    assert found["longitudinal"].vibration_power == 0.0
    assert found["transverse"].gain > 0.01
    assert any("too slow" in note for note in found.notes)


def test_a_direction_of_its_own_is_compared_too():
    turned = Vibration(frequency=20e3, velocity_ratio=3.0, direction=math.radians(30), units="SI")
    row = compare(*gearset(), vibration=turned)["given"]
    assert row.name == "vibration at 30 deg, k = 3"
    assert row.vibration.share == pytest.approx(directed_ratio(3.0, math.radians(30)))


@pytest.mark.parametrize("direction", [0.0, 1.0, math.pi / 2])
@pytest.mark.parametrize("k", [0.5, 3.0, 20.0])
def test_the_sliding_body_agrees_with_the_closed_forms_where_both_answer(k, direction):
    wave = Vibration(frequency=20e3, velocity_ratio=k, units="SI")
    solved = shake(wave, direction, 1.39, friction=Friction(model="coulomb", mu=0.1))
    closed = shake(wave, direction, 1.39)
    assert solved.share == pytest.approx(closed.share, abs=2e-3)
    assert solved.power == pytest.approx(closed.power, rel=5e-3, abs=2e-3)


def test_elastic_asperities_far_below_the_amplitude_are_as_good_as_rigid():
    wave = Vibration(frequency=20e3, displacement_amplitude=20e-6, units="SI")
    stiff = shake(wave, 0.0, 1.39, friction=Friction(mu=0.1, max_deflection=70e-9, units="SI"))
    soft = shake(wave, 0.0, 1.39, friction=Friction(mu=0.1, max_deflection=3e-6, units="SI"))
    rigid = shake(wave, 0.0, 1.39)
    assert stiff.share == pytest.approx(rigid.share, abs=1e-3)
    assert soft.share > rigid.share + 0.02


def test_a_tangential_stiffness_is_taken_with_the_normal_force():
    wave = Vibration(frequency=20e3, displacement_amplitude=20e-6, units="SI")
    law = Friction(mu=0.15, tangential_stiffness=80e6, units="SI")
    same = Friction(mu=0.15, max_deflection=0.15 * 1000.0 / 80e6, units="SI")
    by_force = shake(wave, 0.0, 1.39, friction=law, normal_force=1000.0)
    assert by_force.share == pytest.approx(shake(wave, 0.0, 1.39, friction=same).share)


def test_a_triangle_along_the_sliding_leaves_no_friction_and_no_loss():
    wave = Vibration(waveform="triangle", frequency=20e3, velocity_ratio=3.0, units="SI")
    found = compare(*gearset(), vibration=wave)["longitudinal"]
    assert found.vibration.share == pytest.approx(0.0, abs=2e-3)
    assert found.efficiency == pytest.approx(1.0, abs=5e-3)


def test_a_wave_that_drives_the_contact_on_is_refused(tmp_path):
    time = np.linspace(0.0, 1e-3, 41)
    # A sawtooth: slowly ahead with the sliding, quickly back.
    shape = np.where(time < 0.9e-3, time / 0.9e-3, (1e-3 - time) / 0.1e-3)
    rows = "\n".join(f"{t:.9g},{1e-3 * u:.9g}" for t, u in zip(time, shape, strict=True))
    (tmp_path / "saw.csv").write_text(rows)
    wave = Vibration(waveform="sampled", samples="saw.csv", velocity_amplitude=200.0, units="SI")
    with pytest.raises(InputError, match="drives the contact forward"):
        shake(wave, 0.0, 1.39, folder=tmp_path)


def test_the_tables_of_a_case_describe_the_vibration():
    settings = (
        "vibration.frequency=30 kHz",
        "vibration.displacement_amplitude=10 um",
        "friction.mu=0.1",
        "friction.tangential_stiffness=80 MN/m",
        "slider.drive_velocity=1 m/s",
        "slider.normal_force=2 kN",
    )
    found = compare_case(case("gearset-2", *settings))
    wave = Vibration(frequency=30e3, displacement_amplitude=10e-6, units="SI")
    law = Friction(mu=0.1, tangential_stiffness=80e6, units="SI")
    velocity = found.sliding_velocity
    expected = shake(wave, 0.0, velocity, friction=law, normal_force=2000.0)
    assert found["longitudinal"].vibration == expected
    assert found.assumed == {}


def test_what_is_assumed_of_the_vibration_is_said(comparison):
    assert comparison.assumed.keys() == {"vibration", "friction"}
    assert "20 kHz, 20 um" in comparison.assumed["vibration"]


def test_less_friction_may_end_self_locking_and_the_notes_say_so(comparison):
    assert comparison["as_is"].locks
    assert not comparison["polyglycol"].locks
    assert any("no longer does" in note for note in comparison.notes)
    for row in comparison.rows:
        assert row.locks == (math.tan(gearset()[0].geometry.lead_angle) <= row.friction)


def test_methods_of_a_file_of_ones_own_are_compared(file):
    methods = reported_methods(file(OWN))
    found = compare(*gearset(), methods=methods)
    assert [row.key for row in found.rows] == ["as_is", "wax", "transverse", "longitudinal"]
    assert found["wax"].friction == pytest.approx(0.8 * found["as_is"].friction)
    assert found["wax"].source.name == "our own tests"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("reduction = 0.2", "", r"\[method\.wax\]: method\.base_oil is missing; give one of"),
        ("reduction = 0.2", "reduction = 1.2", r"method\.reduction is 1\.2"),
        ("reduction", "reductoin", r"method\.reductoin is not a key .*did you mean 'reduction'"),
        ('"us"', '"them"', r"from is 'them'; it must be 'us'"),
        ('"one source"', '"sure"', r"\[source\.us\]: confidence is 'sure'"),
        ("[method.wax]", "[method.wax", r"methods\.toml: not valid TOML"),
        ("[method.wax]", "[methods.wax]", r"\[methods\] is not a table .*did you mean 'method'"),
        ("[method.wax]", "[method]", r"\[method\] must hold tables with names"),
        ("[source.us]", "source = 3\n[method.us]", r"\[source\] must hold tables with names"),
    ],
)
def test_a_wrong_file_of_methods_is_refused_with_its_place(file, old, new, message):
    with pytest.raises(InputError, match=message):
        reported_methods(file(OWN.replace(old, new)))


def test_a_file_that_is_not_there_is_refused():
    with pytest.raises(InputError, match=r"nowhere\.toml"):
        reported_methods("nowhere.toml")


def test_json_names_units_and_leaves_out_what_does_not_vibrate(comparison):
    answer = json.loads(json.dumps(comparison.to_json(), allow_nan=False))
    rows = {row["key"]: row for row in answer["methods"]}
    assert rows["dlc"]["vibration"] is None
    quoted = rows["longitudinal_quoted"]["vibration"]
    assert quoted["computed"] is False
    assert quoted["velocity_amplitude_m_s"] == pytest.approx(27.8, abs=0.05)
    assert rows["transverse"]["vibration"]["computed"] is True


def test_the_dataset_survives_its_file(comparison, tmp_path):
    dataset = read_dataset(write_dataset(comparison.to_dataset(), tmp_path / "methods.nc"))
    assert float(dataset["eta_z1_2"].sel(way="polyglycol")) == comparison["polyglycol"].efficiency
    assert np.isnan(dataset["velocity_ratio"].sel(way="dlc"))


def test_the_picture_has_a_bar_for_every_way(comparison):
    (axes,) = comparison.plot().axes
    assert len(axes.patches) == len(comparison.rows)


def test_an_unknown_way_names_the_nearest(comparison):
    with pytest.raises(InputError, match="did you mean 'diamond'"):
        comparison["diamonds"]


def test_more_ways_stand_beside_those_that_ship_and_the_last_of_a_key_wins(file):
    shipped = [method.key for method in reported_methods()]
    more = more_methods(["literature", file(OWN + OWN.replace("wax", "fe3o4").split("\n\n")[1])])
    keys = [method.key for method in more]
    assert keys[: len(shipped)] == shipped
    assert {"ester", "wcc", "wax"} <= set(keys)
    assert next(method for method in more if method.key == "fe3o4").reduction == 0.2
    found = compare(*gearset(), methods=more)
    assert found["ester"].base_friction == pytest.approx(0.8 * found["as_is"].base_friction)


@pytest.mark.slow
def test_numbers_of_the_picture_stay_within_it_and_no_line_goes_through_them():
    figure = plot_comparison(compare_case(case("gearset-2")).to_dataset())
    figure.draw_without_rendering()
    (axes,) = figure.axes
    numbers = [text for text in axes.texts if text.get_text()]
    assert len(numbers) == len(axes.patches)
    frame = axes.get_window_extent()
    for text in numbers:
        shown = text.get_window_extent()
        assert frame.x0 < shown.x0
        assert shown.x1 < frame.x1
    (line,) = [line for line in axes.lines if line.get_linestyle() == "--"]
    assert all(text.get_bbox_patch() is not None and text.zorder > line.zorder for text in numbers)
