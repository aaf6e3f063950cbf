"""Lives and static safeties of the bearings of a shaft, over its loads."""

import functools
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from asperity.errors import InputError
from asperity.formulas.traced import number, total
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import ShaftBearing
from asperity.shafts.rolling import life
from asperity.shafts.rolling.equivalent import dynamic_load, outside_table, static_load

_LEAST = 1e-6  # of C, of a bearing that carries next to nothing


class Carried(NamedTuple):
    """What a bearing carries under one load.

    Attributes
    ----------
    radial, axial : float
        N.
    hours : float
        Of the life, h.
    speed : float
        rpm.
    viscosity : float
        Of the oil, mm2/s.
    lasts : bool
        Whether it counts for the life, and not for static safety alone.
    """

    radial: float
    axial: float
    hours: float
    speed: float
    viscosity: float
    lasts: bool = True


class Life(NamedTuple):
    """What a bearing comes to under the loads of a life.

    Attributes
    ----------
    radial, axial : float
        Of the load of the life with the greatest equivalent load, N.
    equivalent : float
        P of that, N; of several loads the mean P_m.
    rating_life : float
        L_10h, h.
    modified : float or None
        L_nmh with oil, dirt and reliability, h; None where nothing is said of the oil's cleanness.
    kappa, a_iso : float or None
        Viscosity ratio and life modification factor, each the least of all loads.
    static_safety : float
        s_0, the least of all loads, of the rated torque too.
    damage : tuple of float
        Share of each load of the life in what uses the bearing up.
    outside : bool
        Whether the axial load is more than the table of a deep groove bearing reaches.
    """

    radial: float
    axial: float
    equivalent: float
    rating_life: float
    modified: float | None
    kappa: float | None
    a_iso: float | None
    static_safety: float
    damage: tuple[float, ...]
    outside: bool

    @property
    def judged_hours(self) -> float:
        """The life that is judged, h."""
        return self.rating_life if self.modified is None else self.modified


def life_of(
    bearing: ShaftBearing, loads: Sequence[Carried], options: BearingOptions, peak: float = 1.0
) -> Life:
    """Return what a bearing comes to under loads.

    Raises
    ------
    InputError
        No bearing is named there.
    """
    rolling = bearing.bearing
    if rolling is None:
        raise InputError("bearing.bearing is missing; name one of a data file")
    c, c0 = rolling.ratings(pair=bearing.pair)
    p, lives, modified, kappas, factors, statics = rolling.exponent, [], [], [], [], []
    equivalents = []
    for each in loads:
        of = rolling.factors(each.axial, opposed=bearing.opposed)
        rest = static_load(of, peak * each.radial, peak * each.axial)
        statics.append(number(life.static_safety(c0, np.maximum(rest, _LEAST * c0))))
        if not each.lasts:
            continue
        load = number(np.maximum(dynamic_load(of, each.radial, each.axial), _LEAST * c))
        equivalents.append(load)
        lives.append(number(life.rating_life_hours(c, load, p, each.speed)))
        if options.e_c is not None:
            reference = life.reference_viscosity(each.speed, rolling.pitch_diameter)
            kappa = number(life.viscosity_ratio(each.viscosity, reference))
            limit = rolling.endless_below * (2.0 if bearing.pair else 1.0)
            factor = number(
                life.life_modification(kappa, options.e_c, limit, load, rolling.elements)
            )
            kappas.append(kappa)
            factors.append(factor)
            modified.append(number(life.modified_life(options.a_1, factor, lives[-1])))
    loads = [each for each in loads if each.lasts]
    hours = [each.hours for each in loads]
    whole = life.spectrum_life(hours, lives)
    reached = options.a_1 * whole if not modified else life.spectrum_life(hours, modified)
    turns = [each.hours * each.speed for each in loads]
    borne = total(t * load**p for t, load in zip(turns, equivalents, strict=True))
    mean = (borne / total(turns)) ** (1.0 / p)
    counted = modified or lives
    used = [h / own for h, own in zip(hours, counted, strict=True)]
    worst = max(range(len(loads)), key=equivalents.__getitem__)
    asked = bool(modified) or options.reliability != 90
    return Life(
        loads[worst].radial,
        loads[worst].axial,
        equivalents[0] if len(loads) == 1 else mean,
        whole,
        reached if asked else None,
        _least(kappas),
        _least(factors),
        _least(statics),
        tuple(each / sum(used) for each in used),
        rolling.kind == "deep groove"
        and any(outside_table(rolling.f0 or 1.0, w.axial, rolling.static_rating) for w in loads),
    )


def _least(values: Sequence[Any]) -> Any:
    return number(functools.reduce(np.minimum, values)) if values else None
