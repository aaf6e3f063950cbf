"""One shaft under all loads and in all cases: reactions, moments, deflection, safeties, lives."""

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from asperity.arrays import EQUAL, first_least
from asperity.errors import InputError
from asperity.shafts.beam import Deflection, at_position, deflection, places_of
from asperity.shafts.bearings import Carried, Life, life_of
from asperity.shafts.loads import Condition, Load
from asperity.shafts.model import Axial, Model
from asperity.shafts.options import BearingOptions
from asperity.shafts.parameters import ShaftBearing
from asperity.shafts.statics import Moments, PointLoad, Reactions, moments, reactions
from asperity.shafts.strength.section import Actions, Detail, Judged, judged, strength

Teeth = Callable[[Load, Condition], PointLoad]
"""The load of the teeth on the shaft."""


@dataclasses.dataclass(frozen=True)
class Loaded:
    """A shaft under one load in one case.

    Attributes
    ----------
    model : Model
        The shaft.
    load : Load
        Of the life.
    condition : Condition
        Rotation, and what drives.
    loads : tuple of PointLoad
        On the shaft, of the teeth first.
    """

    model: Model
    load: Load
    condition: Condition
    loads: tuple[PointLoad, ...]

    @functools.cached_property
    def carried(self) -> Reactions:
        """What the bearings carry."""
        return reactions(self.loads, *self.model.bearings)

    @functools.cached_property
    def axial(self) -> Axial:
        """How they share the axial force."""
        return self.model.axial_of(self.carried, self.carried.radial)

    def moments(self, between: int = 0) -> Moments:
        """Return what the sections carry, where something changes and so often between."""
        marks = [*self.model.bearings, *(load.at for load in self.loads)]
        marks += [detail.at for detail in self.model.details]
        places = places_of(self.model.stretches, marks, between)
        return moments(places, self.loads, self.carried, self.model.bearings, self.axial.forces)

    def deflection(self, between: int = 0) -> Deflection:
        """Return how it bends."""
        return deflection(
            self.model.stretches,
            self.loads,
            self.model.bearings,
            self.model.modulus,
            radial_compliance=self.model.radial_compliance,
            between=between,
        )

    @functools.cached_property
    def at_mesh(self) -> tuple[float, float]:
        """Deflection at the mesh by bending, and with shear, um."""
        bent, shifted = self._mesh
        return math.hypot(*bent), math.hypot(*shifted)

    @property
    def mesh_shift(self) -> tuple[float, float]:
        """How far the mesh goes along y and z, by bending with shear, um."""
        return self._mesh[1]

    @functools.cached_property
    def _mesh(self) -> tuple[tuple[float, float], tuple[float, float]]:
        found = deflection(
            self.model.stretches, self.loads, self.model.bearings, self.model.modulus,
            radial_compliance=self.model.radial_compliance, carried=self.carried,
        )  # fmt: skip
        bent, sheared, _ = at_position(found, self.model.mesh)
        y, z = (1e3 * bent).tolist()
        all_y, all_z = (1e3 * (bent + sheared)).tolist()
        return (y, z), (all_y, all_z)

    @functools.cached_property
    def actions(self) -> tuple[Actions, ...]:
        """What the section of each detail carries, the worse of its two sides."""
        at = np.array([detail.at for detail in self.model.details])
        m = moments(at, self.loads, self.carried, self.model.bearings, self.axial.forces)
        bending = 1e-3 * np.hypot(m.bending[..., 0], m.bending[..., 1]).max(axis=1)
        torque = 1e-3 * np.abs(m.torque).max(axis=1)
        axial = np.abs(m.axial).max(axis=1)
        return tuple(map(Actions, bending.tolist(), torque.tolist(), axial.tolist()))


@dataclasses.dataclass(frozen=True)
class Section:
    """A section as it is judged: the weakest of what has its name.

    Attributes
    ----------
    detail : Detail
        The section.
    actions : Actions
        What it carries there.
    judged : Judged
        Its safeties.
    load : int
        Number of the load, from 0.
    condition : Condition
        The case.
    """

    detail: Detail
    actions: Actions
    judged: Judged
    load: int
    condition: Condition


@dataclasses.dataclass(frozen=True)
class LoadedShaft:
    """A shaft under all loads.

    Attributes
    ----------
    model : Model
        The shaft.
    cases : tuple of Condition
        What holds for loads that say nothing of themselves.
    every : tuple of tuple of Loaded
        By case and load.
    options : BearingOptions
        What is asked of the bearings.
    speeds : tuple of float
        Of the shaft under each load, rpm.
    """

    model: Model
    cases: tuple[Condition, ...]
    every: tuple[tuple[Loaded, ...], ...]
    options: BearingOptions
    speeds: tuple[float, ...]

    @functools.cached_property
    def hardest(self) -> tuple[Loaded, ...]:
        """Each case under the greatest torque."""
        return tuple(max(case, key=lambda each: each.load.torque) for case in self.every)

    @functools.cached_property
    def worst(self) -> Loaded:
        """The case that bends it most at the mesh under the greatest torque."""
        return first_least(self.hardest, lambda each: -each.at_mesh[0])

    @functools.cached_property
    def sections(self) -> tuple[Section, ...]:
        """The sections that are judged, each under its worst load; none without a material."""
        table = self.model.table
        steel = table.material
        if steel is None:
            return ()
        found: dict[str, Section] = {}
        for number, detail in enumerate(self.model.details):
            try:
                borne = strength(detail, steel, table.hardening)
            except InputError as error:
                raise InputError(f"{table.table}, {detail.name}: {error}") from None
            for place, each in self._hardest_of(number):
                actions = each.actions[number]
                safeties = judged(
                    detail, steel, borne, actions, torque=table.torque, peak=table.peak
                )
                own = Section(detail, actions, safeties, place, each.condition)
                known = found.get(detail.name)
                if known is None or least(own.judged) < (1.0 - EQUAL) * least(known.judged):
                    found[detail.name] = own
        return tuple(found.values())

    def _hardest_of(self, detail: int) -> list[tuple[int, Loaded]]:
        """Return the loads of a detail of which no other is as large in all that it carries.

        Every safety falls with each of moment, torque and axial force.
        """
        every = [(place, each) for case in self.every for place, each in enumerate(case)]
        # Those of mirrored cases are the same but for rounding: they keep their order.
        every.sort(key=lambda pair: [-float(f"{a:.9g}") for a in pair[1].actions[detail]])
        kept: list[tuple[int, Loaded]] = []
        for pair in every:
            own = pair[1].actions[detail]
            if not any(all(map(float.__le__, own, other.actions[detail])) for _, other in kept):
                kept.append(pair)
        return kept

    @functools.cached_property
    def lives(self) -> tuple[Mapping[Condition, Life] | None, ...]:
        """What each bearing comes to by case; None of one that is not named."""
        return tuple(
            None if place.bearing is None else self.lives_of(number, place)
            for number, place in enumerate(self.model.places)
        )

    def lives_of(self, number: int, bearing: ShaftBearing) -> Mapping[Condition, Life]:
        """Return what a bearing comes to by case where another stands, or none, of its kind."""
        own = {}
        for condition, case in zip(self.cases, self.every, strict=True):
            loads = [
                Carried(
                    each.carried.radial[number],
                    each.axial.loads[number],
                    each.load.hours,
                    speed,
                    each.load.viscosity,
                    each.load.like is None,
                )
                for each, speed in zip(case, self.speeds, strict=True)
            ]
            own[condition] = life_of(bearing, loads, self.options, self.model.table.peak)
        return own


def least(safeties: Judged) -> float:
    """Return the least safety by DIN 743, case 2 for fatigue."""
    return min(safeties.fatigue_2, safeties.yielding)


def find_shaft(
    model: Model,
    loads: Sequence[Load],
    cases: Sequence[Condition],
    options: BearingOptions,
    teeth: Teeth,
    *,
    of_wheel: bool,
) -> LoadedShaft:
    """Return a shaft under loads.

    Raises
    ------
    InputError
        No bearing carries the axial force of a case.
    """
    every = []
    for case in cases:
        own = []
        for load in loads:
            condition = load.within(case)
            point = teeth(load, condition)
            turned = 1e-3 * point.couple[0]
            found = Loaded(model, load, condition, (point, *model.other_loads(turned)))
            _ = found.axial
            own.append(found)
        every.append(tuple(own))
    speeds = tuple(each.wheel_speed if of_wheel else each.speed for each in loads)
    return LoadedShaft(model, tuple(cases), tuple(every), options, speeds)
