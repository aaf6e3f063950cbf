"""Static friction under vibration: the largest steady pull under which a body does not creep."""

import math
import time
from collections.abc import Mapping
from typing import Any, ClassVar

from asperity.casefile import Case
from asperity.errors import ConvergenceError, InputError
from asperity.results import Quantities, Result, labelled, part, quantity
from asperity.results.settled import Standing, by_what, told, whether_settled
from asperity.runs import Run
from asperity.slider.closed_forms import load_swing, plane_static_ratio
from asperity.slider.closed_forms.profiles import Profile
from asperity.slider.cost import time_of_cycles
from asperity.slider.held import ROUNDING, STANDING, Creep, HeldBody
from asperity.slider.model import Model
from asperity.slider.pressed import friction_limit
from asperity.slider.result import inputs
from asperity.slider.ringing import lasting_ring, rings
from asperity.slider.space import too_few_springs
from asperity.vibration.waveform import SINE

# Of mu W: how near the limit is found, how far above it the creep is told, where it is sought.
_RESOLUTION = 1e-5
_ABOVE = 0.01
_FARTHEST = 64.0
_PULLS = 20  # that are tried, of most cases
# From this frequency on, over that of the body on its asperities, a heavy body stands still.
_STANDS_STILL = 10.0
_PROFILES: dict[str, Profile] = {"linear": "flat", "hertz": "hertz", "rough": "rough"}


class LeastLoad(Quantities):
    """What happens normal to the plane, over a period."""

    ratio_mean_load: float | None = quantity(
        "F_s/mu N", "", "static friction over mu times mean load"
    )
    normal_mean: float = quantity("N", "N", "mean normal force")
    normal_min: float = quantity("N_min", "N", "least normal force")
    normal_max: float = quantity("N_max", "N", "greatest normal force")
    open_share: float = quantity("", "", "share of the time without contact")
    period: float | None = quantity("", "", "cycles until the state repeats itself")
    multiplier: float | None = quantity("", "", "growth of a disturbance over that period")


class StaticResult(Result):
    r"""Static friction of a body on a vibrating base.

    Attributes
    ----------
    model : Model
        What was solved; its drive does not matter.
    static_force, static_ratio : float
        The largest steady pull that does not creep forward, N and over :math:`\mu W`. Negative
        where the vibration carries the body forward that much.
    creep : float or None
        Mean velocity under a pull 1 % of :math:`\mu W` above it, m/s; None: it does not
        settle, or runs away.
    closed_form_ratio : float or None
        What a closed form says; None where there is none.
    closed_form : str
        Which one.
    settled : bool
        Whether what is normal to the plane repeats itself whatever its start.
    settled_by : str
        What shows it, or what is missing.
    normal : LeastLoad or None
        None where the normal force is a constant.
    """

    title: ClassVar[str] = "Static friction"
    stem: ClassVar[str] = "static"

    model: Model
    static_force: float = quantity("F_s", "N", "largest steady pull that does not creep")
    static_ratio: float = quantity("F_s/(mu W)", "", "static friction over mu W")
    creep: float | None = quantity("v", "m/s", "creep under 1 % of mu W more", key="creep_m_s")
    closed_form_ratio: float | None = quantity("", "", "the same by a closed form")
    closed_form: str = quantity("", "", "closed form", only="json", shown=False)
    settled: bool = whether_settled()
    settled_by: str = by_what()
    normal: LeastLoad | None = part(LeastLoad, default=None)
    seconds: float = quantity(
        "", "s", "time it took", key="seconds", only="json", shown=False, swept=False, default=0.0
    )

    @property
    @labelled("mu W", "N", "friction without vibration")
    def full_friction(self) -> float:
        r"""Friction without vibration, :math:`\mu W`, N."""
        return self.model.full_friction

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the model's tables in SI, by ``table.key``."""
        return inputs(self.model)

    def heading(self) -> str:
        """Return what was found, and beside which closed form."""
        beside = self.closed_form or "none for this contact and direction"
        return f"static friction; closed form: {beside}"

    def headline(self) -> tuple[str, ...]:
        """Return that it has not settled, where it has not."""
        return told(self)


def prepare(case: Case) -> Model:
    """Return the model of a case, refused if it has no static friction under vibration.

    Raises
    ------
    InputError
        Naming the key.
    """
    model = Model.from_case(case)
    if model.slider.mass is None:
        raise InputError(
            "slider.mass is missing; a body under a constant pull needs one (massless it would "
            "jump)"
        )
    if not model.vibrates:
        raise InputError(
            "nothing vibrates, so that static friction is friction.mu times slider.normal_force, "
            f"{model.full_friction:g} N; describe a [vibration]"
        )
    if model.solve.scheme == "two-phase":
        raise InputError(
            "solve.scheme is 'two-phase', which knows a drive that moves only; leave it out"
        )
    _ = model.substeps
    return model


def answer(model: Model, run: Run) -> StaticResult:
    """Find the limit by bisection, and the creep above it.

    Raises
    ------
    ConvergenceError
        The body creeps, or stands, under every pull.
    """
    began = time.perf_counter()
    body = HeldBody(model)
    run.forecast(time_of_cycles(model, _PULLS * body.cycles), f"{_PULLS} pulls")
    ratio, least, notes = _limit(body, run)
    standing = _standing(body)
    creep = body.creep(ratio + _ABOVE, settled=True, standing=least)
    closed, which = closed_form(body)
    return StaticResult(
        model=model,
        static_force=ratio * model.full_friction,
        static_ratio=ratio,
        creep=creep.velocity if creep.steady else None,
        closed_form_ratio=closed,
        closed_form=which,
        settled=standing.settled,
        settled_by=standing.settled_by,
        normal=_least_load(body, ratio),
        seconds=time.perf_counter() - began,
        notes=body.notes + notes + _remarks(model, creep, ratio, closed),
    )


def _limit(body: HeldBody, run: Run) -> tuple[float, float, tuple[str, ...]]:
    r"""Find the largest pull without a creep forward.

    Returns
    -------
    ratio : float
        It, over :math:`\mu W`.
    least : float
        Creep that counts, as `HeldBody.creep` takes it.
    notes : tuple of str
        What to know of it.
    """
    at_rest = body.creep(0.0).velocity
    low, high = (0.0, 1.0) if at_rest <= 0.0 else (-1.0, 0.0)
    while at_rest > 0.0 and body.creep(low).velocity > 0.0:
        low, high = 2.0 * low, low
        _bounded(low)
    while at_rest <= 0.0 and body.creep(high).velocity <= 0.0:
        low, high = high, 2.0 * high
        _bounded(high)
    halvings = math.ceil(math.log2((high - low) / _RESOLUTION))
    # Not within `interruptible`: nothing is kept, so that Ctrl-C may end a pull in its middle.
    for done in range(halvings):
        middle = 0.5 * (low + high)
        if body.creep(middle).velocity > 0.0:
            high = middle
        else:
            low = middle
        run.checkpoint(done + 1, halvings, what="pulls")
    if at_rest != 0.0 and body.creep(low - _ABOVE).velocity < 0.0:
        both_ways = (
            "the vibration carries the body along: it goes backward under 1 % of mu W less, "
            "forward under more"
        )
        return low, STANDING, (both_ways,)
    if at_rest == 0.0 and low > 0.0 and body.creeps_below(low):
        creeps = (
            "asperities of this law yield before they slip: shaken so, they creep under any pull; "
            f"at {low:.3g} of mu W by a millionth of their deflection limit a cycle"
        )
        return 0.0, ROUNDING, (creeps,)
    return low, STANDING, ()


def _standing(body: HeldBody) -> Standing:
    """Whether the pulls are those of one motion normal to the plane."""
    missing = []
    if rings(body.model, by_itself=True):
        missing.append(lasting_ring(body.model))
    if body.period is None:
        missing.append("the motion normal to the plane never repeats itself")
    return Standing.of(
        missing, "pulls are tried in the state from rest, which repeats itself, until none fades"
    )


def _bounded(pull: float) -> None:
    if abs(pull) > _FARTHEST:
        raise ConvergenceError(
            f"no pull up to {_FARTHEST:g} times the friction force is where the body begins to "
            "creep",
            reached={"pull": pull},
        )


def _remarks(model: Model, creep: Creep, ratio: float, closed: float | None) -> tuple[str, ...]:
    notes: tuple[str, ...] = ()
    if not creep.steady:
        notes += (
            "under 1 % of mu W more the body finds no steady creep: it runs away, or never repeats "
            "itself",
        )
    friction = model.friction
    early = closed is not None and ratio < closed * (1.0 - _ABOVE)
    if early and friction.model == "lugre" and (friction.static_mu or 0.0) > friction.mu:
        notes += (
            "the pull is put on at once, and LuGre's static friction is left before it is reached: "
            f"a body that is pulled up slowly may hold more, up to {closed:.3g} of mu W",
        )
    if friction.model == "springs":
        notes += too_few_springs(model)
    if model.normal is not None and friction.keeps == "deflection":
        notes += (
            "with friction.keeps 'deflection' asperities gain energy under a changing normal "
            "force, and creep under any pull; 'stiffness' holds",
        )
    return notes


def _least_load(body: HeldBody, ratio: float) -> LeastLoad | None:
    sums = body.sums
    if sums is None:
        return None
    load = body.model.slider.normal_force
    mean = float(sums["load"] / sums["steps"])
    return LeastLoad(
        ratio_mean_load=ratio / mean if mean else None,
        normal_mean=mean * load,
        normal_min=float(sums["load_min"]) * load,
        normal_max=float(sums["load_max"]) * load,
        open_share=float(sums["open"] / sums["steps"]),
        period=body.period,
        multiplier=body.multiplier,
    )


def closed_form(body: HeldBody) -> tuple[float | None, str]:
    r"""Return static friction over :math:`\mu W` by a closed form, and which; (None, "") without.

    Vibration along the normal leaves :math:`\mu` times the least load of a period, here that of the
    body itself. Vibration along the pull takes the amplitude of the asperities'
    deflection from the indentation: for a flat contact under a sine by the body's resonance on its
    asperities too, else where the body is too heavy to follow. Dahl's asperities with an exponent
    above 0 creep there under any pull: from a closed path they come back less deflected.
    """
    model = body.model
    friction = model.friction
    along, across, up = model.unit_direction
    if model.normal is not None and body.sums is not None and along == across == 0.0:
        if friction.model != "coulomb" and friction.keeps == "deflection":
            return None, ""
        static = (friction.static_mu or friction.mu) / friction.mu
        least = float(friction_limit(body.sums["load_min"], friction.load_exponent))
        return static * least, "mu N_min"
    if across != 0.0 or up != 0.0:
        return None, ""
    if friction.model == "dahl" and friction.exponent > 0.0:
        return 0.0, "0: exponents above 0 creep under any pull"
    if friction.model not in ("dahl", "springs"):
        return None, ""
    profile: Profile = "flat"
    if friction.model == "springs" and model.normal is not None:
        profile = _PROFILES[model.normal.law]
    sine = model.shape is not None and model.shape.code == SINE
    if body.frequency_ratio < _STANDS_STILL and not (sine and profile == "flat"):
        return None, ""
    limit = friction.deflection_limit(model.slider.normal_force)
    amplitude = model.amplitude
    if sine:
        try:
            amplitude *= float(load_swing(1.0, body.frequency_ratio, 0.0))
        except InputError:
            return None, ""
    forms = {"flat": "1 - u/s_max", "hertz": "(1 - 2u/(3 s_max))^1.5", "rough": "exp(-u/s_max)"}
    return float(plane_static_ratio(amplitude, limit, profile)), forms[profile]
