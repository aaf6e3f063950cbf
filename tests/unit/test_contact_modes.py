"""Natural modes of an elastic body, as it keeps them."""

import numpy as np

from asperity.contact.elastic import ElasticMaterial, elastic_body
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
