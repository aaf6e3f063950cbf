"""What a user of a loaded gearset's numbers should know of them, in lines."""

from collections.abc import Iterator

import numpy as np

from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.strip import FACE_END, FLANK, WHEEL_TIP, WORM_TIP
from asperity.drive.static.recorder import PhaseRecord
from asperity.drive.static.spread import STRIPS, told_k_h_beta
from asperity.drive.static.sweep import PitchSweep
from asperity.drive.warmed import warmth

_MEGA, _MICRO = 1e6, 1e6
# Of the normal force, from which on an edge is told of.
_BEARS = 1e-3
# Of the error under load, over what the mesh makes of it by itself.
_NOISE = 3.0
_FEW = 8
# Mean over largest pressure of an elastic ellipse of contact (Hertz).
_ELLIPSE = 2.0 / 3.0
_EDGES = {
    WORM_TIP: ("the worm's tip edge", "modification.tip_relief takes it off"),
    WHEEL_TIP: (
        "the wheel's tip edge",
        "it is sharp here; modification.root_relief relieves it",
    ),
    FACE_END: ("an end of the wheel's face", "a hob of some oversize or tilt moves it inwards"),
}

_LEFT = (
    "modification.root_relief leaves this, begun as far out as modification.root_relief_start "
    "says; near its beginning, where teeth end on the wheel's outside cylinder, it takes little "
    "off, however much it is"
)


def notes_of(
    problem: DriveProblem, record: PhaseRecord, forward: PitchSweep, noise: float
) -> tuple[str, ...]:
    """Return the notes of a loaded gearset; ``noise`` is the mesh's part of the error, rad."""
    return (
        *rigid_parts(problem),
        *warmth(problem),
        *narrow(record.spread.k_h_beta),
        *_pressures(problem, record),
        *_error(problem, forward, noise),
    )


def few_phases(problem: DriveProblem) -> Iterator[str]:
    """Yield that a pitch has too few phases, where it has."""
    if problem.drive.phases < _FEW:
        yield (
            f"drive.phases is {problem.drive.phases}: a transmission error needs {_FEW} phases or "
            "more, and peaks between them are not seen"
        )


def read_with_care(problem: DriveProblem) -> tuple[str, ...]:
    """Return the sentence that a headline of few phases ends with; none where they do."""
    phases = problem.drive.phases
    if phases >= _FEW:
        return ()
    what = (
        "a single phase, which has no error of its own" if phases == 1 else f"{phases} phases alone"
    )
    return (
        f"all of it by {what}: what lies between them is not seen, of peaks as of the error "
        f"(drive.phases, {_FEW} or more)",
    )


def narrow(k_h_beta: float) -> Iterator[str]:
    """Yield that all of the force lies in one strip of the face, where it does."""
    told = told_k_h_beta(k_h_beta)
    if "more" in told:
        yield (
            f"K_Hbeta is {told}: all of the force lies within one of {STRIPS} strips of the face, "
            "which tell no larger one"
        )


def flowing(mean: float, cap: float | None) -> tuple[str, ...]:
    """Return the sentence on a flank that flows in large parts, where it does.

    Parameters
    ----------
    mean, cap : float
        Normal force over the area that bears, and the pressure at which the wheel flows, MPa.
    """
    if cap is None or mean <= _ELLIPSE * cap:
        return ()
    return (
        f"large parts of the flank flow: the normal force over the area that bears is {mean:.4g} "
        f"MPa, {100.0 * mean / cap:.2g} % of the hardness of the wheel, more than in an "
        "elastic ellipse; take a smaller operation.output_torque, or a larger or harder wheel",
    )


def rigid_parts(problem: DriveProblem) -> Iterator[str]:
    """Yield what of the drive is taken as rigid."""
    left_out = [
        what
        for what, there in (
            ("bending of the worm's shaft", problem.shaft.diameter and problem.shaft.span),
            ("its radial bearings", problem.shaft.bearing_radial),
            ("its axial bearing and seat", problem.shaft.axial),
            ("its torsion", problem.shaft.torsion),
        )
        if not there
    ]
    if left_out:
        yield (
            f"rigid: {', '.join(left_out)}; together they can give several times what the teeth do"
        )
    body = problem.wheel_body
    yield (
        "the wheel's rim is held at its inside (drive.wheel_body = 'web': web and hub give as well)"
        if body is None
        else f"the wheel is held at its hub of {2.0 * body.hub_radius:.4g} mm, on a web "
        f"{body.web_width:.4g} mm wide ([blank])"
    )
    yield (
        "the worm's threads are rigid (drive.threads) in torque, deflection and error; in the "
        "pressures, and in how teeth share the load, they give as a half-space"
        if problem.drive.threads == "rigid"
        else "the worm's threads give as a half-space (drive.threads); what they bend as "
        "cantilevers is left out"
    )


def _pressures(problem: DriveProblem, record: PhaseRecord) -> Iterator[str]:
    peaks, forces = np.array(record.peaks), np.array(record.forces)
    whole = forces.sum(axis=1)
    wheel = problem.gearset.wheel_material
    cap = problem.flow_pressure
    relieved = problem.modification is not None and problem.modification.root_relief > 0.0
    for zone, (edge, mend) in _EDGES.items():
        if zone == WHEEL_TIP and relieved:
            mend = _LEFT
        bearing = forces[:, zone] > _BEARS * whole
        if not bearing.any():
            continue
        worst = int(np.argmax(forces[:, zone]))
        flows = cap is not None and peaks[:, zone].max() > 0.999 * cap
        yield (
            f"{edge} bears at {int(bearing.sum())} of {len(forces)} phases, up to "
            f"{forces[worst, zone]:.4g} N ({100.0 * forces[worst, zone] / whole[worst]:.2g} %) at "
            f"{peaks[:, zone].max() / _MEGA:.4g} MPa"
            + (", where it flows" if flows else "")
            + f": {mend}"
        )
    if cap is not None and peaks[:, FLANK].max() > 0.999 * cap:
        yield (
            f"the flank itself flows: its pressure comes to {cap / _MEGA:.4g} MPa, the hardness of "
            "the wheel; take a smaller operation.output_torque, or a larger or harder wheel"
        )
    if problem.drive.plastic and wheel.flow_pressure is None:
        yield (
            f"nothing is known of the hardness of {wheel.name}: pressures are elastic "
            "(gearset.wheel_material.brinell_hardness)"
        )
    if cap is None and forces[:, [WHEEL_TIP, FACE_END]].any():
        yield (
            "the wheel's edges are sharp: their elastic pressures grow with finer patches, their "
            "forces do not"
        )
    yield from _unresolved(record, len(forces))


def _unresolved(record: PhaseRecord, phases: int) -> Iterator[str]:
    """Yield which peaks the finest patches still changed, where most and by how much."""
    for zone, (edge, _) in {FLANK: ("the flank", ""), **_EDGES}.items():
        own = [(number, change.share) for number, change in record.changes if change.zone == zone]
        if own:
            worst, share = max(own, key=lambda each: each[1])
            yield (
                f"the peak on {edge} is not resolved at {len({n for n, _ in own})} of {phases} "
                f"phases: the finest patches still changed it by up to {100.0 * share:.2g} % "
                f"(phase {worst + 1})"
            )


def _error(problem: DriveProblem, forward: PitchSweep, noise: float) -> Iterator[str]:
    if problem.drive.phases < _FEW:
        yield from few_phases(problem)
        return
    if float(np.ptp(forward.error)) < _NOISE * noise:
        yield (
            f"the points of the mesh make an error of {_MICRO * noise:.3g} urad by themselves: "
            "that under this load is hardly more"
        )
