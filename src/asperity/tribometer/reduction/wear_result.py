"""What a disc lost over the distance of a wear test, told."""

import math
from collections.abc import Iterator, Mapping, Sequence

from asperity.results import Quantities, measured, quantity
from asperity.results.interval import numbers_of
from asperity.results.table import Table
from asperity.tribometer.uncertainty import Budget, Budgeted

_UNIT = "mm3/(N m)"
_ENDS = "low", "high"


class WearResult(Quantities):
    """What a disc lost in a run of a wear test, by force and path."""

    disc: str = quantity("", "", "disc")
    setting: str = quantity("", "", "run of the plan, as its journal names it")
    mode: str = quantity("", "", "direction of the vibration")
    lubricant: str = quantity("", "", "lubricant")
    frequency: float = quantity("f", "Hz", "frequency of the vibration; 0: none")
    weighings: int = quantity("", "", "weighings")
    distance: float = quantity("s", "m", "sliding distance")
    shaken_distance: float = quantity("", "m", "sliding distance with vibration")
    path: float | None = quantity("", "m", "path of the discs on each other, vibration counted")
    mass_loss: float = quantity("", "mg", "mass lost from the first weighing to the last")
    wear_rate: Budgeted | None = measured(
        "k", _UNIT, "volume lost by force and path", key="wear_rate_mm3_per_Nm"
    )
    wear_rate_by_distance: Budgeted | None = measured(
        "k_s", _UNIT, "volume lost by force and sliding distance",
        key="wear_rate_by_distance_mm3_per_Nm",
    )  # fmt: skip
    archard: float | None = quantity("K", "", "Archard's coefficient, on the path", default=None)

    @property
    def budgets(self) -> dict[str, Budget]:
        """What each rate is uncertain by."""
        found = {name: getattr(self, name) for name in ("wear_rate", "wear_rate_by_distance")}
        return {name: one.budget for name, one in found.items() if one is not None}

    @property
    def condition(self) -> tuple[str, str, str]:
        """What a run with vibration and one without have in common."""
        return self.disc, self.mode, self.lubricant


def ratios(rates: Sequence[WearResult]) -> Iterator[str]:
    """Yield by how much vibration changes the wear over a distance, in sentences."""
    still: Mapping[tuple[str, str, str], WearResult] = {
        one.condition: one for one in rates if not one.frequency
    }
    for one in rates:
        base = still.get(one.condition)
        if not one.frequency or base is None:
            continue
        a, b = one.wear_rate_by_distance, base.wear_rate_by_distance
        if a is None or b is None or b.low <= 0.0:
            continue
        ratio = a.value / b.value
        # Halves of intervals, as of a product of independent numbers.
        half = math.hypot((a.high - a.value) / b.value, ratio * (b.high - b.value) / b.value)
        yield (
            f"{one.disc} disc, {one.frequency:g} Hz {one.mode}: over the same distance, "
            f"{100.0 * one.shaken_distance / one.distance:.3g} % of it shaken, "
            f"{ratio:.3g} ({ratio - half:.3g} to {ratio + half:.3g}) times the wear without "
            "vibration"
            + ("" if one.path is None else f", on {one.path / one.distance:.3g} times the path")
        )


def path_text(path: float | None) -> str:
    """Return a path in words, m; None where it is not known."""
    if path is None:
        return "on a path that is not known, since k is not of every vibration"
    return f"{path:.3g} m with the vibration's path"


def wear_table(rates: Sequence[WearResult]) -> Table:
    """Return a row for each disc of each run, and below what vibration changes."""
    rows = [
        (one.setting, one.disc, *("" if number is None else f"{number:.4g}" for number in (
            one.frequency, one.distance, one.path)), f"{one.mass_loss:.3g}",
         *("" if number is None else f"{number:.4g}" for number in (
             *numbers_of(one.wear_rate), one.archard)))
        for one in rates
    ]  # fmt: skip
    heads = (
        "run", "disc", "f Hz", "distance m", "path m", "lost mg", f"k {_UNIT}", *_ENDS, "K",
    )  # fmt: skip
    return Table.of(heads, rows, left=2, title="Wear over distance", remarks=tuple(ratios(rates)))
