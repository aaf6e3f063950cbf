"""BS 721 against the thesis's gearset 3 and the standard's own fixed points.

Sources: gearset 3 of the thesis, reconstructed from its text (sections 3.3.1, 7.2.2, 7.2.4: ratio
15, 60 teeth, 1440 rpm, 1510.8 mm/s, 500000 turns of the wheel, aluminium bronze taken as
centrifugally cast phosphor bronze); IS 7443, which prints the same formulas in kgf.
"""

import doctest
import math

import numpy as np
import pytest
from apparatus.formulas import formulas_of

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.rating import bs721, rate_case
from asperity.rating.bs721 import life, torque
from asperity.sources import Source

HOURS = 500_000 / (60.0 * 96.0)


def wheel_of_gearset_3(q):
    """Torques that the wheel bears for 26000 h, by wear and by strength, for a diameter factor."""
    lead = math.atan(4.0 / q)
    d1 = 20.0376 * math.cos(lead)
    m = d1 / q
    d2, width = 60.0 * m, 2.0 * m * math.sqrt(q + 1.0)
    speed = bs721.torque.wear_speed_factor(1.5108, 96.0)
    wear = bs721.torque.wear_torque(speed, 15.2, bs721.torque.zone_factor(4, q, width, m), d2, m)
    arc = bs721.torque.root_arc(width, d1 + 2.0 * m, m, q, lead)
    return wear, bs721.torque.strength_torque(
        bs721.torque.strength_speed_factor(96.0), 69.0, m, arc, d2, lead
    )


def rated(*settings):
    return rate_case(read_case("gearset-3", case_tables(), settings), ("bs721",)).bs721


def test_permissible_torque_of_gearset_3():
    wear, strength = wheel_of_gearset_3(8.36)
    assert round(wear) == 148
    assert wear < strength


def test_strength_of_gearset_3_carries_its_rated_torque_up_to_a_diameter_factor_of_8_45():
    factor = bs721.life.strength_life_factor(HOURS / 10.0)
    assert wheel_of_gearset_3(8.2)[1] * factor > 366.0
    assert wheel_of_gearset_3(8.44)[1] * factor > 366.0
    assert wheel_of_gearset_3(8.46)[1] * factor < 366.0


def test_gearset_3_passes_as_the_thesis_says():
    wear, strength = wheel_of_gearset_3(8.2)
    m_w = wear * bs721.life.wear_life_factor(HOURS)
    m_s = strength * bs721.life.strength_life_factor(HOURS / 10.0)
    assert m_w > 366.0 / 3.0
    assert m_s > 366.0
    assert min(m_w, m_s) > min(wear, strength)


def test_worm_beyond_the_tables_is_left_out_and_said_so():
    result = rated()
    assert not {"M_c_worm_Nm", "M_b_worm_Nm"} & {entry.key for entry in result}
    assert result["M_26k_Nm"] == min(result["M_c_wheel_Nm"], result["M_b_wheel_Nm"])
    wear, strength = (note for note in result.notes if note.startswith("the worm is not rated"))
    assert "worm_speed is 1440 rpm; it must be from 0.5 to 600 rpm" in wear
    assert "worm_speed is 1440 rpm; it must be from 1 to 1200 rpm" in strength


def test_worm_within_the_tables_is_rated_with_its_own_factors():
    result = rated("operation.worm_speed=600 rpm")
    v = result["sliding_velocity_m_s"]
    speed = bs721.torque.wear_speed_factor(v, 600.0) / bs721.torque.wear_speed_factor(v, 40.0)
    wear = result["M_c_wheel_Nm"] * speed * 48.3 / 15.2
    assert result["M_c_worm_Nm"] == pytest.approx(wear, rel=1e-12)
    speed = bs721.torque.strength_speed_factor(600.0) / bs721.torque.strength_speed_factor(40.0)
    strength = result["M_b_wheel_Nm"] * speed * 276.0 / 69.0
    assert result["M_b_worm_Nm"] == pytest.approx(strength, rel=1e-12)
    assert not any("worm is not rated" in note for note in result.notes)
    members = ("M_c_wheel_Nm", "M_c_worm_Nm", "M_b_wheel_Nm", "M_b_worm_Nm")
    assert result["M_26k_Nm"] == min(result[key] for key in members)


def test_weak_worm_limits_the_torque():
    result = rated("operation.worm_speed=600 rpm", "gearset.worm_material=0.4C steel")
    assert result["M_26k_Nm"] == result["M_c_worm_Nm"] < result["M_c_wheel_Nm"]


def test_both_life_factors_are_one_at_26000_hours():
    assert bs721.life.wear_life_factor(26000.0) == pytest.approx(1.0, abs=1e-15)
    assert bs721.life.strength_life_factor(26000.0) == pytest.approx(1.0, abs=1e-15)
    assert bs721.life.wear_life_factor(0.0) == pytest.approx(3.0, rel=1e-15)


def test_formulas_in_numbers():
    assert bs721.torque.wear_torque(0.3, 15.2, 1.2, 100.0, 2.0) == pytest.approx(
        0.00191 * 0.3 * 15.2 * 1.2 * 10.0**3.6 * 2.0, rel=1e-14
    )
    assert bs721.torque.strength_torque(
        0.4, 69.0, 2.0, 14.0, 130.0, math.pi / 3.0
    ) == pytest.approx(0.0018 * 0.4 * 69.0 * 2.0 * 14.0 * 130.0 * 0.5, rel=1e-14)
    # A clearance of 0.2 m cos(60 deg) = 0.4 mm makes a diameter of 20.8 mm, half of it the face.
    assert bs721.torque.root_arc(10.4, 20.0, 4.0, 8.0, math.pi / 3.0) == pytest.approx(
        20.8 * math.pi / 6.0, rel=1e-14
    )
    # Here only 2 m sqrt(q + 1) = 12 mm of the face counts.
    assert bs721.torque.root_arc(30.0, 23.6, 2.0, 8.0, math.pi / 3.0) == pytest.approx(
        24.0 * math.pi / 6.0, rel=1e-14
    )


def test_formulas_agree_with_those_of_is_7443_within_the_rounding_of_both():
    # 18.64 X S Z d^1.8 m in kgf/mm2 and N mm; 17.65 X S m l d cos(g) likewise.
    kgf = 9.80665
    wear = 18.64e-3 * 0.3 * (15.2 / kgf) * 1.2 * 130.0**1.8 * 2.2
    assert bs721.torque.wear_torque(0.3, 15.2, 1.2, 130.0, 2.2) == pytest.approx(wear, rel=6e-3)
    strength = 17.65e-3 * 0.4 * (69.0 / kgf) * 2.2 * 14.0 * 130.0 * math.cos(0.45)
    assert bs721.torque.strength_torque(0.4, 69.0, 2.2, 14.0, 130.0, 0.45) == pytest.approx(
        strength, rel=2e-3
    )


def test_wide_faces_do_not_count_above_2_3():
    unit = 2.0 * math.sqrt(9.0)
    at = 2.3 * math.sqrt(9.0) * 2.0
    assert bs721.torque.zone_factor(4, 8.0, at, 2.0) == pytest.approx(1.204 * 1.15, rel=1e-14)
    assert bs721.torque.zone_factor(4, 8.0, 10.0 * at, 2.0) == bs721.torque.zone_factor(
        4, 8.0, 2.0 * at, 2.0
    )
    assert bs721.torque.zone_factor(4, 8.0, unit, 2.0) == pytest.approx(0.5 * 1.204, rel=1e-14)


def test_tables_hold_their_points_and_are_linear_between():
    assert bs721.torque.wear_speed_factor(1.0, 100.0) == pytest.approx(0.55 * 0.55)
    assert bs721.torque.wear_speed_factor(1.5, 75.0) == pytest.approx(0.525 * 0.59)
    assert bs721.torque.strength_speed_factor(60.0) == 0.45
    assert bs721.torque.strength_speed_factor(80.0) == pytest.approx(0.435)
    assert bs721.torque.zone_factor(1, 10.5, 2.0 * math.sqrt(11.5), 1.0) == pytest.approx(1.1515)
    assert bs721.torque.friction(0.0) == 0.145
    assert bs721.torque.friction(3.5) == pytest.approx(0.028)
    assert bs721.torque.friction(50.0) == 0.016


@pytest.mark.slow
def test_life_factors_and_friction_have_no_jumps():
    def largest_step(formula, points):
        values = formula(np.linspace(0.0, 40.0, points))
        return np.abs(np.diff(values)).max()

    for formula in (
        bs721.life.wear_life_factor,
        bs721.life.strength_life_factor,
        bs721.torque.friction,
    ):
        # The steepest piece of the friction table is 0.001 m/s wide.
        assert largest_step(formula, 2_000_001) < 0.06 * largest_step(formula, 100_001)


def test_every_formula_and_table_has_a_source():
    known = bs721.tables.read_tables()
    assert set(known.sources) == {
        "zone_factor",
        "sliding_speed_factor",
        "rotation_speed_factor",
        "strength_speed_factor",
        "friction",
        "bending_stress_factor",
        "surface_stress_factor",
        "worm_surface_stress_factor",
    }
    assert {source.confidence for source in known.sources.values()} == {"from memory"}
    assert known.source.confidence == "from memory"
    assert all(isinstance(formula.source, Source) for formula in formulas_of(bs721).values())


def test_limits_of_the_standard_are_reported():
    assert bs721.limits.VALIDITY["axial_module"].violation(0.5) is not None
    assert bs721.limits.VALIDITY["wheel_speed"].violation(96.0) is None


@pytest.mark.parametrize("module", [life, torque])
def test_examples_in_the_documentation_hold(module):
    results = doctest.testmod(module)
    assert results.failed == 0
