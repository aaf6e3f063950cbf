"""Steady sliding under LuGre's law on paper: its force, and the profile of a fit's chi-square.

:math:`F = \\mu F_N + (F_S - \\mu F_N)\\exp[-(v/v_s)^2] + h_v v`, and scipy for the least squares.
"""

import math

import numpy as np
from scipy.optimize import least_squares

MU, STATIC, SPEED, DAMPING = (
    "friction.mu", "friction.static_mu", "friction.stribeck_velocity", "friction.viscous_damping",
)  # fmt: skip
KEYS = MU, STATIC, SPEED, DAMPING
_SHARES = 0.1, 1.0, 10.0
NARROW = 2.0 * math.log(1000.0)

# A body that slides slowly, and one whose four parameters are fitted to forces at some speeds.
SLOW = """[slider]
drive_velocity = "0.01 mm/s"
normal_force = "1 N"
[friction]
model = "lugre"
mu = 1.0022
static_mu = 1.51
tangential_stiffness = "1e5 N/m"
stribeck_velocity = "1.0249 mm/s"
viscous_damping = "0.38046 N s/m"
[solve]
method = "periodic"
"""
STRIBECK = """[slider]
drive_velocity = "1 mm/s"
normal_force = "1 N"
[friction]
model = "lugre"
mu = 0.9
static_mu = 1.3
tangential_stiffness = "1e5 N/m"
stribeck_velocity = "2 mm/s"
viscous_damping = "0.2 N s/m"
"""
START = 0.9, 1.3, 2e-3, 0.2
DEVIATION = 0.02
SPEEDS = np.array([0.01, 0.3, 0.7, 1.0, 1.5, 3.0, 10.0, 100.0])  # mm/s
FORCES = np.array([1.49, 1.45, 1.31, 1.19, 1.06, 1.00, 1.01, 1.04])  # N


def forces(speeds, mu, static_mu, speed, damping, load=1.0):
    """Forces at the sliding velocities, N."""
    fall = np.exp(-((speeds / speed) ** 2))
    return load * (mu + (static_mu - mu) * fall) + damping * speeds


class Exact:
    """Measured forces with the closed form: what chi-square is, and its profile."""

    def __init__(self, speeds, measured, deviations, start):
        self.speeds, self.measured = np.asarray(speeds), np.asarray(measured)
        self.deviations = np.asarray(deviations)
        self.best = least_squares(self.residuals, np.log(start), xtol=1e-14, ftol=1e-14).x

    def residuals(self, point):
        return (self.measured - forces(self.speeds, *np.exp(point))) / self.deviations

    @property
    def chi2(self):
        """The least there is."""
        return float(np.sum(self.residuals(self.best) ** 2))

    def profile(self, place, value, *near):
        """Return how far chi-square rises with one parameter held at a value."""
        others = [n for n in range(len(KEYS)) if n != place]

        def left(moved):
            point = np.empty(len(KEYS))
            point[place], point[others] = math.log(value), moved
            return self.residuals(point)

        # A logarithm that has run to where it says nothing finds no way back: damping from where a
        # tenth, all, and ten times of the friction would be viscous.
        damping = [math.log(one * math.exp(self.best[0]) / self.speeds.max()) for one in _SHARES]
        starts = [self.best, *(np.array([*self.best[:3], one]) for one in damping), *near]
        found = [
            least_squares(left, one[others], bounds=(-40.0, 20.0), xtol=1e-12, ftol=1e-12)
            for one in starts
        ]
        return 2.0 * min(one.cost for one in found) - self.chi2


class Paper:
    """Stands in for a `Predictor` of forces: the closed form."""

    marched = solves = rigid = 0

    def __call__(self, conditions, given):
        self.solves += len(conditions)
        if given[STATIC] < given[MU]:
            return np.full(len(conditions), math.nan), {0: "static friction below kinetic"}
        speeds = np.array([one["slider.drive_velocity"] for one in conditions])
        return forces(speeds, *(given[key] for key in KEYS)), {}
