"""Quantities in Python: text, quantities of pint, numbers whose unit is named, and nothing else."""

import math

import pint
import pytest

from asperity.errors import InputError
from asperity.friction import Friction
from asperity.gearset import Gearset
from asperity.rating.parameters import Operation
from asperity.slider import Model, Slider
from asperity.vibration import Vibration

GEARS = {
    "starts": 1,
    "wheel_teeth": 40,
    "diameter_factor": 10,
    "worm_material": "case-hardened steel",
    "wheel_material": "CuSn12-C-GZ",
}
RUN = {"output_torque": "300 N m", "lubricant": "ISO VG 220 mineral"}
SHAKEN = {"frequency": "4 kHz", "velocity_ratio": 6}


def refusal(call, *arguments, **keywords):
    with pytest.raises(InputError) as raised:
        call(*arguments, **keywords)
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


@pytest.mark.parametrize(
    ("table", "given", "key", "unit"),
    [
        (Gearset, {**GEARS, "centre_distance": 100}, "centre_distance is 100", "mm"),
        (Gearset, {**GEARS, "axial_module": 4}, "axial_module is 4", "mm"),
        (Operation, {**RUN, "worm_speed": 1500}, "worm_speed is 1500", "rpm"),
        (Vibration, {**SHAKEN, "direction": 30}, "direction is 30", "deg"),
    ],
)  # fmt: skip
def test_a_bare_number_is_refused_with_the_three_ways_to_say_it(table, given, key, unit):
    said = refusal(table, **given)
    assert said.startswith(f"{table.table}.{key}; it must be a")
    assert "as text such as '" in said
    assert "as a quantity of pint" in said
    assert said.endswith(f"as a number with units='{unit}'")


def same(*tables):
    assert len({table.model_dump_json() for table in tables}) == 1


def test_text_pint_and_a_number_with_its_unit_give_the_same_bits():
    u = pint.UnitRegistry()
    for size in (74.93, 100.0, 0.1, 1 / 3):
        text = Gearset(**GEARS, centre_distance=f"{size!r} mm", profile_shift=0)
        same(
            text,
            Gearset(**GEARS, centre_distance=size * u.mm, profile_shift=0),
            Gearset(**GEARS, centre_distance=size, profile_shift=0, units="mm"),
            Gearset(**GEARS, centre_distance=size, profile_shift=0, units=["rpm", "mm"]),
            Gearset(
                **GEARS, centre_distance=size, profile_shift=0, units={"centre_distance": "mm"}
            ),
        )
    same(
        Operation(**RUN, worm_speed="1500 rpm", ambient_temperature="20.3 degC"),
        Operation(**RUN, worm_speed=1500 * u.rpm, ambient_temperature=u.Quantity(20.3, u.degC)),
        Operation(**RUN, worm_speed=1500, ambient_temperature=20.3, units="rpm, degC"),
    )
    same(
        Vibration(**SHAKEN, direction="30 deg"),
        Vibration(**SHAKEN, direction=30 * u.degree),
        Vibration(**SHAKEN, direction=30, units="deg"),
    )
    assert Vibration(**SHAKEN, direction=0.5, units="SI").direction == 0.5
    assert Operation(**RUN, worm_speed="1500 1/min").worm_speed == 50.0 * math.pi


@pytest.mark.parametrize(
    ("units", "said"),
    [
        ("mm, um", "units names 'mm' and 'um', which are of one kind"),
        ("mmm", "units names 'mmm', which is not a unit"),
        (3, "units is 3; it must be 'SI', units such as 'mm, rpm', or a unit by key"),
        ("rpm", "gearset.centre_distance is 100; it must be a length with its unit"),
    ],
)
def test_units_that_are_none_or_do_not_fit_are_refused(units, said):
    given = {**GEARS, "profile_shift": 0, "centre_distance": 100}
    assert refusal(Gearset, **given, units=units).startswith(said)


@pytest.mark.slow
def test_a_quantity_of_pint_of_another_kind_is_refused():
    u = pint.UnitRegistry()
    assert "it must be a length such as" in refusal(
        Gearset, **GEARS, profile_shift=0, centre_distance=100 * u.kg
    )


def test_a_copy_is_checked_like_a_new_table():
    body = Slider(drive_velocity="0.5 mm/s", normal_force="55 N")
    assert body.model_copy(update={"normal_force": "20 N"}).normal_force == 20.0
    assert body.model_copy(update={"normal_force": 20.0}, units="N").normal_force == 20.0
    assert "slider.normal_force is 20" in refusal(body.model_copy, update={"normal_force": 20})
    assert "did you mean 'normal_force'?" in refusal(body.model_copy, update={"normal_forc": 1})
    shaken = Vibration(**SHAKEN)
    changed = shaken.model_copy(update={"velocity_amplitude": "3 mm/s"})
    assert (changed.velocity_ratio, changed.velocity_amplitude) == (None, 3e-3)
    assert changed.frequency == shaken.frequency


def test_keys_are_named():
    assert refusal(Slider, "0.5 mm/s") == (
        "Slider is given '0.5 mm/s' without a key; name each, as in Slider(drive_velocity=...)"
    )


def test_tables_in_the_wrong_order_or_of_the_wrong_type_are_refused_in_one_line():
    body = Slider(drive_velocity="0.5 mm/s", normal_force="55 N")
    contact = Friction(mu=0.1, max_deflection="70 nm")
    shaken = Vibration(**SHAKEN)
    assert refusal(Model, contact, body) == (
        "Model is given a Friction as slider; it must be a Slider"
    )
    assert "a Friction as vibration; it must be a Vibration" in refusal(
        Model, body, contact, contact
    )
    assert "'x' as solve; it must be a Solve" in refusal(Model, body, contact, shaken, "x")
