r"""What mounting tolerances do to exact flanks: backlash, contact pattern, transmission error.

The play of a mesh is the least, over the places where worm and wheel may touch, of what is nearly
linear in how the worm stands: it is concave, so that the least of all assemblies is found at a
corner of the tolerances. The greatest is found where the axes are furthest apart and, along the
offset and the angle, at an end, where the worm stands as its hob stood (an identical hob leaves a
kink there), or between them: what is concave is climbed along one and then the other until neither
finds more. How thick threads and teeth are turns out in the play exactly. What warmth moves the
axes apart by is solved for like any other offset.

Lengths are in mm, angles in rad.
"""

import dataclasses
import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple, TypeVar

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.flanks.meshing.analysis import COLUMNS, ROWS
from asperity.flanks.meshing.backlash import worm_turn
from asperity.flanks.meshing.pattern import pattern
from asperity.flanks.meshing.transmission import Transmission, touching, transmission
from asperity.flanks.sides import both
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import RESOLVED, WheelFlank
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.allowances import Allowances, Taken
from asperity.gearset.tolerancing.backlash import (
    EXACT,
    Backlash,
    Interval,
    Part,
    assembled,
    thickness_parts,
)
from asperity.gearset.tolerancing.table import Tolerances
from asperity.gearset.tolerancing.warmth import Warmth
from asperity.results.table import Column, Table
from asperity.results.words import text_of

_MILLIMETRES = _MICROMETRES = 1e3
_NAMES = "centre distance", "axial offset", "shaft angle"
_SHORT = "a", "offset", "angle"
_MINUTES = 60.0 * 180.0 / math.pi
# Places of the wheel in a pitch between which the least backlash is looked for.
_SAMPLES = 8
# A climb: the share of a tolerance that it looks beside a place, and finds the top to; what is a
# gain, um; and how often it may turn.
_BESIDE, _FINE, _GAIN, _TURNS = 1.0 / 64.0, 1e-4, 1e-5, 8
_Found = TypeVar("_Found")


class Place(NamedTuple):
    """How far the worm stands off: along centre distance and wheel's axis, mm, and its angle, rad.

    In the gearset's own frame, as ``[mount]`` has them.
    """

    centre_distance: float = 0.0
    axial_offset: float = 0.0
    shaft_angle: float = 0.0

    @property
    def name(self) -> str:
        """Which way it stands off, in words."""
        signs = (
            f"{name} {'+' if value > 0.0 else '-'}"
            for name, value in zip(_SHORT, self, strict=True)
            if value
        )
        return ", ".join(signs) or "nominal"

    def further(self, apart: float) -> "Place":
        """Return the place with axes so much further apart, mm."""
        return self._replace(centre_distance=self.centre_distance + apart)

    def of(self, pair: Pair) -> Pair:
        """Return a pair that stands off so much further."""
        nominal, mirror = pair.mounting, pair.mirror
        mounting = dataclasses.replace(
            nominal,
            centre_distance=nominal.centre_distance + self.centre_distance,
            axial_offset=nominal.axial_offset + mirror * self.axial_offset,
            tilt=nominal.tilt + mirror * self.shaft_angle,
        )
        return dataclasses.replace(pair, mounting=mounting)


class Side(NamedTuple):
    """How a flank meshes at a place: marked share, the pattern's centre, mm, and error, rad."""

    share: float
    face: float
    radial: float
    error: float


class Corner(NamedTuple):
    """How the gearset meshes at a corner of its mounting tolerances.

    Attributes
    ----------
    place : Place
        Where the worm stands.
    sides : mapping of int to Side
        By flank, 1 and -1.
    gap : ndarray
        Of the flank s = +1 on the grid of the maps, mm.
    """

    place: Place
    sides: dict[int, Side]
    gap: FloatArray

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        flanks = {
            f"{side:+d}": {
                "pattern_area_fraction": own.share,
                "pattern_centre_mm": [own.face, own.radial],
                "transmission_error_rad": own.error,
            }
            for side, own in self.sides.items()
        }
        return {
            "name": self.place.name,
            "centre_distance_mm": self.place.centre_distance,
            "axial_offset_mm": self.place.axial_offset,
            "shaft_angle_deg": math.degrees(self.place.shaft_angle),
            "flanks": flanks,
        }


@dataclasses.dataclass(frozen=True, eq=False)
class Mounted:
    """A pair, and how its mesh is wherever tolerances let the worm stand.

    What is ``known`` of the backlash, by place, is not looked for again.
    """

    pair: Pair
    wheel: Wheel
    deviations: Place
    known: dict[Place, float] = dataclasses.field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, pair: Pair, wheel: Wheel, given: Tolerances) -> "Mounted":
        """Return it of the tolerances of a case."""
        allowed = Allowances.of(pair.geometry, given)
        offset = given.axial_offset * _MILLIMETRES
        return cls(pair, wheel, Place(allowed.centre_distance, offset, given.shaft_angle))

    def meshes(self, place: Place) -> dict[int, Transmission]:
        """Return the transmission on both flanks with the worm at a place.

        Raises
        ------
        ConvergenceError
            The worm does not reach the wheel all over the pitch.
        """
        return self._at(place, transmission)

    def _at(self, place: Place, found: Callable[[Pair, WheelFlank], _Found]) -> dict[int, _Found]:
        """Return what is found on both flanks with the worm at a place; raises as `meshes`."""
        pair = place.of(self.pair)
        try:
            return both(lambda side: found(pair, self.wheel.flank(side)))
        except ConvergenceError as error:
            raise ConvergenceError(
                f"at {place.name} of the tolerances {error}", reached=error.reached
            ) from None

    def play(self, place: Place) -> float:
        """Return the backlash on the mean circle with the worm at a place, um."""
        if place not in self.known:
            found = self._at(place, lambda pair, flank: touching(pair, flank, _SAMPLES))
            turn = worm_turn(found) / self.pair.ratio
            self.known[place] = 0.5 * _MICROMETRES * self.pair.geometry.wheel_mean_diameter * turn
        return self.known[place]

    def places(self, steps: tuple[int, ...], *more: Place) -> Iterator[Place]:
        """Yield the places so many deviations off, along all that may be off.

        And as far off as places that are given besides, along what they lie within.
        """
        own = []
        for axis, value in enumerate(self.deviations):
            ends = [step * value for step in steps] if value else [0.0]
            own.append([*ends, *(at[axis] for at in more if abs(at[axis]) < value)])
        for off in itertools.product(*(dict.fromkeys(steps) for steps in own)):
            yield Place(*off)

    @property
    def home(self) -> Place:
        """Where the worm stands as its hob stood, along the wheel's axis and in its angle."""
        cut, stands, mirror = self.pair.cutting, self.pair.mounting, self.pair.mirror
        return Place(
            0.0,
            mirror * (cut.axial_offset - stands.axial_offset),
            mirror * (cut.tilt - stands.tilt),
        )

    def plays(self, apart: float = 0.0) -> dict[Place, float]:
        """Return the backlash, um, where it may be least and greatest, with axes so far apart, mm.

        The places are those of the tolerances, before their axes move apart.
        """
        found = {place: self._apart(place, apart) for place in self.places((-1, 0, 1), self.home)}
        top = self._climbed(max(found, key=found.__getitem__), (1, 2), apart)
        found[top] = self._apart(top, apart)
        return found

    def _apart(self, place: Place, apart: float) -> float:
        return self.play(place.further(apart))

    def _climbed(self, start: Place, axes: tuple[int, ...], apart: float = 0.0) -> Place:
        """Return where the play is greatest, climbing along axes by turns."""
        top = start
        for _ in range(_TURNS):
            before = top
            for axis in axes:
                top = self._top(top, axis, apart)
            if top == before or len(axes) == 1:
                break
        return top

    def _top(self, start: Place, axis: int, apart: float) -> Place:
        """Return where the play is greatest along one axis, of which the start is a place."""
        off = self.deviations[axis]
        if not off:
            return start

        def at(value: float) -> Place:
            return Place(*(value if k == axis else own for k, own in enumerate(start)))

        least = self._apart(start, apart) + _GAIN
        for sign in (-1.0, 1.0):
            beside = start[axis] + sign * _BESIDE * off
            if abs(beside) <= off and self._apart(at(beside), apart) > least:
                break
        else:
            # What is concave and falls to both sides is greatest here.
            return start
        from scipy.optimize import minimize_scalar

        best = minimize_scalar(
            lambda value: -self._apart(at(float(value)), apart),
            bounds=tuple(sorted((start[axis], sign * off))),
            method="bounded",
            options={"xatol": _FINE * off},
        )
        found = at(float(best.x))
        return found if self._apart(found, apart) > least else start

    def corners(self) -> tuple[Corner, ...]:
        """Return how it meshes at the corners; none where the worm stands without tolerance."""
        if not any(self.deviations):
            return ()
        return tuple(self._corner(place) for place in self.places((-1, 1)))

    def _corner(self, place: Place) -> Corner:
        meshes = self.meshes(place)
        patterns = both(
            lambda side: pattern(meshes[side], self.wheel.flank(side).grid(ROWS, COLUMNS))
        )
        sides = {}
        for side, found in patterns.items():
            face, radial = found.centre
            error = meshes[side].peak_to_peak
            sides[side] = Side(found.area_fraction, self.pair.mirror * face, radial, error)
        return Corner(place, sides, patterns[1].gap)

    def backlash(
        self, gearset: Gearset, given: Tolerances, nominal: float, wear: float | None = None
    ) -> Backlash:
        """Return the backlash by the exact flanks.

        Parameters
        ----------
        gearset : Gearset
            Whose it is.
        given : Tolerances
            What is allowed.
        nominal : float
            Angle that the worm can be turned by, the wheel held, with nothing off, rad.
        wear : float, optional
            Depth that is worn off, um.
        """
        g = self.pair.geometry
        middle = 0.5 * _MICROMETRES * g.wheel_mean_diameter * nominal / self.pair.ratio
        if abs(middle) < _MICROMETRES * RESOLVED:
            # An identical hob leaves none.
            middle = 0.0
        self.known[Place()] = middle
        found = self.plays()
        alone = [self._alone(n, found) for n, value in enumerate(self.deviations) if value]
        # What a thread is thinner by turns the worm by itself over the lead, and the wheel with it.
        factor = g.wheel_mean_diameter / g.wheel_reference_diameter
        taken = Taken(-min(found.values()) / _MICROMETRES, factor)
        allowed = Allowances.of(g, given, taken)
        thread, tooth = thickness_parts(g, allowed)
        thread = Part(thread.name, *(factor * value for value in thread[1:]))
        parts = (Part("hob and worm", middle, middle, middle), thread, tooth, *alone)
        thickest, thinnest = thread.least + tooth.least, thread.greatest + tooth.greatest
        likely = Interval.of(parts)

        def between(plays: Iterable[float], more: float) -> Interval:
            every = tuple(plays)
            return Interval(
                min(every) + thickest,
                max(every) + thinnest,
                likely.likely_least + more,
                likely.likely_greatest + more,
            )

        warm = None
        if given.temperatures is not None:
            apart = Warmth.of(gearset, given.temperatures, given.housing).apart
            shifted = self.plays(apart)
            warmth = shifted[Place()] - middle
            warm = between(shifted.values(), warmth), warmth
        return assembled(
            gearset, given, allowed, parts, between(found.values(), 0.0), wear,
            by=EXACT, exact=True, warm=warm,
        )  # fmt: skip

    def _alone(self, axis: int, found: dict[Place, float]) -> Part:
        """Return what one deviation brings, nothing else off; what is found may be more."""
        middle = found[Place()]
        own = {
            place: value
            for place, value in found.items()
            if not any(off for k, off in enumerate(place) if k != axis)
        }
        top = max(own, key=own.__getitem__)
        if axis:
            top = self._climbed(top, (axis,))
        return Part(_NAMES[axis], min(own.values()) - middle, 0.0, self.play(top) - middle)


def corner_table(corners: tuple[Corner, ...], nominal: Corner, resolution: float) -> Table:
    """Return how far both flanks bear at each corner, where, and how evenly they turn.

    Errors up to the resolution, rad, are rounding.
    """
    rows: list[tuple[str, ...]] = []
    for number, corner in enumerate((nominal, *corners)):
        for side, own in corner.sides.items():
            within = f"tolerances.corners.{number - 1}.flanks.{side:+d}" if number else ""
            numbers = (
                (own.share, 0.0, "pattern_area_fraction"),
                (own.face, 0.0, "pattern_centre_mm.0"),
                (own.radial, 0.0, "pattern_centre_mm.1"),
                (own.error, resolution, "transmission_error_rad"),
            )
            texts = (
                text_of(value, below, f"{within}.{key}" if within else "")
                for value, below, key in numbers
            )
            rows.append((corner.place.name, f"{side:+d}", *texts))
    heads = (
        "mounted", "flank", "share that bears", "centre: face (mm)", "radial (mm)",
        "transmission error (rad)",
    )  # fmt: skip
    columns = tuple(Column(head, right=n > 0, folds=True) for n, head in enumerate(heads))
    worst = max(own.error for corner in corners for own in corner.sides.values())
    least = min(own.share for corner in corners for own in corner.sides.values())
    said = "rounding" if worst <= resolution else f"{_MINUTES * worst:.3g} arcmin"
    remarks = (
        f"at the corners {100.0 * least:.3g} % of a flank bears at least, and the transmission "
        f"error from peak to peak is at most {said}",
    )
    return Table(columns, tuple(rows), "Corners of the mounting tolerances", remarks)
