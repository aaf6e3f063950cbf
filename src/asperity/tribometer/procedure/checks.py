"""The checks of the procedure: preload (step 8), zeros, changes, speeds, map of the channels.

A check that fails is put right by a person and made again; what stays wrong latches.
"""

from collections.abc import Mapping

from asperity.tribometer.instruments.protocols import InstrumentError, Reading

_PRELOAD_SHARE = 0.05
_ZERO_CURRENT = 0.1  # A, of a clamp on a motor that is off.
_ZERO_TORQUE = 0.05  # N m
_LEAST_TORQUE, _LEAST_CURRENT, _LEAST_SPEED = 0.02, 0.2, 0.5
_SPEED_SHARE = 0.05
_CURRENT_SHARE, _CURRENT_AMPERES = 0.15, 0.2
_TORQUES = 0.7, 1.43  # Of the torques' ratio over that of the radii; exchanged, it is the square.

Levels = Mapping[str, float]


def check_preload(level: float, wanted: float) -> None:
    """See that the load cell tells the preload (step 8), V."""
    if abs(level - wanted) > _PRELOAD_SHARE * abs(wanted):
        raise InstrumentError(
            f"the load cell tells {1e3 * level:.3g} mV; sonotrode.preload_voltage is "
            f"{1e3 * wanted:.3g} mV (5 % allowed): set the preload",
            kind="preload",
        )


def check_zeros(rest: Levels) -> None:
    """See that clamps and torque sensors tell nothing while the motors are off (step 14)."""
    bounds = {"current": (_ZERO_CURRENT, "A"), "torque": (_ZERO_TORQUE, "N m")}
    for disc in ("steel", "bronze"):
        for what, (most, unit) in bounds.items():
            name = f"{what}_{disc}"
            if abs(rest[name]) > most:
                raise InstrumentError(
                    f"{name} is {rest[name]:.3g} {unit} before the motors are started, more than "
                    f"{most:g} {unit}: zero it",
                    kind="zero",
                )


def check_changes(rest: Levels, running: Levels, slower: float = 1.0) -> None:
    """See that every signal of the drives answers the motors (step 15).

    Parameters
    ----------
    rest, running : mapping
        Levels of the signals.
    slower : float
        Speed of a wheel over that of the worm that turns it; of two motors 1.
    """
    for what, least in (
        ("torque", _LEAST_TORQUE), ("current", _LEAST_CURRENT), ("speed", _LEAST_SPEED)
    ):  # fmt: skip
        for disc in ("steel", "bronze"):
            name = f"{what}_{disc}"
            share = min(slower, 1.0) if name == "speed_bronze" else 1.0
            if abs(running[name] - rest[name]) < share * least:
                raise InstrumentError(
                    f"{name} does not change when the motors are switched on: look at its sensor, "
                    "power and cable",
                    kind="no change",
                )
    if abs(running["load_cell"] - rest["load_cell"]) > 0.5 * abs(rest["load_cell"]):
        raise InstrumentError(
            "load_cell changes with the motors: it is on another signal's channel",
            kind="wrong channel map",
        )


def check_speeds(running: Levels, measured: Levels, quantum: float) -> None:
    """Compare speeds with a tachometer (step 16).

    Parameters
    ----------
    running, measured : mapping
        Of the motors, rad/s, by signal and by disc.
    quantum : float
        Of the encoders, rad/s.
    """
    for disc in ("steel", "bronze"):
        told, found = running[f"speed_{disc}"], measured[disc]
        if abs(told - found) > _SPEED_SHARE * abs(found) + quantum:
            raise InstrumentError(
                f"speed_{disc} tells {told:.4g} rad/s where the tachometer has {found:.4g} rad/s: "
                "look at its scale and channel",
                kind="wrong channel map",
            )


def check_map(running: Levels, channels: Mapping[str, Reading], wanted: float) -> None:
    """See that currents and torques are on their own channels.

    Parameters
    ----------
    running : mapping
        Levels of the signals.
    channels : mapping of str to Reading
        What the supplies of the motors tell.
    wanted : float
        Torque of the steel side over that of the bronze side: of discs that of their radii.
    """
    for disc, reading in channels.items():
        told = running[f"current_{disc}"]
        if reading.current is None:
            raise InstrumentError(
                f"the supply of the {disc} disc's motor cannot be asked for its current",
                kind="supply",
            )
        if abs(told - reading.current) > _CURRENT_AMPERES + _CURRENT_SHARE * reading.current:
            raise InstrumentError(
                f"current_{disc} tells {told:.3g} A where the supply has {reading.current:.3g} A: "
                "look at its clamp and channel",
                kind="wrong channel map",
            )
    found = abs(running["torque_steel"]) / abs(running["torque_bronze"])
    if not _TORQUES[0] * wanted <= found <= _TORQUES[1] * wanted:
        raise InstrumentError(
            f"torque_steel is {found:.2f} times torque_bronze where {wanted:.2f} is due: "
            "look at their channels and scales",
            kind="wrong channel map",
        )
