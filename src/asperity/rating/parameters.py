"""The `[operation]` and `[rating]` tables: how a worm gearset is run, and how it is to be rated."""

import functools
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from asperity.casefile import Table
from asperity.casefile.table import numbered
from asperity.errors import InputError
from asperity.gearset.bearings import Bearings
from asperity.gearset.library import find, resolve
from asperity.gearset.lubricants import Lubricant
from asperity.rating.housing import Housing
from asperity.rating.load_steps import (
    LoadStep,
    Power,
    Speed,
    Starts,
    Time,
    Torque,
    Turns,
    steps_of,
)
from asperity.rating.spectrum import Spectrum
from asperity.results.words import Number, Sentence
from asperity.units import Quantity

DEFAULT_LIFE = 25000.0 * 3600.0
"""Life in seconds where none is required: that of AGMA 6034 and of ISO/TR 14521's own tests."""

THROUGH_TRAVEL = 1.0 / 3.0
"""Torque of a valve through its travel over the rated one, where it is left out (thesis 3.2.1)."""

_ASSUMED = {
    "through_travel_torque": "output_torque, all the time",
    "life": "25000 h",
    "lubrication": "bath",
    "oil_temperature": "from the heat balance of ISO/TR 14521",
    "ambient_temperature": "20 degC",
    "bearings": "fixed-floating",
    "bearing_span": "1.5 centre distances, the wheel in the middle",
    "seals": "2",
    "fan": "none",
    "immersed": "worm",
    "application_factor": "1",
    "starts_per_hour": "0",
}

_ROUNDING = 1.0 + 1e-12
_LEAST_SHARE = 1e-9

Temperature = Annotated[
    float, Quantity("K", what="a temperature", example="20 degC", gt=173.15, lt=573.15)
]
Ratio = Annotated[float, Quantity("", what="a factor", example="1.0", gt=0)]


class Operation(Table):
    r"""How a worm gearset is run. The worm drives.

    Parameters
    ----------
    worm_speed : float or str
        Speed of the worm :math:`n_1`, rad/s.
    output_torque : float or str
        Rated wheel torque :math:`T_R`, N m: strength is judged by it. Give this or
        ``input_power`` or ``input_torque``.
    input_power, input_torque : float or str, optional
        Power :math:`P_1`, W, or torque :math:`T_1`, N m, of the worm in place of the wheel's
        torque, which follows by the losses of ISO/TR 14521 of the gearset as it is.
    through_travel_torque : float or str, optional
        Wheel torque through the travel :math:`T_2`, N m: wear is judged by it. Left out:
        ``output_torque``, or as ``service`` has it. A duty cycle takes its place.
    service : {'continuous', 'valve'}
        Whether the rated torque stands all the time, or seats a valve as in the thesis: then
        :math:`T_2` is a third of it where it is left out (3.2.1), and the rated torque counts for a
        tenth of the running time (3.3.1).
    wheel_revolutions : float, optional
        Required life in turns of the wheel. Give this or ``life``; left out: ``life``.
    life : float or str, optional
        Required life, s. Left out: 25000 h.
    duty_cycle : list of table or str, optional
        Parts of the required life, each a `LoadStep`, in place of ``life``; none above
        ``output_torque``.
    lubricant : str or table
        A name that ``asperity lubricants`` lists, or a table with its keys.
    lubrication : {'bath', 'spray'}
        How the lubricant gets to the teeth.
    oil_temperature : float or str, optional
        Sump temperature, K. Left out: from the heat balance of the standard.
    ambient_temperature : float or str
        Temperature of the air around, K; 20 degC if left out.
    bearings : str or table
        Arrangement of the worm's bearings: 'fixed-floating', 'preloaded', a name of your own or a
        table with the keys of `asperity.gearset.bearings.Bearings`.
    bearing_span : float or str, optional
        Between the worm's bearings, m; that of ``[worm_shaft]``, else 1.5 centre distances.
    seals : int
        Lip seals on the worm shaft.
    fan : bool
        Whether a fan sits on the worm shaft.
    immersed : {'worm', 'wheel'}
        What dips into the oil.
    application_factor : float
        Application factor :math:`K_A`, which multiplies the torque, of shafts and bearings too.
    starts_per_hour : float
        Starts per hour :math:`N_S`.
    spectrum, housing : table, optional
        What the tables ``[spectrum]`` and ``[housing]`` of a case say; see `with_tables`.
    """

    table: ClassVar[str] = "operation"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("wheel_revolutions", "life", "duty_cycle"),
    )
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("output_torque", "input_power", "input_torque"),
    )

    worm_speed: Speed
    # Which is never missing where a standard is applied: see asperity.rating.driven.
    output_torque: Torque = None  # type: ignore[assignment]
    input_power: Power | None = None
    input_torque: Torque | None = None
    through_travel_torque: Torque | None = None
    service: Literal["continuous", "valve"] = "continuous"
    wheel_revolutions: Turns | None = None
    life: Time | None = None
    duty_cycle: Annotated[tuple[LoadStep, ...], Field(min_length=1)] | None = None
    lubricant: Lubricant
    lubrication: Literal["bath", "spray"] = "bath"
    oil_temperature: Temperature | None = None
    ambient_temperature: Temperature = 293.15
    bearings: Bearings = Field(default_factory=lambda: find(Bearings, "fixed-floating"))
    bearing_span: (
        Annotated[float, Quantity("m", what="a length", example="110 mm", gt=0)] | None
    ) = None
    seals: Annotated[int, Field(strict=True, ge=0, le=10)] = 2
    fan: Annotated[bool, Field(strict=True)] = False
    immersed: Literal["worm", "wheel"] = "worm"
    application_factor: Ratio = 1.0
    starts_per_hour: Starts = 0.0
    spectrum: Spectrum | None = Field(default=None, exclude=True)
    housing: Housing | None = Field(default=None, exclude=True)

    @model_validator(mode="before")
    @classmethod
    def _named(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if not isinstance(data, Mapping):
            return data
        named = dict(data)
        if "lubricant" in named:
            named["lubricant"] = resolve(Lubricant, named["lubricant"], info.context)
        if named.get("duty_cycle") is not None:
            named["duty_cycle"] = steps_of(
                named["duty_cycle"], info.context, "operation.duty_cycle"
            )
        for key in ("spectrum", "housing"):
            if not isinstance(named.get(key), Spectrum | Housing | None):
                raise InputError(f"operation.{key} is a table of its own; write it as [{key}]")
        if "bearings" in named:
            try:
                named["bearings"] = resolve(Bearings, named["bearings"], info.context)
            except InputError as error:
                raise InputError(f"operation.{error}") from None
        return named

    @model_validator(mode="after")
    def _consistent(self) -> "Operation":
        if self.driven_by:
            return self
        if (
            self.through_travel_torque is not None
            and self.through_travel_torque > self.output_torque
        ):
            raise InputError(
                f"operation.through_travel_torque is {self.through_travel_torque:g} N m; it must "
                f"not exceed operation.output_torque, {self.output_torque:g} N m"
            )
        if self.spectrum is not None and self.duty_cycle is not None:
            raise InputError("operation.duty_cycle and [spectrum] are given; keep one of them")
        key = "spectrum.step" if self.spectrum is not None else "operation.duty_cycle"
        # Those that what drives is given for are looked at once it is known.
        torques = {n: step.output_torque or 0.0 for n, step in enumerate(self.steps or (), 1)}
        for n, torque in sorted(torques.items(), key=lambda each: -each[1]):
            has = f"{key} has a part with {torque:g} N m, {numbered(n)}"
            rated = f"operation.output_torque, {self.output_torque:g} N m"
            if torque > self.output_torque * _ROUNDING:
                more = "raise that, by which strength is judged"
                raise InputError(f"{has}; none may exceed {rated}: {more}")
            if 0.0 < torque < self.output_torque * _LEAST_SHARE:
                least = f"it must be at least {_LEAST_SHARE:g} of {rated}"
                raise InputError(f"{has}; {least}: leave out what carries nothing")
        return self

    @functools.cached_property
    def _steps(self) -> tuple[LoadStep, ...] | None:
        if self.spectrum is not None:
            return self.spectrum.steps(self.output_torque)
        return self.duty_cycle

    @property
    def steps(self) -> tuple[LoadStep, ...] | None:
        """The steps of the duty cycle or spectrum; None of a load that is all the same."""
        return self._steps

    def with_steps(self, steps: tuple[LoadStep, ...], **more: float) -> "Operation":
        """Return it with other steps in the place of its own, and other numbers in SI."""
        update: dict[str, Any] = {"duty_cycle": steps, **more}
        if self.spectrum is not None:
            whole = {"step": steps, "duty_class": None, "life": None, "stroke": None}
            spectrum = self.spectrum.model_copy(update={**whole, "cycles": None})
            update = {"spectrum": spectrum, **more}
        return self.model_copy(update=update, units="SI")

    def with_tables(
        self, spectrum: Spectrum | None = None, housing: Housing | None = None
    ) -> "Operation":
        """Return it with what the tables ``[spectrum]`` and ``[housing]`` say of the same run.

        Parameters
        ----------
        spectrum, housing : Spectrum, Housing, optional
            Left out: as it has them.

        Returns
        -------
        Operation
            Another one, or the same where nothing is said.
        """
        if spectrum is not None:
            spectrum.require_beside(self.oil_temperature)
        given = {"spectrum": spectrum, "housing": housing}
        update = {key: table for key, table in given.items() if table is not None}
        return self.model_copy(update=update) if update else self

    @property
    def parts(self) -> tuple[Spectrum | Housing, ...]:
        """What `with_tables` gave it."""
        return tuple(table for table in (self.spectrum, self.housing) if table is not None)

    @property
    def service_factor(self) -> float | None:
        """That of AGMA 6034, by the spectrum; None where ``application_factor`` counts."""
        if self.spectrum is None:
            return None
        return self.spectrum.service_factor(self.most_starts)

    @property
    def most_starts(self) -> float:
        """Most starts per hour of any step."""
        own = (step.starts_per_hour for step in self.steps or ())
        each = [self.starts_per_hour if starts is None else starts for starts in own]
        return max(each, default=self.starts_per_hour)

    @property
    def driven_by(self) -> str:
        """What of the worm is given in place of the torque of the wheel; else empty."""
        given = (key for key in ("input_power", "input_torque") if getattr(self, key) is not None)
        return next(given, "")

    @property
    def travel_torque(self) -> float:
        """Torque of the wheel that wear is judged by, N m: T_2; of a duty cycle, the greatest."""
        if self.steps is not None:
            return max(step.torque for step in self.steps)
        if self.through_travel_torque is not None:
            return self.through_travel_torque
        return self.travel_share * self.output_torque

    @property
    def travel_share(self) -> float:
        """T_2 over T_R where neither T_2 nor a duty cycle is given."""
        return THROUGH_TRAVEL if self.service == "valve" else 1.0

    @property
    def wear_assumed(self) -> str:
        """What is to be said of the torque that wear is judged by; empty where it is given."""
        return self.wear_sentence()

    def wear_sentence(self, within: str = "") -> Sentence | str:
        """As `wear_assumed`, its numbers by where they stand ``within`` an answer's JSON."""
        given = self.through_travel_torque is not None or self.steps is not None
        if given or self.service != "valve":
            return ""
        of_wear, rated = (
            Number.of(value, ".4g", within and f"{within}.{name}_torque_Nm")
            for name, value in (
                ("through_travel", self.travel_torque),
                ("output", self.output_torque),
            )
        )
        return Sentence(
            "wear is judged at T_2 = ", of_wear, " N m, of a valve assumed a third of the ", rated,
            " N m given: else give operation.through_travel_torque",
        )  # fmt: skip

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        left_out = {
            key: reason
            for key, reason in _ASSUMED.items()
            if key not in self.model_fields_set or getattr(self, key) is None
        }
        if self.wheel_revolutions is not None or self.steps is not None:
            left_out.pop("life", None)
        if self.steps is not None:
            left_out.pop("through_travel_torque", None)
        elif self.service == "valve" and "through_travel_torque" in left_out:
            left_out["through_travel_torque"] = "a third of output_torque, as of a valve"
        return MappingProxyType({**left_out, **self.lubricant.assumed})


class RatingOptions(Table):
    r"""How a worm gearset is to be rated.

    Parameters
    ----------
    iso14521_edition : {'1998', '2010'}
        Edition whose formulas are taken.
    iso14521_face_width : {'tip_chord', 'reference_chord'}
        Face width :math:`b_{2H}` that carries by ISO/TR 14521, at most the wheel's own where that
        is given: :math:`2 m_{x1} \sqrt{q_1 + 1}`, which is assumed because BS 721 takes it, or
        :math:`\sqrt{6 m_{x1} d_{m1} - 9 m_{x1}^2}`, which a commercial program prints for DIN 3996
        and which makes the shear stress at the root some 5 % lower.
    bs721_tables : path, optional
        A TOML file of your own tables of BS 721, in place of those that ship from memory.
    bs721_friction_angle : {'mu', 'mu_over_cos'}
        What the efficiencies of BS 721 take for the friction angle: :math:`\arctan \mu`, or
        :math:`\arctan(\mu/\cos\alpha_n)`, as Carvill, RoyMech and JGMA 405-01 have it; then a worm
        locks itself at some 6 % less friction. Permissible torques do not rest on it.
    base_friction : float, optional
        Coefficient of friction in place of :math:`\mu_{0T}`: the methods of the thesis's Table 3.3
        act here.
    friction : float, optional
        Coefficient of friction in place of the mean tooth friction of every standard.
    friction_factor : float
        Multiplies the tooth friction of every standard: the way in for vibration.
    wear_factor : float
        Multiplies :math:`W_{ML}` of ISO/TR 14521: how fast the wheel wears beside the standard's
        materials, as against a coated worm, 0.1 where it wears ten times less.
    pitting_factor : float
        Multiplies :math:`\sigma_{HlimT}` of ISO/TR 14521; a capacity goes with its square.
    """

    table: ClassVar[str] = "rating"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("base_friction", "friction"),)

    # A year given by --set arrives as a number.
    iso14521_edition: Annotated[
        Literal["1998", "2010"],
        BeforeValidator(
            lambda year: str(year) if isinstance(year, int) else year,
            json_schema_input_type=Literal["1998", "2010", 1998, 2010],
        ),
    ] = "2010"
    iso14521_face_width: Literal["tip_chord", "reference_chord"] = "tip_chord"
    bs721_tables: Path | None = None
    bs721_friction_angle: Literal["mu", "mu_over_cos"] = "mu"
    base_friction: (
        Annotated[
            float, Quantity("", what="a coefficient of friction", example="0.055", gt=0, lt=1)
        ]
        | None
    ) = None
    friction: (
        Annotated[float, Quantity("", what="a coefficient of friction", example="0.05", ge=0, lt=1)]
        | None
    ) = None
    friction_factor: Annotated[float, Quantity("", what="a factor", example="1.0", ge=0, le=10)] = (
        1.0
    )
    wear_factor: Annotated[float, Quantity("", what="a factor", example="0.1", ge=1e-6, le=1e6)] = (
        1.0
    )
    pitting_factor: Annotated[
        float, Quantity("", what="a factor", example="1.33", ge=1e-3, le=1e3)
    ] = 1.0

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        defaults = {
            "iso14521_edition": "2010",
            "iso14521_face_width": "tip_chord, as BS 721 has it; 'reference_chord' is some 5 % "
            "wider, and a commercial program takes that",
            "friction_factor": "1",
        }
        return MappingProxyType(
            {key: text for key, text in defaults.items() if key not in self.model_fields_set}
        )
