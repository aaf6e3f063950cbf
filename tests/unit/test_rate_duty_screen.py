"""What the first screen says of loads, oil, life and starting, and of what others add to it."""

import dataclasses

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import rate_case
from asperity.rating.rows import Row


def actuator(*settings):
    return rate_case(read_case("actuator-duty", case_tables(), settings))


def test_the_screen_of_an_actuator_tells_its_loads_oil_life_and_start():
    found = actuator()
    text = found.brief()
    assert found.heading() == "actuator: 3 loads in 5000 h, S3 15 % of 10 min"
    for said in (
        "of all wear by ISO/TR 14521: 150 N m 42 %, 60 N m 36 %, 250 N m 23 %",
        "life 155,917 h of 5,000 asked, until wear by ISO/TR 14521",
        "AGMA 6034 has no load spectra: the load nearest to its limit, times a service",
        "oil 32 degC by heat balance, 63 by ISO's formula (S1); idling 139 W by formula",
        "starts at 33 % of the teeth, motor 16.6 N m (friction at rest of AGMA 6034)",
    ):
        assert said in text
    assert max(map(len, text.splitlines())) <= 79


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
    assert "does not hold: worm shaft by DIN 743" in text
    assert "ISO 281 worm bearing A" in text
    assert "1.1 of 1.2  FAILS; fillet d 25" in text
    told = found.to_json()["verdict"]["rows"]
    assert [row["holds"] for row in told] == [True, False]
    assert told[0]["life_h"] == 337e3
    assert "does not hold:" not in dataclasses.replace(found, rows=rows[:1]).brief()
