"""Whether the wheel can drive the worm, by the friction of each standard and by the user's own.

By ISO/TR 14521 and BS 721 a worm locks itself where its lead angle is not above the friction
angle, atan(mu); AGMA 6034, and BS 721 where that is asked for, projects the friction with the
pressure angle, so that it does where the lead angle is not above atan(mu/cos(alpha_n)). In each
case it is where the standard's own efficiency with the wheel driving is not above zero.

Statically the friction at rest counts, dynamically that at the sliding velocity. The factor on the
friction multiplies both: a vibration that lowers the friction by it sets a worm free that locked
itself.
"""

import dataclasses
import math
from collections.abc import Iterator, Mapping
from typing import Any, Literal, Protocol

import numpy as np

from asperity.arrays import Real
from asperity.formulas import formula
from asperity.gearset import Geometry
from asperity.rating.agma6034 import mesh
from asperity.rating.bs721 import torque
from asperity.rating.bs721.rating import by_normal_section
from asperity.rating.bs721.tables import Tables, read_tables
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521 import efficiency
from asperity.rating.iso14521 import friction as iso_friction
from asperity.rating.iso14521.symbols import alpha_n, gamma_m1
from asperity.rating.result import Rating
from asperity.rating.standing import NAMES, listed
from asperity.results.quantity import Quantities, labelled, quantity
from asperity.results.table import Table, table_of_rows

State = Literal["static", "dynamic"]


class Numbers(Protocol):
    """Numbers of ratings by ``standard.key``."""

    def __contains__(self, key: object) -> bool: ...

    def __getitem__(self, key: str) -> Any: ...


_FACTORS = ("Y_S", "Y_G", "Y_W", "Y_R")


class Verdict(Quantities):
    """Whether a worm locks itself with one friction value.

    Attributes
    ----------
    standard : str
        ``"iso14521"``, ``"bs721"``, ``"agma6034"`` or ``"given"``.
    state : {'static', 'dynamic'}
        At rest, or at the sliding velocity.
    """

    standard: str = quantity("", "", "whose friction it is")
    state: State = quantity("", "", "at rest or at the sliding velocity")
    friction: float = quantity("mu", "", "coefficient of friction with the factor on it")
    limit: float = quantity("", "", "coefficient from which on the worm locks itself")
    efficiency: float = quantity("eta_z2-1", "", "efficiency of the teeth, the wheel driving")

    @property
    @labelled("", "", "whether the worm locks itself")
    def locks(self) -> bool:
        """Whether the worm locks itself."""
        return self.efficiency <= 0.0

    @property
    @labelled("", "", "what the friction must be multiplied by to reach the limit")
    def factor_to_limit(self) -> float | None:
        """What the friction must be multiplied by to reach the limit.

        None without friction, or with so little that no number reaches the limit.
        """
        factor = self.limit / self.friction if self.friction > 0.0 else math.inf
        return factor if math.isfinite(factor) else None


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
            "verdicts": [verdict.to_json() for verdict in self],
        }

    def table(self) -> Table:
        """Return a row for every verdict."""
        return table_of_rows(
            self.verdicts,
            {
                "friction of": lambda verdict: NAMES.get(verdict.standard, verdict.standard),
                "state": "state",
                "friction": "friction",
                "limit": "limit",
                "efficiency, wheel driving": "efficiency",
                "locks": "locks",
            },
            title=f"Self-locking at a lead angle of {math.degrees(self.lead_angle):.4g} deg",
            within="self_locking.verdicts",
        )


@formula(symbol="mu", equation="tan(gamma_m1)")
def locking_friction(lead_angle: gamma_m1, pressure_angle: alpha_n | None = None) -> Real:
    """Coefficient of friction from which on a worm locks itself.

    Shown for ISO/TR 14521 and BS 721; with a pressure angle that of AGMA 6034,
    cos(alpha_n) tan(gamma_m1).

    Examples
    --------
    >>> import math
    >>> round(locking_friction(math.atan(1 / 10.8)), 4)
    0.0926
    """
    share = 1.0 if pressure_angle is None else np.cos(pressure_angle)
    return share * np.tan(lead_angle)


def self_locking(inputs: Inputs, ratings: Mapping[str, Rating], tables: Tables) -> SelfLocking:
    """Judge by the friction of each rating, at rest and at the sliding velocity.

    Parameters
    ----------
    inputs : Inputs
        What was rated.
    ratings : mapping of str to Rating
        By standard; those that are not there are left out. Where the user gave a friction, it
        takes the place of all.
    tables : Tables
        Of BS 721.
    """
    plain = {name: name for name in ("iso14521", "bs721") if name in ratings}
    if inputs.friction is not None:
        plain = {"given": next(iter(plain))} if plain else {}
    verdicts = [
        Verdict(
            standard=name,
            state=state,
            friction=mu,
            limit=friction_share(inputs, name) * locking_friction(inputs.lead_angle),
            efficiency=efficiency.wheel_driving_efficiency(
                inputs.lead_angle, mu / friction_share(inputs, name)
            ),
        )
        for name, rated_by in plain.items()
        for state, mu in _friction(inputs, rated_by, ratings[rated_by], tables)
    ]
    if "agma6034" in ratings:
        verdicts += [
            Verdict(
                standard="agma6034",
                state=state,
                friction=mu,
                limit=locking_friction(inputs.lead_angle, inputs.pressure_angle),
                efficiency=mesh.wheel_driving_efficiency(
                    mu, inputs.lead_angle, inputs.pressure_angle
                ),
            )
            for state, mu in _friction(inputs, "agma6034", ratings["agma6034"], tables)
        ]
    return SelfLocking(inputs.lead_angle, inputs.friction_factor, tuple(verdicts))


def near_limit(locking: SelfLocking, geometry: Geometry, inputs: Inputs) -> tuple[str, ...]:
    """Return that a verdict hangs on where the teeth touch, where it does; none elsewhere.

    Standards judge on the reference circle. Loaded teeth touch anywhere between the wheel's tip and
    the worm's, and the further out, the less friction locks.
    """
    angle, lead = geometry.pressure_angle, geometry.reduced_lead
    reference = 0.5 * geometry.worm_pitch_diameter
    inner, outer = geometry.wheel_throat_radius, 0.5 * geometry.worm_tip_diameter

    def of_reference(radius: float) -> float:
        squares = radius**2 + lead**2, reference**2 + lead**2
        return (reference / radius) ** 2 * math.sqrt(squares[0] / squares[1])

    least = float(locking_friction(locking.lead_angle, angle)) * of_reference(outer)
    near = {
        (verdict.friction, verdict.state): NAMES.get(verdict.standard, "as given")
        for verdict in reversed(locking.verdicts)
        if least <= verdict.friction <= verdict.limit * of_reference(inner)
    }
    if not near:
        return ()
    frictions = [
        f"{mu:.3g} {'at rest' if state == 'static' else 'in motion'} ({whose})"
        for (mu, state), whose in reversed(near.items())
    ]
    at = float(locking_friction(locking.lead_angle))
    tip, bottom = at * of_reference(outer), at * of_reference(inner)
    share = math.cos(angle)
    leave = "ISO/TR 14521 leaves" if by_normal_section(inputs) else "ISO/TR 14521 and BS 721 leave"
    return (
        f"self-locking hangs on where loaded teeth touch, with the friction {listed(frictions)}: "
        f"it takes {at:.3g} on the reference circle, as here, {tip:.3g} at the worm's tip and "
        f"{bottom:.3g} at the wheel's, and with the pressure angle, which {leave} "
        f"out, {share * at:.3g}, {share * tip:.3g} and {share * bottom:.3g}; asperity "
        "locking has it and goes by where they do",
    )


def friction_share(inputs: Inputs, name: str) -> Real:
    """What BS 721 divides its friction by, where that is asked for; else 1."""
    asked = name == "bs721" and by_normal_section(inputs)
    return np.cos(inputs.pressure_angle) if asked else 1.0


def locking_margins(
    inputs: Inputs, numbers: Numbers, tables: Tables | None = None
) -> dict[tuple[str, State], Real]:
    """Return by how much friction is above that from which on a worm locks itself, over it.

    Parameters
    ----------
    inputs : Inputs
        What was rated, arrays of variants among them.
    numbers : Numbers
        Of ratings, or of variants; a standard that has none is left out.
    tables : Tables, optional
        Of BS 721, in place of those that ship.

    Returns
    -------
    dict of (standard, state) to float or ndarray
        At least 0 where the worm locks.
    """
    tan = np.tan(inputs.lead_angle)
    limits = {
        "iso14521": tan,
        "bs721": friction_share(inputs, "bs721") * tan,
        "agma6034": np.cos(inputs.pressure_angle) * tan,
    }
    keys = {"iso14521": "mu_zm", "bs721": "mu", "agma6034": "mu"}
    margins: dict[tuple[str, State], Real] = {}
    for name, limit in limits.items():
        if f"{name}.{keys[name]}" in numbers:
            at_rest = inputs.friction
            if at_rest is None:
                at_rest = _at_rest(inputs, name, numbers, tables or read_tables())
            margins[name, "static"] = inputs.friction_factor * at_rest / limit - 1.0
            margins[name, "dynamic"] = numbers[f"{name}.{keys[name]}"] / limit - 1.0
    return margins


def _at_rest(inputs: Inputs, name: str, numbers: Numbers, tables: Tables) -> Real:
    if name == "agma6034":
        return mesh.friction(0.0)
    if name == "bs721":
        return torque.friction(0.0, tables=tables)
    return _iso_at_rest(inputs, {key: numbers[f"iso14521.{key}"] for key in _FACTORS})


def _friction(
    inputs: Inputs, name: str, rating: Rating, tables: Tables
) -> tuple[tuple[State, float], tuple[State, float]]:
    """Return the friction of a standard at rest and moving, with the factor on it."""
    if inputs.friction is not None:
        at_rest = inputs.friction
    elif name == "iso14521":
        at_rest = float(_iso_at_rest(inputs, {key: rating[key] for key in _FACTORS}))
    else:
        at_rest = mesh.friction(0.0) if name == "agma6034" else torque.friction(0.0, tables=tables)
    moving = float(rating["mu_zm" if name == "iso14521" else "mu"])
    return ("static", inputs.friction_factor * at_rest), ("dynamic", moving)


def _iso_at_rest(inputs: Inputs, factors: Mapping[str, Any]) -> Real:
    """Mean friction with the standard's law at no sliding velocity, which is its cap."""
    base = inputs.base_friction
    if base is None:
        base = iso_friction.base_friction(
            0.0,
            family=inputs.gearset.wheel_material.family,
            lubrication=inputs.operation.lubrication,
            base_oil=inputs.operation.lubricant.base_oil,
        )
    return iso_friction.mean_friction(base, *(factors[key] for key in _FACTORS))
