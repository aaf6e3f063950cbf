"""How long a gearset would run under its load spectrum, its steps in the same shares all along.

Each limit is where a safety falls to what is asked of it, and after that to 1: the depth that may
be worn off, the damage that pits, the root that wear leaves too thin, and by BS 721 the equivalent
hours at which its life factors have come down to the load. What does not hold at once lasts no
hours; what no running time brings down has none.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from asperity.rating.demands import DEMANDS
from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating
from asperity.rating.standing import NAMES
from asperity.results.quantity import Quantities, quantity
from asperity.results.table import Cell, Table, table_of_rows
from asperity.results.words import Number, Sentence

_ROOT = 1.06  # of the wear that the root of a tooth loses, as in its thickness
_PITTING_CAP = 1.6
_COUNTED = 1e9  # hours that are written out


class Endurance(Quantities):
    """How long it runs until one limit; 0 h where it does not hold at once."""

    standard: str = quantity("", "", "whose limit it is")
    name: str = quantity("", "", "what ends it")
    asked: float = quantity("", "", "safety that is asked", key="asked_safety")
    lasting: float = quantity("t_a", "h", "until the safety that is asked is left", key="asked_h")
    hours: float | None = quantity("t", "h", "until a safety of 1 is left")

    def sentence(self, asked: float, key: str = "") -> Sentence:
        """Return it in words, beside the running time that is asked for, h."""
        required = f"{asked:,.0f}" if 1000.0 <= asked < _COUNTED else f"{asked:.4g}"
        symbol = next(
            d.symbol for d in DEMANDS if (d.standard, d.name) == (self.standard, self.name)
        )
        said: list[str] = [
            "life ", _hours(self.lasting, key and f"{key}.asked_h"),
            f" h of {required} asked until {symbol} is {self.asked:g}",
        ]  # fmt: skip
        if self.asked != 1.0 and self.hours is not None:
            said += [" (", _hours(self.hours, key and f"{key}.hours_h"), " h until 1)"]
        return Sentence(*said, f": {self.name} by {NAMES[self.standard]}")


def _hours(value: float, key: str) -> Number:
    return Number.of(value, ",.0f" if 100.0 <= value < _COUNTED else ".3g", key)


def endurance_table(rows: Sequence[Endurance]) -> Table:
    """Return the running time until each limit as a table."""
    return table_of_rows(
        rows,
        {
            "standard": lambda row: NAMES[row.standard],
            "until": "name",
            "S asked": "asked",
            "h until that": "lasting",
            "h until S = 1": Cell("hours", right=True),
        },
        title="Running time until each limit",
        remarks=("with the loads in the same shares all along",),
        within="endurance",
    )


def endurance(inputs: Inputs, ratings: Mapping[str, Rating]) -> tuple[Endurance, ...]:
    """Return the running time until each limit, the shortest first.

    Parameters
    ----------
    inputs : Inputs
        What was rated.
    ratings : mapping of str to Rating
        Its ratings, by standard.
    """
    hours = float(inputs.total(part.hours for part in inputs.loads) if inputs.duty else inputs.life)
    asked = {demand.path: demand.asked for demand in DEMANDS}
    lasting = dict(_factors(inputs, ratings, asked))
    at_all = dict(_factors(inputs, ratings, dict.fromkeys(asked, 1.0)))
    rows = [
        Endurance(
            standard=path.partition(".")[0],
            name=path.partition("_")[2],
            asked=asked[path],
            lasting=hours * max(factor, 0.0),
            hours=hours * max(at_all[path], 0.0) if math.isfinite(at_all[path]) else None,
        )
        for path, factor in lasting.items()
        if math.isfinite(factor)
    ]
    return tuple(sorted(rows, key=lambda row: row.lasting))


def _factors(
    inputs: Inputs, ratings: Mapping[str, Rating], least: Mapping[str, float]
) -> Iterator[tuple[str, float]]:
    """Yield how many times as long it runs until each safety is the least."""
    iso: Any = ratings.get("iso14521", {})
    if "safety_wear" in iso:
        yield (path := "iso14521.safety_wear"), float(iso["safety_wear"]) / least[path]
    if "safety_pitting" in iso:
        path = "iso14521.safety_pitting"
        of_25000 = float(iso["safety_pitting"]) / iso["Z_h"] / least[path]
        relief = _or(iso, "relief", 1.0)
        equivalent = _or(iso, "L_He_h", inputs.life)
        holds = _PITTING_CAP * relief * of_25000 >= 1.0
        yield path, float(25000.0 / equivalent * of_25000**6 if holds else 0.0)
    if "safety_root" in iso and "safety_wear" in iso:
        yield (path := "iso14521.safety_root"), float(_of_root(inputs, iso, least[path]))
    bs: Any = ratings.get("bs721", {})
    if "safety_wear" in bs:
        of_26000 = bs["safety_wear"] / bs["wear_life_factor"] / least["bs721.safety_wear"]
        yield "bs721.safety_wear", float((27000.0 * of_26000**3 - 1000.0) / bs["U_w_h"])
    if "safety_strength" in bs:
        path = "bs721.safety_strength"
        of_26000 = bs["safety_strength"] / bs["strength_life_factor"] / least[path]
        yield path, float((26200.0 * of_26000**7 - 200.0) / bs["U_s_h"])


def _or(rating: Any, key: str, other: Any) -> Any:
    return rating[key] if key in rating else other  # noqa: SIM401 - a Rating has no get


def _of_root(inputs: Inputs, iso: Any, least: float) -> float:
    """How many times as long it runs until wear leaves too thin a root."""
    worn = min(iso["delta_Wn_mm"], iso["delta_Wlim_mm"])
    # The safety goes with the thickness, which goes down with the wear.
    room = iso["s_ft2_mm"] * (1.0 - least / iso["safety_root"])
    borne = worn + room * math.cos(float(inputs.lead_angle)) / _ROOT
    return borne / iso["delta_Wn_mm"] if borne <= iso["delta_Wlim_mm"] else math.inf
