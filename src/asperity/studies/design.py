"""What stays free in a worm gearset once place, ratio, drive and materials are given.

Thesis 3.2.3: with centre distance, ratio and worm speed as they are, pressure angle, diameter
factor, axial module and roughness remain. The profile shift makes up for the centre distance.
"""

import dataclasses
import functools
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.formulas import masking
from asperity.gearset.hob_shelf import hob_of, shelf
from asperity.gearset.parameters import Gearset
from asperity.gearset.threads import CLOSED_FORMS, thread_room
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate
from asperity.rating.rated import Rated
from asperity.rating.self_locking import locking_margins
from asperity.rating.standards import STANDARDS, tables_of
from asperity.rating.variants import variants
from asperity.sources import Source
from asperity.studies.climb import spread
from asperity.studies.cube import cube_of
from asperity.studies.requirements import Requirements

VARIABLES = ("pressure_angle", "diameter_factor", "axial_module", "worm_roughness")
"""What is free: alpha_n, q1, m_x1, Ra1."""

NEEDED = ("iso14521", "bs721")
"""Standards that judge a design: the efficiency, and the permissible torques."""

ASSUMED = Source(
    "default of asperity", "own choice", "Table 3.6 of the thesis, which has them, is lost"
)
"""Where the default bounds come from."""

_SAMPLE = 2**11
_REQUIRED = "requirements."
_OF_A_HOB = ("pressure_angle", "diameter_factor", "axial_module")
_ABOVE = 1e-9

_NUMBERS = {
    "eta_z1_2": "iso14521.eta_z1_2",
    "h_star": "iso14521.h_star",
    "M_w_Nm": "bs721.M_w_Nm",
    "M_s_Nm": "bs721.M_s_Nm",
}

WORTH = ("eta_z1_2", "M_w_Nm", "M_s_Nm", "profile_shift")
"""What a design is judged by."""

THREADS = "thread_room"
"""What is left of the pitch where the threads of worm and hob are thinnest."""

LEAST_THREADS = 1e-3
"""Below it a design counts as pointed: above zero, so that what lies on the limit can be cut."""

Span = tuple[float, float]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Bounds:
    r"""How far a design may be changed. The defaults are assumed, see `ASSUMED`.

    A gearset that lies outside as it is widens them, so that it is a design like the others.

    Parameters
    ----------
    pressure_angle : tuple of float
        :math:`\alpha_n`, rad.
    diameter_factor : tuple of float
        :math:`q_1`.
    module_change : tuple of float
        Change of :math:`m_{x1}` in parts of itself.
    worm_roughness : tuple of float
        :math:`Ra_1`, m.
    profile_shift : tuple of float
        :math:`x_2`, which follows from the others and needs room.
    """

    pressure_angle: Span = (math.radians(14.5), math.radians(30.0))
    diameter_factor: Span = (6.0, 12.0)
    module_change: Span = (-0.05, 0.05)
    worm_roughness: Span = (0.8e-6, 1.6e-6)
    profile_shift: Span = (-0.5, 0.5)

    def __post_init__(self) -> None:
        for name, (lower, upper) in dataclasses.asdict(self).items():
            if not (math.isfinite(lower) and math.isfinite(upper) and lower <= upper):
                raise InputError(
                    f"the bounds of {name} are {lower:g} and {upper:g}; give the lower one first"
                )
        if self.profile_shift[0] == self.profile_shift[1]:
            raise InputError(
                f"the bounds of profile_shift are both {self.profile_shift[0]:g}; it follows from "
                "the others and needs room: give it some, such as -0.01 and 0.01"
            )


class Space:
    """All designs of a gearset within bounds, as points of a unit cube.

    A variable whose bounds are one number is not a dimension of it.

    Parameters
    ----------
    gearset, operation, options
        As in `asperity.rating.rate`.
    bounds : Bounds, optional
        How far the design may be changed.
    folder : path, optional
        Where a relative file name among the options starts.
    least : mapping of str to float, optional
        Least safeties of every design, by ``standard.key``.
    requirements : Requirements, optional
        What every design keeps beside them.

    Raises
    ------
    InputError
        The gearset cannot be rated, or has not the ratio or the centre distance that is required,
        neither of which any design changes.

    Attributes
    ----------
    lower, upper : ndarray
        Bounds of the `VARIABLES` in SI.
    profile_shift : tuple of float
        Bounds of the profile shift.
    least_threads : float or None
        Least `THREADS` of a design; None where it is not looked at.
    start : ndarray
        The gearset as it is, as a point.
    """

    def __init__(
        self,
        gearset: Gearset,
        operation: Operation,
        options: RatingOptions | None = None,
        bounds: Bounds | None = None,
        folder: Path | None = None,
        least: Mapping[str, float] | None = None,
        requirements: Requirements | None = None,
    ) -> None:
        self.gearset, self.operation = gearset, operation
        self.options, self.folder = options or RatingOptions(), folder
        self.least = dict(least or {})
        self.requirements = requirements or Requirements()
        # The thesis (3.3.5), which asks for torques alone, looks at no threads.
        knows = least is not None and gearset.flank in CLOSED_FORMS
        asked = {path.removeprefix("locking.").partition(".")[0] for path in self.least}
        if self.requirements.self_locking != "any":
            asked |= {*rate(gearset, operation, self.options, folder=folder).found}
        self._tables = tables_of(self.options, folder)
        self._standards = tuple(name for name in STANDARDS if name in {*NEEDED, *asked})
        self._required = self._moved(gearset)
        self._judged = (
            *WORTH, *((THREADS,) if knows else ()), *self.least, *self._required,
        )  # fmt: skip
        for standard in NEEDED:
            # Alone, because then one that cannot be applied says why.
            rate(gearset, operation, self.options, (standard,), folder=folder)
        bounds = bounds or Bounds()
        geometry = gearset.geometry
        module = 1e-3 * geometry.axial_module
        spans = {
            "pressure_angle": bounds.pressure_angle,
            "diameter_factor": bounds.diameter_factor,
            "axial_module": tuple(module * (1.0 + change) for change in bounds.module_change),
            "worm_roughness": bounds.worm_roughness,
        }
        now = np.array(
            [gearset.pressure_angle, geometry.diameter_factor, module, gearset.worm_roughness]
        )
        self.lower = np.minimum([spans[name][0] for name in VARIABLES], now)
        self.upper = np.maximum([spans[name][1] for name in VARIABLES], now)
        self._keep_hob()
        shift = geometry.profile_shift
        self.profile_shift = (
            min(bounds.profile_shift[0], shift),
            max(bounds.profile_shift[1], shift),
        )
        ends = np.column_stack([self.lower, self.upper])
        twice, teeth = 2e-3 * geometry.centre_distance, gearset.wheel_teeth
        self.cube = cube_of(VARIABLES, ends, self.profile_shift, twice, teeth)
        own = self.threads_of(geometry.diameter_factor, gearset.pressure_angle)
        self.least_threads = min(LEAST_THREADS, float(own)) if knows else None
        self.start = self.cube.points(now)

    def _keep_hob(self) -> None:
        """Refuse to change what a hob of the shelf settles, and a gearset that none cuts."""
        which, geometry = self.requirements.hobs, self.gearset.geometry
        if which == "any":
            return
        free = [
            name
            for name, low, high in zip(VARIABLES, self.lower, self.upper, strict=True)
            if name in _OF_A_HOB and high > low
        ]
        if free:
            raise InputError(
                f"requirements.hobs is {which!r}, and another {free[0]} needs another hob: leave "
                "it out, or take --free worm_roughness; asperity size goes through the hobs"
            )
        hobs = shelf(which, self.gearset) or ()
        if not hob_of(hobs, geometry.starts, geometry.axial_module, geometry.diameter_factor):
            raise InputError(
                f"requirements.hobs is {which!r}, and none of them cuts a gearset with "
                f"m_x1 {geometry.axial_module:g} mm, q_1 {geometry.diameter_factor:g} and "
                f"{geometry.starts} starts"
            )

    @property
    def dimensions(self) -> int:
        """How many of the `VARIABLES` have room within their bounds."""
        return len(self.cube.free)

    def values(self, points: FloatArray) -> dict[str, Any]:
        """Return the variables at points, in SI."""
        designs = self.cube.designs(points)
        return dict(zip(VARIABLES, np.moveaxis(designs, -1, 0), strict=True))

    def rated(self, gearset: Gearset) -> Rated:
        """Return the whole rating of a gearset under what all are under."""
        return rate(gearset, self.operation, self.options, folder=self.folder)

    def numbers(self, points: FloatArray) -> dict[str, FloatArray]:
        """Return what the designs at points are worth, by the keys of a rating.

        NaN stands for designs without an answer.
        """
        found = variants(
            self.gearset,
            self.operation,
            self.options,
            self._standards,
            capacity=any(path.startswith("iso14521.") for path in self.least),
            loads=False,
            folder=self.folder,
            **self.values(points),
        )
        shift = np.broadcast_to(found.rating_inputs.profile_shift, found.shape)
        locking = [path for path in self.least if path.startswith("locking.")]
        paths = _NUMBERS | {path: path for path in self.least if path not in locking}
        numbers = {key: found[path] for key, path in paths.items()} | {"profile_shift": shift}
        if locking or self._required:
            with masking(found.shape):
                margins = locking_margins(found.rating_inputs, found, self._tables)
            at_rest = {name: m for (name, state), m in margins.items() if state == "static"}
            room = self.requirements.room(found.rating_inputs, at_rest)
            for name in self._required:
                left = np.asarray(room[name.removeprefix(_REQUIRED)], dtype=float) - _ABOVE
                numbers[name] = np.broadcast_to(left, found.shape)
            for (standard, state), margin in margins.items():
                over = np.broadcast_to(np.asarray(margin, dtype=float) + 1.0, found.shape)
                numbers[f"locking.{standard}.{state}"] = over
        if self.least_threads is not None:
            q, alpha = found.rating_inputs.diameter_factor, self.values(points)["pressure_angle"]
            numbers[THREADS] = np.broadcast_to(self.threads_of(q, alpha), found.shape)
        return numbers | {"M_permissible_Nm": np.minimum(numbers["M_w_Nm"], numbers["M_s_Nm"])}

    def worth(self, points: FloatArray) -> FloatArray:
        """Return efficiency, permitted torques, profile shift and asked safeties, in rows."""
        found = self.numbers(points)
        return np.stack([found[key] for key in self._judged], axis=-1)

    def merit(self, rows: FloatArray, least: Mapping[str, float]) -> FloatArray:
        """Return from rows of worth the efficiency, and the room of torques and profile shift.

        Parameters
        ----------
        rows : ndarray
            Of `worth`.
        least : mapping of str to float
            Least torques by key.
        """
        found = dict(zip(self._judged, rows.T, strict=True))
        room = [found[key] / bound - 1.0 for key, bound in least.items()]
        return np.stack([rows[:, 0], *room, *self.room(found)], axis=-1)

    @functools.cached_property
    def sample(self) -> tuple[FloatArray, dict[str, FloatArray]]:
        """Points all over the cube that keep the bounds of the profile shift, and their worth."""
        points = spread(self.dimensions, _SAMPLE)
        found = self.numbers(points)
        inside = np.all(np.stack(self.room(found)) >= 0.0, axis=0)
        return points[inside], {key: values[inside] for key, values in found.items()}

    def best_of_sample(self, height: str, **least: float) -> list[FloatArray]:
        """Return the best point of the sample, if there is one.

        Parameters
        ----------
        height : str
            What is to be high, by its key.
        **least : float
            Least numbers by key.
        """
        points, found = self.sample
        allowed = np.all([found[key] >= bound for key, bound in least.items()], axis=0)
        worth = np.where(allowed & ~np.isnan(found[height]), found[height], -np.inf)
        return [points[int(np.argmax(worth))]] if np.any(worth > -np.inf) else []

    def room(self, numbers: Mapping[str, FloatArray]) -> list[FloatArray]:
        """Return by how much profile shift and safeties keep their bounds, none below zero."""
        shift = numbers["profile_shift"]
        safeties = [numbers[path] / bound - 1.0 for path, bound in self.least.items()]
        if self.least_threads is not None:
            safeties.append(numbers[THREADS] - self.least_threads)
        safeties += [numbers[name] for name in self._required]
        return [shift - self.profile_shift[0], self.profile_shift[1] - shift, *safeties]

    @property
    def kept(self) -> tuple[str, ...]:
        """A note of what is kept as ``[requirements]`` has it, if there is any."""
        said = self.requirements.said
        return (f"kept as [requirements] has it: {said}",) if said else ()

    def required_of(self, point: FloatArray) -> list[tuple[str, float, float]]:
        """Return the name of each requirement, 0, and the room that the design at a point has."""
        found = self.numbers(point) if self._required else {}
        return [(f"{name}.room", 0.0, round(float(found[name]), 8)) for name in self._required]

    def nothing_keeps(self) -> InputError:
        """Return the error that no design within the bounds keeps what is required."""
        return InputError(
            f"[requirements] asks for {self.requirements.said or 'too much'}, which no design "
            "within the bounds has: ask for less, widen --bounds, or let size propose another"
        )

    def _moved(self, gearset: Gearset) -> tuple[str, ...]:
        """Return the requirements that a design may break; raises InputError for the others."""
        asked = self.requirements
        geometry = gearset.geometry
        if asked.ratio is not None and (
            abs(geometry.gear_ratio / asked.ratio - 1.0) > asked.ratio_tolerance * (1.0 + _ABOVE)
        ):
            raise InputError(
                f"requirements.ratio is {asked.ratio:g} within {100 * asked.ratio_tolerance:g} %, "
                f"and the gearset has {geometry.gear_ratio:.4g}, which stays: size proposes others"
            )
        most = asked.centre_distance
        if most is not None and geometry.centre_distance > 1e3 * most * (1.0 + _ABOVE):
            raise InputError(
                f"requirements.centre_distance is {1e3 * most:g} mm, and the gearset has "
                f"{geometry.centre_distance:.4g} mm, which stays: size proposes others"
            )
        names = [
            name for name in ("wheel_diameter", "worm_length") if getattr(asked, name) is not None
        ]
        if asked.self_locking != "any":
            names += [f"self_locking.{standard}" for standard in self._standards]
        return tuple(_REQUIRED + name for name in names)

    def threads_of(self, diameter_factor: Any, pressure_angle: Any) -> FloatArray:
        """Return the `THREADS` of designs."""
        rule, starts = self.gearset.tooth_proportions, self.gearset.starts
        return thread_room(self.gearset.flank, rule, starts, diameter_factor, pressure_angle)

    def points(self, designs: FloatArray) -> FloatArray:
        """Return the points of designs that are rows of `VARIABLES` in SI."""
        return self.cube.points(designs)

    def thickest(self, point: FloatArray) -> FloatArray:
        """Return a point with the greatest diameter factor in place of its own."""
        return np.where(self.cube.free == VARIABLES.index("diameter_factor"), 1.0, point)

    def gearset_at(self, point: FloatArray) -> Gearset:
        """Return the design at a point as a gearset."""
        old = self.gearset
        given = {key: getattr(old, key) for key in old.model_fields_set}
        for key in ("worm_pitch_diameter", "profile_shift"):
            given.pop(key, None)
        values = {name: float(value) for name, value in self.values(point).items()}
        distance = 1e-3 * old.geometry.centre_distance
        return Gearset.model_validate({**given, "centre_distance": distance, **values})


def refuse_given_friction(options: RatingOptions | None) -> None:
    """Refuse to look for what a given friction has no say on."""
    if options is not None and options.friction is not None:
        raise InputError(
            f"rating.friction is {options.friction:g}, on which pressure angle and roughness have "
            "no say; leave it out, or use rating.base_friction or rating.friction_factor"
        )
