"""Pictures of the documentation, of vibration out of the plane: what is drawn is what was given."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

FILE = Path(__file__).parents[2] / "docs" / "make_pictures.py"
SPEC = importlib.util.spec_from_file_location("make_pictures", FILE)
pictures = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(pictures)


def labels(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


@pytest.mark.slow
def test_all_swings_fall_on_one_curve():
    velocity = np.linspace(0.0, 1.0, 11)
    reduction = (1.0 - velocity) ** 2
    curves = {a: 1.0 - a * reduction for a in (0.1, 0.9)}
    points = {a: (velocity, ratio) for a, ratio in curves.items()}
    figure = pictures.plot_master_curve(velocity, curves, reduction, reduction, points)
    left, right = figure.axes
    assert labels(left) == ["a = 0.1", "a = 0.9"]
    assert labels(right) == ["h(V)", "Popov", "a = 0.1", "a = 0.9"]
    for line in right.lines:
        assert line.get_ydata() == pytest.approx(reduction, abs=1e-12)
    figure.draw_without_rendering()


def test_more_swings_than_there_are_dashes_are_drawn():
    velocity = np.linspace(0.0, 1.0, 3)
    curves = {0.1 * count: 1.0 - 0.1 * count * velocity for count in range(1, 10)}
    figure = pictures.plot_master_curve(velocity, curves, velocity, velocity, {})
    assert len(figure.axes[0].lines) == 9


@pytest.mark.slow
def test_a_thrust_has_a_colour_of_its_own():
    elevation, azimuth = np.radians([0.0, 45.0, 90.0]), np.radians([0.0, 90.0, 180.0])
    braking = 0.5 * np.ones((3, 3)) + 0.1 * azimuth
    for ratio, lowest in ((braking, 0.0), (braking - 0.6, -np.abs(braking - 0.6).max())):
        figure = pictures.plot_directions(elevation, azimuth, ratio)
        field = figure.axes[0].collections[0]
        assert field.get_clim()[0] == pytest.approx(lowest)
        figure.draw_without_rendering()


@pytest.mark.slow
def test_flight_is_shaded_where_the_normal_force_is_zero():
    time = np.linspace(0.0, 0.5e-3, 501)
    load = np.maximum(55.0 * (1.0 + 1.5 * np.cos(4e3 * 2.0 * np.pi * time)), 0.0)
    for normal, flights in ((load, 2), (load + 1.0, 0)):
        figure = pictures.plot_two_cycles(time, normal, 0.05 * normal, 0.1, 55.0)
        upper, lower = figure.axes
        paths = sum(len(shade.get_paths()) for shade in upper.collections)
        assert paths == flights
        assert ("in flight" in labels(upper)) == bool(flights)
        assert "µs" in lower.get_xlabel()
        figure.draw_without_rendering()
