"""What the table `[shaft]` of a drive lacks, from the worm's shaft where a case describes it."""

from asperity.casefile import Case, naming_source
from asperity.drive.parameters import STEEL_MODULUS, Shaft
from asperity.gearset.parameters import Gearset
from asperity.shafts.compliance import plain_shaft
from asperity.shafts.parameters import WormShaft


def shaft_of(case: Case) -> Shaft:
    """Return the shaft of a drive: ``[shaft]``, what it lacks from ``[worm_shaft]``.

    The sections stand for a plain shaft that gives as much at the mesh; see
    `asperity.shafts.compliance`.
    """
    shaft = case.get(Shaft, Shaft())
    if WormShaft.table not in case or Gearset.table not in case:
        return shaft
    with naming_source(case):
        geometry = case.require(Gearset).require_consistent().geometry
        plain = plain_shaft(case.require(WormShaft), geometry, STEEL_MODULUS, shaft.span)
    lacking = {
        key: value
        for key, value in plain._asdict().items()
        if value is not None and getattr(shaft, key) is None
    }
    return shaft.model_copy(update=lacking, units="SI")
