"""What the simulated rig's parameters rest on: measured, fitted or placeholders.

A figure is worth no more than the weakest of what it rests on.
"""

from typing import Literal

from asperity.casefile import Case
from asperity.gearset import Gearset
from asperity.tribometer.options import Twin

Standing = Literal["measured", "fitted", "placeholder", "given"]

TWIN: dict[str, tuple[Standing, object, str]] = {
    "motor_constant": ("fitted", 0.0515, "to Table 6.3"),
    "motor_resistance": ("fitted", 0.3, "to Table 6.3"),
    "motor_drag": ("fitted", 0.095, "to the torques and slide-roll ratios of 6.4.7 and 6.4.11"),
    "bronze_drag": ("fitted", 0.091, "to the slide-roll ratios of 6.4.7"),
    "mu": ("fitted", 0.185, "to the torques of 6.4.11; not the only fit"),
    "mu_drop": ("fitted", 0.54, "likewise"),
    "stribeck_velocity": ("fitted", 6.1e-3, "likewise"),
    "gear_efficiency": ("placeholder", 0.7, ""),
    "max_deflection": ("placeholder", 70e-9, ""),
    "motor_inertia": ("placeholder", 5e-5, ""),
    "supply_current": ("placeholder", 5.0, ""),
    "rotor_inertia": ("placeholder", None, "the disc does not answer to vibration"),
    "rotor_frequency": ("placeholder", None, ""),
    "rotor_damping": ("placeholder", 0.02, ""),
    "torque_noise": ("placeholder", 12e-3, ""),
    "coloured_noise": ("placeholder", 4e-3, ""),
    "noise_time": ("placeholder", 0.2, ""),
    "current_noise": ("placeholder", 0.02, ""),
    "runout_steel": ("placeholder", 0.01, ""),
    "runout_bronze": ("placeholder", 0.01, ""),
    "drift": ("placeholder", 0.1, ""),
    "encoder_gate": ("placeholder", 1.0, ""),
    "encoder_lag": ("placeholder", 0.2, ""),
    "wear_steel": ("placeholder", 0.0, "nothing wears"),
    "wear_bronze": ("placeholder", 0.0, ""),
    "weighing_noise": ("placeholder", 0.0, ""),
    "brake_resistance": ("placeholder", 20.0, "of gear rigs alone"),
}
"""By key of ``[twin]``: what the value that ships rests on, that value, and more about it."""

_MEASURED_FREQUENCY = 750.0


def parameters(case: Case) -> dict[str, Standing]:
    """Return what each parameter of a configuration's simulated rig rests on.

    Parameters
    ----------
    case : Case
        A configuration with ``[twin]``.

    Returns
    -------
    dict of str to str
        ``measured``, ``fitted``, ``placeholder`` or ``given`` by key.
    """
    twin = case.require(Twin)
    return {
        name: standing if getattr(twin, name) == shipped else "given"
        for name, (standing, shipped, _) in TWIN.items()
    }


def figure_standing(mode: str, waveform: str, frequency: float) -> Standing:
    """Return what a torque change of the simulated rig rests on.

    The velocity of the disc was measured at 750 Hz alone, and the torque there across the sliding;
    that a disc shaken along the sliding stands still is assumed.

    Parameters
    ----------
    mode : {'longitudinal', 'transverse'}
        Of the vibration.
    waveform : str
        As of ``[vibration]``.
    frequency : float
        Hz.

    Returns
    -------
    str
        ``fitted`` or ``placeholder``.
    """
    fitted = mode == "transverse" and waveform == "sine" and frequency == _MEASURED_FREQUENCY
    return "fitted" if fitted else "placeholder"


def standing(case: Case) -> list[str]:
    """Return what a reader of simulated figures should know, in sentences.

    Parameters
    ----------
    case : Case
        As of `parameters`.

    Returns
    -------
    list of str
        Sentences.
    """
    found = parameters(case)
    named = {
        kind: ", ".join(name for name, one in found.items() if one == kind)
        for kind in ("fitted", "placeholder", "given")
    }
    words = {
        "fitted": "fitted to a few published figures",
        "placeholder": "placeholders",
        "given": "as the case gives them",
    }
    if Gearset.table in case:
        return [
            "the worm's torques are those of asperity drive on this case, at the means of its "
            "motion; motor, brake, sensors and noise of [twin] are of no rig that stands"
        ]
    told = [f"[twin] {words[kind]}: {names}" for kind, names in named.items() if names]
    return [
        *told,
        "figures of transverse sine vibration at 750 Hz rest on what was fitted, all others on "
        "placeholders; grease is simulated as oil is",
    ]
