"""The command `roots`: stresses at the fillets of a loaded wheel's teeth over a pitch."""

from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.friction import rating_inputs
from asperity.drive.lacking import require_all
from asperity.drive.problem import DriveProblem
from asperity.drive.root.model import COARSER, COUNTS, TEETH, RootModel, Roots
from asperity.drive.root.result import Largest, RootStress
from asperity.drive.static.equilibrium import Balance
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.sweep import LoadCase
from asperity.drive.teeth.sector import Sector, lattice, right_handed
from asperity.errors import InputError
from asperity.rating.parameters import RatingOptions
from asperity.rating.standards import rate_by, tables_of
from asperity.runs import Run

_LOADED = 0.02  # of all normal force, below which nobody asks for a tooth's root
_FOOT = 0.2  # of the flank's height, the part that bears beside the fillet


class Load(NamedTuple):
    """A tooth as it is loaded at a phase, with those beside it."""

    phase: int
    tooth: int
    normal: float  #: On it, N
    foot: float  #: Share of it on the lowest part of its flank
    #: (3, n, 3): On the flanks of the teeth before, of it and after in the mesh, each in its own
    #: frame, N
    forces: FloatArray


def prepare(case: Case) -> DriveProblem:
    """Return what is loaded.

    Parameters
    ----------
    case : Case
        Of a gearset's drive; its vibration counts for nothing.

    Raises
    ------
    InputError
        Something of a drive is missing.
    """
    require_all(case, shaken=False)
    return DriveProblem.from_case(case, shaken=False)


def answer(problem: DriveProblem, run: Run) -> RootStress:
    """Find the stresses at the roots of all teeth that bear, at each phase of a pitch.

    Raises
    ------
    InputError
        There is no such wheel or mesh, or the teeth cannot carry the torque.
    ConvergenceError
        No balance was found.
    """
    run.forecast(60.0, "loads and two meshes")
    with run.interruptible():
        static = StaticModel(problem, run)
        loads = loads_of(static)
        run.checkpoint(1, 3, what="meshes")
        wheel = right_handed(static.sector.wheel)
        teeth = min(TEETH, static.sector.teeth)
        models = []
        found: list[Roots] = []
        for done, counts in enumerate((COARSER, COUNTS)):
            model = RootModel(wheel, problem.gearset.wheel_material, counts, teeth)
            surface = static.sector.surface
            nodal = np.column_stack([model.nodal(surface, load.forces) for load in loads])
            found.append(model.solve(nodal))
            models.append(model)
            run.checkpoint(2 + done, 3, what="meshes")
    coarse, fine = found
    worst = Largest.of(models[1], fine)
    before = Largest.of(models[0], coarse)
    shear, safety = _nominal(problem)
    return RootStress.of(
        problem, models[1], fine, loads, worst, before.tension / worst.tension - 1.0,
        static.phases, shear, safety,
    )  # fmt: skip


def loads_of(static: StaticModel) -> list[Load]:
    """Return every tooth that bears at every phase of a pitch."""
    sector = static.sector
    low = _low_rows(sector)
    found: list[Load] = []

    def keep(number: int, balance: Balance) -> None:
        contact, action = balance.contact, balance.action
        own = contact.nodal_forces().reshape(contact.slots, -1, 3)
        none = np.zeros_like(own[0])
        # In the mesh teeth follow one another against their numbers.
        rows = [none, *own, none]
        for k, normal in enumerate(action.normal):
            if normal < _LOADED * action.normal.sum():
                continue
            force = np.linalg.norm(own[k], axis=1)
            forces = np.array([rows[k + 2], rows[k + 1], rows[k]])
            found.append(
                Load(
                    number,
                    action.teeth[k],
                    float(normal),
                    float(force[low].sum() / force.sum()),
                    forces,
                )
            )

    static.courses([LoadCase(static.problem.load, evaluate=keep)])
    return found


def _low_rows(sector: Sector) -> FloatArray:
    """Return which nodes of a flank lie on its lowest part."""
    nodes = lattice(sector.surface)
    count = max(1, round(_FOOT * len(nodes)))
    low = np.zeros(nodes.size, dtype=bool)
    low[nodes[:count]] = True
    return low


def _nominal(problem: DriveProblem) -> tuple[float | None, float | None]:
    """Return the nominal shear stress at the root by ISO/TR 14521, Pa, and its safety, if any."""
    case = problem.case
    assert case is not None
    try:
        options = case.get(RatingOptions, RatingOptions())
        rated = rate_by("iso14521", rating_inputs(case), tables_of(options, case.folder))
    except InputError:
        return None, None
    if "tau_F_MPa" not in rated or "S_F" not in rated:
        return None, None
    return 1e6 * float(rated["tau_F_MPa"]), float(rated["S_F"])
