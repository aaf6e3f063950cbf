"""Pictures of sweeps: scales."""

import numpy as np
import pytest
import xarray as xr
from matplotlib.markers import MarkerStyle

from asperity.sweep.axis import POINT, by_factors
from asperity.sweep.plots import plot_along, plot_branches, plot_sweep

FACTORS = (1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0)


@pytest.mark.parametrize(
    ("values", "found"),
    [
        (FACTORS, True),
        (FACTORS[::-1], True),
        ((1.0, 2.0, 5.0, 10.0), True),
        (np.geomspace(0.1, 1.0, 4), True),
        ((*range(1, 10), *range(10, 101, 10)), True),
        (np.linspace(1.0, 1000.0, 12), False),
        ((1.0, 5.5, 10.0), False),
        (np.geomspace(1.0, 9.0, 6), False),  # less than a decade
        ((0.0, 1.0, 10.0, 100.0), False),
        ((-1.0, -10.0, -100.0), False),
        ((1.0, 1000.0), False),  # nobody knows how two are spread
        ((1.0, 1.0, 1000.0), False),
    ],
)
def test_values_go_by_factors_or_by_steps(values, found):
    assert by_factors(np.array(values, dtype=float)) is found


def swept(values, others=(1.0,), name="frequency"):
    """A sweep's dataset of ratios by hand."""
    attributes = {"units": "Hz", "long_name": name}
    return xr.Dataset(
        {"ratio": ((name, "mass"), np.ones((len(values), len(others))))},
        {
            name: (name, np.array(values), attributes),
            "mass": ("mass", np.array(others), {"units": "kg", "long_name": "mass"}),
        },
    )


@pytest.mark.parametrize(("values", "scale"), [(FACTORS, "log"), (range(7), "linear")])
def test_what_goes_by_factors_has_a_scale_of_factors(values, scale):
    (panel, *_) = plot_sweep(swept(values)).axes
    assert panel.get_xscale() == scale


def test_few_factors_are_told_on_the_axis_each_once():
    panel = plot_sweep(swept((1.5, 3.0, 6.0, 12.0, 24.0))).axes[0]
    assert [label.get_text() for label in panel.get_xticklabels()] == ["1.5", "3", "6", "12", "24"]
    assert not panel.get_xticks(minor=True).size


@pytest.mark.parametrize(("count", "others"), [(7, 1), (60, 1), (60, 9)])
def test_no_line_goes_through_what_has_not_settled(count, others):
    found = swept(np.arange(1.0, count + 1.0), np.arange(1.0, others + 1.0))
    loose = np.isin(found["frequency"], (3.0, 5.0))
    found["settled"] = found["ratio"] * np.where(loose, 0.0, 1.0)[:, None]
    lines = plot_sweep(found).axes[0].lines
    solid = [line for line in lines if line.get_linestyle() == "-"]
    hollow = [line for line in lines if line.get_fillstyle() == "none"]
    assert len(solid) == len(hollow) == others
    assert all(np.isnan(line.get_ydata()).tolist() == loose.tolist() for line in solid)
    assert all(line.get_xdata().tolist() == [3.0, 5.0] for line in hollow)
    # The fourth, between them, has its mark also where a line has none.
    assert all(line.get_marker() == "o" and line.get_markevery() in (None, [3]) for line in solid)


@pytest.mark.parametrize(("count", "others"), [(7, 1), (60, 1), (60, 9)])
def test_of_points_without_lines_too_what_has_not_settled_is_hollow(count, others):
    # Of many points a dash is the mark, which is as full as it is hollow.
    found = swept(np.arange(1.0, count + 1.0), np.arange(1.0, others + 1.0), POINT)
    loose = np.isin(found[POINT], (3.0, 5.0))
    found["settled"] = found["ratio"] * np.where(loose, 0.0, 1.0)[:, None]
    lines = plot_sweep(found).axes[0].lines
    hollow = [line for line in lines if line.get_fillstyle() == "none"]
    assert len(hollow) == others
    for line in hollow:
        assert MarkerStyle(line.get_marker()).is_filled()
        assert line.get_xdata().tolist() == [3.0, 5.0]


def test_so_have_the_colours_of_many_lines():
    (_, bar) = plot_sweep(swept(np.arange(1.0, 12.0), np.geomspace(1.0, 1e3, 10))).axes
    assert bar.get_yscale() == "log"
    (_, bar) = plot_sweep(swept(np.arange(1.0, 12.0), np.arange(1.0, 11.0))).axes
    assert bar.get_yscale() == "linear"


def test_but_rows_of_a_table_of_points_have_places():
    (panel, *_) = plot_sweep(swept(FACTORS, name="point")).axes
    assert panel.get_xscale() == "linear"


def test_no_line_of_branches_goes_through_what_has_not_settled():
    places = {"value": ("value", [1.0, 2.0, 3.0]), "way": ["there", "back"]}
    names = ("ratio", "penetration_swing", "open_share", "settled")
    found = xr.Dataset({name: (("value", "way"), np.ones((3, 2))) for name in names}, places)
    found["settled"][1] = 0.0
    found = found.assign_attrs(axis="vibration.frequency", axis_unit="Hz")
    for panel in plot_branches(found).axes:
        drawn = [line for line in panel.lines if line.get_linestyle() == "-"]
        assert [np.isnan(line.get_ydata()).tolist() for line in drawn] == [[False, True, False]] * 2


@pytest.mark.slow
def test_so_have_branches_and_safeties():
    both = np.ones((2, len(FACTORS)))
    names = ("ratio", "penetration_swing", "open_share", "settled")
    ways = xr.Dataset(
        dict.fromkeys(names, (("way", "value"), both)),
        {"way": ["there", "back"], "value": np.array(FACTORS)},
        {"axis": "vibration.frequency", "axis_unit": "Hz"},
    )
    assert {panel.get_xscale() for panel in plot_branches(ways).axes} == {"log"}
    never = ways.assign(open_share=0.0 * ways["open_share"])
    assert plot_branches(never).axes[2].get_ylim() == (0.0, 1.0)
    gears = swept(FACTORS).isel(mass=0).rename(ratio="margin")
    assert {panel.get_xscale() for panel in plot_along(gears).axes} == {"log"}
