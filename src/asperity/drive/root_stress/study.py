"""The command `roots`: stresses at the fillets of a loaded wheel's teeth over a pitch."""

import functools

import numpy as np

from asperity.casefile import Case
from asperity.drive.friction import rating_inputs
from asperity.drive.lacking import require_all
from asperity.drive.problem import DriveProblem
from asperity.drive.root_stress.loads import loads_of
from asperity.drive.root_stress.model import COARSER, COUNTS, TEETH, RootModel, Roots
from asperity.drive.root_stress.result import Largest, RootStress
from asperity.drive.root_stress.stages import Stages
from asperity.drive.static.solve import StaticModel
from asperity.drive.teeth.sector import moving_rim, on_coarse, right_handed
from asperity.errors import InputError
from asperity.rating.parameters import RatingOptions
from asperity.rating.standards import rate_by, tables_of
from asperity.runs import Run

# Of processor time: for the loads of a phase, and for a mesh by its unknowns to the power 1.5,
# nearly all of it one factorisation.
_SECONDS_A_PHASE, _SECONDS_OF_MESH = 0.8, 1.4e-6


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
    with run.interruptible():
        static = StaticModel(problem, run)
        wheel = right_handed(static.sector.wheel)
        material, body = problem.gearset.wheel_material, problem.wheel_body
        teeth = min(TEETH, static.sector.teeth)
        models = [RootModel(wheel, material, counts, teeth) for counts in (COARSER, COUNTS)]
        stages = Stages(run, [
            _SECONDS_A_PHASE * len(static.phases),
            *(_SECONDS_OF_MESH * model.unknowns**1.5 for model in models),
        ])  # fmt: skip
        loads = loads_of(static)
        rim = None if body is None else moving_rim(static.sector, material, body, run.notify)
        stages.done()
        found: list[Roots] = []
        while models:
            model = models.pop(0)
            surface = static.sector.surface
            nodal = np.column_stack([model.nodal(surface, load.forces) for load in loads])
            held = None
            if rim is not None:
                held = np.column_stack(
                    [model.on_web(rim, on_coarse(static.sector, load.forces)) for load in loads]
                )
            found.append(stages.wait(functools.partial(model.solve, nodal, held)))
            stages.done()
    coarse, fine = found
    worst, before = Largest.of(fine), Largest.of(coarse)
    shear, safety = _nominal(problem)
    return RootStress.of(
        problem, model, fine, loads, worst, before.tension / worst.tension - 1.0,
        static.phases, shear, safety,
    )  # fmt: skip


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
