"""What a command takes beside a case, read in one place; and what rooms above add to its answer."""

import pytest

from asperity.casefile import read_case
from asperity.commands import COMMANDS, case_tables
from asperity.errors import InputError
from asperity.friction.dahl import LAWS
from asperity.rating.standards import ALL, STANDARDS
from asperity.runs import Run
from asperity.tribometer.fit.forward import BLOCK, DRIVE, SLIDE
from asperity.tribometer.guardian.backends import BACKENDS
from asperity.tribometer.report.standards import STANDARDS as ASTM

GEARSET = read_case("gearset-3", case_tables(), [])


def command_of(name):
    return next(one for one in COMMANDS if one.name == name)


def option_of(command, name):
    return next(one for one in command_of(command).options if one.name == name)


@pytest.mark.parametrize(
    ("command", "name", "allowed"),
    [
        ("rate", "standard", {*STANDARDS, ALL}),
        ("fit", "law", {*LAWS, "all"}),
        ("fit", "model", {SLIDE, BLOCK, DRIVE}),
        ("rig run", "backend", {*BACKENDS}),
        ("rig report", "standard", {*ASTM}),
        ("rig package", "standard", {*ASTM}),
    ],
)
def test_an_option_takes_what_its_room_knows_and_nothing_else(command, name, allowed):
    option = option_of(command, name)
    assert set(option.choices) == allowed
    for text in (*option.choices, option.default):
        assert option.read(text) == text
    near = option.choices[0][:-1]
    with pytest.raises(InputError, match=rf"^--{name} {near}: it must be one of .*"):
        option.read(near)


def test_an_option_that_counts_gives_a_number():
    option = option_of("fit", "next")
    assert [option.read(text) for text in (option.default, "7", "100", 3)] == [0, 7, 100, 3]
    for text in ("-1", "101", "", "two", "1.5", "²", "9" * 5000):
        with pytest.raises(InputError, match="whole number, at most 100"):
            option.read(text)


def test_options_are_read_before_a_command_prepares_and_before_it_reads_a_case(tmp_path):
    with pytest.raises(InputError, match=r"^--standard agma: it must be one of "):
        command_of("rate").prepared(GEARSET, standard="agma")
    report = {"folder": str(tmp_path), "standard": "G98"}
    with pytest.raises(InputError, match=r"^--standard G98: it must be one of "):
        command_of("rig report").case_of("", [], **report)


def test_what_is_added_to_an_answer_is_prepared_where_it_is_asked_for():
    rate = command_of("rate")
    assert rate.prepared(GEARSET, **rate.defaults)[1] == []
    problem = rate.prepared(GEARSET, **rate.defaults | {"pattern": True})
    assert len(problem[1]) == 1
    with pytest.raises(InputError, match="name a folder for it with --out"):
        rate.solved(problem, Run())
    # What an answer is kept under follows from all that adds to it.
    assert [module.split(".")[1] for module in rate.modules] == [
        "rating",
        "shafts",
        "flanks",
        "flanks",
    ]
