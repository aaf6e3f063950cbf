"""How long a gearset would run under its load spectrum, its steps in the same shares all along.

Each limit is where a safety falls to 1: the depth that may be worn off, the damage that pits, the
root that wear leaves too thin, and by BS 721 the equivalent hours at which its life factors have
come down to the load. What does not hold at once lasts no hours; what no running time brings down
has none.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating
from asperity.rating.standing import NAMES
from asperity.results.quantity import Quantities, quantity
from asperity.results.table import Table, table_of_rows
from asperity.results.words import Number, Sentence

_ROOT = 1.06  # of the wear that the root of a tooth loses, as in its thickness
_PITTING_CAP = 1.6


class Endurance(Quantities):
    """How long it runs until one limit; 0 h where it does not hold at once."""

    standard: str = quantity("", "", "whose limit it is")
    name: str = quantity("", "", "what ends it")
    hours: float = quantity("t", "h", "running time")

    def sentence(self, asked: float, key: str = "") -> Sentence:
        """Return it in words, beside the running time that is asked for, h."""
        form = ",.0f" if self.hours >= 100.0 else ".3g"
        return Sentence(
            "life ", Number.of(self.hours, form, key and f"{key}.hours_h"), " h of ",
            f"{asked:,.4g} asked, until {self.name} by {NAMES[self.standard]}",
        )  # fmt: skip


def endurance_table(rows: Sequence[Endurance]) -> Table:
    """Return the running time until each limit as a table."""
    return table_of_rows(
        rows,
        {"standard": lambda row: NAMES[row.standard], "until": "name", "hours": "hours"},
        title="Running time until each limit",
        remarks=("with the loads in the same shares all along, until a safety is 1",),
        within="endurance",
    )


def endurance(given: Inputs, found: Mapping[str, Rating]) -> tuple[Endurance, ...]:
    """Return the running time until each limit, the shortest first.

    Parameters
    ----------
    given : Inputs
        What was rated.
    found : mapping of str to Rating
        Its ratings, by standard.
    """
    hours = float(given.total(part.hours for part in given.loads) if given.duty else given.life)
    rows = [
        Endurance(standard=standard, name=name, hours=hours * max(float(factor), 0.0))
        for standard, name, factor in (*_by_iso(given, found), *_by_bs(found))
        if math.isfinite(factor)
    ]
    return tuple(sorted(rows, key=lambda row: row.hours))


def _by_iso(given: Inputs, found: Mapping[str, Rating]) -> Iterator[tuple[str, str, float]]:
    iso: Any = found.get("iso14521", {})
    if "safety_wear" in iso:
        yield "iso14521", "wear", iso["safety_wear"]
    if "safety_pitting" in iso:
        of_25000 = iso["safety_pitting"] / iso["Z_h"]
        relief = _or(iso, "relief", 1.0)
        equivalent = _or(iso, "L_He_h", given.life)
        holds = _PITTING_CAP * relief * of_25000 >= 1.0
        yield "iso14521", "pitting", (25000.0 / equivalent * of_25000**6 if holds else 0.0)
    if "safety_root" in iso and "safety_wear" in iso:
        yield "iso14521", "root", _of_root(given, iso)


def _or(rating: Any, key: str, other: Any) -> Any:
    return rating[key] if key in rating else other  # noqa: SIM401 - a Rating has no get


def _of_root(given: Inputs, iso: Any) -> float:
    """How many times as long it runs until wear leaves too thin a root."""
    worn = min(iso["delta_Wn_mm"], iso["delta_Wlim_mm"])
    # The safety goes with the thickness, which goes down with the wear.
    room = iso["s_ft2_mm"] * (1.0 - 1.0 / iso["safety_root"])
    borne = worn + room * math.cos(float(given.lead_angle)) / _ROOT
    return borne / iso["delta_Wn_mm"] if borne <= iso["delta_Wlim_mm"] else math.inf


def _by_bs(found: Mapping[str, Rating]) -> Iterator[tuple[str, str, float]]:
    bs: Any = found.get("bs721", {})
    if "safety_wear" in bs:
        of_26000 = bs["safety_wear"] / bs["wear_life_factor"]
        yield "bs721", "wear", (27000.0 * of_26000**3 - 1000.0) / bs["U_w_h"]
    if "safety_strength" in bs:
        of_26000 = bs["safety_strength"] / bs["strength_life_factor"]
        yield "bs721", "strength", (26200.0 * of_26000**7 - 200.0) / bs["U_s_h"]
