"""The map of a body's state over a cycle of the vibration, whose fixed point repeats itself."""

import itertools
import math
from collections.abc import Iterator
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.slider import kernels as k
from asperity.slider.at_limit import bends_only, comes_to_its_limit
from asperity.slider.integrators import LoadedIntegrator, integrator
from asperity.slider.model import Model
from asperity.slider.on_twice import DIFFERENTIATE, at_state
from asperity.slider.pressed import march_pressed
from asperity.slider.shooting import ACCEPTED, run, shoot
from asperity.slider.unknowns import (
    most_unknowns,
    read_unknowns,
    unknown_scales,
    write_unknowns,
)
from asperity.vibration.waveform import TRIANGLE, cycle_of_wave

_Kind = TypeVar("_Kind")

UNSTABLE = 1.0 + 1e-3
_PUSH = 1e-3
_LITTLE = 1e-2  # of it, from where what grows towards another motion nearby is told from the two
_NEAR_ONE = 1e-2
_WATCHED = 64  # cycles of a march that is pushed
_FEW = 2  # of them, after which a friction that keeps this share of what is allowed has told it
_CLEARLY = 0.1
_LASTING = 1.0 - 1e-5  # a multiplier by differences is as exact
_SURE = 1.0 + 2e-5  # above which it is not 1
_LONGER = 64, 256  # times the cycles, over which a slow growth is told
_AS_OFTEN = 0.25  # of the times as many, that a growth over the longer time may be off it
_FAR_PUSH, _HARD_PUSH = 0.1, 0.3
_SAME_RATIO, _SAME_IN_PLANE = 1e-6, 2e-5
_MOST_WATCHED = 2000
_PLAINLY = 1.01  # growth that three digits tell
_GONE = 100.0  # times the push: it does not come back
# Of a push, that is left of it at most in twice as many cycles, if it fades.
_FADED, _FADING = 0.9, (256, 512, 1024)
_ONE_MODE = 1e-6  # of their size, up to which modes are apart that are taken as one


class Cycle:
    """The map of a body's state over one cycle of the vibration, or over several.

    Attributes
    ----------
    body : Integrator
        At the start of the cycle.
    residual : float
        Largest scaled change of an unknown over the cycle.
    run : int
        Cycles integrated so far.
    step, phase : float
        Its step, s, and where in the wave it begins, in cycles.

    Parameters
    ----------
    phase : float
        Where in the wave it begins, in cycles.
    """

    def __init__(self, model: Model, steps: int, step: float, phase: float = 0.0) -> None:
        self.body = integrator(model, step)
        self.step = step
        self.phase = phase
        self.residual = math.inf
        self.run = 0
        self.period = 1
        self.springs = np.zeros((2, 0))
        self.q = None
        if isinstance(self.body, LoadedIntegrator):
            self.q, self.springs = self.body.q, self.body.kept["springs"]
        self.increments, self.rises = self.waves(steps, step)
        if isinstance(self.body, LoadedIntegrator):
            self.body.place(1.0, ramped=False)

    def waves(self, steps: int, step: float) -> tuple[FloatArray, FloatArray]:
        """Return increments in the plane and up over steps in s, and over one of the next cycle."""
        model = self.body.model
        still = np.zeros(steps + 1)
        if not model.vibrates:
            return still, still
        along = cycle_of_wave(model.wave(step, lead=self.phase), steps)
        if self.q is None:
            return along, still
        if model.normal_lead == 0.0:
            return along, along
        lead = self.phase + model.normal_lead
        return along, cycle_of_wave(model.wave(step, lead=lead), steps)

    def halves(self) -> tuple[FloatArray, FloatArray]:
        """Return the same over half the steps, which end nearer to corners that steps miss."""
        if self._straight:
            along = _halved(self.increments)
            return along, (np.zeros(along.size) if self.q is None else along)
        steps = (self.increments.size - 1) // self.period
        along, up = self.waves(2 * steps, 0.5 * self.step)
        if self.period == 1:
            return along, up
        return _repeated(along, self.period), _repeated(up, self.period)

    @property
    def _straight(self) -> bool:
        """Whether its waves go straight over every step: triangles, whose corners steps end on."""
        model = self.body.model
        triangle = model.shape is not None and model.shape.code == TRIANGLE and model.meets_corners
        leads = self.phase == 0.0 and (self.q is None or model.normal_lead == 0.0)
        return triangle and leads and (self.increments.size - 1) // self.period % 4 == 0

    @property
    def at_the_limit(self) -> bool:
        """Whether friction at its limit was found to repeat itself: in a cycle, before a search."""
        return self.run <= 2

    def copied(self) -> "Cycle":
        """Return the same map, for the body to go elsewhere."""
        other = _like(self)
        body = other.body = _like(self.body)
        body.kept = {"state": body.kept["state"].copy(), "sums": body.no_sums()}
        body.sums["breakaway"] = -1.0
        other.springs = body.kept["springs"] = self.springs.copy()
        return other

    def repeat(self, times: int) -> None:
        """Ask for a state that repeats itself only after so many times the cycles."""
        self.period *= times
        same = self.rises is self.increments
        self.increments = _repeated(self.increments, times)
        self.rises = self.increments if same else _repeated(self.rises, times)

    def find(self, settle: int) -> bool:
        """Look for the state that repeats itself; ``settle`` as in `shoot`."""
        size = most_unknowns(self.springs)
        jacobian = np.zeros((size + 1, size))
        self.residual, cycles, unknowns = shoot(
            self.body.kept["state"], self.springs, self.body.p, self.q, self.increments,
            self.rises, self.body.sums, jacobian, settle,
        )  # fmt: skip
        self.jacobian = jacobian[:unknowns, :unknowns]
        self.slopes = jacobian[unknowns, :unknowns]
        self.run += cycles * self.period
        return bool(self.residual <= ACCEPTED)

    def multiplier(self) -> float:
        """Return how much the least stable disturbance grows over the cycle.

        By differences; but the map has corners, where a difference of one side is no derivative, so
        that what seems to grow is marched, pushed to either side.
        """
        growth = self._by_differences()
        return self._marched(growth) if growth > UNSTABLE else growth

    def _by_differences(self) -> float:
        return _growth(self.jacobian)

    def grows_slowly(self, growth: float) -> bool:
        """Whether what is 1 within the bound of what is told unstable is above it nevertheless.

        A corner of the map or its rounding adds to a multiplier once, however many cycles it is
        over; what grows does so in each of them, as often as there are.
        """
        if not _SURE < growth <= UNSTABLE:
            return False
        early = self._growth_over(_LONGER[0])
        if not early > UNSTABLE:
            return False
        late = self._growth_over(_LONGER[1])
        times = math.log(max(late, 1.0)) / math.log(early)
        return abs(times * _LONGER[0] / _LONGER[1] - 1.0) < _AS_OFTEN

    def _growth_over(self, cycles: int) -> float:
        """How much the least stable disturbance grows over so many times the cycles from here.

        By differences too, which a state that was found bears for as long without being found anew.
        """
        same, along = self.rises is self.increments, _repeated(self.increments, cycles)
        unknowns = len(self.jacobian)
        found = np.empty((unknowns + 1, unknowns))
        at_state(
            self.body.kept["state"], self.springs, self.body.p, self.q, along,
            along if same else _repeated(self.rises, cycles), self.body.no_sums(), found, 0,
            DIFFERENTIATE,
        )  # fmt: skip
        return _growth(found[:unknowns]) if np.isfinite(found).all() else math.inf

    def one_of_many(self, growth: float) -> bool:
        """Whether a disturbance of a state lasts, and the mean force follows it."""
        if not lasts(growth):
            return False
        # Drive and contact may both ring: which lasts a rounding longer says nothing.
        return any(
            self._is_followed(mode) and not self._bends(mode) and not self._fades_after_all(mode)
            for mode in _modes(self.jacobian, _LASTING)
        )

    def _is_followed(self, mode: npt.NDArray[np.complex128]) -> bool:
        """Whether the mean force follows a disturbance that lasts."""
        most = _SAME_RATIO if self.q is not None else _SAME_IN_PLANE
        if self.q is None and mode.imag.any():
            # A ring. By its square it does the same always, and what comes and goes twice a turn: a
            # quarter of a turn on, that has the other sign. Of two pushes so far apart half the sum
            # lasts, and the lesser is told at once: by friction, which a slow drive follows late.
            parts = mode.real, mode.imag
            if all(abs(self._shift(part, _FEW, _FEW)) <= _CLEARLY * most for part in parts):
                return False
        return not abs(self._shift(mode.real, _WATCHED)) <= most

    def _bends(self, mode: npt.NDArray[np.complex128]) -> bool:
        """Whether a mode is one of asperities that come to their limit by a power of the time."""
        body = self.body
        state = body.kept["state"][0]
        return comes_to_its_limit(body.model, body.sums, state) and bends_only(
            mode, state, self.springs, body.p, self.q
        )

    def _fades_after_all(self, mode: npt.NDArray[np.complex128]) -> bool:
        """Whether less and less is left of a push, though no multiplier tells that it fades.

        By a power of the time: asperities of an exponent above 1 that are next to their limit. Of a
        ring that lasts as much is left, however long.
        """
        share = _share_of(self.jacobian, mode)
        for push in (_HARD_PUSH, -_HARD_PUSH):
            pushed = self.pushed(push * mode.real, _FADING[-1])
            before, most, done = math.inf, float(abs(push * (share @ mode.real))), 0
            for cycles in _FADING:
                left = [abs(share @ off) for off, _ in itertools.islice(pushed, cycles - done)]
                most = max(most, float(np.max(left)))
                if not most <= _FADED * before:
                    return False
                before, most, done = most, 0.0, cycles
        return True

    def _shift(self, mode: FloatArray, cycles: int, since: int = 1) -> float:
        """How far the mean force of cycles after a push, from one of them on, is off the state's.

        A ring of the drive comes and goes with its sign: what both sides share is what it does.
        """
        means = [
            mean
            for push in (_FAR_PUSH, -_FAR_PUSH)
            for _, mean in list(self.pushed(push * mode, cycles))[since - 1 :]
        ]
        return float(np.mean(means)) - self._mean_force(self.body.sums)

    def _mean_force(self, sums: np.void) -> float:
        """Mean force over mu F_N: in the plane friction, of a pressed body that of the drive."""
        name = "friction_x" if self.q is None else "drive_force"
        return float(sums[name]) / float(sums["steps"])

    def _marched(self, growth: float) -> float:
        """Return how much a push grows a cycle in a march, to the worse side, for what it may.

        What grows may end on another motion nearby, and stays as far off from then on, as if it
        neither grew nor faded: from much nearer to the state its growth is told.
        """
        worst, left = self._of_pushes(_PUSH, growth)
        if abs(worst - 1.0) > _NEAR_ONE or left < _PUSH:
            return worst
        nearer, _ = self._of_pushes(_LITTLE * _PUSH, growth)
        return nearer if nearer > UNSTABLE else worst

    def _of_pushes(self, size: float, growth: float) -> tuple[float, float]:
        """How much a push of a size grows a cycle, to the worse side, and the most left of it."""
        worst, left, mode = 0.0, 0.0, _modes(self.jacobian)[0].real
        half = round(0.5 * min(max(math.log(_GONE) / math.log(growth), _WATCHED), _MOST_WATCHED))
        for push in (size, -size):
            # The mode may turn round slowly: the most of a time tells more than its end.
            most = [size, 0.0]
            for n, (apart, _) in enumerate(self.pushed(push * mode, 2 * half)):
                off = float(np.abs(apart).max(initial=0.0))
                if not off <= _GONE * size:
                    grown = off / size if math.isfinite(off) else _GONE
                    worst = max(worst, grown ** (1.0 / (n + 1)))
                    break
                most[n >= half] = max(most[n >= half], off)
            else:
                worst = max(worst, (most[1] / most[0]) ** (1.0 / half))
                left = max(left, most[1])
        return worst, left

    def pushed(self, push: FloatArray, cycles: int) -> Iterator[tuple[FloatArray, float]]:
        """March from the state, pushed in scaled unknowns.

        Yields after each cycle how far each of them is off, and the mean force in it.
        """
        body, p, q = self.body, self.body.p, self.q
        here, there, scales = (np.empty(most_unknowns(self.springs)) for _ in range(3))
        state, springs, sums = body.kept["state"].copy(), self.springs.copy(), body.no_sums()
        count = unknown_scales(state, springs, p, q, scales)
        read_unknowns(state[0], springs, p, q, here)
        there[:] = here
        there[:count] += push * scales[:count]
        write_unknowns(there, p, q, state[0], springs)
        for _ in range(cycles):
            run(state[0], springs, p, q, self.increments, self.rises, sums[0])
            read_unknowns(state[0], springs, p, q, there)
            yield (there[:count] - here[:count]) / scales[:count], self._mean_force(sums[0])

    def record(self) -> FloatArray:
        """March over the cycle; returns what `history_of` takes, a row a step."""
        body = self.body
        steps = self.increments.size - 1
        nodes = np.empty(steps, body.node_type)
        here = body.kept["state"].copy()
        here["lateral"] = 0.0
        sums = body.no_sums()[0]
        if self.q is None:
            k.march_block(here[0], sums, body.p, self.increments, steps, nodes)
        else:
            here["height"] = 0.0
            march_pressed(
                here[0], self.springs.copy(), sums, body.p, self.q, self.increments, self.rises,
                steps, nodes, True,
            )  # fmt: skip
        # Recorded in one stretch, and given as one a step.
        nodes["position_x"] -= body.p.drive * np.arange(steps)
        rows: FloatArray = nodes.view(np.float64).reshape(steps, -1)
        return rows

    def disturb(self) -> None:
        """Push the body off its state, for it to go where it goes."""
        self.body.state["velocity_x"] *= 1.0 + _PUSH
        if self.q is not None:
            self.body.state["rise"] += _PUSH * math.sqrt(self.q.mobility)


def lasts(growth: float) -> bool:
    """Whether what grows so much a cycle neither grows nor fades, as exact as differences are."""
    return _LASTING <= growth <= UNSTABLE


def times(growth: float) -> str:
    """Say how much a disturbance grows a cycle, in digits that tell it from one that does not."""
    return f"{growth:.3g} times" if growth >= _PLAINLY else f"{growth:.7g} times"


def _like(one: _Kind) -> _Kind:
    """Return a shallow copy, in a third of the time that `copy.copy` takes."""
    other = object.__new__(type(one))
    other.__dict__.update(one.__dict__)
    return other


def _repeated(increments: FloatArray, times: int) -> FloatArray:
    return np.append(np.tile(increments[:-1], times), increments[0])


def _halved(increments: FloatArray) -> FloatArray:
    """Return the increments over half the steps of what goes straight over each."""
    halves = np.empty(2 * increments.size - 1)
    np.multiply(increments, 0.5, out=halves[::2])
    halves[1::2] = halves[:-1:2]
    return halves


def _growth(jacobian: FloatArray) -> float:
    """Largest multiplier of the cycle's map, whose Jacobian less one is given; 0 if not taken."""
    if not jacobian.any():
        return 0.0
    return float(np.abs(np.linalg.eigvals(_map_of(jacobian))).max())


def _map_of(jacobian: FloatArray) -> FloatArray:
    """Return the Jacobian of the map itself, in a third of the time that `np.eye` takes."""
    found = jacobian.copy()
    found.reshape(-1)[:: len(found) + 1] += 1.0
    return found


def _share_of(jacobian: FloatArray, mode: npt.NDArray[np.complex128]) -> npt.NDArray[np.complex128]:
    """Return what a disturbance has of a mode, as a row to multiply it by.

    Modes that are next to each other have a share each: two of asperities that bend sideways are.
    """
    _, modes = np.linalg.eig(_map_of(jacobian))
    shares = np.linalg.pinv(modes, rcond=_ONE_MODE)
    share: npt.NDArray[np.complex128] = shares[int(np.argmax(np.abs(shares @ mode)))]
    return share


def _modes(jacobian: FloatArray, least: float = math.inf) -> list[npt.NDArray[np.complex128]]:
    """Return what has at least this multiplier, the largest always and first, its most being 1.

    Of two that turn round opposite ways one.
    """
    growths, modes = np.linalg.eig(_map_of(jacobian))
    sizes = np.where(growths.imag < 0.0, -1.0, np.abs(growths))
    order = np.argsort(-sizes, kind="stable")
    lasting = max(1, int(np.count_nonzero(sizes >= least)))
    # Turned so that its real part is its most.
    return [mode / mode[np.argmax(np.abs(mode))] for mode in modes.T[order[:lasting]]]
