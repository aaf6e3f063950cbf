"""What a shaken drive is: torques, their balance, contact lost, powers, what it costs."""

from collections.abc import Mapping
from typing import ClassVar

from asperity.arrays import FloatArray
from asperity.drive.driven import OfDrive
from asperity.drive.headline import state_of
from asperity.results import Quantities, labelled, part, quantity
from asperity.results.ledger import Ledger
from asperity.results.words import Number, Sentence

EQUAL = 5e-3  # of a power, as of what makes a state settled
_MORE = 1.005  # times a force, what is told beside it
_OVER_TIME, _CYCLES = ("time",), ("cycle",)


class DriveLedger(Ledger):
    """Mean powers over the window, W: drive + actuator = load + friction + damping + stored.

    Attributes
    ----------
    drive : float
        The motor's: torque on the shaft's end times its steady speed.
    actuator : float
        What the vibration puts in, wherever it is applied; below 0 where it is driven.
    load : float
        What the wheel gives to the load.
    friction : float
        Lost between the flanks.
    damping : float
        Lost in the contact's damping, the shaft's and the seat's.
    stored : float
        Rate of change of kinetic and elastic energy.
    """

    drive: float = quantity("P_d", "W", "power of the motor")
    actuator: float = quantity("P_a", "W", "mechanical power of the vibration's actuator")
    load: float = quantity("P_R", "W", "power given to the load")
    friction: float = quantity("P_f", "W", "power lost to friction between the flanks")
    damping: float = quantity("P_h", "W", "power lost to damping of contact, shaft and seat")
    stored: float = quantity("P_s", "W", "rate of change of stored energy")

    @property
    def _inputs(self) -> tuple[float, ...]:
        # A load that drives the worm puts in what it gives.
        return self.drive, self.actuator, max(-self.load, 0.0), max(-self.stored, 0.0)

    @property
    def _outputs(self) -> tuple[float, ...]:
        return max(self.load, 0.0), self.friction, self.damping, max(self.stored, 0.0)


class Bands(Quantities):
    """Motion over time in stretches: mean, least and greatest of each."""

    time: FloatArray = quantity("t", "s", "time", dims=_OVER_TIME, coordinate=True)
    torque: FloatArray = quantity("T_B", "N m", "torque of the worm's shaft", dims=_OVER_TIME)
    torque_min: FloatArray = quantity("T_B", "N m", "least torque of a stretch", dims=_OVER_TIME)
    torque_max: FloatArray = quantity("T_B", "N m", "greatest torque of a stretch", dims=_OVER_TIME)
    normal: FloatArray = quantity("N", "N", "normal force, driving flank", dims=_OVER_TIME)
    normal_min: FloatArray = quantity("N", "N", "least normal force of a stretch", dims=_OVER_TIME)
    normal_max: FloatArray = quantity(
        "N", "N", "greatest normal force of a stretch", dims=_OVER_TIME
    )
    back: FloatArray = quantity("N_b", "N", "normal force, other flank", dims=_OVER_TIME)
    open: FloatArray = quantity("", "", "share of a stretch without contact", dims=_OVER_TIME)


class CycleMeans(Quantities):
    """Means of whole cycles, from the start of the vibration on."""

    cycle_end: FloatArray = quantity("t", "s", "end of the cycle", dims=_CYCLES, coordinate=True)
    cycle_torque: FloatArray = quantity("T_B", "N m", "torque, mean of a cycle", dims=_CYCLES)
    cycle_wheel: FloatArray = quantity(
        "T_R", "N m", "torque of the mesh on the wheel, mean of a cycle", dims=_CYCLES
    )


class DriveResult(OfDrive):
    """The answer for a gearset under vibration.

    A torque ratio means nothing without ``torque_balance`` and ``settled``: while the wheel coasts
    or speeds up, the worm may carry any torque.

    Attributes
    ----------
    problem : DriveProblem
        What was asked.
    """

    title: ClassVar[str] = "Worm gearset under vibration"
    stem: ClassVar[str] = "drive"
    drawings: ClassVar[Mapping[str, str]] = {
        "drive": "asperity.drive.plots:plot_torque",
        "drive_powers": "asperity.drive.plots:plot_powers",
    }

    captions: ClassVar[Mapping[str, str]] = {
        "drive": "The worm's torque over the last cycles, and its means from the start on.",
        "drive_powers": "Mean powers over the window: what is put in, and where it goes.",
    }

    k_w: float = quantity("k_w", "", "peak velocity of the vibration over the sliding", key="k_w")
    torque_static: float = quantity("T_Bs", "N m", "torque without vibration")
    torque: float | None = quantity("T_Bv", "N m", "mean torque under vibration")
    torque_ratio: float | None = quantity("T_Bv/T_Bs", "", "mean torque over that without")
    torque_ratio_closed_form: float | None = quantity(
        "T_B(mu S)/T_Bs", "", "ratio of a fast screw by closed form, in balance", optional=True,
        default=None,
    )  # fmt: skip
    torque_balance: float = quantity(
        "T_m/T_R - 1", "", "what the mesh gives the wheel beyond its load, over it"
    )
    settled: bool = quantity("", "", "periodic and balanced")
    settled_by: str = quantity("", "", "settled by", shown=False, default="")
    step_error: float | None = quantity(
        "", "", "error of the ratio from the step, about", default=None
    )
    spread: float | None = quantity("", "", "spread of what is to stay, over the last three blocks")
    torque_ratio_window: float | None = quantity(
        "T_Bw/T_Bs", "", "the same over the first cycles, whatever the balance"
    )
    window_balance: float | None = quantity("T_w/T_R - 1", "", "balance over the first cycles")
    floor_reversed: float = quantity(
        "T_Br/T_Bs", "", "ratio with all friction reversed, the least in contact"
    )
    open_share: float = quantity("", "", "share of time without contact")
    second_flank_share: float = quantity("", "", "share of time on the other flank")
    force_max: float = quantity(
        "N_max", "N", "greatest normal force, once settled of the last block of cycles"
    )
    force_run_in: float | None = quantity(
        "N_on", "N", "greatest normal force since it was switched on", default=None
    )
    force_static: float = quantity("N_s", "N", "normal force without vibration")
    advantage_min: float | None = quantity(
        "", "", "least torque of the worm over the wheel's, over the same without vibration, while "
        "the driving flank alone touches",
    )  # fmt: skip
    advantage_max: float | None = quantity("", "", "the greatest of it")
    ledger: DriveLedger = part(DriveLedger, "power_")
    energy_ratio: float | None = quantity(
        "(P_d + P_a)/P_0", "", "mechanical power put in over that without vibration"
    )
    energy_ratio_error: float | None = quantity(
        "", "", "error of the power put in over that without, about", default=None
    )
    saved_power: float | None = quantity(
        "P_0 - P_d", "W", "drive power saved, worm and wheel in balance", default=None
    )
    saved_power_error: float | None = quantity(
        "", "W", "error of the drive power saved, about", default=None
    )
    saved_per_actuator: float | None = quantity(
        "(P_0 - P_d)/P_a", "", "drive power saved per actuator power",
        key="saved_per_actuator_W_W", default=None,
    )  # fmt: skip
    saved_per_actuator_error: float | None = quantity(
        "", "", "error of what is saved per actuator power, about",
        key="saved_per_actuator_error_W_W", default=None,
    )  # fmt: skip
    actuator_electrical: float | None = quantity(
        "P_e", "W", "real power that the amplifier takes from the mains, its losses in it"
    )
    actuator_apparent: float | None = quantity(
        "S", "VA", "apparent power behind the amplifier, at the actuator"
    )
    system_efficiency: float | None = quantity(
        "eta_sys", "", "load's power over drive's and actuator's electrical power"
    )
    efficiency_static: float = quantity("eta_s", "", "efficiency without vibration")
    resonance_worm: float | None = quantity(
        "f_1", "Hz", "natural frequency of the worm on its shaft, the mesh open"
    )
    resonance_wheel: float | None = quantity(
        "f_2", "Hz", "natural frequency of the wheel on the teeth, the worm held"
    )
    tooth_mode: float | None = quantity(
        "f_t", "Hz", "lowest natural frequency of a tooth, cut out with its rim", optional=True,
        default=None,
    )  # fmt: skip
    creep: float | None = quantity(
        "",
        "rad/s",
        "mean speed of the wheel with the motor off",
        key="creep_rad_s",
        optional=True,
        default=None,
    )
    held_after: bool | None = quantity(
        "",
        "",
        "whether the gearset holds once vibration and motor are off",
        optional=True,
        default=None,
    )
    residual: float = quantity(
        "", "", "largest residual of the mesh's own equations, over full friction", default=0.0
    )
    course: CycleMeans | None = part(CycleMeans, default=None)
    bands: Bands | None = part(Bands, default=None)
    steps: int = quantity("", "", "time steps", shown=False, default=0)
    seconds: float = quantity(
        "", "s", "time it took", key="seconds", only="json", shown=False, swept=False,
        default=0.0,
    )  # fmt: skip

    @property
    @labelled("", "", "of the powers, what is missing over what is put in", swept=True)
    def closure(self) -> float:
        """Residual of the power ledger."""
        return self.ledger.residual

    @property
    def equal(self) -> float:
        """What powers may differ by that are the same as far as is known, over them.

        All of them, where no error is known.
        """
        return max(EQUAL, 1.0 if self.energy_ratio_error is None else self.energy_ratio_error)

    def headline(self) -> tuple[str, ...]:
        """Return what vibration does to torque, energy and contact."""
        lines = (_torque(self), _energy(self), _contact(self))
        return tuple(line for line in lines if line)

    def heading(self) -> str:
        """Return what was asked, and whether the answer is a periodic state."""
        state = "settled" if self.settled else "not settled"
        return f"{self.problem.drive.protocol}, {self.problem.mode}: {state}"


def _torque(answer: DriveResult) -> str:
    state = state_of(answer.settled, answer.torque_balance)
    protocol = answer.problem.drive.protocol
    if answer.creep is not None:
        creep = Number.of(answer.creep, ".3g", "creep_rad_s")
        return Sentence(
            "with the motor off the wheel creeps at ", creep, " rad/s under the vibration (",
            state, ")",
        )  # fmt: skip
    if answer.torque_ratio is None:
        return Sentence("no torque of a motor to compare (", state, ")")
    ratio = Number.of(answer.torque_ratio, ".3g", "torque_ratio")
    if protocol == "held-wheel":
        return Sentence("a held wheel takes 1/", ratio, " of its load's torque (", state, ")")
    torque = Sentence(ratio, " of the torque without vibration (", state, ")")
    if protocol == "window":
        return Sentence("over its first cycles alone ", torque)
    return torque if answer.settled else Sentence(torque, ": a ratio that need not last")


def _energy(answer: DriveResult) -> str:
    ratio = answer.energy_ratio
    if ratio is None:
        return ""
    said = Sentence(
        "motor and actuator put in ", Number.of(ratio, ".3g", "energy_ratio"),
        " of the power without vibration",
    )  # fmt: skip
    efficiency, equal = answer.system_efficiency, answer.equal
    if efficiency is not None:
        before = answer.efficiency_static
        word = "saves energy" if efficiency * (1.0 - equal) > before else "saves no energy"
        return Sentence(
            said, ", efficiency with the actuator's electrical side ",
            Number.of(efficiency, ".3g", "system_efficiency"), ", without vibration ",
            Number.of(before, ".3g", "efficiency_static"),
            f": it {word}" if answer.settled else "", _untold(answer),
        )  # fmt: skip
    word = ": it saves power" if ratio < 1.0 - equal else ": it saves no power"
    return Sentence(
        said, word if answer.settled else "",
        ", the actuator's electrical side ([actuator]) not counted", _untold(answer),
    )  # fmt: skip


def _untold(answer: DriveResult) -> str:
    """Return that less drive power is saved than can be told; nothing where it is told."""
    error = answer.saved_power_error
    if answer.saved_power is not None or error is None:
        return ""
    known = Number.of(error, ".2g", "saved_power_error_W")
    return Sentence("; of the motor's power no saving can be told, which is known to ", known, " W")


def _contact(answer: DriveResult) -> str:
    said = []
    if answer.open_share > 0.0:
        share = Number.of(answer.open_share, ".2g", "open_share", 100.0)
        said.append(Sentence("contact is lost for ", share, " % of the time"))
    most, before = _newtons(answer, "force_max"), _newtons(answer, "force_static")
    first = answer.force_run_in
    in_all: tuple[str, ...] = ()
    if answer.settled and first is not None and first > _MORE * answer.force_max:
        in_all = (", ", _newtons(answer, "force_run_in"), " N since it was switched on")
    said.append(
        Sentence(
            "the flanks take at most ", most, " N", *in_all,
            ", without vibration ", before, " N",
        )
    )  # fmt: skip
    if answer.held_after is not None:
        said.append(Sentence("holds after it" if answer.held_after else "does not hold after it"))
    return Sentence.joined(said, "; ")


def _newtons(answer: DriveResult, name: str) -> Number:
    force = float(getattr(answer, name))
    return Number.of(force, ".3g" if force < 1e3 else ".0f", f"{name}_N")


class HeldWheel(DriveResult):
    """The answer for a wheel that is held while the motor pushes as it does without vibration."""

    title: ClassVar[str] = "Held wheel of a worm gearset under vibration"

    torque_ratio: float | None = quantity(
        "T_R/T_m", "", "load over the mean torque on the held wheel, the motor's torque the same"
    )
