"""The claims ledger: what the thesis says, what comes out here, and whether the two agree."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from asperity.thesis.exhibits import Exhibit

Verdict = Literal["reproduced", "differs"]


@dataclasses.dataclass(frozen=True)
class Finding:
    """What the computation of a claim gave.

    Attributes
    ----------
    verdict : {'reproduced', 'differs'}
        Whether every part of the claim holds.
    ours : str
        The numbers in a phrase.
    reason : str
        Why it differs, or how closely it agrees.
    numbers : mapping of str to float
        The numbers, each named with its unit.
    how : sequence of str
        Commands and functions that give them.
    """

    verdict: Verdict
    ours: str
    reason: str
    numbers: Mapping[str, float]
    how: Sequence[str]

    @classmethod
    def judged(
        cls,
        parts: Mapping[str, bool],
        ours: str,
        reason: str,
        numbers: Mapping[str, float],
        how: Sequence[str],
    ) -> "Finding":
        """Judge by the parts of a claim; if one fails, the reason begins with what holds or not."""
        failed = [part for part, holds in parts.items() if not holds]
        held = [part for part, holds in parts.items() if holds]
        if failed:
            reason = f"Does not hold: {'; '.join(failed)}. {reason}"
        if failed and held:
            reason = f"Holds: {'; '.join(held)}. {reason}"
        verdict: Verdict = "differs" if failed else "reproduced"
        return cls(verdict, ours, reason, dict(numbers), tuple(how))


@dataclasses.dataclass(frozen=True)
class Claim(Exhibit):
    """A statement of the thesis, whose number never changes.

    Attributes
    ----------
    section : str
        Where the thesis makes it.
    text : str
        What is claimed.
    thesis : str
        The thesis's number or word.
    """

    kind = "claim"
    section: str
    text: str
    thesis: str

    def make(self) -> Finding:
        """Compute what tests it."""
        finding: Finding = self.function()
        return finding


@dataclasses.dataclass(frozen=True)
class Entry:
    """A claim with its finding: a line of the ledger."""

    number: str
    section: str
    text: str
    thesis: str
    finding: Finding

    @classmethod
    def of(cls, claim: Claim, finding: Finding) -> "Entry":
        """The line of a claim."""
        return cls(claim.number, claim.section, claim.text, claim.thesis, finding)

    def to_json(self) -> dict[str, Any]:
        """As plain values."""
        return {
            "id": self.number,
            "section": self.section,
            "claim": self.text,
            "thesis": self.thesis,
            "ours": self.finding.ours,
            "verdict": self.finding.verdict,
            "reason": self.finding.reason,
            "numbers": dict(self.finding.numbers),
            "how": list(self.finding.how),
        }

    @classmethod
    def from_json(cls, plain: Mapping[str, Any]) -> "Entry":
        """Undo `to_json`."""
        finding = Finding(
            plain["verdict"], plain["ours"], plain["reason"], plain["numbers"], plain["how"]
        )
        return cls(plain["id"], plain["section"], plain["claim"], plain["thesis"], finding)
