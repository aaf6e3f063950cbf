"""The answer of ``asperity rig check``: findings, each with its evidence and what to do."""

import dataclasses
import itertools
from collections.abc import Mapping
from typing import Any, ClassVar

from asperity.arrays import FloatArray
from asperity.results import Result, quantity
from asperity.results.table import Columns, Table, table_of, table_of_rows


@dataclasses.dataclass(frozen=True)
class Found:
    """A finding in a recording.

    Attributes
    ----------
    file : str
        The recording.
    start : float or None
        Of the vibration of the segment it is in, s; None: all of the recording.
    name, evidence, remedy : str
        What is wrong, by which numbers, and what to do.
    signals : tuple of str
        What it is seen in.
    spoils : bool
        Whether numbers rest on it, so that they are not good.
    """

    file: str
    start: float | None
    name: str
    evidence: str
    remedy: str
    signals: tuple[str, ...]
    spoils: bool

    @property
    def where(self) -> str:
        """The segment it is in."""
        return "all of it" if self.start is None else f"{self.start:.0f} s"

    @property
    def told(self) -> str:
        """What stands above its picture."""
        return f"{self.file}, {self.where}: {self.name}"


class Checked(Result):
    """What was heard, checked.

    Attributes
    ----------
    found : tuple of Found
        In the order of recordings.
    """

    title = "What was heard, checked"
    stem = "check"
    drawings: ClassVar[Mapping[str, str]] = {"check": "asperity.tribometer.plots:plot_findings"}

    found: tuple[Found, ...]
    recordings: int = quantity("", "", "recordings")
    segments: int = quantity("", "", "segments with vibration")
    refused: int = quantity("", "", "of these refused, and not checked")
    findings: int = quantity("", "", "findings", key="count")
    spoiling: int = quantity("", "", "of these such that numbers are not good")
    x: FloatArray = quantity("", "", "across each picture", dims=("finding", "point"), only="file")
    y: FloatArray = quantity("", "", "up each picture", dims=("finding", "point"), only="file")
    marks: FloatArray = quantity(
        "", "", "where along x a finding lies", dims=("finding", "end"), only="file"
    )
    across: Any = quantity("", "", "what x is", dims=("finding",), only="file")
    up: Any = quantity("", "", "what y is", dims=("finding",), only="file")
    told: Any = quantity("", "", "what is found", dims=("finding",), only="file")

    def headline(self) -> tuple[str, ...]:
        """Say whether numbers can rest on it."""
        if self.found:
            return ()
        if self.notes:
            return ("Nothing is found, but not all could be checked.",)
        return ("Nothing is wrong with what was heard.",)

    def to_json(self) -> dict[str, Any]:
        """Return the findings."""
        listed = [
            {"file": one.file, "start_s": one.start, "name": one.name, "evidence": one.evidence,
             "remedy": one.remedy, "signals": list(one.signals), "spoils": one.spoils}
            for one in self.found
        ]  # fmt: skip
        return super().to_json() | {"findings": listed}

    def tables(self) -> tuple[Table, ...]:
        """Return the counts, and a row a finding with what to do below."""
        told = [
            f"{place}: {one.evidence}; {one.remedy}"
            for place, one in enumerate(self.found, start=1)
        ]
        number = itertools.count(1)
        columns: Columns = {
            "": lambda one: str(next(number)), "file": "file",
            "vibration at": "where", "finding": "name",
            "numbers": lambda one: "not good" if one.spoils else "to know",
        }  # fmt: skip
        return table_of(self), table_of_rows(self.found, columns, remarks=(*told, *self.notes))
