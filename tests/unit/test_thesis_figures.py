import numpy as np
import pytest

from asperity.thesis.contents import FIGURES
from asperity.thesis.sliding.figures import figure_2_7, figure_2_14, figure_2_15


def test_every_figure_asked_for_is_there():
    assert list(FIGURES) == [
        "2.7", "2.9", "2.10", "2.11", "2.13", "2.14", "2.15", "3.1", "3.2", "3.3", "3.4", "3.5",
        "4.3", "4.4", "4.17", "4.18", "4.19", "4.20", "4.21", "4.22", "4.23", "5.2", "5.5", "5.6",
        "5.7", "5.8", "5.9", "5.10", "5.11", "7.1", "7.2", "7.3", "7.4", "7.8", "7.9", "7.11",
    ]  # fmt: skip


def test_dahl_from_rest_is_drawn_for_five_exponents():
    drawn = figure_2_7()
    (axes,) = drawn.figure.axes
    assert len(axes.get_legend().get_texts()) == 5
    assert float(drawn.dataset["force"].max()) == pytest.approx(5.5)


def test_rigid_friction_is_reversed_for_a_third_of_the_cycle_at_k_2():
    friction = figure_2_14().dataset["friction_rigid_drive"].sel(axis="x").values
    assert np.median(np.abs(friction)) == pytest.approx(5.08)
    assert np.mean(np.abs(friction) < 5.079) < 1e-3
    assert np.mean(friction < 0.0) == pytest.approx(1.0 / 3.0, abs=1e-3)


def test_dahl_friction_falls_and_keeps_its_sign_just_above_k_1():
    dataset = figure_2_15().dataset
    for drive in ("compliant", "rigid"):
        least = float(dataset[f"friction_{drive}_drive"].sel(axis="x").min())
        assert 0.0 < least < 0.8 * float(dataset["full_force"])
