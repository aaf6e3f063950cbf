"""Paths of a counter-surface in static contact: from guide to guide, from place to place."""

from collections.abc import Sequence

from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.static import Guide, StaticState, move_to


def on_guide(
    solver: IncrementSolver, guide: Guide, state: StaticState, place: float = 0.0
) -> StaticState:
    """Count the place of a state on another guide, to go on along it.

    Parameters
    ----------
    solver : IncrementSolver
        Of the way to come; friction may differ from that of the way before.
    guide : Guide
        The next one; at ``place`` the counter-surface has to stand where it stands.
    state : StaticState
        Where the way before ended.
    place : float
        m or rad.

    Returns
    -------
    StaticState
        The same contact with its load along the next guide.
    """
    return StaticState(place, guide.load(solver.problem, state.contact), state.contact, 0)


def follow(
    solver: IncrementSolver,
    guide: Guide,
    places: Sequence[float],
    *,
    start: StaticState | float = 0.0,
    increments: int = 1,
) -> tuple[StaticState, ...]:
    """Move the counter-surface from place to place.

    Parameters
    ----------
    solver, guide, start
        As `move_to`.
    places : sequence of float
        Where to, m or rad, one after the other.
    increments : int
        Equal parts of the way to each.

    Returns
    -------
    tuple of StaticState
        One for each place.

    Raises
    ------
    ConvergenceError
        As `move_to`.
    """
    states: list[StaticState] = []
    for place in places:
        start = move_to(solver, guide, place, start=start, increments=increments)
        states.append(start)
    return tuple(states)
