"""Efficiency and load capacity of worm gearsets by three standards."""

from asperity.rating.housing import Housing
from asperity.rating.load_steps import LoadStep, SpectrumStep
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import Rated, rate, rate_case
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
