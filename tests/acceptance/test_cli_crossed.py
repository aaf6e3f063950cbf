"""``asperity crossed`` tells geometry, speed and pressure, and that it rates no strength."""

import json
import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.gearset import Gearset
from asperity.gearset.crossed import crossed


def test_the_command_says_that_no_strength_is_rated(asperity):
    code, output, errors = asperity("crossed", "gearset-3")
    assert code == 0, errors
    assert "strength is not rated" in output
    code, output, errors = asperity("crossed", "gearset-3", "--json")
    found = json.loads(output)
    # Without friction the wheel's torque is the normal force times its lever.
    case = read_case("gearset-3", case_tables())
    g, torque = case.require(Gearset).geometry, case["operation"].output_torque
    pair = crossed(g)
    lever = 0.5e-3 * g.wheel_teeth * g.normal_module * math.cos(g.pressure_angle)
    assert found["force_N"] == pytest.approx(torque / lever, rel=1e-12)
    assert found["contact_ratio"] == pytest.approx(pair.contact_ratio)
    assert found["most_pressure_MPa"] >= found["pressure_MPa"]
    code, _, errors = asperity("crossed", "gearset-3", "--set", "gearset.flank=ZC")
    assert code == 2
    assert "only an involute helicoid meshes with a helical wheel" in errors


def test_without_an_operation_there_is_geometry_alone(asperity, tmp_path):
    text = "[gearset]\nstarts=1\nwheel_teeth=50\naxial_module='2 mm'\ndiameter_factor=10\n"
    text += "worm_material='case-hardened steel'\nwheel_material='CuSn12-C-GZ'\n"
    (tmp_path / "own.toml").write_text(text)
    code, output, errors = asperity("crossed", "own.toml", "--json", cwd=tmp_path)
    assert code == 0, errors
    found = json.loads(output)
    assert found.get("pressure_MPa") is None
    assert found["contact_ratio"] > 1.0
