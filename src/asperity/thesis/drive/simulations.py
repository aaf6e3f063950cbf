"""The 33 simulations of a shaken gearset by what decides them, and which of them an exhibit shows.

Light, so that a run can hand them out before anything of theirs is imported.
"""

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING

from asperity.runs.workers import Task
from asperity.thesis.cached import once
from asperity.thesis.cases import Shipped
from asperity.thesis.drive.fine import given
from asperity.thesis.drive.sets import BASE as BASE
from asperity.thesis.drive.sets import Condition, conditions
from asperity.thesis.exhibits import Part

if TYPE_CHECKING:
    from asperity.thesis.drive.marches import Loaded, Shaken, Stroke

_ROOM = "asperity.thesis.drive"
_SOLVED_BY = f"{_ROOM}.marches"
_MARCHING, _LOADING = 0.2, 7.0  # s, about

COULOMB = "friction.model=coulomb"
MESHES = ("coarse", "intermediate", "fine")
"""Those of a flank that is loaded: 11, 15 and 23 elements high, 13, 18 and 27 along the face."""


class Simulation(Shipped):
    """A shaken gearset."""

    verb = "drive"

    def shaken(self) -> "Shaken":
        """What it comes to, marched once for all runs."""
        from asperity.thesis.drive.marches import Shaken, march

        return once(self, Shaken, _SOLVED_BY, functools.partial(march, self.case, self.settings))

    @property
    def task(self) -> Task:
        """To march it, for those that ask later."""
        return Task(f"march {self.name}", self.shaken, _ROOM, _MARCHING)


class OnFine(Simulation):
    """A shaken gearset whose teeth are those that are kept of the fine mesh."""

    @property
    def name(self) -> str:
        """Case and settings, the teeth by the name of their mesh."""
        own = self.settings[: -len(given())]
        return " ".join((self.case, *own, f"drive.density={MESHES[-1]}"))


class OnDemandStroke(Shipped):
    """An actuator that is shaken on demand."""

    verb = "drive"

    def stroke(self) -> "Stroke":
        """What its stroke comes to, solved once for all runs."""
        from asperity.thesis.drive.marches import Stroke, stroke

        return once(self, Stroke, _SOLVED_BY, functools.partial(stroke, self.case, self.settings))

    @property
    def task(self) -> Task:
        """To solve it, for those that ask later."""
        return Task(f"stroke {self.name}", self.stroke, _ROOM, _LOADING)


STROKE = OnDemandStroke("drive-actuator")


class LoadedTeeth(Shipped):
    """A gearset's elastic teeth under load, without vibration."""

    verb = "drive"

    def loaded(self) -> "Loaded":
        """What they come to, solved once for all runs."""
        from asperity.thesis.drive.marches import Loaded, load

        return once(self, Loaded, _SOLVED_BY, functools.partial(load, self.case, self.settings))

    @property
    def task(self) -> Task:
        """To solve them, for those that ask later."""
        return Task(f"load {self.name}", self.loaded, _ROOM, _LOADING)

    def command(self, verb: str = "", **options: tuple[str, ...]) -> str:
        """How to come by it on the command line."""
        return f"{Shipped.command(self, verb, **options)} --static"


def meshes(full: bool = True) -> list[LoadedTeeth]:
    """Return the teeth of gearset 3 on the meshes that take seconds, from coarse to finer."""
    del full
    return [LoadedTeeth(BASE, ("drive.phases=12", f"drive.density={name}")) for name in MESHES[:-1]]


def on_mesh(density: str) -> list[Simulation]:
    """Return the simulations of set 3 with teeth meshed so."""
    if density == MESHES[0]:
        return of_set(3)  # as the case has it
    if density == MESHES[-1]:
        return [OnFine(one.case, one.settings) for one in of_set(3, *given())]
    return of_set(3, f"drive.density={density}")


def simulation(condition: Condition, *settings: str) -> Simulation:
    """Return the simulation of a row of Table 7.2, with more settings."""
    return Simulation(
        BASE,
        (
            f"vibration.frequency={condition.frequency:.6g} Hz",
            f"vibration.velocity_amplitude={condition.velocity:.6g} m/s",
            f"operation.worm_speed={condition.worm_speed:.6g} rad/s",
            f"operation.output_torque={condition.torque:g} N m",
            *settings,
        ),
    )


def of_set(number: int, *settings: str) -> list[Simulation]:
    """Return the eleven simulations of a set."""
    return [simulation(condition, *settings) for condition in conditions(number)]


OURS = {
    "drive.load_inertia": (3.2e-3, "kg m**2"),
    "drive.worm_inertia": (1.3e-5, "kg m**2"),
    "drive.contact_damping": (0.01, "s/m"),
    "mount.backlash": (0.28, "mm"),
}
"""What the thesis does not give of the shaken gearset, as the case has it, and its unit."""

FACTORS = (1.0 / 3.0, 3.0)
"""By which each of it is varied."""


def varied(full: bool = True) -> list[Simulation]:
    """Return the last simulation of set 3 with each of what is ours less and more."""
    del full
    last = conditions(3)[-1]
    return [
        simulation(last, f"{key}={factor * value:.6g} {unit}")
        for key, (value, unit) in OURS.items()
        for factor in FACTORS
    ]


ACTUATOR = (
    "actuator.coupling=0.3", "actuator.quality_factor=500", "actuator.efficiency=0.9",
    "drive.worm_mass=0.3 kg",
)  # fmt: skip
"""An ultrasonic actuator, tuned to each frequency, and the worm that it moves."""

Parts = Callable[[bool], Sequence[Part]]


def _of_sets(given: tuple[tuple[int, tuple[str, ...]], ...], full: bool) -> list[Simulation]:
    del full
    return [one for number, settings in given for one in of_set(number, *settings)]


def _kept(*given: tuple[int, tuple[str, ...]]) -> Parts:
    # Functions of a module alone can be handed to other processes.
    return functools.partial(_of_sets, given)


def _last(full: bool) -> list[Simulation]:
    del full
    return of_set(3)[-1:]


def _savings(full: bool) -> list[Simulation]:
    return [*_last(full), *varied(full)]


def _coarse(full: bool) -> list[LoadedTeeth]:
    return meshes(full)[:1]


def _stroke(full: bool) -> list[OnDemandStroke]:
    del full
    return [STROKE]


def _marched(full: bool) -> list[Simulation]:
    del full
    return [run for name in MESHES for run in on_mesh(name)]


def _on_meshes(full: bool) -> list[Part]:
    # The marches of a mesh come after its teeth, whose deflection they use.
    return [*meshes(full), *_marched(full)]


PARTS: Mapping[str, Parts] = {
    "figure 7.10": _last,
    "figure 7.12": _marched,
    "figure 7.13": _kept((1, ()), (2, ())),
    "figure 7.14": _kept((3, ()), (3, (COULOMB,))),
    "figure 7.15": _kept((3, ACTUATOR)),
    "claim 7.2": _coarse,
    "claim 7.3": _kept((3, ())),
    "claim 7.5": _on_meshes,
    "claim 7.6": _kept((3, ()), (3, (COULOMB,))),
    "claim 7.7": _kept((3, ACTUATOR)),
    "claim 7.10": _kept((1, ()), (2, ())),
    "claim 7.11": _savings,
    "claim 7.13": _kept((3, ())),
    "claim 7.15": _kept((3, ())),
    "claim 7.17": _coarse,
    "claim 7.23": _kept((1, ()), (2, ()), (3, ())),
    "claim 8.2": _stroke,
}
"""What each exhibit needs of them."""
