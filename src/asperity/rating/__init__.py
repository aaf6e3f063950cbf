"""Efficiency and load capacity of worm gearsets by three standards."""

from asperity.rating.parameters import LoadStep, Operation, RatingOptions
from asperity.rating.rate import STANDARDS, Rated, rate, rate_case

__all__ = ["STANDARDS", "LoadStep", "Operation", "Rated", "RatingOptions", "rate", "rate_case"]
