"""The answer of a march that is at its end, judged by all that is known of it."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from asperity.results.settled import Standing
from asperity.slider.astray import come_to_its_size, motion_across
from asperity.slider.chance import judged, standing_by_cycles, wandering
from asperity.slider.flights import flies_for_long
from asperity.slider.foreseen import needed
from asperity.slider.integrators import Integrator
from asperity.slider.march_end import MarchEnd, end_of_march, rings_unheard
from asperity.slider.model import Model
from asperity.slider.nearby import comes_there, next_to
from asperity.slider.on_its_way import brought_home, far_from_home, most_off, still_goes
from asperity.slider.result import SlideResult
from asperity.slider.ring_on_drive import ring_at_end
from asperity.slider.ringing import heard, ringing_notes, rings
from asperity.slider.steady import off_steady, parts_of_slips
from asperity.slider.summary import summarise
from asperity.slider.timetable import WindowMeans, march_notes


def judged_answer(
    model: Model,
    window: WindowMeans,
    sums: np.void,
    ends: tuple[tuple[float, float], tuple[float, float]],
    body: Callable[[], Integrator],
    *,
    leaves: str = "",
    slips: bool = False,
    notes: tuple[str, ...] = (),
    foretell: bool = True,
    next_cycles: Iterator[float] | None = None,
    **told: Any,
) -> tuple[SlideResult, float | None]:
    """Return the answer of a march that is at its end, judged by all that is known of it.

    Parameters
    ----------
    model : Model
        The body as the case has it.
    window : WindowMeans
        What it has come to.
    sums : np.void
        Over the whole window.
    ends : tuple of 2 tuples
        Energies where the window begins and ends, as `summarise` takes them.
    body : callable
        Gives the body at the end; called where its means agree.
    leaves : str
        What it lacks that is next to steady sliding which is unstable.
    slips : bool
        Whether it is seen to stick and slip beside steady sliding.
    notes : tuple of str
        Beside those of the march.
    foretell : bool
        Whether it is asked what duration would do.
    next_cycles : iterator of float, optional
        Ratios of the cycles that follow, where they are marched more cheaply than one by one.
    told
        What else `summarise` takes.

    Returns
    -------
    SlideResult
        The answer.
    float or None
        The duration that would do, s; None where nothing is missing, or none is foreseen.
    """
    table = window.table
    wanders: tuple[str, ...] = ()
    end = MarchEnd(None)
    ratio = float(sums["drive_force"] / sums["steps"])
    standing, steady, means = standing_by_cycles(window, body, sums)
    lacks = leaves or off_steady(model, ratio) or parts_of_slips(window.model, sums)
    if standing.settled and lacks:
        standing = Standing(False, lacks)
    standing = heard(standing, model, window.model.duration)
    across = motion_across(body, window) if standing.settled else None
    if across is not None:
        standing = Standing(False, str(across))
    if standing.settled:
        at_end = body()
        standing, wanders = judged(standing, at_end, table, sums, means)
        if standing.settled:
            end = end_of_march(at_end, table, sums, window)
    ever = None if standing.settled else wandering(body(), window, sums)
    if ever is not None:
        standing = Standing(False, str(ever))
    follows = True
    if standing.settled and rings(model):
        # Its mean goes nowhere.
        follows = not rings_unheard(body(), table, ratio)
        end = end._replace(ratio=None)
    comes_to = end.ratio
    home = brought_home(window, ratio, comes_to)
    is_far = far_from_home(window, ratio, comes_to)
    if comes_to is not None and is_far:
        standing, end = Standing(False, still_goes(ratio, comes_to)), MarchEnd(None)
    elif comes_to is not None and home is not None:
        wanders += (still_goes(ratio, comes_to, home),)
    answer = summarise(
        model, model.parameters(table.step), table.step, sums, *ends,
        standing=standing,
        step_error=end.error,
        residual=window.residual, steps=table.steps, cycles=table.cycles, substeps=model.substeps,
        notes=(*march_notes(steady), *ringing_notes(model, follows=follows), *wanders, *notes),
        **told,
    )  # fmt: skip
    if not foretell or ever is not None:
        return answer, None
    if across is not None:
        return answer, come_to_its_size(across, window.model)
    if answer.settled or (is_far and home is not None):
        return answer, home
    if flies_for_long(body(), table, sums):
        return answer, None
    return answer, foretold(window, body(), next_cycles, is_far=is_far, slips=slips)


def foretold(
    window: WindowMeans,
    body: Integrator,
    next_cycles: Iterator[float] | None = None,
    *,
    is_far: bool = False,
    slips: bool = False,
) -> float | None:
    """Return the duration in s that would do of a march that has not settled; None where none is.

    Parameters
    ----------
    window : WindowMeans
        What it has come to.
    body : Integrator
        At its end; left as it is.
    next_cycles : iterator of float, optional
        As `judged_answer` takes it.
    is_far : bool
        Whether its mean agrees in the halves of the window, far from where it goes to.
    slips : bool
        Whether it is seen to stick and slip beside steady sliding.
    """
    model, table = window.model, window.table
    # One that ends in the ramp is next to a state of less vibration than it comes to.
    in_ramp = model.vibrates and model.duration < model.start + model.ramp
    near = None if in_ramp else next_to(body, table, next_cycles)
    if is_far and near is not None:
        return comes_there(near, window.model, most_off(near.ratio))
    return needed(window, near or ring_at_end(window, body), slips=slips)
