"""Whether the wheel can drive the worm, by the friction of each standard and by the user's own.

By ISO/TR 14521 and BS 721 a worm locks itself where its lead angle is not above the friction
angle, atan(mu); AGMA 6034 projects the friction with the pressure angle, so that it does where the
lead angle is not above atan(mu/cos(alpha_n)). In each case it is where the standard's own
efficiency with the wheel driving is not above zero.

Statically the friction at rest counts, dynamically that at the sliding velocity. The factor on the
friction multiplies both: a vibration that lowers the friction by it sets a worm free that locked
itself.
"""

import dataclasses
import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from asperity.rating import agma6034, bs721
from asperity.rating.formula import Argument, Invalid, angle, evaluate
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521 import efficiency
from asperity.rating.iso14521 import friction as iso_friction
from asperity.rating.result import Rating

State = Literal["static", "dynamic"]


@dataclasses.dataclass(frozen=True)
class Verdict:
    """Whether a worm locks itself with one friction value.

    Attributes
    ----------
    standard : str
        Whose friction it is: ``"iso14521"``, ``"bs721"``, ``"agma6034"`` or ``"given"``.
    state : {'static', 'dynamic'}
        At rest, or at the sliding velocity.
    friction : float
        Coefficient of friction with the factor on it.
    limit : float
        Coefficient from which on the worm locks itself.
    efficiency : float
        With the wheel driving; zero or below where the worm locks itself.
    """

    standard: str
    state: State
    friction: float
    limit: float
    efficiency: float

    @property
    def locks(self) -> bool:
        """Whether the worm locks itself."""
        return self.efficiency <= 0.0

    @property
    def factor_to_limit(self) -> float | None:
        """What the friction must be multiplied by to reach the limit; None without friction."""
        return self.limit / self.friction if self.friction > 0.0 else None


@dataclasses.dataclass(frozen=True)
class SelfLocking:
    """Whether a worm locks itself.

    Attributes
    ----------
    lead_angle : float
        rad.
    friction_factor : float
        That multiplies every friction value.
    verdicts : tuple of Verdict
        By each friction value.
    """

    lead_angle: float
    friction_factor: float
    verdicts: tuple[Verdict, ...]

    def __iter__(self) -> Iterator[Verdict]:
        return iter(self.verdicts)

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        return {
            "lead_angle_deg": math.degrees(self.lead_angle),
            "friction_factor": self.friction_factor,
            "verdicts": [
                {
                    **dataclasses.asdict(verdict),
                    "locks": verdict.locks,
                    "factor_to_limit": verdict.factor_to_limit,
                }
                for verdict in self
            ],
        }

    def to_rows(self) -> list[dict[str, str]]:
        """Return a row of texts for every verdict."""
        return [
            {
                "friction of": verdict.standard,
                "state": verdict.state,
                "friction": f"{verdict.friction:.4g}",
                "limit": f"{verdict.limit:.4g}",
                "efficiency, wheel driving": f"{verdict.efficiency:.4g}",
                "locks itself": "yes" if verdict.locks else "no",
            }
            for verdict in self
        ]


def locking_friction(
    lead_angle: npt.ArrayLike,
    pressure_angle: npt.ArrayLike | None = None,
    *,
    on_invalid: Invalid = "raise",
) -> Any:
    r"""Coefficient of friction from which on a worm locks itself.

    .. math:: \mu = \tan\gamma_{m1} \quad \text{(ISO/TR 14521, BS 721)}, \qquad
        \mu = \cos\alpha_n \tan\gamma_{m1} \quad \text{(AGMA 6034)}

    Parameters
    ----------
    lead_angle : array_like
        :math:`\gamma_{m1}`, rad.
    pressure_angle : array_like, optional
        :math:`\alpha_n`, rad, for AGMA 6034.
    on_invalid : {'raise', 'mask'}
        What to do with elements of arrays that are not allowed.

    Returns
    -------
    float, ndarray or Masked
        The coefficient of friction.

    Examples
    --------
    >>> import math
    >>> round(locking_friction(math.atan(1 / 10.8)), 4)
    0.0926
    """
    if pressure_angle is None:
        return evaluate(np.tan, angle("lead_angle", lead_angle), on_invalid=on_invalid)
    return evaluate(
        lambda lead, alpha: np.cos(alpha) * np.tan(lead),
        angle("lead_angle", lead_angle),
        angle("pressure_angle", pressure_angle),
        on_invalid=on_invalid,
    )


def locks(lead_angle: npt.ArrayLike, friction: npt.ArrayLike) -> Any:
    r"""Whether a worm locks itself, :math:`\gamma_{m1} \le \arctan\mu`.

    Parameters
    ----------
    lead_angle : array_like
        rad.
    friction : array_like
        Coefficient of friction; under vibration the effective one.

    Returns
    -------
    bool or ndarray of bool
        Where the efficiency with the wheel driving is not above zero.

    Examples
    --------
    >>> locks(0.0923, 0.148), locks(0.0923, 0.5 * 0.148)
    (True, False)
    """
    answer = evaluate(
        lambda lead, mu: np.where(lead <= np.arctan(mu), 1.0, 0.0),
        angle("lead_angle", lead_angle),
        Argument("friction", friction, lower=0.0),
    )
    return answer > 0.5 if np.ndim(answer) else bool(answer)


def self_locking(given: Inputs, ratings: Mapping[str, Rating], tables: bs721.Tables) -> SelfLocking:
    """Judge by the friction of each rating, at rest and at the sliding velocity.

    Parameters
    ----------
    given : Inputs
        What was rated.
    ratings : mapping of str to Rating
        By standard; those that are not there are left out. Where the user gave a friction, it
        takes the place of all.
    tables : Tables
        Of BS 721.
    """
    plain = {name: name for name in ("iso14521", "bs721") if name in ratings}
    if given.friction is not None:
        plain = {"given": next(iter(plain))} if plain else {}
    verdicts = [
        Verdict(
            name,
            state,
            mu,
            locking_friction(given.lead_angle),
            efficiency.wheel_driving_efficiency(given.lead_angle, mu),
        )
        for name, rated_by in plain.items()
        for state, mu in _friction(given, rated_by, ratings[rated_by], tables)
    ]
    if "agma6034" in ratings:
        verdicts += [
            Verdict(
                "agma6034",
                state,
                mu,
                locking_friction(given.lead_angle, given.pressure_angle),
                agma6034.wheel_driving_efficiency(mu, given.lead_angle, given.pressure_angle),
            )
            for state, mu in _friction(given, "agma6034", ratings["agma6034"], tables)
        ]
    return SelfLocking(given.lead_angle, given.friction_factor, tuple(verdicts))


def _friction(
    given: Inputs, name: str, rating: Rating, tables: bs721.Tables
) -> tuple[tuple[State, float], tuple[State, float]]:
    """Return the friction of a standard at rest and moving, with the factor on it."""
    if given.friction is not None:
        at_rest = given.friction
    elif name == "iso14521":
        at_rest = _iso_at_rest(given, rating)
    else:
        at_rest = (
            agma6034.friction(0.0) if name == "agma6034" else bs721.friction(0.0, tables=tables)
        )
    moving = float(rating["mu_zm" if name == "iso14521" else "mu"])
    return ("static", given.friction_factor * at_rest), ("dynamic", moving)


def _iso_at_rest(given: Inputs, rating: Rating) -> float:
    """Mean friction with the standard's law at no sliding velocity, which is its cap."""
    base = given.base_friction
    if base is None:
        base = iso_friction.base_friction(
            0.0,
            family=given.gearset.wheel_material.family,
            lubrication=given.operation.lubrication,
            base_oil=given.operation.lubricant.base_oil,
        )
    factors = (float(rating[key]) for key in ("Y_S", "Y_G", "Y_W", "Y_R"))
    mean: float = iso_friction.mean_friction(base, *factors)
    return mean
