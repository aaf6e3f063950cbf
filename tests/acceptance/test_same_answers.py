"""Every command answers what it answered when its answers were recorded, to twelve digits."""

import pytest
from compare import differences
from observe import command_lines, observe
from record import records

CHANGES = (
    # (command lines, what in their answers, why it is no longer what was recorded)
    *(
        ("flank *", f"flank.nc:{name}", "scalars stand in the file as well")
        for name in (
            "axial_amplitude_max",
            "axial_clearance",
            "backlash_normal",
            "backlash_normal_least",
            "base_lead_angle",
            "base_radius",
            "conjugacy_residual",
            "contact_ratio",
            "contact_ratio_marked",
            "ease_off_max",
            "ease_off_min",
            "flank_area",
            "lead_angle",
            "marking_thickness",
            "pattern_area_fraction",
            "pattern_face",
            "pattern_radius",
            "pitch",
            "pitch_radius",
            "transmission_error_mean",
            "transmission_error_range",
        )
    ),
    *(
        ("flank *", f"flank.nc:{name}.units", "what labels a dimension is a number without unit")
        for name in ("axis", "direction", "part")
    ),
    ("*", "json*.assumed.rating.iso14521_face_width", "b_2H is offered both ways, one is assumed"),
    *(
        (line, "json.agma6034.violations", "a sump too hot is named")
        for line in ("*output_torque='500 N m'*", "rate gearset-3 --set rating.friction=0.05")
    ),
)


def _marked(group, *marks):
    return [pytest.param(line, id=line, marks=marks) for line in command_lines(group)]


@pytest.mark.parametrize("line", _marked("ordinary") + _marked("slow", pytest.mark.slow))
def test_the_answer_is_the_recorded_one(line, tmp_path):
    recorded = records(line.split()[0])[line]
    found = differences(line, recorded, observe(line, tmp_path), CHANGES)
    assert not found, "\n".join([line, *found[:20], f"{len(found)} differences"])
