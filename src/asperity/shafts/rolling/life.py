"""ISO 281: rating life, its modification by oil and dirt; ISO 76: static safety."""

from collections.abc import Sequence
from typing import Annotated, Any, Literal

import numpy as np

from asperity.arrays import Real
from asperity.formulas import Symbol, formula, positive
from asperity.formulas.traced import total
from asperity.shafts import symbols as s

Kind = Literal["ball", "roller"]
EXPONENT: dict[Kind, float] = {"ball": 3.0, "roller": 10.0 / 3.0}
"""Exponent p of load in life."""

RELIABILITY = {90: 1.0, 95: 0.64, 96: 0.55, 97: 0.47, 98: 0.37, 99: 0.25}
"""Life factor a_1 by percent; above 95 from memory, `symbols.ISO_281_MEMORY`."""

CLEANLINESS = {
    "high": 0.6, "normal": 0.5, "slight": 0.3, "typical": 0.1, "severe": 0.0, "bronze": 0.3,
}  # fmt: skip
"""Factor e_C by a word, the least of its range; ``bronze`` is a proposal of our own for an oil bath
that holds what a wheel of bronze wears off."""

AT_REST: dict[Kind, float] = {"ball": 1.0, "roller": 1.5}
"""Least static safety for normal running, from memory, `symbols.ISO_76_MEMORY`."""

_MOST = 50.0
_kinematic = Annotated[Real, Symbol("nu", "mm2/s", positive)]
_reference = Annotated[Real, Symbol("nu_1", "mm2/s", positive)]
_L = Annotated[Real, Symbol("L_10h", "h", positive)]
_P0 = Annotated[Real, Symbol("P_0", "N", positive)]


@formula(symbol="L_10", unit="1e6 turns", equation="(C/P)^p", source=s.ISO_281)
def rating_life(rating: s.C, load: s.P, exponent: s.p) -> Real:
    """Millions of turns that nine of ten bearings reach.

    Examples
    --------
    >>> rating_life(2000.0, 1000.0, 3.0)
    8.0
    """
    return (rating / load) ** exponent


@formula(symbol="L_10h", unit="h", equation="1e6/(60 n) (C/P)^p", source=s.ISO_281)
def rating_life_hours(rating: s.C, load: s.P, exponent: s.p, speed: s.n) -> Real:
    """Running time that nine of ten bearings reach.

    Examples
    --------
    >>> round(rating_life_hours(7350.0, 0.56 * 2500.0 + 1.6 * 1000.0, 3.0, 720.0), 2)
    340.42
    """
    return 1e6 / (60.0 * speed) * (rating / load) ** exponent


def spectrum_life(hours: Sequence[Any], lives: Sequence[Any]) -> Any:
    """Return the life under several loads, h, by their hours and the life under each alone.

    Parameters
    ----------
    hours : sequence of float, shape (n,)
        How long each load acts, h.
    lives : sequence of float, shape (n,)
        Life under each of them alone, h; arrays where many gearsets are looked at together.

    Returns
    -------
    float or ndarray, shape of each life
        h, by linear damage (Palmgren and Miner).
    """
    whole = total(hours)
    return 1.0 / total(each / whole / own for each, own in zip(hours, lives, strict=True))


@formula(
    symbol="nu_1",
    unit="mm2/s",
    equation="45000 n^-0.83 D_pw^-0.5 below 1000 rpm, else 4500 n^-0.5 D_pw^-0.5",
    source=s.ISO_281_MEMORY,
)
def reference_viscosity(speed: s.n, pitch_diameter: s.D_pw) -> Real:
    """Viscosity that parts the surfaces well enough."""
    slow = 45e3 * speed**-0.83
    return np.where(speed < 1000.0, slow, 4500.0 * speed**-0.5) * pitch_diameter**-0.5


@formula(symbol="kappa", equation="nu/nu_1", source=s.ISO_281)
def viscosity_ratio(viscosity: _kinematic, reference: _reference) -> Real:
    """How much thicker the oil is than it must be.

    Examples
    --------
    >>> viscosity_ratio(20.0, 10.0)
    2.0
    """
    return viscosity / reference


@formula(symbol="C_u", unit="N", equation="C_0/22 of balls, C_0/8.2 of rollers",
         source=s.ISO_281_MEMORY)  # fmt: skip
def fatigue_load_limit(static_rating: s.C_0, kind: Kind) -> Real:
    """Load below which nothing tires; for pitch diameters up to 100 mm."""
    return static_rating / (22.0 if kind == "ball" else 8.2)


@formula(
    symbol="a_ISO",
    equation="0.1 (1 - c^0.83 x^(1/3))^-9.3 of balls, 0.1 (1 - c x^0.4)^-9.185 of rollers, at most "
    "50; x = e_C C_u/P, c by kappa",
    source=s.ISO_281_MEMORY,
)
def life_modification(
    viscosity_ratio: s.kappa, cleanliness: s.e_C, limit: s.C_u, load: s.P, kind: Kind
) -> Real:
    """What oil and dirt make of the life of a radial bearing.

    The viscosity ratio counts from 0.1 to 4: a thicker oil does not help, and below 0.1 the
    formula is not valid and 0.1 is taken.

    Examples
    --------
    >>> round(life_modification(0.6, 1.0, 100.0, 1000.0, "ball"), 5)
    0.80119
    >>> round(life_modification(0.6, 1.0, 100.0, 1000.0, "roller"), 5)
    0.23643
    """
    k = np.minimum(np.maximum(viscosity_ratio, 0.1), 4.0)
    x = cleanliness * limit / load
    ball = kind == "ball"
    whole, thin, middle, thick = (
        (2.5671, 2.2649, 1.9987, 1.9987) if ball else (1.5859, 1.3993, 1.2348, 1.2348)
    )
    c = whole - np.where(
        k < 0.4,
        thin / k**0.054381,
        np.where(k < 1.0, middle / k**0.19087, thick / k**0.071739),
    )
    base = 1.0 - (c**0.83 * np.cbrt(x) if ball else c * x**0.4)
    # Where the base reaches nothing, the life has no end and its factor is cut.
    most = 0.1 * np.maximum(base, 1e-3) ** (-9.3 if ball else -9.185)
    return np.minimum(most, _MOST)


@formula(symbol="L_nmh", unit="h", equation="a_1 a_ISO L_10h", source=s.ISO_281)
def modified_life(
    reliability: Annotated[Real, Symbol("a_1", "", positive)],
    modification: Annotated[Real, Symbol("a_ISO", "", positive)],
    life: _L,
) -> Real:
    """Life with the reliability that is asked, with oil and dirt.

    Examples
    --------
    >>> modified_life(0.5, 2.0, 100.0)
    100.0
    """
    return reliability * modification * life


@formula(symbol="s_0", equation="C_0/P_0", source=s.ISO_76)
def static_safety(static_rating: s.C_0, load: _P0) -> Real:
    """Safety against dents.

    Examples
    --------
    >>> static_safety(2000.0, 1000.0)
    2.0
    """
    return static_rating / load
