"""Efficiency and load capacity of worm gearsets by three standards."""

from asperity.rating.parameters import LoadStep, Operation, RatingOptions
from asperity.rating.rate import Rated, rate, rate_case
from asperity.rating.variants import Variants, variants
from asperity.rating.wanted import STANDARDS

__all__ = [
    "STANDARDS",
    "LoadStep",
    "Operation",
    "Rated",
    "RatingOptions",
    "Variants",
    "rate",
    "rate_case",
    "variants",
]
