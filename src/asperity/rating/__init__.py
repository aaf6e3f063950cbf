"""Efficiency and load capacity of worm gearsets by three standards.

:Entry: `rate` and `rate_case`, `asperity rate`; `variants` for arrays.
:Data: `[operation]` and `[rating]` (`parameters`) beside `[gearset]`; tables of the standards in
    `data/`.
:Where: a standard a folder, a formula a function: `iso14521`, `bs721`, `agma6034`; `inputs` (what
    they start from), `standing` and `verdict` (what they come to), `forces`, `self_locking`,
    `workbook`.
:Tests: `unit/test_rate*`, `unit/test_rating_*`, `literature/test_iso14521*`,
    `literature/test_bs721`, `literature/test_agma6034`, `property/test_rat*`.
"""

from asperity.rating.housing import Housing
from asperity.rating.load_steps import LoadStep, SpectrumStep
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate, rate_case
from asperity.rating.rated import Rated
from asperity.rating.spectrum import Spectrum
from asperity.rating.standards import STANDARDS
from asperity.rating.variants import Variants, variants

__all__ = [
    "STANDARDS",
    "Housing",
    "LoadStep",
    "Operation",
    "Rated",
    "RatingOptions",
    "Spectrum",
    "SpectrumStep",
    "Variants",
    "rate",
    "rate_case",
    "variants",
]
