"""The tables of a case that a study of a worm gearset begins with."""

import dataclasses
from pathlib import Path
from typing import Self

from asperity.casefile import Case, naming_source
from asperity.gearset import Gearset
from asperity.rating.driven import driven
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.tables import operation_of
from asperity.studies.requirements import Requirements


@dataclasses.dataclass(frozen=True)
class Gears:
    """A worm gearset, how it runs and how it is rated.

    Attributes
    ----------
    gearset, operation, options
        The tables ``[gearset]``, ``[operation]`` and ``[rating]``, the last of which may be
        missing.
    requirements : Requirements
        The table ``[requirements]``; what is assumed where it is missing.
    folder : pathlib.Path
        Where relative file names among the options start.
    """

    gearset: Gearset
    operation: Operation
    options: RatingOptions | None
    folder: Path
    requirements: Requirements = dataclasses.field(default_factory=Requirements)

    @classmethod
    def of(cls, case: Case) -> Self:
        """Return the tables of a case; raises InputError where one is missing."""
        options = case.get(RatingOptions)
        gearset = case.require(Gearset)
        with naming_source(case):
            operation = driven(gearset, operation_of(case), options)
        return cls(
            gearset, operation, options, case.folder, case.get(Requirements) or Requirements()
        )
