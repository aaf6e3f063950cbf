"""Studies of a worm gearset: sensitivity, ways to less friction, optimum, trade-off, catalogue."""

from asperity.rating.studies.sensitivity import Influence, Sensitivity, sensitivity

__all__ = ["Influence", "Sensitivity", "sensitivity"]
