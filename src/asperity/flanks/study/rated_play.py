"""The backlash of a gearset by its exact flanks, for a rating and for gearsets that are proposed.

The formula of `asperity.gearset.tolerancing.backlash` knows no hob, and takes flanks that touch
where they should: its worst case is no bound. Here the flanks are cut, which costs some tenths of a
second for each place in which the worm may stand; no torque moves them, so that what was found of a
gearset is kept for the process.
"""

import dataclasses
import functools
from collections.abc import Callable

from asperity.casefile import Case, Table, naming_source
from asperity.errors import ConvergenceError, InputError
from asperity.flanks.measuring.corners import Mounted
from asperity.flanks.meshing.backlash import set_backlash, worm_turn
from asperity.flanks.meshing.transmission import touching, transmission
from asperity.flanks.parameters import Disc, Hob, MeasuringOptions, Modification, Mount
from asperity.flanks.sides import both
from asperity.flanks.study.toleranced import require_once
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.gearset import Gearset
from asperity.gearset.tolerancing.backlash import Backlash
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating import Rated
from asperity.rating.backlash import worn
from asperity.runs import Run

_KEPT = 32


@dataclasses.dataclass(frozen=True)
class Manufacture:
    """How worm and wheel of a gearset are made and mounted; equal to another by what is asked.

    Attributes
    ----------
    hob, mount, modification, disc : optional
        As of `asperity.flanks.worm.setting.Pair.of`.
    """

    hob: Hob | None = None
    mount: Mount | None = None
    modification: Modification | None = None
    disc: Disc | None = None

    @classmethod
    def of(cls, case: Case) -> "Manufacture":
        """Return it of a case."""
        return cls(case.get(Hob), case.get(Mount), case.get(Modification), case.get(Disc))

    @property
    def fits(self) -> bool:
        """Whether the hob is the worm, which then fills the wheel's spaces as it is mounted."""
        return self.hob is None and self.mount is None and self.modification is None

    def pair(self, gearset: Gearset) -> Pair:
        """Return the pair of a gearset; raises InputError."""
        return Pair.of(gearset, self.hob, self.mount, self.modification, self.disc)


@dataclasses.dataclass(frozen=True)
class _MountingKey:
    key: tuple[object, ...]
    pair: Pair = dataclasses.field(compare=False)
    given: Tolerances = dataclasses.field(compare=False)
    fits: bool = dataclasses.field(compare=False)


@functools.lru_cache(maxsize=_KEPT)
def _mounted(mounting: _MountingKey) -> tuple[Mounted, float]:
    """Return how a pair may be mounted, and the worm's turn with nothing off, rad."""
    pair = mounting.pair
    wheel = Wheel.cut(pair)
    if mounting.fits:
        return Mounted.of(pair, wheel, mounting.given), 0.0
    if pair.backlash is None:
        turn = worm_turn(both(lambda side: touching(pair, wheel.flank(side))))
        return Mounted.of(pair, wheel, mounting.given), turn
    meshes = both(lambda side: transmission(pair, wheel.flank(side)))
    meshes = set_backlash(meshes, pair.backlash)
    thinned = meshes[1].search.pair
    return Mounted.of(thinned, Wheel(thinned), mounting.given), worm_turn(meshes)


def exact_backlash(
    gearset: Gearset, manufacture: Manufacture, tolerances: Tolerances, wear: float | None = None
) -> Backlash:
    """Return the backlash by the exact flanks that tolerances leave of a gearset.

    Parameters
    ----------
    gearset : Gearset
        Whose it is.
    manufacture : Manufacture
        How its flanks are made and mounted.
    tolerances : Tolerances
        What is allowed.
    wear : float, optional
        Depth that is worn off the wheel's flanks, um.

    Returns
    -------
    Backlash
        That of ``asperity flank``.

    Raises
    ------
    InputError
        There is no such wheel; as of `asperity.flanks.study.flank.prepare_gearset`.
    ConvergenceError
        Somewhere within the tolerances the worm does not reach the wheel.
    """
    tables: tuple[Table | None, ...] = (*vars(manufacture).values(), tolerances)
    texts = tuple(None if table is None else table.model_dump_json() for table in tables)
    key = gearset.geometry, gearset.flank, gearset.hand, texts
    mounted, turn = _mounted(
        _MountingKey(key, manufacture.pair(gearset), tolerances, manufacture.fits)
    )
    return mounted.backlash(gearset, tolerances, turn, wear)


def beside_rating(case: Case) -> Callable[[Rated, Run], Rated]:
    """Return what gives a rating the backlash of the exact flanks of a case.

    Where they cannot be cut, or do not reach each other, the rating keeps its formula's, and a note
    says why.

    Raises
    ------
    InputError
        A thickness is given twice.
    """
    gearset, given, made = case.require(Gearset), case.require(Tolerances), Manufacture.of(case)
    with naming_source(case):
        require_once(given, made.mount, case.get(MeasuringOptions))

    def add(rated: Rated, _: Run) -> Rated:
        try:
            found = exact_backlash(gearset, made, given, worn(rated.found))
        except (InputError, ConvergenceError) as error:
            said = f"the backlash is by geometry, which is no bound: {error}"
            return dataclasses.replace(rated, notes=(*rated.notes, said))
        return dataclasses.replace(rated, backlash=found)

    return add
