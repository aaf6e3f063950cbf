"""Which other oil and which other wheel material of those with a name bring most of a safety."""

from collections.abc import Iterator
from typing import Any, NamedTuple

from asperity.errors import AsperityError
from asperity.gearset.library import every
from asperity.gearset.lubricants import Lubricant
from asperity.gearset.materials import WheelMaterial
from asperity.gearset.parameters import Gearset
from asperity.rating.levers import Judge
from asperity.rating.parameters import Operation
from asperity.results.words import Number, Sentence

_NOTHING = 0.01
_WORDS = {"operation.lubricant": "oil", "gearset.wheel_material": "wheel"}


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

    def told(self, asked: float, key: str = "") -> Sentence:
        """In words, beside what is asked: beyond ten times that, how far says nothing."""
        much, near = 10.0 * asked, Number.of(self.safety, ".3g", key and f"{key}.safety")
        safety = near if self.safety < much else f"over {much:g}"
        also = "".join(f"; {change}" for change in self.changes)
        return Sentence(f"{_WORDS[self.key]} {self.value} (", safety, f"{also})")


def alternatives(judge: Judge, gearset: Gearset, operation: Operation) -> tuple[Alternative, ...]:
    """Return the best other oil and the best other wheel material, the better one first.

    Parameters
    ----------
    judge : callable
        Returns the safety of a gearset and its operation.
    gearset, operation
        As they are.

    Returns
    -------
    tuple of Alternative
        Of each kind the best, where it brings at least a percent of the safety. Pairs that practice
        avoids are left out.
    """
    now = judge(gearset, operation)
    best: dict[str, Alternative] = {}
    for key, name, changed in _others(gearset, operation):
        try:
            then = judge(*changed)
        except AsperityError:
            continue
        if then > max(now * (1.0 + _NOTHING), best[key].safety if key in best else 0.0):
            best[key] = Alternative(key, name, then)
    return tuple(sorted(best.values(), key=lambda found: -found.safety))


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
