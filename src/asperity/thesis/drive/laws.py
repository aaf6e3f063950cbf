"""Claim 7.6: Coulomb friction, a sound asperity and Appendix E under a worm that hammers."""

import numpy as np

from asperity.thesis.drive.appendix_e import Hammered, Subroutine, hammered
from asperity.thesis.drive.claims import FRICTION, assumed
from asperity.thesis.drive.sets import AMPLITUDE, RATIOS
from asperity.thesis.drive.simulations import COULOMB, of_set
from asperity.thesis.exhibits import claim
from asperity.thesis.products import NOT_TESTABLE, Finding

LAW = Subroutine(FRICTION, 70e-9, 1.0)
"""Of the thesis's simulations (7.2.4); the exponent is not stated, 1 is that of chapter 4."""

SHARES = (0.424, 0.317)
"""Of an axial vibration of gearset 3 along the sliding and across it, as ``asperity flank`` says.

The rest, 0.848, is along the normal.
"""

INCREMENTS = 1000
OTHERS = (200, 5000)
"""Increments a cycle, and others beside."""
HOW = "asperity.thesis.drive.appendix_e.hammered(law, k_w, (0.424, 0.317), 0.16e-3, 1000)"
_AGREE = 0.01


def at_ratios(increments: int = INCREMENTS) -> list[Hammered]:
    """Friction by each law over the velocity ratios of a set."""
    return [hammered(LAW, k, SHARES, AMPLITUDE, increments) for k in RATIOS]


@claim("7.6")
def _coulomb() -> Finding:
    found = at_ratios()
    above = [one for one, k in zip(found, RATIOS, strict=True) if k > 1.0]
    _, dahl, coulomb = (np.array(values) for values in zip(*above, strict=True))
    apart = float(np.abs(dahl - coulomb).max())
    at_5 = found[RATIOS.index(5.0)]
    runs = [of_set(3), of_set(3, COULOMB)]
    marched = [
        (k, rigid.ratio - elastic.ratio)
        for k, elastic, rigid in zip(
            RATIOS, *([run.shaken() for run in group] for group in runs), strict=True
        )
        if k > 1.0 and elastic.settled and rigid.settled
    ]
    counts = sorted((INCREMENTS, *OTHERS))
    increments = f"{', '.join(map(str, counts[:-1]))} and {counts[-1]}"
    least = min(
        one.coulomb - one.subroutine
        for count in counts
        for one, k in zip(at_ratios(count), RATIOS, strict=True)
        if k > 1.0
    )
    return Finding.judged(
        {
            "mean friction by Coulomb's law is above the subroutine's, at each k_w above one": least
            > _AGREE,
        },
        f"mean friction at k_w = 5: Coulomb {at_5.coulomb:.3f}, a sound asperity {at_5.dahl:.3f}, "
        f"Appendix E {at_5.subroutine:.3f} of mu N",
        "Figure 7.14 is lost, and Appendix E has not been marched in a gearset here: what is "
        "computed is another quantity than the torque of the worm, mean friction of one contact "
        "under the motion of set 3. Of that Coulomb's law gives more than the thesis's subroutine, "
        f"by {least:.2f} of mu N at least, with {increments} increments a cycle, though what "
        "the subroutine gives depends on them. That asperities do it is not so: a sound law of "
        f"theirs, whose limit follows the normal force, is within {apart:.3f} of Coulomb's, since "
        f"its {1e9 * LAW.max_deflection:g} nm are nothing beside {1e3 * AMPLITUDE:g} mm; it is "
        "the subroutine that is low, by a branch that (79) to (97) as printed do not have. Marched "
        "in balance (figure 7.14), Coulomb's ratio less that of the sound asperity is "
        + ", ".join(f"{more:+.3f} at {k:g}" for k, more in marched)
        + " where both are settled.",
        {
            "above_the_subroutine_at_least": least,
            "apart_from_coulomb": apart,
            "subroutine_at_k_w_5": at_5.subroutine,
            "dahl_at_k_w_5": at_5.dahl,
            "coulomb_at_k_w_5": at_5.coulomb,
            "subroutine_at_k_w_20": found[-1].subroutine,
            "coulomb_at_k_w_20": found[-1].coulomb,
        },
        [HOW, *(run for group in runs for run in group)],
        verdict=NOT_TESTABLE,
        assumed="Mean friction along the sliding over mu times the mean normal force in the place "
        "of the torque, the worm moved as in set 3 against a wheel that coasts. The increments a "
        f"cycle, {INCREMENTS} for the numbers shown, and the exponent of the law, "
        f"{LAW.exponent:g}: neither is stated. {assumed()}",
    )
