"""Texts with their symbols set: what is written as ``mu F_N`` in plain text, as HTML."""

import functools
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from markupsafe import Markup

_GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "eta": "η", "theta": "θ", "lambda": "λ",
    "mu": "µ", "nu": "ν", "phi": "φ", "rho": "ρ", "sigma": "σ", "tau": "τ",
}  # fmt: skip
_SIGNS = {
    "<=": "≤",
    r"\+-": "±",
    r"\bmu\b": "µ",
    r"\bdegC\b": "°C",
    r"\bum\b": "µm",
    r"\bmm2\b": "mm²",
    # A hyphen that does not break, between the side that drives and the side that is driven.
    r"\beta_z(\d)_(\d)": r"eta_z\1‑\2",
    **{rf"\b{name}_": f"{letter}_" for name, letter in _GREEK.items()},
}
_INDEXED = r"\b(Ra|[A-Za-zµα-ω])_(\w+(?:[,‑]\w+)?)"
_RAISED = r"\^(\([^()]*\)|-?[\d.]+)"


@functools.lru_cache(maxsize=4096, typed=True)
def typeset(text: str) -> "Markup":
    """Return a text as HTML with its symbols set: ``mu F_N``, ``eta_y``, ``<=``, ``q^0.5``.

    Examples
    --------
    >>> print(typeset("s_max <= 5 % of mu F_N"))
    s<sub>max</sub> ≤ 5 % of µ F<sub>N</sub>
    >>> print(typeset("d_m1^2 n_1^(4/3)"))
    d<sub>m1</sub><sup>2</sup> n<sub>1</sub><sup>(4/3)</sup>
    >>> print(typeset("gamma"))
    γ
    """
    from markupsafe import Markup, escape

    if text in _GREEK:
        return Markup(_GREEK[text])

    for plain, sign in _SIGNS.items():
        text = re.sub(plain, sign, text)
    indexed = re.sub(_INDEXED, r"\1<sub>\2</sub>", str(escape(text)))
    for name, letter in _GREEK.items():
        indexed = indexed.replace(f"<sub>{name}</sub>", f"<sub>{letter}</sub>")
    return Markup(re.sub(_RAISED, r"<sup>\1</sup>", indexed))
