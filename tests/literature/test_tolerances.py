"""Backlash, grades and standard tolerances against numbers found by another way.

Sources: an actuator of 1/50 at 100 mm, whose backlash was found by a separate calculation from the
same formulas; ISO 286-1, where IT7 of 80 to 120 mm is 35 um; Anuryev,
Designer's handbook, vol. 2, table 140 (GOST 3675-81); ISO 1328-1:2013 for 160.6 mm and a normal
module of 3.14 mm at grade 8.
"""

import math

import pytest
from apparatus.duties import A100

from asperity.gearset.keys import key_of
from asperity.gearset.tolerancing.allowances import FITS, Allowances, fit_backlash
from asperity.gearset.tolerancing.backlash import backlash
from asperity.gearset.tolerancing.grades import graded
from asperity.gearset.tolerancing.iso286 import standard_tolerance
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.warmth import EXPANSION

GIVEN = {
    "centre_distance": "js7", "thread": ["-40 um", "-70 um"], "tooth": ["-50 um", "-100 um"],
}  # fmt: skip
NEW = {
    "circumferential_min_um": 77.35, "circumferential_max_um": 183.00,
    "circumferential_likely_min_um": 98.32, "circumferential_likely_max_um": 162.03,
    "normal_min_um": 72.45, "normal_max_um": 171.42, "wheel_min_arcmin": 3.31,
    "wheel_max_arcmin": 7.83, "worm_min_deg": 2.81, "worm_max_deg": 6.66,
}  # fmt: skip


@pytest.mark.parametrize("key", NEW)
def test_backlash_of_the_actuator(key):
    assert round(backlash(A100, Tolerances(**GIVEN)).to_json()["new"][key], 2) == NEW[key]


def test_wear_of_the_actuator_adds_to_its_backlash():
    found = backlash(A100, Tolerances(**GIVEN), wear=30.2).to_json()
    more = found["worn"]["circumferential_min_um"] - found["new"]["circumferential_min_um"]
    assert round(more, 1) == 32.2
    assert found["worn"]["normal_max_um"] - found["new"]["normal_max_um"] == pytest.approx(30.2)


def test_axial_pressure_angle_of_the_actuator():
    assert round(math.degrees(A100.geometry.axial_pressure_angle), 4) == 20.0588


def test_fits_are_standard_tolerances_of_the_centre_distance():
    assert [1e3 * fit_backlash(100.0, fit) for fit in FITS] == pytest.approx(
        [0, 35, 54, 87, 140, 220]
    )


def test_a_fit_leaves_its_least_backlash_in_the_worst_case():
    for fit in "EDCBA":
        found = backlash(A100, Tolerances(centre_distance="js8", fit=fit, tooth=["-5 um", "-9 um"]))
        assert found.to_json()["new"]["normal_min_um"] == pytest.approx(
            1e3 * fit_backlash(100.0, fit)
        )


def test_standard_tolerances():
    # The geometric mean of a range and its tolerance unit, from which the table is rounded.
    for low, high in ((6, 10), (50, 80), (80, 120), (400, 500)):
        mean = math.sqrt(low * high)
        unit = 0.45 * mean ** (1 / 3) + 0.001 * mean
        for grade, units in ((6, 10), (7, 16), (8, 25), (9, 40), (10, 64), (11, 100)):
            assert 1e3 * standard_tolerance(high, grade) == pytest.approx(units * unit, rel=0.06)
    assert standard_tolerance(100.0, 7) == 0.035


@pytest.mark.parametrize("grade", range(5, 13))
def test_a_range_of_sizes_ends_where_the_next_begins(grade):
    sizes = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
    just = [standard_tolerance(size, grade) for size in sizes]
    above = [standard_tolerance(size + 1e-6, grade) for size in sizes[:-1]]
    assert above == just[1:]
    # From grade 6 up they are ten times as large five grades on, but for one that is rounded.
    if grade in (6, 7):
        tenfold = [10.0 * one for one in just]
        tenfold[1] -= 0.005 if grade == 6 else 0.0
        assert [standard_tolerance(s, grade + 5) for s in sizes] == pytest.approx(tenfold)


def test_both_depths_of_a_key_are_its_height_and_a_clearance():
    # DIN 6885-1: up to a diameter of the shaft, width and height, mm.
    keys = (
        (8, 2, 2), (10, 3, 3), (12, 4, 4), (17, 5, 5), (22, 6, 6), (30, 8, 7), (38, 10, 8),
        (44, 12, 8), (50, 14, 9), (58, 16, 10), (65, 18, 11), (75, 20, 12), (85, 22, 14),
        (95, 25, 14), (110, 28, 16), (130, 32, 18),
    )  # fmt: skip
    before = 6.0
    for most, width, height in keys:
        clearance = 0.2 if height < 4 else 0.3 if height < 11 else 0.4
        for diameter in (before + 1e-6, float(most)):
            key = key_of(diameter, "bore")
            assert key.width == width
            assert key.in_shaft + key.in_hub == pytest.approx(height + clearance)
            assert 0.5 * height <= key.in_shaft <= 0.65 * height
        before = float(most)


def test_grade_8_of_the_actuator():
    found = {one.symbol: one.value for one in graded(A100.geometry, 8)}
    assert [found[s] for s in ("f_h", "f_hk", "f_px", "f_f1")] == [28, 53, 19, 28]
    assert [round(found[s], 2) for s in ("f_p2", "F_p2")] == [18.15, 60.78]


def test_equal_warmth_of_one_material_scales_the_backlash_away():
    # What expands alike everywhere leaves the centre distance where the gears want it.
    alike = {"housing": "80 degC", "gears": "80 degC"}
    iron = A100.model_copy(update={"wheel_material": "EN-GJS-400-15"})
    found = backlash(iron, Tolerances(**GIVEN, temperatures=alike, housing="steel"))
    g = iron.geometry
    less = EXPANSION["steel"] - EXPANSION["cast iron"]
    expected = 60.0 * less * g.wheel_mean_diameter * math.tan(g.axial_pressure_angle) * 1e3
    assert found.warmth == pytest.approx(expected)


def test_a_hot_housing_opens_and_hot_gears_close_the_backlash():
    for hot, sign in (("housing", 1), ("gears", -1)):
        found = backlash(A100, Tolerances(**GIVEN, temperatures={hot: "80 degC"}))
        assert sign * found.warmth > 0
        assert found.states["warm"].least == pytest.approx(found.states["new"].least + found.warmth)


def test_without_allowances_thicknesses_have_the_tolerances_of_series_25():
    found = Allowances.of(A100.geometry, Tolerances())
    assert found.thread == (0.0, pytest.approx(-0.03))
    assert found.tooth[1] == pytest.approx(-0.05 / math.cos(A100.geometry.lead_angle))
    assert found.centre_distance == 0.0
