"""The pattern of a pitch: what contacts press where they stand, and on their way between phases."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.resolved.pressures import ToothPressure
from asperity.drive.resolved.strip import FLANK, WORM_TIP
from asperity.drive.static.pattern import Pattern

ROWS, COLUMNS, HALF = 41, 21, 10e-3
Z = np.linspace(-HALF, HALF, COLUMNS)
EVERYWHERE = np.full(COLUMNS, True)


def nearest(share, z):
    row = np.clip(np.rint(np.asarray(share) * (ROWS - 1)), 0, ROWS - 1).astype(int)
    column = np.rint((np.asarray(z) / HALF + 1.0) * 0.5 * (COLUMNS - 1)).astype(int)
    return row * COLUMNS + np.clip(column, 0, COLUMNS - 1)


def pattern():
    # The height of the flank is 1 here, so that a point's share is its first coordinate.
    flank = SimpleNamespace(
        nodes=ROWS * COLUMNS, rows=ROWS, least_reach=2.0 * HALF / (COLUMNS - 1), nearest=nearest,
        share_at=lambda points: points[:, 0],
    )  # fmt: skip
    return Pattern(SimpleNamespace(flank=flank, mesh_error=lambda found: found.off))


def line(number, share, pressure, on=EVERYWHERE, zone=FLANK):
    """A tooth that bears along a line at a share of its height, one patch across."""
    points = np.column_stack([np.full(COLUMNS, share), np.zeros(COLUMNS), Z])
    frame = SimpleNamespace(
        shape=(1, COLUMNS), spacing=(1e-3, Z[1] - Z[0]), axes=np.eye(3)[[0, 2, 1]]
    )
    strip = SimpleNamespace(
        frame=frame, points=points, share=points[:, 0], zone=np.full(COLUMNS, zone)
    )
    pressed = np.where(on, pressure, 0.0)
    return ToothPressure(number, strip, pressed, pressed)


def of(*phases):
    made = pattern()
    for teeth in phases:
        made.add(SimpleNamespace(teeth=teeth, off=0.0))
    return made.largest.reshape(ROWS, COLUMNS)


def test_what_lies_between_two_phases_is_passed_over():
    found = of([line(0, 0.30, 100.0)], [line(0, 0.40, 120.0)])
    for row in range(12, 17):
        # A row has what is pressed half of a row beside it.
        np.testing.assert_allclose(found[row], 100.0 + 5.0 * (row - 12), atol=2.6)
    assert not np.delete(found, range(12, 17), axis=0).any()


def test_from_the_last_phase_a_tooth_goes_on_where_the_next_one_stood_at_the_first():
    found = of([line(0, 0.30, 100.0)], [line(-1, 0.25, 80.0)])
    # A pitch later tooth -1 stands where tooth 0 stood.
    np.testing.assert_allclose(found[11], 90.0, atol=5.1)
    assert of([line(0, 0.30, 100.0)], [line(1, 0.25, 80.0)])[11].max() == 0.0


@pytest.mark.parametrize(
    "after",
    [
        line(0, 0.50, 100.0),  # further than is known
        line(0, 0.40, 100.0, zone=WORM_TIP),  # another place of the tooth
        line(0, 0.40, 100.0, on=np.abs(Z) > 0.5 * HALF),  # in two where there was one
    ],
)
def test_what_is_not_the_same_contact_is_not_led_over(after):
    found = of([line(0, 0.30, 100.0)], [after])
    assert found[13:15].max() == 0.0


def test_an_edge_s_pressure_is_put_on_the_edge_and_not_beside_it():
    made, edge = pattern(), line(0, 1.0, 900.0, zone=WORM_TIP)
    # Patches as long as two columns, that cross the edge: their ends lie a row and more beside it.
    edge.strip.frame.spacing = 1e-3, 0.2
    edge.strip.frame.axes = np.array([[0.0, 1.0, 0.0], [0.5, 0.0, 0.0], [0.0, 0.0, 1.0]])
    every_third = np.arange(COLUMNS) % 3 == 0
    edge = ToothPressure(0, edge.strip, edge.pressure * every_third, edge.force * every_third)
    made.add(SimpleNamespace(teeth=[edge], off=0.0))
    found = made.largest.reshape(ROWS, COLUMNS)
    assert not found[:-1].any()
    # And what lies between two patches of it has it as well.
    np.testing.assert_allclose(found[-1, : COLUMNS - 2], 900.0)
