"""Words of the thesis as a machine read them, made comparable with words as we write them."""

import re

_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "ζ": "zeta", "η":
    "eta", "θ": "theta", "ι": "iota", "κ": "kappa", "λ": "lambda", "μ": "mu", "ν": "nu", "ξ":
    "xi", "ο": "omicron", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau", "υ": "upsilon", "φ":
    "phi", "χ": "chi", "ψ": "psi", "ω": "omega", "µ": "mu",
}  # fmt: skip
_SIGNS = {
    "\\cdot": "·", "⋅": "·", "\\times": "×", "\\leq": "<=", "\\le": "<=", "\\geq": ">=",
    "\\ge": ">=", "\\approx": "≈", "\\circ": "°", "−": "-", "‑": "-", "\\dot": "", "\\tilde": "",
    "\\overline": "", "\\mathbf": "", "\\boldsymbol": "", "\\bm": "", "\\text": "", "\\,": "",
    "\\mu": "mu", "₁": "1", "²": "2", "³": "3", "⁶": "6", "\\mathrm": "",
}  # fmt: skip


def plain(text: str) -> str:
    """Return a text without markup, blanks and capitals, Greek letters by their names."""
    for sign, instead in _SIGNS.items():
        text = re.sub(re.escape(sign) + ("(?![a-z])" if sign[-1].isalpha() else ""), instead, text)
    for letter, name in _GREEK.items():
        text = text.replace(letter, name)
    return re.sub(r"[$\\{}*_^~\s]", "", text).lower()
