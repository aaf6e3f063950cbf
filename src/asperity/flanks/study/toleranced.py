"""What the tolerances of a case come to on the exact flanks of its gearset."""

import dataclasses
from typing import TYPE_CHECKING, Any

from asperity.errors import InputError
from asperity.flanks.measuring.corners import Corner, Mounted, Offset, Side, corner_table
from asperity.flanks.meshing.analysis import Analysis
from asperity.flanks.parameters import MeasuringOptions, Mount
from asperity.flanks.wheel.enveloped import Wheel
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.backlash import Backlash
from asperity.gearset.tolerancing.grades import Allowed, graded
from asperity.gearset.tolerancing.table import Tolerances
from asperity.results.table import Table

if TYPE_CHECKING:
    import xarray as xr


@dataclasses.dataclass(frozen=True, eq=False)
class Toleranced:
    """What tolerances leave of a gearset.

    Attributes
    ----------
    backlash : Backlash
        By the exact flanks.
    nominal : Corner
        How it meshes with nothing off.
    corners : tuple of Corner
        And at the corners of the mounting tolerances.
    graded : tuple of Allowed
        Deviations that its grade allows.
    resolution : float
        Size below which a transmission error is rounding, rad.
    """

    backlash: Backlash
    nominal: Corner
    corners: tuple[Corner, ...]
    graded: tuple[Allowed, ...]
    resolution: float

    @classmethod
    def of(
        cls,
        gearset: Gearset,
        wheel: Wheel,
        analysis: Analysis,
        tolerances: Tolerances,
        wear: float | None = None,
    ) -> "Toleranced":
        """Return it of a gearset that has been analysed; the wear in um.

        Raises
        ------
        ConvergenceError
            At a corner the worm does not reach the wheel.
        """
        mounted = Mounted.of(analysis.pair, wheel, tolerances)
        backlash = mounted.backlash(gearset, tolerances, analysis.play.worm_angle, wear)
        sides = {
            side: Side(
                flank.pattern.area_fraction, *flank.pattern_centre, flank.transmission.peak_to_peak
            )
            for side, flank in analysis.flanks.items()
        }
        return cls(
            backlash,
            Corner(Offset(), sides, analysis.flanks[1].pattern.gap),
            mounted.corners(),
            () if tolerances.grade is None else graded(analysis.pair.geometry, tolerances.grade),
            analysis.flanks[1].transmission.resolution("peak_to_peak"),
        )

    def tables(self) -> tuple[Table, ...]:
        """Return the backlash, the corners, and what the grade allows."""
        tables = [self.backlash.table("tolerances.backlash")]
        if self.corners:
            tables.append(corner_table(self.corners, self.nominal, self.resolution))
        if self.graded:
            rows = [
                (one.name, one.symbol, one.value, "um", one.part, one.source.name)
                for one in self.graded
            ]
            heads = "deviation that is allowed", "symbol", "value", "unit", "of", "source"
            said = f"Grade {self.graded[0].grade}"
            notes = {f"{s.name}: {s.confidence}, {s.note}": None for s in map(_source, self.graded)}
            tables.append(Table.of(heads, rows, title=said, left=6, remarks=notes))
        return tuple(tables)

    def to_json(self) -> dict[str, Any]:
        """Return everything by key."""
        return {
            "backlash": self.backlash.to_json(),
            "corners": [corner.to_json() for corner in self.corners],
            "grades": [
                {"part": one.part, "name": one.name, "symbol": one.symbol, "value_um": one.value,
                 "source": str(one.source)}
                for one in self.graded
            ],
        }  # fmt: skip

    def added(self, dataset: "xr.Dataset") -> "xr.Dataset":
        """Return a dataset with the gap at every corner besides."""
        if not self.corners:
            return dataset
        import numpy as np
        import xarray as xr

        rows = dataset["gap"].dims[1:]
        gaps = np.stack([corner.gap for corner in self.corners])
        names = [corner.offset.name for corner in self.corners]
        said = {"units": "mm", "long_name": "smallest gap of the flank s = +1 at a corner"}
        corner = xr.Variable(
            "corner", np.array(names, dtype=object),
            {"units": "1", "long_name": "corner of the mounting tolerances"},
        )  # fmt: skip
        return dataset.assign(corner_gap=(("corner", *rows), gaps, said)).assign_coords(
            corner=corner
        )


def require_once(
    tolerances: Tolerances | None, mount: Mount | None, measuring: MeasuringOptions | None
) -> None:
    """Refuse a thickness that is given twice; raises InputError."""
    if tolerances is None:
        return
    key = "fit" if tolerances.fit is not None else "thread"
    set_ = getattr(tolerances, key) is not None
    if set_ and mount is not None and mount.backlash is not None:
        raise InputError(
            f"mount.backlash and tolerances.{key} are given, and both say how thick the threads "
            "are; keep one of them"
        )
    for own, other in (("thread_tolerance", key), ("tooth_tolerance", "tooth")):
        if getattr(measuring, own, None) is not None:
            raise InputError(
                f"measuring.{own} is given beside [tolerances]; say it there, as tolerances.{other}"
            )


def _source(allowed: Allowed) -> Any:
    return allowed.source
