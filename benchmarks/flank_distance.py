"""How fast the distance of a point to a worm is found, against other ways in the same run.

Run it with ``make bench``. Every line gives a time and a ratio: on a shared machine only the ratio
means something. All runs are on one core, over points within 0.3 mm of the flanks of gearset 3.
The other ways: the closed form of ZI in NumPy, and a minimisation by SciPy for any flank.
"""

import math
import time

import numpy as np
from _common import best, finish, on_one_core
from scipy.optimize import least_squares

from asperity.flanks.worm.distance import distance, distance_only_each
from asperity.flanks.worm.helicoid import Helicoid
from asperity.flanks.worm.types import TYPES
from asperity.gearset import Geometry
from asperity.kernels.compiled import kernel

POINTS = 20_000
MINIMISED = 200
REPEATS = 7
TARGETS_NS = {"ZI": (35.0, 70.0)}
GENERAL_NS = (350.0, 350.0)


@kernel
def distance_each(points, thread, out):
    """`distance` of every point, into the rows of ``out``."""
    for i in range(points.shape[0]):
        for j, number in enumerate(distance(points[i, 0], points[i, 1], points[i, 2], thread)):
            out[i, j] = number


def cloud(worm):
    """Points in the thread space and a little in the threads, all round the worm."""
    rng = np.random.default_rng(7)
    rho = rng.uniform(worm.root_radius + 0.35, worm.flank_end - 0.25, POINTS)
    theta = rng.uniform(-0.7, 0.7, POINTS)
    off = rng.uniform(-0.02, 0.3, POINTS)
    z = worm.width(rho)[0] - off + worm.reduced_lead * theta
    return np.stack([rho * np.cos(theta), rho * np.sin(theta), z], axis=-1)


def in_numpy(points, worm):
    """The closed form of ZI, as one writes it in arrays."""
    base, p = worm.profile.base_radius, worm.reduced_lead
    rho = np.hypot(points[:, 0], points[:, 1])
    along = np.sqrt(rho**2 - base**2) / base
    r = math.sqrt((worm.pitch_radius / base) ** 2 - 1.0)
    w = worm.half_space + p * (along - np.arctan(along) - r + math.atan(r))
    q = points[:, 2] - p * np.arctan2(points[:, 1], points[:, 0])
    return base / math.hypot(base, p) * (w - q)


def minimised(point, worm):
    """The distance to the flank s = 1 by least squares over its two parameters."""

    def way(place):
        rho, theta = place
        z = worm.width(rho)[0] + worm.reduced_lead * theta
        return point - np.array([rho * math.cos(theta), rho * math.sin(theta), z])

    start = [math.hypot(point[0], point[1]), math.atan2(point[1], point[0])]
    return np.linalg.norm(least_squares(way, start, xtol=1e-12, ftol=1e-12, gtol=1e-12).fun)


def main():
    """Run all and print one line a figure."""
    on_one_core()
    geometry = Geometry.of(starts=4, wheel_teeth=60, axial_module=2.15380, diameter_factor=8.4)
    report = {}
    for kind in TYPES:
        worm = Helicoid.worm(geometry, kind)
        points, thread = cloud(worm), worm.facing(1)
        alone, every = np.empty(POINTS), np.empty((POINTS, 10))
        distance_only_each(points, thread, alone)
        distance_each(points, thread, every)
        bare = best(lambda a=(points, thread, alone): distance_only_each(*a), REPEATS) / POINTS
        whole = best(lambda a=(points, thread, every): distance_each(*a), REPEATS) / POINTS
        began = time.thread_time()
        found = [minimised(point, worm) for point in points[:MINIMISED]]
        slow = (time.thread_time() - began) / MINIMISED
        targets = TARGETS_NS.get(kind, GENERAL_NS)
        report[kind] = {
            "distance_ns": bare * 1e9,
            "of_the_target": bare * 1e9 / targets[0],
            "with_derivatives_ns": whole * 1e9,
            "of_the_target_with_derivatives": whole * 1e9 / targets[1],
            "scipy_over_this": slow / bare,
            "scipy_difference_mm": float(np.abs(found - np.abs(alone[:MINIMISED])).max()),
        }
        if kind == "ZI":
            arrays = best(lambda p=points, w=worm: in_numpy(p, w), REPEATS) / POINTS
            report[kind]["numpy_over_this"] = arrays / bare
            report[kind]["numpy_difference_mm"] = float(
                np.abs(in_numpy(points, worm) - alone).max()
            )
    finish(report, most={"of_the_target": 1.0, "of_the_target_with_derivatives": 1.0})


if __name__ == "__main__":
    main()
