"""Whether a gearset holds, on one screen: what a rating comes to before its numbers."""

import math
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from asperity.rating.alternatives import Alternative
from asperity.rating.demands import DEMANDS, Demand
from asperity.rating.levers import Lever
from asperity.rating.regime import Film
from asperity.rating.result import Rating
from asperity.rating.self_locking import SelfLocking
from asperity.results.quantity import Number, Sentence

NAMES = {"iso14521": "ISO/TR 14521", "bs721": "BS 721", "agma6034": "AGMA 6034"}
"""What people call the standards."""

_WIDTH = 79
_LONGEST = 3.0
_BAR = 27
_MOST_LEVERS = 3
_MOST_REMARKS = 3
_MOST_LINES = 23


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
        return f"{d.symbol} {self.value:.3g} of {d.asked:g}{'' if self.holds else '  FAILS'}"

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
        Safeties that have no answer, as ``standard.key``.
    levers : tuple of Lever
        What moves the least of them, the strongest first.
    alternatives : tuple of Alternative
        The oil and the wheel material of those with a name that bring most of it.
    film : Film or None
        The oil between the teeth, by ISO/TR 14521.
    wear_assumed : str
        What is to be said of the torque that wear is judged by.
    """

    safeties: tuple[Safety, ...]
    unrated: tuple[str, ...]
    levers: tuple[Lever, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    film: Film | None = None
    wear_assumed: str = ""

    @classmethod
    def of(
        cls,
        found: Mapping[str, Rating],
        levers: tuple[Lever, ...] = (),
        alternatives: tuple[Alternative, ...] = (),
        wear_assumed: str = "",
    ) -> "Verdict":
        """Return the verdict of ratings by standard."""
        asked = [demand for demand in DEMANDS if demand.standard in found]
        rated = {d: found[d.standard][d.key] for d in asked if d.key in found[d.standard]}
        return cls(
            tuple(Safety(demand, float(value)) for demand, value in rated.items()),
            tuple(demand.path for demand in asked if demand not in rated),
            levers,
            alternatives,
            Film.of(found["iso14521"]) if "h_min_um" in found.get("iso14521", ()) else None,
            wear_assumed if any(demand.name == "wear" for demand in rated) else "",
        )

    def __repr__(self) -> str:
        said = [line for sentence in self.sentences() for line in _wrapped(sentence)]
        return "\n".join((*said, *self.bars()))

    @property
    def first(self) -> Safety | None:
        """The safety that fails first: the least over what is asked; None without any."""
        return min(self.safeties, key=lambda safety: safety.margin, default=None)

    @property
    def holds(self) -> dict[str, bool]:
        """Whether it holds, by standard."""
        standards = dict.fromkeys(
            (
                *(s.demand.standard for s in self.safeties),
                *(p.partition(".")[0] for p in self.unrated),
            )
        )
        return {
            name: all(s.holds for s in self.safeties if s.demand.standard == name)
            and not any(path.startswith(f"{name}.") for path in self.unrated)
            for name in standards
        }

    def to_json(self) -> dict[str, Any]:
        """Return everything by key."""
        first = self.first
        return {
            "holds": self.holds,
            "first": None if first is None else first.demand.path,
            "safeties": [safety.to_json() for safety in self.safeties],
            "unrated": list(self.unrated),
            "moved_by": [
                {"name": lever.name, "keys": list(lever.keys), "exponent": lever.exponent}
                for lever in self.levers
            ],
            "alternatives": [other._asdict() for other in self.alternatives],
            "film": None if self.film is None else self.film.to_json(),
        }

    def sentences(self) -> Iterator[str]:
        """Yield whether it holds, and what fails first."""
        holds = [NAMES[name] for name, holds in self.holds.items() if holds]
        fails = [NAMES[name] for name, holds in self.holds.items() if not holds]
        parts = [f"does not hold by {_and(fails)}"] if fails else []
        parts += [f"holds by {_and(holds)}"] if holds else []
        yield "; ".join(parts)
        first = self.first
        if first is None:
            return
        d, own = first.demand, f"verdict.safeties.{self.safeties.index(first)}"
        said: list[str] = [
            f"{'nearest to its limit' if first.holds else 'first to fail'}: {d.name} by "
            f"{NAMES[d.standard]}, {d.symbol} ",
            Number.of(first.value, ".3g", f"{own}.value"),
            " of the ",
            Number.of(d.asked, "g", f"{own}.asked"),
            " asked",
        ]
        if self.levers:
            strongest = (
                lever.told(f"verdict.moved_by.{place}")
                for place, lever in enumerate(self.levers[:_MOST_LEVERS])
            )
            said += ["; a percent of it brings most: ", Sentence.joined(strongest)]
        yield Sentence(*said)
        if self.alternatives:
            better = (
                other.told(d.asked, f"verdict.alternatives.{place}")
                for place, other in enumerate(self.alternatives)
            )
            yield Sentence("best listed: ", Sentence.joined(better))

    def bars(self) -> Iterator[str]:
        """Yield a line each safety: its bar up to three times what is asked, and numbers.

        Below them what the bars of wear are judged by, where it is assumed.
        """
        if not self.safeties:
            return
        unit = _BAR // int(_LONGEST)
        scale = "".join(f"{number:>{unit}}" for number in range(1, int(_LONGEST) + 1))
        yield f"{'':26}{scale}  times what is asked"
        for safety in self.safeties:
            d = safety.demand
            name = f"{NAMES[d.standard]} {d.name}"
            yield f"{name:25} {bar(safety.margin)} {safety.said}"
        yield from _wrapped(self.wear_assumed)


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


def power_lines(iso: Rating) -> Iterator[str]:
    """Yield efficiency and losses of a rating by ISO/TR 14521."""

    def number(key: str, form: str, times: float = 1.0) -> Number:
        return Number.of(float(iso[key]), form, f"iso14521.{key}", times)

    parts = {"teeth": "meshing", "idling": "idle", "bearings": "bearing", "seals": "seal"}
    keys = {name: f"loss_{key}_W" for name, key in parts.items()}
    # Three digits say enough, and the line stays one.
    shares = (
        Sentence(f"{name} ", number(key, ".0f" if float(iso[key]) >= 100.0 else ".3g"))
        for name, key in keys.items()
    )
    yield Sentence(
        "efficiency ", number("eta_ges", ".1f", 100.0), " % of the gearbox, ",
        number("eta_z1_2", ".1f", 100.0), " % of the teeth (ISO/TR 14521)",
    )  # fmt: skip
    yield Sentence(
        "losses ", number("loss_total_W", ".4g"), " W of ", number("input_power_W", ".4g"), " W: ",
        Sentence.joined(shares, " + "),
    )  # fmt: skip


def locking_line(locking: SelfLocking) -> str:
    """Return whether the worm locks itself, in a sentence."""
    said = []
    for state, words in (("static", "at rest"), ("dynamic", "in motion")):
        own = [verdict for verdict in locking if verdict.state == state]
        locks = [NAMES.get(v.standard, "the given friction") for v in own if v.locks]
        if locks:
            alone = "" if len(locks) == len(own) else f" by {_and(locks)} alone"
            said.append(f"{words}{alone}")
    locked = f"locks itself {', '.join(said)}" if said else "does not lock itself"
    angles = [math.degrees(math.atan(v.friction)) for v in locking]
    lead = Number.of(math.degrees(locking.lead_angle), ".3g", "self_locking.lead_angle_deg")
    spread = f", friction {min(angles):.2g} to {max(angles):.2g} deg" if angles else ""
    return Sentence(f"{locked} (lead angle ", lead, f" deg{spread})")


def screen(
    verdict: Verdict,
    found: Mapping[str, Rating],
    locking: SelfLocking,
    assumed: int,
    notes: Iterable[str],
) -> str:
    """Return what is shown first: the verdict, at most 23 lines of 79 characters."""
    lines: list[str] = []
    for sentence in verdict.sentences():
        lines += _wrapped(sentence)
    lines += ["", *verdict.bars(), ""]
    if "iso14521" in found:
        for line in power_lines(found["iso14521"]):
            lines += _wrapped(line)
    if verdict.film is not None:
        lines += _wrapped(verdict.film.sentence())
    lines += _wrapped(locking_line(locking))
    remarks = [
        *notes,
        *(text for rating in found.values() for text in rating.violations),
    ]
    shown = remarks[: max(1, min(_MOST_REMARKS, _MOST_LINES - 1 - len(lines)))]
    for remark in shown:
        lines.append(textwrap.shorten(f"- {remark}", _WIDTH, placeholder=" ..."))
    memory = len({entry.key for rating in found.values() for entry in rating if entry.from_memory})
    more = len(remarks) - len(shown)
    lines.append(
        f"assumed {assumed} keys, {memory} numbers rest on sources from memory"
        f"{f', {more} more remarks' if more > 0 else ''}: --full"
    )
    return "\n".join(lines)


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _WIDTH, subsequent_indent="  ", break_on_hyphens=False)


def _and(words: list[str]) -> str:
    return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)
