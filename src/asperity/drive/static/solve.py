"""The loaded contact of a drive over a pitch of the worm: forward, without friction, reversed."""

from __future__ import annotations

import copy
import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.candidates.records import Body
from asperity.drive.friction import friction_curve, rating_inputs
from asperity.drive.friction_curve import friction_at
from asperity.drive.lugre import of_speed, steady_friction
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.contact import ResolvedContact
from asperity.drive.resolved.flank import ExactFlank
from asperity.drive.resolved.strip import ZONES
from asperity.drive.shafts import compliances_of
from asperity.drive.static.equilibrium import Balance, Equilibrium, TooDeepError
from asperity.drive.static.flash import Flash
from asperity.drive.static.harmonics import ErrorHarmonics
from asperity.drive.static.notes import notes_of
from asperity.drive.static.pattern import Pattern
from asperity.drive.static.pressure import hertz_pressure, modulus_of
from asperity.drive.static.recorder import PhaseRecord, contact_means
from asperity.drive.static.result import PATTERNS, StaticResult
from asperity.drive.static.spread import LOADED, k_h_alpha, shares
from asperity.drive.static.sweep import (
    FRICTIONLESS,
    REVERSED,
    LoadCase,
    PitchSweep,
    phases_of,
    sweep,
    touching_angles,
)
from asperity.drive.teeth.contact import TeethContact
from asperity.drive.teeth.sector import Sector, sector
from asperity.drive.teeth.threads import thread_flexibility
from asperity.errors import InputError
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.worm.setting import Pair
from asperity.runs import Run

_MILLIMETRES = 1e3
_MEGA, _MICRO = 1e6, 1e6
# Torques beside the load, between which the tangent stiffness is taken.
_BESIDE = 0.01
# For the stiffness each third of the phases, where there are many.
_EVERY, _MANY = 3, 12


def wheel_of(problem: DriveProblem) -> Wheel:
    """Return the wheel of a drive, cut and mounted as its case says."""
    return Wheel.cut(
        Pair.of(problem.gearset, problem.hob, problem.mount, problem.modification, problem.disc)
    )


def condensed(problem: DriveProblem, run: Run) -> Sector:
    """Return the elastic teeth of a drive, condensed or from those that are kept."""
    drive = problem.drive
    found = sector(
        wheel_of(problem),
        problem.gearset.wheel_material,
        density=drive.density,
        teeth=drive.teeth,
        body=problem.wheel_body,
        notify=run.notify,
    )
    if drive.threads == "rigid":
        return found
    steel = problem.gearset.worm_material
    both = found.body.flexibility + thread_flexibility(
        found.surface, steel.youngs_modulus, steel.poisson_ratio
    )
    body = Body.of(found.surface, both)._replace(places=found.body.places)
    return dataclasses.replace(found, body=body)


def friction_of(problem: DriveProblem, speed: float) -> float:
    """Return the coefficient of friction while the drive runs steadily and slides at a speed."""
    mu = _kinetic(problem, speed)
    point = problem.point(problem.drive.effective_radius)
    return steady_friction(problem.friction, mu, point, problem.load, speed)


def _kinetic(problem: DriveProblem, speed: float) -> float:
    if problem.drive.friction == "constant":
        return problem.friction.mu
    if problem.case is None:
        raise InputError("drive.friction is 'iso14521', which needs a case with [operation]")
    return float(friction_at(friction_curve(rating_inputs(problem.case), 3.0 * speed), speed))


class TooMuchError(InputError):
    """The teeth cannot carry the torque; ``full``: as more of a flank would bear than a half."""

    full = False


def too_much(problem: DriveProblem, *, full: bool = False) -> InputError:
    """Return the line that refuses a drive's torque."""
    module = problem.geometry.axial_module
    found = TooMuchError(
        f"operation.output_torque is {problem.load:.6g} N m; it would press the worm deeper than "
        f"{0.1 * module:.3g} mm, a tenth of the module, into the teeth, or half of a flank would "
        "bear, which no elastic tooth carries: take a smaller torque"
    )
    found.full = full
    return found


class StaticModel:
    """A drive's loaded contact, ready for any torque.

    Parameters
    ----------
    problem : DriveProblem
        The drive.
    run : Run
        Who is told about what takes long.
    phases : int, optional
        Positions of the worm over a pitch; those of the problem if left out.
    """

    def __init__(self, problem: DriveProblem, run: Run, phases: int | None = None) -> None:
        self.problem = problem
        self.run = run
        self.sector = condensed(problem, run)
        self.radius = problem.drive.effective_radius or problem.reference_radius
        self.parts: Mapping[str, FloatArray] = compliances_of(problem.shaft, self.radius)
        whole = sum(self.parts.values(), np.zeros((4, 4)))
        self.contact = TeethContact(self.sector, 0.0)
        self.phases = phases_of(self.contact, phases or problem.drive.phases)
        self.touching = touching_angles(self.contact, self.phases)
        self.equilibrium = Equilibrium(self.contact, whole)
        self.friction = friction_of(problem, self._sliding_speed())
        self.contact = TeethContact(self.sector, self.friction)
        self.equilibrium = Equilibrium(self.contact, whole)

    @functools.cached_property
    def resolved(self) -> ResolvedContact:
        """What resolves the pressures of its balances."""
        problem = self.problem
        wheel, worm = problem.gearset.wheel_material, problem.gearset.worm_material
        give = self.sector.body.flexibility
        if problem.drive.threads == "elastic":
            # Of the worm the patches have all of it.
            give = give - thread_flexibility(
                self.sector.surface, worm.youngs_modulus, worm.poisson_ratio
            )
        modulus = modulus_of(wheel, worm)
        of_worm = modulus * (1.0 - worm.poisson_ratio**2) / worm.youngs_modulus
        return ResolvedContact(
            ExactFlank.of(self.sector, wheel, give),
            modulus,
            problem.flow_pressure,
            of_worm if problem.drive.threads == "rigid" else 0.0,
        )

    def _sliding_speed(self) -> float:
        """Speed at which the flanks slide where they bear, m/s, which friction hardly moves."""
        drive, speed = self.problem.drive, self.problem.worm_speed
        if drive.friction == "constant" and not of_speed(self.problem.friction):
            return self.problem.sliding_speed
        if drive.effective_radius is not None:
            return self.problem.point(drive.effective_radius).sliding_speed(speed)
        means: list[tuple[float, float, float]] = []

        def evaluate(_number: int, balance: Balance) -> None:
            means.append(contact_means(balance.contact, balance))

        every = max(1, len(self.phases) // 4)
        phases, touching = self.phases[::every], self.touching[::every]
        try:
            sweep(
                self.equilibrium, phases, touching,
                [LoadCase(self.problem.load, FRICTIONLESS, evaluate=evaluate)],
            )  # fmt: skip
        except TooDeepError:
            raise too_much(self.problem) from None
        force, radius, _ = np.array(means).T
        mean = float(force @ radius / force.sum())
        return self.problem.point(mean).sliding_speed(speed)

    def rubbing(self, friction: float) -> StaticModel:
        """Return the same with another coefficient of friction."""
        other = copy.copy(self)
        other.friction = friction
        other.contact = TeethContact(self.sector, friction)
        other.equilibrium = Equilibrium(other.contact, self.equilibrium.compliance)
        return other

    def sweeps(
        self, cases: Sequence[LoadCase], step: Callable[[int], None] = lambda _number: None
    ) -> list[PitchSweep]:
        """Return the balances over a pitch; refuses torques that teeth cannot carry.

        Parameters are as in `asperity.drive.static.sweep.sweep`.
        """
        try:
            return sweep(self.equilibrium, self.phases, self.touching, cases, step)
        except TooDeepError as error:
            raise too_much(self.problem, full=error.full) from None


def solve_static(problem: DriveProblem, run: Run) -> StaticResult:
    """Solve the loaded contact of a drive over a pitch.

    Raises
    ------
    InputError
        There is no such wheel or mesh, or the teeth cannot carry the torque.
    ConvergenceError
        No balance was found.
    """
    model = StaticModel(problem, run)
    load, sector_, contact = problem.load, model.sector, model.contact
    flash = Flash(problem, model.resolved.flank, model.friction)
    seen = PhaseRecord(model.resolved, flash)
    less_loaded = [Pattern(model.resolved) for _ in PATTERNS[:-1]]
    count = len(model.phases)
    total = (3 if run.detailed else 2) * count
    every = _EVERY if count >= _MANY else 1
    with run.interruptible():
        forward, more, less, frictionless, reversed_ = model.sweeps(
            [
                LoadCase(load, evaluate=seen.evaluate),
                *(LoadCase((1.0 + sign * _BESIDE) * load, every=every) for sign in (1.0, -1.0)),
                LoadCase(load, FRICTIONLESS),
                LoadCase(load, REVERSED),
            ],
            lambda done: run.checkpoint(done, total, what="phases"),
        )
        lighter = model.sweeps(
            [
                LoadCase(share * load, evaluate=part.evaluate)
                for share, part in zip(PATTERNS[:-1], less_loaded, strict=True)
            ],
            lambda done: run.checkpoint(count + done, total, what="phases"),
        )
        back = _back_patterns(model, 2 * count, total) if run.detailed else None
    patterns = [*less_loaded, seen.pattern]
    error = ErrorHarmonics.of(
        sector_.wheel, [*lighter, forward], [np.array(part.mesh_errors) for part in patterns]
    )
    tangent = (more.torque - less.torque) / (more.mean_deflection - less.mean_deflection)
    radius = seen.radius / seen.weight
    parts = _parts(model, np.array(seen.turns[::every]), more, less)
    share = shares(seen.tooth_force)
    loaded = (share > LOADED).sum(axis=1)
    axes = contact.stand.axes
    on_worm = -forward.wrench[:, :3].mean(axis=0)
    places = model.resolved.flank.grid[0]
    return StaticResult(
        problem=problem,
        sector=sector_,
        nodal_force=seen.nodal_forces,
        output_torque=load,
        friction=model.friction,
        input_torque=float(forward.worm_torque.mean()),
        input_torque_frictionless=float(frictionless.worm_torque.mean()),
        input_torque_reversed=float(reversed_.worm_torque.mean()),
        friction_radius=_MILLIMETRES * radius,
        sliding_speed=problem.worm_speed * seen.speed / seen.weight,
        transmission_error=float(np.ptp(forward.error)),
        deflection=forward.mean_deflection,
        stiffness=tangent,
        stiffness_secant=load / forward.mean_deflection,
        normal_force=float(seen.tooth_force.sum(axis=1).mean()),
        axial_force=float(abs(on_worm @ axes[2])),
        radial_force=float(-on_worm @ axes[0]),
        tangential_force=float(abs(on_worm @ axes[1])),
        loaded_teeth_min=int(loaded.min()),
        loaded_teeth_max=int(loaded.max()),
        load_share_max=float(share.max()),
        k_h_beta=seen.spread.k_h_beta,
        k_h_alpha=k_h_alpha(seen.tooth_force),
        line_load=seen.spread.line_load / _MILLIMETRES,
        **_pressures(model, seen),
        hertz_pressure_max=hertz_pressure(problem, sector_.wheel),
        flash_temperature=max(flash.course),
        flash_temperature_face=_MILLIMETRES * problem.gearset.hand_sign * flash.worst.hottest,
        flash_temperature_flank=flash.on_flank,
        flash_temperature_course=np.array(flash.course),
        flash_line_face=problem.gearset.hand_sign * flash.worst.face,
        flash_line=flash.worst.rise,
        residual=max(forward.residual, frictionless.residual, reversed_.residual),
        teeth_nodes=sector_.body.nodes,
        condense_seconds=sector_.seconds,
        worm_angle=forward.worm_angle,
        torque=forward.worm_torque,
        torque_frictionless=frictionless.worm_torque,
        torque_reversed=reversed_.worm_torque,
        error_loaded=forward.error,
        error_unloaded=error.unloaded,
        error_torque=error.torque,
        error_order=error.order,
        error_amplitude=error.amplitude,
        error_phase=error.phase,
        error_noise=error.noise,
        error_noise_range=float(error.noise_range[-1]),
        error_noise_ranges=error.noise_range,
        tooth_force=seen.tooth_force,
        part=np.array(list(parts)),
        part_stiffness=np.array(list(parts.values())),
        pattern_torque=load * np.array(PATTERNS),
        pattern=np.array([part.largest for part in patterns]),
        pattern_back=back,
        node_radius=np.hypot(places[:, 0], places[:, 1]),
        node_face=problem.gearset.hand_sign * places[:, 2],
        faces=model.resolved.flank.faces,
        notes=notes_of(problem, seen, forward, float(error.noise_range[-1])),
    )


def _back_patterns(model: StaticModel, done: int, total: int) -> FloatArray | None:
    """Largest pressures on the other flanks as the drive runs backwards; None where none bear."""
    contact = TeethContact(model.sector, model.friction, side=-1)
    seen = [Pattern(model.resolved) for _ in PATTERNS]
    asked = [
        LoadCase(share * model.problem.load, REVERSED, evaluate=part.evaluate)
        for share, part in zip(PATTERNS, seen, strict=True)
    ]
    touching = touching_angles(contact, model.phases)
    try:
        sweep(
            Equilibrium(contact, model.equilibrium.compliance), model.phases, touching, asked,
            lambda more: model.run.checkpoint(done + more, total, what="phases"),
        )  # fmt: skip
    except TooDeepError:
        return None
    return np.array([part.largest for part in seen])


def _pressures(model: StaticModel, record: PhaseRecord) -> dict[str, Any]:
    """What a result has of the resolved pressures, MPa, N, mm and um."""
    cap, worst = model.resolved.cap, record.worst
    assert worst is not None
    zones = {
        key: value
        for name, (peak, force) in record.largest().items()
        for key, value in ((f"pressure_{name}", peak / _MEGA), (f"force_{name}", force))
    }
    del zones["force_flank"]
    by_phase = {
        f"{what}_{name}_course": np.array(values)[:, k]
        for k, name in enumerate(ZONES)
        for what, values in (("pressure", record.peaks), ("force", record.forces))
    }
    del by_phase["force_flank_course"]
    length, width = worst.extent()
    return {
        **zones,
        **by_phase,
        "pressure_mean": record.mean / _MEGA,
        "flow_pressure": None if cap is None else cap / _MEGA,
        "flow_depth": None if cap is None else _MICRO * max(record.depths),
        "contact_length": _MILLIMETRES * length,
        "contact_width": _MILLIMETRES * width,
        "pressure_nodal": record.nodal / _MEGA,
    }


def _parts(
    model: StaticModel, turns: FloatArray, more: PitchSweep, less: PitchSweep
) -> dict[str, float]:
    """Stiffness at the wheel by what gives way, N m/rad: what shafts leave is the teeth's.

    ``turns`` (p, 4) are those of the wheel by which the worm's yielding is made up for.
    """
    torque = more.torque - less.torque
    on_worm = model.equilibrium.on_worm(more.wrench - less.wrench) / torque
    shafts = {
        name: -float(np.einsum("pi,ij,pj->p", turns, part, on_worm).mean())
        for name, part in model.parts.items()
    }
    teeth = (more.mean_deflection - less.mean_deflection) / torque - sum(shafts.values())
    return {"teeth": 1.0 / teeth} | {name: 1.0 / value for name, value in shafts.items()}
