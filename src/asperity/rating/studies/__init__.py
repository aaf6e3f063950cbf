"""Studies of a worm gearset: sensitivity, ways to less friction, optimum, trade-off, catalogue."""

from asperity.rating.studies.catalogue import Catalogue, search
from asperity.rating.studies.comparison import Compared, Comparison
from asperity.rating.studies.design import Bounds
from asperity.rating.studies.methods import compare, compare_case
from asperity.rating.studies.optimise import Limit, Optimum, optimise
from asperity.rating.studies.reported import Method, reported_methods
from asperity.rating.studies.sensitivity import Influence, Sensitivity, sensitivity
from asperity.rating.studies.tradeoff import TradeOff, trade_off

__all__ = [
    "Bounds",
    "Catalogue",
    "Compared",
    "Comparison",
    "Influence",
    "Limit",
    "Method",
    "Optimum",
    "Sensitivity",
    "TradeOff",
    "compare",
    "compare_case",
    "optimise",
    "reported_methods",
    "search",
    "sensitivity",
    "trade_off",
]
