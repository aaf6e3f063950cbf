"""The command `optimise`: the best gearset by its rating, or with ``--over`` the best flanks.

A rating knows ratio, module and pressure angle; what the flanks are relieved by, and with which hob
they are cut, the loaded contact alone tells apart. `asperity.studies.optimise` has the former,
`asperity.drive.studies.relief` the latter, here with values between those that are given.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from asperity.casefile import Case
from asperity.errors import InputError
from asperity.results import Result
from asperity.runs import Run
from asperity.studies import optimise
from asperity.studies.optimise import Problem

if TYPE_CHECKING:
    from asperity.drive.studies.relief import Search


def prepare(
    case: Case,
    *,
    free: str = "",
    bounds: Sequence[str] | None = None,
    keep: Sequence[str] | None = None,
    over: Sequence[str] | None = None,
    at: Sequence[str] | None = None,
) -> "Problem | Search":
    """Return what is to be optimised; InputError where it cannot be.

    Parameters
    ----------
    case : Case
        Of a gearset and its operation; with ``over`` of its drive.
    free, bounds, keep : str, sequences of str
        As of `asperity.studies.optimise.prepare`: the gearset's own numbers.
    over, at : sequences of str
        As of `asperity.drive.studies.relief.prepare`: what the flanks are made by, and what they
        are to bear with.
    """
    if not over:
        if at:
            raise InputError(
                "--at says where flanks are to bear: name what may change with --over, as "
                "--over 'modification.tip_relief=0,20,40 um'"
            )
        return optimise.prepare(case, free=free, bounds=bounds, keep=keep)
    if free or bounds or keep:
        raise InputError(
            "--over is for flanks under load, --free, --bounds and --keep for the gearset's "
            "rating: take one after the other, the rating first"
        )
    from asperity.drive.studies import relief

    return relief.between(relief.prepare(case, over=over, at=at))


def answer(problem: "Problem | Search", run: Run) -> Result:
    """Return the best design; errors as of the two searches."""
    if isinstance(problem, Problem):
        return optimise.answer(problem, run)
    from asperity.drive.studies import relief

    return relief.answer(problem, run)
