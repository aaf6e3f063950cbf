"""What a search for an optimum may change, how far, and what may not fall, as text has it."""

import dataclasses
import math
from collections.abc import Mapping, Sequence

from asperity.errors import InputError, nearest
from asperity.gearset.parameters import Gearset
from asperity.rating.demands import DEMANDS
from asperity.rating.rated import Rated
from asperity.rating.standards import STANDARDS
from asperity.studies.design import ASSUMED, VARIABLES, Bounds
from asperity.units import quantity_of, split_unit

# A safety that nothing moves would else be on its limit wherever the search looks.
_ROOM = 1e-6
_ABOVE = 1e-9

LOCKING = "locking"
"""What is kept of a worm that locks itself: friction over that from which on it does, 1 or more."""

BOUNDED = (*VARIABLES, "profile_shift")


def bounds_of(gearset: Gearset, free: str, given: Sequence[str]) -> Bounds | None:
    """Return the bounds of a search; None where nothing is asked and they are assumed.

    Parameters
    ----------
    gearset : Gearset
        What is searched from.
    free : str
        The variables that may change, separated by commas; empty: all.
    given : sequence of str
        ``variable=low:high unit``.

    Raises
    ------
    InputError
        A variable that is not known, or a span that is none.
    """
    if not free and not given:
        return None
    wanted = [name.strip() for name in free.split(",")] if free else [*VARIABLES]
    for name in wanted:
        if name not in VARIABLES:
            raise InputError(f"--free {free}: {name!r} cannot be free{nearest(name, VARIABLES)}")
    geometry = gearset.geometry
    now = {
        "pressure_angle": gearset.pressure_angle,
        "diameter_factor": geometry.diameter_factor,
        "axial_module": 1e-3 * geometry.axial_module,
        "worm_roughness": gearset.worm_roughness,
    }
    spans = {name: (now[name],) * 2 for name in VARIABLES if name not in wanted}
    spans |= dict(map(_span, given))
    named = {
        "module_change" if name == "axial_module" else name: (
            tuple(value / now[name] - 1.0 for value in span) if name == "axial_module" else span
        )
        for name, span in spans.items()
    }
    return dataclasses.replace(Bounds(), **named)  # type: ignore[arg-type]


def _span(text: str) -> tuple[str, tuple[float, float]]:
    name, equals, written = text.partition("=")
    name = name.strip().removeprefix("gearset.")
    if name not in BOUNDED:
        raise InputError(f"--bounds {text}: {name!r} has no bounds{nearest(name, BOUNDED)}")
    quantity = quantity_of(Gearset, name)
    assert quantity is not None
    low, colon, high = written.partition(":")
    upper = split_unit(high)
    lower = split_unit(low)
    unit = upper[1] if upper else ""
    try:
        if not (equals and colon and lower and upper):
            raise InputError("no span")
        ends = [
            quantity.check(f"{number} {own or unit}".strip(), text_only=True)
            for number, own in (lower, upper)
        ]
    except InputError:
        number, unit = split_unit(quantity.example) or ("1", "")
        raise InputError(
            f"--bounds {text}: it must be {name}=low:high with a unit, as in "
            f"{name}={number}:{1.25 * float(number):g} {unit}".rstrip()
        ) from None
    if ends[0] > ends[1]:
        raise InputError(f"--bounds {text}: give the lower one first")
    return name, (ends[0], ends[1])


def least_safeties(
    rated: Rated, keep: Sequence[str] = (), required: float = 1.0
) -> dict[str, float]:
    """Return the least value of every safety that a design must have, by ``standard.key``.

    A safety that holds goes on to hold, one that does not falls no further, and what is to be kept
    stays as it is.

    Parameters
    ----------
    rated : Rated
        The gearset as it is.
    keep : sequence of str
        Safeties that may not fall at all: a standard, ``standard.key``, a symbol, or ``all``; and
        ``locking``: a worm that locks itself goes on to, at rest and in motion, by each standard.
    required : float
        Times what is asked; above 1 every safety must have that, also where it has not as it is.

    Raises
    ------
    InputError
        Something to keep that is none of these.
    """
    kept = {path for name in keep for path in known_safeties(name)}
    least = {}
    for safety in rated.verdict.safeties:
        asked, value = safety.demand.asked, safety.value * (1.0 - _ROOM)
        if math.isfinite(value) and value > 0.0:
            path = safety.demand.path
            least[path] = value if path in kept else min(value, asked)
            if required > 1.0:
                least[path] = max(least[path], required * asked * (1.0 + _ABOVE))
    if LOCKING in kept:
        for one in rated.self_locking:
            if one.locks:
                ratio = one.friction / one.limit
                least[f"{LOCKING}.{one.standard}.{one.state}"] = min(ratio, 1.0 + _ABOVE)
    return least


def known_safeties(name: str) -> set[str]:
    """Return the safeties that a name stands for, by ``standard.key``; raises InputError."""
    known: Mapping[str, set[str]] = {
        "all": {demand.path for demand in DEMANDS},
        **{standard: {d.path for d in DEMANDS if d.standard == standard} for standard in STANDARDS},
        **{demand.path: {demand.path} for demand in DEMANDS},
        LOCKING: {LOCKING},
        **{d.symbol: {o.path for o in DEMANDS if o.symbol == d.symbol} for d in DEMANDS},
    }
    if name not in known:
        raise InputError(f"--keep {name}: it is not a safety{nearest(name, known)}")
    return known[name]


def notes_of(before: Rated, bounds: Bounds | None, agreed: int, starts: int) -> tuple[str, ...]:
    """Return what to know of assumed bounds, numbers from memory, and starts that disagree."""
    notes = []
    if bounds is None:
        notes.append(f"the bounds are assumed: {ASSUMED.note}")
    rating = before.bs721
    if rating is not None and rating.entry("M_w_Nm").from_memory:
        notes.append("M_w and M_s rest on tables of BS 721 from memory; check them before use")
    if 2 * agreed < starts:
        notes.append(
            f"only {agreed} of {starts} starts came to this design: there may be a better one; "
            "narrower --bounds search more closely"
        )
    return tuple(notes)
