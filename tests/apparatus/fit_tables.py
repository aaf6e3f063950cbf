"""The sliding body's ratios over its parameters, solved at a few points and interpolated.

A ratio is smooth in the logarithms of the parameters, so that a polynomial through a few Chebyshev
points in each stands for the periodic solution to a small part of a measurement's noise: hundreds
of sets of measurements are fitted in the time of one.
"""

import itertools
import math

import numpy as np
from numpy.polynomial import chebyshev


class Tabulated:
    """Stands in for a `Predictor`, for the conditions that it is made with.

    Parameters
    ----------
    predict : Predictor
        The model.
    conditions : sequence of dict
        Of the measurements.
    box : dict of str to (low, high)
        The parameters, and where they are tabulated; there is no answer elsewhere.
    law : str
        Of friction.
    nodes : int
        In each parameter.
    """

    def __init__(self, predict, conditions, box, law, nodes):
        self.keys, self.order = list(box), nodes - 1
        self.ends = np.log([box[key] for key in self.keys])
        points = chebyshev.chebpts1(nodes)
        axes = [0.5 * (low + high) + 0.5 * (high - low) * points for low, high in self.ends]
        rows = []
        for logarithms in itertools.product(*axes):
            values = map(math.exp, logarithms)
            given = {"friction.law": law, **dict(zip(self.keys, values, strict=True))}
            answers, why = predict(conditions, given)
            assert not why, why
            rows.append(answers)
        table = np.reshape(rows, [nodes] * len(axes) + [len(conditions)])
        inverse = np.linalg.inv(chebyshev.chebvander(points, self.order))
        for axis in range(len(axes)):
            table = np.moveaxis(np.tensordot(inverse, table, axes=(1, axis)), 0, axis)
        self.weights = table

    def __call__(self, conditions, given):
        low, high = self.ends.T
        at = (2.0 * np.log([given[key] for key in self.keys]) - low - high) / (high - low)
        if np.abs(at).max() > 1.0:
            return np.full(self.weights.shape[-1], math.nan), {0: "outside of what is tabulated"}
        found = self.weights
        for one in at:
            found = np.tensordot(chebyshev.chebvander(one, self.order)[0], found, axes=(0, 0))
        return found, {}


class Together:
    """Predictors of parts of the measurements, by law, as one."""

    marched = solves = rigid = 0

    def __init__(self, parts):
        self.parts = parts

    def __call__(self, conditions, given):
        self.solves += len(conditions)
        found = [part(conditions, given) for part in self.parts[given["friction.law"]]]
        why = {key: reason for _, told in found for key, reason in told.items()}
        return np.concatenate([values for values, _ in found]), why
