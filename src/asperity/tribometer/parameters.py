"""Tables of a rig's configuration: the machine, its discs, drives, sonotrode, oil and limits."""

from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.tribometer.quantities import (
    AnyVoltage,
    Count,
    Current,
    Force,
    Frequency,
    Length,
    Mass,
    Modulus,
    Ratio,
    Share,
    Temperature,
    Tolerance,
    Torque,
    Velocity,
    Voltage,
)
from asperity.units import Quantity

TRANSVERSE, LONGITUDINAL, AXIAL = "transverse", "longitudinal", "axial"
Mode = Literal["transverse", "longitudinal", "axial"]
"""Directions of the vibration: of a disc against the sliding; of a worm along its axis."""

GRAVITY = 9.81
"""m/s2, as thesis (72) has it."""


class Rig(Table):
    """The machine as a whole, and how it stands for a recording.

    Parameters
    ----------
    name : str
        What it is called in reports.
    mode : {'transverse', 'longitudinal', 'axial'}
        Direction of the vibration against the sliding; of a gear rig along the worm's axis.
    platform_mass, dead_mass : float or str
        What presses the discs together, kg: F_N = (m_r + m_w) 9.81, thesis (72).
    normal_force : float or str, optional
        F_N, N, in place of the masses.
    brake_torque : float or str, optional
        Of the wheel's brake, N m, where the rig is a gearset; in place of both.
    bearing_torque_steel, bearing_torque_bronze : float or str
        T_bs and T_ba, N m, thesis (65), (66): what the sensors read with the discs apart.
    bearing_tolerance : float
        Share of a disc's torque that its bearings may hold beyond that, before a recording
        contradicts; less, where a run with the discs apart has told them.
    """

    table: ClassVar[str] = "rig"

    name: str = "rig"
    mode: Mode = "transverse"
    platform_mass: Mass = 0.0
    dead_mass: Mass = 0.0
    normal_force: Force | None = None
    brake_torque: Annotated[float, Quantity("N m", "a torque", "23 N m", gt=0)] | None = None
    bearing_torque_steel: Torque = 0.0
    bearing_torque_bronze: Torque = 0.0
    bearing_tolerance: Tolerance = 0.1

    @model_validator(mode="after")
    def _loaded(self) -> "Rig":
        masses = self.platform_mass + self.dead_mass
        if self.normal_force is not None and masses > 0.0:
            raise InputError(
                "rig.normal_force is given beside rig.platform_mass or rig.dead_mass; keep one "
                "of them"
            )
        pressed = self.normal_force is not None or masses > 0.0
        if self.brake_torque is not None and pressed:
            raise InputError(
                "rig.brake_torque is of a gearset, and rig.normal_force or its masses of discs; "
                "keep one of them"
            )
        if self.brake_torque is None and not pressed:
            raise InputError(
                "rig.normal_force is missing; give it, or rig.platform_mass and rig.dead_mass; of "
                "a gearset rig.brake_torque"
            )
        return self

    @property
    def load(self) -> float:
        """F_N, N, of discs."""
        if self.brake_torque is not None:
            raise InputError(
                "rig.brake_torque is of a gearset, which no force presses together; fit with "
                "--model drive"
            )
        if self.normal_force is not None:
            return self.normal_force
        return (self.platform_mass + self.dead_mass) * GRAVITY


class Disc(Table):
    """A disc of the pair.

    Parameters
    ----------
    material : str
        What it is made of.
    diameter, thickness : float or str
        m.
    young_modulus : float or str
        Pa.
    poisson_ratio : float
        Of the material.
    density : float or str, optional
        kg/m³.
    roughness : float or str, optional
        Ra along the circumference, m.
    hardness : float or str, optional
        Pa, for Archard's coefficient of wear.
    mass_loss : float or str, optional
        What it lost between two weighings, over the recordings that are reduced together, kg.
    composition, treatment : str
        Of the material, and what was done to it: for reports.
    """

    material: str
    diameter: Length
    thickness: Length
    young_modulus: Modulus
    poisson_ratio: Annotated[float, Quantity("", "a ratio", "0.3", ge=0, lt=0.5)] = 0.3
    density: Annotated[float, Quantity("kg/m**3", "a density", "7850 kg/m**3", gt=0)] | None = None
    roughness: Annotated[float, Quantity("m", "a roughness", "0.8 um", gt=0)] | None = None
    hardness: Modulus | None = None
    mass_loss: Annotated[float, Quantity("kg", "a mass", "4.2 mg", ge=0)] | None = None
    composition: str = ""
    treatment: str = ""

    @property
    def radius(self) -> float:
        """Half the diameter, m."""
        return 0.5 * self.diameter


class SteelDisc(Disc):
    """The disc that is driven over a torque sensor and whose torque is told."""

    table: ClassVar[str] = "steel_disc"


class BronzeDisc(Disc):
    """The disc that is shaken."""

    table: ClassVar[str] = "bronze_disc"


class Drives(Table):
    """Motors, gears and their supplies.

    Parameters
    ----------
    gear_ratio : float
        Turns of the steel disc's motor to one of the disc; 32 gives the 960 of thesis (75).
    bronze_gear_ratio : float
        The same of the bronze disc.
    steel_supply, bronze_supply : float or str
        Set voltages of a recording, V; those in its events come first.
    encoder_pulses : int
        Pulses of an encoder to a turn of a motor.
    """

    table: ClassVar[str] = "drives"

    gear_ratio: Ratio
    bronze_gear_ratio: Ratio
    steel_supply: Voltage
    bronze_supply: Voltage
    encoder_pulses: Count = 32


class Sonotrode(Table):
    """The piezo actuator, its amplifier, and how fast it moves the disc.

    Parameters
    ----------
    actuator : str
        What it is.
    stroke : float or str
        From the lowest to the highest voltage, m.
    lowest_voltage, highest_voltage : float or str
        V, after the amplifier.
    amplifier_gain : float
        Of the drive signal.
    blocking_force : float or str
        N.
    preload_voltage : float or str
        Of the load cell, V.
    preload_sensitivity : float or str, optional
        N/V; with it the journal tells the preload in N as well.
    capacitance : float or str, optional
        F; with ``current_limit`` it caps the velocity.
    current_limit : float or str, optional
        Of the amplifier, A.
    frequencies : list of float or str
        Where the velocity has been measured, Hz, rising.
    transverse_velocity, longitudinal_velocity, axial_velocity : list of float or str
        v_a at those frequencies under a full sine, m/s.
    velocity_uncertainty : float
        Standard deviation of those velocities, as a share of them.
    """

    table: ClassVar[str] = "sonotrode"

    actuator: str = ""
    stroke: Length
    lowest_voltage: AnyVoltage
    highest_voltage: AnyVoltage
    amplifier_gain: Ratio = 10.0
    blocking_force: Force | None = None
    preload_voltage: AnyVoltage = 0.0
    preload_sensitivity: (
        Annotated[float, Quantity("N/V", "a sensitivity", "33 N/mV", gt=0)] | None
    ) = None
    capacitance: Annotated[float, Quantity("F", "a capacitance", "11 uF", gt=0)] | None = None
    current_limit: Current | None = None
    frequencies: tuple[Frequency, ...] = ()
    transverse_velocity: tuple[Velocity, ...] = ()
    longitudinal_velocity: tuple[Velocity, ...] = ()
    axial_velocity: tuple[Velocity, ...] = ()
    velocity_uncertainty: Share = 0.0

    @model_validator(mode="after")
    def _consistent(self) -> "Sonotrode":
        if self.highest_voltage <= self.lowest_voltage:
            raise InputError(
                f"sonotrode.highest_voltage is {self.highest_voltage:g} V; it must be above "
                f"sonotrode.lowest_voltage = {self.lowest_voltage:g} V"
            )
        pairs = zip(self.frequencies, self.frequencies[1:], strict=False)
        if any(later <= earlier for earlier, later in pairs):
            raise InputError("sonotrode.frequencies do not rise; sort them, each once")
        for name in (TRANSVERSE, LONGITUDINAL, AXIAL):
            count = len(self.velocities(name))
            if count not in (0, len(self.frequencies)):
                raise InputError(
                    f"sonotrode.{name}_velocity has {count} values; it must have one for each of "
                    f"the {len(self.frequencies)} sonotrode.frequencies"
                )
        return self

    def velocities(self, mode: str) -> tuple[float, ...]:
        """Return v_a at the frequencies, m/s; empty where it is not known.

        Parameters
        ----------
        mode : {'longitudinal', 'transverse', 'axial'}
            Of the vibration.

        Returns
        -------
        tuple of float
            As many as `frequencies`.
        """
        return {
            TRANSVERSE: self.transverse_velocity,
            LONGITUDINAL: self.longitudinal_velocity,
            AXIAL: self.axial_velocity,
        }[mode]

    def velocity(self, mode: str, frequency: float) -> float | None:
        """Return v_a under a full sine, m/s; None where it has not been measured.

        Between the frequencies it follows a curve without overshoot over log f; beyond them
        nothing is known.

        Parameters
        ----------
        mode : {'longitudinal', 'transverse'}
            Of the vibration.
        frequency : float
            Hz.

        Returns
        -------
        float or None
            m/s.
        """
        values = self.velocities(mode)
        if not values or not self.frequencies[0] <= frequency <= self.frequencies[-1]:
            return None
        if len(values) == 1:
            return values[0]
        import numpy as np
        from scipy.interpolate import PchipInterpolator

        return float(PchipInterpolator(np.log(self.frequencies), values)(np.log(frequency)))


class Lubricant(Table):
    """What is between the discs.

    Parameters
    ----------
    kind : {'oil', 'grease', 'dry'}
        For the plan and the table of cells.
    name : str
        Of the product.
    viscosity : float or str, optional
        Dynamic, at the discs, Pa s.
    pressure_viscosity : float or str, optional
        Coefficient alpha of Barus, 1/Pa.
    temperature : float or str, optional
        Of the discs, K.
    """

    table: ClassVar[str] = "lubricant"

    kind: Literal["oil", "grease", "dry"] = "oil"
    name: str = ""
    viscosity: Annotated[float, Quantity("Pa s", "a viscosity", "0.15 Pa s", gt=0)] | None = None
    pressure_viscosity: (
        Annotated[float, Quantity("1/Pa", "a coefficient", "2e-8 1/Pa", gt=0)] | None
    ) = None
    temperature: Temperature | None = None


class Conditions(Table):
    """What a report on tests tells beside their numbers; no number hangs on it.

    Parameters
    ----------
    laboratory, operator : str
        Where and by whom the tests were made.
    temperature : float or str, optional
        Of the air, K.
    humidity : float or str, optional
        Of the air, relative: "45 %".
    atmosphere : str
        What the discs stand in.
    cleaning : str
        How the discs were cleaned before the tests.
    running_in : str
        What was done before the first recording.
    deviations : str
        From the standard that a report follows, beside those of the rig itself.
    """

    table: ClassVar[str] = "conditions"
    counts: ClassVar[bool] = False

    laboratory: str = ""
    operator: str = ""
    temperature: Temperature | None = None
    humidity: Share | None = None
    atmosphere: str = ""
    cleaning: str = ""
    running_in: str = ""
    deviations: str = ""


class Limits(Table):
    """What must not be passed.

    Parameters
    ----------
    torque : float or str
        Of the sensors, N m.
    steel_supply, bronze_supply : float or str
        V.
    motor_current : float or str, optional
        A.
    lowest_frequency, highest_frequency : float or str
        Of the vibration, Hz.
    """

    table: ClassVar[str] = "limits"

    torque: Annotated[float, Quantity("N m", "a torque", "2 N m", gt=0)] = 2.0
    steel_supply: Voltage = 24.0
    bronze_supply: Voltage = 24.0
    motor_current: Current | None = None
    lowest_frequency: Frequency = 1.0
    highest_frequency: Frequency = 100_000.0
