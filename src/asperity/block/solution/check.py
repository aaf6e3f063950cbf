"""What an elastic block is refused for before anything is built."""

import math

from asperity.block.problem import BlockProblem
from asperity.contact.elastic import machine_memory, memory_for
from asperity.contact.elastic.solver import installed_solver
from asperity.errors import InputError

# Strain of the block, and overclosure over its height, under the mean pressure.
_MOST_SQUEEZE = 0.1

# Deflection limits of slip in a step; with more of them nothing of the friction law is left.
_MOST_SLIP = 1000.0

# The size of an atom's nucleus; squares of far smaller numbers are none.
_LEAST_LIMIT = 1e-15

# From aerogel to far beyond any solid; a much lighter block is all contact, and no inertia is left.
_LEAST_DENSITY, _MOST_DENSITY = 1.0, 1e7


def check(problem: BlockProblem) -> None:
    """Refuse what cannot be solved, before anything is built.

    That is what `check_ranges` refuses, more modes than the mesh has, and a mesh too large for the
    machine's memory.
    """
    check_ranges(problem)
    block, unknowns = problem.block, 3 * problem.nodes
    if block.modes > unknowns // 4:
        raise InputError(
            f"block.modes is {block.modes}; allowed: 0 to {unknowns // 4} with this mesh"
        )
    along, across, _ = block.elements
    faces = (block.order * along + 1) * (block.order * across + 1)
    needed = memory_for(
        problem.nodes,
        (math.prod(block.elements), (block.order + 1) ** 3),
        faces,
        modes=block.modes,
        solver=installed_solver(),
    )
    there = machine_memory()
    if needed > there:
        raise InputError(
            f"block.elements is {list(block.elements)} with '{block.element}', {unknowns} "
            f"unknowns; condensing them needs about {needed / 1e9:.3g} GB, more than the "
            f"{there / 1e9:.3g} GB of this machine: take fewer elements"
        )


def check_ranges(problem: BlockProblem) -> None:
    """Refuse what no program can solve on any mesh.

    Steps that miss the vibration, forces or stiffnesses beyond small deformations.
    """
    _ = problem.timetable
    _check_density(problem)
    _check_squeeze(problem)
    limit = problem.model.friction.max_deflection
    if limit is not None and problem.model.friction.model != "coulomb" and limit < _LEAST_LIMIT:
        raise InputError(
            f"friction.max_deflection is {limit:g} m; an elastic block takes {_LEAST_LIMIT:g} "
            "m or more: give friction.model 'coulomb' for asperities that do not give"
        )
    _check_slip(problem)


def _check_slip(problem: BlockProblem) -> None:
    """Refuse steps in which the asperities are bent anew a thousand times and more."""
    if problem.model.friction.model == "coulomb":
        return
    fastest = problem.model.slider.drive_velocity + problem.model.peak_velocity
    limit, step = problem.friction.limit, problem.timetable.step
    if fastest * step > _MOST_SLIP * limit:
        raise InputError(
            f"solve.step is {step:g} s; with slips of up to {fastest:.4g} m/s a deflection of "
            f"at most {limit:g} m takes a step of at most {_MOST_SLIP * limit / fastest:.3g} s"
        )


def _check_density(problem: BlockProblem) -> None:
    """Refuse a mass that makes no solid."""
    volume = problem.block.volume
    if not _LEAST_DENSITY * volume <= problem.mass <= _MOST_DENSITY * volume:
        raise InputError(
            f"slider.mass is {problem.mass:g} kg, which makes a density of "
            f"{problem.block.density(problem.mass):.4g} kg/m^3; with this block.size it must be "
            f"{_LEAST_DENSITY * volume:.4g} to {_MOST_DENSITY * volume:.4g} kg"
        )


def _check_squeeze(problem: BlockProblem) -> None:
    """Refuse a body or a contact that gives way by more than a small part of the block."""
    block, force = problem.block, problem.model.slider.normal_force
    pressure, height = problem.mean_pressure, block.size[2]
    given = f"slider.normal_force is {force:g} N, a mean pressure of {pressure:.4g} Pa; "
    if pressure > _MOST_SQUEEZE * block.youngs_modulus:
        raise InputError(
            f"{given}block.youngs_modulus is {block.youngs_modulus:g} Pa; it must be at least "
            f"{pressure / _MOST_SQUEEZE:.4g} Pa, for the deformation to be small"
        )
    if pressure > _MOST_SQUEEZE * height * problem.normal.stiffness:
        raise InputError(
            f"{given}contact.stiffness is {problem.normal.stiffness:g} Pa/m; it must be at least "
            f"{pressure / (_MOST_SQUEEZE * height):.4g} Pa/m, for the overclosure to be small"
        )
    over = problem.normal.overclosure(pressure)
    if over > _MOST_SQUEEZE * height:
        raise InputError(
            f"{given}contact.initial_stiffness {problem.normal.initial:g} Pa/m lets it sink by "
            f"{over:.4g} m; it may be {_MOST_SQUEEZE * height:.4g} m, for the overclosure to "
            "be small: give a greater one, or a shorter contact.transition"
        )
