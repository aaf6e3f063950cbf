"""Tables of what is done with a rig: the plan, the simulated rig, the reduction."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import MOST_DIGITS, Table
from asperity.errors import InputError
from asperity.tribometer.parameters import Mode
from asperity.tribometer.quantities import (
    Count,
    Current,
    Duration,
    Frequency,
    Mass,
    Share,
    Span,
    Speed,
    Tolerance,
    Torque,
    Velocity,
    Voltage,
)
from asperity.units import Quantity

Waveform = Literal["sine", "triangle"]
Positive = Annotated[float, Quantity("", "a number", "0.18", gt=0)]
WearRate = Annotated[float, Quantity("m**2/N", "a wear rate", "1e-5 mm3/(N m)", ge=0)]


class Plan(Table):
    """The cells of a test matrix and how long each part of a run takes.

    Parameters
    ----------
    modes, lubricants, waveforms : list of str
        What is combined; ``excluded`` names those that are not run.
    excluded : list of str
        Combinations as ``"longitudinal grease"`` or ``"grease triangle"``: a cell that holds all
        words of one is left out.
    steel_supplies : list of float or str
        V.
    bronze_supply : float or str
        V.
    frequencies : list of float or str
        Hz: those a drive signal is told apart by.
    repeats : int
        Recordings of each file's cells.
    before, shaken, idle : float or str
        Sliding without vibration, with it, and at rest, s.
    distance : float or str, optional
        Sliding distance of a run, m: a wear test. In place of ``shaken`` each run slides that far,
        with discs of its own, which are weighed before, after and on the way.
    stretches : int
        Of a wear test: parts of that distance, with a weighing behind each.
    unshaken : bool
        Of a wear test: whether every setting has runs without vibration as well.
    sample_rate : float or str
        Of recordings, Hz; the thesis states none.
    order : {'thesis', 'randomised'}
        Of the cells.
    seed : int
        Of a randomised order.
    """

    table: ClassVar[str] = "plan"

    modes: tuple[Mode, ...] = ("transverse", "longitudinal")
    lubricants: tuple[Literal["oil", "grease", "dry"], ...] = ("oil",)
    waveforms: tuple[Waveform, ...] = ("sine", "triangle")
    excluded: tuple[str, ...] = ()
    steel_supplies: tuple[Voltage, ...] = ()
    bronze_supply: Voltage = 0.0
    frequencies: tuple[Frequency, ...] = ()
    repeats: Count = 1
    before: Duration = 10.0
    shaken: Duration = 10.0
    idle: Duration = 10.0
    distance: Annotated[float, Quantity("m", "a distance", "1800 m", gt=0)] | None = None
    stretches: Count = 1
    unshaken: bool = True
    sample_rate: Annotated[float, Quantity("Hz", "a frequency", "20 kHz", ge=100.0, le=500e3)] = (
        20e3
    )
    order: Literal["thesis", "randomised"] = "thesis"
    seed: Annotated[int, Field(strict=True, ge=0, le=MOST_DIGITS)] = 0


class Twin(Table):
    """Parameters of the simulated rig; none of them has been measured but where a case says so.

    Parameters
    ----------
    motor_constant : float or str
        k_e, V s/rad and N m/A.
    motor_resistance : float or str
        R, ohm.
    motor_drag, bronze_drag : float or str
        Torque of the motor and its gear without load, N m, at the motor.
    gear_efficiency : float
        eta_g of the steel disc's gear.
    mu : float
        Coefficient of friction at rest.
    mu_drop : float
        Share of it that is lost at speed, mu(v) = mu0 (1 - d (1 - exp(-v/v_S))).
    stribeck_velocity : float or str
        v_S, m/s.
    bronze_velocity : float or str
        v_pa, m/s; noted only: the simulated worm turns as its supply and its load let it.
    torque_noise, coloured_noise : float or str
        Standard deviations of what is white from sample to sample, and of what is not, N m.
    noise_time : float or str
        Correlation time of the latter, s.
    runout_steel, runout_bronze : float
        Amplitude of the torque over a turn of each disc, as a share of it.
    drift : float
        Change of the torque over an hour, as a share of it.
    max_deflection : float or str
        Of the asperities at full friction, m.
    motor_inertia : float or str
        Of each motor with its gear, kg m2.
    supply_current : float or str
        What a supply gives at most, A.
    rotor_inertia, rotor_frequency, rotor_damping : float or str, optional
        The steel disc on its shaft: J in kg m2, its torsional frequency in Hz and its share of
        critical damping; left out, the disc does not answer to vibration along the sliding.
    encoder_gate, encoder_lag : float or str
        Time pulses are counted over, and time constant of the filter behind, s.
    current_noise : float or str
        Standard deviation of the current clamps, A.
    brake_resistance : float or str
        Of the coil of a wheel's brake, ohm.
    wear_steel, wear_bronze : float or str
        Volume that each disc loses by force and path of one on the other, m2/N; 0: it loses none.
    weighing_noise : float or str
        Standard deviation of a weighing, kg.
    seed : int
        Of the noise.
    motor_tolerance, drag_tolerance, gear_tolerance : float
        By what share of themselves a real rig's motors may differ in constant and resistance, which
        warm with them, in drag and in the gear's efficiency, before a recording contradicts.
    supply_tolerance : float
        By what share of its volts a supply may give otherwise than it was told.
    lead_voltage : float or str
        What may fall in leads and brushes, V.
    """

    table: ClassVar[str] = "twin"

    motor_constant: Annotated[float, Quantity("V s/rad", "a constant", "0.05 V s/rad", gt=0)]
    motor_resistance: Annotated[float, Quantity("ohm", "a resistance", "0.3 ohm", gt=0)]
    motor_drag: Torque = 0.0
    bronze_drag: Torque = 0.0
    gear_efficiency: Annotated[float, Quantity("", "an efficiency", "0.7", gt=0, le=1)] = 1.0
    mu: Positive
    mu_drop: Annotated[float, Quantity("", "a share", "0.5", ge=0, lt=1)] = 0.0
    stribeck_velocity: Annotated[float, Quantity("m/s", "a velocity", "6 mm/s", gt=0)] = 1.0
    bronze_velocity: Velocity = 0.0
    torque_noise: Torque = 0.0
    coloured_noise: Torque = 0.0
    noise_time: Span = 0.2
    runout_steel: Share = 0.0
    runout_bronze: Share = 0.0
    drift: Annotated[float, Quantity("", "a share", "0.05", ge=-1, le=1)] = 0.0
    max_deflection: Annotated[float, Quantity("m", "a deflection", "70 nm", gt=0)] = 70e-9
    motor_inertia: Annotated[float, Quantity("kg m**2", "an inertia", "5e-5 kg m2", gt=0)] = 5e-5
    supply_current: Annotated[float, Quantity("A", "a current", "5 A", gt=0)] = 5.0
    rotor_inertia: (
        Annotated[float, Quantity("kg m**2", "an inertia", "1e-4 kg m2", gt=0)] | None
    ) = None
    rotor_frequency: Frequency | None = None
    rotor_damping: Share = 0.02
    encoder_gate: Span = 1.0
    encoder_lag: Span = 0.2
    current_noise: Current = 0.02
    brake_resistance: Annotated[float, Quantity("ohm", "a resistance", "20 ohm", gt=0)] = 20.0
    wear_steel: WearRate = 0.0
    wear_bronze: WearRate = 0.0
    weighing_noise: Mass = 0.0
    seed: Annotated[int, Field(strict=True, ge=0, le=MOST_DIGITS)] = 0
    motor_tolerance: Tolerance = 0.1
    drag_tolerance: Tolerance = 0.25
    gear_tolerance: Tolerance = 0.25
    supply_tolerance: Tolerance = 0.02
    lead_voltage: Voltage = 0.1

    @model_validator(mode="after")
    def _rotor(self) -> "Twin":
        if (self.rotor_inertia is None) != (self.rotor_frequency is None):
            raise InputError(
                "twin.rotor_inertia and twin.rotor_frequency describe the steel disc on its shaft "
                "together; give both or none"
            )
        return self


class Reduction(Table):
    """How recordings become numbers.

    Parameters
    ----------
    block : float or str
        Samples are taken together over so long, s.
    settling : float or str
        Left out behind every change, s.
    speed_settling : float or str
        Left out behind every change of the speeds, s: an encoder counts pulses over a while, and a
        filter is behind it.
    least_window : float or str
        A shorter window is refused, s.
    threshold : float
        Drive signal, as a share of its largest, above which there is vibration.
    least_drive : float or str
        Deviation of a drive signal below which there is none at all, V.
    running_speed : float or str
        Of the steel disc's motor, above which it turns.
    frequency_tolerance : float
        Between a measured and a commanded frequency, as a share.
    confidence : float
        Of intervals.
    drift : bool
        Whether a slow drift of the torque is estimated, too.
    weighing_uncertainty : float or str, optional
        Standard deviation of a weighing, kg; left out, that of the masses about their line.
    """

    table: ClassVar[str] = "reduction"

    block: Annotated[float, Quantity("s", "a time", "20 ms", gt=0, le=1)] = 0.02
    settling: Duration = 1.0
    speed_settling: Duration = 3.0
    least_window: Span = 3.0
    threshold: Annotated[float, Quantity("", "a share", "0.4", gt=0, lt=1)] = 0.4
    least_drive: Annotated[float, Quantity("V", "a voltage", "0.1 V", gt=0)] = 0.1
    running_speed: Speed = 2.0
    frequency_tolerance: Annotated[float, Quantity("", "a share", "0.01", gt=0, lt=0.5)] = 0.02
    confidence: Annotated[float, Quantity("", "a share", "0.95", gt=0.5, lt=1)] = 0.95
    drift: bool = True
    weighing_uncertainty: Annotated[float, Quantity("kg", "a mass", "0.1 mg", gt=0)] | None = None

    @model_validator(mode="after")
    def _fits(self) -> "Reduction":
        if self.least_window < 10.0 * self.block:
            raise InputError(
                f"reduction.least_window is {self.least_window:g} s; it must be at least ten "
                f"times reduction.block = {self.block:g} s"
            )
        return self
