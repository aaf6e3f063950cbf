"""Marches that go on until they have settled, where the case says no duration."""

import dataclasses
import math
from typing import Protocol, TypeVar

from asperity.slider.advice import advice
from asperity.slider.kept_rings import UNALIKE
from asperity.slider.model import Model
from asperity.slider.result import SlideResult
from asperity.slider.ringing import FARTHEST, WHEN_SETTLED
from asperity.slider.steady import two_states

_FURTHER = 1.5, 4.0  # times what is marched, that it goes on to at once

M = TypeVar("M", bound=Model)
A = TypeVar("A", bound=SlideResult)
A_co = TypeVar("A_co", bound=SlideResult, covariant=True)


class Marching(Protocol[A_co]):
    """A march whose end can be put off."""

    @property
    def duration(self) -> float:
        """Time it is marched for, s."""
        ...

    def to_the_end(self) -> tuple[A_co, float | None]:
        """March to that time; the answer, and the duration in s that would do where foreseen.

        What has settled is foreseen none where its mean is where it goes to.
        """
        ...

    def go_on(self, duration: float) -> None:
        """Take a later end, s."""
        ...


def until_settled(
    model: Model,
    marching: Marching[A],
    instead: str | None = "periodic",
    farthest: float = math.inf,
) -> A:
    """March to the end; where the case says no duration, on until it has settled, within bounds.

    Parameters
    ----------
    model : Model
        The body as the case has it.
    marching : Marching
        Its march, wherever it stands.
    instead : str, optional
        The method that looks for a state where no duration is foreseen that would do.
    farthest : float
        Time up to which it goes on at most, s; no later than that by the bounds.
    """
    farthest = min(farthest, FARTHEST * model.duration)
    while True:
        answer, foreseen = marching.to_the_end()
        marched = marching.duration
        goes_on = foreseen is not None or not answer.settled
        # All of a later window is still to come.
        room = marched + model.window <= farthest
        if goes_on and model.solve.duration is None and room:
            low, high = (share * marched for share in _FURTHER)
            marching.go_on(min(max(foreseen or high, low), high, farthest))
            continue
        if not answer.settled:
            slips = not model.vibrates and two_states(model) in answer.notes
            rings = answer.settled_by.startswith(UNALIKE)
            foreseen = None if rings else foreseen
            note = advice(foreseen, model, instead, slips=slips, rings=rings)
            answer = dataclasses.replace(answer, notes=(*answer.notes, note))
        if marched == model.duration:
            return answer
        until = WHEN_SETTLED if answer.settled else "and has not settled"
        note = f"solve.duration is left out: the march went on to {marched:.3g} s, {until}"
        return dataclasses.replace(answer, notes=(note, *answer.notes))


def lasting(model: M, duration: float) -> M:
    """Return a body that is marched for a duration in s."""
    solve = model.solve.model_copy(update={"duration": duration}, units="SI")
    return dataclasses.replace(model, solve=solve)
