"""What the first screen says of loads, oil, life and starting, and of what others add to it."""

import dataclasses
import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
from asperity.rating.verdict_rows import Row
from asperity.start.compare import compare


def actuator(*settings):
    return rate_case(read_case("actuator-duty", case_tables(), settings))


def power_section(found):
    return next(section for section in found.sections() if section.title == "Power")


def test_the_screen_of_an_actuator_tells_its_loads_oil_life_and_start():
    found = actuator()
    text = found.brief()
    assert found.heading() == "actuator: 3 loads in 5000 h, S3 15 % of 10 min"
    for said in (
        "of all wear by ISO/TR 14521: 150 N m 42 %, 60 N m 36 %, 250 N m 23 %",
        "life 141,743 h of 5,000 asked until S_W is 1.1 (155,917 h until 1): wear by\n",
        "this at 250 N m, 1400 rpm; over the duty 55.6 %, mean loss 205.8 W, 1029 kWh",
        "AGMA 6034 has no load spectra: the load nearest to its limit, times a service",
        "oil 32 degC by heat balance, 63 by ISO's formula (S1); idling 139 W by formula",
        "starts at 33 % of the teeth, motor 16.6 N m (friction at rest of AGMA 6034)",
    ):
        assert said in text
    assert max(map(len, text.splitlines())) <= 79


def test_the_parts_of_a_duty_in_which_the_load_drives_are_marked():
    found = rate_case(read_case("gearset-3", case_tables(), ["operation.duty_cycle=1 h, 60 N m"]))
    (plain,) = (table for table in found.tables() if "Duty" in table.title)
    assert not plain.remarks
    duty = "operation.duty_cycle=1 h, 60 N m; 1 h, 60 N m, load drives"
    found = rate_case(read_case("gearset-3", case_tables(), [duty]))
    (table,) = (table for table in found.tables() if "Duty" in table.title)
    assert [row[0] for row in table.rows] == ["part 1", "part 2 *"]
    assert "the load drives the worm" in table.remarks[0]
    assert [part.get("load_drives") for part in found.to_json()["duty_cycle"]] == [None, True]


POWERS = "loss_total_W", "input_power_W"
BACK = "1 h, 300 N m, load drives; 9 h, 150 N m, 700 rpm, load drives"


def test_where_the_load_drives_in_all_parts_the_efficiency_is_that_of_the_load():
    duty = "operation.duty_cycle=" + BACK
    found = rate_case(
        read_case("gearset-3", case_tables(), [duty, "operation.output_torque=300 N m"])
    )
    iso, text = found.iso14521, found.brief()
    assert f"efficiency {100 * iso['eta_ges2_1']:.1f} % of the gearbox" in text
    assert f"{100 * iso['eta_z2_1']:.1f} % of the teeth (the load driving" in text
    # By its definition: what leaves at the worm over what comes in at the wheel.
    lost = iso["loss_total_W"] - iso["loss_meshing_W"] + iso["loss_meshing_back_W"]
    assert iso["eta_ges2_1"] == pytest.approx(1.0 - lost / iso["output_power_W"], rel=1e-12)
    assert f"losses {lost:.4g} W of {iso['output_power_W']:.4g} W: teeth " in text
    assert found.of_power[0] in [str(line) for line in found.sections()[0].texts]
    assert "In this duty the load does" in power_section(found).texts[0]
    assert not power_section(rate_case(read_case("gearset-3", case_tables()))).texts


def test_cases_side_by_side_have_the_efficiency_of_who_drives():
    """What leaves over what comes in, by either way that the power goes."""
    duty = "operation.duty_cycle=" + BACK
    cases = [
        read_case("gearset-3", case_tables(), ["operation.output_torque=300 N m", *own])
        for own in ([], [duty], [duty, "gearset.axial_module=2.2 mm"])
    ]
    found = compare(cases, lambda command, case: rate_case(case))
    numbers = {key: values for key, _, values in found.numbers}
    shown = {key for key, what, _ in found.numbers if what}
    for at, case in enumerate(cases):
        iso = rate_case(case).iso14521
        lost, put_in = (numbers[f"by_who_drives.{key}"][at] for key in POWERS)
        assert numbers["by_who_drives.efficiency"][at] == pytest.approx(1.0 - lost / put_in)
        assert put_in == iso["output_power_W" if at else "input_power_W"]
        way = "2_1" if at else "1_2"
        assert numbers["by_who_drives.teeth_efficiency"][at] == iso[f"eta_z{way}"]
    assert {f"by_who_drives.{key}" for key in POWERS} <= shown
    assert not {"iso14521.eta_ges", "iso14521.loss_total_W"} & shown
    assert sum("the load drives" in sentence for _, sentence in found.said) == 2
    both = compare(cases[:1] * 2, lambda command, case: rate_case(case))
    assert not any(key.startswith("by_who") for key, *_ in both.numbers)


def test_a_load_that_is_to_drive_and_cannot_has_no_efficiency_side_by_side():
    duty = "operation.duty_cycle=9 h, 15 N m, load drives"
    cases = [read_case("gearset-2", case_tables(), own) for own in ([], [duty])]
    found = compare(cases, lambda command, case: rate_case(case))
    numbers = {key: values for key, _, values in found.numbers}
    assert numbers["by_who_drives.efficiency"][0] > 0.0
    assert numbers["by_who_drives.efficiency"][1] is None
    assert numbers["by_who_drives.loss_total_W"][1] is None
    said = [sentence for _, sentence in found.said if "the load" in sentence]
    assert said == ["the load is to drive and cannot: it has no efficiency and no losses"]


@pytest.mark.parametrize("duty", ["1 h, 300 N m; 9 h, 150 N m, 700 rpm, load drives", None])
def test_where_the_worm_drives_at_times_it_is_that_of_the_worm(duty):
    settings = ["operation.output_torque=300 N m"]
    settings += [] if duty is None else [f"operation.duty_cycle={duty}"]
    found = rate_case(read_case("gearset-3", case_tables(), settings))
    assert f"efficiency {100 * found.iso14521['eta_ges']:.1f} % of the gearbox" in found.brief()
    assert "the load driving" not in found.brief()


def test_a_gearset_that_locks_itself_has_no_efficiency_under_a_load_that_is_to_drive():
    duty = "operation.duty_cycle=9 h, 15 N m, load drives"
    found = rate_case(read_case("gearset-2", case_tables(), [duty]))
    assert found.iso14521["eta_ges2_1"] < 0.0
    (said,) = [line for line in found.brief().splitlines() if "efficiency" in line]
    assert said.startswith("no efficiency: the load is to drive, which the gearset does not let it")


def test_measured_losses_and_a_given_oil_are_told_as_such():
    text = actuator("housing.idle_loss=30 W", "operation.oil_temperature=60 degC").brief()
    assert "60 as given; idling 30 W measured" in text


def test_without_the_tables_nothing_of_them_is_said():
    found = rate_case(read_case("gearset-3", case_tables()))
    assert found.of_duty == ()
    assert {"endurance", "starting"} & set(found.to_json()) == set()
    assert "rows" not in found.to_json()["verdict"]


def test_rows_of_others_stand_below_the_safeties_and_fail_the_gearbox():
    rows = (
        Row("worm bearing A", "ISO 281", 337e3, 5000.0, "h", "anticlockwise"),
        Row("worm shaft", "DIN 743", 1.1, 1.2, "", "fillet d 25"),
    )
    found = dataclasses.replace(actuator(), rows=rows)
    text = found.brief()
    assert text.startswith("does not hold: worm shaft by DIN 743\nholds by ISO/TR 14521")
    assert "first to fail: worm shaft by DIN 743, 1.1 of the 1.2 asked" in text
    assert "ISO 281 worm bearing A" in text
    assert "1.1 of 1.2  FAILS; fillet d 25" in text
    told = found.to_json()["verdict"]["rows"]
    assert [row["holds"] for row in told] == [True, False]
    assert told[0]["life_h"] == 337e3
    assert "does not hold:" not in dataclasses.replace(found, rows=rows[:1]).brief()


def test_a_duty_cycle_has_the_lines_of_the_spectrum_that_is_the_same():
    text = "250 N m, 1400 rpm, 500 h; 150 N m, 1400 rpm, 1500 h; 60 N m, 700 rpm, 3000 h"
    short = rate_case(read_case("gearset-3", case_tables(), [f"operation.duty_cycle={text}"]))
    whole = rate_case(read_case("gearset-3", case_tables(), [f"spectrum.step={text}"]))
    # What is assumed of the oil's temperature is a key of the spectrum.
    assert short.brief().splitlines()[:-1] == whole.brief().splitlines()[:-1]
    assert short.heading() == whole.heading() == "gearset 3: 3 loads in 5000 h"
    told, other = short.to_json(), whole.to_json()
    for key in ("duty_cycle", "duty_mean", "endurance", "starting"):
        assert told[key] == other[key], key
    assert len(short.tables()) == len(whole.tables())


@pytest.mark.slow
@pytest.mark.parametrize("duty", ["S3 15 %", "S2 15 min"])
def test_a_duty_that_cannot_count_is_told_with_the_verdict(duty):
    told = f"{duty} does not count yet, temperature is judged as of S1: give [housing] with"
    case = read_case("actuator-duty", case_tables(), [f"spectrum.duty={duty}"])
    whole = rate_case(case)
    assert "does not count" not in whole.brief()
    case.raw.pop("housing")
    case = case.replace(())
    found = rate_case(case)
    assert told in " ".join(found.brief().split())
    assert told in " ".join(repr(found.verdict).split())
    assert any(told in note for note in found.iso14521.notes)
    assert "does not count" in found.to_html()
    given = rate_case(case.replace(["operation.oil_temperature=60 degC"]))
    assert "does not count" not in given.brief()
    assert "does not count" not in rate_case(case.replace(["spectrum.duty=S1"])).brief()


def test_losses_and_energy_are_those_of_the_loads_in_their_hours():
    found = actuator()
    mean = found.to_json()["duty_mean"]
    parts = found.to_json()["duty_cycle"]
    hours = [part["hours_h"] for part in parts]
    lost = sum(h * part["loss_W"] for h, part in zip(hours, parts, strict=True))
    speeds = [part["worm_speed_rpm"] * math.pi / 30.0 / 50.0 for part in parts]
    out = sum(
        h * part["output_torque_Nm"] * speed
        for h, part, speed in zip(hours, parts, speeds, strict=True)
    )
    assert mean["loss_W"] == pytest.approx(lost / 5000.0, rel=1e-12)
    assert mean["loss_W"] == pytest.approx(found.iso14521["loss_mean_W"], rel=1e-12)
    assert mean["lost_energy_kWh"] == pytest.approx(lost / 1000.0, rel=1e-12)
    assert mean["output_power_W"] == pytest.approx(out / 5000.0, rel=1e-12)
    assert mean["efficiency"] == pytest.approx(out / (out + lost), rel=1e-12)
    other = actuator("spectrum.step=60 N m, 700 rpm, 10 h").brief()
    assert "this at the rated 250 N m, 1400 rpm, no load of the duty; over the duty" in other
    alone = actuator("spectrum.step=60 N m, 700 rpm, 10 h, load drives").to_json()["duty_mean"]
    assert alone["efficiency"] is None


def test_of_wear_without_an_answer_no_shares_are_told():
    text = actuator("spectrum.step=200 N m, 1e6 rpm, 6 h").brief()
    assert "of all wear" not in text


@pytest.mark.parametrize("shift", [-0.5, 0.0, 0.5])
def test_how_far_losses_are_off_those_by_the_efficiency_is_told(shift):
    # a = (z_2 + q + 2 x_2) m_x / 2
    distance = 0.5 * (60.0 + 8.2 + 2.0 * shift) * 2.1962
    case = read_case("gearset-3", case_tables(), [f"gearset.centre_distance={distance} mm"])
    found = rate_case(case).agma6034
    by_efficiency = found["output_power_W"] * (1.0 / found["eta"] - 1.0)
    apart = found["loss_meshing_W"] / by_efficiency - 1.0
    (note,) = (note for note in found.notes if "W_f is taken as Shigley has it" in note)
    if shift == 0.0:
        assert apart == pytest.approx(0.0, abs=1e-3)
        assert "so that losses and e_W agree" in note
    else:
        way = "less" if apart < 0.0 else "more"
        assert f"losses are {100.0 * abs(apart):.2g} % {way} than by e_W" in note
