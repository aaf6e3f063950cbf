"""Stretches of a wear test: as long as it takes to slide a distance, by the encoders."""

from asperity.casefile import Case
from asperity.tribometer.instruments.protocols import InstrumentError
from asperity.tribometer.options import Plan, Reduction
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.procedure.logger import Logger, Window

_LOOKED_AT = 1.0  # s, after which the distance is counted
_STARTING = 10.0  # s, in which discs begin to slide
_LEAST = 1e-5  # m/s, below which nothing slides


class Sliding:
    """Counts how far discs slide on each other.

    Parameters
    ----------
    case : Case
        The configuration.
    plan : Plan
        What is run.

    Attributes
    ----------
    idle : float
        How long discs are watched at rest, s: of a wear test until encoders have told all.
    """

    def __init__(self, case: Case, plan: Plan) -> None:
        self._pair = pair_of(case)
        settled = case.get(Reduction, Reduction()).speed_settling
        self.idle = plan.idle if plan.distance is None else max(plan.idle, settled)

    def over(self, logger: Logger, window: Window) -> float:
        """Return how far the discs slid over a window, m."""
        levels = logger.levels(window)
        steel, bronze = self._pair.rims(levels["speed_steel"], levels["speed_bronze"])
        return float(abs(steel - bronze)) * window.samples * logger.interval

    def far(self, logger: Logger, distance: float, crc32: int) -> tuple[Window, float]:
        """Record until the discs have slid a distance.

        Parameters
        ----------
        logger : Logger
            What records.
        distance : float
            m; a second is recorded where it is nothing.
        crc32 : int
            Check sum that the window's follows.

        Returns
        -------
        window : Window
            All of it.
        slid : float
            m.

        Raises
        ------
        InstrumentError
            The discs do not slide.
        """
        window = logger.watch(_LOOKED_AT, crc32=crc32)
        slid = self.over(logger, window)
        while slid < distance:
            part = logger.watch(_LOOKED_AT, crc32=window.crc32)
            slid += self.over(logger, part)
            window.join(part)
            seconds = window.samples * logger.interval
            if seconds > _STARTING and slid < _LEAST * seconds:
                raise InstrumentError(
                    f"the discs slid {1e3 * slid:.2g} mm in {seconds:.0f} s: look at motors and "
                    "encoders",
                    kind="no sliding",
                )
        return window, slid
