"""How studies lay out what they found: texts of datasets, efficiencies in percent."""

from typing import Any

import numpy as np


def words(values: Any) -> Any:
    """Return texts as an array that a dataset holds."""
    return np.array(list(values), dtype=object)


def points(change: float) -> str:
    """Return a change of an efficiency in points."""
    return f"{100.0 * change:+.1f}"


def percent(efficiency: float) -> str:
    """Return an efficiency in percent."""
    return "-" if np.isnan(efficiency) else f"{100.0 * efficiency:.1f}"
