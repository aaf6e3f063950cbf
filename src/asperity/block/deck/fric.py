r"""A friction law of ours as Abaqus's user subroutine FRIC, in fixed-form Fortran 77.

The subroutine is put together from the parts in ``fortran/``: the interface, how the slip falls
into its two parts (base or body vibrated), the law's update with its derivatives, the vibration's
waveform. It takes the same steps as the compiled update of `asperity.friction`, with all the terms
of :math:`\partial\tau/\partial\gamma` (DDTDDG) and :math:`\partial\tau/\partial p` (DDTDDP).

============ =========== ======================================================================
scheme       law         parts
============ =========== ======================================================================
two-phase    split       the thesis's two explicit phases: its Appendix D (base) and Appendix E
                         (body), here with :math:`\eta_y` in both and derivatives that belong to
                         the stress
exponential  vector      relaxation along the slip
exponential  split,      relaxation along the asperity, step with the rate at its middle
             unsplit
============ =========== ======================================================================
"""

import dataclasses
import textwrap
from collections.abc import Iterable, Iterator
from importlib import resources

from asperity.errors import InputError
from asperity.mesh.inp import numbers
from asperity.slider.model import Model
from asperity.vibration.waveform import SAMPLED, SINE

STATE_VARIABLES = 3
# A time no analysis reaches: without vibration it never starts.
_NEVER = 1e30
_WIDTH = 72
_SAMPLES_A_STATEMENT = 36
_PER_LINE = 8  # numbers of a deck


@dataclasses.dataclass(frozen=True)
class FricSubroutine:
    """The subroutine and the numbers its surface interaction hands to it."""

    text: str  #: Fixed-form Fortran 77; with FRIC also DISP where the base's waveform is not a sine
    properties: tuple[float, ...]  #: PROPS, as the deck's ``*FRICTION, USER`` lists them; SI
    #: DEPVAR: deflection of the asperities along both slip directions, and its size, m
    state_variables: int
    moves_base: bool  #: Whether the text contains DISP, the base's motion

    def lines(self) -> Iterator[str]:
        """Yield what a deck's surface interaction says of it."""
        count = len(self.properties)
        yield f"*FRICTION, USER, DEPVAR={self.state_variables}, PROPERTIES={count}"
        for start in range(0, count, _PER_LINE):
            yield numbers(*self.properties[start : start + _PER_LINE])


def fric_subroutine(model: Model, *, before: float = 0.0, side: int = -1) -> FricSubroutine:
    """Write FRIC for a case.

    Parameters
    ----------
    model : Model
        Body, friction and vibration; Dahl friction only.
    before : float
        Time the analysis spends on what comes before the drive (weight, load), s; it is added to
        the start of the vibration.
    side : {-1, 1}
        Whether the second slip direction of the contact points along -y or +y.

    Raises
    ------
    InputError
        The friction model is not Dahl's (Coulomb needs no subroutine; LuGre's damping is not one
        of slip and pressure alone), or keeps the stiffness of its asperities: FRIC follows the
        pressure at the end of an increment, as the thesis's does, and is not told the one before.
    """
    friction = model.friction
    if friction.model != "dahl":
        raise InputError(
            f"friction.model is '{friction.model}'; FRIC is written for 'dahl' (for 'coulomb' "
            "the deck uses Abaqus's own friction)"
        )
    if friction.keeps != "deflection" and model.solve.scheme != "two-phase":
        raise InputError(
            f"friction.keeps is '{friction.keeps}'; FRIC is written for 'deflection', by which "
            "friction follows the pressure at once: give that"
        )
    if side not in (-1, 1):
        raise InputError(f"side is {side}; it must be -1 or 1")
    properties = _properties(model, before, side)
    moves_base = needs_disp(model)
    parts = [_part("fric"), _part("slip_body" if model.on_body else "slip_base")]
    if model.solve.scheme == "two-phase":
        parts += [_part("two_phase")]
    elif friction.law == "vector":
        parts += [_part("vector"), _part("functions")]
    else:
        parts += [_part("midpoint"), _part(f"rate_{friction.law}"), _part("functions")]
    parts.append(_wave(model))
    if moves_base:
        parts.append(_motion(model, before))
    heading = "".join(commented(_heading(model, properties, moves_base)))
    return FricSubroutine(heading + "".join(parts), properties, STATE_VARIABLES, moves_base)


def needs_disp(model: Model) -> bool:
    """Whether the base's motion is more than one periodic amplitude of Abaqus can say."""
    return model.shape is not None and model.vibrates and model.shape.code != SINE


def disp_subroutine(model: Model, *, before: float = 0.0) -> str:
    """Write DISP alone, for a base whose waveform is not a sine under friction Abaqus knows."""
    lines = ["User subroutine DISP for Abaqus/Standard, written by asperity: the base's motion."]
    return "".join([*commented(lines), _motion(model, before), _wave(model)])


def base_amplitudes(model: Model) -> tuple[float, float]:
    """Displacement amplitudes of the base along the drive and across it, m.

    A body's prescribed motion is given to the base with the opposite sign: the slip is the same,
    and the body's inertia does not resist it.
    """
    sign = -1.0 if model.on_body else 1.0
    cos, sin, _ = model.unit_direction
    return sign * model.amplitude * cos + 0.0, sign * model.amplitude * sin + 0.0


def _part(name: str) -> str:
    return (resources.files(__package__) / "fortran" / f"{name}.f").read_text("utf-8")


def _properties(model: Model, before: float, side: int) -> tuple[float, ...]:
    friction, shape = model.friction, model.shape
    across = 0.0 if model.on_body else base_amplitudes(model)[1]
    return (
        friction.mu,
        friction.exponent,
        friction.deflection_limit(model.slider.normal_force),
        friction.transfer,
        before + model.start if model.vibrates else _NEVER,
        model.frequency,
        across,
        float(shape.code) if shape is not None else float(SINE),
        shape.rise if shape is not None else 0.0,
        float(side),
    )


def _wave(model: Model) -> str:
    shape = model.shape
    if shape is None or shape.code != SAMPLED:
        return _part("wave")
    points = [number(value) for value in shape.table]
    lines = []
    for first in range(0, len(points), _SAMPLES_A_STATEMENT):
        values = points[first : first + _SAMPLES_A_STATEMENT]
        lines.append(f"      DATA (W(I),I={first + 1},{first + len(values)})/")
        rows = [", ".join(values[i : i + 2]) for i in range(0, len(values), 2)]
        lines += [f"     1 {row}," for row in rows[:-1]] + [f"     1 {rows[-1]}/"]
    return _part("wave_sampled").format(
        points=len(points), intervals=len(points) - 1, data="\n".join(lines)
    )


def _motion(model: Model, before: float) -> str:
    along, across = base_amplitudes(model)
    shape = model.shape
    return _part("disp").format(
        frequency=number(model.frequency),
        start=number(before + model.start),
        along=number(along),
        across=number(across),
        code=number(float(shape.code) if shape is not None else 0.0),
        rise=number(shape.rise if shape is not None else 0.0),
    )


def number(value: float) -> str:
    """Return a double-precision constant of Fortran."""
    mantissa, _, exponent = f"{value:.17g}".partition("e")
    if "." not in mantissa:
        mantissa += ".0"
    return f"{mantissa}D{int(exponent or 0)}"


def _heading(model: Model, properties: tuple[float, ...], moves_base: bool) -> list[str]:
    friction = model.friction
    what = "body" if model.on_body else "base"
    if model.solve.scheme == "two-phase":
        law = f"in two explicit phases, {what} vibrated"
    else:
        law = f"law '{friction.law}', exponential step, {what} vibrated"
    sampled = model.shape is not None and model.shape.code == SAMPLED
    waveforms = "3, that sampled below" if sampled else "0 sine, 1 triangle, 2 square"
    meaning = (
        "coefficient of friction",
        "Dahl's exponent",
        "SMAX, deflection of the asperities at full friction, m",
        "ETA, share of the vibration across the drive that reaches the contact",
        "total time at which the vibration starts, s",
        "its frequency, Hz",
        "amplitude of the base's motion across the drive, m",
        f"its waveform: {waveforms}",
        "rise time of a square wave, periods",
        "1 if the second slip direction is +y, -1 if it is -y",
    )
    lines = [
        f"User subroutine FRIC for Abaqus/Standard, written by asperity: Dahl friction, {law}.",
        "",
        "The asperities of the contact are bent by the slip and relax on the way. The stress is "
        "TAU = MU P S/SMAX, S the deflection. Directions of slip: 1 along the drive (x), 2 across "
        "it. SI units: m, s, Pa.",
        "",
        "PROPS, and what this case gives:",
        *(
            f"{i:3d}  {word}: {value:.10g}"
            for i, (word, value) in enumerate(zip(meaning, properties, strict=True), start=1)
        ),
        "",
        "STATEV: 1, 2 deflection along both directions of slip; 3 its size with a sign; m. Abaqus "
        "hands over the values at the start of the increment in every iteration, so that an "
        "iteration never moves the history; it starts from zeros.",
        "",
        "LM: a point that was open when the increment began comes with 2 and goes back with 2 (it "
        "slides freely, its asperities unbent); any other goes back with 0. The stress depends on "
        "the slip and the pressure, and the derivatives by both are given; DDTDDP counts only "
        "with an unsymmetric solver (*STEP, UNSYMM=YES).",
        "",
    ]
    if not model.on_body:
        lines += [
            "The law tells the motion of the base from that of the body; Abaqus gives the slip, "
            "the difference of the two. The base moves as PROPS 5 to 9 say, so that its part of "
            "an increment follows from TIME(2), the total time at the end of the increment, and "
            "DTIME: the amplitude in the deck must be the same.",
            "PROPS(10) must fit the directions of slip Abaqus chose. The second is the normal of "
            "the surface times the first: -y for the lower face of a block. To check: soon after "
            "the start of the vibration the body hardly moves, so that CSLIP2 is -PROPS(10) times "
            "the displacement of the base.",
            "",
        ]
    if model.solve.scheme == "two-phase":
        lines += [
            "Until the vibration starts the direction of the deflection is forced to +x: the "
            "friction across the drive is zero, and a drive backwards runs away. The step is "
            "explicit: unstable where the slip in an increment exceeds 2 SMAX, and a few percent "
            "wrong already at SMAX/3.",
            "",
        ]
    if moves_base:
        lines += ["DISP moves the base, for the waveform is not a sine.", ""]
    return lines


def commented(lines: Iterable[str]) -> Iterable[str]:
    """Yield lines of comment, as wide as fixed-form Fortran has them."""
    for line in lines:
        hanging = " " * 5 if line.startswith("  ") else ""
        wrapped = textwrap.wrap(line, _WIDTH - 2, subsequent_indent=hanging) or [""]
        yield from (f"C {text}".rstrip() + "\n" for text in wrapped)
