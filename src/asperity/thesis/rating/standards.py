"""Claims 2.8, 2.9, 2.11, 3.15 to 3.18: methods, standards and the optimum against another."""

import math

from asperity.rating.agma6034.mesh import worm_driving_efficiency
from asperity.studies.methods import compare
from asperity.studies.reported import more_methods
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding
from asperity.thesis.rating import printed
from asperity.thesis.rating.claims import FROM_MEMORY
from asperity.thesis.rating.rated import (
    GEARSET_2,
    GEARSETS,
    OPTIMISED,
    RatedGear,
    number,
    quoted_methods,
)

_WORST, _BEST = 3.24, 2.77
"""Power with the worst and the best oil of one grade, kW (2.3.2)."""
_PERCENT = 14.6
_LITTLE = 0.1
_AT_OPTIMUM = 0.45
"""Of gearset 2 (3.4)."""
_PRINTED = (0.0715, 0.0170, 0.0550)
"""Friction with mineral oil, polyglycol and polyalphaolefin (3.2.1)."""


def _near(share: float, printed: float) -> bool:
    """Whether a share is that of printed numbers, to the percent."""
    return abs(share - printed) < 0.005


@claim("2.8")
def _reversible() -> Finding:
    study = GEARSET_2.comparison
    rows = [study[method.key] for method in quoted_methods()]
    keep, lose = ([row for row in rows if row.locks is locks] for locks in (True, False))
    as_is, optimum = study["as_is"], GEARSET_2.optimum.after
    optimised = number(optimum, "iso14521", "eta_z1_2")
    back = number(optimum, "iso14521", "eta_z2_1")
    lead = math.radians(GEARSET_2.number("iso14521", "lead_angle_deg"))
    bound = 0.5 * (1.0 - math.tan(lead) ** 2)
    by_hand = [printed.locks(row) for row in rows]
    angles = sorted(math.degrees(math.atan(row.friction)) for row in rows)
    unlocked = [sum(not locked[n] for locked in by_hand) for n in range(len(printed.LEADS))]
    return Finding.judged(
        {
            f"at {printed.EFFICIENCY:.0%} gearset 2 locks itself": all(printed.locks(as_is)),
            "with a better method it does not": all(unlocked) and bool(lose),
        },
        f"{len(lose)} of {len(rows)} methods of Table 3.3 unlock it: "
        + ", ".join(f"{row.name} ({row.efficiency:.0%})" for row in lose),
        f"Arithmetic: by (6) and (1) from the printed {printed.EFFICIENCY:.0%} and the printed "
        f"frictions, {' and '.join(map(str, sorted(set(unlocked))))} of {len(rows)} methods unlock "
        f"a worm of any lead angle from {printed.BETWEEN} deg. What depends on the ratio is the "
        "lead angle that goes with it: by (1) a worm with the friction of gearset 2 stays locked "
        f"with all of them below {angles[0]:.1f} deg of lead, and without any from "
        f"{math.degrees(math.atan(as_is.friction)):.1f} deg on it does not lock at all. Gearset 2, "
        f"at {math.degrees(lead):.1f} deg, locks itself while it slides below {bound:.1%}. It "
        "stays locked with "
        + ", ".join(f"{row.name} ({row.efficiency:.0%})" for row in keep)
        + f"; its optimum, at {optimised:.1%}, {'keeps' if back <= 0.0 else 'loses'} it.",
        {f"{row.key}_back_driving": row.back_driving_efficiency for row in rows}
        | {"bound": bound, "optimum_back_driving": back},
        [printed.HOW, GEARSET_2.command("methods"), GEARSET_2.command("optimise")],
        verdict=ARITHMETIC,
        assumed="Gearset 2 at its own ratio for the numbers of methods.",
    )


@claim("2.9")
def _polyglycol() -> Finding:
    quoted = quoted_methods()
    study = GEARSET_2.comparison
    glycol, olefin = study["polyglycol"], study["polyalphaolefin"]
    as_is = study["as_is"]
    base, polyglycol, polyalphaolefin = _PRINTED
    fall, other = (1.0 - row.base_friction / as_is.base_friction for row in (glycol, olefin))
    literature = [one for one in more_methods(["literature"]) if one.key.startswith("poly")]
    again = compare(*GEARSET_2.tables(), methods=[*quoted, *literature])
    most = again["polyglycol_most"]
    rows = [study[method.key] for method in quoted if method.kind != "vibration"]
    above = [row for row in rows if row.key != "polyglycol" and row.efficiency > most.efficiency]
    return Finding.judged(
        {
            f"{polyglycol:.4f} for {base:.4f} is {fall:.0%} less": _near(
                fall, 1.0 - polyglycol / base
            ),
            f"{polyalphaolefin:.4f} for {base:.4f} is {other:.0%} less": _near(
                other, 1.0 - polyalphaolefin / base
            ),
        },
        f"Table 3.3 has {fall:.0%} less for polyglycol, {other:.0%} for polyalphaolefin",
        "The thesis names both sources, and nothing of either is refuted: Doleschel's are FZG "
        "tests, and Siebert, of whom Table 3.3 has its number, is whom the review cites for worm "
        "gearing. The choice is what makes polyglycol the best of all oils and coatings here: with "
        f"the most of the FZG tests gearset 2 comes to {most.efficiency:.1%} instead of "
        f"{glycol.efficiency:.1%}, and behind "
        + ", ".join(f"{row.name} ({row.efficiency:.1%})" for row in above)
        + ".",
        {
            "polyglycol_reduction": fall,
            "polyalphaolefin_reduction": other,
            "eta_z_with_the_most_cited": most.efficiency,
        },
        [f"{GEARSET_2.command('methods')} --also literature"],
        verdict=ARITHMETIC,
        assumed="Gearset 2, which is reconstructed, for what the efficiencies come to; they judge "
        "nothing.",
    )


@claim("2.11")
def _one_grade() -> Finding:
    share = 1.0 - _BEST / _WORST
    half = 0.005
    low, high = 1.0 - (_BEST + half) / (_WORST - half), 1.0 - (_BEST - half) / (_WORST + half)
    mean = GEARSET_2.number("iso14521", "mu_zm")
    efficiency = GEARSET_2.number("iso14521", "eta_z1_2")
    better = RatedGear(GEARSET_2.case, (f"rating.friction={mean * (1.0 - share):.6f}",))
    gain = better.number("iso14521", "eta_z1_2") - efficiency
    return Finding.judged(
        {"14.6 % within rounding": low <= 0.01 * _PERCENT <= high},
        f"{share:.1%}",
        f"The printed powers leave {low:.1%} to {high:.1%}. Were it all of the tooth friction, as "
        f"here, the scatter of oils of one grade would be {100.0 * gain:.1f} points of gearset 2's "
        "efficiency: the error bar of every oil in Table 3.3.",
        {"share": share, "gearset_2_gain": gain},
        ["1 - 2.77/3.24", better],
        verdict=ARITHMETIC,
    )


@claim("3.15")
def _equations() -> Finding:
    pairs = {}
    for name, gear in GEARSETS.items():
        mu, lead, pressure = gear.numbers(
            "iso14521", "mu_zm", "lead_angle_deg", "pressure_angle_deg"
        )
        by_agma = worm_driving_efficiency(mu, math.radians(lead), math.radians(pressure))
        pairs[name] = (gear.number("iso14521", "eta_z1_2"), float(by_agma))
    return Finding.judged(
        {"“as well as differences in the efficiency equations (6) and (7)”": all(
            agma > iso for iso, agma in pairs.values())},
        "; ".join(f"{name}: (6) {iso:.1%}, (7) {agma:.1%}" for name, (iso, agma) in pairs.items())
        + ", of one friction",
        "With one coefficient of friction in both, (7), which has the pressure angle in it, gives "
        "the lower efficiency. All of what eta_AGMA is higher by is its lower friction, which the "
        "thesis names first.",
        {f"{name}_{which}": value for name, both in pairs.items()
         for which, value in zip(("eta_6", "eta_7"), both, strict=True)},
        GEARSETS.values(),
    )  # fmt: skip


def _torques(rated: object) -> tuple[float, float, float]:
    """M_26k, T_G,all and the lesser of M_w and M_s, N m."""
    keys = (("bs721", "M_26k_Nm"), ("agma6034", "allowable_torque_Nm"),
            ("bs721", "M_w_Nm"), ("bs721", "M_s_Nm"))  # fmt: skip
    long, allowable, wear, strength = (number(rated, *key) for key in keys)  # type: ignore[arg-type]
    return long, allowable, min(wear, strength)


@claim("3.16")
def _close() -> Finding:
    found = {
        f"{name}, {when}": _torques(rated)
        for name, gear in GEARSETS.items()
        for when, rated in (("as it is", gear.optimum.before), ("optimum", gear.optimum.after))
    }
    apart = {name: long / allowable - 1.0 for name, (long, allowable, _) in found.items()}
    return Finding.judged(
        {},
        "; ".join(f"{name}: {long:.0f} and {allowable:.0f} N m"
                  for name, (long, allowable, _) in found.items()),
        "“Close” names no number, the tables of two of four gearsets are lost, and our BS 721 is "
        f"from memory. Of ours M_26k is {min(apart.values()):+.0%} to {max(apart.values()):+.0%} "
        f"of "
        "T_G,all away, and at the optimum of gearset 2 the order of the two turns.",
        {f"{name}_{key}_Nm": value for name, values in found.items()
         for key, value in zip(("M_26k", "T_G_all"), values[:2], strict=True)},
        [*GEARSETS.values(), *OPTIMISED],
        verdict=NOT_TESTABLE,
    )  # fmt: skip


@claim("3.17")
def _capacity() -> Finding:
    gains, allowable = {}, {}
    for name, gear in GEARSETS.items():
        before, after = (_torques(rated) for rated in (gear.optimum.before, gear.optimum.after))
        gains[name] = after[2] / before[2] - 1.0
        allowable[name] = (before[1], after[1])
    return Finding.judged(
        {
            "the lesser of M_w and M_s rises by little": all(
                gain < _LITTLE for gain in gains.values()
            ),
        },
        ", ".join(f"{name} {gain:+.1%}" for name, gain in gains.items())
        + " in the lesser of M_w and M_s",
        "“Very little” names no number, as “close” in claim 3.16 names none, and the bounds of the "
        "optimum are lost. That it costs no capacity by BS 721 could not be otherwise: the optimum "
        "is told to keep it, here as there. By AGMA 6034, which nobody told it to keep, T_G,all "
        "goes from "
        + " and from ".join(f"{a:.0f} to {b:.0f} N m ({name})"
                           for name, (a, b) in allowable.items())
        + " with our bounds.",
        {f"{name}_gain": gain for name, gain in gains.items()}
        | {f"{name}_T_G_all_optimum_Nm": after for name, (_, after) in allowable.items()},
        OPTIMISED,
        verdict=NOT_TESTABLE,
        assumed=f"The bounds; {_LITTLE:.0%} for “little”. {FROM_MEMORY}",
    )  # fmt: skip


@claim("3.18")
def _beside_the_methods() -> Finding:
    study = GEARSET_2.comparison
    rows = [study[method.key] for method in quoted_methods()]
    best = number(GEARSET_2.optimum.after, "iso14521", "eta_z1_2")
    below = [row for row in rows if min(printed.efficiencies(row)) < _AT_OPTIMUM]
    return Finding.judged(
        {
            "“a relatively small efficiency improvement compared to the other friction reduction "
            "methods”, most of them": len(below) < 0.5 * len(rows),
        },
        f"less than {_AT_OPTIMUM:.0%} with "
        + ", ".join(
            f"{row.name} ({' to '.join(f'{one:.1%}' for one in sorted(printed.efficiencies(row)))})"
            for row in below
        ),
        f"By (6), from the printed {printed.EFFICIENCY:.0%} and the printed frictions alone, the "
        f"{_AT_OPTIMUM:.0%} that the thesis adds up (claim 3.11) are less than with "
        f"{len(rows) - len(below)} of {len(rows)} methods, at any lead angle from "
        f"{printed.BETWEEN} deg. They are more than with polyalphaolefin, also by the thesis's own "
        f"points, which are seven for six. Our optimum comes to {best:.1%}, between the same two. "
        "It costs neither oil nor coating.",
        {"optimum_eta_z": best} | {f"{row.key}_eta_z": row.efficiency for row in rows},
        [printed.HOW, GEARSET_2.command("methods"), GEARSET_2.command("optimise")],
        verdict=ARITHMETIC,
    )
