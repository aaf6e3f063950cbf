"""Whether a gearset holds, on one screen: what a rating comes to before its numbers."""

import math
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from asperity.rating.demands import DEMANDS, Demand
from asperity.rating.levers import Alternative, Lever
from asperity.rating.regime import Film
from asperity.rating.result import Rating
from asperity.rating.self_locking import SelfLocking
from asperity.rating.standing import NAMES, WIDTH, Standing, listed, wrapped
from asperity.rating.verdict_rows import Row
from asperity.results.language import said
from asperity.results.unit_systems import shown_text
from asperity.results.words import Number, Sentence

_LONGEST = 3.0
_BAR = 27
_NAMES = 24
_MOST_LEVERS = 3
_MOST_REMARKS = 3
_MOST_LINES = 23
_SHORT_LINES = 14


class Safety(NamedTuple):
    """A safety against what is asked of it.

    Attributes
    ----------
    demand : Demand
        What is asked.
    value : float
        What there is.
    """

    demand: Demand
    value: float

    @property
    def margin(self) -> float:
        """What there is over what is asked."""
        return self.value / self.demand.asked

    @property
    def holds(self) -> bool:
        """Whether it is enough."""
        return self.value >= self.demand.asked

    @property
    def said(self) -> str:
        """What there is of what is asked, and that it fails where it does."""
        d = self.demand
        fails = "" if self.holds else f"  {said('FAILS')}"
        return f"{d.symbol} {_short(self.value)} {said('of')} {d.asked:g}{fails}"

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        d = self.demand
        named = {"standard": d.standard, "key": d.key, "symbol": d.symbol, "name": d.name}
        return {**named, "value": self.value, "asked": d.asked, "holds": self.holds}


class Verdict(NamedTuple):
    """Whether a gearset holds.

    Attributes
    ----------
    safeties : tuple of Safety
        Of every standard that it was rated by, in their order.
    unrated : tuple of str
        Safeties that have no answer, as ``standard.key``, of standards that have others.
    standing : tuple of Standing
        What each standard comes to, those without any answer too.
    levers : tuple of Lever
        What moves the least of them, the strongest first.
    alternatives : tuple of Alternative
        The oil and the wheel material of those with a name that bring most of it.
    film : Film or None
        The oil between the teeth, by ISO/TR 14521.
    wear_assumed : str
        What is to be said of the torque that wear is judged by.
    rows : tuple of Row
        What others than the three standards say, of shafts and bearings for one.
    heat_assumed : str
        What is to be said of a duty that temperature is not judged by.
    """

    safeties: tuple[Safety, ...]
    unrated: tuple[str, ...]
    standing: tuple[Standing, ...] = ()
    levers: tuple[Lever, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    film: Film | None = None
    wear_assumed: str = ""
    rows: tuple[Row, ...] = ()
    heat_assumed: str = ""

    @classmethod
    def of(
        cls,
        ratings: Mapping[str, Rating],
        levers: tuple[Lever, ...] = (),
        alternatives: tuple[Alternative, ...] = (),
        wear_assumed: str = "",
        unanswered: Mapping[str, str] | None = None,
        rows: tuple[Row, ...] = (),
        heat_assumed: str = "",
    ) -> "Verdict":
        """Return the verdict of ratings by standard; why others have no answer, likewise.

        Parameters
        ----------
        ratings : mapping of str to Rating
            By standard.
        levers : tuple of Lever
            What raises a safety, and how much.
        alternatives : tuple of Alternative
            What would hold in the place of what is asked.
        wear_assumed : str
            What was assumed of the torque that wears; empty for nothing.
        unanswered : mapping of str to str, optional
            Why a standard has no answer.
        rows : tuple of Row
            Of what is not of the standards, such as bearings.
        heat_assumed : str
            What was assumed of a duty's heat; empty for nothing.

        Returns
        -------
        Verdict
            Safeties, and where each standard stands.
        """
        asked = [demand for demand in DEMANDS if demand.standard in ratings]
        rated = {d: ratings[d.standard][d.key] for d in asked if d.key in ratings[d.standard]}
        return cls(
            tuple(Safety(demand, float(value)) for demand, value in rated.items()),
            tuple(demand.path for demand in asked if demand not in rated),
            tuple(Standing.of(ratings, unanswered or {})),
            levers,
            alternatives,
            Film.of(ratings["iso14521"]) if "h_min_um" in ratings.get("iso14521", ()) else None,
            wear_assumed if any(demand.name == "wear" for demand in rated) else "",
            rows,
            heat_assumed if any(demand.name == "temperature" for demand in rated) else "",
        )

    def __repr__(self) -> str:
        said = [line for text in (*self.stands(), *self.nearest()) for line in wrapped(text)]
        best, bars = [line for text in self.best() for line in wrapped(text)], [*self.bars()]
        short = len(said) + len(best) + len(bars) <= _SHORT_LINES
        return "\n".join((*said, *(best if short else ()), *bars))

    @property
    def first(self) -> Safety | None:
        """The safety of the standards that fails first: the least over what is asked; or None."""
        return min(self.safeties, key=lambda safety: safety.margin, default=None)

    @property
    def holds(self) -> dict[str, bool | None]:
        """Whether it holds, by standard; None where one cannot tell."""
        return {one.standard: one.holds for one in self.standing}

    def to_json(self) -> dict[str, Any]:
        """Return everything by key."""
        first = self.first
        return {
            "holds": self.holds,
            "first": None if first is None else first.demand.path,
            "safeties": [safety.to_json() for safety in self.safeties],
            "unrated": list(self.unrated),
            "standing": {one.standard: one.to_json() for one in self.standing},
            "moved_by": [
                {"name": lever.name, "keys": list(lever.keys), "exponent": lever.exponent}
                for lever in self.levers
            ],
            "alternatives": [other._asdict() for other in self.alternatives],
            "film": None if self.film is None else self.film.to_json(),
            **self._beside(),
        }

    def _beside(self) -> dict[str, Any]:
        """Return the rows by key, and which number is the least of all; nothing without rows."""
        if not self.rows:
            return {}
        every: list[Safety | Row] = [*self.safeties, *self.rows]
        place, known = every.index(min(every, key=lambda one: one.margin)), len(self.safeties)
        least = f"safeties.{place}" if place < known else f"rows.{place - known}"
        return {"least": least, "rows": [row.to_json() for row in self.rows]}

    def stands(self, whole: bool = False) -> Iterator[str]:
        """Yield by which standards it holds, which have no answer, and which rate outside.

        Parameters
        ----------
        whole : bool
            Whether reasons are told in full.

        Yields
        ------
        str
            One of each kind that there is.
        """
        failing = [f"{row.name} by {row.standard}" for row in self.rows if not row.holds]
        if failing:
            yield f"does not hold: {listed(failing)}"
        yield from Standing.sentences(self.standing, whole)
        if not failing and self.rows and not self.safeties:
            yield f"holds by {listed([*dict.fromkeys(row.standard for row in self.rows)])}"

    def sentences(self) -> Iterator[str]:
        """Yield whether it holds, and what fails first."""
        yield from self.stands(whole=True)
        yield from self.nearest()
        yield from self.best()

    def nearest(self) -> Iterator[Sentence]:
        """Yield what fails first or is nearest to it, and what moves that most."""
        first = self.first
        place, row = min(enumerate(self.rows), key=lambda one: one[1].margin, default=(0, None))
        beside = row is not None and (first is None or row.margin < first.margin)
        if row is not None and beside:
            yield row.nearest(f"verdict.rows.{place}")
        if first is None:
            return
        d, own = first.demand, f"verdict.safeties.{self.safeties.index(first)}"
        is_first = "nearest to its limit" if first.holds else "first to fail"
        said: list[str] = [
            f"{'least by the standards' if beside else is_first}: {d.name} by "
            f"{NAMES[d.standard]}, {d.symbol} ",
            Number.of(first.value, ".3g", f"{own}.value"),
            " of the ",
            Number.of(d.asked, "g", f"{own}.asked"),
            " asked",
        ]
        if self.levers:
            strongest = (
                lever.sentence(f"verdict.moved_by.{place}")
                for place, lever in enumerate(self.levers[:_MOST_LEVERS])
            )
            said += ["; a percent of it brings most: ", Sentence.joined(strongest)]
        yield Sentence(*said)

    def best(self) -> Iterator[Sentence]:
        """Yield which other oil and material with a name would bring most of it."""
        first = self.first
        if self.alternatives and first is not None:
            better = (
                other.sentence(first.demand.asked, f"verdict.alternatives.{place}")
                for place, other in enumerate(self.alternatives)
            )
            yield Sentence("best listed: ", Sentence.joined(better))

    def bars(self) -> Iterator[str]:
        """Yield a line each safety: its bar up to three times what is asked, and numbers.

        Below them what the bars of wear are judged by, where it is assumed.
        """
        if not self.safeties and not self.rows:
            return
        names = [f"{NAMES[one.demand.standard]} {said(one.demand.name)}" for one in self.safeties]
        wide = max([_NAMES, *map(len, names)])
        unit = _BAR // int(_LONGEST)
        scale = "".join(f"{number:>{unit}}" for number in range(1, int(_LONGEST) + 1))
        if self.safeties:
            yield f"{'':{wide + 1}}{scale}  {said('times what is asked')}"
        for name, safety in zip(names, self.safeties, strict=True):
            yield f"{name:{wide}} {bar(safety.margin)} {safety.said}"
        for row in self.rows:
            yield from wrapped(row.line)
        yield from wrapped(self.wear_assumed)
        yield from wrapped(self.heat_assumed)


def _short(value: float) -> str:
    """Return a safety in three digits, in fewer where it is small: a line of bars has 79 signs."""
    text = f"{value:.3g}"
    if value >= 1.0 or len(text) <= 5:
        return text
    return f"{value:.2g}" if value >= 0.01 else "<0.01"


def bar(margin: float) -> str:
    """Return a margin as a bar with a mark at 1.

    Examples
    --------
    >>> bar(0.5).rstrip(), bar(2.0).rstrip()
    ('####    |', '########|#########')
    """
    one = int(_BAR / _LONGEST) - 1
    filled = min(round(margin * _BAR / _LONGEST), _BAR) if math.isfinite(margin) else 0
    # What does not reach the mark never seems to.
    filled = min(filled, one) if margin < 1.0 else max(filled, one + 1)
    signs = ["#" if place < filled else " " for place in range(_BAR)]
    signs[one] = "|"
    return "".join(signs) + (">" if margin > _LONGEST else " ")


def locking_line(locking: SelfLocking) -> str:
    """Return whether the worm locks itself, in a sentence."""
    said = []
    for state, words in (("static", "at rest"), ("dynamic", "in motion")):
        own = [verdict for verdict in locking if verdict.state == state]
        locks = [NAMES.get(v.standard, "the given friction") for v in own if v.locks]
        if locks:
            alone = "" if len(locks) == len(own) else f" by {listed(locks)} alone"
            said.append(f"{words}{alone}")
    locked = f"locks itself {', '.join(said)}" if said else "does not lock itself"
    angles = [math.degrees(math.atan(v.friction)) for v in locking]
    if not angles:
        locked = "no standard says whether it locks itself"
    lead = Number.of(math.degrees(locking.lead_angle), ".3g", "self_locking.lead_angle_deg")
    spread = f", friction {min(angles):.2g} to {max(angles):.2g} deg" if angles else ""
    return Sentence(f"{locked} (lead angle ", lead, f" deg{spread})")


def screen(
    verdict: Verdict,
    ratings: Mapping[str, Rating],
    locking: SelfLocking,
    assumed: int,
    notes: Iterable[str],
    *,
    power: Iterable[str],
    duty: Iterable[str] = (),
    play: Iterable[str] = (),
) -> str:
    """Return what is shown first: the verdict, in lines of at most 79 characters.

    At most 23 lines, unless the verdict itself takes more; what has no room is left to ``--full``.
    """
    first, best = verdict.nearest(), verdict.best()
    film = () if verdict.film is None else (verdict.film.sentence(),)
    # What is nearer to the verdict stays where there is no room for all.
    said = {f"{one.standard}: {reason}" for one in verdict.standing for reason in one.reasons}
    remarks = *(note for note in notes if note not in said), *_outside(ratings)
    kept = {"film": film, "remarks": remarks}
    blocks = {"stands": verdict.stands(), "first": first, "best": best, "power": power,
              "duty": duty, "locking": (locking_line(locking),), "play": play}  # fmt: skip
    lines = {name: [line for one in of for line in wrapped(one)] for name, of in blocks.items()}
    lines |= {"bars": ["", *verdict.bars(), ""], "film": [], "remarks": []}
    if sum(map(len, lines.values())) >= _MOST_LINES:
        lines["bars"] = lines["bars"][1:-1]
    shown = 0
    for name, texts in kept.items():
        for text in texts[:_MOST_REMARKS]:
            own = wrapped(text)
            if name == "remarks":
                own = [textwrap.shorten(f"- {shown_text(text)}", WIDTH, placeholder=" ...")]
            if len(own) <= _MOST_LINES - 1 - sum(map(len, lines.values())):
                lines[name] += own
                shown += name == "remarks"
    memory = len(
        {entry.key for rating in ratings.values() for entry in rating if entry.from_memory}
    )
    more = len(kept["remarks"]) - shown
    rest = "number rests" if memory == 1 else "numbers rest"
    further = f", {more} remark{'s' * (more > 1)}" if more > 0 else ""
    lines["end"] = wrapped(
        f"assumed {assumed} key{'s' * (assumed != 1)}, {memory} {rest} on sources from memory"
        f"{further}: --full"
    )
    order = (
        "stands", "first", "best", "bars", "power", "duty", "film", "locking", "play", "remarks",
        "end",
    )  # fmt: skip
    return "\n".join(line for name in order for line in lines[name])


def _outside(ratings: Mapping[str, Rating]) -> tuple[str, ...]:
    return tuple(text for rating in ratings.values() for text in (*rating.violations, *rating.gaps))
