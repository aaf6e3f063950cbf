"""How fast a worm wheel is cut, analysed, meshed and written, against other ways in the same run.

Run it with ``make bench``. Every line gives a time, its share of the target, and a ratio against
another way: on a shared machine only the ratio means something. All runs are on one core, on
gearset 3 with a hob 12 % larger and 2 degrees of tilt. The other ways: the equation of meshing
solved by SciPy for each point; the transmission error by the distances of a grid's points at so
many angles of the worm, to 1e-3 rad of it; and the triangles of the exact bodies. How fast
distances are found is in ``flank_distance.py``.
"""

import math
import tempfile
import time
from pathlib import Path

import numpy as np
from _common import best, finish, on_one_core
from scipy.optimize import least_squares

from asperity.casefile import read_case
from asperity.flanks.export.cad.step import write_step
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.tooth import tooth_body
from asperity.flanks.export.worm import worm_body
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.meshing.analysis import analyse
from asperity.flanks.meshing.pattern import pattern
from asperity.flanks.meshing.transmission import transmission
from asperity.flanks.study.flank import prepare
from asperity.flanks.tables import TABLES as FLANKS
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.distance import distances
from asperity.rating.tables import TABLES as RATING

ROWS, COLUMNS = 20, 24
SOLVED = 40
REPEATS = 5
TARGETS_S = {"flanks": 0.020, "mesh": 0.5, "contact": 1.0, "step": 1.0}


def both_flanks(wheel):
    return [wheel.flank(side).grid(ROWS, COLUMNS) for side in (1, -1)]


def by_scipy(wheel, radius, z, near):
    """A point of the flank s = 1 as the envelope of the hob's positions: d = 0 and its minimum.

    It is given a place nearby to begin with: far from it there are other roots.
    """
    pair = wheel.pair
    hob, i = pair.hob, pair.ratio
    centre = np.array([0.0, radius])

    def gap(angle, phase):
        turned = angle - phase / i
        point = np.array([centre[1] * math.sin(turned), centre[1] * math.cos(turned), z])
        place = pair.cutting.to_helicoid(point)
        place[2] += hob.reduced_lead * phase
        return float(distances(place, hob, 1))

    def equations(unknown):
        angle, phase = unknown
        step = 1e-5
        slope = (gap(angle, phase + step) - gap(angle, phase - step)) / (2.0 * step)
        return [gap(angle, phase), slope]

    start = [near[0] + 1e-3, near[1] + 0.05]
    found = least_squares(equations, start, xtol=1e-12, ftol=1e-12, gtol=1e-12)
    return found.x[0]


def cutting(wheel, report):
    """Both flanks at 20 x 24 points, and some of the points by SciPy."""
    seconds = best(lambda: both_flanks(wheel), REPEATS)
    grid = both_flanks(wheel)[0]
    chosen = np.linspace(0, grid.radius.size - 1, SOLVED).astype(int)
    began = time.thread_time()
    near = np.stack([grid.angle, grid.phase], axis=-1).reshape(-1, 2)
    angles = [by_scipy(wheel, grid.radius.flat[k], grid.z.flat[k], near[k]) for k in chosen]
    slow = (time.thread_time() - began) / SOLVED * 2 * ROWS * COLUMNS
    off = np.abs(np.array(angles) - grid.angle.flat[chosen]) * grid.radius.flat[chosen]
    report["both flanks"] = {
        "seconds": seconds,
        "of_the_target": seconds / TARGETS_S["flanks"],
        "scipy_over_this": slow / seconds,
        "scipy_difference_mm": float(off.max()),
    }


def meshing(wheel, report):
    """One tooth and five, by density, and the triangles of the exact tooth."""
    triangles = best(lambda: tooth_body(wheel).surface(), 3)
    for density in ("coarse", "intermediate", "fine"):
        for teeth in (1, 5):
            seconds = best(lambda d=density, n=teeth: tooth(wheel, d, teeth=n), 3)
            report[f"{density}, {teeth} teeth"] = {
                "seconds": seconds,
                "of_the_target": seconds / TARGETS_S["mesh"],
                "elements": len(tooth(wheel, density, teeth=teeth).cells),
                "triangles_of_one_over_this": triangles / seconds,
            }


def contact(wheel, report):
    """Transmission error and pattern of one flank, and the whole analysis."""
    pair, flank = wheel.pair, wheel.flank(1)
    grid = flank.grid(ROWS, COLUMNS)
    mesh = transmission(pair, flank)
    error = best(lambda: transmission(pair, flank), 3)
    marked = best(lambda: pattern(mesh, grid), 3)
    report["one flank"] = {
        "transmission_error_s": error,
        "pattern_s": marked,
        "of_the_target": (error + marked) / TARGETS_S["contact"],
        "whole_analysis_of_both_s": best(lambda: analyse(pair, wheel), 2),
        "grid_of_one_tooth_over_transmission_error": brute(wheel, grid) / error,
    }


def brute(wheel, grid):
    """Time of looking for the worm's angle at 32 places, by 40 angles around each, on one tooth."""
    pair = wheel.pair
    began = time.thread_time()
    for place in np.linspace(0.0, math.pi / 2.0, 32):
        for phase in place + np.linspace(-0.02, 0.02, 40):
            points = pair.mounting.to_helicoid(grid.points)
            points[..., 2] += pair.worm.reduced_lead * phase
            distances(points, pair.worm, 1).min()
    return time.thread_time() - began


def step(wheel, report):
    """Tooth and worm as STEP files."""
    require_cad()
    with tempfile.TemporaryDirectory() as folder:
        for body in (tooth_body(wheel), worm_body(wheel.pair)):
            seconds = best(lambda b=body: write_step(Path(folder) / "body.step", b), 3)
            triangles = best(body.surface, 3)
            report[f"STEP, {body.name}"] = {
                "seconds": seconds,
                "of_the_target": seconds / TARGETS_S["step"],
                "over_its_triangles": seconds / triangles,
            }


def main():
    """Run all and print one line a figure."""
    on_one_core()
    case = read_case("gearset-3b", {**RATING, **FLANKS})
    wheel = Wheel.cut(prepare(case).wheel.pair)
    both_flanks(wheel)
    report = {}
    cutting(wheel, report)
    meshing(wheel, report)
    contact(wheel, report)
    step(wheel, report)
    finish(report, most={"of_the_target": 1.0})


if __name__ == "__main__":
    main()
