"""The `[slider]` and `[solve]` tables: the body, its drive, and how to find the answer."""

import functools
import math
from collections.abc import Callable
from typing import Annotated, Any, ClassVar, Literal, ParamSpec, TypeVar

from pydantic import model_validator

from asperity.casefile import Table
from asperity.errors import AsperityError, InputError
from asperity.friction import Friction
from asperity.normal import Normal
from asperity.units import Quantity
from asperity.vibration import Vibration

_Given = ParamSpec("_Given")
_Answer = TypeVar("_Answer")

FAR_APART = (
    "the numbers of this case are too far apart to calculate with; look for a value with a wrong "
    "unit or exponent"
)


class Slider(Table):
    """A body pulled over a base.

    Parameters
    ----------
    drive_velocity : float or str
        Velocity at which the drive is pulled v_d > 0, m/s.
    normal_force : float or str
        Force between body and base F_N, N; at least 1e-12, below which its numbers tell nothing.
    drive_stiffness : float or str, optional
        Stiffness between drive and body k_d, N/m; left out: a rigid drive, the body moves at v_d.
    drive_damping : float or str
        Damping beside the stiffness h_d, N s/m.
    mass : float or str, optional
        Mass of the body m, kg; needed with a drive stiffness, or for a body that moves sideways.
    lateral : {'free', 'guided'}, optional
        Whether the body can move sideways. Left out: free if it has a mass.
    """

    table: ClassVar[str] = "slider"

    drive_velocity: Annotated[float, Quantity("m/s", what="a velocity", example="0.5 mm/s")]
    normal_force: Annotated[float, Quantity("N", what="a force", example="55 N", ge=1e-12)]
    drive_stiffness: (
        Annotated[float, Quantity("N/m", what="a stiffness", example="96068 N/m", gt=0)] | None
    ) = None
    drive_damping: Annotated[
        float, Quantity("N s/m", what="a damping", example="10 N s/m", ge=0)
    ] = 0.0
    mass: Annotated[float, Quantity("kg", what="a mass", example="0.5 kg", gt=0)] | None = None
    lateral: Literal["free", "guided"] | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Slider":
        if self.drive_velocity <= 0.0:
            raise InputError(
                f"slider.drive_velocity is {self.drive_velocity:g} m/s; it must be positive "
                "(to reverse the drive, turn vibration.direction by 180 deg instead)"
            )
        if self.drive_stiffness is None:
            if self.drive_damping > 0.0:
                raise InputError(
                    "slider.drive_damping is given without slider.drive_stiffness; a rigid drive "
                    "has none"
                )
            if self.mass is None and self.lateral == "free":
                raise InputError(
                    "slider.lateral is 'free', which needs slider.mass; give a mass or guide the "
                    "body"
                )
        elif self.mass is None:
            raise InputError(
                "slider.mass is missing; a drive with stiffness needs it (leave "
                "slider.drive_stiffness out for a rigid drive)"
            )
        return self

    @property
    def rigid(self) -> bool:
        """Whether the drive is rigid."""
        return self.drive_stiffness is None

    @property
    def free(self) -> bool:
        """Whether the body moves sideways."""
        return self.mass is not None and self.lateral != "guided"


class Solve(Table):
    """How the answer is found.

    Parameters
    ----------
    method : {'march', 'periodic', 'homogenised', 'settled'}
        Time integration; the periodic state by shooting; the tabulated cycle-mean law; for an
        elastic block alone, what it settles to under vibration.
    scheme : {'exponential', 'two-phase'}
        Exponential midpoint (default), or the thesis's explicit scheme (with ``march`` and law
        ``split`` only).
    step : float or str, optional
        Time step, s. Left out: 1/500 of a vibration period, at most 1 us where there is none, or
        so much finer that it makes an error below a thousandth of the ratio.
    duration : float or str, optional
        Simulated time, s. Left out: enough for two windows after the start of the vibration, and
        on until the march has settled, to sixteen times as much.
    """

    table: ClassVar[str] = "solve"

    method: Literal["march", "periodic", "homogenised", "settled"] = "march"
    scheme: Literal["exponential", "two-phase"] = "exponential"
    step: Annotated[float, Quantity("s", what="a time", example="1 us", gt=0)] | None = None
    duration: Annotated[float, Quantity("s", what="a time", example="1 s", gt=0)] | None = None

    @model_validator(mode="after")
    def _consistent(self) -> "Solve":
        if self.scheme == "two-phase" and self.method != "march":
            raise InputError(
                f"solve.scheme is 'two-phase', which goes with solve.method 'march' only; the "
                f"method is '{self.method}'"
            )
        return self


def check_normal(
    slider: Slider,
    friction: Friction,
    vibration: Vibration | None,
    normal: Normal | None,
    solve: Solve,
) -> None:
    """Refuse tables that do not go together in the direction normal to the plane.

    Raises
    ------
    InputError
        Naming the keys.
    """
    elevation = 0.0 if vibration is None else vibration.elevation
    lifted = math.sin(elevation) > 1e-12
    if normal is None:
        if lifted:
            raise InputError(
                f"vibration.elevation is {math.degrees(elevation):g} deg, but the normal force is "
                "a constant; describe the contact in [normal] (law, stiffness), or leave the "
                "elevation out"
            )
        if vibration is not None and vibration.normal_phase != 0.0:
            raise InputError(
                f"vibration.normal_phase is {math.degrees(vibration.normal_phase):g} deg, but "
                "nothing moves normal to the plane: describe the contact in [normal], or leave the "
                "phase out"
            )
        if friction.model == "springs":
            raise InputError(
                "friction.model is 'springs', which follow the penetration; describe it in "
                "[normal] (law, stiffness), or use 'dahl', whose exponents 0, 1/3 and 1 are the "
                "first loadings of flat, Hertz and rough contacts"
            )
        if friction.load_exponent != 1.0:
            raise InputError(
                f"friction.load_exponent is {friction.load_exponent:g}; the normal force of "
                "[slider] is constant, so that nothing follows from it: leave it out"
            )
        return
    if friction.model == "springs" and friction.load_exponent != 1.0:
        raise InputError(
            f"friction.load_exponent is {friction.load_exponent:g}; springs carry a load each, and "
            "their friction is proportional to it: leave it out"
        )
    if solve.scheme == "two-phase":
        raise InputError(
            "solve.scheme is 'two-phase', which knows a constant normal force only; leave [normal] "
            "out, or the scheme"
        )
    if lifted and friction.model in ("dahl", "lugre") and friction.law == "split":
        raise InputError(
            "friction.law is 'split', which is of the plane of contact; with vibration.elevation "
            "take 'vector' or 'unsplit'"
        )
    if normal.control == "force" and slider.mass is None:
        raise InputError(
            "slider.mass is missing; a body under a dead load needs it (normal.control "
            "'displacement' is a machine that holds its height)"
        )
    normal.loss(slider.normal_force, slider.mass)


def check_scheme(friction: Friction, solve: Solve) -> None:
    """Refuse a scheme that the friction does not go with."""
    if solve.scheme != "two-phase":
        return
    if friction.model != "dahl" or friction.law != "split":
        raise InputError(
            "solve.scheme is 'two-phase', which exists for friction.model 'dahl' with "
            f"friction.law 'split' only; they are '{friction.model}' and '{friction.law}'"
        )
    if friction.exponent < 1.0:
        raise InputError(
            f"friction.exponent is {friction.exponent:g}; the two-phase scheme needs 1 or more "
            "(below, it never saturates or overshoots the limit): use solve.scheme 'exponential'"
        )


def unit_vector(angle: float) -> tuple[float, float]:
    """Cosine and sine, exact at the quarter turns."""
    turns = angle / (0.5 * math.pi)
    quarter = round(turns)
    if abs(turns - quarter) < 1e-12:
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[quarter % 4]
    return math.cos(angle), math.sin(angle)


class in_proportion:  # noqa: N801
    """Refuse numbers that overflow or vanish when they are put together.

    Around lines, or around a function: without a context of each call, which takes longer than most
    of those functions do.
    """

    def __call__(self, function: Callable[_Given, _Answer]) -> Callable[_Given, _Answer]:
        """Return the function that refuses them."""

        @functools.wraps(function)
        def refusing(*given: _Given.args, **named: _Given.kwargs) -> _Answer:
            try:
                return function(*given, **named)
            except AsperityError:
                raise
            except (ArithmeticError, ValueError):
                raise InputError(FAR_APART) from None

        return refusing

    def __enter__(self) -> None:
        """Begin the lines."""

    def __exit__(
        self, _: type[BaseException] | None, error: BaseException | None, *of: Any
    ) -> None:
        """End them."""
        strange = isinstance(error, ArithmeticError | ValueError)
        if strange and not isinstance(error, AsperityError):
            raise InputError(FAR_APART) from None
