"""The study of a gearset whose mounting has tolerances: it is drawn at their corners too."""

from collections.abc import Mapping
from typing import ClassVar

from asperity.flanks.study.result import FlankStudy


class MountedStudy(FlankStudy):
    """The flanks of a worm gearset, and their contact at the corners of how it may be mounted."""

    drawings: ClassVar[Mapping[str, str]] = {
        **FlankStudy.drawings,
        "corners": "asperity.flanks.study.plots:corners",
    }
    captions: ClassVar[Mapping[str, str]] = {
        **FlankStudy.captions,
        "corners": "The pattern of the flank s = +1 at the corners of the mounting tolerances.",
    }
