r"""The backlash of a gearset as an interval: by worst case and by squares, warm and worn.

On the mean circle of the wheel, with allowances :math:`E \le 0` of the thicknesses, the deviation
:math:`f_a` of the centre distance and :math:`\tan\alpha_x = \tan\alpha_n/\cos\gamma`,

.. math:: j_t = -\left(\frac{E_{sn1}}{\cos\gamma} + E_{s2}\right) + 2 f_a\tan\alpha_x, \qquad
          j_n = j_t\cos\alpha_n\cos\gamma .

The worst case adds what each may be off by. The squares add their squares: of assemblies whose
deviations are normal, and within three standard deviations of their middle, 99.7 % lie within.
Warmth adds :math:`2a(\alpha_h\Delta T_h - \sum_i s_i\alpha_i\Delta T_i)\tan\alpha_x`, where
:math:`s_i` is the share of the centre distance that each material takes, and flanks that are worn
by :math:`\delta` normal to them add :math:`\delta/(\cos\alpha_n\cos\gamma)`. This is geometry, of
no standard, and no bound: exact flanks touch elsewhere at another centre distance, where they are
steeper, and know their hob. What a user is told is theirs, `asperity.flanks.study.rated_play`.
"""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from asperity.gearset.geometry import Geometry
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.allowances import Allowances
from asperity.gearset.tolerancing.table import Temperatures, Tolerances
from asperity.gearset.tolerancing.warmth import Warmth
from asperity.results.table import Column, Table
from asperity.results.words import Number, Sentence, text_of

GEOMETRY = "by geometry"
EXACT = "by the exact flanks"
_MICROMETRES = 1e3
# What is below this is rounding of allowances that leave nothing, um.
_ROUNDING = 1e-3
_ARCMINUTES = 60.0 * 180.0 / math.pi


class Part(NamedTuple):
    """What one deviation brings of the circumferential backlash, um: least, middle, greatest."""

    name: str
    least: float
    middle: float
    greatest: float


class Interval(NamedTuple):
    """Circumferential backlash on the mean circle of the wheel, um.

    Attributes
    ----------
    least, greatest : float
        By the worst case.
    likely_least, likely_greatest : float
        By the squares.
    """

    least: float
    greatest: float
    likely_least: float
    likely_greatest: float

    @classmethod
    def of(cls, parts: Iterable[Part]) -> "Interval":
        """Return the interval of deviations that are independent of each other."""
        found = tuple(parts)
        middle = math.fsum(part.middle for part in found)
        below = math.hypot(*(part.middle - part.least for part in found))
        above = math.hypot(*(part.greatest - part.middle for part in found))
        return cls(
            math.fsum(part.least for part in found),
            math.fsum(part.greatest for part in found),
            middle - below,
            middle + above,
        )

    def times(self, factor: float) -> "Interval":
        """Return it by another measure."""
        return Interval(*(factor * value for value in self))

    def rounded(self) -> "Interval":
        """Return it with what is rounding told as none."""
        return Interval(*(0.0 if abs(value) < _ROUNDING else value for value in self))


class Measure(NamedTuple):
    """A way to say a backlash: the name of its keys, its unit, and how much it is of j_t in um."""

    key: str
    symbol: str
    unit: str
    meaning: str
    factor: float


class Backlash(NamedTuple):
    """What tolerances leave of backlash.

    Attributes
    ----------
    states : mapping of str to Interval
        By ``new``, ``warm`` (where temperatures are given) and ``worn``, at the end of the life,
        where the wear is known; warm where that is known.
    parts : tuple of Part
        What each deviation brings, of a new gearbox, um.
    measures : tuple of Measure
        On the mean circle, normal, and as angles of wheel and worm.
    warmth, wear : float or None
        What both add on the mean circle, um.
    by : str
        What it is found by.
    allowances : Allowances
        What was allowed.
    """

    states: Mapping[str, Interval]
    parts: tuple[Part, ...]
    measures: tuple[Measure, ...]
    warmth: float | None
    wear: float | None
    by: str
    allowances: Allowances

    @property
    def least(self) -> float:
        """Least normal backlash of all states, um."""
        return min(one.least for one in self.states.values()) * self.measures[1].factor

    def rows(self) -> Iterator[tuple[str, str, str]]:
        """Yield a name, what it is by, and a value as text: a line each of a short screen."""
        wheel = self.measures[2]
        for name, interval in self.states.items():
            said = interval.times(wheel.factor)
            yield (
                f"backlash, {name}", self.by,
                f"{said.least:.3g} to {said.greatest:.3g} {wheel.unit} at the wheel "
                f"({said.likely_least:.3g} to {said.likely_greatest:.3g} likely)",
            )  # fmt: skip

    def sentence(self, key: str = "backlash") -> Sentence:
        """Return it in a sentence of the verdict.

        Parameters
        ----------
        key : str
            Where it stands in an answer's JSON.

        Returns
        -------
        Sentence
            With its numbers.
        """
        wheel = self.measures[2]
        new = self.states["new"].times(wheel.factor)

        def number(value: float, path: str) -> Number:
            return Number.of(value, ".3g", f"{key}.{path}")

        said: list[str] = [
            "backlash by geometry " if self.by == GEOMETRY else "backlash ",
            number(new.least, "new.wheel_min_arcmin"), " to ",
            number(new.greatest, "new.wheel_max_arcmin"), " arcmin at the wheel",
        ]  # fmt: skip
        if self.warmth is not None:
            more = self.warmth * wheel.factor
            said += [
                "; ",
                number(abs(more), "warm_arcmin"),
                f" {'more' if more >= 0 else 'less'} warm",
            ]
        if self.wear is not None:
            said += ["; ", number(self.wear * wheel.factor, "worn_arcmin"), " more when worn"]
        if self.least < 0.0:
            said += [": IT MAY JAM"]
        return Sentence(*said)

    def to_json(self) -> dict[str, Any]:
        """Return everything by key."""
        wheel = self.measures[2].factor
        states = {
            name: {
                f"{measure.key}_{end}_{measure.unit}": value
                for measure in self.measures
                for end, value in zip(
                    ("min", "max", "likely_min", "likely_max"),
                    interval.times(measure.factor),
                    strict=True,
                )
            }
            for name, interval in self.states.items()
        }
        off = self.allowances
        return {
            "by": self.by,
            **states,
            "warm_arcmin": None if self.warmth is None else abs(self.warmth) * wheel,
            "worn_arcmin": None if self.wear is None else self.wear * wheel,
            "parts": [
                {"name": part.name, "least_um": part.least, "greatest_um": part.greatest}
                for part in self.parts
            ],
            "allowances": {
                "centre_distance_mm": off.centre_distance,
                "thread_upper_mm": off.thread[0],
                "thread_lower_mm": off.thread[1],
                "tooth_upper_mm": off.tooth[0],
                "tooth_lower_mm": off.tooth[1],
                "fit_backlash_normal_mm": off.fit_backlash,
                "by": dict(off.words),
            },
        }

    def table(self, key: str = "backlash") -> Table:
        """Return a row for each measure of each state, and what each deviation brings.

        Parameters
        ----------
        key : str
            As of `sentence`.

        Returns
        -------
        Table
            Of the terminal, the page and the report.
        """
        rows: list[tuple[str, ...]] = []
        ends = "min", "max", "likely_min", "likely_max"
        for state, interval in self.states.items():
            for measure in self.measures:
                values = zip(ends, interval.times(measure.factor), strict=True)
                rows.append(
                    (
                        f"{state}: {measure.meaning}",
                        measure.symbol,
                        *(
                            text_of(value, key=f"{key}.{state}.{measure.key}_{end}_{measure.unit}")
                            for end, value in values
                        ),
                        measure.unit,
                    )
                )
        columns = (
            Column("", folds=True), Column("symbol", typeset=True), Column("least", right=True),
            Column("greatest", right=True), Column("likely least", right=True),
            Column("likely greatest", right=True), Column("unit"),
        )  # fmt: skip
        return Table(columns, tuple(rows), f"Backlash, {self.by}", tuple(self._remarks()))

    def _remarks(self) -> Iterator[str]:
        parts = (f"{part.name} {part.least:.4g} to {part.greatest:.4g} um" for part in self.parts)
        yield f"on the mean circle: {'; '.join(parts)}"
        yield "likely: 99.7 % of assemblies whose deviations are normal, by the squares"
        if self.by == GEOMETRY:
            yield (
                "straight flanks and a hob as large as the worm are taken: exact ones may leave "
                "tens of um less, at wide centre distances and of a larger hob; asperity flank "
                "has them"
            )
        off = self.allowances
        yield (
            f"centre distance +-{1e3 * off.centre_distance:.4g} um ({off.words['centre_distance']})"
            f"; thread {1e3 * off.thread[0]:.4g} to {1e3 * off.thread[1]:.4g} um "
            f"({off.words['thread']}); tooth {1e3 * off.tooth[0]:.4g} to "
            f"{1e3 * off.tooth[1]:.4g} um ({off.words['tooth']})"
        )
        if self.least < 0.0:
            yield "the least backlash is below zero: worm and wheel may jam"


def measures(geometry: Geometry, *, exact: bool = False) -> tuple[Measure, ...]:
    """Return the ways to say a backlash of a gearset.

    By geometry a backlash on the mean circle turns the worm by itself over the reduced lead. Exact
    flanks turn worm and wheel by the ratio: with a profile shift both differ by d_m2/d_2.
    """
    g = geometry
    normal = math.cos(g.pressure_angle) * math.cos(g.lead_angle)
    angle = 1.0 / (0.5 * _MICROMETRES * g.wheel_mean_diameter)
    turn = angle * g.gear_ratio if exact else 1.0 / (_MICROMETRES * g.reduced_lead)
    return (
        Measure("circumferential", "j_t", "um", "on the wheel's mean circle", 1.0),
        Measure("normal", "j_n", "um", "normal to the flanks", normal),
        Measure("wheel", "", "arcmin", "angle of the wheel", angle * _ARCMINUTES),
        Measure("worm", "", "deg", "angle of the worm", math.degrees(turn)),
    )


def thickness_parts(geometry: Geometry, allowed: Allowances) -> tuple[Part, Part]:
    """Return what the thicknesses of thread and tooth bring."""
    slant = math.cos(geometry.lead_angle)
    return _between("thread", allowed.thread, slant), _between("tooth", allowed.tooth, 1.0)


def backlash(gearset: Gearset, tolerances: Tolerances, wear: float | None = None) -> Backlash:
    """Return the backlash that tolerances leave of a gearset, by geometry.

    Parameters
    ----------
    gearset : Gearset
        Of which material and geometry are taken.
    tolerances : Tolerances
        What is allowed.
    wear : float, optional
        Depth that is worn off the wheel's flanks, normal to them, um.

    Returns
    -------
    Backlash
        Of the gearset new and worn, between its ends and likely.

    Raises
    ------
    InputError
        As of `Allowances.of`.
    """
    g = gearset.geometry
    allowed = Allowances.of(g, tolerances)
    off = 2.0 * _MICROMETRES * allowed.centre_distance * math.tan(g.axial_pressure_angle)
    parts = (*thickness_parts(g, allowed), Part("centre distance", -off, 0.0, off))
    return assembled(gearset, tolerances, allowed, parts, Interval.of(parts), wear, by=GEOMETRY)


def assembled(
    gearset: Gearset,
    tolerances: Tolerances,
    allowed: Allowances,
    parts: tuple[Part, ...],
    new: Interval,
    wear: float | None,
    *,
    by: str,
    exact: bool = False,
    warm: tuple[Interval, float] | None = None,
) -> Backlash:
    """Return the backlash of a new gearset and what each deviation brings (um), warm and worn.

    Where it is known, ``warm`` is the interval of the warm one, and by how much its middle moves.
    """
    g = gearset.geometry
    said = measures(g, exact=exact)
    states = {"new": new}
    warmth = None
    if warm is not None:
        states["warm"], warmth = warm
    elif tolerances.temperatures is not None:
        warmth = warm_backlash(gearset, tolerances.temperatures, tolerances.housing)
        states["warm"] = Interval(*(value + warmth for value in states["new"]))
    more = None if wear is None else wear / said[1].factor
    if more is not None:
        last = states.get("warm", states["new"])
        states["worn"] = Interval(*(value + more for value in last))
    states = {name: interval.rounded() for name, interval in states.items()}
    return Backlash(states, parts, said, warmth, more, by, allowed)


def warm_backlash(gearset: Gearset, temperatures: Temperatures, housing: str) -> float:
    """Return what warmth adds to the backlash on the mean circle, um.

    As `Warmth` has it.
    """
    apart = Warmth.of(gearset, temperatures, housing).apart
    return 2.0 * _MICROMETRES * apart * math.tan(gearset.geometry.axial_pressure_angle)


def _between(name: str, allowances: tuple[float, float], slant: float) -> Part:
    least, greatest = (-_MICROMETRES * value / slant + 0.0 for value in allowances)
    return Part(name, least, 0.5 * (least + greatest), greatest)
