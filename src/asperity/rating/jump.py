"""How much a formula of a standard jumps at one of its own branch points."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Jump:
    """The two sides of a branch point.

    Attributes
    ----------
    formula : str
        Name of the function.
    at : float
        Where, in ``unit``.
    unit : str
        Unit of ``at``; ``""`` for a ratio.
    before, after : float
        Values on both sides of it.
    """

    formula: str
    at: float
    unit: str
    before: float
    after: float

    @property
    def relative(self) -> float:
        """Height of the jump over the value before it."""
        return self.after / self.before - 1.0
