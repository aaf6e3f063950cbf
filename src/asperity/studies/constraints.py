"""The constraints of an optimum: what is asked, what it has, and which of them hold it back."""

from collections.abc import Mapping
from typing import Any, NamedTuple

from asperity.arrays import FloatArray
from asperity.rating.rated import Rated
from asperity.studies.design import THREADS, VARIABLES, Space
from asperity.studies.design_compared import SHOWN, free_numbers
from asperity.studies.quantities import varied_quantity
from asperity.studies.search import LOCKING

TORQUES = {"M_w_Nm": "M_w", "M_s_Nm": "M_s"}
"""Torques that BS 721 permits for wear and strength, with their symbols."""

_ACTIVE = 1e-6


class Limit(NamedTuple):
    """A constraint at the optimum.

    Attributes
    ----------
    key, symbol : str
        What is limited; the unit is part of the key.
    relation : {'>=', '<=', '>'}
        Which side is allowed.
    bound, value : float
        The limit, and what the optimum has.
    active : bool
        Whether the optimum lies on it.
    """

    key: str
    symbol: str
    relation: str
    bound: float
    value: float
    active: bool


def number_of(rated: Rated, key: str) -> float:
    """Return a number of ISO/TR 14521 or BS 721 by its key."""
    rating: Any = rated.iso14521 if key in SHOWN["iso14521"] else rated.bs721
    return float(rating[key])


def limits_of(
    space: Space, capacity: Mapping[str, float], after: Rated, design: FloatArray
) -> tuple[Limit, ...]:
    """Return every constraint of an optimum.

    Parameters
    ----------
    space : Space
        The designs.
    capacity : mapping of str to float
        Torques that are kept, by key.
    after : Rated
        The optimum, rated.
    design : ndarray
        Its point.
    """
    limits = []
    for key, symbol in TORQUES.items():
        bound, value = capacity[key], number_of(after, key)
        limits.append(Limit(key, symbol, ">=", bound, value, value - bound < _ACTIVE * bound))
    for safety in after.verdict.safeties:
        demand, value = safety.demand, safety.value
        if demand.path in space.least:
            bound = space.least[demand.path]
            active = value - bound < _ACTIVE * bound
            limits.append(Limit(demand.path, demand.symbol, ">=", bound, value, active))
    for one in after.self_locking:
        path = f"{LOCKING}.{one.standard}.{one.state}"
        if path in space.least:
            bound, value = space.least[path], one.friction / one.limit
            active = value - bound < _ACTIVE * bound
            limits.append(Limit(path, "locking", ">=", bound, value, active))
    if space.least_threads is not None:
        g = after.geometry
        room = float(space.threads_of(g.diameter_factor, g.pressure_angle))
        active = room - space.least_threads < _ACTIVE
        limits.append(Limit(THREADS, "thread room", ">=", space.least_threads, room, active))
    limits += [
        Limit(name, "requirement", ">=", bound, value, value - bound < _ACTIVE)
        for name, bound, value in space.required_of(design)
    ]
    h_star = number_of(after, "h_star")
    limits.append(Limit("h_star", "h*", ">", 0.0, h_star, h_star < _ACTIVE))
    spans = {
        name: (varied_quantity(name).shown(low), varied_quantity(name).shown(high))
        for name, low, high in zip(VARIABLES, space.lower, space.upper, strict=True)
    } | {"profile_shift": space.profile_shift}
    values = free_numbers(after)
    for name, (low, high) in spans.items():
        what, value = varied_quantity(name), values[name]
        # Bounds that lie decades away hold nothing back; a shift of zero has a size, too.
        near = _ACTIVE * min(high - low, max(10.0 * abs(value), 1.0))
        for relation, bound, gap in ((">=", low, value - low), ("<=", high, high - value)):
            limits.append(Limit(what.key, what.symbol, relation, bound, value, gap <= near))
    return tuple(limits)
