"""How far each input of h* is from where the formula ends, and the error that tells."""

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from asperity.arrays import FloatArray, Real
from asperity.errors import InputError
from asperity.gearset import relations
from asperity.roots import root_between

Film = Callable[..., Real]
"""From a gearset, by the names of `asperity.rating.iso14521.film_parameter`, to h*."""

# What a message calls an input, its unit there, and how many of those are one of the input's own.
_SHOWN = {
    "ratio": ("ratio", "", 1.0),
    "axial_module": ("axial module", " mm", 1.0),
    "centre_distance": ("centre distance", " mm", 1.0),
    "diameter_factor": ("diameter factor", "", 1.0),
    "pressure_angle": ("pressure angle", " deg", math.degrees(1.0)),
}

_WHOLE = 10.0  # per cent, from which on no parts of one are told


class FilmParameterError(InputError):
    r"""The parameter of the lubricant film :math:`h^*` is not above zero.

    Attributes
    ----------
    value : float
        :math:`h^*`.
    driver : str
        The input that has to change least, in parts of itself, to bring it back to zero.
    limits : mapping of str to float or None
        As `film_limits` returns them.
    """

    def __init__(
        self, message: str, value: float, driver: str, limits: Mapping[str, float | None]
    ) -> None:
        super().__init__(message)
        self.value = value
        self.driver = driver
        self.limits = dict(limits)


def film_limits(film: Film, gearset: Mapping[str, Any]) -> dict[str, float | None]:
    """Return the value of each input at which h* is zero, the others as they are.

    The centre distance stays unless it is the one that changes; the profile shift follows.

    Parameters
    ----------
    film : callable
        The formula.
    gearset : mapping of str to float
        What it is given, by name.

    Returns
    -------
    dict of str to float or None
        ``ratio``, ``axial_module`` (mm), ``centre_distance`` (mm), ``diameter_factor``,
        ``pressure_angle`` (rad); None where no value between a fifth of it and five times does.
    """
    return {name: _limit(film, gearset, name) for name in _SHOWN}


def too_thin(film: Film, gearset: Mapping[str, Any], value: float) -> FilmParameterError:
    """Return the error for a gearset whose h* is not above zero."""
    limits = film_limits(film, gearset)
    shares = {n: limit / _now(gearset, n) for n, limit in limits.items() if limit is not None}
    driver = min(shares, key=lambda name: abs(math.log(shares[name])), default="ratio")
    changes = []
    for name, (words, unit, size) in _SHOWN.items():
        limit = limits[name]
        if limit is not None:
            side = "below" if shares[name] < 1.0 else "above"
            percent = 100.0 * (shares[name] - 1.0)
            changed = f"{percent:+.2g}" if abs(percent) < _WHOLE else f"{percent:+.0f}"
            changes.append(f"{words} {side} {limit * size:.5g}{unit} ({changed} %)")
        elif name in ("ratio", "axial_module"):
            changes.append(f"no {words}")
    words, unit, size = _SHOWN[driver]
    return FilmParameterError(
        f"the film parameter h* is {value:.3g}; it must be above 0. The {words} of "
        f"{_now(gearset, driver) * size:.5g}{unit} drives it (with a profile shift of "
        f"{gearset['profile_shift']:.3g}); any one of these, the profile shift following, brings "
        f"it back: {', '.join(changes)}",
        value,
        driver,
        limits,
    )


def _now(gearset: Mapping[str, Any], name: str) -> float:
    if name == "ratio":
        return float(gearset["wheel_teeth"] / gearset["starts"])
    return _centre_distance(gearset) if name == "centre_distance" else float(gearset[name])


def _centre_distance(gearset: Mapping[str, Any]) -> float:
    names = ("axial_module", "diameter_factor", "wheel_teeth", "profile_shift")
    return float(relations.centre_distance(*(gearset[name] for name in names)))


def _limit(film: Film, gearset: Mapping[str, Any], name: str) -> float | None:
    """Return where h* is zero nearest to what an input is, in parts of it."""
    nearest: float | None = None
    for way in (-1.0, 1.0):
        steps = way * np.linspace(0.0, math.log(5.0), 400)
        # An input that the formula does not know leaves a single value; NaN is no side.
        side = np.broadcast_to(np.sign(_scaled(film, gearset, name, np.exp(steps))), steps.shape)
        crossing = np.flatnonzero(np.abs(side[1:] - side[:-1]) > 0.5)
        if not crossing.size or (nearest and abs(nearest) <= abs(steps[crossing[0]])):
            continue
        nearest = root_between(
            lambda step: float(_scaled(film, gearset, name, np.exp(step))),
            steps[crossing[0]],
            steps[crossing[0] + 1],
        )
    return None if nearest is None else _now(gearset, name) * math.exp(nearest)


def _scaled(film: Film, gearset: Mapping[str, Any], name: str, factor: FloatArray) -> FloatArray:
    """h* with one input times a factor; the profile shift makes up for the centre distance."""
    changed, distance = dict(gearset), np.asarray(_centre_distance(gearset))
    if name == "centre_distance":
        distance = distance * factor
    else:
        key = "wheel_teeth" if name == "ratio" else name
        changed[key] = changed[key] * factor
    teeth = changed["diameter_factor"] + changed["wheel_teeth"]
    changed["profile_shift"] = distance / changed["axial_module"] - 0.5 * teeth
    with np.errstate(all="ignore"):
        h = film(**changed)
    return np.where(changed["pressure_angle"] < 0.5 * math.pi, h, np.nan)
