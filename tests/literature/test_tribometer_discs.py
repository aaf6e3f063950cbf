"""The discs of the rig against numbers that the thesis prints.

Source: the thesis, Table 6.3 (dry runs of the preliminary rig),
6.4.8 and Table 6.8 (Hertz contact), 6.4.4 ("40 lbs (178 N)"). Speeds in Table 6.3 are printed to
1 rpm of 1000 and 0.1 of 18.7, velocities to 1 mm/s, ratios to 0.01.
"""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.thesis.rig import measured as m
from asperity.tribometer import discs
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import Lubricant
from asperity.tribometer.tables import TABLES

RPM = np.pi / 30.0
KNOWN = TABLES


def pair(name, *settings):
    return Pair.from_case(read_case(name, KNOWN, settings))


def rims():
    rig = pair("rig-preliminary")
    steel = discs.peripheral_velocity(rig.steel.diameter, RPM * m.STEEL_RPM)
    bronze = discs.peripheral_velocity(rig.bronze.diameter, RPM * m.BRONZE_RPM)
    return steel, bronze


def test_sliding_and_rolling_velocities_of_table_6_3_follow_from_its_speeds():
    # Within what rounding the speeds and the velocities leaves: 0.5 rpm are 1 mm/s.
    assert 1e3 * discs.sliding_velocity(*rims()) == pytest.approx(m.PRINTED_SLIDING, abs=1.6)
    assert 1e3 * discs.rolling_velocity(*rims()) == pytest.approx(m.PRINTED_ROLLING, abs=1.1)


def test_slide_roll_ratios_of_table_6_3_follow_but_for_the_first_rounding():
    ratios = discs.slide_roll_ratio(*rims())
    assert ratios == pytest.approx(m.PRINTED_RATIO, abs=0.0055)
    assert ratios[0] == pytest.approx(0.915, abs=5e-4)


def test_hertz_pressure_and_load_of_the_final_rig_are_those_printed():
    rig = pair("rig-final")
    assert rig.rig.load == pytest.approx(141.6, abs=0.05)
    assert 1e-6 * rig.pressure == pytest.approx(194.3, abs=0.1)
    assert 2e3 * rig.half_width == pytest.approx(0.116, abs=5e-4)
    # The moduli that the thesis names elsewhere give another pressure.
    other = pair(
        "rig-final",
        "steel_disc.young_modulus=209 GPa",
        "bronze_disc.young_modulus=120 GPa",
    )
    assert 1e-6 * other.pressure == pytest.approx(191.6, abs=0.1)


def test_friction_by_the_currents_is_plausible_only_if_the_loads_are_kilograms():
    rig = pair("rig-preliminary")
    torque = 0.0515 * (m.STEEL_CURRENT[1:] - m.STEEL_CURRENT[0]) * rig.drives.gear_ratio
    pounds = m.LOADS_LB[1:] * m.POUND_FORCE
    friction = discs.friction_of_torque(torque, pounds, rig.steel.diameter)
    assert friction == pytest.approx([0.13, 0.20, 0.38, 0.34], abs=0.01)
    printed = discs.friction_of_torque(torque, m.PRINTED_LOADS[1:], rig.steel.diameter)
    assert printed.min() > 1.2
    assert printed.max() > 3.5
    assert m.LOADS_LB[1:] * m.POUND == pytest.approx(m.PRINTED_LOADS[1:], abs=0.05)


def test_torques_of_both_discs_follow_from_friction_and_bearings():
    assert discs.steel_torque(0.15, 141.6, 0.060, 0.02) == pytest.approx(0.02 + 0.15 * 141.6 * 0.03)
    assert discs.bronze_torque(0.15, 141.6, 0.045, 0.02) == pytest.approx(
        0.02 - 0.15 * 141.6 * 0.0225
    )
    assert discs.friction_of_torque(
        discs.steel_torque(0.15, 141.6, 0.060, 0.02), 141.6, 0.060, 0.02
    ) == pytest.approx(0.15)


@pytest.mark.parametrize(("rolling", "least", "most"), [(3e-3, 0.005, 0.03), (46e-3, 0.05, 0.2)])
def test_the_film_is_far_thinner_than_the_roughness(rolling, least, most):
    case = read_case("rig-final", KNOWN)
    parameter = Pair.from_case(case).film(case.require(Lubricant), rolling)
    assert least < parameter < most
