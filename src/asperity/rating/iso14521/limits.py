"""Where ISO/TR 14521 is valid; the safety it asks for stands in `asperity.rating.demands`."""

import math
from collections.abc import Mapping

from asperity.gearset import oil
from asperity.sources import Range, Source

_STANDARD = "ISO/TR 14521:2010"
_ONE_SOURCE = Source(_STANDARD, "one source")
_FROM_MEMORY = Source(_STANDARD, "from memory")
_SCOPE = Source("ISO/TS 14521:2020", "one source", "its scope")

VALIDITY: Mapping[str, Range] = {
    "centre_distance": Range("centre distance a (Y_S)", 65.0, 250.0, "mm", _ONE_SOURCE),
    "profile_shift": Range(
        "profile shift x_2 (h*, p_m*)", -1.0, 1.0, "", Source("MITCalc 1.74", "one source")
    ),
    "geometry_factor": Range(
        "geometry factor Y_G", 0.0, 2.0, "", Source("one commercial program", "one source")
    ),
    "sump_centre_distance": Range("centre distance a (theta_S)", 63.0, 400.0, "mm", _FROM_MEMORY),
    "sump_worm_speed": Range("worm speed n_1 (theta_S)", 60.0, 3000.0, "rpm", _FROM_MEMORY),
    "sump_ratio": Range("ratio u (theta_S)", 10.0, 40.0, "", _FROM_MEMORY),
    "sliding_velocity": Range("sliding velocity v_gm", 0.1, 25.0, "m/s", _SCOPE),
}
"""Where the standard's formulas are valid; the symbol in brackets is what rests on it.

The sliding velocity's is the scope of the next edition, which the older one is shown by too: below
its lower bound wear is not covered. That edition's least contact ratio, 2.1, is not asked about, as
the standard's formula of it is not at hand; ``asperity flank`` finds one on the flanks.
"""


_PRACTICE = Source("usual practice", "own choice", "bounds of our own")

PLAUSIBLE: Mapping[str, Range] = {
    "theta_S_degC": Range(
        "temperature of the sump theta_S",
        oil.TEMPERATURE.lower,
        oil.TEMPERATURE.upper,
        "degC",
        oil.TEMPERATURE.source,
    ),
    "sigma_Hm_MPa": Range("mean contact stress sigma_Hm", 0.0, 2000.0, "MPa", _PRACTICE),
    "idle_share": Range("losses without load over P_2 (eta_ges)", 0.0, 1.0, "", _PRACTICE),
}
"""Where a result still has a meaning, by its key in a rating.

``idle_share`` is what is lost without load, idling and in the seals, in parts of the power at the
wheel: above 1 the efficiencies of the gearbox tell about a gearbox that carries nothing.
"""


def implausible(values: Mapping[str, float]) -> tuple[str, ...]:
    """Return a sentence for each result of a rating that lies outside `PLAUSIBLE`."""
    idle = (values["loss_idle_W"] + values["loss_seal_W"]) / values["output_power_W"]
    found = {**values, "idle_share": idle}
    found["theta_S_degC"] = values.get("theta_S_max_degC", values["theta_S_degC"])
    sentences = (
        span.violation(found[key]) for key, span in PLAUSIBLE.items() if not math.isnan(found[key])
    )
    return tuple(sentence for sentence in sentences if sentence)


def violations(
    *,
    centre_distance: float,
    profile_shift: float,
    worm_speed: float,
    ratio: float,
    geometry_factor: float | None = None,
    sump_by_formula: bool = True,
    sliding_velocity: float | None = None,
) -> tuple[str, ...]:
    """Return a sentence for each limit of validity that does not hold.

    Parameters
    ----------
    centre_distance : float
        mm.
    profile_shift : float
        Of the wheel.
    worm_speed : float
        rpm.
    ratio : float
        Wheel teeth over starts.
    geometry_factor : float, optional
        Left out where the friction is given and does not rest on it.
    sump_by_formula : bool
        Whether the sump's temperature comes from the standard and is not given.
    sliding_velocity : float, optional
        m/s.

    Examples
    --------
    >>> violations(centre_distance=60.17, profile_shift=0, worm_speed=1440, ratio=15)[0]
    'centre distance a (theta_S) is 60.17 mm; ISO/TR 14521:2010 is valid from 63 to 400 mm'
    """
    given: dict[str, float] = {"profile_shift": profile_shift}
    if geometry_factor is not None:
        given.update(centre_distance=centre_distance, geometry_factor=geometry_factor)
    if sump_by_formula:
        given.update(
            sump_centre_distance=centre_distance, sump_worm_speed=worm_speed, sump_ratio=ratio
        )
    if sliding_velocity is not None:
        given["sliding_velocity"] = sliding_velocity
    sentences = (VALIDITY[name].violation(value) for name, value in given.items())
    return tuple(sentence for sentence in sentences if sentence)
