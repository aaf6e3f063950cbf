"""How every long work runs: under a key of all it follows from, kept, interrupted, resumed."""

from asperity.runs.interrupt import Interrupted, Stopped
from asperity.runs.run import Run

__all__ = ["Interrupted", "Run", "Stopped"]
