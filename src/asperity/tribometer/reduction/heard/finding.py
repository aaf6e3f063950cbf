"""A finding: what is wrong with what was heard, by which numbers, and what to do."""

import dataclasses

from asperity.arrays import FloatArray


@dataclasses.dataclass(frozen=True)
class Curve:
    """What a finding is seen by, as points of a picture.

    Attributes
    ----------
    x, y : ndarray
        Points.
    across, up : str
        What they are, with units.
    marked : tuple of (float, float)
        Where along x the finding lies.
    """

    x: FloatArray
    y: FloatArray
    across: str
    up: str
    marked: tuple[tuple[float, float], ...] = ()


@dataclasses.dataclass(frozen=True)
class Finding:
    """Something that is wrong, or that a reader should know.

    Attributes
    ----------
    name : str
        Of what is wrong, in a few words.
    evidence : str
        Numbers with units.
    remedy : str
        What to do.
    signals : tuple of str
        What it is seen in.
    curve : Curve
        Its picture.
    index : int or None
        Of the segment it is in; None: the whole recording.
    spoils : bool
        Whether numbers rest on it that nothing mends.
    """

    name: str
    evidence: str
    remedy: str
    signals: tuple[str, ...]
    curve: Curve
    index: int | None = None
    spoils: bool = True

    @property
    def flag(self) -> str:
        """In a line."""
        return f"{self.name}: {self.evidence} ({self.remedy})"
