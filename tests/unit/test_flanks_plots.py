"""Pictures of flanks show what they are given: shape, units, and what is bare."""

import numpy as np
import pytest

from asperity.flanks.plots import (
    FlankMap,
    plot_contact_lines,
    plot_ease_off,
    plot_pattern,
    plot_transmission_error,
    plot_vibration,
)

ROWS, COLUMNS = 12, 15
FACE = np.broadcast_to(np.linspace(-6.0, 6.0, COLUMNS), (ROWS, COLUMNS))
RADIUS = np.linspace(62.0, 67.0, ROWS)[:, None] + 0.05 * FACE**2
PITCH = np.pi / 2.0


def over_the_flank(values, side=1):
    return FlankMap(side, FACE, RADIUS, np.broadcast_to(values, FACE.shape).astype(float))


def both(values):
    return [over_the_flank(values), over_the_flank(np.asarray(values)[:, ::-1], side=-1)]


def labels(axes):
    return axes.get_xlabel(), axes.get_ylabel()


def test_the_outline_runs_once_round_the_flank():
    face, radius = over_the_flank(0.0).outline
    assert len(face) == 2 * (ROWS + COLUMNS) - 3
    assert (face[0], radius[0]) == (face[-1], radius[-1])
    area = 0.5 * np.sum(face[:-1] * radius[1:] - face[1:] * radius[:-1])
    assert area == pytest.approx(12.0 * 5.0)


def test_pattern_marks_its_centre_and_only_what_lies_below_the_film():
    figure = plot_pattern(both((FACE - 1.0) ** 2), 6.0, [(1.0, 65.0), (-1.0, 65.0)])
    left, right, bar = figure.axes
    assert "6" in bar.get_xlabel()
    assert "µm" in bar.get_xlabel()
    assert all("(mm)" in label for label in labels(left))
    assert [left.get_title("left"), right.get_title("left")] == ["flank s = +1", "flank s = -1"]
    centres = [line for line in left.lines if line.get_marker() == "+"]
    assert all((line.get_xdata()[0], line.get_ydata()[0]) == (1.0, 65.0) for line in centres)
    filled = left.collections[0]
    reach = np.concatenate([path.vertices[:, 0] for path in filled.get_paths() if len(path)])
    step = 12.0 / (COLUMNS - 1)
    assert reach.min() == pytest.approx(1.0 - np.sqrt(6.0), abs=step)
    assert reach.max() == pytest.approx(1.0 + np.sqrt(6.0), abs=step)


def test_a_flank_that_bears_nowhere_is_bare():
    figure = plot_pattern(both(np.full(FACE.shape, 9.0)), 6.0, [(0.0, 65.0), (0.0, 65.0)])
    assert len(figure.axes) == 2
    assert not figure.axes[0].collections


@pytest.mark.parametrize("size", [0.0, 150.0])
def test_ease_off_covers_its_range_also_where_there_is_none(size):
    figure = plot_ease_off(both(size * (FACE / 6.0) ** 2 - 8.0))
    bar = figure.axes[-1]
    assert "(µm)" in bar.get_xlabel()
    low, high = bar.get_xlim()
    assert low <= -8.0
    assert high >= size - 8.0


def test_contact_lines_are_drawn_where_the_worm_is_nearest_and_nowhere_else():
    phase = np.broadcast_to((RADIUS - 65.0) * 0.9, FACE.shape).copy()
    phase[FACE > 3.0] = np.nan
    figure = plot_contact_lines(both(phase), PITCH)
    assert "90°" in figure.get_suptitle()
    drawn = [path.vertices for lines in figure.axes[0].collections for path in lines.get_paths()]
    assert max(vertices[:, 0].max() for vertices in drawn if len(vertices)) <= 3.0 + 1e-9
    assert any(text.get_text() == "0°" for text in figure.axes[0].texts)


def test_transmission_error_is_drawn_about_its_mean_in_microradians():
    angle = np.linspace(0.0, PITCH, 33)
    error = 3e-6 * np.cos(4.0 * angle)
    figure = plot_transmission_error(angle, {1: 1e-3 + error, -1: -error}, PITCH)
    (axes,) = figure.axes
    assert "(µrad)" in axes.get_ylabel()
    plus, minus = axes.lines
    assert np.ptp(plus.get_ydata()) == pytest.approx(6.0)
    assert np.mean(minus.get_ydata()) == pytest.approx(0.0, abs=1e-12)
    assert axes.get_xlim() == pytest.approx((0.0, 90.0))


def test_rounding_is_not_blown_up_to_a_transmission_error():
    angle = np.linspace(0.0, PITCH, 33)
    figure = plot_transmission_error(angle, {1: 1e-16 * np.sin(angle)}, PITCH)
    assert figure.axes[0].get_ylim() == (-1.0, 1.0)


def test_vibration_has_a_panel_for_each_direction_and_part_on_one_scale():
    maps = {
        direction: {part: over_the_flank(value) for part, value in parts.items()}
        for direction, parts in {
            "axial": {"along": 0.4, "across": 0.4, "normal": -0.8},
            "torsional": {"along": 0.9, "across": 0.0, "normal": 0.4},
        }.items()
    }
    names = {"axial": "worm, along", "torsional": "worm, about"}
    figure = plot_vibration(maps, names)
    *panels, bar = figure.axes
    assert len(panels) == 6
    assert [panel.get_title() for panel in panels[:3]] == ["along", "across", "normal"]
    assert bar.get_ylim() == pytest.approx((-1.05, 1.05))
