"""The friction subroutine of the thesis's Appendix E as Fortran, to repeat what it did in Abaqus.

It is no law to calculate with: it leaves out the transfer across the sliding, and where the slip
of an increment passes the asperities' limit it leaves their root where it was, so that friction
points along the way slid since and not along the sliding, and works can be gained. It is written
on request alone, beside a deck that stays as it is.
"""

from collections.abc import Sequence
from importlib import resources

from asperity.block.deck.fric import FricSubroutine, commented

_STATE_VARIABLES = 5


def appendix_e(mu: float, exponent: float, max_deflection: float) -> FricSubroutine:
    """Write the subroutine of Appendix E.

    Parameters
    ----------
    mu : float
        Coefficient of friction.
    exponent : float
        Dahl's.
    max_deflection : float
        Of the asperities at full friction, m.

    Returns
    -------
    FricSubroutine
        Its text, and its properties and state as the deck lists them.
    """
    properties = (mu, exponent, max_deflection)
    text = (resources.files(__package__) / "fortran" / "appendix_e.f").read_text("utf-8")
    heading = "".join(commented(_heading(properties)))
    return FricSubroutine(heading + text, properties, _STATE_VARIABLES, moves_base=False)


def _heading(properties: Sequence[float]) -> list[str]:
    meaning = (
        "coefficient of friction",
        "Dahl's exponent",
        "SMAX, deflection of the asperities at full friction, m",
    )
    return [
        "User subroutine FRIC for Abaqus/Standard, written by asperity: the scheme of Appendix E "
        "of the thesis, to repeat what it gives. It is not a sound law of friction.",
        "",
        "ETA, the share of the motion across the sliding that reaches the contact, is left out, as "
        "in Appendix E. Where the slip of one increment passes SMAX friction is MU P, and the root "
        "of the asperity and its deflection stay as they were: from then on friction points along "
        "the whole way slid since, however the surfaces slide now, and works can be gained. What "
        "it gives depends on the increment.",
        "",
        "The scheme tells the two directions of slip apart: 1 must be along the sliding, 2 across. "
        "Slip directions that turn with the surface are not followed. SI units: m, s, Pa.",
        "",
        "PROPS, and what this case gives:",
        *(
            f"{i:3d}  {word}: {value:.10g}"
            for i, (word, value) in enumerate(zip(meaning, properties, strict=True), start=1)
        ),
        "",
        "STATEV: 1, 2 way slid along both directions, 3, 4 root of the asperity along both, 5 its "
        "deflection; m.",
        "",
    ]
