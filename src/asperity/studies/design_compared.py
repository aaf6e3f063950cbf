"""What is shown of a design beside the gearset it came from: its numbers and its safeties."""

import math
from typing import Any

from asperity.rating.changes import changed_words, locking_words
from asperity.rating.demands import DEMANDS
from asperity.rating.rated import Rated
from asperity.studies.quantities import varied_quantity

SHOWN = {
    "iso14521": ("h_star", "mu_zm", "eta_z1_2", "eta_ges", "sigma_Hm_MPa"),
    "bs721": ("M_26k_Nm", "M_w_Nm", "M_s_Nm", "M_permissible_Nm"),
    "agma6034": ("eta", "allowable_torque_Nm", "bending_stress_MPa"),
}
"""Numbers of a rating that are shown of a design, by standard."""

EFFICIENCIES = {
    "iso14521.eta_ges": "the efficiency of the gearbox by ISO/TR 14521",
    "agma6034.eta": "the efficiency by AGMA 6034",
}
"""What may fall although the efficiency of the teeth by ISO/TR 14521 rises."""

_FALL = 1e-3


def design_numbers(rated: Rated) -> dict[str, Any]:
    """Return a design: what is free, what follows, and what it is worth by each standard."""
    g = rated.geometry
    return {
        **{varied_quantity(name).key: value for name, value in free_numbers(rated).items()},
        "lead_angle_deg": math.degrees(g.lead_angle),
        **{
            standard: (
                {key: rating[key] for key in keys if key in rating}
                if (rating := rated.found.get(standard)) is not None
                else None
            )
            for standard, keys in SHOWN.items()
        },
    }


def free_numbers(rated: Rated) -> dict[str, float]:
    """Return what is free, and the profile shift that follows, in the units of results."""
    g = rated.geometry
    return {
        "pressure_angle": varied_quantity("pressure_angle").shown(g.pressure_angle),
        "diameter_factor": g.diameter_factor,
        "axial_module": g.axial_module,
        "worm_roughness": varied_quantity("worm_roughness").shown(rated.gearset.worm_roughness),
        "profile_shift": g.profile_shift,
    }


def safety_rows(*designs: Rated) -> list[list[Any]]:
    """Return each safety with what is asked of it and what each design has; None without one."""
    found = [{s.demand.path: s.value for s in rated.verdict.safeties} for rated in designs]
    return [
        [d.path, d.asked, *(values.get(d.path) for values in found)]
        for d in DEMANDS
        if any(d.path in values for values in found)
    ]


def safeties_json(before: Rated, after: Rated, made: Rated | None) -> list[dict[str, Any]]:
    """Return each safety before and after, by key."""
    names = ("path", "asked", "given", "optimum", "made")
    rows = safety_rows(before, after, *([made] if made else []))
    return [dict(zip(names, row, strict=False)) for row in rows]


def locking_of(before: Rated, after: Rated, made: Rated | None) -> dict[str, dict[str, str]]:
    """Return by which standards each design locks itself, by state."""
    designs = {"given": before, "optimum": after} | ({"made": made} if made else {})
    return {name: locking_words(one) for name, one in designs.items()}


def falls(before: Rated, after: Rated) -> list[str]:
    """Return a sentence for each safety that falls, is lost, or does not hold, and efficiency.

    And for each word of the verdict that changes: what holds, and what locks itself.
    """
    said = [
        f"{text} (--keep locking holds that)" if text.startswith("no longer") else text
        for text in changed_words(before, after, each=False)
    ]
    for path, asked, old, new in safety_rows(before, after):
        if new is None:
            said.append(f"{path} has no answer any more")
        elif new < asked:
            said.append(f"{path} does not hold: {new:.3g}; at least {asked:g} is asked")
        elif old is not None and new < old * (1.0 - _FALL):
            said.append(f"{path} falls from {old:.3g} to {new:.3g}; {asked:g} is asked")
    for path, what in EFFICIENCIES.items():
        standard, _, key = path.partition(".")
        if not all(standard in rated.found for rated in (before, after)):
            continue
        old, new = (float(rated.found[standard][key]) for rated in (before, after))
        if new < old - _FALL:
            said.append(f"{what} falls from {100 * old:.1f} to {100 * new:.1f} %")
    return said
