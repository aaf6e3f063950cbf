"""What ways to less friction are worth in a worm gearset: oils, additives, coatings, vibration.

This is thesis 3.2.2 (Table 3.3, Figure 3.1), with vibration also as the package's own friction
model has it at the sliding velocity of the gearset.
"""

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.friction.parameters import Friction
from asperity.gearset.parameters import Gearset
from asperity.rating.driven import driven
from asperity.rating.iso14521.friction import base_friction
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.rate import rate
from asperity.rating.result import Rating
from asperity.rating.tables import operation_of
from asperity.rating.variants import variants
from asperity.runs import Run
from asperity.slider.parameters import Slider
from asperity.sources import Source
from asperity.studies import vibrated_friction
from asperity.studies.comparison import Compared, Comparison
from asperity.studies.gears import Gears
from asperity.studies.reported import OWN, Method, more_methods, reported_methods
from asperity.studies.vibrated_friction import Shaken
from asperity.vibration import Vibration

AS_IS = "as_is"
"""Key of the gearset as it is."""

_STANDARD = "iso14521"
_QUARTER = 1e-9


def compare(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    *,
    methods: Sequence[Method] | None = None,
    vibration: Vibration | None = None,
    friction: Friction | None = None,
    normal_force: float | None = None,
    folder: Path | None = None,
) -> Comparison:
    r"""Compare ways to less friction by the efficiency that ISO/TR 14521 gives with them.

    Parameters
    ----------
    gearset : Gearset
        As in `asperity.rating.rate`, whose friction a reduction acts on.
    operation : Operation
        As in `asperity.rating.rate`.
    options : RatingOptions, optional
        As in `asperity.rating.rate`.
    methods : sequence of Method, optional
        What is reported; `asperity.studies.reported_methods` if left out.
    vibration : Vibration, optional
        What is imposed on the contact, along and across the sliding, and in its own direction
        where that is neither; a velocity ratio is taken to the sliding velocity. Left out:
        a sine of 20 kHz and 20 um, assumed.
    friction : Friction, optional
        The law of the contact under vibration; its coefficient does not matter but for a
        tangential stiffness. Left out: rigid Coulomb friction, assumed.
    normal_force : float, optional
        On the contact, N. Left out: that which the standard's efficiency implies.
    folder : path, optional
        Where the file of a sampled waveform is looked for.

    Returns
    -------
    Comparison
        Efficiency with each method, and with vibration.

    Raises
    ------
    InputError
        The gearset cannot be rated, or its mean friction is given.
    ConvergenceError
        The contact has no periodic state under the vibration.
    """
    options = options or RatingOptions()
    if options.friction is not None:
        raise InputError(
            f"rating.friction is {options.friction:g}, which leaves nothing to the methods; leave "
            "it out, or give rating.base_friction"
        )
    rating = rate(gearset, operation, options, (_STANDARD,)).found[_STANDARD]
    contact = _Contact(gearset, operation, rating)
    imposed = contact.imposed(
        vibration or vibrated_friction.DEFAULT, friction, normal_force, folder
    )
    methods = reported_methods() if methods is None else methods
    entries = [contact.as_is(options), *contact.reported(methods, options, imposed[0]), *imposed]
    rows = contact.compared(entries, options)
    return Comparison(
        name=gearset.name,
        sliding_velocity=contact.velocity,
        output_power=contact.power,
        rows=rows,
        assumed=MappingProxyType(_assumed(vibration, friction)),
        notes=_notes(contact, rows),
    )


def compare_case(case: Case, methods: Sequence[Method] | None = None) -> Comparison:
    """Compare ways to less friction in the gearset of a case file.

    Its tables ``[vibration]`` and ``[friction]``, and the normal force of ``[slider]``, describe
    the vibration where they are there.
    """
    slider = case.get(Slider)
    gearset, options = case.require(Gearset), case.get(RatingOptions)
    return compare(
        gearset,
        driven(gearset, operation_of(case), options),
        options,
        methods=methods,
        vibration=case.get(Vibration),
        friction=case.get(Friction),
        normal_force=slider.normal_force if slider else None,
        folder=case.folder,
    )


def prepare(case: Case, *, also: Sequence[str] | None = None) -> tuple[Case, tuple[Method, ...]]:
    """Return a case that has a gearset, and ways to less friction.

    Raises
    ------
    InputError
        A table is missing, or a file of more ways is wrong.
    """
    Gears.of(case)
    return case, more_methods(also or ())


def answer(problem: tuple[Case, tuple[Method, ...]], _: Run) -> Comparison:
    """Compare ways to less friction in the gearset of a case."""
    return compare_case(*problem)


@dataclasses.dataclass(frozen=True)
class _Entry:
    """A way to less friction, ready to be rated."""

    key: str
    name: str
    kind: str
    base_friction: float
    source: Source
    vibration: Shaken | None = None


class _Contact:
    """The tooth contact of a gearset as ISO/TR 14521 has it."""

    def __init__(self, gearset: Gearset, operation: Operation, rating: Rating) -> None:
        def number(key: str) -> float:
            value: Any = rating[key]
            return float(value)

        self.gearset, self.operation = gearset, operation
        self.source = rating.entry("mu_0T").source
        self.velocity = number("sliding_velocity_m_s")
        self.power = number("output_power_W")
        self.base_friction, self.friction = number("mu_0T"), number("mu_zm")
        self.lead_angle = gearset.geometry.lead_angle

    def normal_force(self, mean: float) -> float:
        """Return the load on the flanks, N, where the mean friction along the sliding is this.

        It turns the wheel against the friction, as the standard's efficiency has it.
        """
        sin, cos = math.sin(self.lead_angle), math.cos(self.lead_angle)
        return self.power / (self.velocity * sin * (cos - mean * sin))

    def as_is(self, options: RatingOptions) -> _Entry:
        oil = self.operation.lubricant.base_oil
        name = f"as it is, {oil} oil" if options.base_friction is None else "as it is"
        return _Entry(AS_IS, name, "as it is", self.base_friction, self.source)

    def reported(
        self, methods: Sequence[Method], options: RatingOptions, imposed: _Entry
    ) -> list[_Entry]:
        frequency = (
            vibrated_friction.FREQUENCY
            if imposed.vibration is None
            else imposed.vibration.frequency
        )
        own = self.operation.lubricant.base_oil if options.base_friction is None else None
        return [
            _Entry(
                method.key,
                method.name,
                method.kind,
                self._reported(method),
                method.source,
                self._quoted(method, frequency),
            )
            for method in methods
            if method.base_oil is None or method.base_oil != own
        ]

    def _reported(self, method: Method) -> float:
        if method.base_friction is not None:
            return method.base_friction
        if method.reduction is not None:
            return (1.0 - method.reduction) * self.base_friction
        assert method.base_oil is not None
        by_standard: float = base_friction(
            self.velocity,
            family=self.gearset.wheel_material.family,
            lubrication=self.operation.lubrication,
            base_oil=method.base_oil,
        )
        return by_standard

    def _quoted(self, method: Method, frequency: float) -> Shaken | None:
        if method.velocity_ratio is None:
            return None
        return vibrated_friction.quoted(
            method.velocity_ratio,
            method.direction or 0.0,
            self.velocity,
            frequency,
            round(1.0 - (method.reduction or 0.0), 12),
        )

    def imposed(
        self,
        vibration: Vibration,
        friction: Friction | None,
        normal_force: float | None,
        folder: Path | None,
    ) -> list[_Entry]:
        directions = {"transverse": math.pi / 2.0, "longitudinal": 0.0}
        if abs(math.sin(2.0 * vibration.direction)) > _QUARTER:
            directions["given"] = vibration.direction
        force = normal_force or self.normal_force(self.friction)
        entries = []
        for key, direction in directions.items():
            moved = vibrated_friction.shake(
                vibration, direction, self.velocity, friction=friction, normal_force=force,
                folder=folder,
            )  # fmt: skip
            turned = f"vibration at {math.degrees(direction):.4g} deg"
            what = turned if key == "given" else f"{key} vibration"
            name = f"{what}, k = {moved.velocity_ratio:.3g}"
            less = moved.share * self.base_friction
            entries.append(_Entry(key, name, "vibration", less, OWN, moved))
        return entries

    def compared(self, entries: Sequence[_Entry], options: RatingOptions) -> tuple[Compared, ...]:
        found = variants(
            self.gearset,
            self.operation,
            options,
            (_STANDARD,),
            capacity=False,
            base_friction=np.array([entry.base_friction for entry in entries]),
        )

        def column(key: str) -> list[float]:
            numbers: list[float] = found[f"{_STANDARD}.{key}"].tolist()
            return numbers

        rows = []
        keys = ("mu_zm", "eta_z1_2", "eta_ges", "eta_z2_1")
        columns = zip(*map(column, keys), strict=True)
        first = column("eta_z1_2")[0]
        for entry, (mean, efficiency, total, back) in zip(entries, columns, strict=True):
            given = 0.0
            if entry.vibration is not None:
                full = self.friction * self.normal_force(mean) * self.velocity
                given = entry.vibration.power * full
            rows.append(
                Compared(
                    key=entry.key,
                    name=entry.name,
                    kind=entry.kind,
                    base_friction=entry.base_friction,
                    friction=mean,
                    efficiency=efficiency,
                    total_efficiency=total,
                    back_driving_efficiency=back,
                    gain=efficiency - first,
                    source=entry.source,
                    vibration=entry.vibration,
                    vibration_power=given,
                    efficiency_with_vibration=self.power / (self.power / efficiency + given),
                )
            )
        return tuple(rows)


def _assumed(vibration: Vibration | None, friction: Friction | None) -> dict[str, str]:
    assumed = {}
    if vibration is None:
        assumed["vibration"] = (
            f"sine, {1e-3 * vibrated_friction.FREQUENCY:g} kHz, "
            f"{1e6 * vibrated_friction.AMPLITUDE:g} um, what an "
            "ultrasonic transducer reaches without load"
        )
    if friction is None:
        assumed["friction"] = "rigid Coulomb friction"
    return assumed


def _notes(contact: _Contact, rows: Sequence[Compared]) -> tuple[str, ...]:
    notes = []
    quoted = [row for row in rows if row.vibration is not None and not row.vibration.computed]
    for ratio in dict.fromkeys(row.vibration.velocity_ratio for row in quoted if row.vibration):
        alike = [
            r for r in quoted if r.vibration is not None and r.vibration.velocity_ratio == ratio
        ]
        most = max(row.vibration_power for row in alike)
        notes.append(
            f"{' and '.join(row.name for row in alike)}: reported with "
            f"{_imposed(alike[0], contact)}, and with rigid friction puts up to {_power(most)} "
            f"into the contact for {_power(contact.power)} at the wheel"
        )
    for row in rows:
        if row.vibration is None or not row.vibration.computed:
            continue
        counted = (
            f"puts {_power(row.vibration_power)} into the contact; with that counted the "
            f"efficiency is {100.0 * row.efficiency_with_vibration:.1f} %, and "
            f"{100.0 * rows[0].efficiency:.1f} % without vibration"
        )
        idle = row.vibration.share >= 1.0
        notes.append(
            f"{row.name}: {_imposed(row, contact)}, "
            + ("too slow to lower the friction in this direction" if idle else counted)
        )
    notes.append(
        "a vibration is taken to reach the contact whole and in its plane; what teeth, shaft and "
        "mounting yield is missing there"
    )
    notes.append("locks is said of the worm in motion; of the worm at rest asperity rate tells it")
    freed = sum(not row.locks for row in rows)
    if rows[0].locks and freed:
        notes.append(
            f"sliding, the worm locks itself as it is; with {freed} of these ways it no longer does"
        )
    oil = contact.operation.lubricant.base_oil
    if oil != "mineral":
        notes.append(f"reductions were reported in mineral oil; here they act in {oil} oil")
    return tuple(notes)


def _imposed(row: Compared, contact: _Contact) -> str:
    moved = row.vibration
    assert moved is not None
    return (
        f"a peak velocity {moved.velocity_ratio:.3g} times that of sliding, here "
        f"{moved.velocity:.3g} m/s for {contact.velocity:.3g} m/s; it takes "
        f"{1e6 * moved.amplitude:.3g} um at {moved.frequency:.6g} Hz"
    )


def _power(watts: float) -> str:
    return f"{1e-3 * watts:.3g} kW" if watts >= 1e3 else f"{watts:.3g} W"
