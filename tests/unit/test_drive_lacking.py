"""What a drive lacks is asked for at once."""

import functools

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive import directions, locking
from asperity.drive.problem import DriveProblem
from asperity.drive.solve import prepare
from asperity.errors import InputError

GEARSET = """
[gearset]
starts = 1
wheel_teeth = 50
centre_distance = "100 mm"
axial_module = "3.15 mm"
diameter_factor = 12.5
worm_material = "case-hardened steel"
wheel_material = "CuSn12Ni2-C-GZ"

[operation]
lubricant = "ISO VG 220 polyglycol"
output_torque = "250 N m"
worm_speed = "1400 rpm"
"""
MENDS = {
    "[friction]": "friction.model=coulomb friction.mu=0.1",
    "[vibration]": "vibration.mode=axial vibration.frequency=20kHz "
    "vibration.displacement_amplitude=1um",
    "vibration.mode": "vibration.mode=axial",
    "drive.load_inertia": "drive.load_inertia=3e-3kg*m**2",
    "drive.contact_damping": "drive.contact_damping=0.01s/m",
    "shaft.diameter and shaft.span": "shaft.diameter=20mm shaft.span=120mm",
    "mount.backlash": "mount.backlash=20um",
}
SHAKEN = ("vibration.frequency=20 kHz", "vibration.displacement_amplitude=1 um")
TEETH = "drive.deflection=[['23 N m','47.6 urad'],['366 N m','365 urad']]"
ROUND = ("drive.effective_radius=19.5 mm", "drive.tangential_compliance=2.9 nm/N", TEETH)


def read(tmp_path, settings):
    path = tmp_path / "gear.toml"
    path.write_text(GEARSET, encoding="utf-8")
    return read_case(path, case_tables(), settings)


def lacking(ask, case):
    """Return the lines in which a case is refused, each naming what is missing."""
    with pytest.raises(InputError) as refused:
        ask(case)
    head, _, listed = str(refused.value).partition("these are missing, add them: ")
    assert "\n" not in head + listed
    return listed.split("; ")


@pytest.mark.ordinary(6)
@pytest.mark.parametrize(
    ("ask", "settings", "count"),
    [
        (locking.prepare, SHAKEN, 6),
        (locking.prepare, (*SHAKEN, "shaft.diameter=20 mm"), 6),
        (locking.prepare, (*SHAKEN, "drive.friction=iso14521", "drive.flanks=driving"), 4),
        (directions.prepare, (), 5),
        (prepare, SHAKEN, 5),
        (prepare, (*SHAKEN, "drive.protocol=held-wheel"), 6),
        (prepare, (*SHAKEN, "vibration.mode=screw", "actuator.coupling=0.3"), 5),
        (prepare, (*SHAKEN, "vibration.mode=screw", "shaft.bearing_axial=50 N/um"), 5),
    ],
)
def test_all_that_is_missing_is_named_at_once_and_each_of_it_is_needed(
    tmp_path, ask, settings, count
):
    given = (*ROUND, *settings)
    missing = lacking(ask, read(tmp_path, given))
    assert len(missing) == count
    mends = [
        next(mend for key, mend in MENDS.items() if each.startswith(key)).split()
        for each in missing
    ]
    ask(read(tmp_path, [*given, *(setting for mend in mends for setting in mend)]))
    for left in mends:
        others = [setting for mend in mends if mend is not left for setting in mend]
        with pytest.raises(InputError, match=r"is missing"):
            ask(read(tmp_path, [*given, *others]))


@pytest.mark.parametrize("ask", [functools.partial(prepare, static=True), locking.prepare])
def test_a_drive_at_rest_lacks_friction_alone(tmp_path, ask):
    with pytest.raises(InputError, match=r"\[friction\] is missing"):
        ask(read(tmp_path, ROUND))
    ask(read(tmp_path, [*ROUND, *MENDS["[friction]"].split()]))


def test_a_case_of_something_else_is_no_drive():
    with pytest.raises(InputError, match=r"there is no \[gearset\] in it"):
        DriveProblem.from_case(read_case("table-4.3", case_tables()))
