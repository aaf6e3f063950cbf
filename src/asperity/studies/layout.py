"""How studies lay out what they found: labelled datasets, efficiencies in percent."""

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

Labelled = tuple[tuple[str, ...], Any, str, str]


def labelled(title: str, coordinates: dict[str, Labelled], **variables: Labelled) -> "xr.Dataset":
    """Return a dataset of variables given as (dimensions, values, units, long name)."""
    import xarray as xr

    def named(group: dict[str, Labelled]) -> dict[str, Any]:
        return {
            name: (dims, values, {"units": units, "long_name": long_name})
            for name, (dims, values, units, long_name) in group.items()
        }

    return xr.Dataset(named(variables), named(coordinates), {"title": title})


def words(values: Any) -> Any:
    """Return texts as an array that a dataset holds."""
    return np.array(list(values), dtype=object)


def points(change: float) -> str:
    """Return a change of an efficiency in points."""
    return f"{100.0 * change:+.1f}"


def percent(efficiency: float) -> str:
    """Return an efficiency in percent."""
    return "-" if np.isnan(efficiency) else f"{100.0 * efficiency:.1f}"
