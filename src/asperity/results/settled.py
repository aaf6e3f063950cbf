"""Whether an answer has settled, by what that shows, and the error its step makes: said once.

What has not settled is no prediction: whoever shows it marks it, and whoever chooses among answers
leaves it out.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

from asperity.results.quantity import quantity
from asperity.results.words import Sentence, text_of

MARK = "*"
"""Behind a number that has not settled, in a table."""


class Standing(NamedTuple):
    """Whether something has settled.

    Attributes
    ----------
    settled : bool
        Whether it stays as it is.
    settled_by : str
        What shows it, or what is missing.
    """

    settled: bool
    settled_by: str

    @classmethod
    def of(cls, missing: Sequence[str], shown: str) -> "Standing":
        """Return that of what lacks some things; of what lacks none, with what shows that."""
        return cls(not missing, "; ".join(missing) or shown)


def whether_settled() -> Any:
    """Declare the field that says whether an answer has settled."""
    return quantity("", "", "whether it has settled")


def by_what() -> Any:
    """Declare the field that says what shows it, or what is missing."""
    return quantity("", "", "settled by", shown=False)


def error_of_step() -> Any:
    """Declare the field of the error that the step makes, of what the answer is asked for."""
    return quantity("", "", "error of the ratio from the step", default=None)


def smaller_step(
    step: float,
    over: float,
    *,
    order: float = 2.0,
    given: bool = True,
    sure: bool = True,
    instead: str = "none",
) -> str:
    """Return what step would do in place of one that makes too great an error, as advice.

    Parameters
    ----------
    step : float
        That was taken, s.
    over : float
        How many times too great its error is.
    order : float
        What power of the step the error goes with.
    given : bool
        Whether the case says the step: it is not to blame else.
    sure : bool
        Whether that is known of the error; what is left of powers may go by another power of it.
    instead : str
        What else may be given, or left out.

    Returns
    -------
    str
        A part of a sentence.
    """
    does = step / (1.1 * over ** (1.0 / order))
    if not given:
        return f"a solve.step of {does:.2g} s may do"
    if not sure:
        return f"give {instead}, or a smaller solve.step: {does:.2g} s may do"
    return f"give a solve.step of at most {does:.2g} s, or {instead}"


def marked(values: Sequence[Any], loose: Sequence[bool]) -> list[Any]:
    """Return numbers as a table has them, those that have not settled marked."""
    return [
        Sentence(text_of(value), f" {MARK}") if out else value
        for value, out in zip(values, loose, strict=True)
    ]


def unsettled(answer: object) -> str:
    """Return what an answer lacks for a prediction; empty where it has settled or cannot."""
    return "" if getattr(answer, "settled", True) else str(getattr(answer, "settled_by", ""))


def told(answer: object) -> tuple[str, ...]:
    """Return what stands above the numbers of an answer that has not settled."""
    missing = unsettled(answer)
    return (f"Not settled, no prediction: {missing}.",) if missing else ()
