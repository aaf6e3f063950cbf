"""What moves a safety most: one input raised alone, or another oil or wheel material."""

import math
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from asperity.errors import AsperityError
from asperity.gearset.library import every
from asperity.gearset.lubricants import Lubricant
from asperity.gearset.materials import WheelMaterial
from asperity.gearset.parameters import Gearset
from asperity.rating.parameters import DEFAULT_LIFE, Operation
from asperity.results.words import Number, Sentence

_STEP = 1.01
# Of ISO 3448. Within a step of a percent the sump's temperature of ISO/TR 14521 says nothing of an
# oil: it dips sharply at 220.3 mm²/s, where the commonest oil of worm gears stands.
_GRADE = 1.5
_NOTHING = 0.05
_LITTLE = 0.01  # of a safety
_WORDS = {"operation.lubricant": "oil", "gearset.wheel_material": "wheel"}
_OIL = "oil viscosity"

Judge = Callable[[Gearset, Operation], float]


class Lever(NamedTuple):
    """An input that moves a safety.

    Attributes
    ----------
    name : str
        What is raised, in words.
    keys : tuple of str
        The keys of a case that it takes, as ``table.key``.
    exponent : float
        Percent of the safety for a percent of the input; of an oil's viscosity, per percent on the
        way to the next grade.
    """

    name: str
    keys: tuple[str, ...]
    exponent: float

    def sentence(self, key: str = "") -> Sentence:
        """In words: what to do for more safety, and what a percent of it brings."""
        word, times = ("more", 1.0) if self.exponent > 0 else ("less", -1.0)
        brings = Number.of(self.exponent, ".1f", key and f"{key}.exponent", times)
        return Sentence(f"{word} {self.name} (", brings, ")")


def levers(judge: Judge, gearset: Gearset, operation: Operation) -> tuple[Lever, ...]:
    """Return what moves a safety, the strongest first.

    Parameters
    ----------
    judge : callable
        Returns the safety of a gearset and its operation.
    gearset, operation
        As they are.

    Returns
    -------
    tuple of Lever
        Those of which a percent brings at least a twentieth of a percent.
    """
    now = judge(gearset, operation)
    found = []
    if not (math.isfinite(now) and now > 0.0):
        return ()
    for name, keys, changed in _raised(gearset, operation):
        try:
            then = judge(*changed())
        except AsperityError:
            continue
        if math.isfinite(then) and then > 0.0:
            step = _GRADE if name == _OIL else _STEP
            found.append(Lever(name, keys, math.log(then / now) / math.log(step)))
    strong = [lever for lever in found if abs(lever.exponent) >= _NOTHING]
    return tuple(sorted(strong, key=lambda lever: -abs(lever.exponent)))


Raised = tuple[str, tuple[str, ...], Callable[[], tuple[Gearset, Operation]]]


def _raised(gearset: Gearset, operation: Operation) -> Iterator[Raised]:
    """Yield what can be raised by itself: its name, its keys, and how."""

    def gears(**values: float) -> Callable[[], tuple[Gearset, Operation]]:
        return lambda: (gearset.model_copy(update=values, units="SI"), operation)

    def run(**values: Any) -> Callable[[], tuple[Gearset, Operation]]:
        return lambda: (gearset, operation.model_copy(update=values, units="SI"))

    more = _STEP
    g = gearset.geometry
    millimetres = {
        "centre_distance": g.centre_distance,
        "axial_module": g.axial_module,
    }
    # Everything else of the geometry keeps its proportions to these.
    grown = {key: 1e-3 * value * more for key, value in millimetres.items()}
    widths = ("worm_face_width", "wheel_face_width", "rim_thickness")
    given = {key: getattr(gearset, key) for key in widths}
    grown |= {key: value * more for key, value in given.items() if value is not None}
    if gearset.worm_pitch_diameter is not None:
        grown["worm_pitch_diameter"] = gearset.worm_pitch_diameter * more
    elif gearset.diameter_factor is not None:
        grown["diameter_factor"] = gearset.diameter_factor
    yield "size", ("gearset.centre_distance", "gearset.axial_module"), gears(**grown)
    yield (
        "diameter factor",
        ("gearset.diameter_factor",),
        gears(
            diameter_factor=g.diameter_factor * more,
            centre_distance=1e-3 * g.centre_distance,
            axial_module=1e-3 * g.axial_module,
        ),
    )
    rough = gearset.worm_roughness
    yield "worm roughness", ("gearset.worm_roughness",), gears(worm_roughness=rough * more)
    torques: dict[str, Any] = {"output_torque": operation.output_torque * more}
    keys = ["operation.output_torque"]
    if operation.through_travel_torque is not None:
        torques["through_travel_torque"] = operation.through_travel_torque * more
        keys.append("operation.through_travel_torque")
    spectrum = operation.spectrum
    if operation.steps is None or (spectrum is not None and spectrum.duty_class is not None):
        # The steps of a class follow the rated torque.
        yield "torque", tuple(keys), run(**torques)
    else:
        steps = tuple(
            step.model_copy(update={"output_torque": step.torque * more}, units="SI")
            for step in operation.steps
        )
        keys.append("operation.duty_cycle" if spectrum is None else "spectrum.step")
        heavier = operation.with_steps(steps, **torques)
        yield "torque", tuple(keys), lambda: (gearset, heavier)
    oil = operation.lubricant
    thicker = {key: getattr(oil, key) * _GRADE for key in ("viscosity_40", "viscosity_100")}
    yield (
        _OIL,
        ("operation.lubricant",),
        run(lubricant=oil.model_copy(update=thicker, units="SI")),
    )
    speed = operation.worm_speed * more
    if operation.steps is None or all(step.worm_speed is None for step in operation.steps):
        yield "worm speed", ("operation.worm_speed",), run(worm_speed=speed)
    else:
        # A step's own speed goes with it, as its torque does.
        paced = tuple(
            step
            if step.worm_speed is None
            else step.model_copy(update={"worm_speed": step.worm_speed * more}, units="SI")
            for step in operation.steps
        )
        own = "operation.duty_cycle" if spectrum is None else "spectrum.step"
        faster = operation.with_steps(paced, worm_speed=speed)
        yield "worm speed", ("operation.worm_speed", own), lambda: (gearset, faster)
    if operation.steps is None:
        turns = operation.wheel_revolutions
        if turns is None:
            life = (operation.life or DEFAULT_LIFE) * more
            yield "life", ("operation.life",), run(life=life)
        else:
            raised = run(wheel_revolutions=turns * more)
            yield "life", ("operation.wheel_revolutions",), raised


class Alternative(NamedTuple):
    """Another choice from a table of things that have a name, all else as it is.

    Attributes
    ----------
    key : str
        What would be chosen otherwise, as ``table.key`` of a case.
    value : str
        The best choice.
    safety : float
        The safety with it.
    changes : tuple of str
        What else it changes in the words of the verdict.
    """

    key: str
    value: str
    safety: float
    changes: tuple[str, ...] = ()

    def sentence(self, required: float, key: str = "") -> Sentence:
        """In words, beside what is asked: beyond ten times that, how far says nothing."""
        much, near = 10.0 * required, Number.of(self.safety, ".3g", key and f"{key}.safety")
        safety = near if self.safety < much else f"over {much:g}"
        also = "".join(f"; {change}" for change in self.changes)
        return Sentence(f"{_WORDS[self.key]} {self.value} (", safety, f"{also})")


def alternatives(
    judge: Judge,
    gearset: Gearset,
    operation: Operation,
    kept: Callable[[Alternative], Alternative | None] = lambda other: other,
) -> tuple[Alternative, ...]:
    """Return the best other oil and the best other wheel material, the better one first.

    Parameters
    ----------
    judge, gearset, operation
        As of `levers`.
    kept : callable, optional
        Returns an alternative with what is to be said of it, or None if it is none.

    Returns
    -------
    tuple of Alternative
        Of each kind the best that is kept, where it brings at least a percent of the safety. Pairs
        that practice avoids are left out.
    """
    least = judge(gearset, operation) * (1.0 + _LITTLE)
    better: dict[str, list[Alternative]] = {}
    for key, name, changed in _others(gearset, operation):
        try:
            then = judge(*changed)
        except AsperityError:
            continue
        if then > max(least, 0.0):
            better.setdefault(key, []).append(Alternative(key, name, then))
    found = [
        next(filter(None, map(kept, sorted(others, key=lambda other: -other.safety))), None)
        for others in better.values()
    ]
    return tuple(sorted(filter(None, found), key=lambda other: -other.safety))


def _others(
    gearset: Gearset, operation: Operation
) -> Iterator[tuple[str, str, tuple[Gearset, Operation]]]:
    for oil in every(Lubricant):
        if not gearset.wheel_material.avoids(oil.base_oil):
            changed: Any = operation.model_copy(update={"lubricant": oil})
            yield "operation.lubricant", oil.name, (gearset, changed)
    for material in every(WheelMaterial):
        if not material.avoids(operation.lubricant.base_oil):
            changed = gearset.model_copy(update={"wheel_material": material})
            yield "gearset.wheel_material", material.name, (changed, operation)
