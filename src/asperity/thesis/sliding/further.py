"""Claims 4.13, 4.14 and 7.20: stiffness of the contact, directions, and a body without eta_y."""

import numpy as np

from asperity.friction import Friction
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, Finding
from asperity.thesis.sliding.bodies import DIRECTION, PERIODIC, RATIO, Body, Sweep

_PRINTED_LOADS = (50.8, 50.08)
"""Normal force with k_t of 67.29e6: in Table 4.4 and Appendix A; in 4.4 and 4.5.6, N."""
_PRINTED = 67.29e6
_SELECTED = (2.0, 3.0, 4.0, 6.0, 20.0)
_ALL = "0:360:5"
_READ = 0.02
_ON_BODY = "vibration.applied_to=body"


@claim("4.13")
def _stiffness() -> Finding:
    law = Body("table-4.4", (PERIODIC,)).read().require(Friction)
    right, said = (law.mu * load / (law.max_deflection or np.nan) for load in _PRINTED_LOADS)
    return Finding.judged(
        {
            "the force and s_max of Table 4.4 give that stiffness": abs(right / _PRINTED - 1.0)
            < 1e-4,
            "“F_N = 50.08 N, k_t = 67.29 ⋅ 10⁶ N/m²”": abs(said / _PRINTED - 1.0) < 1e-4,
        },
        f"{1e-6 * right:.2f}e6 N/m with {_PRINTED_LOADS[0]} N, {1e-6 * said:.2f}e6 N/m with "
        f"{_PRINTED_LOADS[1]} N",
        "Appendix A has the stiffness with the force of Table 4.4, as matching those of the "
        "literature: the force of the claim is a misprint, twice. By (18), a force over a "
        "deflection, the s_max of that table gives the same, which proves nothing more, since it "
        "was selected for it. "
        "The unit is N/m, as Appendix A has it.",
        {"k_t_at_50.8_N_N_per_m": right, "k_t_at_50.08_N_N_per_m": said},
        ["mu F_N / s_max, of Table 4.4"],
    )


@claim("4.14")
def _directions() -> Finding:
    axes = ((RATIO, ",".join(f"{k:g}" for k in _SELECTED)), (DIRECTION, _ALL))
    around = Sweep("table-4.4", axes, (PERIODIC,))
    ratios, theta = around.ratios(), around.values(1)
    quarter = np.flatnonzero(theta <= 180.0)
    mirrored = float(np.abs(ratios[:, quarter] - ratios[:, quarter[::-1]]).max())
    counts = [_crossings(row[:-1]) for row in ratios]
    worst = theta[np.argmax(ratios[0][theta <= 90.0])]
    return Finding.judged(
        {
            "the same at four directions": mirrored < 1e-9 and min(counts) >= 4,
        },
        "a ratio is met at up to "
        + ", ".join(f"{n} directions at k = {k:g}" for n, k in zip(counts, _SELECTED, strict=True)),
        "It follows from symmetry, which the equations have: about across the drive as about along "
        "it, which gives each ratio four directions, and two would be “multiple values” still. "
        f"At k = {_SELECTED[0]:g} vibration does least at {worst:g} deg, not across "
        f"the "
        f"drive ({ratios[0].max():.3f} for {ratios[0][theta == 90.0][0]:.3f}), so that a ratio "
        "between the two is met at twice as many.",
        {f"directions_at_k_{k:g}": float(n) for n, k in zip(counts, _SELECTED, strict=True)}
        | {"asymmetry_about_90_deg": mirrored, "worst_direction_at_k_2_deg": float(worst)},
        [around],
        verdict=ARITHMETIC,
    )


def _crossings(ratios: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> int:
    """At how many directions around the circle a ratio is met at most."""
    ends = np.sort(ratios)
    levels = 0.5 * (ends[1:] + ends[:-1])
    levels = levels[np.diff(ends) > 1e-6]
    above = ratios[None, :] > levels[:, None]
    return int((above != np.roll(above, 1, axis=1)).sum(axis=1).max())


@claim("7.20")
def _without_transfer() -> Finding:
    ratios = "0.5,1,2,3,6,20"
    base = Sweep("table-4.4", ((RATIO, ratios),), (PERIODIC,))
    body = Sweep("table-4.4", ((RATIO, ratios),), (PERIODIC, _ON_BODY, "friction.transfer=1"))
    ours, theirs = base.ratios(), body.ratios()
    apart = ours - theirs
    k = base.values()
    worst = int(np.argmax(np.abs(apart)))
    transfer = Body("table-4.4").read().require(Friction).transfer
    return Finding.judged(
        {
            "“the same regardless of whether vibration is applied to the base or to the sliding "
            "body”": float(np.abs(apart).max()) < _READ,
        },
        f"apart by up to {np.abs(apart).max():.2f}, at k = {k[worst]:g}: {ours[worst]:.2f} for the "
        f"base, {theirs[worst]:.2f} for the body",
        f"Appendix E drops eta_y, by a comment of its own, where Appendix D has {transfer:g}: the "
        "shaken body then gives all of its lateral motion to the contact, the shaken base a part. "
        "Seen on a figure from 0 to 1 that must show; Figure 7.8 of the thesis is lost. With the "
        "transfer "
        "kept, as section 7.3 has it, the two agree: claim 7.8; along the sliding, where eta_y "
        "does nothing (claim 4.9), they do without it.",
        {f"apart_at_k_{one:g}": float(value) for one, value in zip(k, apart, strict=True)},
        [base, body],
        assumed=f"The yardstick, {_READ:g} of mu F_N: what can be read off such a figure. Sliding "
        "bodies for the block, in their periodic states, without the plastic branch of Appendix E.",
    )
