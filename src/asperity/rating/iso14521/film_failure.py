"""How far each input of h* is from where the formula ends, and the error that tells."""

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from asperity.errors import InputError
from asperity.rating.formula import FloatArray


class FilmParameterError(InputError):
    r"""The parameter of the lubricant film :math:`h^*` is not above zero.

    Attributes
    ----------
    value : float
        :math:`h^*`.
    driver : str
        The input that has to change least, in parts of itself, to bring it back to zero.
    limits : mapping of str to float or None
        For each input the value at which :math:`h^*` is zero with the others as they are, in the
        units of `film_parameter`; None where no value between a fifth of it and five times does.
    """

    def __init__(
        self, message: str, value: float, driver: str, limits: Mapping[str, float | None]
    ) -> None:
        super().__init__(message)
        self.value = value
        self.driver = driver
        self.limits = dict(limits)


@dataclasses.dataclass(frozen=True)
class _Limit:
    factor: float
    value: float


_SHOWN = {
    "ratio": ("U", ""),
    "axial_module": ("m_x1", " mm"),
    "centre_distance": ("c", " mm"),
    "diameter_factor": ("q_1", ""),
    "pressure_angle": ("alpha_n", " deg"),
}


def _centre_distance(gearset: Mapping[str, float]) -> float:
    teeth = gearset["diameter_factor"] + gearset["wheel_teeth"] + 2.0 * gearset["profile_shift"]
    return 0.5 * gearset["axial_module"] * teeth


def _value_of(name: str, gearset: Mapping[str, float]) -> float:
    if name == "ratio":
        return gearset["wheel_teeth"] / gearset["starts"]
    return _centre_distance(gearset) if name == "centre_distance" else gearset[name]


def _scaled(
    formula: Callable[..., FloatArray], gearset: Mapping[str, float], name: str, factor: Any
) -> Any:
    """h* with one input times a factor; the profile shift makes up for the centre distance."""
    changed: dict[str, Any] = dict(gearset)
    distance = _centre_distance(gearset)
    if name == "centre_distance":
        distance = distance * factor
    else:
        key = "wheel_teeth" if name == "ratio" else name
        changed[key] = changed[key] * factor
    teeth = changed["diameter_factor"] + changed["wheel_teeth"]
    changed["profile_shift"] = distance / changed["axial_module"] - 0.5 * teeth
    with np.errstate(all="ignore"):
        film = formula(*(np.asarray(value) for value in changed.values()))
    return np.where(changed["pressure_angle"] < 0.5 * np.pi, film, np.nan)


def _limits(
    formula: Callable[..., FloatArray], gearset: Mapping[str, float]
) -> dict[str, _Limit | None]:
    # Here, because loading it takes longer than all else that a command line needs.
    from scipy.optimize import brentq

    steps = np.linspace(0.0, np.log(5.0), 400)
    limits: dict[str, _Limit | None] = {}
    for name in _SHOWN:
        nearest: float | None = None
        for way in (-1.0, 1.0):
            values = _scaled(formula, gearset, name, np.exp(way * steps))
            # An input that the formula does not know leaves a single value; NaN is no side.
            side = np.broadcast_to(np.sign(values), steps.shape)
            crossing = np.flatnonzero(np.abs(side[1:] - side[:-1]) > 0.5)
            if not crossing.size or (nearest and abs(nearest) <= steps[crossing[0]]):
                continue
            low, high = steps[crossing[0]] * way, steps[crossing[0] + 1] * way
            nearest = float(
                brentq(lambda s, n=name: float(_scaled(formula, gearset, n, np.exp(s))), low, high)
            )
        value = _value_of(name, gearset)
        factor = None if nearest is None else float(np.exp(nearest))
        limits[name] = _Limit(factor, value * factor) if factor else None
    return limits


def too_thin(
    formula: Callable[..., FloatArray], gearset: Mapping[str, float], value: float
) -> FilmParameterError:
    """Return the error for a gearset whose h* is not above zero."""
    limits = _limits(formula, gearset)
    reached = [(abs(np.log(limit.factor)), name) for name, limit in limits.items() if limit]
    driver = min(reached)[1] if reached else "ratio"
    changes = []
    for name, limit in limits.items():
        symbol, unit = _SHOWN[name]
        if limit is None:
            if name in ("ratio", "axial_module"):
                changes.append(f"no {symbol}")
            continue
        side = "below" if limit.factor < 1.0 else "above"
        shown = np.degrees(limit.value) if name == "pressure_angle" else limit.value
        changes.append(f"{symbol} {side} {shown:.5g}{unit} ({100.0 * (limit.factor - 1.0):+.2g} %)")
    symbol, unit = _SHOWN[driver]
    given = _value_of(driver, gearset)
    shown = np.degrees(given) if driver == "pressure_angle" else given
    return FilmParameterError(
        f"h* is {value:.3g}; it must be above 0. {symbol} = {shown:.5g}{unit} drives it (with "
        f"x_2 = {gearset['profile_shift']:.3g}); any one of these, x_2 following, brings it back: "
        f"{', '.join(changes)}",
        value,
        driver,
        {name: limit.value if limit else None for name, limit in limits.items()},
    )


def limits_of(
    formula: Callable[..., FloatArray], gearset: Mapping[str, float]
) -> dict[str, float | None]:
    """Return the value of each input at which a formula for h* is zero, the others as they are."""
    limits = _limits(formula, gearset)
    return {name: limit.value if limit else None for name, limit in limits.items()}
