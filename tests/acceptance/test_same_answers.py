"""Every command answers what it answered when its answers were recorded, to twelve digits."""

import pytest
from apparatus.called import left_to_numba
from compare import differences
from observe import command_lines, observe
from record import records

_STRETCHES = "a row of a march's history is the mean of a stretch, with what it swings through"
_MARCHED = ("slide table-4.[34] --out OUT", "slide table-4.1-L4 * --out OUT")
_OF_MARCHES = (
    *((line, f"slide.nc:{name}", _STRETCHES)
      for line in _MARCHED
      for name in ("time", "drive_force", "friction", "deflection", "position", "velocity")),
    *(("slide * --out OUT", f"slide.nc:{name}", _STRETCHES)
      for name in ("span", "drive_force_m*", "friction_m*", "deflection_m*", "position_m*",
                   "velocity_m*")),
)  # fmt: skip

CHANGES = (
    *_OF_MARCHES,
    *(
        ("block *", f"block.nc:{name}", _STRETCHES)
        for name in ("time", "drive_force", "friction", "deflection", "position", "velocity")
    ),
    # (command lines, what in their answers, why it is no longer what was recorded)
    ("drive *", "*contact_width*", "it is of the area that bears, not of how a contact is bent"),
    ("slide oblique *", "json.thrust_N", "a vibration that drives the body tells its thrust"),
    ("cases", "json.cases", "three cases of vibration out of the plane have come"),
    ("check *", "json.refused.shafts", "a command of shafts has come"),
    ("check *", "json.commands", "a command of REXS files has come"),
    ("materials", "json.listed*.brinell_hardness", "the hardness caps the pressure of an edge"),
    ("materials", "json.listed*.sources.brinell_hardness*", "where the hardness is from"),
    *(
        ("schema", f"json.properties.{table}*", "tables of shafts and bearings have come")
        for table in ("worm_shaft", "wheel_shaft", "bearings")
    ),
    *(
        ("flank *", f"flank.nc:{name}.units", "what labels a dimension is a number without unit")
        for name in ("axis", "direction", "part")
    ),
    *(
        (line, f"slide.nc:{name}", "the history of a march holds means of stretches, not samples")
        for line in ("slide table-4.? --out OUT", "slide table-4.1-L4 * --out OUT")
        for name in ("time", "drive_force", "friction", "deflection", "position", "velocity")
    ),
    ("compare *", "*results.forces.*", "forces on shafts and bearings are told"),
    ("schema", "json.properties.project*", "a case says for whom it is made"),
    ("compare *", "*results.holding*", "what holds the load when the motor stops is told"),
    *(
        (f"{line} *", f"{place}.geometry*", "the geometry that the report draws is told")
        for line in ("drive", "flank")
        for place in ("json", f"{line}.json", "*answer*")
    ),
    ("*", "*from_memory*", "documents have been found for numbers that were from memory"),
    *(
        (line, f"json.listed*.sources.*.{what}", "documents have been found")
        for line in ("materials*", "lubricants*", "motors*")
        for what in ("name", "confidence", "note")
    ),
    ("optimise *", "*json.locking", "whether a design locks itself is told"),
    ("*", "json*.assumed.rating.iso14521_face_width", "b_2H is offered both ways, one is assumed"),
    *(
        ("thesis *", place, "a number asked for brings claims and tables of that number too")
        for place in ("json.claims*", "json.failed*", "json.tables*", "figure-4.3.nc:*")
    ),
    (
        "optimise gearset-3 --set rating.iso14521_edition=1998",
        "json.*pressure_angle_deg*",
        "the edition of 1998 knows no pressure angle: any is as good as any other",
    ),
    (
        "drive drive-actuator *",
        "json.safety_wear*",
        "a valve's gearset lives for its strokes, not for a gearbox's 25000 h",
    ),
)


def _marked(group, *marks):
    return [
        pytest.param(line.split()[0], line, id=line, marks=marks) for line in command_lines(group)
    ]


SLOW = pytest.mark.slow, pytest.mark.campaign


@pytest.mark.parametrize(("command", "line"), _marked("ordinary") + _marked("slow", *SLOW))
def test_the_answer_is_the_recorded_one(command, line, tmp_path):
    recorded = records(command)[line]
    with left_to_numba() as unlisted:
        observed = observe(line, tmp_path)
    found = differences(line, recorded, observed, CHANGES)
    assert not found, "\n".join([line, *found[:20], f"{len(found)} differences"])
    # Where it fails, `python tests/harvest.py --again` with words of the line.
    assert not unlisted, line
