"""Loads of a spectrum as a text, and what a gearset weighs."""

import math
import random

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.gearset.masses import DENSITY, masses
from asperity.rating import Spectrum

TEXT = "250 N m, 1400 rpm, 500 h; 150 N m, 1400 rpm, 1500 h; 60 N m, 700 rpm, 3000 h"


def spectrum(steps, **more):
    return Spectrum.model_validate({"step": steps, **more}, context={"text_only": True})


def test_loads_as_a_text_are_the_loads_as_tables():
    tables = [
        {"output_torque": "250 N m", "worm_speed": "1400 rpm", "duration": "500 h"},
        {"output_torque": "150 N m", "worm_speed": "1400 rpm", "duration": "1500 h"},
        {"output_torque": "60 N m", "worm_speed": "700 rpm", "duration": "3000 h"},
    ]
    assert spectrum(TEXT) == spectrum(tables)


@pytest.mark.parametrize("seed", range(20))
def test_parts_of_a_step_stand_in_any_order_and_unit(seed):
    draw = random.Random(seed)
    time = draw.choice([("duration", "h"), ("turns", "turns")])
    load = draw.choice([("output_torque", "N m"), ("output_torque", "lbf in"),
                        ("input_power", "W"), ("input_power", "hp")])  # fmt: skip
    parts = {key: f"{draw.uniform(1, 500):.4g} {unit}" for key, unit in (time, load)}
    parts["worm_speed"] = f"{draw.uniform(100, 3000):.5g} rpm"
    written = list(parts.values())
    if draw.random() < 0.5:
        parts["rotation"] = "clockwise"
        written.append(draw.choice(["clockwise", "rotation = clockwise"]))
    draw.shuffle(written)
    table = {key: text.removesuffix(" turns") for key, text in parts.items()}
    if "turns" in table:
        table["turns"] = float(table["turns"])
    assert spectrum(", ".join(written)) == spectrum([table])


def test_a_share_is_of_the_life():
    found = spectrum("250 N m, 10 %; 60 N m, 90 %", life="100 h")
    assert [step.duration for step in found.steps(None)] == pytest.approx([36e3, 324e3])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("250 N m, 3 m", "'3 m' is no torque, time, speed, power, number of turns or share"),
        ("250", "'250' is no torque"),
        ("3 h, 4 h, 9 N m", "says duration twice"),
        ("250 N m", "spectrum.step, number 1 of the list: duration is missing"),
        ("", "is no torque"),
        ("1 h; ; 2 h", "is no torque"),
        ("torque=250 N m, 3 h", "'torque=250 N m' is no torque"),
        ("-250 N m, 3 h", "output_torque"),
    ],
)
def test_what_is_no_load_is_refused_in_one_line(text, said):
    with pytest.raises(InputError, match=said) as caught:
        spectrum(text)
    assert "\n" not in str(caught.value)


def test_a_gearset_weighs_what_its_cylinders_do():
    gearset = read_case("gearset-3", case_tables()).require(Gearset)
    g = gearset.geometry
    found = masses(gearset)
    quarter = math.pi / 4.0 * 1e-9
    worm = 7850.0 * quarter * g.worm_pitch_diameter**2 * g.worm_face_width
    wheel = quarter * g.wheel_mean_diameter**2 * g.wheel_face_width
    inside = quarter * (g.wheel_root_diameter - 2 * g.rim_thickness) ** 2 * g.wheel_face_width
    density = DENSITY[gearset.wheel_material.family]
    assert found.rim == pytest.approx(density * (wheel - inside))
    assert found.whole == pytest.approx(worm + 7850.0 * inside + found.rim)
