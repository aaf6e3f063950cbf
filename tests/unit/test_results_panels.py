"""Panels as data: what is declared is what is drawn."""

import numpy as np
import pytest
from matplotlib.colors import to_hex

from asperity.results.figures import BLACK, BLUE, VERMILION
from asperity.results.panels import Panel, band, drawn, level, line, points, shade

X = np.linspace(0.0, 1.0, 5)


def only(*marks, **how):
    (axes,) = drawn([Panel("time (s)", "force (N)", marks, **how)]).axes
    return axes


def test_a_curve_has_the_look_of_its_place_among_several():
    first, second = only(line(0, X, X, "along"), line(1, X, 2.0 * X)).lines
    assert (first.get_color(), second.get_color()) == (BLUE, VERMILION)
    assert second.get_ydata() == pytest.approx(2.0 * X)
    assert first.get_label() == "along"


def test_points_are_open_unless_they_are_filled():
    hollow, full = only(points(0, X, X), points(0, X, X, filled=True)).lines
    assert hollow.get_linestyle() == full.get_linestyle() == "None"
    assert hollow.get_markerfacecolor() == "none"
    assert to_hex(full.get_markerfacecolor()).upper() == BLUE


def test_a_level_runs_from_side_to_side_and_an_upright_one_from_below_to_above():
    across, up = only(level(2.0), level(0.5, upright=True)).lines
    assert set(across.get_ydata()) == {2.0}
    assert set(up.get_xdata()) == {0.5}
    assert across.get_color() == BLACK


def test_a_shade_spans_the_panel_and_a_band_its_curves():
    axes = only(band(X, X, X + 1.0, BLUE), shade(X, X > 0.4, color=BLACK))
    between, shaded = axes.collections
    assert between.get_datalim(axes.transData).y1 == pytest.approx(2.0)
    # In parts of the panel, whatever its limits are.
    assert shaded.get_transform() == axes.get_xaxis_transform()


def test_axes_titles_limits_and_legends_are_those_that_are_declared():
    axes = only(line(0, X, X, "along"), title="Pull", legend={"ncols": 2}, limits={"ylim": (0, 3)})
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time (s)", "force (N)")
    assert axes.get_title(loc="left") == "Pull"
    assert axes.get_xlim() == (0.0, 1.0)
    assert axes.get_ylim() == (0.0, 3.0)
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["along"]


def test_without_a_legend_curves_are_not_named_and_what_is_not_tight_has_room():
    axes = only(line(0, X, X, "along"), tight=False)
    assert axes.get_legend() is None
    assert axes.get_xlim()[0] < 0.0


def test_panels_stand_row_by_row_and_what_is_special_is_drawn_last():
    found = []
    shown = [Panel(title=name, more=lambda axes: found.append(axes.get_title(loc="left")))
             for name in "abcd"]  # fmt: skip
    figure = drawn(shown, columns=2)
    assert found == list("abcd")
    a, b, c, _ = (axes.get_position() for axes in figure.axes)
    assert a.y0 == pytest.approx(b.y0)
    assert c.y0 < a.y0
