"""What a case lacks for a drive, asked for in one line."""

from asperity.casefile import Case
from asperity.drive.parameters import Actuator, Drive, Shaft
from asperity.drive.shafts import bends
from asperity.drive.worm_shaft import shaft_of
from asperity.errors import InputError
from asperity.flanks.parameters import Mount
from asperity.friction import Friction
from asperity.gearset import Gearset
from asperity.rating import Operation
from asperity.vibration import Vibration

FREE_WORM = {
    "held-wheel": "the motor pushes with a torque alone",
    "back-drive": "the motor is off",
}
"""Protocols in which the motor's end of the shaft does not hold the worm, and why."""

_WORM_FREED = (*FREE_WORM, "on-demand")
_NEEDED = (("load_inertia", "3.2e-3 kg m**2"), ("contact_damping", "0.01 s/m"))


def moved(drive: Drive, shaft: Shaft, mode: str | None, actuated: bool) -> tuple[bool, bool]:
    """Return whether the worm's inertia and its mass count.

    Parameters
    ----------
    drive, shaft
        The tables of the case.
    mode : str, optional
        Which way it is shaken.
    actuated : bool
        Whether what an actuator takes is asked for: it follows from what it moves.
    """
    turns = shaft.torsion is not None or drive.protocol in _WORM_FREED
    shifts = shaft.axial is not None or bends(shaft)
    if actuated:
        # Of a wheel nothing tells the mass.
        both = drive.protocol == "tangential" or mode == "screw"
        turns = turns or both or mode == "torsional"
        shifts = shifts or both or mode == "axial"
    return turns, shifts


def require_all(
    case: Case, *, shaken: bool = True, must_shake: bool = False, protocol: str | None = None
) -> None:
    """Ask for all that a case lacks for a drive; what it lacks alone is asked for where it is used.

    Parameters
    ----------
    case : Case
        What was given.
    shaken : bool
        Whether its vibration counts.
    must_shake : bool
        Whether it is asked how a vibration acts, so that there must be one.
    protocol : str, optional
        In place of the case's own.

    Raises
    ------
    InputError
        More than one thing is missing, or the case is none of a gearset.
    """
    if Gearset.table not in case:
        other = "a sliding body: asperity slide takes it" if "slider" in case else "something else"
        raise InputError(
            f"{case.source}: there is no [gearset] in it; a drive is one of a worm gearset, and "
            f"this case is of {other}"
        )
    drive, shaft = case.get(Drive, Drive()), shaft_of(case)
    if protocol is not None:
        drive = drive.model_copy(update={"protocol": protocol})
    missing = []
    if Operation.table not in case:
        missing.append("[operation] (lubricant, output_torque and worm_speed)")
    if Friction.table not in case and drive.friction == "constant":
        missing.append(
            "[friction] (model, 'coulomb' or 'dahl', and mu), or drive.friction = 'iso14521'"
        )
    vibration = case.get(Vibration)
    if vibration is None and must_shake:
        missing.append("[vibration] (mode, frequency and an amplitude)")
    if must_shake or (shaken and vibration is not None):
        missing += _for_shaking(case, drive, shaft, vibration)
    if len(missing) > 1:
        raise InputError(f"{case.source}: these are missing, add them: {'; '.join(missing)}")


def _for_shaking(case: Case, drive: Drive, shaft: Shaft, vibration: Vibration | None) -> list[str]:
    missing = []
    mode = None if vibration is None else vibration.mode
    if vibration is not None and mode is None:
        missing.append("vibration.mode ('axial')")
    missing += [
        f"drive.{key} ('{example}')" for key, example in _NEEDED if getattr(drive, key) is None
    ]
    counts = moved(drive, shaft, mode, Actuator.table in case and not _still(vibration))
    if shaft.diameter is None or shaft.span is None:
        of_worm = [
            f"drive.{key}"
            for key, needed in zip(("worm_inertia", "worm_mass"), counts, strict=True)
            if needed and getattr(drive, key) is None
        ]
        if of_worm:
            missing.append(f"shaft.diameter and shaft.span, or {' and '.join(of_worm)}")
    mount = case.get(Mount)
    if drive.flanks == "both" and (mount is None or mount.backlash is None):
        missing.append("mount.backlash ('20 um'), or drive.flanks = 'driving'")
    return missing


def _still(vibration: Vibration | None) -> bool:
    return vibration is not None and 0.0 in (
        vibration.velocity_ratio,
        vibration.velocity_amplitude,
        vibration.displacement_amplitude,
    )
