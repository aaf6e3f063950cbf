"""Of what order the error of a step is, by friction, wave and drive: part of a difference it is."""

from asperity.slider.model import Model

# What the difference to twice the step is of the error, by the order.
_ORDER_HALF = 0.41
ORDER_ONE = 1.0
ORDER_TWO = 3.0
_LEAST_EXPONENT = 0.5  # below it friction along one line is of order one
_LEAST_WHERE_IT_TURNS = 0.7  # and that of a slip that turns, or of a load that changes
_LEAST_TO_FOLLOW = 0.1  # exponent, below which friction turns at once
_ALONG = 1e-9


def part_of_difference(model: Model) -> float:
    """Return what the error is of the difference to the solution beside it."""
    return 1.0 / of_the_error(model) + (1.0 if model.meets_corners else 0.0)


def power_of(model: Model) -> float:
    """Return what power of the step its error goes with, for a step that would do."""
    return 2.0 if of_the_error(model) == ORDER_TWO else 1.0


def of_the_error(model: Model) -> float:
    """Return what the difference to a solution on twice the step is of the error of the first."""
    smooth = model.shape is None or not model.shape.cornered
    friction = model.friction
    loaded = model.vibrates and abs(model.unit_direction[2]) > _ALONG
    if model.solve.scheme == "two-phase":
        return ORDER_ONE
    if friction.model == "lugre" and model.normal is not None and loaded:
        return ORDER_ONE  # where the limit falls with load and speed, as far as a step goes
    if friction.model == "dahl" and friction.exponent < _LEAST_WHERE_IT_TURNS:
        # A body free sideways answers to a slip that turns, and friction to a load that changes;
        # where it turns with the slip at once the step makes them chatter.
        turns = model.slider.free and abs(model.unit_direction[1]) > _ALONG
        if turns and friction.exponent < _LEAST_TO_FOLLOW:
            return _ORDER_HALF
        stiff = friction.exponent < _LEAST_EXPONENT and not (smooth and friction.law == "vector")
        if turns or stiff or loaded:
            return ORDER_ONE
    # Where Coulomb friction stops a body after a corner, errors fall by four on average only.
    stops = friction.model == "coulomb" and not (model.slider.rigid and not model.slider.free)
    follows = friction.model == "lugre" or model.normal is not None
    return ORDER_ONE if (follows or stops) and not smooth else ORDER_TWO
