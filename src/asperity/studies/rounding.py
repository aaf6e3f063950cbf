"""A design in numbers that can be made: modules of a series, tenths of a degree.

The numbers near the best design are tried together, and of those that keep every constraint the
best is taken.
"""

import itertools
from collections.abc import Mapping

import numpy as np

from asperity.arrays import FloatArray
from asperity.gearset.sizing import MODULES as ISO_54
from asperity.studies.climb import SAME, Rows, Top, climb
from asperity.studies.design import VARIABLES, Space
from asperity.studies.quantities import varied_quantity
from asperity.studies.series import MODULES as DIN_780
from asperity.studies.with_shafts import Borne

STEPS = {
    "pressure_angle": 0.1,
    "diameter_factor": 0.05,
    "axial_module": 0.01,
    "worm_roughness": 0.1,
}
"""What the numbers of a design are multiples of, in deg, mm and um."""

SERIES = tuple(sorted({*ISO_54, *DIN_780}))
"""Modules, mm, that there are tools for."""

SERIES_IS_WORTH = 0.005
"""Efficiency that is given for a module of the series."""

_NEAR = 3
_KEPT = 1e-12
_SAME = 1e-9


def rounded(
    space: Space, point: FloatArray, least: Mapping[str, float], borne: Borne | None = None
) -> FloatArray | None:
    """Return the point of the best design near another in numbers that can be made.

    Parameters
    ----------
    space : Space
        The designs.
    point : ndarray
        The best of them.
    least : mapping of str to float
        Least torques by key, as in :meth:`Space.merit`.
    borne : Borne, optional
        What shafts and bearings must bear.

    Returns
    -------
    ndarray or None
        None where none of those near keeps all constraints.
    """
    best = {name: float(value) for name, value in space.values(point).items()}
    twice = 2e-3 * space.gearset.geometry.centre_distance
    low, high = space.lower[VARIABLES.index("axial_module")], space.upper[2]
    series = [1e-3 * m for m in SERIES if low <= 1e-3 * m <= high]
    found: list[tuple[float, bool, FloatArray]] = []
    for module in [*series, *_multiples(space, "axial_module", best["axial_module"])]:
        # As much profile shift as the best design has.
        shifted = twice / best["axial_module"] - best["diameter_factor"]
        factor = twice / module - shifted if low < high else best["diameter_factor"]
        choices = (
            _multiples(space, "pressure_angle", best["pressure_angle"]),
            [*_multiples(space, "diameter_factor", factor),
             *_multiples(space, "diameter_factor", best["diameter_factor"])],
            [module],
            _multiples(space, "worm_roughness", best["worm_roughness"]),
        )  # fmt: skip
        designs = np.array(list(itertools.product(*choices)))
        inside = np.all((designs >= space.lower) & (designs <= space.upper), axis=1)
        if not inside.any():
            continue
        points = space.points(designs[inside])
        rows = space.merit(space.worth(points), least)
        kept = np.all(np.isfinite(rows), axis=1) & np.all(rows[:, 1:] >= -_KEPT, axis=1)
        order = np.flatnonzero(kept)[np.argsort(-rows[kept, 0], kind="stable")]
        first = 0 if borne is None else borne.first_of(space.gearset_at, point, points[order])
        if order.size and first is not None:
            place = int(order[first])
            found.append((float(rows[place, 0]), module in series, points[place]))
    if not found:
        return None
    worth = [height + SERIES_IS_WORTH * in_series for height, in_series, _ in found]
    return found[int(np.argmax(worth))][2]


def rounded_near(
    space: Space,
    top: Top,
    merit: Rows,
    least: Mapping[str, float],
    borne: Borne | None = None,
) -> tuple[Top, FloatArray | None]:
    """Return the best design and the one near it that can be made, which is no better.

    Where the climbs missed what numbers near their top have, another begins there.

    Parameters
    ----------
    top : Top
        What the climbs came to.
    merit : callable
        What they climbed.
    space, least, borne
        As in `rounded`.
    """
    while True:
        near = rounded(space, top.point, least, borne)
        if near is None or float(merit(near[None])[0, 0]) <= top.height + SAME:
            return top, near
        higher = climb(merit, [near])
        if higher is None or higher.height <= top.height + SAME:
            return top, near
        top = higher


def _multiples(space: Space, name: str, value: float) -> list[float]:
    """Return the multiples of a variable's step around a value, within its bounds."""
    place = VARIABLES.index(name)
    low, high = float(space.lower[place]), float(space.upper[place])
    if low == high:
        return [low]
    what, step = varied_quantity(name), STEPS[name]
    middle = round(float(what.from_si(value)) / step)
    counts = range(middle - _NEAR, middle + _NEAR + 1)
    found = [float(what.to_si(float(f"{count * step:.12g}"))) for count in counts]
    slack = _SAME * (high - low)
    return [min(max(v, low), high) for v in found if low - slack <= v <= high + slack]
