"""Natural modes of an elastic body, as it keeps them."""

import numpy as np
import pytest

from asperity.contact.elastic import ElasticMaterial, elastic_body, modes
from asperity.contact.elastic.modes import natural_modes
from asperity.mesh import box


def test_a_mode_is_of_unit_mass_and_points_where_it_moves_most():
    # Its sign would be the solver's else, and another on another machine.
    mesh = box((10e-3, 7e-3, 4e-3), (5, 4, 3), 1)
    body = elastic_body(mesh, ElasticMaterial(210e9, 0.3, 7850.0), element="hex8i", tied="top")
    shapes, frequencies = natural_modes(body, 8)
    assert np.all(np.diff(frequencies) > 0.0)
    strongest = np.abs(shapes).argmax(axis=0)
    assert np.all(shapes[strongest, np.arange(8)] > 0.0)
    mass = np.column_stack([shapes.T @ body.mass_times(shape) for shape in shapes.T])
    assert np.abs(mass - np.eye(8)).max() <= 1e-9


@pytest.mark.parametrize("count", [1, 2, 3, 4, 6, 7])
def test_of_modes_of_equal_frequency_the_same_are_taken_whatever_a_solver_gives(monkeypatch, count):
    # A square tower bends in pairs; where the last of a pair is left out, the other is one of many.
    mesh = box((4e-3, 4e-3, 9e-3), (2, 2, 4), 1)
    body = elastic_body(mesh, ElasticMaterial(210e9, 0.3, 7850.0), element="hex8i")
    solved = modes._all_modes
    first = modes.natural_modes(body, count)

    def turned(body):
        squared, shapes = solved(body)
        for begin in np.flatnonzero(np.diff(squared) < 1e-9 * squared[1:]):
            pair = shapes[:, begin : begin + 2].copy()
            angle = 0.7 + begin
            turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
            shapes[:, begin : begin + 2] = pair @ turn
        return squared, shapes

    monkeypatch.setattr(modes, "_all_modes", turned)
    again = modes.natural_modes(body, count)
    assert again[1] == pytest.approx(first[1], rel=1e-12)
    size = np.abs(first[0]).max()
    assert np.abs(again[0]) == pytest.approx(np.abs(first[0]), abs=1e-7 * size)
