"""Pictures of flanks show what their dataset holds: shape, units, and what is bare."""

import numpy as np
import pytest
import xarray as xr

from asperity.flanks.study import plots

ROWS, COLUMNS = 12, 15
FACE = np.broadcast_to(np.linspace(-6.0, 6.0, COLUMNS), (ROWS, COLUMNS))
RADIUS = np.linspace(62.0, 67.0, ROWS)[:, None] + 0.05 * FACE**2
PITCH = np.pi / 2.0


def dataset(**values):
    """Both flanks, the other one mirrored: maps by name, and what has a side alone."""

    def sides(array):
        array = np.asarray(array, dtype=float)
        if array.ndim == 0:
            return ("side", np.array([1.0, -1.0]) * array)
        over = np.broadcast_to(array, FACE.shape)
        return (("side", "row", "column"), np.stack([over, over[:, ::-1]]))

    maps = {"face": np.zeros(1), "radius": RADIUS, "compared": np.ones(1)} | values
    found = xr.Dataset({name: sides(each) for name, each in maps.items()}, {"side": [1, -1]})
    found["face"] = (("side", "row", "column"), np.stack([FACE, FACE]))
    return found.assign(pitch=PITCH, marking_thickness=6e-3)


def with_error(error):
    return dataset().assign(
        transmission_error=(("side", "place"), np.stack([1e-3 + error, -error]))
    )


def labels(axes):
    return axes.get_xlabel(), axes.get_ylabel()


def test_the_outline_runs_once_round_the_flank():
    face, radius = plots.outline(FACE, RADIUS)
    assert len(face) == 2 * (ROWS + COLUMNS) - 3
    assert (face[0], radius[0]) == (face[-1], radius[-1])
    area = 0.5 * np.sum(face[:-1] * radius[1:] - face[1:] * radius[:-1])
    assert area == pytest.approx(12.0 * 5.0)


def test_pattern_marks_its_centre_and_only_what_lies_below_the_film():
    gap = 1e-3 * (FACE - 1.0) ** 2
    shown = dataset(gap=gap, pattern_face=1.0)
    figure = plots.pattern(shown.assign(pattern_radius=("side", [65.0, 65.0])))
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
    figure = plots.pattern(dataset(gap=np.full(FACE.shape, 9e-3)))
    assert len(figure.axes) == 2
    assert not figure.axes[0].collections


@pytest.mark.parametrize("size", [0.0, 150.0])
def test_ease_off_covers_its_range_also_where_it_is_even(size):
    figure = plots.ease_off(dataset(ease_off=1e-3 * (size * (FACE / 6.0) ** 2 - 8.0)))
    bar = figure.axes[-1]
    assert "(µm)" in bar.get_xlabel()
    low, high = bar.get_xlim()
    assert low <= -8.0
    assert high >= size - 8.0


def test_ease_off_that_is_rounding_is_said_to_be_zero():
    noise = 1e-14 * np.random.default_rng(1).standard_normal(FACE.shape)
    left, right = plots.ease_off(dataset(ease_off=noise)).axes
    for panel in (left, right):
        (said,) = (text.get_text() for text in panel.texts)
        assert said == "zero within 1e-06 µm:\nan identical hob cut the wheel"
        assert not panel.collections


@pytest.mark.slow
def test_contact_lines_are_drawn_where_the_worm_is_nearest_and_nowhere_else():
    phase = np.broadcast_to((RADIUS - 65.0) * 0.9, FACE.shape)
    figure = plots.contact_lines(dataset(phase=phase, reach=3.0 - FACE))
    assert "90°" in figure.get_suptitle()
    drawn = [path.vertices for lines in figure.axes[0].collections for path in lines.get_paths()]
    assert max(vertices[:, 0].max() for vertices in drawn if len(vertices)) <= 3.0 + 1e-9
    assert any(text.get_text() == "0°" for text in figure.axes[0].texts)


def test_transmission_error_is_drawn_about_its_mean_in_microradians():
    angle = np.linspace(0.0, PITCH, 32, endpoint=False)
    figure = plots.transmission_error(with_error(3e-6 * np.cos(4.0 * angle)))
    (axes,) = figure.axes
    assert "(µrad)" in axes.get_ylabel()
    plus, minus = axes.lines
    assert len(plus.get_xdata()) == 33
    assert np.ptp(plus.get_ydata()) == pytest.approx(6.0)
    assert np.mean(minus.get_ydata()) == pytest.approx(0.0, abs=1e-12)
    assert axes.get_xlim() == pytest.approx((0.0, 90.0))


def test_rounding_is_not_blown_up_to_a_transmission_error():
    (axes,) = plots.transmission_error(with_error(1e-16 * np.sin(np.arange(32.0)))).axes
    assert axes.get_ylim() == (-1.0, 1.0)
    (said,) = (text.get_text() for text in axes.texts)
    assert said.startswith("zero within ")
    assert said.endswith(" µrad: the wheel turns evenly")


@pytest.mark.slow
def test_vibration_has_a_panel_for_each_direction_and_part_on_one_scale():
    directions, parts = (
        ["axial", "torsional", "wheel_axial", "screw"],
        ["along", "across", "normal"],
    )
    shown = dataset().assign_coords(direction=directions, part=parts)
    over = ("side", "row", "column", "direction", "part")
    figure = plots.vibration(shown.assign(vibration=(over, np.full((2, *FACE.shape, 4, 3), 0.4))))
    *panels, bar = figure.axes
    assert len(panels) == 9
    assert [panel.get_title() for panel in panels[:3]] == parts
    assert bar.get_ylim() == pytest.approx((-1.05, 1.05))


def test_in_black_and_white_a_vibrations_part_below_zero_is_hatched():
    directions, parts = list(plots._SHAKEN), ["along", "across"]
    parts_of = {"along": np.abs(FACE) / 6.0, "across": -np.full_like(FACE, 0.5)}
    over = np.stack([np.stack([np.stack([parts_of[p]] * 2) for p in parts])] * len(directions))
    dims = ("direction", "part", "side", "row", "column")
    shown = dataset().assign(vibration=(dims, over))
    shown = shown.assign_coords(direction=directions, part=parts)
    figure = plots.vibration(shown)
    for place, panel in enumerate(figure.axes[: 2 * len(directions)]):
        hatched = [each for each in panel.collections if any(getattr(each, "hatches", ()) or ())]
        covered = any(len(path.vertices) for each in hatched for path in each.get_paths())
        assert covered == (parts[place % 2] == "across")


@pytest.mark.parametrize("name", ["viridis", "cividis"])
def test_in_black_and_white_the_levels_of_a_map_stay_apart(name):
    import matplotlib

    rgb = matplotlib.colormaps[name](np.linspace(0.05, 0.95, 6))[:, :3]
    grey = rgb @ (0.2126, 0.7152, 0.0722)
    assert (np.diff(grey) > 0.03).all()
