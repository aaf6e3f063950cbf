"""Studies of a worm gearset: sensitivity, ways to less friction, optimum, trade-off, catalogue."""

from asperity.studies.catalogue import Catalogue, search
from asperity.studies.comparison import Compared, Comparison
from asperity.studies.design import Bounds
from asperity.studies.methods import compare, compare_case
from asperity.studies.optimise import Limit, Optimum, optimise
from asperity.studies.reported import Method, reported_methods
from asperity.studies.sensitivity import Influence, Sensitivity, sensitivity
from asperity.studies.tradeoff import TradeOff, trade_off

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
